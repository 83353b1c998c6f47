//! The command line of ltl-rover.

fn main() {}
