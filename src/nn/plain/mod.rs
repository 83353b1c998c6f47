//! The networks and their update as the papers print them, in double precision and without haste: every fast implementation is
//! tested against this one, and this one against finite differences.

mod adam;
mod learner;
mod network;

pub use learner::Plain;
