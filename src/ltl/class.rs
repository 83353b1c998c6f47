//! What can be read off a formula's syntax: its place in the Σ/Π hierarchy, and whether it forgets a prefix.

use super::normal_form::{Node, NodeId};

/// Syntactic properties of a formula in negation normal form.
///
/// The hierarchy: Σ₀ = Π₀ = Δ₀ are the formulas without `F G U R W M`; Σᵢ₊₁ has Πᵢ and is closed under ∧ ∨ X F U M; Πᵢ₊₁ has Σᵢ and is
/// closed under ∧ ∨ X G R W. So Σ₁ holds the syntactic co-safety and Π₁ the syntactic safety formulas. Definition of Σᵢ and Πᵢ:
/// [Esparza, Křetínský & Sickert](crate::bib::Esparza2020).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Traits {
    /// The least i with the formula in Σᵢ.
    pub sigma: u8,
    /// The least i with the formula in Πᵢ.
    pub pi: u8,
    /// Whether it is a Boolean combination of propositions.
    pub boolean: bool,
    /// Whether a word satisfies it as soon as one of its suffixes does (the formula is equivalent to `F` of itself).
    pub eventual: bool,
    /// Whether every suffix of a word that satisfies it does so too (the formula is equivalent to `G` of itself).
    pub universal: bool,
}

impl Traits {
    /// Whether the formula has no `F G U R W M`.
    pub fn is_finite(self) -> bool {
        self.sigma == 0
    }

    /// Whether it is syntactically a co-safety formula (Σ₁).
    pub fn is_co_safety(self) -> bool {
        self.sigma <= 1
    }

    /// Whether it is syntactically a safety formula (Π₁).
    pub fn is_safety(self) -> bool {
        self.pi <= 1
    }

    /// Whether a word satisfies it exactly if its suffixes do.
    pub fn is_suffix_invariant(self) -> bool {
        self.eventual && self.universal
    }

    /// The properties of a formula from those of its operands.
    ///
    /// Eventual and universal: K. Etessami, G. Holzmann: *Optimizing Büchi Automata*, CONCUR 2000, section 3.
    pub(super) fn of(node: &Node, traits: impl Fn(NodeId) -> Traits) -> Traits {
        let constant = Traits { sigma: 0, pi: 0, boolean: true, eventual: true, universal: true };
        let raise = |level: u8| level.saturating_add(1);
        let least = |operands: &[NodeId]| {
            operands.iter().map(|id| traits(*id)).fold(Traits { boolean: false, ..constant }, |all, one| Traits {
                sigma: all.sigma.max(one.sigma),
                pi: all.pi.max(one.pi),
                ..all
            })
        };
        let mu = |operands: &[NodeId]| {
            let sigma = least(operands).sigma.max(1);
            Traits { sigma, pi: raise(sigma), boolean: false, eventual: false, universal: false }
        };
        let nu = |operands: &[NodeId]| {
            let pi = least(operands).pi.max(1);
            Traits { sigma: raise(pi), pi, boolean: false, eventual: false, universal: false }
        };
        match node {
            Node::False | Node::True => constant,
            Node::Literal { .. } => Traits { eventual: false, universal: false, ..constant },
            Node::And(list) | Node::Or(list) => Traits {
                boolean: list.iter().all(|id| traits(*id).boolean),
                eventual: list.iter().all(|id| traits(*id).eventual),
                universal: list.iter().all(|id| traits(*id).universal),
                ..least(list)
            },
            Node::Next(a) => Traits { boolean: false, ..traits(*a) },
            Node::Finally(a) => Traits { eventual: true, universal: traits(*a).universal, ..mu(&[*a]) },
            Node::Globally(a) => Traits { universal: true, eventual: traits(*a).eventual, ..nu(&[*a]) },
            // For `a U b`: behind the instant of b, b holds for ever; before it, a still leads there. The other three likewise.
            Node::Until(a, b) => Traits { universal: traits(*b).universal, ..mu(&[*a, *b]) },
            Node::WeakUntil(a, b) => {
                Traits { universal: traits(*b).universal, eventual: traits(*a).eventual && traits(*b).eventual, ..nu(&[*a, *b]) }
            }
            Node::Release(a, b) => Traits { eventual: traits(*b).eventual, ..nu(&[*a, *b]) },
            Node::StrongRelease(a, b) => {
                Traits { eventual: traits(*b).eventual, universal: traits(*a).universal && traits(*b).universal, ..mu(&[*a, *b]) }
            }
        }
    }
}
