//! Translation: the language on lasso words against the semantics, sizes, options, budgets.

mod translate {
    pub mod families;
    pub mod hard;
    pub mod language;
    pub mod limits;
    pub mod options;
    pub mod references;
    pub mod typing;
    pub mod words;
}
