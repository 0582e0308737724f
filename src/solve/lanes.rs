//! Two SIMD registers' worth of real numbers.
//!
//! WebAssembly gets its own code: left to the compiler, the innermost loops come out vectorised or several times slower,
//! depending on its level of optimisation. Everywhere else plain numbers are written out for the compiler to put together.
//! The same operations in the same order on every platform, without fused multiplication and addition: so are the results.

use core::fmt::Debug;

/// The numbers of one register pair.
pub(super) trait Lanes: Copy + Debug {
    /// One of them.
    type Number: Copy;
    /// All of them in memory.
    type Array;

    fn load(array: &Self::Array) -> Self;
    fn store(self) -> Self::Array;
    /// self + a
    fn plus(self, a: Self) -> Self;
    /// self + a·b
    fn plus_product(self, a: Self, b: Self) -> Self;
    /// self − a·b
    fn minus_product(self, a: Self, b: Self) -> Self;
    /// self + a·scale
    fn plus_scaled(self, a: Self, scale: Self::Number) -> Self;
    /// self − a·scale
    fn minus_scaled(self, a: Self, scale: Self::Number) -> Self;
    /// Zero where the absolute value is below `least`.
    fn without_traces(self, least: Self::Number) -> Self;
}

#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod registers {
    use core::arch::wasm32::{
        f32x4_abs, f32x4_add, f32x4_lt, f32x4_mul, f32x4_splat, f32x4_sub, f64x2_abs, f64x2_add, f64x2_lt, f64x2_mul,
        f64x2_splat, f64x2_sub, v128, v128_andnot,
    };

    use super::Lanes;

    macro_rules! pair {
        ($name:ident, $number:ident, $lanes:literal, $splat:ident, $add:ident, $sub:ident, $mul:ident, $abs:ident, $lt:ident) => {
            #[derive(Clone, Copy, Debug)]
            pub(in crate::solve) struct $name(v128, v128);

            impl Lanes for $name {
                type Number = $number;
                type Array = [$number; $lanes];

                #[inline(always)]
                #[allow(unsafe_code, reason = "there is no safe way to read a register from memory as a whole")]
                fn load(array: &[$number; $lanes]) -> Self {
                    // SAFETY: both are 32 bytes in which every pattern of bits is valid.
                    let [a, b] = unsafe { core::mem::transmute::<[$number; $lanes], [v128; 2]>(*array) };
                    Self(a, b)
                }

                #[inline(always)]
                #[allow(unsafe_code, reason = "there is no safe way to write a register to memory as a whole")]
                fn store(self) -> [$number; $lanes] {
                    // SAFETY: both are 32 bytes in which every pattern of bits is valid.
                    unsafe { core::mem::transmute::<[v128; 2], [$number; $lanes]>([self.0, self.1]) }
                }

                #[inline(always)]
                fn plus(self, a: Self) -> Self {
                    Self($add(self.0, a.0), $add(self.1, a.1))
                }

                #[inline(always)]
                fn plus_product(self, a: Self, b: Self) -> Self {
                    Self($add(self.0, $mul(a.0, b.0)), $add(self.1, $mul(a.1, b.1)))
                }

                #[inline(always)]
                fn minus_product(self, a: Self, b: Self) -> Self {
                    Self($sub(self.0, $mul(a.0, b.0)), $sub(self.1, $mul(a.1, b.1)))
                }

                #[inline(always)]
                fn plus_scaled(self, a: Self, scale: $number) -> Self {
                    let scale = $splat(scale);
                    self.plus_product(a, Self(scale, scale))
                }

                #[inline(always)]
                fn minus_scaled(self, a: Self, scale: $number) -> Self {
                    let scale = $splat(scale);
                    self.minus_product(a, Self(scale, scale))
                }

                #[inline(always)]
                fn without_traces(self, least: $number) -> Self {
                    let least = $splat(least);
                    Self(v128_andnot(self.0, $lt($abs(self.0), least)), v128_andnot(self.1, $lt($abs(self.1), least)))
                }
            }
        };
    }

    pair!(Doubles, f64, 4, f64x2_splat, f64x2_add, f64x2_sub, f64x2_mul, f64x2_abs, f64x2_lt);
    pair!(Singles, f32, 8, f32x4_splat, f32x4_add, f32x4_sub, f32x4_mul, f32x4_abs, f32x4_lt);
}

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod registers {
    use super::Lanes;

    macro_rules! lanes {
        ($name:ident, $number:ident, $lanes:literal: $($i:literal)*) => {
            #[derive(Clone, Copy, Debug)]
            pub(in crate::solve) struct $name([$number; $lanes]);

            impl Lanes for $name {
                type Number = $number;
                type Array = [$number; $lanes];

                #[inline(always)]
                fn load(array: &[$number; $lanes]) -> Self {
                    Self(*array)
                }

                #[inline(always)]
                fn store(self) -> [$number; $lanes] {
                    self.0
                }

                #[inline(always)]
                fn plus(self, a: Self) -> Self {
                    Self([$(self.0[$i] + a.0[$i]),*])
                }

                #[inline(always)]
                fn plus_product(self, a: Self, b: Self) -> Self {
                    Self([$(self.0[$i] + a.0[$i] * b.0[$i]),*])
                }

                #[inline(always)]
                fn minus_product(self, a: Self, b: Self) -> Self {
                    Self([$(self.0[$i] - a.0[$i] * b.0[$i]),*])
                }

                #[inline(always)]
                fn plus_scaled(self, a: Self, scale: $number) -> Self {
                    Self([$(self.0[$i] + a.0[$i] * scale),*])
                }

                #[inline(always)]
                fn minus_scaled(self, a: Self, scale: $number) -> Self {
                    Self([$(self.0[$i] - a.0[$i] * scale),*])
                }

                #[inline(always)]
                fn without_traces(self, least: $number) -> Self {
                    Self([$(if self.0[$i].abs() < least { 0.0 } else { self.0[$i] }),*])
                }
            }
        };
    }

    lanes!(Doubles, f64, 4: 0 1 2 3);
    lanes!(Singles, f32, 8: 0 1 2 3 4 5 6 7);
}

pub(super) use registers::{Doubles, Singles};

/// Four sums of products, which stay in registers: `sums[j]` − Σ over k of `a[k]` · number `lane + j` of `b[k]`, or plus
/// where `PLUS`. WebAssembly engines have 16 registers for everything, and two of them make one of [`Lanes`].
#[inline(always)]
pub(super) fn sum_products<const PLUS: bool, T, L: Lanes>(
    sums: [L; 4],
    blocks: core::iter::Zip<core::slice::Iter<'_, T>, core::slice::Iter<'_, T>>,
    a_of: impl Fn(&T) -> &L::Array,
    b_of: impl Fn(&T, usize) -> L::Number,
) -> [L; 4] {
    let [mut s0, mut s1, mut s2, mut s3] = sums;
    for (a, b) in blocks {
        let a = L::load(a_of(a));
        if PLUS {
            s0 = s0.plus_scaled(a, b_of(b, 0));
            s1 = s1.plus_scaled(a, b_of(b, 1));
            s2 = s2.plus_scaled(a, b_of(b, 2));
            s3 = s3.plus_scaled(a, b_of(b, 3));
        } else {
            s0 = s0.minus_scaled(a, b_of(b, 0));
            s1 = s1.minus_scaled(a, b_of(b, 1));
            s2 = s2.minus_scaled(a, b_of(b, 2));
            s3 = s3.minus_scaled(a, b_of(b, 3));
        }
    }
    [s0, s1, s2, s3]
}
