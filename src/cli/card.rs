//! Model cards: what a policy file is, how it was trained, and what an evaluation has shown of it, in Markdown.

use crate::agent::ModularDdpg;
use crate::env::TraceHasher;
use crate::eval::{Evaluation, RolloutSettings};
use crate::product::Start;
use crate::task::Setup;
use crate::train::Checkpoint;
use std::fmt::Write;

/// The card of the policy in `checkpoint`, with what `evaluation` under `settings` has shown.
pub fn card(
    checkpoint: &Checkpoint,
    setup: &Setup,
    learner: &ModularDdpg,
    (e, settings): (&Evaluation, RolloutSettings),
) -> String {
    let file = setup.task().file();
    let l = &setup.preset().learner;
    let percent = |share: f64| format!("{:.1} %", 100.0 * share);
    let mut text = format!("# {}\n\n{}\n\n| | |\n| --- | --- |\n", file.title, file.description);
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "| {name} | {} |", value.replace('|', "\\|"));
    };
    row("formula", format!("`{}`", file.specification.ltl));
    let environment = &file.environment;
    row("environment", environment.map.as_ref().map_or(environment.name.clone(), |map| format!("{} on {map}", environment.name)));
    let automaton = setup.automaton();
    let fingerprint = setup.hoa().map_or_else(|| "translated".to_owned(), |hoa| format!("{:016x}", fingerprint(hoa)));
    row("automaton", format!("{} states, {} accepting sets, fingerprint {fingerprint}", automaton.len(), automaton.sets()));
    row(
        "networks",
        format!("{} modules, hidden layers {:?}; the file holds actors and critics", learner.modules().len(), l.hidden),
    );
    row("recipe", format!("`{}`; all its numbers stand in the file's metadata", setup.preset_name()));
    let extent = checkpoint.extent;
    row("trained for", format!("{} environment steps, {} episodes, {} updates", extent.steps, extent.episodes, extent.updates));
    row("training seed", checkpoint.seed.to_string());
    let start = match settings.start {
        Start::Initial => "the environment's own starts",
        Start::Anywhere => "starts anywhere on safe ground",
    };
    row("judged on", format!("{} episodes of {} steps, {start}, seed {}", e.runs, settings.max_steps, e.seed));
    row(
        "success",
        format!(
            "{}/{}, 95 % interval [{}, {}] (Clopper–Pearson)",
            e.successes,
            e.runs,
            percent(e.ci95.low),
            percent(e.ci95.high)
        ),
    );
    row("rounds", format!("{:.2} per episode", e.rounds_mean));
    row("first round", e.first_round_steps_mean.map_or("never".to_owned(), |steps| format!("after {steps:.1} steps on average")));
    let failures = e.runs - e.successes;
    let sinks = (e.sink_rate * f64::from(e.runs)).round() as u32;
    row(
        "known failures",
        match failures {
            0 => "none in these episodes".to_owned(),
            n => format!("{n} episodes: {sinks} ended in a sink, {} had no round", n.saturating_sub(sinks)),
        },
    );
    row("program", format!("ltl-rover {}", env!("CARGO_PKG_VERSION")));
    text
}

/// 64 bits that stand for a text: FNV-1a over its characters.
pub fn fingerprint(text: &str) -> u64 {
    let mut hasher = TraceHasher::new();
    text.bytes().for_each(|byte| hasher.word(u64::from(byte)));
    hasher.finish()
}
