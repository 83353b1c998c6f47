//! The logs of a run: CSV and JSON lines, under the names that Stable-Baselines3 uses.

use super::failure::Failure;
use crate::eval::Evaluation;
use crate::train::EpisodeSummary;
use std::fs::{File, OpenOptions};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// The open log files of a run.
pub struct Logs {
    folder: PathBuf,
    episodes: csv::Writer<File>,
    evaluations: csv::Writer<File>,
    progress: csv::Writer<File>,
    lines: BufWriter<File>,
    headed: bool,
}

impl Logs {
    /// Creates the logs in `folder`, or opens them to go on with `append`.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn open(folder: &Path, append: bool) -> Result<Logs, Failure> {
        std::fs::create_dir_all(folder).map_err(|e| Failure::file(folder, e))?;
        let file = |name: &str| {
            let path = folder.join(name);
            let opened = if append { OpenOptions::new().append(true).create(true).open(&path) } else { File::create(&path) };
            opened.map_err(|e| Failure::file(&path, e))
        };
        let table = |name: &str| -> Result<csv::Writer<File>, Failure> {
            let file = file(name)?;
            let empty = file.metadata().map_or(true, |m| m.len() == 0);
            Ok(csv::WriterBuilder::new().has_headers(empty).from_writer(file))
        };
        let progress = file("progress.csv")?;
        let headed = progress.metadata().is_ok_and(|m| m.len() > 0);
        Ok(Logs {
            folder: folder.to_owned(),
            episodes: table("episodes.csv")?,
            evaluations: table("evaluations.csv")?,
            progress: csv::WriterBuilder::new().has_headers(false).from_writer(progress),
            lines: BufWriter::new(file("progress.jsonl")?),
            headed,
        })
    }

    fn wrote<T, E: std::fmt::Display>(&self, result: Result<T, E>) -> Result<T, Failure> {
        result.map_err(|e| Failure::running(format!("{}: {e}", self.folder.display())))
    }

    /// A finished episode.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn episode(&mut self, episode: &EpisodeSummary) -> Result<(), Failure> {
        let done = self.episodes.serialize(episode);
        self.wrote(done)
    }

    /// An evaluation after `step` environment steps.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn evaluation(&mut self, step: u64, e: &Evaluation) -> Result<(), Failure> {
        #[derive(serde::Serialize)]
        struct Row {
            step: u64,
            runs: u32,
            successes: u32,
            success_rate: f64,
            ci95_low: f64,
            ci95_high: f64,
            rounds_mean: f64,
            sink_rate: f64,
            first_round_steps_mean: Option<f64>,
            seed: u64,
        }
        let done = self.evaluations.serialize(Row {
            step,
            runs: e.runs,
            successes: e.successes,
            success_rate: e.success_rate,
            ci95_low: e.ci95.low,
            ci95_high: e.ci95.high,
            rounds_mean: e.rounds_mean,
            sink_rate: e.sink_rate,
            first_round_steps_mean: e.first_round_steps_mean,
            seed: e.seed,
        });
        self.wrote(done)
    }

    /// A row of means; `rate` is in environment steps per second, `elapsed` in seconds.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn progress(&mut self, mut row: Vec<(String, Option<f64>)>, rate: f64, elapsed: f64) -> Result<(), Failure> {
        row.push(("time/fps".to_owned(), Some(rate)));
        row.push(("time/time_elapsed".to_owned(), Some(elapsed)));
        if !self.headed {
            self.headed = true;
            let done = self.progress.write_record(row.iter().map(|(name, _)| name));
            self.wrote(done)?;
        }
        let done = self.progress.write_record(row.iter().map(|(_, v)| v.map(|v| v.to_string()).unwrap_or_default()));
        self.wrote(done)?;
        let object: serde_json::Map<String, serde_json::Value> = row.into_iter().map(|(k, v)| (k, v.into())).collect();
        let done = writeln!(self.lines, "{}", serde_json::Value::Object(object));
        self.wrote(done)?;
        self.flush()
    }

    /// Puts everything on disk.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn flush(&mut self) -> Result<(), Failure> {
        let all = [self.episodes.flush(), self.evaluations.flush(), self.progress.flush(), self.lines.flush()];
        all.into_iter().try_for_each(|done| self.wrote(done))
    }
}
