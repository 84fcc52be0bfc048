//! The scalar of a user's right-hand side.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A real number that may carry derivatives: `f64` itself, or a [`Dual`](crate::Dual) number.
///
/// A right-hand side written over `T: Real` is evaluated with `f64` for values and with dual
/// numbers for exact Jacobians, from one source. Arithmetic works with `T` and with `f64` on the
/// right (`y * 2.0`); elementary functions have their standard-library names. Comparisons look at
/// the value only, so a branch is differentiated along the side that is taken.
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + DivAssign
    + From<f64>
{
    /// The constant `value`, with no derivative.
    fn from_f64(value: f64) -> Self;
    /// The value alone, for branching.
    fn value(self) -> f64;
    /// eˣ.
    fn exp(self) -> Self;
    /// Natural logarithm; NaN for a negative argument.
    fn ln(self) -> Self;
    /// Sine, argument in radians.
    fn sin(self) -> Self;
    /// Cosine, argument in radians.
    fn cos(self) -> Self;
    /// Sine and cosine together, argument in radians.
    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    /// Tangent, argument in radians.
    fn tan(self) -> Self;
    /// Arc tangent, in (−π/2, π/2).
    fn atan(self) -> Self;
    /// Angle of the point (`other`, `self`), in (−π, π].
    fn atan2(self, other: Self) -> Self;
    /// Arc sine, in \[−π/2, π/2\]; NaN outside \[−1, 1\].
    fn asin(self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Square root; NaN for a negative argument, infinite derivative at zero.
    fn sqrt(self) -> Self;
    /// Integer power.
    fn powi(self, n: i32) -> Self;
    /// Real power with a constant exponent.
    fn powf(self, exponent: f64) -> Self;
    /// Absolute value; derivative +1 at zero.
    fn abs(self) -> Self;
    /// Square root of the sum of squares, without overflow in the value.
    fn hypot(self, other: Self) -> Self;
    /// The smaller of two numbers, with its derivative (that of `self` in a tie).
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }
    /// The larger of two numbers, with its derivative (that of `self` in a tie).
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
    /// Error function 2/√π ∫₀ˣ exp(−t²) dt.
    fn erf(self) -> Self;
}

impl Real for f64 {
    fn from_f64(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
    }
    fn exp(self) -> Self {
        self.exp()
    }
    fn ln(self) -> Self {
        self.ln()
    }
    fn sin(self) -> Self {
        self.sin()
    }
    fn cos(self) -> Self {
        self.cos()
    }
    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }
    fn tan(self) -> Self {
        self.tan()
    }
    fn atan(self) -> Self {
        self.atan()
    }
    fn atan2(self, other: Self) -> Self {
        self.atan2(other)
    }
    fn asin(self) -> Self {
        self.asin()
    }
    fn sinh(self) -> Self {
        self.sinh()
    }
    fn cosh(self) -> Self {
        self.cosh()
    }
    fn tanh(self) -> Self {
        self.tanh()
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    fn powi(self, n: i32) -> Self {
        self.powi(n)
    }
    fn powf(self, exponent: f64) -> Self {
        self.powf(exponent)
    }
    fn abs(self) -> Self {
        self.abs()
    }
    fn hypot(self, other: Self) -> Self {
        self.hypot(other)
    }
    fn erf(self) -> Self {
        libm::erf(self)
    }
}
