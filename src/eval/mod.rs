//! How good a policy is: greedy episodes, success as [Cai et al. 2021](crate::bib::Cai2021) count it, and honest intervals.

mod evaluation;
mod rollout;
mod statistics;

pub use evaluation::{Evaluation, episodes, episodes_seen, evaluate};
pub use rollout::{Episode, Rollout, RolloutSettings};
pub use statistics::{Interval, clopper_pearson, interquartile_mean, mean, stratified_bootstrap};
