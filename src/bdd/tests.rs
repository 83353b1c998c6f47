//! Decision diagrams against truth tables.

use super::*;
use proptest::prelude::*;

/// A function of four variables as its table of 16 values, and the same as a diagram.
fn diagram(manager: &mut Manager, table: u16) -> Bdd {
    let mut f = Bdd::FALSE;
    for row in (0..16u32).filter(|row| table >> row & 1 == 1) {
        let mut term = Bdd::TRUE;
        for v in 0..4 {
            let literal = manager.literal(v, row >> v & 1 == 1).unwrap();
            term = manager.and(term, literal).unwrap();
        }
        f = manager.or(f, term).unwrap();
    }
    f
}

fn table(manager: &Manager, f: Bdd) -> u16 {
    (0..16u16).fold(0, |all, row| all | u16::from(manager.evaluate(f, |v| row >> v & 1 == 1)) << row)
}

proptest! {
    #[test]
    fn operations_are_those_of_truth_tables(a: u16, b: u16, c: u16) {
        let manager = &mut Manager::new(10_000);
        let [f, g, h] = [a, b, c].map(|t| diagram(manager, t));
        prop_assert_eq!(table(manager, f), a);
        let and = manager.and(f, g).unwrap();
        let or = manager.or(f, g).unwrap();
        let not = manager.not(f).unwrap();
        let ite = manager.if_then_else(f, g, h).unwrap();
        prop_assert_eq!([and, or, not, ite].map(|x| table(manager, x)), [a & b, a | b, !a, a & b | !a & c]);
        prop_assert_eq!(manager.implies(f, g).unwrap(), a & !b == 0);
        prop_assert_eq!(f == g, a == b, "equal functions are equal indices");
        let mut exchange = Substitution::default();
        exchange.set(1, g);
        let composed = manager.substitute(f, &mut exchange).unwrap();
        let expected = (0..16u16).fold(0, |all, row| {
            let moved = row & !2 | (b >> row & 1) << 1;
            all | (a >> moved & 1) << row
        });
        prop_assert_eq!(table(manager, composed), expected);
        prop_assert_eq!(manager.replace(f, &[(1, g)]).unwrap(), composed);
        for &v in manager.support(f).iter() {
            prop_assert!((0..16u16).any(|row| a >> row & 1 != a >> (row ^ 1 << v) & 1));
        }
    }
}

#[test]
fn the_limit_is_kept() {
    let manager = &mut Manager::new(20);
    let mut parity = Bdd::FALSE;
    let error = (0..100).find_map(|v| {
        let x = manager.variable(v).and_then(|x| {
            let not = manager.not(parity)?;
            manager.if_then_else(x, not, parity)
        });
        x.map(|x| parity = x).err()
    });
    assert_eq!(error, Some(Exhausted::Nodes { limit: 20 }));
    assert!(manager.len() <= 20);
}
