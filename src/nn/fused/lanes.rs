//! The seam to the processor: a vector of [`LANES`] numbers, its portable form, and the choice of a form at run time.
#![allow(unsafe_code)]

/// Numbers in one vector. Buffers are laid out for it: columns in panels of this width.
pub const LANES: usize = if cfg!(target_arch = "wasm32") { 8 } else { 16 };

/// A vector of [`LANES`] numbers.
///
/// # Safety
/// Every method may be called only where the processor has the instructions of the implementing type; pointers must be valid for
/// [`LANES`] numbers.
pub trait Lanes: Copy {
    /// Rows of a register tile: so many sums of one vector each fit the registers beside the operands.
    const ROWS: usize;
    /// The numbers at `from`.
    unsafe fn load(from: *const f32) -> Self;
    /// Writes the numbers to `to`.
    unsafe fn store(self, to: *mut f32);
    /// The same number everywhere.
    unsafe fn splat(number: f32) -> Self;
    /// `self + a·b`, rounded once where the processor can.
    unsafe fn plus_product(self, a: Self, b: Self) -> Self;
    /// Sums.
    unsafe fn plus(self, other: Self) -> Self;
    /// Differences.
    unsafe fn minus(self, other: Self) -> Self;
    /// Products.
    unsafe fn times(self, other: Self) -> Self;
    /// Quotients.
    unsafe fn over(self, other: Self) -> Self;
    /// Square roots.
    unsafe fn root(self) -> Self;
    /// `max(self, 0)`.
    unsafe fn rectified(self) -> Self;
    /// `self` where `of` is positive, else 0.
    unsafe fn where_positive(self, of: Self) -> Self;
    /// The sum of all lanes, always in the same order: halves added, then their halves …
    unsafe fn sum(self) -> f32;
}

/// The form that every processor has.
#[derive(Clone, Copy)]
pub struct Portable([f32; LANES]);

impl Portable {
    #[inline(always)]
    fn zip(self, other: Portable, f: impl Fn(f32, f32) -> f32) -> Portable {
        Portable(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }
}

impl Lanes for Portable {
    const ROWS: usize = 2;
    #[inline(always)]
    unsafe fn load(from: *const f32) -> Portable {
        // SAFETY: the caller's pointer is valid for LANES numbers; an array of numbers needs their alignment only.
        Portable(unsafe { from.cast::<[f32; LANES]>().read() })
    }
    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: as above.
        unsafe { to.cast::<[f32; LANES]>().write(self.0) }
    }
    #[inline(always)]
    unsafe fn splat(number: f32) -> Portable {
        Portable([number; LANES])
    }
    #[inline(always)]
    unsafe fn plus_product(self, a: Portable, b: Portable) -> Portable {
        Portable(std::array::from_fn(|i| self.0[i] + a.0[i] * b.0[i]))
    }
    #[inline(always)]
    unsafe fn plus(self, other: Portable) -> Portable {
        self.zip(other, |a, b| a + b)
    }
    #[inline(always)]
    unsafe fn minus(self, other: Portable) -> Portable {
        self.zip(other, |a, b| a - b)
    }
    #[inline(always)]
    unsafe fn times(self, other: Portable) -> Portable {
        self.zip(other, |a, b| a * b)
    }
    #[inline(always)]
    unsafe fn over(self, other: Portable) -> Portable {
        self.zip(other, |a, b| a / b)
    }
    #[inline(always)]
    unsafe fn root(self) -> Portable {
        Portable(self.0.map(f32::sqrt))
    }
    #[inline(always)]
    unsafe fn rectified(self) -> Portable {
        Portable(self.0.map(|a| if a > 0.0 { a } else { 0.0 }))
    }
    #[inline(always)]
    unsafe fn where_positive(self, of: Portable) -> Portable {
        self.zip(of, |a, of| if of > 0.0 { a } else { 0.0 })
    }
    #[inline(always)]
    unsafe fn sum(self) -> f32 {
        let mut sums = self.0;
        let mut half = LANES / 2;
        while half > 0 {
            for i in 0..half {
                sums[i] += sums[i + half];
            }
            half /= 2;
        }
        sums[0]
    }
}

/// Something to compute, written once for every form of vector.
pub trait Work {
    /// What comes out.
    type Output;
    /// Computes it with vectors `L`; must be `#[inline(always)]` in all it calls.
    ///
    /// # Safety
    /// Only where the processor has the instructions of `L`.
    unsafe fn run<L: Lanes>(self) -> Self::Output;
}

/// Which form of vectors to compute with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Kernel(Form);

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Form {
    Portable,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
    Simd128,
}

impl Kernel {
    /// The form every processor has.
    pub const PORTABLE: Kernel = Kernel(Form::Portable);

    /// The fastest form of this processor: AVX2 with FMA on x86-64 where it is there, simd128 in a WebAssembly build with it.
    pub fn fastest() -> Kernel {
        #[cfg(target_arch = "x86_64")]
        if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") {
            return Kernel(Form::Avx2);
        }
        #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
        return Kernel(Form::Simd128);
        #[allow(unreachable_code)]
        Kernel::PORTABLE
    }

    /// A short name for tables and logs.
    pub fn name(self) -> &'static str {
        match self.0 {
            Form::Portable => "portable",
            #[cfg(target_arch = "x86_64")]
            Form::Avx2 => "AVX2 + FMA",
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Form::Simd128 => "simd128",
        }
    }

    /// Does the work with this form.
    #[inline]
    pub fn run<W: Work>(self, work: W) -> W::Output {
        match self.0 {
            // SAFETY: needs nothing beyond the target's own instructions.
            Form::Portable => unsafe { portable(work) },
            // SAFETY: `fastest` makes this value only where the processor has AVX2 and FMA.
            #[cfg(target_arch = "x86_64")]
            Form::Avx2 => unsafe { avx2(work) },
            // SAFETY: the target has simd128 at compile time.
            #[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
            Form::Simd128 => unsafe { simd128(work) },
        }
    }
}

#[inline(never)]
unsafe fn portable<W: Work>(work: W) -> W::Output {
    // SAFETY: passed on.
    unsafe { work.run::<Portable>() }
}

#[cfg(target_arch = "x86_64")]
#[inline(never)]
#[target_feature(enable = "avx2,fma")]
unsafe fn avx2<W: Work>(work: W) -> W::Output {
    // SAFETY: passed on.
    unsafe { work.run::<super::lanes_avx2::Avx2>() }
}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
#[inline(never)]
unsafe fn simd128<W: Work>(work: W) -> W::Output {
    // SAFETY: passed on.
    unsafe { work.run::<super::lanes_simd128::Simd128>() }
}
