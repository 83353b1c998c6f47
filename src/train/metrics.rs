//! Metrics folded over ticks: a summary per episode, and rows of means under the names that Stable-Baselines3 uses.

use super::trainer::{Tick, Trainer};
use crate::eval::Episode;
use serde::Serialize;
use std::collections::VecDeque;

/// Episodes in the means of a row.
const WINDOW: usize = 100;

/// A finished training episode.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct EpisodeSummary {
    /// Its number, from 0.
    pub episode: u64,
    /// Environment steps of the run at its end.
    pub step: u64,
    /// Its own environment steps.
    pub steps: u32,
    /// Σ R(x), in the paper's units, without shaping and sink rewards.
    pub total_reward: f64,
    /// Reward per step.
    pub average_reward: f64,
    /// Σ R'(x, u, x'), shaping and sink rewards included.
    pub shaped_reward: f64,
    /// Completed rounds.
    pub rounds: u32,
    /// 1 if it completed a round and met no sink, else 0.
    pub success: u8,
    /// 1 if it ended in a sink, else 0.
    pub sink: u8,
}

/// A running mean since it was last read.
#[derive(Clone, Copy, Default, Debug)]
struct Mean {
    sum: f64,
    count: u64,
}

impl Mean {
    fn add(&mut self, value: f32) {
        self.sum += f64::from(value);
        self.count += 1;
    }

    fn take(&mut self) -> Option<f64> {
        let Mean { sum, count } = std::mem::take(self);
        (count > 0).then(|| sum / count as f64)
    }
}

/// What has been folded so far.
#[derive(Clone, Debug)]
pub struct Metrics {
    states: Vec<String>,
    modules: Vec<String>,
    episode: Episode,
    shaped: f64,
    window: VecDeque<EpisodeSummary>,
    visits: Vec<u64>,
    critic: Vec<Mean>,
    actor: Vec<Mean>,
    updates: Vec<u64>,
    step: u64,
    episodes: u64,
}

impl Metrics {
    /// Nothing folded yet, for what `trainer` does.
    pub fn of(trainer: &Trainer) -> Metrics {
        let automaton = trainer.product().embedding().automaton();
        let modules = trainer.learner().modules();
        let state = |q| if automaton.name(q).is_empty() { q.to_string() } else { automaton.name(q).to_owned() };
        Metrics::new(automaton.states().map(state).collect(), (0..modules.len()).map(|m| modules.name(m).to_owned()).collect())
    }

    /// Nothing folded yet; `states` and `modules` are the names of automaton states and modules.
    pub fn new(states: Vec<String>, modules: Vec<String>) -> Metrics {
        let (visits, losses) = (vec![0; states.len()], vec![Mean::default(); modules.len()]);
        let updates = vec![0; modules.len()];
        Metrics {
            states,
            modules,
            episode: Episode::default(),
            shaped: 0.0,
            window: VecDeque::new(),
            visits,
            critic: losses.clone(),
            actor: losses,
            updates,
            step: 0,
            episodes: 0,
        }
    }

    /// Takes in a tick; the summary of the episode that it ended, if it did and is not one of the short ones.
    pub fn fold(&mut self, tick: &Tick) -> Option<EpisodeSummary> {
        self.step = tick.step;
        if let Some(start) = tick.start {
            self.episode = Episode { rounds: u32::from(start.closes_round), ..Episode::default() };
            self.shaped = 0.0;
        }
        self.episode.count(&tick.product, tick.rounds, tick.reward.base);
        self.shaped += f64::from(tick.reward.payoff().reward);
        if let Some(count) = self.visits.get_mut(tick.product.to.q as usize) {
            *count += 1;
        }
        if let Some(update) = tick.update {
            self.critic[update.module].add(update.losses.critic);
            self.actor[update.module].add(update.losses.actor);
            self.updates[update.module] += 1;
        }
        tick.counted_end()?;
        let total = f64::from(self.episode.total_reward);
        let summary = EpisodeSummary {
            episode: tick.episode,
            step: tick.step,
            steps: self.episode.steps,
            total_reward: total,
            average_reward: total / f64::from(self.episode.steps.max(1)),
            shaped_reward: self.shaped,
            rounds: self.episode.rounds,
            success: u8::from(self.episode.success()),
            sink: u8::from(self.episode.sink),
        };
        self.episodes += 1;
        self.window.push_back(summary);
        if self.window.len() > WINDOW {
            self.window.pop_front();
        }
        Some(summary)
    }

    /// The row of this moment, always with the same columns: means over the last 100 episodes, losses since the last row, visits
    /// since the beginning. The mean of nothing is `None`.
    pub fn row(&mut self) -> Vec<(String, Option<f64>)> {
        let mut row = vec![("time/total_timesteps".to_owned(), Some(self.step as f64))];
        row.push(("time/episodes".to_owned(), Some(self.episodes as f64)));
        let n = self.window.len() as f64;
        let mut mean = |name: &str, of: &dyn Fn(&EpisodeSummary) -> f64| {
            let value = (n > 0.0).then(|| self.window.iter().map(of).sum::<f64>() / n);
            row.push((name.to_owned(), value));
        };
        mean("rollout/ep_rew_mean", &|e| e.total_reward);
        mean("rollout/ep_rew_per_step_mean", &|e| e.average_reward);
        mean("rollout/ep_len_mean", &|e| f64::from(e.steps));
        mean("rollout/success_rate", &|e| f64::from(e.success));
        mean("ltl/rounds", &|e| f64::from(e.rounds));
        mean("ltl/sink_rate", &|e| f64::from(e.sink));
        let all =
            |losses: &[Mean]| losses.iter().fold(Mean::default(), |a, b| Mean { sum: a.sum + b.sum, count: a.count + b.count });
        row.push(("train/critic_loss".to_owned(), all(&self.critic).take()));
        row.push(("train/actor_loss".to_owned(), all(&self.actor).take()));
        for (m, name) in self.modules.iter().enumerate() {
            row.push((format!("train/critic_loss/{name}"), self.critic[m].take()));
            row.push((format!("train/actor_loss/{name}"), self.actor[m].take()));
        }
        row.push(("train/n_updates".to_owned(), Some(self.updates.iter().sum::<u64>() as f64)));
        row.extend(self.states.iter().zip(&self.visits).map(|(q, n)| (format!("ltl/visits/{q}"), Some(*n as f64))));
        row
    }

    /// The last episodes, at most 100.
    pub fn window(&self) -> impl ExactSizeIterator<Item = &EpisodeSummary> {
        self.window.iter()
    }
}
