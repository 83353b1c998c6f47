//! One network of burn's layers, its parameters in and out as numbers, and a step of burn's Adam.

use burn::module::{Module, ModuleMapper, ModuleVisitor, Param};
use burn::nn::{LayerNorm, LayerNormConfig, Linear, LinearConfig};
use burn::optim::{Adam, AdamState, AdaptiveMomentumState, Optimizer};
use burn::tensor::activation::{relu, tanh};
use burn::tensor::{Device, Gradients, Tensor, TensorData};

use super::super::tensors::{NORM_EPSILON, Widths};

/// What the output layer ends with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Output {
    /// An actor.
    Tanh,
    /// A critic.
    Linear,
}

#[derive(Module, Debug)]
struct Layer {
    linear: Linear,
    norm: Option<LayerNorm>,
}

/// The layers from the input to the output. Visitors meet the parameters in the order of [`Widths::tensors`].
#[derive(Module, Debug)]
pub struct Network {
    layers: Vec<Layer>,
}

impl Network {
    /// With burn's own initial parameters; a record replaces them.
    pub fn new(widths: &Widths, device: &Device) -> Network {
        let last = widths.layers.len() - 2;
        let layer = |(i, pair): (usize, &[usize])| {
            let norm = LayerNormConfig::new(pair[1]).with_epsilon(NORM_EPSILON);
            Layer {
                linear: LinearConfig::new(pair[0], pair[1]).init(device),
                norm: (widths.normalised && i < last).then(|| norm.init(device)),
            }
        };
        Network { layers: widths.layers.windows(2).enumerate().map(layer).collect() }
    }

    /// rows × input to rows × output.
    pub fn forward(&self, input: Tensor<2>, output: Output) -> Tensor<2> {
        let (last, hidden) = self.layers.split_last().expect("a network has layers");
        let inner = hidden.iter().fold(input, |x, layer| {
            let sums = layer.linear.forward(x);
            relu(match &layer.norm {
                Some(norm) => norm.forward(sums),
                None => sums,
            })
        });
        let sums = last.linear.forward(inner);
        if output == Output::Tanh { tanh(sums) } else { sums }
    }

    /// The numbers of every parameter tensor, row-major.
    pub fn numbers(&self) -> Vec<Vec<f32>> {
        let mut reader = Reader(Vec::new());
        self.visit(&mut reader);
        reader.0
    }

    /// With the parameters replaced by `numbers`, on the network's own device.
    pub fn with_numbers(self, numbers: &[Vec<f32>]) -> Network {
        self.map(&mut Writer(numbers.iter()))
    }

    /// τ·`from` + (1−τ)·`self`.
    pub fn moved(self, from: &Network, tau: f32) -> Network {
        let mut flat = Flat(Vec::new());
        from.visit(&mut flat);
        self.map(&mut Mover { from: flat.0.into_iter(), tau })
    }
}

/// Adam's memory of a network, tensor by tensor, each as one row.
pub type Memory = Vec<Option<AdamState<2>>>;

/// A memory of these moments after `steps` steps.
pub fn memory(steps: u32, m: &[Vec<f32>], v: &[Vec<f32>], device: &Device) -> Memory {
    let row = |numbers: &Vec<f32>| Tensor::<2>::from_data(TensorData::new(numbers.clone(), [1, numbers.len()]), device);
    let state = |(m, v)| AdamState::new(AdaptiveMomentumState::new(steps as usize, row(m), row(v)));
    m.iter().zip(v).map(|pair| (steps > 0).then(|| state(pair))).collect()
}

/// One step of burn's Adam.
pub struct Descend<'a> {
    /// With β₁, β₂ and ε.
    pub adam: Adam,
    /// The learning rate.
    pub rate: f64,
    /// From the loss's backward pass.
    pub gradients: &'a Gradients,
    /// One entry for each tensor that was met so far is replaced.
    pub memory: std::slice::IterMut<'a, Option<AdamState<2>>>,
}

impl ModuleMapper for Descend<'_> {
    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let (id, tensor, mapper) = param.consume();
        let gradient = tensor.grad(self.gradients).expect("every parameter takes part in the loss");
        let (shape, count) = (tensor.shape(), tensor.shape().num_elements());
        let memory = self.memory.next().expect("one memory for each tensor");
        let (row, gradient) = (tensor.inner().reshape([1, count]), gradient.reshape([1, count]));
        let (moved, state) = self.adam.step(self.rate, row, gradient, memory.take());
        *memory = state;
        Param::from_mapped_value(id, Tensor::from_inner(moved.reshape(shape)).require_grad(), mapper)
    }
}

struct Reader(Vec<Vec<f32>>);

impl ModuleVisitor for Reader {
    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        self.0.push(numbers(param.val()));
    }
}

/// The numbers of a tensor, row-major.
pub fn numbers<const D: usize>(tensor: Tensor<D>) -> Vec<f32> {
    tensor.into_data().try_to_vec().expect("networks hold 32-bit floating-point numbers")
}

struct Writer<'a>(std::slice::Iter<'a, Vec<f32>>);

impl ModuleMapper for Writer<'_> {
    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let numbers = self.0.next().expect("as many tensors as the network has");
        param.map(|old| {
            let new = Tensor::from_data(TensorData::new(numbers.clone(), old.shape()), &old.device());
            if old.is_require_grad() { new.require_grad() } else { new }
        })
    }
}

struct Flat(Vec<Tensor<1>>);

impl ModuleVisitor for Flat {
    fn visit_float<const D: usize>(&mut self, param: &Param<Tensor<D>>) {
        self.0.push(param.val().inner().flatten(0, D - 1));
    }
}

struct Mover {
    from: std::vec::IntoIter<Tensor<1>>,
    tau: f32,
}

impl ModuleMapper for Mover {
    fn map_float<const D: usize>(&mut self, param: Param<Tensor<D>>) -> Param<Tensor<D>> {
        let from = self.from.next().expect("as many tensors as the network has");
        param.map(|own| from.reshape(own.shape()).mul_scalar(self.tau) + own.mul_scalar(1.0 - self.tau))
    }
}
