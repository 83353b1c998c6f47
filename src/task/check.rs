//! The ranges of a recipe's numbers: outside them a learner could not run, or would take a machine's whole memory.

use super::preset::Preset;
use crate::agent::{NoiseSettings, Schedule};

/// A number outside its range: where it stands in the preset, what it is, and what is allowed.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct OutOfRange {
    /// Keys below the preset, such as `learner`, `tau`.
    pub path: &'static [&'static str],
    pub message: String,
}

/// The largest replay per module, in samples.
const MAX_REPLAY: usize = 10_000_000;
/// The widest hidden layer.
const MAX_WIDTH: usize = 1024;

/// The first number of `preset` that is outside its range.
pub(super) fn out_of_range(preset: &Preset) -> Option<OutOfRange> {
    let (p, l, t) = (&preset.product, &preset.learner, &preset.training);
    let (x, short) = (&l.exploration, &t.short_episodes);
    let rate = |s: &Schedule| within(s, 0.0, 1.0);
    let hidden = !l.hidden.is_empty() && l.hidden.len() <= 8 && l.hidden.iter().all(|w| (1..=MAX_WIDTH).contains(w));
    let noise = match x.noise {
        NoiseSettings::OrnsteinUhlenbeck { theta, sigma } => theta > 0.0 && theta <= 1.0 && within(&sigma, 0.0, 10.0),
        NoiseSettings::Gaussian { sigma } => within(&sigma, 0.0, 10.0),
        NoiseSettings::None => true,
    };
    let smoothing = [l.target_smoothing.sigma, l.target_smoothing.clip];
    let shown = |value: &dyn std::fmt::Debug| format!("{value:?}");
    let open = |v: f64| v > 0.0 && v < 1.0;
    let rows: [(bool, &'static [&'static str], String, &str); 30] = [
        (open(p.accepting_discount), &["product", "accepting_discount"], shown(&p.accepting_discount), "between 0 and 1"),
        (p.discount > 0.0 && p.discount <= 1.0, &["product", "discount"], shown(&p.discount), "above 0 and at most 1"),
        (p.sink_reward.abs() <= 1e6, &["product", "sink_reward"], shown(&p.sink_reward), "within ±1000000"),
        ((0.0..=1e6).contains(&p.shaping.weight()), &["product", "shaping"], shown(&p.shaping.weight()), "a weight ≥ 0"),
        (hidden, &["learner", "hidden"], shown(&l.hidden), "1 to 8 layers of 1 to 1024"),
        (l.fourier_octaves <= 12, &["learner", "fourier_octaves"], shown(&l.fourier_octaves), "0 to 12"),
        (rate(&l.actor_rate), &["learner", "actor_rate"], shown(&l.actor_rate), "0 to 1"),
        (rate(&l.critic_rate), &["learner", "critic_rate"], shown(&l.critic_rate), "0 to 1"),
        (l.tau > 0.0 && l.tau <= 1.0, &["learner", "tau"], shown(&l.tau), "above 0 and at most 1"),
        ((1..=4096).contains(&l.batch), &["learner", "batch"], shown(&l.batch), "1 to 4096"),
        ((1..=MAX_REPLAY).contains(&l.replay), &["learner", "replay"], shown(&l.replay), "1 to 10000000"),
        ((1..=1000).contains(&l.n_step), &["learner", "n_step"], shown(&l.n_step), "1 to 1000"),
        (l.updates_per_step <= 100, &["learner", "updates_per_step"], shown(&l.updates_per_step), "0 to 100"),
        ((1..=10_000).contains(&l.update_every), &["learner", "update_every"], shown(&l.update_every), "1 to 10000"),
        ((1..=100).contains(&l.policy_delay), &["learner", "policy_delay"], shown(&l.policy_delay), "1 to 100"),
        (
            (0.0..=1e3).contains(&l.saturation_penalty),
            &["learner", "saturation_penalty"],
            shown(&l.saturation_penalty),
            "0 to 1000",
        ),
        (smoothing.iter().all(|v| (0.0..=2.0).contains(v)), &["learner", "target_smoothing"], shown(&smoothing), "0 to 2"),
        (l.reward_scale > 0.0 && l.reward_scale <= 1e6, &["learner", "reward_scale"], shown(&l.reward_scale), "0 to 1000000"),
        (l.counterfactual.samples <= 64, &["learner", "counterfactual"], shown(&l.counterfactual.samples), "0 to 64 samples"),
        (noise, &["learner", "exploration", "noise"], shown(&x.noise), "theta above 0 and at most 1, sigma 0 to 10"),
        (rate(&x.hold_probability), &["learner", "exploration", "hold_probability"], shown(&x.hold_probability), "0 to 1"),
        (x.hold_steps <= 1_000_000, &["learner", "exploration", "hold_steps"], shown(&x.hold_steps), "0 to 1000000"),
        (
            (0.0..=1.0).contains(&x.jump_probability),
            &["learner", "exploration", "jump_probability"],
            shown(&x.jump_probability),
            "0 to 1",
        ),
        (t.steps >= 1, &["training", "steps"], shown(&t.steps), "at least 1"),
        (t.evaluation_runs >= 1 || t.evaluate_every == 0, &["training", "evaluation_runs"], "0".into(), "at least 1"),
        (t.evaluation_runs <= 100_000, &["training", "evaluation_runs"], shown(&t.evaluation_runs), "at most 100000"),
        ((0.0..=1.0).contains(&short.share), &["training", "short_episodes", "share"], shown(&short.share), "0 to 1"),
        (
            (1..=10_000_000).contains(&short.max_steps),
            &["training", "short_episodes", "max_steps"],
            shown(&short.max_steps),
            "1 to 10000000",
        ),
        ((0.0..=100.0).contains(&t.disturbance), &["training", "disturbance"], shown(&t.disturbance), "0 to 100"),
        (t.max_steps <= 10_000_000, &["training", "max_steps"], shown(&t.max_steps), "at most 10000000"),
    ];
    rows.into_iter().find(|(ok, ..)| !ok).map(|(_, path, found, allowed)| OutOfRange {
        path,
        message: format!("`{}` is {found}; allowed is {allowed}", path[path.len() - 1]),
    })
}

/// Whether a schedule stays within `[low, high]` and takes at least one step.
fn within(schedule: &Schedule, low: f32, high: f32) -> bool {
    let (least, greatest) = schedule.range();
    let moves = !matches!(schedule, Schedule::Linear(line) if line.over == 0);
    least >= low && greatest <= high && moves
}
