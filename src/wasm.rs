//! The browser boundary: conversions over [`Session`], and nothing decided here.
//!
//! Structured, rare things cross as plain JavaScript objects; numbers that cross often, as `Float32Array`s copied once. Every
//! refusal becomes a thrown `Error` with the fields of [`Refusal`] in one place, `refused`.
#![allow(missing_docs, reason = "what the macro makes of extern types carries no docs of its own")]

use crate::agent::Replays;
use crate::session::{self, EpisodeTrace, OpenRequest, Refusal, Subject, TranslationOptions, ValueMapRequest};
use js_sys::{Array, Error, Float32Array, Object, Reflect, Uint8Array};
use serde::Serialize;
use serde_wasm_bindgen::Serializer;
use wasm_bindgen::prelude::*;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
import type { BestPolicy, ComparisonVerdict, Curves, Description, Episode, EvaluationProgress, FormulaVerdict, HoaVerdict, MapVerdict, ModuleStatistics, TaskEntry, ValueMap, ValueMapRequest, Word, WordReading } from '../src/protocol.js';
export interface TranslationOptions { state_based?: boolean; deterministic?: boolean; classify?: boolean; }
export type TranslationVerdict = { ok: true; facts: TranslationFacts } | { ok: false; error: TranslationRefusal };
/** Places are in UTF-16 code units of the text that `field` names. */
export interface TranslationRefusal { field: 'task' | 'formula' | 'hoa' | 'map' | 'session'; message: string; hint: string; start: number; end: number; line: number; column: number; }
export interface TranslationWarning {
  kind: 'notation' | 'unsatisfiable' | 'valid' | 'unknown_proposition' | 'never_holds' | 'impossible_here' | 'lost_at_start'
    | 'good_for_mdps' | 'mismatch' | 'reading';
  message: string; start: number; end: number;
}
export interface TranslationFacts {
  formula: string; parenthesised: string; paraphrase: string;
  class: { name: 'safety' | 'guarantee' | 'obligation' | 'recurrence' | 'persistence' | 'reactivity'; meaning: string; exact: boolean } | null;
  size: { states: number; unreachable: number; sinks: number; nondeterministic: number; edges: number; epsilon: number; sets: number;
    propositions: number; deterministic: boolean; state_based: boolean; empty_language: boolean };
  graph: Description['automaton']; hoa: string; offered: string[]; exclusive: string[][]; warnings: TranslationWarning[];
}
export interface Request {
  task: string; formula?: string | null; hoa?: string | null; map?: string | null; seed: bigint; preset?: string | null; overrides?: Record<string, string>;
}
"#;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(typescript_type = "Request")]
    pub type JsRequest;
    #[wasm_bindgen(typescript_type = "Description")]
    pub type JsDescription;
    #[wasm_bindgen(typescript_type = "Episode")]
    pub type JsEpisode;
    #[wasm_bindgen(typescript_type = "Curves")]
    pub type JsCurves;
    #[wasm_bindgen(typescript_type = "ModuleStatistics[]")]
    pub type JsStatistics;
    #[wasm_bindgen(typescript_type = "EvaluationProgress | undefined")]
    pub type JsProgress;
    #[wasm_bindgen(typescript_type = "BestPolicy | undefined")]
    pub type JsBestPolicy;
    #[wasm_bindgen(typescript_type = "TaskEntry[]")]
    pub type JsTasks;
    #[wasm_bindgen(typescript_type = "FormulaVerdict")]
    pub type JsFormulaVerdict;
    #[wasm_bindgen(typescript_type = "HoaVerdict")]
    pub type JsHoaVerdict;
    #[wasm_bindgen(typescript_type = "MapVerdict")]
    pub type JsMapVerdict;
    #[wasm_bindgen(typescript_type = "TranslationOptions")]
    pub type JsTranslationOptions;
    #[wasm_bindgen(typescript_type = "TranslationVerdict")]
    pub type JsTranslationVerdict;
    #[wasm_bindgen(typescript_type = "Word")]
    pub type JsWord;
    #[wasm_bindgen(typescript_type = "WordReading")]
    pub type JsWordReading;
    #[wasm_bindgen(typescript_type = "ComparisonVerdict")]
    pub type JsComparisonVerdict;
    #[wasm_bindgen(typescript_type = "ValueMapRequest")]
    pub type JsValueMapRequest;
    #[wasm_bindgen(typescript_type = "ValueMap")]
    pub type JsValueMap;
}

/// Runs once when the module is loaded: a panic is said in the console with its place, before the trap.
#[wasm_bindgen(start)]
fn start() {
    std::panic::set_hook(Box::new(|info| {
        #[wasm_bindgen]
        extern "C" {
            #[wasm_bindgen(js_namespace = console)]
            fn error(message: &str);
        }
        error(&format!("ltl-rover stopped, which is a fault of the program: {info}"));
    }));
}

/// The one place where a refusal becomes a thrown value.
fn refused(refusal: Refusal) -> JsValue {
    let error = Error::new(&refusal.message);
    let fields: JsValue = plain(&refusal);
    Object::assign(&error, fields.unchecked_ref::<Object>()).into()
}

/// Plain objects, `null` for what is absent, 64-bit numbers as numbers.
fn plain<T: JsCast>(value: &impl Serialize) -> T {
    let serializer = Serializer::json_compatible().serialize_large_number_types_as_bigints(false);
    value.serialize(&serializer).expect("the session's types are plain data").unchecked_into()
}

fn set(object: &JsValue, key: &str, value: impl Into<JsValue>) {
    Reflect::set(object, &key.into(), &value.into()).expect("a plain object takes any property");
}

/// `{ ok: true, facts }`, or `{ ok: false, error }`.
fn verdict<T: JsCast>(result: Result<impl Serialize, Refusal>) -> T {
    let object = Object::new();
    set(&object, "ok", result.is_ok());
    match result {
        Ok(facts) => set(&object, "facts", plain::<JsValue>(&facts)),
        Err(refusal) => set(&object, "error", plain::<JsValue>(&refusal)),
    }
    object.unchecked_into()
}

fn episode(trace: &EpisodeTrace) -> JsEpisode {
    let object = Object::new();
    set(&object, "rows", trace.rows as f64);
    set(&object, "data", Float32Array::from(trace.data.as_slice()));
    set(&object, "rounds", trace.rounds);
    set(&object, "success", trace.success);
    object.unchecked_into()
}

/// The tasks that come with the page.
#[wasm_bindgen]
pub fn builtin_tasks() -> JsTasks {
    plain(&session::builtin_tasks())
}

/// The verdict on a formula; `known` are the environment's propositions, for warnings.
#[wasm_bindgen]
pub fn check_formula(text: &str, known: Vec<String>) -> JsFormulaVerdict {
    verdict(session::check_formula(text, &known))
}

/// The verdict on an automaton file.
#[wasm_bindgen]
pub fn check_hoa(text: &str) -> JsHoaVerdict {
    verdict(session::check_hoa(text))
}

/// The verdict on a map file without a picture.
#[wasm_bindgen]
pub fn check_map(json: &str) -> JsMapVerdict {
    map_verdict(session::check_map(json, None))
}

/// The verdict on a map file whose labels are the colours of a picture: red, green, blue and opacity of its pixels, row by row.
#[wasm_bindgen]
pub fn check_map_and_picture(json: &str, width: u32, height: u32, pixels: &[u8]) -> JsMapVerdict {
    let picture = session::picture(width as usize, height as usize, pixels);
    map_verdict(picture.and_then(|picture| session::check_map(json, Some(&picture))))
}

/// The verdict on a picture with flat colours as a map.
#[wasm_bindgen]
pub fn map_of_picture(name: &str, width: u32, height: u32, pixels: &[u8]) -> JsMapVerdict {
    let picture = session::picture(width as usize, height as usize, pixels);
    map_verdict(picture.and_then(|picture| session::map_of_picture(name, &picture)))
}

/// The map file that a map of one's own begins with.
#[wasm_bindgen]
pub fn default_map() -> String {
    session::default_map().to_owned()
}

fn map_verdict(result: Result<session::MapFacts, Refusal>) -> JsMapVerdict {
    let indices = result.as_ref().ok().map(|facts| Uint8Array::from(facts.indices.as_slice()));
    let object: JsMapVerdict = verdict(result);
    if let Some(indices) = indices {
        let facts = Reflect::get(&object, &"facts".into()).expect("a verdict that is good has facts");
        set(&facts, "indices", indices);
    }
    object
}

/// The automaton of a formula, for the environment of the built-in task or the task file `task` (none if it is empty).
#[wasm_bindgen]
pub fn translate_formula(text: &str, task: &str, options: JsTranslationOptions) -> JsTranslationVerdict {
    verdict(translation_options(options).and_then(|options| session::translate_formula(text, task, &options)))
}

/// What is left out of the options has its default.
fn translation_options(options: JsTranslationOptions) -> Result<TranslationOptions, Refusal> {
    let options: JsValue = options.into();
    if options.is_undefined() || options.is_null() {
        return Ok(TranslationOptions::default());
    }
    let malformed = |e| Refusal::new(Subject::Session, format!("the options are malformed: {e}"));
    serde_wasm_bindgen::from_value(options).map_err(malformed)
}

/// Translates formulas for one environment: cheap to ask again and again, while the user types.
#[wasm_bindgen]
pub struct Translator(session::Translator);

#[wasm_bindgen]
impl Translator {
    /// For the environment of a built-in task or a task file (none if `task` is empty), with `map`, a map file, for the rover on that map.
    pub fn of_task(task: &str, map: Option<String>) -> Result<Translator, JsValue> {
        if task.is_empty() && map.is_none() {
            return Ok(Translator(session::Translator::free()));
        }
        session::Translator::of_task(task, map.as_deref()).map(Translator).map_err(refused)
    }

    /// The verdict on a formula: its automaton, its class, warnings.
    pub fn translate(&self, text: &str, options: JsTranslationOptions) -> JsTranslationVerdict {
        verdict(translation_options(options).and_then(|options| self.0.translate(text, &options)))
    }

    /// The verdict on an automaton file, held against the formula `text` if that is not empty.
    pub fn read(&self, hoa: &str, text: &str) -> JsTranslationVerdict {
        verdict(self.0.read(hoa, text))
    }

    /// The verdict on an automaton file held against a formula: equal, or a word on which they differ.
    pub fn compare(&self, formula: &str, hoa: &str) -> JsComparisonVerdict {
        verdict(self.0.compare(formula, hoa))
    }
}

fn word(given: JsWord) -> Result<session::Word, JsValue> {
    serde_wasm_bindgen::from_value(given.into())
        .map_err(|e| refused(Refusal::new(Subject::Session, format!("the word is malformed: {e}"))))
}

/// Whether an infinite word satisfies a formula; throws what is wrong with either.
#[wasm_bindgen]
pub fn judge_word(formula: &str, given: JsWord) -> Result<bool, JsValue> {
    session::judge_word(formula, &word(given)?).map_err(refused)
}

/// An open task under training.
#[wasm_bindgen]
pub struct Session(session::Session);

#[wasm_bindgen]
impl Session {
    /// Opens a task; throws what is wrong with it.
    pub fn open(request: JsRequest) -> Result<Session, JsValue> {
        let request: OpenRequest = serde_wasm_bindgen::from_value(request.into())
            .map_err(|e| refused(Refusal::new(Subject::Task, format!("the request is malformed: {e}"))))?;
        session::Session::open(&request).map(Session).map_err(refused)
    }

    /// Opens a checkpoint; throws what is wrong with it.
    pub fn restore(bytes: &[u8]) -> Result<Session, JsValue> {
        session::Session::restore(bytes).map(Session).map_err(refused)
    }

    /// The checkpoint of this moment, from which training goes on exactly.
    pub fn save(&mut self) -> Uint8Array {
        Uint8Array::from(self.0.save(Replays::Keep).as_slice())
    }

    /// The same without replays: small, but training first fills them anew.
    pub fn save_small(&mut self) -> Uint8Array {
        Uint8Array::from(self.0.save(Replays::Leave).as_slice())
    }

    /// The best policy alone: small, to be shown, not trained on.
    pub fn save_policy(&self) -> Uint8Array {
        Uint8Array::from(self.0.save_policy().as_slice())
    }

    /// The rover map of the open task as one map file, if it has one.
    pub fn map(&self) -> Option<String> {
        self.0.map()
    }

    /// Everything that does not change from step to step.
    pub fn describe(&self) -> JsDescription {
        plain(&self.0.describe())
    }

    /// Translates formulas for this session's environment.
    pub fn translator(&self) -> Translator {
        Translator(self.0.translator())
    }

    /// Trains for at most `steps` moves, and no further than the recipe's end; how many were made.
    pub fn advance(&mut self, steps: u32) -> u32 {
        self.0.advance(steps)
    }

    /// Whether the recipe's budget is spent, or its goal reached.
    #[wasm_bindgen(getter)]
    pub fn finished(&self) -> bool {
        self.0.finished()
    }

    /// What the best policy so far came to.
    #[wasm_bindgen(getter)]
    pub fn best(&self) -> JsBestPolicy {
        self.0.best().map_or(JsValue::UNDEFINED.unchecked_into(), |best| plain(&best))
    }

    /// Environment steps at the first periodic evaluation without a failure.
    #[wasm_bindgen(getter)]
    pub fn first_perfect_step(&self) -> Option<f64> {
        self.0.first_perfect_step().map(|step| step as f64)
    }

    /// The numbers of this moment.
    pub fn frame(&self) -> Float32Array {
        Float32Array::from(self.0.frame().as_slice())
    }

    /// One greedy episode from start `index`.
    pub fn rollout(&mut self, index: u64) -> JsEpisode {
        episode(&self.0.rollout(index))
    }

    /// One greedy episode from a state of one's own.
    pub fn rollout_from(&mut self, index: u64, state: &[f32]) -> Result<JsEpisode, JsValue> {
        self.0.rollout_from(index, state).map(|trace| episode(&trace)).map_err(refused)
    }

    /// What the critic of a module thinks of a plane of states.
    pub fn value_map(&mut self, request: JsValueMapRequest) -> Result<JsValueMap, JsValue> {
        let request: ValueMapRequest = serde_wasm_bindgen::from_value(request.into())
            .map_err(|e| refused(Refusal::new(Subject::Session, format!("the request is malformed: {e}"))))?;
        let map = self.0.value_map(&request).map_err(refused)?;
        let object = Object::new();
        set(&object, "module", map.module.map_or(JsValue::NULL, |module| JsValue::from(module as f64)));
        set(&object, "axes", plain::<JsValue>(&map.axes));
        set(&object, "columns", map.columns as f64);
        set(&object, "rows", map.rows as f64);
        set(&object, "values", Float32Array::from(map.values.as_slice()));
        set(&object, "controls", Float32Array::from(map.controls.as_slice()));
        Ok(object.unchecked_into())
    }

    /// Begins an evaluation of `runs` episodes.
    pub fn begin_evaluation(&mut self, runs: u32) -> Result<(), JsValue> {
        self.0.begin_evaluation(runs).map_err(refused)
    }

    /// Makes at most `steps` moves of the evaluation; whether there is more to do.
    pub fn advance_evaluation(&mut self, steps: u32) -> bool {
        self.0.advance_evaluation(steps)
    }

    /// How the last evaluation stands.
    pub fn evaluation(&self) -> JsProgress {
        self.0.evaluation().map_or(JsValue::UNDEFINED.unchecked_into(), |progress| plain(&progress))
    }

    /// Begins an episode that the user drives, from start `index`; its first frame.
    pub fn begin_drive(&mut self, index: u64) -> Float32Array {
        Float32Array::from(self.0.begin_drive(index).as_slice())
    }

    /// One step under the user's control, or along the ε-jump to `jump`; the frame after it.
    pub fn drive(&mut self, control: &[f32], jump: Option<u16>) -> Result<Float32Array, JsValue> {
        self.0.drive(control, jump).map(|frame| Float32Array::from(frame.as_slice())).map_err(refused)
    }

    /// Reads an infinite word letter by letter; throws what is wrong with it.
    pub fn read_word(&self, given: JsWord) -> Result<JsWordReading, JsValue> {
        let reading = self.0.read_word(&word(given)?).map_err(refused)?;
        let object: JsValue = plain(&reading);
        set(&object, "data", Float32Array::from(reading.data.as_slice()));
        Ok(object.unchecked_into())
    }

    /// The learning curves so far.
    pub fn curves(&self) -> JsCurves {
        let curves = self.0.curves();
        let object = Object::new();
        set(&object, "every", curves.every);
        for (name, column) in curves.columns() {
            set(&object, name, Float32Array::from(column));
        }
        let numbers = |curve: &Vec<Option<f32>>| curve.iter().map(|loss| loss.unwrap_or(f32::NAN)).collect::<Vec<f32>>();
        let columns = curves.modules.iter().map(|curve| Float32Array::from(numbers(curve).as_slice()));
        set(&object, "modules", columns.collect::<Array>());
        object.unchecked_into()
    }

    /// How each module has fared.
    pub fn statistics(&self) -> JsStatistics {
        plain(&self.0.statistics())
    }
}
