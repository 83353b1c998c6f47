//! Intervals and robust means: Clopper–Pearson within one policy, interquartile mean and bootstrap across training seeds.
//!
//! Episodes of one policy are one sample, training seeds another: the two are never pooled.

use crate::rng::Rng;
use serde::{Deserialize, Serialize};
use statrs::function::beta::inv_beta_reg;

/// A closed interval.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// The exact interval of [Clopper & Pearson 1934](crate::bib::ClopperPearson1934) for a success rate: `successes` of `runs` at
/// the given `confidence` (0.95 for 95 %). Without a run nothing is known: `[0, 1]`.
///
/// # Panics
/// If `successes > runs` or `confidence` is outside `(0, 1)`.
pub fn clopper_pearson(successes: u32, runs: u32, confidence: f64) -> Interval {
    assert!(successes <= runs, "more successes than runs");
    assert!(confidence > 0.0 && confidence < 1.0, "a confidence lies in (0, 1)");
    let tail = (1.0 - confidence) / 2.0;
    let (k, n) = (f64::from(successes), f64::from(runs));
    let low = if successes == 0 { 0.0 } else { beta_quantile(tail, k, n - k + 1.0) };
    let high = if successes == runs { 1.0 } else { beta_quantile(1.0 - tail, k + 1.0, n - k) };
    Interval { low, high }
}

/// The number below which a Beta(a, b) variable lies with probability `p`. Where the distribution is a power in closed form
/// that is used, since the ends 0/n and n/n are the ones reported most.
fn beta_quantile(p: f64, a: f64, b: f64) -> f64 {
    if b == 1.0 {
        libm::pow(p, 1.0 / a)
    } else if a == 1.0 {
        1.0 - libm::pow(1.0 - p, 1.0 / b)
    } else {
        inv_beta_reg(a, b, p)
    }
}

/// The arithmetic mean; NaN for no values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The mean of the middle half of the values ([Agarwal et al. 2021](crate::bib::Agarwal2021)): values at the quartiles count with
/// the fraction of them that lies inside, so that it is also defined for few values. NaN for no values.
pub fn interquartile_mean(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len() as f64;
    let (from, to) = (n / 4.0, 3.0 * n / 4.0);
    let weight = |i: usize| ((i as f64 + 1.0).min(to) - (i as f64).max(from)).max(0.0);
    sorted.iter().enumerate().map(|(i, x)| weight(i) * x).sum::<f64>() / (to - from)
}

/// The percentile bootstrap of a statistic over training seeds, stratified by task: in each of `resamples` rounds every stratum is
/// drawn anew with replacement, and `statistic` sees all of them together ([Agarwal et al. 2021](crate::bib::Agarwal2021)).
/// `None` if there is no stratum, an empty one, or no round.
pub fn stratified_bootstrap(
    strata: &[&[f64]],
    statistic: fn(&[f64]) -> f64,
    confidence: f64,
    resamples: usize,
    rng: &mut Rng,
) -> Option<Interval> {
    if strata.is_empty() || strata.iter().any(|s| s.is_empty()) || resamples == 0 {
        return None;
    }
    let mut drawn = Vec::with_capacity(strata.iter().map(|s| s.len()).sum());
    let mut statistics: Vec<f64> = (0..resamples)
        .map(|_| {
            drawn.clear();
            for stratum in strata {
                drawn.extend((0..stratum.len()).map(|_| stratum[rng.below(stratum.len())]));
            }
            statistic(&drawn)
        })
        .collect();
    statistics.sort_by(f64::total_cmp);
    let tail = (1.0 - confidence) / 2.0;
    Some(Interval { low: quantile(&statistics, tail), high: quantile(&statistics, 1.0 - tail) })
}

/// The quantile of sorted values, by straight lines between them.
fn quantile(sorted: &[f64], p: f64) -> f64 {
    let at = p * (sorted.len() - 1) as f64;
    let below = at as usize;
    let above = (below + 1).min(sorted.len() - 1);
    sorted[below] + (sorted[above] - sorted[below]) * (at - below as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rng::Purpose;

    /// P(X ≤ k) for X binomial, summed term by term: the definition of the interval needs nothing else. In logarithms, since
    /// 0.02^200 is below the smallest number.
    fn binomial_at_most(k: u32, n: u32, p: f64) -> f64 {
        let mut log_term = f64::from(n) * (1.0 - p).ln();
        let mut sum = log_term.exp();
        for i in 0..k {
            log_term += (f64::from(n - i) / f64::from(i + 1)).ln() + p.ln() - (1.0 - p).ln();
            sum += log_term.exp();
        }
        sum
    }

    #[test]
    fn clopper_pearson_agrees_with_published_values() {
        // scipy.stats.binomtest(k, n).proportion_ci(0.95, 'exact'); 200/200 is also 0.025^(1/200).
        for (k, n, low, high) in
            [(200, 200, 0.981_724, 1.0), (0, 10, 0.0, 0.308_497), (5, 10, 0.187_086, 0.812_914), (1, 10, 0.002_529, 0.445_016)]
        {
            let i = clopper_pearson(k, n, 0.95);
            assert!((i.low - low).abs() < 1e-5 && (i.high - high).abs() < 1e-5, "{k}/{n}: {i:?}");
        }
    }

    #[test]
    fn clopper_pearson_meets_its_definition() {
        for n in [1, 2, 7, 50, 200] {
            for k in 0..=n {
                let i = clopper_pearson(k, n, 0.95);
                if k > 0 {
                    let above = 1.0 - binomial_at_most(k - 1, n, i.low);
                    assert!((above - 0.025).abs() < 1e-6, "{k}/{n} low {}: {above}", i.low);
                }
                if k < n {
                    let below = binomial_at_most(k, n, i.high);
                    assert!((below - 0.025).abs() < 1e-6, "{k}/{n} high {}: {below}", i.high);
                }
            }
        }
        assert_eq!(clopper_pearson(0, 0, 0.95), Interval { low: 0.0, high: 1.0 });
    }

    #[test]
    fn the_interquartile_mean_cuts_a_quarter_off_each_end() {
        assert_eq!(interquartile_mean(&[100.0, 2.0, 3.0, -50.0]), 2.5);
        assert_eq!(interquartile_mean(&[7.0]), 7.0);
        // Of five values the middle three count with 0.75, 1 and 0.75.
        let of_five = interquartile_mean(&[0.0, 1.0, 2.0, 4.0, 100.0]);
        assert!((of_five - (0.75 * 1.0 + 2.0 + 0.75 * 4.0) / 2.5).abs() < 1e-12);
    }

    #[test]
    fn the_bootstrap_of_a_mean_has_the_width_that_theory_gives() {
        let mut rng = Rng::new(1, Purpose::Tool);
        let values: Vec<f64> = (0..400).map(|_| f64::from(rng.normal())).collect();
        let i = stratified_bootstrap(&[&values], mean, 0.95, 2000, &mut rng).unwrap();
        let deviation = (values.iter().map(|v| (v - mean(&values)).powi(2)).sum::<f64>() / 400.0).sqrt();
        let expected = 2.0 * 1.96 * deviation / 20.0;
        assert!(((i.high - i.low) / expected - 1.0).abs() < 0.1, "{i:?} against a width of {expected}");
        assert_eq!(stratified_bootstrap(&[], mean, 0.95, 10, &mut rng), None);
        let constant = stratified_bootstrap(&[&[1.0, 1.0], &[0.0]], mean, 0.95, 10, &mut rng).unwrap();
        assert!((constant.low - 2.0 / 3.0).abs() < 1e-12 && constant.low == constant.high);
    }
}
