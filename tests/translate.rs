//! Translation: the language on lasso words against the semantics, sizes, options, budgets.

mod translate {
    pub mod language;
    pub mod options;
    pub mod references;
    pub mod typing;
    pub mod words;
}
