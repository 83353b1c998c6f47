//! Sixteen lanes as two AVX2 registers, with fused multiply-add.
#![allow(unsafe_code)]

use std::arch::x86_64::*;

use super::lanes::Lanes;

/// Two registers of eight numbers.
#[derive(Clone, Copy)]
pub struct Avx2(__m256, __m256);

// SAFETY, of every block below: the trait's callers promise AVX2, FMA and valid pointers, and nothing else is needed.
impl Lanes for Avx2 {
    // 6 rows × 2 registers of sums, 2 of weights, 1 of the input: 15 of the 16 registers.
    const ROWS: usize = 6;
    #[inline(always)]
    unsafe fn load(from: *const f32) -> Avx2 {
        unsafe { Avx2(_mm256_loadu_ps(from), _mm256_loadu_ps(from.add(8))) }
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        unsafe {
            _mm256_storeu_ps(to, self.0);
            _mm256_storeu_ps(to.add(8), self.1);
        }
    }
    #[inline(always)]
    unsafe fn splat(number: f32) -> Avx2 {
        unsafe { Avx2(_mm256_set1_ps(number), _mm256_set1_ps(number)) }
    }
    #[inline(always)]
    unsafe fn plus_product(self, a: Avx2, b: Avx2) -> Avx2 {
        unsafe { Avx2(_mm256_fmadd_ps(a.0, b.0, self.0), _mm256_fmadd_ps(a.1, b.1, self.1)) }
    }
    #[inline(always)]
    unsafe fn plus(self, other: Avx2) -> Avx2 {
        unsafe { Avx2(_mm256_add_ps(self.0, other.0), _mm256_add_ps(self.1, other.1)) }
    }
    #[inline(always)]
    unsafe fn minus(self, other: Avx2) -> Avx2 {
        unsafe { Avx2(_mm256_sub_ps(self.0, other.0), _mm256_sub_ps(self.1, other.1)) }
    }
    #[inline(always)]
    unsafe fn times(self, other: Avx2) -> Avx2 {
        unsafe { Avx2(_mm256_mul_ps(self.0, other.0), _mm256_mul_ps(self.1, other.1)) }
    }
    #[inline(always)]
    unsafe fn over(self, other: Avx2) -> Avx2 {
        unsafe { Avx2(_mm256_div_ps(self.0, other.0), _mm256_div_ps(self.1, other.1)) }
    }
    #[inline(always)]
    unsafe fn root(self) -> Avx2 {
        unsafe { Avx2(_mm256_sqrt_ps(self.0), _mm256_sqrt_ps(self.1)) }
    }
    #[inline(always)]
    unsafe fn rectified(self) -> Avx2 {
        unsafe {
            let zero = _mm256_setzero_ps();
            Avx2(_mm256_max_ps(self.0, zero), _mm256_max_ps(self.1, zero))
        }
    }
    #[inline(always)]
    unsafe fn where_positive(self, of: Avx2) -> Avx2 {
        unsafe {
            let zero = _mm256_setzero_ps();
            let (low, high) = (_mm256_cmp_ps::<_CMP_GT_OQ>(of.0, zero), _mm256_cmp_ps::<_CMP_GT_OQ>(of.1, zero));
            Avx2(_mm256_and_ps(self.0, low), _mm256_and_ps(self.1, high))
        }
    }
    #[inline(always)]
    unsafe fn sum(self) -> f32 {
        unsafe {
            let eight = _mm256_add_ps(self.0, self.1);
            let four = _mm_add_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps::<1>(eight));
            let two = _mm_add_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_add_ss(two, _mm_movehdup_ps(two)))
        }
    }
}
