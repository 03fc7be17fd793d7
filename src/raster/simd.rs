//! One number at a time, under the names of `pulp`: the engine without the feature `simd`, with the
//! same bits.

/// How many numbers are worked on at once, and how: here one, which compilers may make more of.
#[expect(non_camel_case_types, reason = "the names of `pulp`")]
pub(super) trait Simd: Copy {
    type f32s: Copy;
    type u32s: Copy;
    type m32s: Copy;

    const F32_LANES: usize;

    fn as_simd_f32s(numbers: &[f32]) -> (&[Self::f32s], &[f32]);
    fn as_mut_simd_f32s(numbers: &mut [f32]) -> (&mut [Self::f32s], &mut [f32]);
    fn as_mut_simd_u32s(numbers: &mut [u32]) -> (&mut [Self::u32s], &mut [u32]);
    fn splat_f32s(self, number: f32) -> Self::f32s;
    fn splat_u32s(self, number: u32) -> Self::u32s;
    fn add_f32s(self, a: Self::f32s, b: Self::f32s) -> Self::f32s;
    fn sub_f32s(self, a: Self::f32s, b: Self::f32s) -> Self::f32s;
    fn mul_f32s(self, a: Self::f32s, b: Self::f32s) -> Self::f32s;
    fn div_f32s(self, a: Self::f32s, b: Self::f32s) -> Self::f32s;
    fn max_f32s(self, a: Self::f32s, b: Self::f32s) -> Self::f32s;
    fn min_f32s(self, a: Self::f32s, b: Self::f32s) -> Self::f32s;
    fn sqrt_f32s(self, a: Self::f32s) -> Self::f32s;
    fn abs_f32s(self, a: Self::f32s) -> Self::f32s;
    fn less_than_f32s(self, a: Self::f32s, b: Self::f32s) -> Self::m32s;
    fn less_than_or_equal_f32s(self, a: Self::f32s, b: Self::f32s) -> Self::m32s;
    fn and_m32s(self, a: Self::m32s, b: Self::m32s) -> Self::m32s;
    fn and_u32s(self, a: Self::u32s, b: Self::u32s) -> Self::u32s;
    fn xor_u32s(self, a: Self::u32s, b: Self::u32s) -> Self::u32s;
    fn select_f32s(self, mask: Self::m32s, a: Self::f32s, b: Self::f32s) -> Self::f32s;
    fn select_u32s(self, mask: Self::m32s, a: Self::u32s, b: Self::u32s) -> Self::u32s;
}

/// Work that is compiled for a processor.
pub(super) trait WithSimd {
    type Output;

    fn with_simd<S: Simd>(self, simd: S) -> Self::Output;
}

/// One lane.
#[derive(Clone, Copy)]
pub(super) struct Scalar;

/// What the processor has: nothing is asked of it.
#[derive(Clone, Copy)]
pub(super) struct Arch;

impl Arch {
    pub(super) const fn new() -> Self {
        Self
    }

    #[inline(always)]
    #[expect(clippy::unused_self, reason = "as that of `pulp`")]
    pub(super) fn dispatch<W: WithSimd>(self, work: W) -> W::Output {
        work.with_simd(Scalar)
    }
}

/// Methods that are one expression of numbers.
macro_rules! lanes {
    ($($name:ident($($argument:ident: $kind:ty),+) -> $result:ty = $value:expr;)+) => {
        $(#[inline(always)]
        fn $name(self, $($argument: $kind),+) -> $result {
            $value
        })+
    };
}

impl Simd for Scalar {
    type f32s = f32;
    type u32s = u32;
    type m32s = bool;

    const F32_LANES: usize = 1;

    #[inline(always)]
    fn as_simd_f32s(numbers: &[f32]) -> (&[f32], &[f32]) {
        (numbers, &[])
    }

    #[inline(always)]
    fn as_mut_simd_f32s(numbers: &mut [f32]) -> (&mut [f32], &mut [f32]) {
        (numbers, &mut [])
    }

    #[inline(always)]
    fn as_mut_simd_u32s(numbers: &mut [u32]) -> (&mut [u32], &mut [u32]) {
        (numbers, &mut [])
    }

    lanes! {
        splat_f32s(number: f32) -> f32 = number;
        splat_u32s(number: u32) -> u32 = number;
        add_f32s(a: f32, b: f32) -> f32 = a + b;
        sub_f32s(a: f32, b: f32) -> f32 = a - b;
        mul_f32s(a: f32, b: f32) -> f32 = a * b;
        div_f32s(a: f32, b: f32) -> f32 = a / b;
        max_f32s(a: f32, b: f32) -> f32 = if a > b { a } else { b };
        min_f32s(a: f32, b: f32) -> f32 = if a < b { a } else { b };
        sqrt_f32s(a: f32) -> f32 = a.sqrt();
        abs_f32s(a: f32) -> f32 = a.abs();
        less_than_f32s(a: f32, b: f32) -> bool = a < b;
        less_than_or_equal_f32s(a: f32, b: f32) -> bool = a <= b;
        and_m32s(a: bool, b: bool) -> bool = a & b;
        and_u32s(a: u32, b: u32) -> u32 = a & b;
        xor_u32s(a: u32, b: u32) -> u32 = a ^ b;
        select_f32s(mask: bool, a: f32, b: f32) -> f32 = if mask { a } else { b };
        select_u32s(mask: bool, a: u32, b: u32) -> u32 = if mask { a } else { b };
    }
}
