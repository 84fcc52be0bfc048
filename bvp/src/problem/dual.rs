//! Forward-mode automatic differentiation with all directions carried at once.

use crate::problem::real::Real;
use std::cmp::Ordering;
use std::f64::consts::PI;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A value with its derivatives in `W` directions: x + Σ xᵢ εᵢ with εᵢ εⱼ = 0.
///
/// A fixed width vectorises, and every transcendental function is evaluated once for all
/// directions, which makes exact Jacobians cheaper than finite differences.
#[derive(Clone, Copy, Debug)]
pub struct Dual<const W: usize> {
    /// The value x.
    pub value: f64,
    /// The derivatives xᵢ of the value in each direction.
    pub gradient: [f64; W],
}

impl<const W: usize> Dual<W> {
    /// The independent variables of all directions, where they are zero.
    pub(crate) const VARIABLES: [Self; W] = {
        let mut variables = [Self::constant(0.0); W];
        let mut direction = 0;
        while direction < W {
            variables[direction].gradient[direction] = 1.0;
            direction += 1;
        }
        variables
    };

    /// A constant: all derivatives zero.
    pub const fn constant(value: f64) -> Self {
        Self {
            value,
            gradient: [0.0; W],
        }
    }

    /// The independent variable of direction `direction`: derivative 1 there, 0 elsewhere.
    ///
    /// # Panics
    /// If `direction >= W`.
    pub fn variable(value: f64, direction: usize) -> Self {
        let mut gradient = [0.0; W];
        gradient[direction] = 1.0;
        Self { value, gradient }
    }

    /// f(x) by the chain rule, from the value f and the derivative f' at x.
    #[inline]
    fn chain(self, value: f64, derivative: f64) -> Self {
        Self {
            value,
            gradient: self.gradient.map(|g| derivative * g),
        }
    }

    /// f(x, y) by the chain rule, from the value and both partial derivatives.
    #[inline]
    fn chain2(self, other: Self, value: f64, d_self: f64, d_other: f64) -> Self {
        let mut gradient = [0.0; W];
        for ((g, a), b) in gradient.iter_mut().zip(self.gradient).zip(other.gradient) {
            *g = d_self * a + d_other * b;
        }
        Self { value, gradient }
    }
}

impl<const W: usize> PartialEq for Dual<W> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<const W: usize> PartialOrd for Dual<W> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<const W: usize> From<f64> for Dual<W> {
    fn from(value: f64) -> Self {
        Self::constant(value)
    }
}

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

impl<const W: usize> Real for Dual<W> {
    fn from_f64(value: f64) -> Self {
        Self::constant(value)
    }
    fn value(self) -> f64 {
        self.value
    }
    #[inline]
    fn exp(self) -> Self {
        let e = self.value.exp();
        self.chain(e, e)
    }
    #[inline]
    fn ln(self) -> Self {
        self.chain(self.value.ln(), 1.0 / self.value)
    }
    #[inline]
    fn sin(self) -> Self {
        let (sin, cos) = self.value.sin_cos();
        self.chain(sin, cos)
    }
    #[inline]
    fn cos(self) -> Self {
        let (sin, cos) = self.value.sin_cos();
        self.chain(cos, -sin)
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    #[inline]
    fn tan(self) -> Self {
        let t = self.value.tan();
        self.chain(t, 1.0 + t * t)
    }
    #[inline]
    fn atan(self) -> Self {
        self.chain(self.value.atan(), 1.0 / (1.0 + self.value * self.value))
    }
    #[inline]
    fn atan2(self, other: Self) -> Self {
        // Scaled by the larger of the two, so that the square of the radius cannot overflow.
        let scale = self.value.abs().max(other.value.abs());
        let (y, x) = (self.value / scale, other.value / scale);
        let r2 = (x * x + y * y) * scale;
        self.chain2(other, self.value.atan2(other.value), x / r2, -y / r2)
    }
    #[inline]
    fn asin(self) -> Self {
        let derivative = 1.0 / ((1.0 - self.value) * (1.0 + self.value)).sqrt();
        self.chain(self.value.asin(), derivative)
    }
    #[inline]
    fn sinh(self) -> Self {
        self.chain(self.value.sinh(), self.value.cosh())
    }
    #[inline]
    fn cosh(self) -> Self {
        self.chain(self.value.cosh(), self.value.sinh())
    }
    #[inline]
    fn tanh(self) -> Self {
        let t = self.value.tanh();
        self.chain(t, (1.0 - t) * (1.0 + t))
    }
    #[inline]
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }
    #[inline]
    fn powi(self, n: i32) -> Self {
        if n == 0 {
            return Self::constant(1.0);
        }
        self.chain(self.value.powi(n), f64::from(n) * self.value.powi(n - 1))
    }
    #[inline]
    fn powf(self, exponent: f64) -> Self {
        if exponent == 0.0 {
            return Self::constant(1.0);
        }
        self.chain(
            self.value.powf(exponent),
            exponent * self.value.powf(exponent - 1.0),
        )
    }
    #[inline]
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    #[inline]
    fn hypot(self, other: Self) -> Self {
        let h = self.value.hypot(other.value);
        self.chain2(other, h, self.value / h, other.value / h)
    }
    #[inline]
    fn erf(self) -> Self {
        let derivative = 2.0 / PI.sqrt() * (-self.value * self.value).exp();
        self.chain(libm::erf(self.value), derivative)
    }
}
