//! Numbers, intervals and tables in Markdown.

use crate::eval::Interval;

/// What stands where nothing is known yet.
pub const MISSING: &str = "not yet run";

/// A Markdown table.
pub struct Table {
    text: String,
}

impl Table {
    /// A table with these titles; those that begin with `>` head a column of numbers.
    pub fn new(titles: &[&str]) -> Table {
        let shown: Vec<&str> = titles.iter().map(|title| title.trim_start_matches('>')).collect();
        let rule: Vec<&str> = titles.iter().map(|title| if title.starts_with('>') { "---:" } else { "---" }).collect();
        Table { text: format!("| {} |\n| {} |\n", shown.join(" | "), rule.join(" | ")) }
    }

    /// Adds a row.
    pub fn row<S: AsRef<str>>(&mut self, cells: &[S]) {
        let cells: Vec<&str> = cells.iter().map(AsRef::as_ref).collect();
        self.text += &format!("| {} |\n", cells.join(" | "));
    }

    /// The table as text.
    pub fn finish(self) -> String {
        self.text
    }
}

/// A share in per cent: `97.5 %`, `100 %`.
pub fn percent(share: f64) -> String {
    let tenths = (1000.0 * share).round() / 10.0;
    if tenths.fract() == 0.0 { format!("{tenths:.0} %") } else { format!("{tenths:.1} %") }
}

/// An interval of shares in per cent: `[98.2, 100]`.
pub fn percents(interval: Interval) -> String {
    let bare = |share: f64| percent(share).trim_end_matches(" %").to_owned();
    format!("[{}, {}]", bare(interval.low), bare(interval.high))
}

/// A count with thousands set apart by thin spaces: `1 234 567`; `never` for infinity.
pub fn count(number: f64) -> String {
    if number.is_infinite() {
        return "never".to_owned();
    }
    let digits = format!("{number:.0}");
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// A duration: `8.4 s`, `3.5 min`, `2.1 h`; `never` for infinity.
pub fn duration(seconds: f64) -> String {
    match seconds {
        s if s.is_infinite() => "never".to_owned(),
        s if s < 10.0 => format!("{s:.1} s"),
        s if s < 120.0 => format!("{s:.0} s"),
        s if s < 7200.0 => format!("{:.1} min", s / 60.0),
        s => format!("{:.1} h", s / 3600.0),
    }
}

/// `show` of the value, or [`MISSING`].
pub fn or_missing<T>(value: Option<T>, show: impl Fn(T) -> String) -> String {
    value.map_or_else(|| MISSING.to_owned(), show)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_people_read_them() {
        assert_eq!((percent(1.0), percent(0.975), percent(0.99949)), ("100 %".into(), "97.5 %".into(), "99.9 %".into()));
        assert_eq!(percents(Interval { low: 0.98172, high: 1.0 }), "[98.2, 100]");
        assert_eq!((count(999.0), count(1_234_567.0)), ("999".into(), "1\u{202f}234\u{202f}567".into()));
        assert_eq!([8.44, 75.0, 200.0, 9000.0].map(duration), ["8.4 s", "75 s", "3.3 min", "2.5 h"]);
        assert_eq!((count(f64::INFINITY), duration(f64::INFINITY)), ("never".into(), "never".into()));
    }

    #[test]
    fn tables_align_numbers_to_the_right() {
        let mut table = Table::new(&["task", ">steps"]);
        table.row(&["B1", "12"]);
        assert_eq!(table.finish(), "| task | steps |\n| --- | ---: |\n| B1 | 12 |\n");
    }
}
