//! Eight lanes as two 128-bit vectors of WebAssembly, which has no fused multiply-add with one result everywhere.
#![allow(unsafe_code)]

use std::arch::wasm32::*;

use super::lanes::Lanes;

/// Two vectors of four numbers.
#[derive(Clone, Copy)]
pub struct Simd128(v128, v128);

// SAFETY, of every block below: the trait's callers promise valid pointers, and simd128 is there at compile time.
impl Lanes for Simd128 {
    // Measured: six rows make V8 spill to the stack, four do not.
    const ROWS: usize = 4;
    #[inline(always)]
    unsafe fn load(from: *const f32) -> Simd128 {
        unsafe { Simd128(v128_load(from.cast()), v128_load(from.add(4).cast())) }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        unsafe {
            v128_store(to.cast(), self.0);
            v128_store(to.add(4).cast(), self.1);
        }
    }
    #[inline(always)]
    unsafe fn splat(number: f32) -> Simd128 {
        Simd128(f32x4_splat(number), f32x4_splat(number))
    }
    #[inline(always)]
    unsafe fn plus_product(self, a: Simd128, b: Simd128) -> Simd128 {
        Simd128(f32x4_add(self.0, f32x4_mul(a.0, b.0)), f32x4_add(self.1, f32x4_mul(a.1, b.1)))
    }
    #[inline(always)]
    unsafe fn plus(self, other: Simd128) -> Simd128 {
        Simd128(f32x4_add(self.0, other.0), f32x4_add(self.1, other.1))
    }
    #[inline(always)]
    unsafe fn minus(self, other: Simd128) -> Simd128 {
        Simd128(f32x4_sub(self.0, other.0), f32x4_sub(self.1, other.1))
    }
    #[inline(always)]
    unsafe fn times(self, other: Simd128) -> Simd128 {
        Simd128(f32x4_mul(self.0, other.0), f32x4_mul(self.1, other.1))
    }
    #[inline(always)]
    unsafe fn over(self, other: Simd128) -> Simd128 {
        Simd128(f32x4_div(self.0, other.0), f32x4_div(self.1, other.1))
    }
    #[inline(always)]
    unsafe fn root(self) -> Simd128 {
        Simd128(f32x4_sqrt(self.0), f32x4_sqrt(self.1))
    }
    #[inline(always)]
    unsafe fn rectified(self) -> Simd128 {
        let zero = f32x4_splat(0.0);
        Simd128(f32x4_pmax(zero, self.0), f32x4_pmax(zero, self.1))
    }
    #[inline(always)]
    unsafe fn where_positive(self, of: Simd128) -> Simd128 {
        let zero = f32x4_splat(0.0);
        Simd128(v128_and(self.0, f32x4_gt(of.0, zero)), v128_and(self.1, f32x4_gt(of.1, zero)))
    }
    #[inline(always)]
    unsafe fn sum(self) -> f32 {
        let four = f32x4_add(self.0, self.1);
        let two = f32x4_add(four, i32x4_shuffle::<2, 3, 2, 3>(four, four));
        f32x4_extract_lane::<0>(two) + f32x4_extract_lane::<1>(two)
    }
}
