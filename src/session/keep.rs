//! A session as the bytes of a checkpoint, and back: training goes on bit by bit, with its curves and counts.

use super::activity::Activity;
use super::builtin;
use super::curves::{CurveRecorder, EpisodeLosses};
use super::live::Session;
use super::open::{OpenRequest, written};
use super::refusal::{Refusal, Subject};
use crate::agent::Replays;
use crate::task::{Setup, TaskError};
use crate::train::{Checkpoint, CheckpointError};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// The note of a checkpoint that holds the learning curves.
const CURVES: &str = "curves";
/// The note that holds what else a session counts.
const COUNTED: &str = "counted";
/// The note that holds the request by which the session was opened.
const REQUEST: &str = "request";

/// What a session counts beside the curves.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Counted {
    activity: Vec<Activity>,
    total: f64,
    losses: EpisodeLosses,
}

impl Session {
    /// A checkpoint: the bytes of a file from which [`Session::restore`] opens this session again. With [`Replays::Keep`] training
    /// goes on from it bit by bit; without, it is small, and training first fills the replays anew. A periodic evaluation that is
    /// going on is played to its end.
    pub fn save(&mut self, replays: Replays) -> Vec<u8> {
        while self.check.is_some() {
            self.advance_check();
        }
        let mut origin = self.setup.origin();
        let counted = Counted { activity: self.activity.clone(), total: self.total, losses: self.losses.clone() };
        // The map and the seed stand in the checkpoint already: here it only matters whether there is a map of one's own.
        let map = self.request.map.as_ref().map(|_| String::new());
        let request = OpenRequest { map, seed: 0, ..self.request.clone() };
        let written = "curves, counts and requests are made of tables, numbers and texts";
        origin.notes.insert(CURVES.to_owned(), toml::to_string(&self.curves).expect(written));
        origin.notes.insert(COUNTED.to_owned(), toml::to_string(&counted).expect(written));
        origin.notes.insert(REQUEST.to_owned(), toml::to_string(&request).expect(written));
        self.run.save(&origin, replays)
    }

    /// The best policy alone (of this moment, if no evaluation has seen one): a small file that can be shown, not trained on.
    pub fn save_policy(&self) -> Vec<u8> {
        self.run.save_policy(&self.setup.origin())
    }

    /// Opens a checkpoint or a policy file.
    ///
    /// # Errors
    /// Bytes that are none, or whose parts do not fit together.
    pub fn restore(bytes: &[u8]) -> Result<Session, Refusal> {
        let refusal = |e: CheckpointError| Refusal::new(Subject::Checkpoint, e.to_string());
        let checkpoint = Checkpoint::read(bytes).map_err(refusal)?;
        let inside = |e: TaskError| Refusal::new(Subject::Checkpoint, e.to_string());
        let setup = Setup::from_checkpoint(&checkpoint).map_err(inside)?;
        let run = setup.resume(&checkpoint).map_err(refusal)?;
        let hoa = setup.hoa().map(str::to_owned).unwrap_or_else(|| written(setup.automaton()));
        let origin = &checkpoint.origin;
        let critics = checkpoint.has_critics();
        let mut session = Session::around(request_of(&checkpoint)?, setup, origin.task_name.clone(), hoa, run);
        session.critics = critics;
        if let Some(curves) = origin.notes.get(CURVES) {
            session.curves = CurveRecorder::read(curves).map_err(|e| Refusal::new(Subject::Checkpoint, e))?;
        }
        if let Some(counted) = origin.notes.get(COUNTED) {
            let counted: Counted = note(counted)?;
            if counted.activity.len() != session.activity.len() {
                let message = "it counts other modules than its learner has";
                return Err(Refusal::new(Subject::Checkpoint, message));
            }
            Counted { activity: session.activity, total: session.total, losses: session.losses } = counted;
        }
        Ok(session)
    }
}

/// What a note of a checkpoint says.
fn note<T: DeserializeOwned>(text: &str) -> Result<T, Refusal> {
    toml::from_str(text).map_err(|e| Refusal::new(Subject::Checkpoint, format!("one of its notes is malformed: {}", e.message())))
}

/// The request that opens a checkpoint's task anew: as it was made, or, in a checkpoint of another shell, the parts in it.
fn request_of(checkpoint: &Checkpoint) -> Result<OpenRequest, Refusal> {
    let origin = &checkpoint.origin;
    let (request, own_map): (OpenRequest, bool) = match origin.notes.get(REQUEST) {
        Some(text) => {
            let request: OpenRequest = note(text)?;
            let own_map = request.map.is_some();
            (request, own_map)
        }
        None => {
            let builtin = builtin::with_text(&origin.task);
            let task = builtin.map_or(origin.task.as_str(), |b| b.name).to_owned();
            let hoa = origin.hoa.clone().filter(|hoa| builtin.is_none_or(|b| b.hoa != hoa));
            (OpenRequest { task, hoa, ..OpenRequest::default() }, builtin.is_none())
        }
    };
    let map = origin.map.clone().filter(|_| own_map);
    Ok(OpenRequest { seed: checkpoint.seed, preset: Some(origin.preset.clone()), map, ..request })
}
