//! The numbers that factors come in: real and complex ones, in double and single precision.
#![allow(trivial_numeric_casts, reason = "the macro casts for both precisions")]

use nalgebra::Complex;

use super::lane_block::{Plain, Planar};
use super::scalar::Scalar;

/// A pivot that is raised is at most this part of its entry: what comes of rounding. Beyond that the factor is one of another matrix.
const ROUNDED: f64 = 1e-3;

macro_rules! scalars {
    ($real:ident, $lanes:literal) => {
        impl Scalar for $real {
            type Wide = f64;
            type Block = Plain<[$real; $lanes]>;
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
            fn scaled(wide: f64, scale: f64) -> f64 {
                wide * scale
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
            fn times(self, other: Self) -> Self {
                self * other
            }

            #[inline]
            fn root(self, diagonal: Self, negligible: f64) -> Option<Self> {
                let least = negligible as $real * diagonal.abs();
                (self > least && self < $real::INFINITY).then(|| self.sqrt())
            }

            #[inline]
            fn raised_root(self, diagonal: Self, negligible: f64) -> Option<Self> {
                let least = negligible as $real * diagonal.abs();
                let is_rounding = self.abs() <= ROUNDED as $real * diagonal.abs();
                (is_rounding && least > 0.0 && least < $real::INFINITY).then(|| least.max(self.abs()).sqrt())
            }

            #[inline]
            fn reciprocal(self) -> Self {
                1.0 / self
            }
        }

        impl Scalar for Complex<$real> {
            type Wide = Complex<f64>;
            type Block = Planar<[$real; $lanes]>;
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
            fn scaled(wide: Complex<f64>, scale: f64) -> Complex<f64> {
                Complex::new(wide.re * scale, wide.im * scale)
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
            fn times(self, other: Self) -> Self {
                Complex::new(self.re * other.re - self.im * other.im, self.re * other.im + self.im * other.re)
            }

            /// Elimination keeps the real part of a matrix positive semi-definite if it was so, and then roots lie in the
            /// right half plane.
            #[inline]
            fn root(self, diagonal: Self, negligible: f64) -> Option<Self> {
                let size = diagonal.re.abs() + diagonal.im.abs();
                let least = negligible as $real * size;
                // Squares of small parts would vanish in single precision.
                let larger = self.re.abs().max(self.im.abs());
                let (re, im) = (self.re / larger, self.im / larger);
                let modulus = larger * (re * re + im * im).sqrt();
                if !(modulus > least && modulus < $real::INFINITY && self.re > -$real::EPSILON.sqrt() * size) {
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
            fn raised_root(self, _diagonal: Self, _negligible: f64) -> Option<Self> {
                None
            }

            #[inline]
            fn reciprocal(self) -> Self {
                let square = self.re * self.re + self.im * self.im;
                Complex::new(self.re / square, -self.im / square)
            }
        }
    };
}

scalars!(f64, 4);
scalars!(f32, 8);
