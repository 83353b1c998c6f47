//! What a shell may ask: open a task, describe it, advance training, read its numbers, roll out, evaluate, drive, save, restore.
//!
//! A [`Session`] owns one [`Trainer`](crate::train::Trainer) and nothing of the outside: no file, no clock, no screen. A shell gives
//! it texts and step counts, and reads back
//!
//! - once, a [`Description`]: the task, the formula, the automaton as a [`Graph`](crate::automaton::Graph), the scene, the [`Layout`] of frames;
//! - after each slice of work, one frame: a flat array of `f32` whose places the layout names;
//! - now and then, [`Curves`] and [`ModuleStatistics`];
//! - on demand, an [`EpisodeTrace`] (frames of a greedy episode, row by row), a [`TrialProgress`], a [`ValueMap`], a checkpoint.
//!
//! Words without an environment are read letter by letter ([`Session::read_word`]) and judged by a formula alone ([`judge_word`]).
//! Texts that a user types are judged by [`check_formula`], [`check_hoa`] and [`check_map`], translated and held against each
//! other by a [`Translator`]; every refusal is a [`Refusal`] with its place. [`map_of_picture`] makes a map of a picture's flat
//! colours.

mod activity;
mod builtin;
mod check;
mod comparison;
mod curves;
mod describe;
mod drive;
mod edges;
mod frame;
mod keep;
mod live;
mod open;
mod own_map;
mod refusal;
mod translation;
mod trial;
mod value_map;
mod word;

pub use activity::ModuleStatistics;
pub use builtin::{TaskEntry, builtin_task, builtin_tasks};
pub use check::{FormulaFacts, HoaFacts, Remark, check_formula, check_hoa};
pub use comparison::ComparisonFacts;
pub use curves::{CurveRecorder, Curves, EpisodeLosses, EpisodeOutcome};
pub use describe::{Description, EnvironmentFacts, PropositionFacts, Setting, TaskFacts};
pub use edges::EdgeIndex;
pub use frame::{Counters, FrameWriter, LAYOUT_VERSION, Layout, LayoutField, Source};
pub use live::{EpisodeTrace, Session};
pub use open::OpenRequest;
pub use own_map::{MapFacts, MapLabel, check_map, default_map, map_of_picture, picture};
pub use refusal::{Place, Refusal, Subject};
pub use translation::{ClassFacts, Doubt, TranslationFacts, TranslationOptions, Translator, Warning, translate_formula};
pub use trial::{BestPolicy, Trial, TrialProgress};
pub use value_map::{ValueAxis, ValueMap, ValueMapRequest};
pub use word::{Word, WordReading, judge_word};
