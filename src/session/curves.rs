//! Learning curves of bounded length: finished episodes folded into points, neighbours merged when there are too many.

use serde::{Deserialize, Serialize};

/// The most points that are kept. When they are full, neighbours are merged and a point stands for twice as many episodes.
const MAX_POINTS: usize = 800;

/// What one finished episode adds.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub struct EpisodeOutcome {
    /// Environment steps.
    pub steps: u32,
    /// Σ R(x'), in the paper's units.
    pub total: f64,
    /// Completed rounds.
    pub rounds: u32,
    /// A round was completed, and no sink entered.
    pub success: bool,
}

/// Sum and number of critic losses.
#[derive(Clone, Copy, PartialEq, Default, Debug, Serialize, Deserialize)]
struct LossSum(f64, u64);

impl LossSum {
    fn add(&mut self, other: LossSum) {
        *self = LossSum(self.0 + other.0, self.1 + other.1);
    }

    /// The mean; `None` where there was no update.
    fn mean(self) -> Option<f32> {
        (self.1 > 0).then(|| (self.0 / self.1 as f64) as f32)
    }
}

/// The critic losses of one episode's updates, by module.
#[derive(Clone, PartialEq, Default, Debug, Serialize, Deserialize)]
pub struct EpisodeLosses(Vec<LossSum>);

impl EpisodeLosses {
    /// No updates yet, of `modules` modules.
    pub fn new(modules: usize) -> EpisodeLosses {
        EpisodeLosses(vec![LossSum::default(); modules])
    }

    /// Takes in one update. A module that there is not is passed over.
    pub fn add(&mut self, module: usize, critic: f32) {
        if let Some(sum) = self.0.get_mut(module) {
            sum.add(LossSum(f64::from(critic), 1));
        }
    }

    /// Forgets all updates, for another episode.
    pub fn clear(&mut self) {
        self.0.fill(LossSum::default());
    }
}

/// Sums over the episodes of one point.
#[derive(Clone, PartialEq, Default, Debug, Serialize, Deserialize)]
struct Point {
    episodes: u64,
    /// Σ total/steps.
    average: f64,
    total: f64,
    rounds: f64,
    success: f64,
    /// Σ of the episodes' mean critic losses.
    critic: f64,
    /// By module. Older checkpoints have none.
    #[serde(default)]
    losses: Vec<LossSum>,
}

impl Point {
    fn add(&mut self, other: &Point) {
        self.episodes += other.episodes;
        self.average += other.average;
        self.total += other.total;
        self.rounds += other.rounds;
        self.success += other.success;
        self.critic += other.critic;
        self.losses.resize(self.losses.len().max(other.losses.len()), LossSum::default());
        for (sum, more) in self.losses.iter_mut().zip(&other.losses) {
            sum.add(*more);
        }
    }
}

/// Curves as columns of equal length; each entry is the mean over `every` episodes.
#[derive(Clone, PartialEq, Default, Debug)]
pub struct Curves {
    /// Episodes that a point stands for.
    pub every: u32,
    /// The first episode after the point, from 1.
    pub episode: Vec<f32>,
    /// Reward per step, without shaping, in the paper's units.
    pub average: Vec<f32>,
    /// Reward per episode.
    pub total: Vec<f32>,
    /// Rounds per episode.
    pub rounds: Vec<f32>,
    /// Share of the episodes that satisfied the task, 0 … 1.
    pub success: Vec<f32>,
    /// Critic loss, over all modules.
    pub critic: Vec<f32>,
    /// Critic loss of each module; `None` where it was not updated.
    pub modules: Vec<Vec<Option<f32>>>,
}

impl Curves {
    /// The columns with their names.
    pub fn columns(&self) -> [(&'static str, &[f32]); 6] {
        [
            ("episode", &self.episode),
            ("average", &self.average),
            ("total", &self.total),
            ("rounds", &self.rounds),
            ("success", &self.success),
            ("critic", &self.critic),
        ]
    }
}

/// Takes in episodes and gives [`Curves`].
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct CurveRecorder {
    every: u64,
    points: Vec<Point>,
    open: Point,
}

impl Default for CurveRecorder {
    fn default() -> Self {
        CurveRecorder { every: 1, points: vec![], open: Point::default() }
    }
}

impl CurveRecorder {
    /// Reads back what was saved as TOML.
    ///
    /// # Errors
    /// What is wrong with the text, in a sentence.
    pub fn read(text: &str) -> Result<CurveRecorder, String> {
        let recorder: CurveRecorder = toml::from_str(text).map_err(|e| format!("its curves are malformed: {}", e.message()))?;
        let sound = recorder.points.iter().all(|p| p.episodes == recorder.every) && recorder.open.episodes < recorder.every;
        if sound && recorder.every.is_power_of_two() && recorder.points.len() < MAX_POINTS {
            Ok(recorder)
        } else {
            Err("its curves are malformed: the points do not add up".to_owned())
        }
    }

    /// Takes in one finished episode with the losses of its updates.
    pub fn push(&mut self, episode: EpisodeOutcome, losses: &EpisodeLosses) {
        let mut all = LossSum::default();
        losses.0.iter().for_each(|sum| all.add(*sum));
        self.open.add(&Point {
            episodes: 1,
            average: episode.total / f64::from(episode.steps.max(1)),
            total: episode.total,
            rounds: f64::from(episode.rounds),
            success: f64::from(u8::from(episode.success)),
            critic: all.0 / all.1.max(1) as f64,
            losses: losses.0.clone(),
        });
        if self.open.episodes < self.every {
            return;
        }
        self.points.push(std::mem::take(&mut self.open));
        if self.points.len() == MAX_POINTS {
            let merge = |pair: &[Point]| {
                let mut sum = pair[0].clone();
                sum.add(&pair[1]);
                sum
            };
            self.points = self.points.chunks_exact(2).map(merge).collect();
            self.every *= 2;
        }
    }

    /// The curves as they stand; episodes that do not yet fill a point are left out.
    pub fn curves(&self) -> Curves {
        let modules = self.points.last().map_or(0, |p| p.losses.len());
        let every = u32::try_from(self.every).unwrap_or(u32::MAX);
        let mut curves = Curves { every, modules: vec![vec![]; modules], ..Curves::default() };
        let mut episodes = 0;
        for point in &self.points {
            let n = point.episodes as f64;
            episodes += point.episodes;
            curves.episode.push(episodes as f32);
            curves.average.push((point.average / n) as f32);
            curves.total.push((point.total / n) as f32);
            curves.rounds.push((point.rounds / n) as f32);
            curves.success.push((point.success / n) as f32);
            curves.critic.push((point.critic / n) as f32);
            for (module, curve) in curves.modules.iter_mut().enumerate() {
                curve.push(point.losses.get(module).copied().unwrap_or_default().mean());
            }
        }
        curves
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_stay_bounded_and_keep_the_sums() {
        let mut recorder = CurveRecorder::default();
        let count = 5_000u32;
        let mut losses = EpisodeLosses::new(2);
        losses.add(1, 0.25);
        losses.add(1, 0.75);
        losses.add(7, 100.0);
        for k in 0..count {
            recorder.push(EpisodeOutcome { steps: 10, total: f64::from(k), rounds: k % 3, success: k % 2 == 0 }, &losses);
        }
        let curves = recorder.curves();
        let n = curves.episode.len();
        assert!((MAX_POINTS / 2..MAX_POINTS).contains(&n), "{n} points");
        assert!(curves.every.is_power_of_two());
        assert!(curves.critic.iter().all(|&loss| loss == 0.5) && curves.modules[1].iter().all(|&loss| loss == Some(0.5)));
        assert_eq!(curves.modules[0], vec![None; n]);
        // Means of equally many episodes: the mean of means over complete points is the mean over their episodes.
        let covered = n as u32 * curves.every;
        assert_eq!(*curves.episode.last().unwrap(), covered as f32);
        let mean = curves.total.iter().map(|&t| f64::from(t)).sum::<f64>() / n as f64;
        assert!((mean - f64::from(covered - 1) / 2.0).abs() < 1e-3, "{mean}");
        assert!(curves.average.iter().zip(&curves.total).all(|(a, t)| (a * 10.0 - t).abs() <= 1e-3 * t.max(1.0)));
    }

    #[test]
    fn a_few_episodes_are_shown_as_they_are() {
        let mut recorder = CurveRecorder::default();
        for rounds in [0, 2, 1] {
            recorder.push(EpisodeOutcome { steps: 4, total: 0.02, rounds, success: rounds > 0 }, &EpisodeLosses::default());
        }
        let curves = recorder.curves();
        assert_eq!((curves.every, curves.rounds, curves.success), (1, vec![0.0, 2.0, 1.0], vec![0.0, 1.0, 1.0]));
        assert_eq!(curves.episode, vec![1.0, 2.0, 3.0]);
    }
}
