//! A batch's way through one network, forward and back, in buffers that are allocated once.

use super::adam::{Descend, Step};
use super::buffer::Buffer;
use super::head::{HeadGradient, WeightedSums, Weights};
use super::lanes::{Kernel, LANES};
use super::layout::{Layout, panels, stride};
use super::norm::{Normalise, NormaliseGradient};
use super::product::{Finish, Product, Start, Transpose, WeightGradient};

/// Copies row-major `values` into columns `from..` of the activations `to`.
pub fn pack(to: &mut [f32], rows: usize, from: usize, values: &[f32]) {
    let columns = values.len() / rows;
    let (step, mut column) = (stride(rows), 0);
    while column < columns {
        let (panel, lane) = ((from + column) / LANES, (from + column) % LANES);
        let count = (LANES - lane).min(columns - column);
        for row in 0..rows {
            let at = panel * step + row * LANES + lane;
            to[at..at + count].copy_from_slice(&values[row * columns + column..][..count]);
        }
        column += count;
    }
}

/// What a batch leaves in a network on its way forward.
#[derive(Clone, Debug, Default)]
pub struct Trace {
    /// Of each hidden layer: what its ReLU wrote.
    activations: Vec<Buffer>,
    /// Of each normalised layer: the normalised sums, and one over each row's standard deviation.
    normal: Vec<(Buffer, Buffer)>,
    /// rows × outputs, row-major: what the output layer wrote.
    pub output: Vec<f32>,
}

impl Trace {
    /// For batches of up to `rows` rows.
    pub fn new(layout: &Layout, rows: usize) -> Trace {
        let sheet = |columns: usize| Buffer::zeros(panels(columns) * stride(rows));
        let normalised = layout.hidden.iter().filter(|dense| dense.normalised);
        Trace {
            activations: layout.hidden.iter().map(|dense| sheet(dense.outputs)).collect(),
            normal: normalised.map(|dense| (sheet(dense.outputs), Buffer::zeros(rows))).collect(),
            output: vec![0.0; rows * layout.head.outputs],
        }
    }

    /// Runs the rows of `input` through the network with these parameters; the output layer's sums are in `output`.
    pub fn forward(&mut self, kernel: Kernel, layout: &Layout, parameters: &[f32], input: &[f32], rows: usize) {
        for (layer, dense) in layout.hidden.iter().enumerate() {
            let (before, after) = self.activations.split_at_mut(layer);
            let x = before.last().map_or(input, |x| x);
            let w = &parameters[dense.offset..];
            let (columns, panel) = (dense.outputs, dense.panel());
            let product = |y, finish| Product { rows, depth: dense.inputs, columns, x, w, panel, start: Start::Bias, y, finish };
            if dense.normalised {
                let (sums, scales) = &mut self.normal[layer];
                kernel.run(product(sums, Finish::Linear));
                let gains = &w[(dense.inputs + 1) * LANES..];
                kernel.run(Normalise { rows, columns, gains, panel, sums, scales, y: &mut after[0] });
            } else {
                kernel.run(product(&mut after[0], Finish::Rectified));
            }
        }
        let head = &layout.head;
        let w = Weights { parameters, from: head.offset, output: head.row(), panel: LANES };
        let x = &self.activations[layout.hidden.len() - 1];
        let y = &mut self.output[..rows * head.outputs];
        kernel.run(WeightedSums { rows, depth: head.inputs, outputs: head.outputs, x, w, y });
        let biases = &parameters[head.biases()..][..head.outputs];
        for row in y.chunks_exact_mut(head.outputs) {
            row.iter_mut().zip(biases).for_each(|(sum, bias)| *sum += bias);
        }
    }
}

/// Scratch of the way back.
#[derive(Clone, Debug, Default)]
pub struct Slopes {
    /// After [`Slopes::backward`]: derivatives by the first hidden layer's sums.
    first: Buffer,
    other: Buffer,
    transposed: Buffer,
}

impl Slopes {
    /// For batches of up to `rows` rows through any of the networks.
    pub fn new(layouts: &[&Layout], rows: usize) -> Slopes {
        let columns = layouts.iter().flat_map(|layout| &layout.hidden).map(|dense| dense.outputs).max().unwrap_or(0);
        let transposed = layouts.iter().map(|layout| layout.transposed_len()).max().unwrap_or(0);
        let sheet = Buffer::zeros(panels(columns) * stride(rows));
        Slopes { first: sheet.clone(), other: sheet, transposed: Buffer::zeros(transposed) }
    }

    /// From `by_output` (rows × outputs, the derivatives of a loss by the output layer's sums) back through the network that
    /// `trace` came through. Writes the derivatives by the parameters to `gradient`, every number of it, unless it is empty.
    pub fn backward(
        &mut self,
        kernel: Kernel,
        network: (&Layout, &[f32]),
        trace: (&Trace, &[f32]),
        by_output: &[f32],
        gradient: &mut [f32],
    ) {
        let ((layout, parameters), (trace, input)) = (network, trace);
        let head = &layout.head;
        let rows = by_output.len() / head.outputs;
        let wanted = !gradient.is_empty();
        // A part of the gradient, or nothing where none is wanted.
        fn part(gradient: &mut [f32], from: usize) -> &mut [f32] {
            let from = from.min(gradient.len());
            &mut gradient[from..]
        }
        kernel.run(HeadGradient {
            rows,
            depth: head.inputs,
            outputs: head.outputs,
            x: &trace.activations[layout.hidden.len() - 1],
            dy: by_output,
            w: &parameters[head.offset..],
            dw: part(gradient, head.offset),
            dx: &mut self.first,
        });
        if wanted {
            let biases = &mut gradient[head.biases()..];
            biases.fill(0.0);
            for row in by_output.chunks_exact(head.outputs) {
                biases.iter_mut().zip(row).for_each(|(sum, slope)| *sum += slope);
            }
        }
        for (layer, dense) in layout.hidden.iter().enumerate().rev() {
            let (w, panel, columns) = (&parameters[dense.offset..], dense.panel(), dense.outputs);
            if dense.normalised {
                let (gains, gradient) =
                    (&w[(dense.inputs + 1) * LANES..], part(gradient, dense.offset + (dense.inputs + 1) * LANES));
                let (normal, scales) = &trace.normal[layer];
                kernel.run(NormaliseGradient { rows, columns, gains, panel, normal, scales, slopes: &mut self.first, gradient });
            }
            if wanted {
                let x = if layer == 0 { input } else { &trace.activations[layer - 1] };
                let dw = part(gradient, dense.offset);
                kernel.run(WeightGradient { rows, depth: dense.inputs, columns, x, dy: &self.first, dw, panel });
            }
            if layer > 0 {
                kernel.run(Transpose { inputs: dense.inputs, outputs: columns, w, panel, to: &mut self.transposed });
                kernel.run(Product {
                    rows,
                    depth: columns,
                    columns: dense.inputs,
                    x: &self.first,
                    w: &self.transposed,
                    panel: columns * LANES,
                    start: Start::Zero,
                    y: &mut self.other,
                    finish: Finish::WherePositive(&trace.activations[layer - 1]),
                });
                std::mem::swap(&mut self.first, &mut self.other);
            }
        }
    }

    /// After [`Slopes::backward`]: the derivatives by the network's inputs from the column `from` on, rows × columns, row-major.
    pub fn by_input(&self, kernel: Kernel, (layout, parameters): (&Layout, &[f32]), from: usize, rows: usize, to: &mut [f32]) {
        let dense = &layout.hidden[0];
        let w = Weights { parameters, from: dense.offset + from * LANES, output: LANES, panel: dense.panel() };
        kernel.run(WeightedSums { rows, depth: dense.outputs, outputs: to.len() / rows, x: &self.first, w, y: to });
    }
}

/// A network's parameters, their target and Adam's memory, each in one buffer of the same layout.
#[derive(Clone, Debug)]
pub struct Trained {
    /// Where each parameter lies.
    pub layout: Layout,
    /// θ.
    pub parameters: Buffer,
    /// θ'.
    pub target: Buffer,
    /// First moments.
    pub m: Buffer,
    /// Second moments.
    pub v: Buffer,
    /// Steps taken.
    pub steps: u32,
}

/// Whether a target follows its network's step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Target {
    /// It moves by τ.
    Follows,
    /// It stays.
    Stays,
}

impl Trained {
    /// All parameters 0, no steps taken.
    pub fn new(layout: Layout) -> Trained {
        let zeros = Buffer::zeros(layout.len());
        Trained { layout, parameters: zeros.clone(), target: zeros.clone(), m: zeros.clone(), v: zeros, steps: 0 }
    }

    /// One step of Adam against `gradient`.
    pub fn descend(
        &mut self,
        kernel: Kernel,
        gradient: &[f32],
        rate: f32,
        settings: &super::super::actor_critic::OptimiserSettings,
        target: Target,
    ) {
        self.steps = self.steps.saturating_add(1);
        kernel.run(Descend {
            step: Step::new(self.steps, rate, settings),
            gradient,
            parameters: &mut self.parameters,
            m: &mut self.m,
            v: &mut self.v,
            target: if target == Target::Follows { &mut self.target } else { &mut [] },
        });
    }
}
