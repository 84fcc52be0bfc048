//! Sums, differences, products and quotients of dual numbers and plain ones, by the rules of differentiation.

use crate::problem::dual::Dual;
use crate::problem::real::Real;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

impl<const W: usize> Neg for Dual<W> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0)
    }
}

impl<const W: usize> Add for Dual<W> {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        self.chain2(other, self.value + other.value, 1.0, 1.0)
    }
}

impl<const W: usize> Sub for Dual<W> {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self.chain2(other, self.value - other.value, 1.0, -1.0)
    }
}

impl<const W: usize> Mul for Dual<W> {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        self.chain2(other, self.value * other.value, other.value, self.value)
    }
}

impl<const W: usize> Div for Dual<W> {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let inverse = 1.0 / other.value;
        let quotient = self.value / other.value;
        self.chain2(other, quotient, inverse, -quotient * inverse)
    }
}

impl<const W: usize> Add<f64> for Dual<W> {
    type Output = Self;
    #[inline]
    fn add(mut self, other: f64) -> Self {
        self.value += other;
        self
    }
}

impl<const W: usize> Sub<f64> for Dual<W> {
    type Output = Self;
    #[inline]
    fn sub(mut self, other: f64) -> Self {
        self.value -= other;
        self
    }
}

impl<const W: usize> Mul<f64> for Dual<W> {
    type Output = Self;
    #[inline]
    fn mul(self, other: f64) -> Self {
        self.chain(self.value * other, other)
    }
}

impl<const W: usize> Div<f64> for Dual<W> {
    type Output = Self;
    #[inline]
    fn div(self, other: f64) -> Self {
        self.chain(self.value / other, 1.0 / other)
    }
}

impl<const W: usize> AddAssign for Dual<W> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const W: usize> SubAssign for Dual<W> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<const W: usize> MulAssign for Dual<W> {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<const W: usize> DivAssign for Dual<W> {
    #[inline]
    fn div_assign(&mut self, other: Self) {
        *self = *self / other;
    }
}

impl<const W: usize> Add<Dual<W>> for f64 {
    type Output = Dual<W>;
    #[inline]
    fn add(self, other: Dual<W>) -> Dual<W> {
        other + self
    }
}

impl<const W: usize> Sub<Dual<W>> for f64 {
    type Output = Dual<W>;
    #[inline]
    fn sub(self, other: Dual<W>) -> Dual<W> {
        other.chain(self - other.value, -1.0)
    }
}

impl<const W: usize> Mul<Dual<W>> for f64 {
    type Output = Dual<W>;
    #[inline]
    fn mul(self, other: Dual<W>) -> Dual<W> {
        other * self
    }
}

impl<const W: usize> Div<Dual<W>> for f64 {
    type Output = Dual<W>;
    #[inline]
    fn div(self, other: Dual<W>) -> Dual<W> {
        let quotient = self / other.value;
        other.chain(quotient, -quotient / other.value)
    }
}

impl<const W: usize> AddAssign<f64> for Dual<W> {
    #[inline]
    fn add_assign(&mut self, other: f64) {
        *self = *self + other;
    }
}

impl<const W: usize> SubAssign<f64> for Dual<W> {
    #[inline]
    fn sub_assign(&mut self, other: f64) {
        *self = *self - other;
    }
}

impl<const W: usize> MulAssign<f64> for Dual<W> {
    #[inline]
    fn mul_assign(&mut self, other: f64) {
        *self = *self * other;
    }
}

impl<const W: usize> DivAssign<f64> for Dual<W> {
    #[inline]
    fn div_assign(&mut self, other: f64) {
        *self = *self / other;
    }
}

impl<const W: usize> Sum for Dual<W> {
    fn sum<I: Iterator<Item = Self>>(terms: I) -> Self {
        terms.fold(Self::ZERO, Add::add)
    }
}
