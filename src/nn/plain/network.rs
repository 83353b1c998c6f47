//! One plain fully connected network: forward with a trace, backward through it, one number at a time in double precision.

use super::super::actor_critic::NetworkTensor;
use super::super::tensors::{NORM_EPSILON, Widths};

/// What the output layer ends with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Output {
    /// An actor: tanh, so that actions lie in `[-1, 1]`.
    Tanh,
    /// A critic: the sum itself.
    Linear,
}

/// A tensor for each entry of [`Widths::tensors`], in that order: parameters, gradients or Adam's moments.
pub type Tensors = Vec<Vec<f32>>;

/// A network's layers and parameters.
#[derive(Clone, Debug)]
pub struct Network {
    widths: Widths,
    output: Output,
    /// The parameters.
    pub tensors: Tensors,
}

/// What the forward pass of one row leaves for the backward pass, layer by layer.
pub struct Trace {
    /// What each layer read; the last entry is what the network wrote.
    values: Vec<Vec<f64>>,
    /// The sums of the last layer, before the output's function.
    sums: Vec<f64>,
    /// Of each normalised layer: the normalised sums and one over their standard deviation.
    normalised: Vec<(Vec<f64>, f64)>,
}

impl Trace {
    /// What the network wrote.
    pub fn output(&self) -> &[f64] {
        self.values.last().expect("a network has layers")
    }

    /// The sums of the last layer: what tanh was taken of.
    pub fn sums(&self) -> &[f64] {
        &self.sums
    }
}

impl Network {
    /// A network whose parameters are all 0.
    pub fn new(widths: Widths, output: Output) -> Network {
        let tensors = widths.tensors().iter().map(|(_, shape)| vec![0.0; shape.iter().product()]).collect();
        Network { widths, output, tensors }
    }

    /// The parameters by name, after `prefix` and a point.
    pub fn named(&self, prefix: &str, tensors: &Tensors) -> Vec<NetworkTensor> {
        let named = self.widths.tensors().into_iter().zip(tensors);
        named
            .map(|((name, shape), values)| NetworkTensor { name: format!("{prefix}.{name}"), shape, values: values.clone() })
            .collect()
    }

    /// Where the tensor of this name stands among the tensors.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.widths.tensors().iter().position(|(own, _)| own == name)
    }

    /// Tensors of the same sizes, all 0.
    pub fn zeros(&self) -> Vec<Vec<f64>> {
        self.tensors.iter().map(|tensor| vec![0.0; tensor.len()]).collect()
    }

    fn last(&self) -> usize {
        self.widths.layers.len() - 2
    }

    /// The number of the weight tensor of `layer`; its bias, gain and shift follow.
    fn first_tensor(&self, layer: usize) -> usize {
        layer * if self.widths.normalised { 4 } else { 2 }
    }

    /// The network's output for one row, with what the backward pass needs.
    pub fn forward(&self, input: &[f64]) -> Trace {
        let mut trace = Trace { values: vec![input.to_vec()], sums: Vec::new(), normalised: Vec::new() };
        for layer in 0..=self.last() {
            let x = &trace.values[layer];
            let [weight, bias] = [0, 1].map(|i| &self.tensors[self.first_tensor(layer) + i]);
            let width = bias.len();
            let mut sums: Vec<f64> = bias.iter().map(|&b| f64::from(b)).collect();
            for (i, x) in x.iter().enumerate() {
                for (o, sum) in sums.iter_mut().enumerate() {
                    *sum += x * f64::from(weight[i * width + o]);
                }
            }
            if layer == self.last() {
                trace.sums.clone_from(&sums);
                if self.output == Output::Tanh {
                    sums.iter_mut().for_each(|sum| *sum = libm::tanh(*sum));
                }
            } else {
                if self.widths.normalised {
                    let [gain, shift] = [2, 3].map(|i| &self.tensors[self.first_tensor(layer) + i]);
                    let mean = sums.iter().sum::<f64>() / width as f64;
                    let variance = sums.iter().map(|sum| (sum - mean) * (sum - mean)).sum::<f64>() / width as f64;
                    let scale = 1.0 / libm::sqrt(variance + NORM_EPSILON);
                    let normal: Vec<f64> = sums.iter().map(|sum| (sum - mean) * scale).collect();
                    sums = (0..width).map(|o| normal[o] * f64::from(gain[o]) + f64::from(shift[o])).collect();
                    trace.normalised.push((normal, scale));
                }
                sums.iter_mut().for_each(|sum| *sum = sum.max(0.0));
            }
            trace.values.push(sums);
        }
        trace
    }

    /// Adds to `gradient` the derivative of a loss whose derivative by the network's output is `output`, and returns its
    /// derivative by the network's input.
    pub fn backward(&self, trace: &Trace, output: &[f64], gradient: &mut [Vec<f64>]) -> Vec<f64> {
        self.backward_with_sums(trace, output, &[], gradient)
    }

    /// The same for a loss that depends on the sums of the last layer directly as well, with the derivative `by_sums`.
    pub fn backward_with_sums(&self, trace: &Trace, output: &[f64], by_sums: &[f64], gradient: &mut [Vec<f64>]) -> Vec<f64> {
        let mut slope = output.to_vec();
        for layer in (0..=self.last()).rev() {
            let (x, y) = (&trace.values[layer], &trace.values[layer + 1]);
            let tensor = self.first_tensor(layer);
            let width = y.len();
            if layer == self.last() {
                if self.output == Output::Tanh {
                    slope.iter_mut().zip(y).for_each(|(slope, y)| *slope *= 1.0 - y * y);
                }
                slope.iter_mut().zip(by_sums).for_each(|(slope, more)| *slope += more);
            } else {
                slope.iter_mut().zip(y).for_each(|(slope, &y)| *slope = if y > 0.0 { *slope } else { 0.0 });
                if self.widths.normalised {
                    let (normal, scale) = &trace.normalised[layer];
                    for o in 0..width {
                        gradient[tensor + 2][o] += slope[o] * normal[o];
                        gradient[tensor + 3][o] += slope[o];
                        slope[o] *= f64::from(self.tensors[tensor + 2][o]);
                    }
                    // Mean and deviation depend on every sum of the row: their shares are the projections on 1 and on `normal`.
                    let mean = slope.iter().sum::<f64>() / width as f64;
                    let along = slope.iter().zip(normal).map(|(s, n)| s * n).sum::<f64>() / width as f64;
                    slope.iter_mut().zip(normal).for_each(|(s, n)| *s = (*s - mean - n * along) * scale);
                }
            }
            let mut before = vec![0.0; x.len()];
            for (i, x) in x.iter().enumerate() {
                for (o, slope) in slope.iter().enumerate() {
                    gradient[tensor][i * width + o] += x * slope;
                    before[i] += f64::from(self.tensors[tensor][i * width + o]) * slope;
                }
            }
            gradient[tensor + 1].iter_mut().zip(&slope).for_each(|(g, s)| *g += s);
            slope = before;
        }
        slope
    }
}
