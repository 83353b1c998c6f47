//! What [Cai et al. 2021](crate::bib::Cai2021) print in Tables 1 and 2, to stand beside our numbers.

use super::method::Method;

/// The paper's numbers for a task.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PaperTask {
    /// The name of the task file.
    pub task: &'static str,
    /// Its name in the paper.
    pub name: &'static str,
    /// Environment steps in an episode.
    pub max_steps: u32,
    /// Training episodes.
    pub episodes: u32,
    /// Successes in 200 runs, in per cent: with modules (Table 1).
    pub modular: f64,
    /// The same for standard DDPG on the same product.
    pub standard: f64,
    /// Training time in minutes: modular, standard (Table 2).
    pub minutes: [f64; 2],
}

/// The six tasks in the paper's order.
pub const TASKS: [PaperTask; 6] = [
    row("ball_pass_b1", "B1", [200, 1600], [100.0, 0.0], [12.1, 11.3]),
    row("ball_pass_b2", "B2", [500, 1500], [100.0, 77.5], [20.4, 17.0]),
    row("cart_pole_c1", "C1", [200, 1500], [100.0, 23.5], [13.6, 14.1]),
    row("cart_pole_c2", "C2", [500, 1500], [100.0, 61.0], [21.0, 20.2]),
    row("melas", "Melas", [2000, 10_000], [100.0, 0.0], [324.0, 330.0]),
    row("victoria", "Victoria", [8000, 50_000], [100.0, 0.0], [3000.0, 2880.0]),
];

const fn row(task: &'static str, name: &'static str, size: [u32; 2], success: [f64; 2], minutes: [f64; 2]) -> PaperTask {
    let ([max_steps, episodes], [modular, standard]) = (size, success);
    PaperTask { task, name, max_steps, episodes, modular, standard, minutes }
}

/// The paper's row for a task, if it is one of the six.
pub fn paper(task: &str) -> Option<&'static PaperTask> {
    TASKS.iter().find(|row| row.task == task)
}

impl PaperTask {
    /// Successes in per cent; the paper has no numbers for the standard product.
    pub fn success(&self, method: Method) -> Option<f64> {
        match method {
            Method::Modular => Some(self.modular),
            Method::StandardDdpg => Some(self.standard),
            Method::StandardProduct => None,
        }
    }

    /// Training time in minutes.
    pub fn minutes(&self, method: Method) -> Option<f64> {
        match method {
            Method::Modular => Some(self.minutes[0]),
            Method::StandardDdpg => Some(self.minutes[1]),
            Method::StandardProduct => None,
        }
    }
}
