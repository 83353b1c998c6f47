//! A non-deterministic Büchi automaton for a formula, by the tableau of obligations: a state is a set of formulas that must hold from
//! now on; an until may be put off, but not for ever. Slow and plain.

use ltl_rover::labels::Labels;
use ltl_rover::ltl::{BinaryOperator, Formula, UnaryOperator};
use std::collections::{BTreeSet, HashMap};

/// A Büchi automaton over the letters of two propositions; acceptance on edges.
pub struct Buchi {
    pub initial: usize,
    /// Per state and letter: targets, and whether the edge is accepting.
    pub edges: Vec<[Vec<(usize, bool)>; 4]>,
}

/// A formula without negations but at propositions, and without other operators than these.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
enum Plain {
    True,
    False,
    Literal(usize, bool),
    And(Box<Plain>, Box<Plain>),
    Or(Box<Plain>, Box<Plain>),
    Next(Box<Plain>),
    Until(Box<Plain>, Box<Plain>),
    Release(Box<Plain>, Box<Plain>),
}

use Plain::*;

fn plain_constant(value: bool) -> Plain {
    if value { True } else { False }
}

fn plain(formula: &Formula, positive: bool) -> Plain {
    let pair = |l: &Formula, lp: bool, r: &Formula, rp: bool| (Box::new(plain(l, lp)), Box::new(plain(r, rp)));
    let join = |and: bool, (l, r): (Box<Plain>, Box<Plain>)| if and == positive { And(l, r) } else { Or(l, r) };
    let until = |until: bool, (l, r): (Box<Plain>, Box<Plain>)| if until == positive { Until(l, r) } else { Release(l, r) };
    match formula {
        Formula::True => plain_constant(positive),
        Formula::False => plain_constant(!positive),
        Formula::Proposition(name) => Literal(usize::from(&**name == "b"), positive),
        Formula::Unary(operator, inner) => match operator {
            UnaryOperator::Not => plain(inner, !positive),
            UnaryOperator::Next => Next(Box::new(plain(inner, positive))),
            UnaryOperator::Finally => until(true, (Box::new(plain_constant(positive)), Box::new(plain(inner, positive)))),
            UnaryOperator::Globally => until(false, (Box::new(plain_constant(!positive)), Box::new(plain(inner, positive)))),
        },
        Formula::Binary(operator, l, r) => match operator {
            BinaryOperator::And => join(true, pair(l, positive, r, positive)),
            BinaryOperator::Or => join(false, pair(l, positive, r, positive)),
            BinaryOperator::Implies => join(false, pair(l, !positive, r, positive)),
            BinaryOperator::Until => until(true, pair(l, positive, r, positive)),
            BinaryOperator::Release => until(false, pair(l, positive, r, positive)),
            // l W r = r R (l | r), l M r = r U (l & r)
            BinaryOperator::WeakUntil => {
                let both = Box::new(join(false, pair(l, positive, r, positive)));
                until(false, (Box::new(plain(r, positive)), both))
            }
            BinaryOperator::StrongRelease => {
                let both = Box::new(join(true, pair(l, positive, r, positive)));
                until(true, (Box::new(plain(r, positive)), both))
            }
            BinaryOperator::Iff | BinaryOperator::Xor => {
                let same = (*operator == BinaryOperator::Iff) == positive;
                let both = And(Box::new(plain(l, true)), Box::new(plain(r, same)));
                Or(Box::new(both), Box::new(And(Box::new(plain(l, false)), Box::new(plain(r, !same)))))
            }
        },
    }
}

type Obligations = BTreeSet<Plain>;

/// One way to meet obligations with a letter: what is left for the rest of the word, and the untils that were put off.
type Way = (Obligations, BTreeSet<Plain>);

/// All ways to meet `open` by reading `letter`.
fn ways(mut open: Vec<Plain>, letter: Labels, way: Way, found: &mut BTreeSet<Way>) {
    let Some(next) = open.pop() else {
        found.insert(way);
        return;
    };
    let mut branch = |more: &[&Plain], later: Option<&Plain>, put_off: bool| {
        let (mut open, mut way) = (open.clone(), way.clone());
        open.extend(more.iter().map(|p| (*p).clone()));
        way.0.extend(later.cloned());
        if put_off {
            way.1.extend(later.cloned());
        }
        ways(open, letter, way, found);
    };
    match &next {
        True => branch(&[], None, false),
        False => {}
        Literal(index, value) if letter.holds(*index) == *value => branch(&[], None, false),
        Literal(..) => {}
        And(l, r) => branch(&[l, r], None, false),
        Or(l, r) => {
            branch(&[l], None, false);
            branch(&[r], None, false);
        }
        Next(inner) => branch(&[], Some(inner), false),
        Until(l, r) => {
            branch(&[r], None, false);
            branch(&[l], Some(&next), true);
        }
        Release(l, r) => {
            branch(&[l, r], None, false);
            branch(&[r], Some(&next), false);
        }
    }
}

fn untils(formula: &Plain, found: &mut BTreeSet<Plain>) {
    if let Until(..) = formula {
        found.insert(formula.clone());
    }
    match formula {
        And(l, r) | Or(l, r) | Until(l, r) | Release(l, r) => {
            untils(l, found);
            untils(r, found);
        }
        Next(inner) => untils(inner, found),
        True | False | Literal(..) => {}
    }
}

/// The automaton; `None` if it has more than 60 states.
pub fn automaton(formula: &Formula) -> Option<Buchi> {
    let root = plain(formula, true);
    let mut all = BTreeSet::new();
    untils(&root, &mut all);
    let all: Vec<Plain> = all.into_iter().collect();
    // A state: obligations, and the until that must be seen not to be put off next.
    let mut states = vec![(Obligations::from([root]), 0)];
    let mut index: HashMap<(Obligations, usize), usize> = HashMap::from([(states[0].clone(), 0)]);
    let mut edges = Vec::new();
    while edges.len() < states.len() {
        let (obligations, turn) = states[edges.len()].clone();
        let row: [Vec<(usize, bool)>; 4] = std::array::from_fn(|letter| {
            let mut found = BTreeSet::new();
            ways(obligations.iter().cloned().collect(), Labels(letter as u64), Way::default(), &mut found);
            let minimal = found.iter().filter(|w| !found.iter().any(|v| v != *w && v.0.is_subset(&w.0) && v.1.is_subset(&w.1)));
            let target = |way: &Way| {
                let mut next = turn;
                while next < all.len() && !way.1.contains(&all[next]) {
                    next += 1;
                }
                let accepting = next == all.len();
                let state = (way.0.clone(), if accepting { 0 } else { next });
                let number = *index.entry(state.clone()).or_insert_with(|| {
                    states.push(state);
                    states.len() - 1
                });
                (number, accepting)
            };
            minimal.map(target).collect()
        });
        edges.push(row);
        if states.len() > 60 {
            return None;
        }
    }
    Some(Buchi { initial: 0, edges })
}
