//! Exact solvers on finite Markov decision processes: the reference for everything that is learned or claimed.
//!
//! An [`Mdp`] is written out state by state. [`Product`] joins it with an automaton, [`maximal_end_components`] and
//! [`maximal_reachability`] work on the resulting [`Arena`], and [`maximal_probability`] puts them together: the most that any
//! policy can reach, between bounds.

mod arena;
mod end_components;
mod mdp;
mod product;
mod reachability;

pub use arena::{Arena, Transition};
pub use end_components::{EndComponent, maximal_end_components};
pub use mdp::{Distribution, Mdp, MdpError};
pub use product::{Product, UnknownProposition, maximal_probability};
pub use reachability::{Interval, maximal_reachability};
