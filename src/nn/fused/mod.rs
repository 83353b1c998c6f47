//! The fast kernel: the plain networks' arithmetic on flat buffers, forward, back and Adam with the soft update by hand.
//!
//! Activations lie in panels of as many columns as a vector has lanes, and so do the weights, for good: every product reads and
//! writes whole vectors side by side, whatever the widths, and columns that fill up a panel hold 0. What is computed is written
//! once against a small seam of vector operations; AVX2 is chosen at run time, WebAssembly's simd128 at compile time, and
//! a portable form is always there.

mod adam;
mod buffer;
mod head;
mod lanes;
#[cfg(target_arch = "x86_64")]
mod lanes_avx2;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod lanes_simd128;
mod layout;
mod learner;
mod norm;
mod pass;
mod product;

pub use lanes::Kernel;
pub(super) use lanes::{LANES, Lanes, Work};
pub use learner::Fused;
