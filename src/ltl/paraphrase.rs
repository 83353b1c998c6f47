//! A formula in plain English: a reading aid, not a second syntax.

use super::ast::{BinaryOperator as B, Formula, UnaryOperator as U};

impl Formula {
    /// The formula as an English sentence, without a full stop. Parentheses appear where the words alone could be read in two ways.
    ///
    /// ```
    /// use ltl_rover::ltl::Formula;
    /// let say = |text: &str| Formula::parse(text).map(|formula| formula.paraphrase());
    /// assert_eq!(say("G F r1 & G F r2 & G !unsafe")?, "again and again r1, and again and again r2, and never unsafe");
    /// assert_eq!(say("F (r1 & F r2)")?, "at some time r1, and from then on at some time r2");
    /// assert_eq!(say("G (alarm -> F reset)")?, "whenever alarm, then at some time reset");
    /// assert_eq!(say("!goal U key")?, "not goal until key, which comes");
    /// # Ok::<(), ltl_rover::ltl::ParseError>(())
    /// ```
    pub fn paraphrase(&self) -> String {
        sentence(self)
    }
}

/// A whole sentence: may contain commas.
fn sentence(formula: &Formula) -> String {
    match formula {
        Formula::Binary(B::And, ..) => {
            let parts: Vec<String> = flat(formula, B::And).into_iter().map(clause).collect();
            let separator = if parts.iter().any(|part| part.contains(',')) { "; and " } else { ", and " };
            parts.join(separator)
        }
        Formula::Binary(B::Or, ..) if !is_state(formula) => {
            format!("either {}", flat(formula, B::Or).into_iter().map(clause).collect::<Vec<_>>().join(", or "))
        }
        Formula::Binary(B::Implies, a, b) => format!("if {}, then {}", clause(a), clause(b)),
        Formula::Binary(B::Iff, a, b) => format!("{} exactly if {}", clause(a), clause(b)),
        _ => clause(formula),
    }
}

/// A part of a sentence: in parentheses if it would be several parts.
fn clause(formula: &Formula) -> String {
    use Formula::{Binary, False, Proposition, True, Unary};
    match formula {
        True => "anything".into(),
        False => "the impossible".into(),
        Proposition(name) => name.clone(),
        _ if is_state(formula) => state(formula),
        Unary(U::Not, a) => format!("it is not so that {}", bracketed(a)),
        Unary(U::Next, a) => {
            let (steps, inner) = steps(a, 1);
            let when = if steps == 1 { "in the next step".to_owned() } else { format!("in {steps} steps") };
            format!("{when} {}", bracketed(inner))
        }
        Unary(U::Finally, a) => match &**a {
            Unary(U::Globally, b) => format!("from some time on always {}", bracketed(b)),
            Binary(B::And, ..) if !is_state(a) => {
                let parts: Vec<String> = flat(a, B::And).into_iter().map(then).collect();
                format!("at some time {}", parts.join(", and "))
            }
            _ => format!("at some time {}", bracketed(a)),
        },
        Unary(U::Globally, a) => match &**a {
            Unary(U::Finally, b) => format!("again and again {}", bracketed(b)),
            Unary(U::Not, b) if is_state(b) => format!("never {}", inner_state(b)),
            Binary(B::Implies, b, c) => format!("whenever {}, then {}", bracketed(b), then_at_once(c)),
            _ => format!("always {}", bracketed(a)),
        },
        Binary(B::Until, a, b) => format!("{} until {}, which comes", bracketed(a), bracketed(b)),
        Binary(B::WeakUntil, a, b) => format!("{} until {}, or for ever", bracketed(a), bracketed(b)),
        Binary(B::Release, a, b) => {
            format!("{} up to and including the first time of {}, or for ever", bracketed(b), bracketed(a))
        }
        Binary(B::StrongRelease, a, b) => {
            format!("{} up to and including the first time of {}, which comes", bracketed(b), bracketed(a))
        }
        Binary(..) => format!("({})", sentence(formula)),
    }
}

/// What follows `at some time a, and …`.
fn then(formula: &Formula) -> String {
    match formula {
        Formula::Unary(U::Finally, _) | Formula::Unary(U::Globally, _) => format!("from then on {}", clause(formula)),
        _ => clause(formula),
    }
}

/// What follows `whenever a, then …`.
fn then_at_once(formula: &Formula) -> String {
    match formula {
        Formula::Binary(B::And, ..) if !is_state(formula) => bracketed(formula),
        _ => clause(formula),
    }
}

/// As [`clause`], in parentheses if it contains a comma.
fn bracketed(formula: &Formula) -> String {
    let text = clause(formula);
    if text.contains(',') && !text.starts_with('(') { format!("({text})") } else { text }
}

/// A formula about one instant.
fn state(formula: &Formula) -> String {
    match formula {
        Formula::Unary(U::Not, a) => format!("not {}", inner_state(a)),
        Formula::Binary(B::And, ..) => flat(formula, B::And).into_iter().map(inner_state).collect::<Vec<_>>().join(" and "),
        Formula::Binary(B::Or, ..) => flat(formula, B::Or).into_iter().map(inner_state).collect::<Vec<_>>().join(" or "),
        Formula::Binary(B::Xor, a, b) => format!("{} or {} but not both", inner_state(a), inner_state(b)),
        Formula::Binary(B::Implies, a, b) => format!("{} only with {}", inner_state(a), inner_state(b)),
        Formula::Binary(_, a, b) => format!("{} exactly with {}", inner_state(a), inner_state(b)),
        _ => clause(formula),
    }
}

fn inner_state(formula: &Formula) -> String {
    match formula {
        Formula::Binary(..) => format!("({})", state(formula)),
        _ => state(formula),
    }
}

/// Whether the formula speaks of the present instant only.
fn is_state(formula: &Formula) -> bool {
    match formula {
        Formula::True | Formula::False | Formula::Proposition(_) => true,
        Formula::Unary(operator, a) => *operator == U::Not && is_state(a),
        Formula::Binary(operator, a, b) => !operator.is_temporal() && is_state(a) && is_state(b),
    }
}

/// The operands of a chain of one operator, from left to right.
fn flat(formula: &Formula, operator: B) -> Vec<&Formula> {
    match formula {
        Formula::Binary(own, a, b) if *own == operator => {
            let mut parts = flat(a, operator);
            parts.extend(flat(b, operator));
            parts
        }
        _ => vec![formula],
    }
}

/// How many `X` stand in a row, and what is behind them.
fn steps(formula: &Formula, so_far: usize) -> (usize, &Formula) {
    match formula {
        Formula::Unary(U::Next, a) => steps(a, so_far + 1),
        _ => (so_far, formula),
    }
}
