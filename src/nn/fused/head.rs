//! Output layers, whose few columns would waste whole panels: weighted sums of rows forward, and both derivatives in one pass
//! back.
#![allow(unsafe_code)]
// Loops over the rows and panels of a register tile are named by their indices.
#![allow(clippy::needless_range_loop)]

use super::lanes::{LANES, Lanes, Work};
use super::layout::{panels, stride};

/// For each row and each of a few outputs: the sum of the row's activations weighted by the output's weights.
pub struct WeightedSums<'a> {
    /// Rows of `x` and `y`.
    pub rows: usize,
    /// Columns of `x`.
    pub depth: usize,
    /// Outputs a row.
    pub outputs: usize,
    /// Activations: panels of `rows`.
    pub x: &'a [f32],
    /// The weights.
    pub w: Weights<'a>,
    /// rows × outputs, row-major.
    pub y: &'a mut [f32],
}

/// Vectors of weights: panel `p` of output `o` at `from + o · output + p · panel`.
#[derive(Clone, Copy)]
pub struct Weights<'a> {
    /// The parameters.
    pub parameters: &'a [f32],
    /// Where the first vector begins.
    pub from: usize,
    /// Numbers from one output to the next.
    pub output: usize,
    /// Numbers from one panel to the next.
    pub panel: usize,
}

impl Work for WeightedSums<'_> {
    type Output = ();

    #[inline(always)]
    unsafe fn run<L: Lanes>(self) {
        let (step, depth) = (stride(self.rows), panels(self.depth));
        let Weights { parameters, from, output, panel } = self.w;
        assert!(depth > 0 && self.rows > 0 && self.outputs > 0);
        assert!(self.x.len() >= (depth - 1) * step + self.rows * LANES);
        assert!(self.y.len() >= self.rows * self.outputs);
        assert!(parameters.len() >= from + (self.outputs - 1) * output + (depth - 1) * panel + LANES);
        // SAFETY: the assertions keep reads and writes inside the slices; the caller vouches for `L`.
        unsafe {
            for o in 0..self.outputs {
                let w = parameters.as_ptr().add(from + o * output);
                let mut row = 0;
                while row < self.rows {
                    let x = self.x.as_ptr().add(row * LANES);
                    let y = self.y.as_mut_ptr().add(row * self.outputs + o);
                    if row + 4 <= self.rows {
                        sums::<L, 4>(depth, x, step, w, panel, y, self.outputs);
                        row += 4;
                    } else {
                        sums::<L, 1>(depth, x, step, w, panel, y, self.outputs);
                        row += 1;
                    }
                }
            }
        }
    }
}

/// `R` rows against one output.
///
/// # Safety
/// Rows and weights lie inside the buffers; the processor has the instructions of `L`.
#[inline(always)]
unsafe fn sums<L: Lanes, const R: usize>(
    depth: usize,
    x: *const f32,
    step: usize,
    w: *const f32,
    panel: usize,
    y: *mut f32,
    y_step: usize,
) {
    // SAFETY: the caller's promise.
    unsafe {
        let mut sums = [L::splat(0.0); R];
        for p in 0..depth {
            let weights = L::load(w.add(p * panel));
            for r in 0..R {
                sums[r] = sums[r].plus_product(L::load(x.add(p * step + r * LANES)), weights);
            }
        }
        for r in 0..R {
            *y.add(r * y_step) = sums[r].sum();
        }
    }
}

/// The way back through an output layer: the derivative by its weights, and by its inputs through their ReLU.
pub struct HeadGradient<'a> {
    /// Rows of `x`, `dy` and `dx`.
    pub rows: usize,
    /// Columns of `x`.
    pub depth: usize,
    /// Columns of `dy`.
    pub outputs: usize,
    /// The layer's inputs, which a ReLU wrote: panels of `rows`.
    pub x: &'a [f32],
    /// rows × outputs, row-major: the derivatives by the outputs' sums.
    pub dy: &'a [f32],
    /// The layer's parameters: vectors of weights, output after output.
    pub w: &'a [f32],
    /// Where to write the derivative by the weights, laid out as they are; nowhere if it is empty.
    pub dw: &'a mut [f32],
    /// Where to write the derivative by what the ReLU read: panels of `rows`.
    pub dx: &'a mut [f32],
}

impl Work for HeadGradient<'_> {
    type Output = ();

    #[inline(always)]
    unsafe fn run<L: Lanes>(mut self) {
        let (step, depth) = (stride(self.rows), panels(self.depth));
        assert!(depth > 0 && self.rows > 0 && self.outputs > 0);
        assert!(self.x.len() >= (depth - 1) * step + self.rows * LANES);
        assert!(self.dx.len() >= (depth - 1) * step + self.rows * LANES);
        assert!(self.dy.len() >= self.rows * self.outputs);
        assert!(self.w.len() >= self.outputs * depth * LANES);
        assert!(self.dw.is_empty() || self.dw.len() >= self.outputs * depth * LANES);
        // SAFETY: the assertions keep reads and writes inside the slices; the caller vouches for `L`.
        unsafe {
            let mut o = 0;
            while o < self.outputs {
                if o + 2 <= self.outputs {
                    self.pass::<L, 2>(o);
                    o += 2;
                } else {
                    self.pass::<L, 1>(o);
                    o += 1;
                }
            }
        }
    }
}

impl HeadGradient<'_> {
    /// `O` outputs from the `first`-th on.
    ///
    /// # Safety
    /// The slices are long enough; the processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn pass<L: Lanes, const O: usize>(&mut self, first: usize) {
        let (step, depth) = (stride(self.rows), panels(self.depth));
        // SAFETY: the caller's promise.
        unsafe {
            let dy = self.dy.as_ptr().add(first);
            for p in 0..depth {
                let (x, dx) = (self.x.as_ptr().add(p * step), self.dx.as_mut_ptr().add(p * step));
                let mut weights = [L::splat(0.0); O];
                for o in 0..O {
                    weights[o] = L::load(self.w.as_ptr().add(((first + o) * depth + p) * LANES));
                }
                let mut sums = [L::splat(0.0); O];
                for row in 0..self.rows {
                    let input = L::load(x.add(row * LANES));
                    let mut slope = if first == 0 { L::splat(0.0) } else { L::load(dx.add(row * LANES)) };
                    for o in 0..O {
                        let by_output = L::splat(*dy.add(row * self.outputs + o));
                        slope = slope.plus_product(by_output, weights[o]);
                        sums[o] = sums[o].plus_product(by_output, input);
                    }
                    slope.where_positive(input).store(dx.add(row * LANES));
                }
                if !self.dw.is_empty() {
                    for o in 0..O {
                        sums[o].store(self.dw.as_mut_ptr().add(((first + o) * depth + p) * LANES));
                    }
                }
            }
        }
    }
}
