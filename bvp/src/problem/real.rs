//! The scalar of a user's right-hand side.

use std::fmt::Debug;
use std::iter::Sum;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A real number that may carry derivatives: `f64` itself, or a [`Dual`](crate::Dual) number.
///
/// A right-hand side written over `T: Real` is evaluated with `f64` for values and with dual
/// numbers for exact Jacobians, from one source. Arithmetic works with `T` and with `f64` on the
/// right (`y * 2.0`), and with `f64` on the left (`2.0 * y`, `1.0 - y`) in functions that say
/// `where f64: `[`LeftOf`]`<T>`. Elementary functions have their standard-library names; any other
/// function of one variable enters by [`apply`](Self::apply). Comparisons, with `T` and with `f64` on
/// the right (`s < 0.5`), look at the value only, so a branch is differentiated along the side that is
/// taken.
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + PartialOrd<f64>
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
    + AddAssign<f64>
    + SubAssign<f64>
    + MulAssign<f64>
    + DivAssign<f64>
    + Sum
    + From<f64>
{
    /// The constant 0.
    const ZERO: Self;
    /// The constant 1.
    const ONE: Self;
    /// The constant `value`, with no derivative.
    fn from_f64(value: f64) -> Self;
    /// The value alone, for branching.
    fn value(self) -> f64;
    /// eˣ.
    fn exp(self) -> Self;
    /// eˣ − 1, accurate near x = 0.
    fn exp_m1(self) -> Self;
    /// Natural logarithm; NaN for a negative argument.
    fn ln(self) -> Self;
    /// ln(1 + x), accurate near x = 0; NaN for x < −1.
    fn ln_1p(self) -> Self;
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
    /// Arc sine, in \[−π/2, π/2\]; NaN outside \[−1, 1\], infinite derivative at ±1.
    fn asin(self) -> Self;
    /// Arc cosine, in \[0, π\]; NaN outside \[−1, 1\], infinite derivative at ±1.
    fn acos(self) -> Self;
    /// Hyperbolic sine.
    fn sinh(self) -> Self;
    /// Hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Inverse hyperbolic sine.
    fn asinh(self) -> Self;
    /// Inverse hyperbolic cosine, at least 0; NaN below 1, infinite derivative at 1.
    fn acosh(self) -> Self;
    /// Inverse hyperbolic tangent; NaN outside \[−1, 1\], infinite at ±1.
    fn atanh(self) -> Self;
    /// Square root; NaN for a negative argument, infinite derivative at zero.
    fn sqrt(self) -> Self;
    /// Integer power.
    fn powi(self, n: i32) -> Self;
    /// Real power with a constant exponent.
    fn powf(self, exponent: f64) -> Self;
    /// Real power with an exponent that may depend on unknowns, too. A negative number has a power
    /// only where the exponent is a whole number, and a derivative only where it does not vary.
    fn pow(self, exponent: Self) -> Self;
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
    /// A function that is not here, given by its value and its derivative: `function(x)` returns
    /// (f(x), f'(x)) for the value x of this number. The derivative must be that of the function, or
    /// Newton's method converges slowly or not at all; [`check_jacobians`](crate::check_jacobians)
    /// compares it with differences.
    ///
    /// A function of several variables is a sum with the value in one of its terms,
    /// f(x, y) = `x.apply(|_| (f, ∂f/∂x)) + y.apply(|_| (0.0, ∂f/∂y))`.
    ///
    /// ```
    /// use bvp::Real;
    ///
    /// /// The cardinal sine sin x / x.
    /// fn sinc<T: Real>(x: T) -> T {
    ///     x.apply(|x| (x.sin() / x, (x.cos() - x.sin() / x) / x))
    /// }
    ///
    /// assert_eq!(sinc(2.0), 2f64.sin() / 2.0);
    /// ```
    fn apply(self, function: impl FnOnce(f64) -> (f64, f64)) -> Self;
}

/// A number that may stand on the left of a `T`: `f64` beside every [`Real`] of this crate.
///
/// Rust does not let `2.0 * y` be declared for every `T: Real` at once, but a function may ask for
/// it. [`Problem::rhs`](crate::Problem::rhs) and [`Problem::conditions`](crate::Problem::conditions)
/// do; repeat their `where f64: LeftOf<T>` to use it, in functions of your own as well. An
/// implementation that has numbers on the right only may leave it out.
///
/// ```
/// use bvp::{LeftOf, Real};
///
/// fn logistic<T: Real>(y: T) -> T
/// where
///     f64: LeftOf<T>,
/// {
///     1.0 / (1.0 + 2.0 * (-y).exp())
/// }
///
/// assert_eq!(logistic(0.0), 1.0 / 3.0);
/// ```
// Beside a bound on `f64 * T` alone the compiler would take every `f64 * f64` of the function for one of
// these; with both it looks at the right side.
pub trait LeftOf<T>:
    Add<T, Output = T>
    + Sub<T, Output = T>
    + Mul<T, Output = T>
    + Div<T, Output = T>
    + Add<f64, Output = f64>
    + Sub<f64, Output = f64>
    + Mul<f64, Output = f64>
    + Div<f64, Output = f64>
{
}

impl<T> LeftOf<T> for f64 where
    Self: Add<T, Output = T> + Sub<T, Output = T> + Mul<T, Output = T> + Div<T, Output = T>
{
}

impl Real for f64 {
    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    #[inline]
    fn from_f64(value: f64) -> Self {
        value
    }
    #[inline]
    fn value(self) -> f64 {
        self
    }
    #[inline]
    fn exp(self) -> Self {
        self.exp()
    }
    #[inline]
    fn exp_m1(self) -> Self {
        self.exp_m1()
    }
    #[inline]
    fn ln(self) -> Self {
        self.ln()
    }
    #[inline]
    fn ln_1p(self) -> Self {
        self.ln_1p()
    }
    #[inline]
    fn sin(self) -> Self {
        self.sin()
    }
    #[inline]
    fn cos(self) -> Self {
        self.cos()
    }
    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }
    #[inline]
    fn tan(self) -> Self {
        self.tan()
    }
    #[inline]
    fn atan(self) -> Self {
        self.atan()
    }
    #[inline]
    fn atan2(self, other: Self) -> Self {
        self.atan2(other)
    }
    #[inline]
    fn asin(self) -> Self {
        self.asin()
    }
    #[inline]
    fn acos(self) -> Self {
        self.acos()
    }
    #[inline]
    fn sinh(self) -> Self {
        self.sinh()
    }
    #[inline]
    fn cosh(self) -> Self {
        self.cosh()
    }
    #[inline]
    fn tanh(self) -> Self {
        self.tanh()
    }
    #[inline]
    fn asinh(self) -> Self {
        self.asinh()
    }
    #[inline]
    fn acosh(self) -> Self {
        self.acosh()
    }
    #[inline]
    fn atanh(self) -> Self {
        self.atanh()
    }
    #[inline]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
    #[inline]
    fn powi(self, n: i32) -> Self {
        self.powi(n)
    }
    #[inline]
    fn powf(self, exponent: f64) -> Self {
        self.powf(exponent)
    }
    #[inline]
    fn pow(self, exponent: Self) -> Self {
        self.powf(exponent)
    }
    #[inline]
    fn abs(self) -> Self {
        self.abs()
    }
    #[inline]
    fn hypot(self, other: Self) -> Self {
        self.hypot(other)
    }
    #[inline]
    fn erf(self) -> Self {
        libm::erf(self)
    }
    #[inline]
    fn apply(self, function: impl FnOnce(Self) -> (Self, Self)) -> Self {
        function(self).0
    }
}
