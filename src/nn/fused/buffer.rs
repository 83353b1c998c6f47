//! A zeroed buffer of numbers that begins at a cache line, so that no vector load crosses one.
#![allow(unsafe_code)]

use std::ops::{Deref, DerefMut};

/// Numbers in one cache line.
const LINE: usize = 16;

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Line([f32; LINE]);

/// A fixed number of cache lines.
#[derive(Clone, Debug, Default)]
pub struct Buffer {
    lines: Vec<Line>,
}

impl Buffer {
    /// At least `length` numbers, all 0.
    pub fn zeros(length: usize) -> Buffer {
        Buffer { lines: vec![Line([0.0; LINE]); length.div_ceil(LINE)] }
    }
}

impl Deref for Buffer {
    type Target = [f32];

    fn deref(&self) -> &[f32] {
        // SAFETY: a `Line` is 16 numbers without padding (its size is its alignment), and the vector's lines lie side by side.
        unsafe { std::slice::from_raw_parts(self.lines.as_ptr().cast(), self.lines.len() * LINE) }
    }
}

impl DerefMut for Buffer {
    fn deref_mut(&mut self) -> &mut [f32] {
        // SAFETY: as above; the vector is borrowed mutably.
        unsafe { std::slice::from_raw_parts_mut(self.lines.as_mut_ptr().cast(), self.lines.len() * LINE) }
    }
}
