//! The user's own rover map: what a painter must know of it, a map made of a picture, and a task put on a map.

use super::builtin;
use super::live::Session;
use super::open::rewritten;
use super::refusal::{Refusal, Subject};
use crate::env::map::{MAX_SIDE, MapError, Picture, RoverMap};
use crate::ltl::{BinaryOperator, Formula, UnaryOperator};
use crate::task::Task;
use serde::Serialize;

/// What a task file calls a map that is no file.
const NAME: &str = "own_map.json";
/// The most goals that a formula to begin with has: its automaton grows with them.
const MAX_GOALS: usize = 6;

/// A label of a map.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct MapLabel {
    /// The proposition's name.
    pub name: String,
    /// When it holds, in a sentence.
    pub meaning: String,
    /// Cells in which it holds.
    pub area: usize,
}

/// Everything of a map that a painter must know.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct MapFacts {
    /// What the map is called.
    pub name: String,
    /// The unit of length.
    pub unit: String,
    /// Width and height, in `unit`.
    pub size: [f32; 2],
    /// D, the longest way of one step, in `unit`.
    pub reach: f32,
    /// The labels, in the order of letter bits.
    pub labels: Vec<MapLabel>,
    /// The label that wins over all others, if there is one.
    pub hazard: Option<usize>,
    /// The picture that fills the map, if there is one.
    pub picture: Option<String>,
    /// Columns and rows of the grid of letters.
    pub cells: [usize; 2],
    /// The letters that occur, each as the indices of its labels.
    pub letters: Vec<Vec<usize>>,
    /// The letter of each cell, as an index into `letters`, row by row from the top.
    #[serde(skip)]
    pub indices: Vec<u8>,
    /// Cells in which an episode may start.
    pub start_cells: usize,
    /// A formula to begin with: every goal for ever again, the hazard never. Empty for a map without labels.
    pub suggested: String,
    /// The map as one map file.
    pub json: String,
}

impl MapFacts {
    fn new(map: &RoverMap) -> MapFacts {
        let named = map.propositions.iter().zip(&map.meanings).enumerate();
        MapFacts {
            name: map.name.clone(),
            unit: map.unit.clone(),
            size: map.size,
            reach: map.reach,
            labels: named
                .map(|(i, (name, meaning))| MapLabel { name: name.into(), meaning: meaning.clone(), area: map.grid.area(i) })
                .collect(),
            hazard: map.hazard,
            picture: map.picture.clone(),
            cells: map.grid.size(),
            letters: map
                .grid
                .letters()
                .map(|letter| (0..map.propositions.len()).filter(|&i| letter.holds(i)).collect())
                .collect(),
            indices: map.grid.indices().to_vec(),
            start_cells: map.grid.start_cells(),
            suggested: suggested(map).map_or(String::new(), |formula| formula.to_string()),
            json: map.to_json(),
        }
    }
}

/// Reads a map file; `picture` is the one whose colours are labels, if the file says so.
///
/// # Errors
/// What is wrong with it, and where.
pub fn check_map(json: &str, picture: Option<&Picture>) -> Result<MapFacts, Refusal> {
    Ok(MapFacts::new(&read(json, picture)?))
}

/// A picture that a shell has decoded: `pixels` are red, green, blue and opacity, row by row from the top.
///
/// # Errors
/// A picture that is too large, or has other pixels than its size says.
pub fn picture(width: usize, height: usize, pixels: &[u8]) -> Result<Picture, Refusal> {
    if width.max(height) > MAX_SIDE || pixels.len() != width * height * 4 {
        let message = format!("a picture has 1 to {MAX_SIDE} pixels on a side, and four numbers a pixel");
        return Err(Refusal::new(Subject::Map, message));
    }
    Ok(Picture { width, height, pixels: pixels.as_chunks::<4>().0.to_vec() })
}

/// A map of a picture with flat colours.
///
/// # Errors
/// A picture that is not flat, or leaves no free ground.
pub fn map_of_picture(name: &str, picture: &Picture) -> Result<MapFacts, Refusal> {
    let map = RoverMap::from_picture(name, picture).map_err(map_refusal)?;
    Ok(MapFacts::new(&map))
}

/// The map file that a map of one's own begins with.
pub fn default_map() -> &'static str {
    builtin::map_of("own_map").expect("it is shipped")
}

pub(super) fn read(json: &str, picture: Option<&Picture>) -> Result<RoverMap, Refusal> {
    RoverMap::from_json_and_picture(json, picture).map_err(map_refusal)
}

fn map_refusal(error: MapError) -> Refusal {
    Refusal::new(Subject::Map, error.to_string())
}

impl Session {
    /// The rover map of the open task as one map file; `None` for a task without a map.
    pub fn map(&self) -> Option<String> {
        let task = self.setup.task();
        let named = task.file().environment.map.as_deref().and_then(RoverMap::shipped);
        named.map(str::to_owned).or_else(|| task.map().map(|map| map.to_json()))
    }
}

/// Whether the map has every proposition of the task's formula, under the names of its environment.
pub(super) fn has_all(map: &RoverMap, task: &Task) -> bool {
    let labels = &task.file().specification.labels;
    let known = |name: &String| map.propositions.index(labels.get(name).unwrap_or(name)).is_some();
    task.formula().propositions().iter().all(known)
}

/// The formula to begin with on a map.
///
/// # Errors
/// A map on which no label occurs.
pub(super) fn begin_with(map: &RoverMap) -> Result<String, Refusal> {
    let message = "the map has no label yet: paint one, so that there is something to say about it";
    suggested(map).map(|formula| formula.to_string()).ok_or_else(|| Refusal::new(Subject::Map, message))
}

fn suggested(map: &RoverMap) -> Option<Formula> {
    let occurs = |&p: &usize| map.grid.area(p) > 0;
    let goals = (0..map.propositions.len()).filter(|&p| Some(p) != map.hazard).filter(occurs).take(MAX_GOALS);
    let proposition = |p: usize| Formula::proposition(map.propositions.name(p));
    let unary = Formula::unary;
    let for_ever = goals.map(|p| unary(UnaryOperator::Globally, unary(UnaryOperator::Finally, proposition(p))));
    let never = map.hazard.filter(occurs).map(|p| unary(UnaryOperator::Globally, unary(UnaryOperator::Not, proposition(p))));
    for_ever.chain(never).reduce(|left, right| Formula::binary(BinaryOperator::And, left, right))
}

/// The task on another map.
///
/// # Errors
/// A task whose environment has no map.
pub(super) fn on_map(task: &Task, map: RoverMap) -> Result<Task, Refusal> {
    let mut file = task.file().clone();
    if file.environment.name != "rover" {
        let message = format!("a map needs a task of the environment `rover`; this one has `{}`", file.environment.name);
        return Err(Refusal::new(Subject::Map, message));
    }
    file.environment.map = Some(NAME.to_owned());
    Ok(rewritten(task, &file)?.with_map(map))
}
