//! The training loop, one step at a time, and the metrics folded over it.
