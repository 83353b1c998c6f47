//! `reproduce`: the tables and figures of [Cai et al. 2021](crate::bib::Cai2021) by command, with intervals over training seeds.
//!
//! An experiment is a list of cells ([`cell::Plan`]): one training run of one contender on one task with one seed each. A finished
//! cell is a small JSON file under the hash of all that decides it; [`campaign::Campaign`] runs those that are missing. A report
//! (Markdown, CSV, JSON, SVG) is made of the cells that are there, and says of the others that they are not yet run.

mod ablation;
mod campaign;
mod cell;
mod chart;
mod command;
mod contest;
mod curves;
mod learn;
mod machine;
mod map_picture;
mod method;
mod paper;
mod progress;
mod subject;
mod summary;
mod table1;
mod table2;
mod text;
mod trajectories;

pub use command::Reproduce;
