//! The numbers that a factor is made of.
#![allow(trivial_numeric_casts, reason = "the macros cast for both precisions")]

use core::fmt::Debug;

use nalgebra::Complex;

use super::unit::{Plain, Planar, Unit};

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
    /// The distance from 1 to the next number.
    const EPSILON: f64;

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
    /// pivots, or at most the fraction `lost` of the `diagonal` entry that it came from.
    fn root(self, diagonal: Self, lost: f64) -> Option<Self>;
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

macro_rules! real_scalar {
    ($real:ident, $lanes:literal) => {
        impl Scalar for $real {
            type Wide = f64;
            type Unit = Plain<[$real; $lanes]>;
            const ZERO: Self = 0.0;
            const SINGLE: bool = size_of::<$real>() == 4;
            const EPSILON: f64 = $real::EPSILON as f64;

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
            fn root(self, diagonal: Self, lost: f64) -> Option<Self> {
                let least = lost as $real * diagonal.abs();
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
            const EPSILON: f64 = $real::EPSILON as f64;

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
            fn root(self, diagonal: Self, lost: f64) -> Option<Self> {
                let size = diagonal.re.abs() + diagonal.im.abs();
                let lost = lost as $real * size;
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
