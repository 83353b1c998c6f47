//! Task files, runs and checkpoints on disk.

use super::failure::Failure;
use crate::agent::ModularDdpg;
use crate::env::map::{MapError, RoverMap};
use crate::task::{Override, Setup, Task, TaskError};
use crate::train::Checkpoint;
use std::fs;
use std::path::{Path, PathBuf};

/// The checkpoint's name in a run's folder.
pub const CHECKPOINT: &str = "checkpoint.safetensors";
/// The name of the best policy alone in a run's folder.
pub const POLICY: &str = "policy.safetensors";

impl From<TaskError> for Failure {
    fn from(error: TaskError) -> Failure {
        let help = error.help().map(str::to_owned);
        match (error.span(), help) {
            (Some(span), help) => Failure::located(error.file(), error.text(), span, error.message(), help),
            (None, Some(help)) => Failure::input(format!("{}: {}", error.file(), error.message())).help(help),
            (None, None) => Failure::input(format!("{}: {}", error.file(), error.message())),
        }
    }
}

/// The text of a file.
///
/// # Errors
/// If it cannot be read or is not UTF-8.
pub fn text(path: &Path) -> Result<String, Failure> {
    fs::read_to_string(path).map_err(|e| Failure::file(path, e))
}

/// Writes a file, and its folder before it.
///
/// # Errors
/// If it cannot be written.
pub fn write(path: &Path, bytes: impl AsRef<[u8]>) -> Result<(), Failure> {
    if let Some(folder) = path.parent().filter(|f| !f.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(|e| Failure::file(folder, e))?;
    }
    // Through a second file, so that an interruption leaves the old one whole.
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let partial = PathBuf::from(partial);
    fs::write(&partial, bytes).map_err(|e| Failure::file(&partial, e))?;
    fs::rename(&partial, path).map_err(|e| Failure::file(path, e))
}

/// The rover map in a file: a flat PNG, or a map file with the picture that it names for labels.
///
/// # Errors
/// A file that cannot be read; what is wrong with the map, at its place.
pub fn map(path: &Path) -> Result<RoverMap, Failure> {
    let bytes = |path: &Path| fs::read(path).map_err(|e| Failure::file(path, e));
    let refuse = |e: MapError| Failure::file(path, e);
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png")) {
        let name = path.file_stem().unwrap_or_default().to_string_lossy();
        return RoverMap::from_png(&name, &bytes(path)?).map_err(refuse);
    }
    let text = text(path)?;
    let image = RoverMap::image_file(&text).map_err(refuse)?;
    let image = image.map(|file| bytes(&beside(path, &file))).transpose()?;
    RoverMap::from_json(&text, image.as_deref()).map_err(refuse)
}

/// `file`, relative to the folder of `path`.
fn beside(path: &Path, file: &str) -> PathBuf {
    path.parent().unwrap_or(Path::new("")).join(file)
}

/// Opens the task at `path`, with the automaton and the map beside it if it names them.
///
/// # Errors
/// A file that cannot be read; what is wrong with the task, its automaton or its map, at its place.
pub fn open(path: &Path, preset: &str, overrides: &[Override]) -> Result<Setup, Failure> {
    let mut task = Task::parse(&text(path)?, &path.to_string_lossy())?;
    if let Some(file) = task.map_file().map(|file| beside(path, file)) {
        task = task.with_map(map(&file)?);
    }
    let hoa = task.file().specification.hoa.as_ref().map(|file| text(&beside(path, file))).transpose()?;
    Ok(Setup::open(task, preset, overrides, hoa.as_deref())?)
}

/// Reads a checkpoint or policy file, or the checkpoint in a run's folder.
///
/// # Errors
/// A file that cannot be read or is no checkpoint.
pub fn checkpoint(run: &Path) -> Result<Checkpoint, Failure> {
    let file = if run.is_dir() { run.join(CHECKPOINT) } else { run.to_owned() };
    let bytes = fs::read(&file).map_err(|e| Failure::file(&file, e))?;
    Checkpoint::read(&bytes).map_err(|e| Failure::file(&file, e))
}

/// The set-up of a run or policy file, and a learner with its best policy.
///
/// # Errors
/// A file that cannot be read, is no checkpoint, or whose parts do not fit together.
pub fn policy(run: &Path) -> Result<(Setup, ModularDdpg), Failure> {
    let checkpoint = checkpoint(run)?;
    let setup = Setup::from_checkpoint(&checkpoint)?;
    let mut learner = setup.learner(checkpoint.seed);
    let policy = checkpoint.policy(learner.modules().len());
    learner.load_policy(&policy).map_err(|e| Failure::file(run, e))?;
    Ok((setup, learner))
}
