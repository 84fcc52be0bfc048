//! Forward-mode automatic differentiation with all directions carried at once.

use crate::problem::real::Real;
use std::cmp::Ordering;
use std::f64::consts::PI;

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
    pub(super) fn chain(self, value: f64, derivative: f64) -> Self {
        Self {
            value,
            gradient: self.gradient.map(|g| derivative * g),
        }
    }

    /// f(x, y) by the chain rule, from the value and both partial derivatives.
    #[inline]
    pub(super) fn chain2(self, other: Self, value: f64, d_self: f64, d_other: f64) -> Self {
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

impl<const W: usize> PartialEq<f64> for Dual<W> {
    fn eq(&self, other: &f64) -> bool {
        self.value == *other
    }
}

impl<const W: usize> PartialOrd<f64> for Dual<W> {
    fn partial_cmp(&self, other: &f64) -> Option<Ordering> {
        self.value.partial_cmp(other)
    }
}

impl<const W: usize> From<f64> for Dual<W> {
    fn from(value: f64) -> Self {
        Self::constant(value)
    }
}

impl<const W: usize> Real for Dual<W> {
    const ZERO: Self = Self::constant(0.0);
    const ONE: Self = Self::constant(1.0);
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
    fn exp_m1(self) -> Self {
        self.chain(self.value.exp_m1(), self.value.exp())
    }
    #[inline]
    fn ln(self) -> Self {
        self.chain(self.value.ln(), 1.0 / self.value)
    }
    #[inline]
    fn ln_1p(self) -> Self {
        self.chain(self.value.ln_1p(), 1.0 / (1.0 + self.value))
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
    fn acos(self) -> Self {
        let derivative = -1.0 / ((1.0 - self.value) * (1.0 + self.value)).sqrt();
        self.chain(self.value.acos(), derivative)
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
    fn asinh(self) -> Self {
        self.chain(self.value.asinh(), 1.0 / self.value.hypot(1.0))
    }
    #[inline]
    fn acosh(self) -> Self {
        // A product of roots: that of x² − 1 would overflow for large x.
        let derivative = 1.0 / ((self.value - 1.0).sqrt() * (self.value + 1.0).sqrt());
        self.chain(self.value.acosh(), derivative)
    }
    #[inline]
    fn atanh(self) -> Self {
        let derivative = 1.0 / ((1.0 - self.value) * (1.0 + self.value));
        self.chain(self.value.atanh(), derivative)
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
    fn pow(self, exponent: Self) -> Self {
        let (x, a) = (self.value, exponent.value);
        let value = x.powf(a);
        let d_base = match a {
            0.0 => 0.0,
            _ => a * x.powf(a - 1.0),
        };
        // xᵃ ln x, whose limit at zero is zero. It is no number for a negative x, which matters only
        // where the exponent varies.
        let d_exponent = match x {
            0.0 if a > 0.0 => 0.0,
            _ => value * x.ln(),
        };
        let mut gradient = self.gradient.map(|g| d_base * g);
        for (g, of_exponent) in gradient.iter_mut().zip(exponent.gradient) {
            if of_exponent != 0.0 {
                *g += d_exponent * of_exponent;
            }
        }
        Self { value, gradient }
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
    #[inline]
    fn apply(self, function: impl FnOnce(f64) -> (f64, f64)) -> Self {
        let (value, derivative) = function(self.value);
        self.chain(value, derivative)
    }
}
