//! What a factor is made of: numbers, and lane blocks of several numbers side by side.

use core::fmt::Debug;

/// What a factor can be stored in: `f64`, `f32`, and complex numbers of both. Values go in and out in double precision.
pub trait Scalar: Copy + Debug + Send + Sync + sealed::Sealed + 'static {
    /// The same number in double precision: what matrices and right-hand sides are given in.
    type Wide: Copy + Debug + Default + PartialEq + Send + Sync + 'static;
    /// A column of [`LaneBlock::LANES`] numbers.
    type Block: LaneBlock<Element = Self>;
    /// Zero.
    const ZERO: Self;
    /// Whether the precision, and with it the range, is single.
    const SINGLE: bool;
    /// The distance from 1 to the next number.
    const EPSILON: f64;

    /// The nearest number of this precision.
    fn narrow(wide: Self::Wide) -> Self;
    /// The same number, exactly.
    fn wide(self) -> Self::Wide;
    /// Whether a number given is neither NaN nor infinite.
    fn is_finite(wide: Self::Wide) -> bool;
    /// The larger of the absolute values of the parts.
    fn magnitude(wide: Self::Wide) -> f64;
    /// The number times a real one.
    fn scaled(wide: Self::Wide, scale: f64) -> Self::Wide;
    /// The sum.
    fn plus(self, other: Self) -> Self;
    /// The difference.
    fn minus(self, other: Self) -> Self;
    /// The product.
    fn times(self, other: Self) -> Self;
    /// The root of a pivot; none where the pivot is not finite, not in the half plane where a definite matrix has its
    /// pivots, or at most the fraction `negligible` of the `diagonal` entry that it came from.
    fn root(self, diagonal: Self, negligible: f64) -> Option<Self>;
    /// The root of the least pivot that is not negligible, or of a larger one of the size of this, for a pivot that is a small part of its
    /// entry, of any sign; none where it is no such part, and for complex numbers, which have no order.
    fn raised_root(self, diagonal: Self, negligible: f64) -> Option<Self>;
    /// 1/self.
    fn reciprocal(self) -> Self;
}

/// A few numbers side by side, as many as two SIMD registers of WebAssembly hold; complex ones as real parts, then
/// imaginary parts, so that no kernel has to sort them out.
pub trait LaneBlock: Copy + Debug + Send + Sync + 'static {
    /// The type of one number.
    type Element: Scalar<Block = Self>;
    /// How many numbers there are.
    const LANES: usize;
    /// Zero in all lanes.
    const ZERO: Self;

    /// One of the numbers; `lane` counts around, which spares the check of its bounds.
    fn lane(&self, lane: usize) -> Self::Element;
    /// Replaces one of the numbers.
    fn set_lane(&mut self, lane: usize, value: Self::Element);
    /// self + other
    #[must_use]
    fn plus(&self, other: &Self) -> Self;
    /// self − a·scale
    #[must_use]
    fn minus_scaled(&self, a: &Self, scale: Self::Element) -> Self;
    /// self + a·b in each lane
    #[must_use]
    fn plus_product(&self, a: &Self, b: &Self) -> Self;
    /// self·scale
    #[must_use]
    #[inline(always)]
    fn times(&self, scale: Self::Element) -> Self {
        Self::ZERO.minus_scaled(self, Self::Element::ZERO.minus(scale))
    }
    /// Zero for numbers whose squares would leave the normal range of single precision, where processors are slow; double
    /// precision has no such numbers in practice. Matrices in single precision are scaled to entries of at most 1.
    #[must_use]
    fn without_traces(self) -> Self;
    /// The sum of the lanes.
    fn sum(&self) -> Self::Element;
    /// `result[j]` −= Σ over k of `a[k]` · lane j of `b[k]`
    fn update(result: &mut [Self], a: &[Self], b: &[Self]);
}

mod sealed {
    pub trait Sealed {}
    impl Sealed for f64 {}
    impl Sealed for f32 {}
    impl Sealed for nalgebra::Complex<f64> {}
    impl Sealed for nalgebra::Complex<f32> {}
}
