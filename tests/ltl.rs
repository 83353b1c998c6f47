//! The formula language: the corpus, round trips, semantics against laws and an independent definition, fuzzing.

mod ltl {
    pub mod corpus;
    pub mod fuzz;
    pub mod laws;
    pub mod random;
}
