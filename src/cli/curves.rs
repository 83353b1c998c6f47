//! Curves over episodes, read from `episodes.csv` and drawn with plotters.

use super::failure::Failure;
use super::plot::Metric;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::register_font;
use std::path::Path;

/// The font of plots, so that they look the same on machines without any: DejaVu Sans, see `assets/fonts/LICENSE-DejaVu.txt`.
const FONT: &[u8] = include_bytes!("../../assets/fonts/DejaVuSans-subset.ttf");

/// Okabe and Ito's palette, distinguishable with every kind of colour vision.
pub const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(0, 0, 0),
];

/// One run's metric, smoothed: points (episode, running mean).
#[derive(Clone, Debug)]
pub struct Curve {
    /// The run's folder name, for the legend.
    pub name: String,
    /// (episode, mean of the metric over the last `window` episodes).
    pub points: Vec<(f64, f64)>,
}

impl Curve {
    /// Reads `episodes.csv` in the folder `run`.
    ///
    /// # Errors
    /// A missing or malformed file, or one without episodes.
    pub fn read(run: &Path, metric: Metric, window: usize) -> Result<Curve, Failure> {
        let path = run.join("episodes.csv");
        let mut reader = csv::Reader::from_path(&path).map_err(|e| Failure::file(&path, e))?;
        let headers = reader.headers().map_err(|e| Failure::file(&path, e))?.clone();
        let column = headers
            .iter()
            .position(|h| h == metric.column())
            .ok_or_else(|| Failure::file(&path, format!("no column `{}`", metric.column())))?;
        let mut values = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|e| Failure::file(&path, e))?;
            let cell = record.get(column).unwrap_or_default();
            let value: f64 =
                cell.parse().map_err(|_| Failure::file(&path, format!("line {}: `{cell}` is no number", values.len() + 2)))?;
            values.push(value);
        }
        if values.is_empty() {
            return Err(Failure::file(&path, "no finished episode yet"));
        }
        let name = run.file_name().map_or_else(|| run.display().to_string(), |n| n.to_string_lossy().into_owned());
        Ok(Curve { name, points: running_mean(&values, window) })
    }
}

/// The mean of the last `window` values at each place (of fewer, at the beginning).
fn running_mean(values: &[f64], window: usize) -> Vec<(f64, f64)> {
    let mut sum = 0.0;
    values
        .iter()
        .enumerate()
        .map(|(i, v)| {
            sum += v;
            if i >= window {
                sum -= values[i - window];
            }
            (i as f64, sum / (i + 1).min(window) as f64)
        })
        .collect()
}

/// Makes the font known to plotters; before any drawing.
///
/// # Errors
/// If the font is damaged.
pub fn font() -> Result<(), Failure> {
    register_font("sans-serif", FontStyle::Normal, FONT).map_err(|_| Failure::running("the font of plots is damaged"))
}

/// Draws the curves into `out`, an `.svg` or `.png` file.
///
/// # Errors
/// Another ending, or a file that cannot be written.
pub fn draw(out: &Path, metric: Metric, curves: &[Curve]) -> Result<(), Failure> {
    font()?;
    let size = (960, 600);
    let ending = out.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    if let Some(folder) = out.parent().filter(|f| !f.as_os_str().is_empty()) {
        std::fs::create_dir_all(folder).map_err(|e| Failure::file(folder, e))?;
    }
    let drawn = match ending.as_str() {
        "svg" => chart(SVGBackend::new(out, size).into_drawing_area(), metric, curves).map_err(|e| e.to_string()),
        "png" => chart(BitMapBackend::new(out, size).into_drawing_area(), metric, curves).map_err(|e| e.to_string()),
        _ => return Err(Failure::file(out, "a picture must end in .svg or .png")),
    };
    drawn.map_err(|e| Failure::file(out, e))
}

fn chart<B: DrawingBackend>(
    area: DrawingArea<B, Shift>,
    metric: Metric,
    curves: &[Curve],
) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
    let all = || curves.iter().flat_map(|c| &c.points);
    let last = all().map(|p| p.0).fold(1.0, f64::max);
    let (low, high) = all().fold((0.0f64, 0.0f64), |(low, high), p| (low.min(p.1), high.max(p.1)));
    let room = if high > low { 0.05 * (high - low) } else { 1.0 };
    area.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&area)
        .margin(16)
        .x_label_area_size(44)
        .y_label_area_size(72)
        .build_cartesian_2d(0.0..last, low - room..high + room)?;
    chart.configure_mesh().x_desc("episode").y_desc(metric.title()).light_line_style(WHITE).draw()?;
    for (i, curve) in curves.iter().enumerate() {
        let style = COLOURS[i % COLOURS.len()].stroke_width(2);
        chart
            .draw_series(LineSeries::new(curve.points.iter().copied(), style))?
            .label(&curve.name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 20, y)], style));
    }
    chart.configure_series_labels().background_style(WHITE.mix(0.8)).border_style(BLACK).draw()?;
    area.present()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_running_mean_of_a_ramp_lags_by_half_its_window() {
        let ramp: Vec<f64> = (0..100).map(f64::from).collect();
        let points = running_mean(&ramp, 11);
        assert_eq!(points[50], (50.0, 45.0));
        assert_eq!(points[0], (0.0, 0.0));
        assert_eq!(points[1], (1.0, 0.5));
    }

    #[test]
    fn both_kinds_of_picture_are_written_and_others_refused() {
        let folder = std::env::temp_dir().join(format!("ltl-rover-curves-{}", std::process::id()));
        let curve = Curve { name: "b1".to_owned(), points: vec![(0.0, 0.0), (1.0, 0.5), (2.0, 0.4)] };
        let draw = |name: &str| draw(&folder.join(name), Metric::AverageReward, std::slice::from_ref(&curve));
        draw("a.svg").unwrap();
        draw("a.png").unwrap();
        assert!(draw("a.gif").is_err());
        let svg = std::fs::read_to_string(folder.join("a.svg")).unwrap();
        assert!(svg.contains("average reward per step") && svg.contains("b1"));
        let png = std::fs::read(folder.join("a.png")).unwrap();
        assert!(png.starts_with(b"\x89PNG"));
        std::fs::remove_dir_all(folder).unwrap();
    }
}
