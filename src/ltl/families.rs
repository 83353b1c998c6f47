//! Families of formulas made by rules: patterns in scopes, fairness, chains, counters. For measuring and testing translations.

use super::ast::{BinaryOperator, Formula, UnaryOperator};

/// Formulas made by one rule.
#[derive(Clone, PartialEq, Debug)]
pub struct Family {
    /// What the rule is about, in a word or two.
    pub name: &'static str,
    /// Its members, small ones first.
    pub formulas: Vec<Formula>,
}

/// All families: some 140 formulas.
pub fn all() -> Vec<Family> {
    let family = |name, formulas| Family { name, formulas };
    vec![
        family("patterns in scopes", patterns()),
        family("recurrence", (1..=6).flat_map(recurrence).collect()),
        family("fairness", (1..=3).flat_map(fairness).collect()),
        family("pairs", (1..=3).flat_map(pairs).collect()),
        family("chains", (2..=5).flat_map(chains).collect()),
        family("visits in order", (1..=5).flat_map(visits).collect()),
        family("delays", (1..=4).flat_map(delays).collect()),
        family("nested promises", nested()),
        family("many limits", [4, 8, 16].into_iter().flat_map(limits).collect()),
    ]
}

fn p(name: &str) -> Formula {
    Formula::proposition(name)
}

fn numbered(name: &str, i: usize) -> Formula {
    Formula::proposition(format!("{name}{i}"))
}

fn globally(a: Formula) -> Formula {
    Formula::unary(UnaryOperator::Globally, a)
}

fn finally(a: Formula) -> Formula {
    Formula::unary(UnaryOperator::Finally, a)
}

fn next(a: Formula, times: usize) -> Formula {
    (0..times).fold(a, |a, _| Formula::unary(UnaryOperator::Next, a))
}

fn not(a: Formula) -> Formula {
    Formula::unary(UnaryOperator::Not, a)
}

fn and(a: Formula, b: Formula) -> Formula {
    Formula::binary(BinaryOperator::And, a, b)
}

fn or(a: Formula, b: Formula) -> Formula {
    Formula::binary(BinaryOperator::Or, a, b)
}

fn implies(a: Formula, b: Formula) -> Formula {
    Formula::binary(BinaryOperator::Implies, a, b)
}

fn until(a: Formula, b: Formula) -> Formula {
    Formula::binary(BinaryOperator::Until, a, b)
}

fn weak_until(a: Formula, b: Formula) -> Formula {
    Formula::binary(BinaryOperator::WeakUntil, a, b)
}

fn release(a: Formula, b: Formula) -> Formula {
    Formula::binary(BinaryOperator::Release, a, b)
}

fn all_of(list: impl Iterator<Item = Formula>) -> Formula {
    list.reduce(and).unwrap_or(Formula::True)
}

/// Absence, existence, universality, precedence and response, each everywhere, before an event, after one, and between two.
///
/// The pattern catalogue: M. Dwyer, G. Avrunin, J. Corbett: *Patterns in Property Specifications for Finite-State Verification*, ICSE 1999. A
/// property holds within a segment if it holds of the word until the segment's end: `F`, `G` and `U` are cut off there.
fn patterns() -> Vec<Formula> {
    let (start, end) = (p("begin"), p("end"));
    let mut formulas = vec![];
    // Each property over a segment that ends with `stop`, which comes for certain.
    let properties: [fn(&Formula) -> Formula; 5] = [
        |stop| until(not(p("bad")), stop.clone()),
        |stop| until(not(stop.clone()), and(p("good"), not(stop.clone()))),
        |stop| until(p("good"), stop.clone()),
        |stop| until(not(p("answer")), or(p("call"), stop.clone())),
        |stop| until(implies(p("call"), until(not(stop.clone()), and(p("answer"), not(stop.clone())))), stop.clone()),
    ];
    let everywhere: [Formula; 5] = [
        globally(not(p("bad"))),
        finally(p("good")),
        globally(p("good")),
        weak_until(not(p("answer")), p("call")),
        globally(implies(p("call"), finally(p("answer")))),
    ];
    for (property, global) in properties.iter().zip(&everywhere) {
        formulas.push(global.clone());
        formulas.push(implies(finally(end.clone()), property(&end)));
        formulas.push(globally(implies(start.clone(), global.clone())));
        let segment = and(and(start.clone(), not(end.clone())), finally(end.clone()));
        formulas.push(globally(implies(segment, property(&end))));
    }
    formulas
}

/// Several things again and again, at least one of several, and with a hazard that never is.
fn recurrence(n: usize) -> Vec<Formula> {
    let each = |i| globally(finally(numbered("a", i)));
    let every = all_of((1..=n).map(each));
    let any = (1..=n).map(|i| finally(globally(numbered("a", i)))).reduce(or).expect("n ≥ 1");
    vec![every.clone(), any, and(every, globally(not(p("unsafe"))))]
}

/// If several things recur, so do several others.
fn fairness(n: usize) -> Vec<Formula> {
    let each = |name: &'static str| all_of((1..=n).map(|i| globally(finally(numbered(name, i)))));
    let request = |i| globally(implies(numbered("call", i), finally(numbered("answer", i))));
    vec![implies(each("a"), each("b")), implies(each("a"), all_of((1..=n).map(request)))]
}

/// Of each pair, one recurs or the other persists; and the other way round.
fn pairs(n: usize) -> Vec<Formula> {
    let recurs = |i| globally(finally(numbered("a", i)));
    let persists = |i| finally(globally(numbered("b", i)));
    let streett = all_of((1..=n).map(|i| or(recurs(i), persists(i))));
    let rabin = (1..=n).map(|i| and(recurs(i), persists(i))).reduce(or).expect("n ≥ 1");
    vec![streett, rabin]
}

/// One of many things persists; the same unless something happens once; one recurs if all of many others do.
fn limits(n: usize) -> Vec<Formula> {
    let persists = |i| finally(globally(not(numbered("v", i))));
    let any = (1..=n).map(persists).reduce(or).expect("n ≥ 1");
    let all = all_of((1..=n).map(|i| globally(finally(numbered("a", i)))));
    vec![any.clone(), or(any, finally(p("unsafe"))), implies(all, globally(finally(p("b"))))]
}

/// Nested U and R, to the left and to the right.
fn chains(n: usize) -> Vec<Formula> {
    let names = || (1..=n).map(|i| numbered("a", i));
    let right = |operator: fn(Formula, Formula) -> Formula| names().rev().reduce(|inner, a| operator(a, inner)).expect("n ≥ 2");
    vec![
        names().reduce(until).expect("n ≥ 2"),
        right(until),
        names().reduce(release).expect("n ≥ 2"),
        right(release),
        names().reduce(weak_until).expect("n ≥ 2"),
        globally(right(until)),
    ]
}

/// Places one after the other, once or again and again, in this order only, and then for ever in the last one.
fn visits(n: usize) -> Vec<Formula> {
    let in_turn = (1..=n).rev().map(|i| numbered("v", i)).reduce(|later, v| and(v, finally(later))).expect("n ≥ 1");
    let ordered = all_of((1..n).map(|i| until(not(numbered("v", i + 1)), numbered("v", i))));
    let stay = (1..=n).rev().map(|i| numbered("v", i)).fold(globally(p("home")), |later, v| finally(and(v, later)));
    vec![finally(in_turn.clone()), globally(finally(in_turn)), and(ordered, finally(numbered("v", n))), stay]
}

/// Something follows after exactly or within n instants.
fn delays(n: usize) -> Vec<Formula> {
    let within = (1..=n).map(|i| next(p("b"), i)).reduce(or).expect("n ≥ 1");
    vec![
        globally(implies(p("a"), next(p("b"), n))),
        globally(implies(p("a"), within.clone())),
        globally(finally(and(p("a"), next(p("b"), n)))),
        finally(globally(implies(p("a"), within))),
        finally(and(p("a"), next(globally(p("b")), n))),
    ]
}

/// Formulas of high alternation.
fn nested() -> Vec<Formula> {
    let (a, b, c) = (|| p("a"), || p("b"), || p("c"));
    vec![
        finally(globally(or(a(), finally(b())))),
        globally(or(a(), finally(globally(b())))),
        until(globally(finally(a())), b()),
        until(globally(finally(a())), globally(b())),
        globally(until(a(), globally(b()))),
        finally(and(a(), globally(or(b(), finally(globally(c())))))),
        and(a(), next(or(finally(globally(b())), finally(globally(c()))), 1)),
        globally(implies(a(), until(b(), or(globally(c()), globally(a()))))),
        release(finally(a()), until(b(), globally(c()))),
        globally(implies(finally(globally(a())), globally(finally(b())))),
        until(globally(finally(a())), globally(until(globally(finally(b())), c()))),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn families_are_formulas_that_differ() {
        let formulas: Vec<String> = all().into_iter().flat_map(|family| family.formulas).map(|f| f.to_string()).collect();
        let mut once = formulas.clone();
        once.sort();
        once.dedup();
        assert!(formulas.len() > 100 && once.len() + 10 > formulas.len(), "{} of {}", once.len(), formulas.len());
        assert!(formulas.iter().all(|text| Formula::parse(text).unwrap().to_string() == *text));
    }
}
