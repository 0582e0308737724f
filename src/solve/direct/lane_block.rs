//! Lane blocks: the short vectors that factors are stored in.
#![allow(trivial_numeric_casts, clippy::cast_lossless, reason = "the macro casts for both precisions")]

use nalgebra::Complex;

use super::scalar::{LaneBlock, Scalar};
use crate::solve::lanes::{Doubles, Lanes, Singles, sum_products};

/// About the root of the smallest normal number in single precision.
const TRACE: f32 = 1e-19;

/// Real numbers. Aligned, because registers that are read across the borders of cache lines cost a quarter of the speed.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub struct Plain<Numbers>(Numbers);

/// Real parts, then imaginary parts.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub struct Planar<Parts> {
    re: Parts,
    im: Parts,
}

macro_rules! without_traces {
    ($real:ident, $registers:ident, $numbers:expr) => {
        if <$real>::SINGLE { $registers::load(&$numbers).without_traces(TRACE as $real).store() } else { $numbers }
    };
}

macro_rules! lane_blocks {
    ($real:ident, $lanes:literal, $registers:ident) => {
        impl LaneBlock for Plain<[$real; $lanes]> {
            type Element = $real;
            const LANES: usize = $lanes;
            const ZERO: Self = Plain([0.0; $lanes]);

            #[inline(always)]
            fn lane(&self, lane: usize) -> $real {
                self.0[lane % $lanes]
            }

            #[inline(always)]
            fn set_lane(&mut self, lane: usize, value: $real) {
                self.0[lane % $lanes] = value;
            }

            #[inline(always)]
            fn plus(&self, other: &Self) -> Self {
                Plain($registers::load(&self.0).plus($registers::load(&other.0)).store())
            }

            #[inline(always)]
            fn minus_scaled(&self, a: &Self, scale: $real) -> Self {
                Plain($registers::load(&self.0).minus_scaled($registers::load(&a.0), scale).store())
            }

            #[inline(always)]
            fn plus_product(&self, a: &Self, b: &Self) -> Self {
                Plain($registers::load(&self.0).plus_product($registers::load(&a.0), $registers::load(&b.0)).store())
            }

            #[inline(always)]
            fn without_traces(self) -> Self {
                Plain(without_traces!($real, $registers, self.0))
            }

            #[inline(always)]
            fn sum(&self) -> $real {
                self.0.iter().sum()
            }

            #[inline(never)]
            fn update(result: &mut [Self], a: &[Self], b: &[Self]) {
                let (fours, rest) = result.as_chunks_mut::<4>();
                let mut lane = 0;
                for [r0, r1, r2, r3] in fours {
                    let sums = [
                        $registers::load(&r0.0),
                        $registers::load(&r1.0),
                        $registers::load(&r2.0),
                        $registers::load(&r3.0),
                    ];
                    let sums =
                        sum_products::<false, _, _>(sums, a.iter().zip(b), |a| &a.0, |b, j| b.0[(lane + j) % $lanes]);
                    let [s0, s1, s2, s3] = sums;
                    (r0.0, r1.0, r2.0, r3.0) = (s0.store(), s1.store(), s2.store(), s3.store());
                    lane += 4;
                }
                update_each(rest, a, b, lane);
            }
        }

        impl LaneBlock for Planar<[$real; $lanes]> {
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
            fn plus(&self, other: &Self) -> Self {
                let real = $registers::load(&self.re).plus($registers::load(&other.re));
                let imaginary = $registers::load(&self.im).plus($registers::load(&other.im));
                Planar { re: real.store(), im: imaginary.store() }
            }

            #[inline(always)]
            fn minus_scaled(&self, a: &Self, scale: Complex<$real>) -> Self {
                let (re, im) = ($registers::load(&a.re), $registers::load(&a.im));
                let real = $registers::load(&self.re).minus_scaled(re, scale.re).plus_scaled(im, scale.im);
                let imaginary = $registers::load(&self.im).minus_scaled(re, scale.im).minus_scaled(im, scale.re);
                Planar { re: real.store(), im: imaginary.store() }
            }

            #[inline(always)]
            fn plus_product(&self, a: &Self, b: &Self) -> Self {
                let (a_re, a_im) = ($registers::load(&a.re), $registers::load(&a.im));
                let (b_re, b_im) = ($registers::load(&b.re), $registers::load(&b.im));
                let real = $registers::load(&self.re).plus_product(a_re, b_re).minus_product(a_im, b_im);
                let imaginary = $registers::load(&self.im).plus_product(a_re, b_im).plus_product(a_im, b_re);
                Planar { re: real.store(), im: imaginary.store() }
            }

            #[inline(always)]
            fn without_traces(self) -> Self {
                Planar {
                    re: without_traces!($real, $registers, self.re),
                    im: without_traces!($real, $registers, self.im),
                }
            }

            #[inline(always)]
            fn sum(&self) -> Complex<$real> {
                Complex::new(self.re.iter().sum(), self.im.iter().sum())
            }

            /// One after the other the four sums of a complex product: more of them at a time would not stay in registers.
            #[inline(never)]
            fn update(result: &mut [Self], a: &[Self], b: &[Self]) {
                let (fours, rest) = result.as_chunks_mut::<4>();
                let mut lane = 0;
                for [r0, r1, r2, r3] in fours {
                    let blocks = || a.iter().zip(b);
                    let sums = [
                        $registers::load(&r0.re),
                        $registers::load(&r1.re),
                        $registers::load(&r2.re),
                        $registers::load(&r3.re),
                    ];
                    let sums = sum_products::<false, _, _>(sums, blocks(), |a| &a.re, |b, j| b.re[(lane + j) % $lanes]);
                    let sums = sum_products::<true, _, _>(sums, blocks(), |a| &a.im, |b, j| b.im[(lane + j) % $lanes]);
                    let [s0, s1, s2, s3] = sums;
                    (r0.re, r1.re, r2.re, r3.re) = (s0.store(), s1.store(), s2.store(), s3.store());
                    let sums = [
                        $registers::load(&r0.im),
                        $registers::load(&r1.im),
                        $registers::load(&r2.im),
                        $registers::load(&r3.im),
                    ];
                    let sums = sum_products::<false, _, _>(sums, blocks(), |a| &a.re, |b, j| b.im[(lane + j) % $lanes]);
                    let sums = sum_products::<false, _, _>(sums, blocks(), |a| &a.im, |b, j| b.re[(lane + j) % $lanes]);
                    let [s0, s1, s2, s3] = sums;
                    (r0.im, r1.im, r2.im, r3.im) = (s0.store(), s1.store(), s2.store(), s3.store());
                    lane += 4;
                }
                update_each(rest, a, b, lane);
            }
        }
    };
}

lane_blocks!(f64, 4, Doubles);
lane_blocks!(f32, 8, Singles);

/// [`LaneBlock::update`] of results from lane `lane` on, one at a time.
#[inline(never)]
fn update_each<B: LaneBlock>(results: &mut [B], a: &[B], b: &[B], mut lane: usize) {
    for result in results {
        let mut sum = *result;
        for (a, b) in a.iter().zip(b) {
            sum = sum.minus_scaled(a, b.lane(lane));
        }
        *result = sum;
        lane += 1;
    }
}
