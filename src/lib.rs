//! Tasks in linear temporal logic, learned by modular deep reinforcement learning ([Cai et al. 2021](bib::Cai2021)).
//!
//! The floors, from the ground up; a module imports only from floors below its own (`tests/architecture.rs` holds the table):
//! letters, random numbers and papers; [`ltl`], [`env`](mod@env) and [`nn`], which do not know one another; [`automaton`]; [`product`];
//! [`agent`]; [`train`] and [`eval`]; the task file; the session; and at the top the two shells, command line and browser.
//! Data flows one way: task → EP-MDP, reward and learner → trainer → tick → metrics → session → shell.

#![warn(missing_docs)]
#![deny(unsafe_code)]

pub mod agent;
pub mod automaton;
pub mod bdd;
pub mod bib;
#[cfg(feature = "cli")]
pub mod cli;
pub mod env;
pub mod eval;
pub mod finite;
pub mod labels;
pub mod ltl;
pub mod nn;
pub mod product;
pub mod rng;
pub mod session;
pub mod task;
pub mod train;
#[cfg(feature = "wasm")]
pub mod wasm;
