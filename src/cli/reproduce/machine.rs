//! What a run cost and on what: seconds by the clock, seconds of processor time, the machine in words.

use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Seconds that a piece of work took.
#[derive(Clone, Copy, PartialEq, Default, Debug, Serialize, Deserialize)]
pub struct Seconds {
    /// By the clock on the wall.
    pub wall: f64,
    /// Of processor time of the thread that did it: the same on an idle machine, less on a busy one. `None` where the system does
    /// not tell.
    pub processor: Option<f64>,
}

impl Seconds {
    /// Adds another piece of work.
    pub fn add(&mut self, other: Seconds) {
        let both =
            if self.wall == 0.0 { Some((0.0, other.processor.unwrap_or(0.0))) } else { self.processor.zip(other.processor) };
        self.processor = both.map(|(a, b)| a + b).filter(|_| other.processor.is_some());
        self.wall += other.wall;
    }
}

/// A stopwatch for the thread that started it.
#[derive(Clone, Copy, Debug)]
pub struct Watch {
    began: Instant,
    processor: Option<f64>,
}

impl Watch {
    /// Starts.
    pub fn start() -> Watch {
        Watch { began: Instant::now(), processor: processor_seconds() }
    }

    /// Seconds since the start.
    pub fn read(&self) -> Seconds {
        let processor = self.processor.zip(processor_seconds()).map(|(before, now)| now - before);
        Seconds { wall: self.began.elapsed().as_secs_f64(), processor }
    }
}

/// Processor time of this thread in seconds, as Linux counts it.
fn processor_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? / 1e9)
}

/// Processor, number of logical processors and system, in words.
pub fn machine() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info.lines().find(|line| line.starts_with("model name")).and_then(|line| line.split(": ").nth(1));
    let cores = std::thread::available_parallelism().map_or_else(|_| "?".to_owned(), |n| n.to_string());
    format!(
        "{}, {cores} logical processors, {} {}",
        model.unwrap_or("unknown processor"),
        std::env::consts::OS,
        std::env::consts::ARCH
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_add_up_and_an_unknown_share_makes_the_sum_unknown() {
        let mut sum = Seconds::default();
        sum.add(Seconds { wall: 2.0, processor: Some(1.0) });
        sum.add(Seconds { wall: 1.0, processor: Some(0.5) });
        assert_eq!(sum, Seconds { wall: 3.0, processor: Some(1.5) });
        sum.add(Seconds { wall: 1.0, processor: None });
        assert_eq!(sum, Seconds { wall: 4.0, processor: None });
    }

    #[test]
    fn a_busy_thread_uses_up_processor_time_but_never_more_than_the_wall_shows() {
        let watch = Watch::start();
        let mut x = 0u64;
        while watch.read().wall < 0.02 {
            x = x.wrapping_mul(6364136223846793005).wrapping_add(1);
        }
        let Seconds { wall, processor } = watch.read();
        assert!(wall >= 0.02 && processor.is_none_or(|p| p <= wall + 0.02), "{x}");
    }
}
