//! Layer norm of a hidden layer's sums, forward with the ReLU and back.
#![allow(unsafe_code)]

use super::super::tensors::NORM_EPSILON;
use super::lanes::{LANES, Lanes, Work};
use super::layout::{panels, stride};

/// Normalises each row of sums and applies gain, shift and ReLU ([Ba et al. 2016](crate::bib::Ba2016)).
pub struct Normalise<'a> {
    /// Rows of `sums` and `y`.
    pub rows: usize,
    /// Columns of `sums` and `y`.
    pub columns: usize,
    /// Gains and shifts: two vectors for each panel.
    pub gains: &'a [f32],
    /// Numbers from the gains of one panel to those of the next.
    pub panel: usize,
    /// The sums, replaced by the normalised ones: panels of `rows`.
    pub sums: &'a mut [f32],
    /// One over each row's standard deviation.
    pub scales: &'a mut [f32],
    /// Activations: panels of `rows`.
    pub y: &'a mut [f32],
}

/// 1 for the columns of a last panel that exist, 0 for those that fill it up.
fn existing(columns: usize) -> [f32; LANES] {
    let last = columns - (panels(columns) - 1) * LANES;
    std::array::from_fn(|i| if i < last { 1.0 } else { 0.0 })
}

impl Work for Normalise<'_> {
    type Output = ();

    #[inline(always)]
    unsafe fn run<L: Lanes>(self) {
        let (step, count) = (stride(self.rows), panels(self.columns));
        let end = (count - 1) * step + self.rows * LANES;
        assert!(self.sums.len() >= end && self.y.len() >= end && self.scales.len() >= self.rows);
        assert!(self.gains.len() >= (count - 1) * self.panel + 2 * LANES);
        let (last, share) = (existing(self.columns), 1.0 / self.columns as f32);
        // SAFETY: the assertions keep reads and writes inside the slices; the caller vouches for `L`.
        unsafe {
            for row in 0..self.rows {
                let sums = self.sums.as_mut_ptr().add(row * LANES);
                let mut total = L::splat(0.0);
                for p in 0..count {
                    total = total.plus(L::load(sums.add(p * step)));
                }
                let mean = L::splat(total.sum() * share);
                let mut squares = L::splat(0.0);
                for p in 0..count {
                    let mut centred = L::load(sums.add(p * step)).minus(mean);
                    if p + 1 == count {
                        centred = centred.times(L::load(last.as_ptr()));
                    }
                    squares = squares.plus_product(centred, centred);
                    centred.store(sums.add(p * step));
                }
                let scale = 1.0 / (squares.sum() * share + NORM_EPSILON as f32).sqrt();
                self.scales[row] = scale;
                for p in 0..count {
                    let normal = L::load(sums.add(p * step)).times(L::splat(scale));
                    normal.store(sums.add(p * step));
                    let gain = self.gains.as_ptr().add(p * self.panel);
                    let y = L::load(gain.add(LANES)).plus_product(normal, L::load(gain));
                    y.rectified().store(self.y.as_mut_ptr().add(p * step + row * LANES));
                }
            }
        }
    }
}

/// The way back from gain and shift (the ReLU is passed already) to the layer's sums.
pub struct NormaliseGradient<'a> {
    /// Rows of `normal` and `slopes`.
    pub rows: usize,
    /// Columns of `normal` and `slopes`.
    pub columns: usize,
    /// The gains: one vector for each panel.
    pub gains: &'a [f32],
    /// Numbers from one panel's parameters to the next's, in `gains` and in `gradient`.
    pub panel: usize,
    /// The normalised sums: panels of `rows`.
    pub normal: &'a [f32],
    /// One over each row's standard deviation.
    pub scales: &'a [f32],
    /// The derivatives by what gain and shift wrote, replaced by those by the layer's sums: panels of `rows`.
    pub slopes: &'a mut [f32],
    /// Where to write the derivatives by gains and shifts, two vectors for each panel; nowhere if it is empty.
    pub gradient: &'a mut [f32],
}

impl Work for NormaliseGradient<'_> {
    type Output = ();

    #[inline(always)]
    unsafe fn run<L: Lanes>(self) {
        let (step, count) = (stride(self.rows), panels(self.columns));
        let end = (count - 1) * step + self.rows * LANES;
        assert!(self.normal.len() >= end && self.slopes.len() >= end && self.scales.len() >= self.rows);
        assert!(self.gains.len() >= (count - 1) * self.panel + LANES);
        assert!(self.gradient.is_empty() || self.gradient.len() >= (count - 1) * self.panel + 2 * LANES);
        let (last, share) = (existing(self.columns), 1.0 / self.columns as f32);
        // SAFETY: the assertions keep reads and writes inside the slices; the caller vouches for `L`.
        unsafe {
            if !self.gradient.is_empty() {
                for p in 0..count {
                    let (mut by_gain, mut by_shift) = (L::splat(0.0), L::splat(0.0));
                    for row in 0..self.rows {
                        let at = p * step + row * LANES;
                        let slope = L::load(self.slopes.as_ptr().add(at));
                        by_gain = by_gain.plus_product(slope, L::load(self.normal.as_ptr().add(at)));
                        by_shift = by_shift.plus(slope);
                    }
                    by_gain.store(self.gradient.as_mut_ptr().add(p * self.panel));
                    by_shift.store(self.gradient.as_mut_ptr().add(p * self.panel + LANES));
                }
            }
            for row in 0..self.rows {
                let (normal, slopes) = (self.normal.as_ptr().add(row * LANES), self.slopes.as_mut_ptr().add(row * LANES));
                // Mean and deviation depend on every sum of the row: their shares are the projections on 1 and on `normal`.
                let (mut total, mut along) = (L::splat(0.0), L::splat(0.0));
                for p in 0..count {
                    let slope = L::load(slopes.add(p * step)).times(L::load(self.gains.as_ptr().add(p * self.panel)));
                    slope.store(slopes.add(p * step));
                    total = total.plus(slope);
                    along = along.plus_product(slope, L::load(normal.add(p * step)));
                }
                let (mean, along) = (L::splat(total.sum() * share), L::splat(along.sum() * share));
                for p in 0..count {
                    let normal = L::load(normal.add(p * step));
                    let mut slope = L::load(slopes.add(p * step)).minus(mean).minus(normal.times(along));
                    if p + 1 == count {
                        slope = slope.times(L::load(last.as_ptr()));
                    }
                    slope.times(L::splat(self.scales[row])).store(slopes.add(p * step));
                }
            }
        }
    }
}
