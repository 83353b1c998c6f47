//! The matrix products of hidden layers: forward, by the input and by the weights, each in register tiles with a fixed order of
//! summation.
#![allow(unsafe_code)]
// Loops over the rows and panels of a register tile are named by their indices.
#![allow(clippy::needless_range_loop)]

use super::lanes::{LANES, Lanes, Work};
use super::layout::{panels, stride};

/// What happens to a sum before it is written.
#[derive(Clone, Copy)]
pub enum Finish<'a> {
    /// Nothing.
    Linear,
    /// `max(sum, 0)`.
    Rectified,
    /// The sum where these activations are positive, else 0: the way back through a ReLU. They lie as the product's output does.
    WherePositive(&'a [f32]),
}

/// `y = finish(bias + x·w)` for `rows` rows.
pub struct Product<'a> {
    /// Rows of `x` and `y`.
    pub rows: usize,
    /// Columns of `x`, rows of `w`.
    pub depth: usize,
    /// Columns of `w` and `y`.
    pub columns: usize,
    /// Activations: panels of `rows`.
    pub x: &'a [f32],
    /// Panels of `depth` rows, the biases in the row after the last if `biased`.
    pub w: &'a [f32],
    /// Numbers from one panel of `w` to the next.
    pub panel: usize,
    /// Whether sums begin with the biases or with 0.
    pub start: Start,
    /// Activations: panels of `rows`.
    pub y: &'a mut [f32],
    /// Applied to each sum.
    pub finish: Finish<'a>,
}

/// What a sum begins with.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// 0.
    Zero,
    /// The row of `w` after the last.
    Bias,
}

impl Work for Product<'_> {
    type Output = ();

    #[inline(always)]
    unsafe fn run<L: Lanes>(self) {
        let (x_step, outputs) = (stride(self.rows), panels(self.columns));
        assert!(self.depth > 0 && self.rows > 0 && outputs > 0);
        assert!(self.x.len() >= (panels(self.depth) - 1) * x_step + self.rows * LANES);
        let end = (outputs - 1) * x_step + self.rows * LANES;
        assert!(self.y.len() >= end);
        let bias = usize::from(self.start == Start::Bias);
        assert!(self.w.len() >= (outputs - 1) * self.panel + (self.depth + bias) * LANES);
        if let Finish::WherePositive(activations) = self.finish {
            assert!(activations.len() >= end);
        }
        let tile = Tile { x_step, depth: self.depth, panel: self.panel, start: self.start };
        // SAFETY: the assertions keep every tile's reads and writes inside the slices; the caller vouches for `L`.
        unsafe {
            if self.rows == 1 {
                // One row has too few sums to hide the latency of an addition: take four panels at once.
                let mut p = 0;
                while p + 4 <= outputs {
                    tile.run::<L, 1, 4>(self.x.as_ptr(), self.w.as_ptr().add(p * self.panel), self.y, p * x_step, self.finish);
                    p += 4;
                }
                while p < outputs {
                    tile.run::<L, 1, 1>(self.x.as_ptr(), self.w.as_ptr().add(p * self.panel), self.y, p * x_step, self.finish);
                    p += 1;
                }
                return;
            }
            for p in 0..outputs {
                let w = self.w.as_ptr().add(p * self.panel);
                let mut row = 0;
                while row < self.rows {
                    let (x, to) = (self.x.as_ptr().add(row * LANES), p * x_step + row * LANES);
                    let count = L::ROWS.min(self.rows - row);
                    match count {
                        6 => tile.run::<L, 6, 1>(x, w, self.y, to, self.finish),
                        5 => tile.run::<L, 5, 1>(x, w, self.y, to, self.finish),
                        4 => tile.run::<L, 4, 1>(x, w, self.y, to, self.finish),
                        3 => tile.run::<L, 3, 1>(x, w, self.y, to, self.finish),
                        2 => tile.run::<L, 2, 1>(x, w, self.y, to, self.finish),
                        _ => tile.run::<L, 1, 1>(x, w, self.y, to, self.finish),
                    }
                    row += count;
                }
            }
        }
    }
}

/// What all register tiles of a product share.
#[derive(Clone, Copy)]
struct Tile {
    x_step: usize,
    depth: usize,
    panel: usize,
    start: Start,
}

impl Tile {
    /// `R` rows times `P` panels, written to `y[to..]`.
    ///
    /// # Safety
    /// Rows and panels lie inside the buffers; the processor has the instructions of `L`.
    #[inline(always)]
    unsafe fn run<L: Lanes, const R: usize, const P: usize>(
        self,
        x: *const f32,
        w: *const f32,
        y: &mut [f32],
        to: usize,
        finish: Finish<'_>,
    ) {
        // SAFETY: the caller's promise.
        unsafe {
            let mut sums = [[L::splat(0.0); P]; R];
            if self.start == Start::Bias {
                for p in 0..P {
                    let bias = L::load(w.add(p * self.panel + self.depth * LANES));
                    for row in &mut sums {
                        row[p] = bias;
                    }
                }
            }
            let mut w = w;
            let (mut x, mut left) = (x, self.depth);
            loop {
                let columns = left.min(LANES);
                for i in 0..columns {
                    let mut weights = [L::splat(0.0); P];
                    for p in 0..P {
                        weights[p] = L::load(w.add(p * self.panel));
                    }
                    for r in 0..R {
                        let input = L::splat(*x.add(r * LANES + i));
                        for p in 0..P {
                            sums[r][p] = sums[r][p].plus_product(input, weights[p]);
                        }
                    }
                    w = w.add(LANES);
                }
                left -= columns;
                if left == 0 {
                    break;
                }
                x = x.add(self.x_step);
            }
            for r in 0..R {
                for p in 0..P {
                    let at = to + p * self.x_step + r * LANES;
                    let value = match finish {
                        Finish::Linear => sums[r][p],
                        Finish::Rectified => sums[r][p].rectified(),
                        Finish::WherePositive(of) => sums[r][p].where_positive(L::load(of.as_ptr().add(at))),
                    };
                    value.store(y.as_mut_ptr().add(at));
                }
            }
        }
    }
}

/// The derivative by a hidden layer's weights and biases: `xᵀ·dy` and the column sums of `dy`, written where the parameters lie.
pub struct WeightGradient<'a> {
    /// Rows of `x` and `dy`.
    pub rows: usize,
    /// Columns of `x`.
    pub depth: usize,
    /// Columns of `dy`.
    pub columns: usize,
    /// Activations: panels of `rows`.
    pub x: &'a [f32],
    /// Derivatives by the layer's sums: panels of `rows`.
    pub dy: &'a [f32],
    /// Panels of `depth + 1` rows.
    pub dw: &'a mut [f32],
    /// Numbers from one panel of `dw` to the next.
    pub panel: usize,
}

impl Work for WeightGradient<'_> {
    type Output = ();

    #[inline(always)]
    unsafe fn run<L: Lanes>(self) {
        let (step, outputs) = (stride(self.rows), panels(self.columns));
        assert!(self.depth > 0 && self.rows > 0 && outputs > 0);
        assert!(self.x.len() >= (panels(self.depth) - 1) * step + self.rows * LANES);
        assert!(self.dy.len() >= (outputs - 1) * step + self.rows * LANES);
        assert!(self.dw.len() >= (outputs - 1) * self.panel + (self.depth + 1) * LANES);
        // SAFETY: the assertions keep every tile's reads and writes inside the slices; the caller vouches for `L`.
        unsafe {
            for p in 0..outputs {
                let dy = self.dy.as_ptr().add(p * step);
                let dw = self.dw.as_mut_ptr().add(p * self.panel);
                for q in 0..panels(self.depth) {
                    let (x, dw) = (self.x.as_ptr().add(q * step), dw.add(q * LANES * LANES));
                    // Tiles of nearly equal height: 16 columns are 6 + 5 + 5 rather than 6 + 6 + 4.
                    let columns = LANES.min(self.depth - q * LANES);
                    let (mut i, mut tiles) = (0, columns.div_ceil(L::ROWS));
                    while tiles > 0 {
                        let count = (columns - i).div_ceil(tiles);
                        let (x, dw) = (x.add(i), dw.add(i * LANES));
                        match count {
                            6 => outer_tile::<L, 6>(self.rows, x, dy, dw),
                            5 => outer_tile::<L, 5>(self.rows, x, dy, dw),
                            4 => outer_tile::<L, 4>(self.rows, x, dy, dw),
                            3 => outer_tile::<L, 3>(self.rows, x, dy, dw),
                            2 => outer_tile::<L, 2>(self.rows, x, dy, dw),
                            _ => outer_tile::<L, 1>(self.rows, x, dy, dw),
                        }
                        i += count;
                        tiles -= 1;
                    }
                }
                column_sums::<L>(self.rows, dy, dw.add(self.depth * LANES));
            }
        }
    }
}

/// `R` columns of `x` against one panel of `dy`.
///
/// # Safety
/// Columns and rows lie inside the buffers; the processor has the instructions of `L`.
#[inline(always)]
unsafe fn outer_tile<L: Lanes, const R: usize>(rows: usize, x: *const f32, dy: *const f32, dw: *mut f32) {
    // SAFETY: the caller's promise.
    unsafe {
        let mut sums = [L::splat(0.0); R];
        for row in 0..rows {
            let slope = L::load(dy.add(row * LANES));
            for r in 0..R {
                sums[r] = sums[r].plus_product(L::splat(*x.add(row * LANES + r)), slope);
            }
        }
        for r in 0..R {
            sums[r].store(dw.add(r * LANES));
        }
    }
}

/// The sums of one panel's columns, in four interleaved chains of rows.
///
/// # Safety
/// The rows lie inside the buffer; the processor has the instructions of `L`.
#[inline(always)]
pub unsafe fn column_sums<L: Lanes>(rows: usize, from: *const f32, to: *mut f32) {
    // SAFETY: the caller's promise.
    unsafe {
        let mut sums = [L::splat(0.0); 4];
        let mut row = 0;
        while row + 4 <= rows {
            for chain in 0..4 {
                sums[chain] = sums[chain].plus(L::load(from.add((row + chain) * LANES)));
            }
            row += 4;
        }
        while row < rows {
            sums[0] = sums[0].plus(L::load(from.add(row * LANES)));
            row += 1;
        }
        sums[0].plus(sums[1]).plus(sums[2].plus(sums[3])).store(to);
    }
}

/// A hidden layer's weights with inputs and outputs exchanged: panels of [`LANES`] inputs, in each output after output. Columns
/// beyond the inputs hold 0.
pub struct Transpose<'a> {
    /// The layer's inputs.
    pub inputs: usize,
    /// The layer's outputs.
    pub outputs: usize,
    /// Panels of outputs.
    pub w: &'a [f32],
    /// Numbers from one panel of `w` to the next.
    pub panel: usize,
    /// Panels of inputs, `outputs` rows each.
    pub to: &'a mut [f32],
}

impl Work for Transpose<'_> {
    type Output = ();

    #[inline(always)]
    unsafe fn run<L: Lanes>(self) {
        for (q, to) in self.to.chunks_exact_mut(self.outputs * LANES).take(panels(self.inputs)).enumerate() {
            let width = LANES.min(self.inputs - q * LANES);
            for (p, to) in to.chunks_mut(LANES * LANES).enumerate() {
                let from = &self.w[p * self.panel + q * LANES * LANES..][..width * LANES];
                for (o, to) in to.chunks_exact_mut(LANES).enumerate() {
                    for (i, to) in to.iter_mut().enumerate() {
                        *to = if i < width { from[i * LANES + o] } else { 0.0 };
                    }
                }
            }
        }
    }
}
