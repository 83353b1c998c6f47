//! The maximal probability to reach a goal, between bounds: interval iteration on the quotient by end components
//! ([Haddad & Monmege 2018](crate::bib::HaddadMonmege2018)).

use super::arena::Arena;
use super::end_components::maximal_end_components;

/// A number known up to an interval.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Interval {
    /// It is at least this.
    pub low: f64,
    /// It is at most this.
    pub high: f64,
}

impl Interval {
    /// The middle.
    pub fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }
}

/// Where a choice of the quotient leads: class, probability.
type Row = Vec<(usize, f64)>;

/// Per state, the maximal probability (over all policies) to reach a goal, up to `precision` (at least 1e-12).
///
/// Value iteration from below alone may stop far from the fixed point. From above as well, both bounds meet once every end
/// component is one state that must be left: then no policy can avoid a decision for ever.
pub fn maximal_reachability(arena: &Arena, goal: &[bool], precision: f64) -> Vec<Interval> {
    let (class, rows) = quotient(arena, goal);
    let classes = rows.len();
    let (mut low, mut high) = (vec![0.0; classes], vec![1.0; classes]);
    // Class 0 is the goal, class 1 is everything from which it cannot be reached.
    (low[0], high[1]) = (1.0, 0.0);
    let best = |values: &[f64], list: &[Row]| {
        list.iter().map(|row| row.iter().map(|(to, p)| p * values[*to]).sum::<f64>()).fold(0.0, f64::max)
    };
    let mut moves = true;
    // Where rounding stops both bounds before they meet, the interval stays as wide as it is.
    while moves && low.iter().zip(&high).any(|(l, h)| h - l > precision.max(1e-12)) {
        moves = false;
        for c in 2..classes {
            // Rounding must not move a bound the wrong way.
            let (l, h) = (best(&low, &rows[c]).clamp(low[c], 1.0), best(&high, &rows[c]));
            let h = h.clamp(l, high[c].max(l));
            moves |= l != low[c] || h != high[c];
            (low[c], high[c]) = (l, h);
        }
    }
    class.into_iter().map(|c| Interval { low: low[c], high: high[c] }).collect()
}

/// The class of every state, and per class its choices that leave it. Classes: 0 = goal, 1 = hopeless, then one per end component
/// without goals, then one per state that is left.
fn quotient(arena: &Arena, goal: &[bool]) -> (Vec<usize>, Vec<Vec<Row>>) {
    let hopeful = arena.can_reach(goal);
    let mut class = vec![usize::MAX; arena.len()];
    for s in 0..arena.len() {
        if goal[s] {
            class[s] = 0;
        } else if !hopeful[s] {
            class[s] = 1;
        }
    }
    let free = class.clone();
    let inside = |s: usize| free[s] == usize::MAX;
    let mut classes = 2;
    for component in maximal_end_components(arena, &|s, transitions| inside(s) && transitions.iter().all(|t| inside(t.target))) {
        for s in component.states {
            class[s] = classes;
        }
        classes += 1;
    }
    for slot in class.iter_mut().filter(|c| **c == usize::MAX) {
        *slot = classes;
        classes += 1;
    }
    let mut rows: Vec<Vec<Row>> = vec![Vec::new(); classes];
    for (s, choices) in arena.choices.iter().enumerate().filter(|(s, _)| class[*s] > 1) {
        for transitions in choices {
            if transitions.iter().any(|t| class[t.target] != class[s]) {
                let staying: f64 = transitions.iter().filter(|t| class[t.target] == class[s]).map(|t| t.probability).sum();
                // Coming back and choosing again: the rest, scaled up.
                let leaving = transitions.iter().filter(|t| class[t.target] != class[s]);
                rows[class[s]].push(leaving.map(|t| (class[t.target], t.probability / (1.0 - staying))).collect());
            }
        }
    }
    (class, rows)
}
