//! The same networks on burn: its layers, its autodiff, its Adam, on a backend chosen at run time. It shares no arithmetic with
//! the other implementations, and its records are theirs.

mod learner;
mod network;

pub use learner::{Backend, Reference};
