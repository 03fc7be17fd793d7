//! Arithmetic on as many pixels at once as the processor takes, with the bits of one at a time.

use std::ops::{Add, Div, Mul, Sub};

use super::simd::Simd;

/// As many single-precision numbers as the processor works on at once; each lane for itself,
/// correctly rounded.
///
/// A formula written with it reads as for one number, and gives each lane the bits that one number
/// would have got: nothing is fused, nothing crosses lanes.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd> {
    simd: S,
    pub value: S::f32s,
}

/// Which lanes.
#[derive(Clone, Copy)]
pub(super) struct Mask<S: Simd> {
    simd: S,
    pub value: S::m32s,
}

impl<S: Simd> Lanes<S> {
    /// The number in every lane.
    #[inline(always)]
    pub(super) fn splat(simd: S, number: f32) -> Self {
        Self { simd, value: simd.splat_f32s(number) }
    }

    /// The numbers read from memory.
    #[inline(always)]
    pub(super) const fn new(simd: S, value: S::f32s) -> Self {
        Self { simd, value }
    }

    /// Another number in every lane.
    #[inline(always)]
    pub(super) fn all(self, number: f32) -> Self {
        Self::splat(self.simd, number)
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        Self { value: self.simd.sqrt_f32s(self.value), ..self }
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        Self { value: self.simd.abs_f32s(self.value), ..self }
    }

    /// The larger; of zeros of different sign, either.
    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        Self { value: self.simd.max_f32s(self.value, other.value), ..self }
    }

    /// The smaller; of zeros of different sign, either.
    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        Self { value: self.simd.min_f32s(self.value, other.value), ..self }
    }

    #[inline(always)]
    pub(super) fn less(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_f32s(self.value, other.value) }
    }

    #[inline(always)]
    pub(super) fn at_most(self, other: Self) -> Mask<S> {
        Mask { simd: self.simd, value: self.simd.less_than_or_equal_f32s(self.value, other.value) }
    }
}

impl<S: Simd> Mask<S> {
    #[inline(always)]
    pub(super) fn and(self, other: Self) -> Self {
        Self { value: self.simd.and_m32s(self.value, other.value), ..self }
    }

    /// One label where the lane is in the mask, the other where it is not, without a choice: as a
    /// choice that is stored where it was read, it would become a masked store.
    #[inline(always)]
    pub(super) fn merge(self, inside: S::u32s, outside: S::u32s) -> S::u32s {
        let simd = self.simd;
        let bits = simd.select_u32s(self.value, simd.splat_u32s(u32::MAX), simd.splat_u32s(0));
        simd.xor_u32s(outside, simd.and_u32s(simd.xor_u32s(outside, inside), bits))
    }

    /// One number where the lane is in the mask, the other where it is not.
    #[inline(always)]
    pub(super) fn select(self, inside: Lanes<S>, outside: Lanes<S>) -> Lanes<S> {
        Lanes { value: self.simd.select_f32s(self.value, inside.value, outside.value), ..inside }
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { value: self.simd.add_f32s(self.value, other.value), ..self }
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { value: self.simd.sub_f32s(self.value, other.value), ..self }
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self { value: self.simd.mul_f32s(self.value, other.value), ..self }
    }
}

impl<S: Simd> Div for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self { value: self.simd.div_f32s(self.value, other.value), ..self }
    }
}
