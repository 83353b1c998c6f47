//! Where each parameter of a network lies in its flat buffer, and how activations lie in panels.

use super::super::tensors::Widths;
use super::lanes::LANES;

/// Panels of [`LANES`] columns that hold `columns` columns.
pub fn panels(columns: usize) -> usize {
    columns.div_ceil(LANES)
}

/// Numbers from one panel of a batch's activations to the next: panel after panel, in each row after row of [`LANES`] numbers.
/// Odd numbers of rows keep panels from falling on the same lines of the cache.
pub fn stride(rows: usize) -> usize {
    (rows | 1) * LANES
}

/// A hidden layer. Its parameters lie in panels of [`LANES`] outputs, in each the weights of input after input, then the biases,
/// and where it is normalised gains and shifts. Columns beyond the outputs hold 0 and stay so.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Dense {
    /// Numbers it reads.
    pub inputs: usize,
    /// Numbers it writes.
    pub outputs: usize,
    /// Whether gains and shifts follow the biases.
    pub normalised: bool,
    /// Where its parameters begin.
    pub offset: usize,
}

impl Dense {
    /// Numbers in one panel of its parameters.
    pub fn panel(&self) -> usize {
        (self.inputs + if self.normalised { 3 } else { 1 }) * LANES
    }

    fn len(&self) -> usize {
        panels(self.outputs) * self.panel()
    }
}

/// The output layer. Its parameters lie output after output, each with the weights of all inputs (filled up with 0 to whole
/// panels), then all biases (filled up likewise).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Head {
    /// Numbers it reads.
    pub inputs: usize,
    /// Numbers it writes.
    pub outputs: usize,
    /// Where its parameters begin.
    pub offset: usize,
}

impl Head {
    /// Numbers from the weights of one output to those of the next.
    pub fn row(&self) -> usize {
        panels(self.inputs) * LANES
    }

    /// Where its biases begin.
    pub fn biases(&self) -> usize {
        self.offset + self.outputs * self.row()
    }

    fn len(&self) -> usize {
        self.outputs * self.row() + panels(self.outputs) * LANES
    }
}

/// The layers of a network in its buffer.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Layout {
    /// The hidden layers in order.
    pub hidden: Vec<Dense>,
    /// The output layer.
    pub head: Head,
}

impl Layout {
    /// The layout of a network with these widths.
    pub fn new(widths: &Widths) -> Layout {
        let (&[.., inputs, outputs], layers) = (widths.layers.as_slice(), widths.layers.len()) else {
            unreachable!("a network has an input and an output");
        };
        let (mut hidden, mut offset) = (Vec::new(), 0);
        for pair in widths.layers[..layers - 1].windows(2) {
            let dense = Dense { inputs: pair[0], outputs: pair[1], normalised: widths.normalised, offset };
            offset += dense.len();
            hidden.push(dense);
        }
        Layout { hidden, head: Head { inputs, outputs, offset } }
    }

    /// Numbers in the buffer, those that fill up included.
    pub fn len(&self) -> usize {
        self.head.offset + self.head.len()
    }

    /// Width of the widest hidden layer's transposed weights: numbers that a scratch buffer for them needs.
    pub fn transposed_len(&self) -> usize {
        self.hidden.iter().skip(1).map(|dense| panels(dense.inputs) * dense.outputs * LANES).max().unwrap_or(0)
    }

    /// Calls `each` with the place in the buffer of every number of the `tensor`-th of [`Widths::tensors`], row-major.
    pub fn places(&self, tensor: usize, mut each: impl FnMut(usize)) {
        let per_layer = if self.hidden[0].normalised { 4 } else { 2 };
        let kind = tensor % per_layer;
        match self.hidden.get(tensor / per_layer) {
            Some(dense) => {
                let place = |i: usize, o: usize| dense.offset + o / LANES * dense.panel() + i * LANES + o % LANES;
                let rows = if kind == 0 { 0..dense.inputs } else { dense.inputs + kind - 1..dense.inputs + kind };
                rows.for_each(|i| (0..dense.outputs).for_each(|o| each(place(i, o))));
            }
            None if kind == 0 => {
                let place = |i: usize, o: usize| self.head.offset + o * self.head.row() + i;
                (0..self.head.inputs).for_each(|i| (0..self.head.outputs).for_each(|o| each(place(i, o))));
            }
            None => (0..self.head.outputs).for_each(|o| each(self.head.biases() + o)),
        }
    }
}
