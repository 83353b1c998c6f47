//! How good a policy is: greedy episodes, success as [Cai et al. 2021](crate::bib::Cai2021) count it, and honest intervals.

mod statistics;

pub use statistics::{Interval, clopper_pearson, interquartile_mean, mean, stratified_bootstrap};
