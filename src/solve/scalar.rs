//! The numbers that a factor is made of, and the short vectors that the kernels work on.
#![allow(trivial_numeric_casts, reason = "the macros cast for both precisions")]

use core::fmt::Debug;

use nalgebra::Complex;

/// What a factor can be stored in: `f64`, `f32`, and complex numbers of both. Values go in and out in double precision.
pub trait Scalar: Copy + Debug + Send + Sync + sealed::Sealed + 'static {
    /// The same number in double precision: what matrices and right-hand sides are given in.
    type Wide: Copy + Debug + Default + PartialEq + Send + Sync + 'static;
    /// A column of [`Unit::LANES`] numbers.
    type Unit: Unit<Element = Self>;
    /// Zero.
    const ZERO: Self;
    /// Whether the precision, and with it the range, is single.
    const SINGLE: bool;

    /// Rounds.
    fn narrow(wide: Self::Wide) -> Self;
    /// Exact.
    fn wide(self) -> Self::Wide;
    /// Whether a number given is neither NaN nor infinite.
    fn is_finite(wide: Self::Wide) -> bool;
    /// The larger of the absolute values of the parts.
    fn magnitude(wide: Self::Wide) -> f64;
    /// The number times a real factor.
    fn times(wide: Self::Wide, factor: f64) -> Self::Wide;
    /// The sum.
    fn plus(self, other: Self) -> Self;
    /// The difference.
    fn minus(self, other: Self) -> Self;
    /// The product.
    fn by(self, other: Self) -> Self;
    /// The root of a pivot, unless the pivot is lost: not finite, not in the half plane where a definite matrix has its
    /// pivots, or so small beside the `diagonal` entry that it came from that only rounding is left of it.
    fn root(self, diagonal: Self) -> Option<Self>;
    /// 1/self.
    fn reciprocal(self) -> Self;
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f64 {}
    impl Sealed for f32 {}
    impl Sealed for nalgebra::Complex<f64> {}
    impl Sealed for nalgebra::Complex<f32> {}
}

/// About the root of the smallest normal number in single precision.
const TRACE: f32 = 1e-19;

/// A pivot below this many roundings of its diagonal entry is taken for zero. A singular Laplacian leaves a pivot of a few
/// roundings, of either sign.
const LOST: f64 = 16.0;

macro_rules! real_scalar {
    ($real:ident, $lanes:literal) => {
        impl Scalar for $real {
            type Wide = f64;
            type Unit = [$real; $lanes];
            const ZERO: Self = 0.0;
            const SINGLE: bool = size_of::<$real>() == 4;

            #[inline]
            fn narrow(wide: f64) -> Self {
                wide as Self
            }

            #[inline]
            fn wide(self) -> f64 {
                self.into()
            }

            #[inline]
            fn is_finite(wide: f64) -> bool {
                wide.is_finite()
            }

            #[inline]
            fn magnitude(wide: f64) -> f64 {
                wide.abs()
            }

            #[inline]
            fn times(wide: f64, factor: f64) -> f64 {
                wide * factor
            }

            #[inline]
            fn plus(self, other: Self) -> Self {
                self + other
            }

            #[inline]
            fn minus(self, other: Self) -> Self {
                self - other
            }

            #[inline]
            fn by(self, other: Self) -> Self {
                self * other
            }

            #[inline]
            fn root(self, diagonal: Self) -> Option<Self> {
                let least = (LOST as $real) * $real::EPSILON * diagonal.abs();
                (self > least && self < $real::INFINITY).then(|| self.sqrt())
            }

            #[inline]
            fn reciprocal(self) -> Self {
                1.0 / self
            }
        }

        impl Scalar for Complex<$real> {
            type Wide = Complex<f64>;
            type Unit = Planar<[$real; $lanes]>;
            const ZERO: Self = Complex::new(0.0, 0.0);
            const SINGLE: bool = size_of::<$real>() == 4;

            #[inline]
            fn narrow(wide: Complex<f64>) -> Self {
                Complex::new(wide.re as $real, wide.im as $real)
            }

            #[inline]
            fn wide(self) -> Complex<f64> {
                Complex::new(self.re.into(), self.im.into())
            }

            #[inline]
            fn is_finite(wide: Complex<f64>) -> bool {
                wide.re.is_finite() && wide.im.is_finite()
            }

            #[inline]
            fn magnitude(wide: Complex<f64>) -> f64 {
                wide.re.abs().max(wide.im.abs())
            }

            #[inline]
            fn times(wide: Complex<f64>, factor: f64) -> Complex<f64> {
                Complex::new(wide.re * factor, wide.im * factor)
            }

            #[inline]
            fn plus(self, other: Self) -> Self {
                Complex::new(self.re + other.re, self.im + other.im)
            }

            #[inline]
            fn minus(self, other: Self) -> Self {
                Complex::new(self.re - other.re, self.im - other.im)
            }

            #[inline]
            fn by(self, other: Self) -> Self {
                Complex::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
            }

            /// Elimination keeps the real part of a matrix positive semi-definite if it was so, and then roots lie in the
            /// right half plane.
            #[inline]
            fn root(self, diagonal: Self) -> Option<Self> {
                let size = diagonal.re.abs() + diagonal.im.abs();
                let lost = (LOST as $real) * $real::EPSILON * size;
                // Squares of small parts would vanish in single precision.
                let larger = self.re.abs().max(self.im.abs());
                let (re, im) = (self.re / larger, self.im / larger);
                let modulus = larger * (re * re + im * im).sqrt();
                if !(modulus > lost && modulus < $real::INFINITY && self.re > -$real::EPSILON.sqrt() * size) {
                    return None;
                }
                // The larger part first: the other one by division, which loses no digits.
                let half = ((modulus + self.re.abs()) * 0.5).sqrt();
                let other = self.im / (2.0 * half);
                Some(if self.re >= 0.0 {
                    Complex::new(half, other)
                } else {
                    Complex::new(other.abs(), if self.im < 0.0 { -half } else { half })
                })
            }

            #[inline]
            fn reciprocal(self) -> Self {
                let square = self.re * self.re + self.im * self.im;
                Complex::new(self.re / square, -self.im / square)
            }
        }
    };
}

real_scalar!(f64, 4);
real_scalar!(f32, 8);

/// A few numbers side by side, as many as two SIMD registers of WebAssembly hold; complex ones as real parts, then
/// imaginary parts, so that no kernel has to sort them out.
pub trait Unit: Copy + Debug + Send + Sync + 'static {
    /// One number.
    type Element: Scalar<Unit = Self>;
    /// How many.
    const LANES: usize;
    /// All zero.
    const ZERO: Self;

    /// One of the numbers; `lane` counts around, which spares the check of its bounds.
    fn lane(&self, lane: usize) -> Self::Element;
    /// Replaces one of the numbers.
    fn set_lane(&mut self, lane: usize, value: Self::Element);
    /// self·factor
    #[must_use]
    #[inline(always)]
    fn times(&self, factor: Self::Element) -> Self {
        Self::ZERO.minus_scaled(self, Self::Element::ZERO.minus(factor))
    }
    /// self + other
    #[must_use]
    fn plus(self, other: &Self) -> Self;
    /// self − a·factor
    #[must_use]
    fn minus_scaled(self, a: &Self, factor: Self::Element) -> Self;
    /// self + a·b, lane by lane.
    #[must_use]
    fn plus_product(self, a: &Self, b: &Self) -> Self;
    /// Zero for numbers whose squares would leave the normal range of single precision, where processors are slow; double
    /// precision has no such numbers in practice. Matrices in single precision are scaled to entries of at most 1.
    #[must_use]
    fn without_traces(self) -> Self;
    /// The sum of the lanes.
    fn sum(&self) -> Self::Element;
    /// `result[j]` −= Σ over k of `a[k]` · lane j of `b[k]`
    fn update(result: &mut [Self], a: &[Self], b: &[Self]);
}

macro_rules! units {
    ($real:ident, $lanes:literal) => {
        impl Unit for [$real; $lanes] {
            type Element = $real;
            const LANES: usize = $lanes;
            const ZERO: Self = [0.0; $lanes];

            #[inline(always)]
            fn lane(&self, lane: usize) -> $real {
                self[lane % $lanes]
            }

            #[inline(always)]
            fn set_lane(&mut self, lane: usize, value: $real) {
                self[lane % $lanes] = value;
            }

            #[inline(always)]
            fn minus_scaled(mut self, a: &Self, factor: $real) -> Self {
                for i in 0..$lanes {
                    self[i] -= a[i] * factor;
                }
                self
            }

            #[inline(always)]
            fn plus(mut self, other: &Self) -> Self {
                for i in 0..$lanes {
                    self[i] += other[i];
                }
                self
            }

            #[inline(always)]
            fn plus_product(mut self, a: &Self, b: &Self) -> Self {
                for i in 0..$lanes {
                    self[i] += a[i] * b[i];
                }
                self
            }

            #[inline(always)]
            fn without_traces(self) -> Self {
                if <$real>::SINGLE { self.map(|x| if x.abs() < TRACE as $real { 0.0 } else { x }) } else { self }
            }

            #[inline(always)]
            fn sum(&self) -> $real {
                self.iter().sum()
            }

            /// Four results at a time stay in registers over the whole of `a` and `b`: WebAssembly engines have 16 of them,
            /// and the compiler makes two of each unit.
            #[inline(never)]
            fn update(result: &mut [Self], a: &[Self], b: &[Self]) {
                const COLUMNS: usize = 4;
                let (blocks, rest) = result.as_chunks_mut::<COLUMNS>();
                let mut lane = 0;
                for block in blocks {
                    let mut sums = *block;
                    for (a, b) in a.iter().zip(b) {
                        for j in 0..COLUMNS {
                            sums[j] = sums[j].minus_scaled(a, b.lane(lane + j));
                        }
                    }
                    *block = sums;
                    lane += COLUMNS;
                }
                update_each(rest, a, b, lane);
            }
        }

        impl Unit for Planar<[$real; $lanes]> {
            type Element = Complex<$real>;
            const LANES: usize = $lanes;
            const ZERO: Self = Planar { re: [0.0; $lanes], im: [0.0; $lanes] };

            #[inline(always)]
            fn lane(&self, lane: usize) -> Complex<$real> {
                Complex::new(self.re[lane % $lanes], self.im[lane % $lanes])
            }

            #[inline(always)]
            fn set_lane(&mut self, lane: usize, value: Complex<$real>) {
                self.re[lane % $lanes] = value.re;
                self.im[lane % $lanes] = value.im;
            }

            #[inline(always)]
            fn minus_scaled(mut self, a: &Self, factor: Complex<$real>) -> Self {
                for i in 0..$lanes {
                    self.re[i] = self.re[i] - a.re[i] * factor.re + a.im[i] * factor.im;
                }
                for i in 0..$lanes {
                    self.im[i] = self.im[i] - a.re[i] * factor.im - a.im[i] * factor.re;
                }
                self
            }

            #[inline(always)]
            fn plus(mut self, other: &Self) -> Self {
                for i in 0..$lanes {
                    self.re[i] += other.re[i];
                    self.im[i] += other.im[i];
                }
                self
            }

            #[inline(always)]
            fn plus_product(mut self, a: &Self, b: &Self) -> Self {
                for i in 0..$lanes {
                    self.re[i] += a.re[i] * b.re[i] - a.im[i] * b.im[i];
                    self.im[i] += a.re[i] * b.im[i] + a.im[i] * b.re[i];
                }
                self
            }

            #[inline(always)]
            fn without_traces(self) -> Self {
                Planar { re: self.re.without_traces(), im: self.im.without_traces() }
            }

            #[inline(always)]
            fn sum(&self) -> Complex<$real> {
                Complex::new(self.re.iter().sum(), self.im.iter().sum())
            }

            /// Real parts, then imaginary parts: both together would need more registers than there are.
            #[inline(never)]
            fn update(result: &mut [Self], a: &[Self], b: &[Self]) {
                const COLUMNS: usize = 4;
                let (blocks, rest) = result.as_chunks_mut::<COLUMNS>();
                let mut lane = 0;
                for block in blocks {
                    let mut sums = block.map(|unit| unit.re);
                    for (a, b) in a.iter().zip(b) {
                        for j in 0..COLUMNS {
                            sums[j] = sums[j].minus_scaled(&a.re, b.re.lane(lane + j));
                        }
                    }
                    for (a, b) in a.iter().zip(b) {
                        for j in 0..COLUMNS {
                            sums[j] = sums[j].minus_scaled(&a.im, -b.im.lane(lane + j));
                        }
                    }
                    for (unit, sum) in block.iter_mut().zip(sums) {
                        unit.re = sum;
                    }
                    let mut sums = block.map(|unit| unit.im);
                    for (a, b) in a.iter().zip(b) {
                        for j in 0..COLUMNS {
                            sums[j] = sums[j].minus_scaled(&a.re, b.im.lane(lane + j));
                        }
                    }
                    for (a, b) in a.iter().zip(b) {
                        for j in 0..COLUMNS {
                            sums[j] = sums[j].minus_scaled(&a.im, b.re.lane(lane + j));
                        }
                    }
                    for (unit, sum) in block.iter_mut().zip(sums) {
                        unit.im = sum;
                    }
                    lane += COLUMNS;
                }
                update_each(rest, a, b, lane);
            }
        }
    };
}

/// Real parts, then imaginary parts.
#[derive(Debug, Clone, Copy)]
pub struct Planar<Parts> {
    re: Parts,
    im: Parts,
}

units!(f64, 4);
units!(f32, 8);

/// [`Unit::update`] of results from lane `lane` on, one at a time.
#[inline(always)]
fn update_each<U: Unit>(results: &mut [U], a: &[U], b: &[U], mut lane: usize) {
    for result in results {
        let mut sum = *result;
        for (a, b) in a.iter().zip(b) {
            sum = sum.minus_scaled(a, b.lane(lane));
        }
        *result = sum;
        lane += 1;
    }
}
