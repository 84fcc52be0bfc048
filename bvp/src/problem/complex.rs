//! Complex states kept as pairs of real ones.

use crate::problem::real::Real;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A complex number re + i im over any [`Real`], for complex states, parameters and conditions.
///
/// States are real; a complex one takes two of them, its real and imaginary part one after the
/// other: complex number j of a slice lies at 2j and 2j + 1 ([`read`](Self::read),
/// [`write`](Self::write)). The Jacobians are then those of the real problem, exact like all others,
/// and the right-hand side need not be differentiable as a complex function: it may use
/// [`conj`](Self::conj) and [`norm_squared`](Self::norm_squared).
///
/// Arithmetic works with another complex number and with `f64` on either side (`2.0 * z`). A real number
/// of type `T` multiplies by [`scale`](Self::scale) and is added as `Complex::from(x)`.
///
/// ```
/// use bvp::{Complex, Real};
///
/// /// w′ = i ω w, one complex equation as two real ones.
/// fn rhs<T: Real>(y: &[T], omega: T, dy: &mut [T]) {
///     Complex::read(y, 0).times_i().scale(omega).write(dy, 0);
/// }
///
/// let mut dy = [0.0; 2];
/// rhs(&[3.0, 4.0], 2.0, &mut dy);
/// assert_eq!(dy, [-8.0, 6.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Complex<T> {
    /// Real part.
    pub re: T,
    /// Imaginary part.
    pub im: T,
}

impl<T: Real> Complex<T> {
    /// re + i im.
    pub const fn new(re: T, im: T) -> Self {
        Self { re, im }
    }

    /// Complex number `index` of a slice of pairs, the entries 2 `index` and 2 `index` + 1.
    ///
    /// # Panics
    /// If the slice is too short.
    pub fn read(pairs: &[T], index: usize) -> Self {
        Self::new(pairs[2 * index], pairs[2 * index + 1])
    }

    /// Writes this number as number `index` of a slice of pairs.
    ///
    /// # Panics
    /// If the slice is too short.
    pub fn write(self, pairs: &mut [T], index: usize) {
        pairs[2 * index] = self.re;
        pairs[2 * index + 1] = self.im;
    }

    /// The conjugate re − i im.
    #[must_use]
    pub fn conj(self) -> Self {
        Self::new(self.re, -self.im)
    }

    /// The square of the modulus, re² + im².
    pub fn norm_squared(self) -> T {
        self.re * self.re + self.im * self.im
    }

    /// i z, without a multiplication.
    #[must_use]
    pub fn times_i(self) -> Self {
        Self::new(-self.im, self.re)
    }

    /// The product with a real number.
    #[must_use]
    pub fn scale(self, factor: T) -> Self {
        Self::new(self.re * factor, self.im * factor)
    }

    /// eᶻ.
    #[must_use]
    pub fn exp(self) -> Self {
        let (sin, cos) = self.im.sin_cos();
        Self::new(cos, sin).scale(self.re.exp())
    }
}

impl<T: Real> From<T> for Complex<T> {
    /// A real number.
    fn from(re: T) -> Self {
        Self::new(re, T::ZERO)
    }
}

impl<T: Real> Neg for Complex<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.re, -self.im)
    }
}

impl<T: Real> Add for Complex<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.im + other.im)
    }
}

impl<T: Real> Sub for Complex<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.im - other.im)
    }
}

impl<T: Real> Mul for Complex<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::new(
            self.re * other.re - self.im * other.im,
            self.re * other.im + self.im * other.re,
        )
    }
}

impl<T: Real> Div for Complex<T> {
    type Output = Self;
    /// Divides numerator and denominator by the larger part of the denominator, so that its square
    /// cannot overflow (R. L. Smith, Algorithm 116, Commun. ACM 5 (1962) 435). Both parts are NaN
    /// where the denominator is zero.
    fn div(self, other: Self) -> Self {
        if other.re.abs() < other.im.abs() {
            // z/w = (i z)/(i w), and i w has its larger part in front.
            return self.times_i() / other.times_i();
        }
        let ratio = other.im / other.re;
        let denominator = other.re + other.im * ratio;
        Self::new(
            (self.re + self.im * ratio) / denominator,
            (self.im - self.re * ratio) / denominator,
        )
    }
}

impl<T: Real> Add<f64> for Complex<T> {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        Self::new(self.re + other, self.im)
    }
}

impl<T: Real> Sub<f64> for Complex<T> {
    type Output = Self;
    fn sub(self, other: f64) -> Self {
        Self::new(self.re - other, self.im)
    }
}

impl<T: Real> Mul<f64> for Complex<T> {
    type Output = Self;
    fn mul(self, other: f64) -> Self {
        Self::new(self.re * other, self.im * other)
    }
}

impl<T: Real> Div<f64> for Complex<T> {
    type Output = Self;
    fn div(self, other: f64) -> Self {
        Self::new(self.re / other, self.im / other)
    }
}

impl<T: Real> Add<Complex<T>> for f64 {
    type Output = Complex<T>;
    fn add(self, other: Complex<T>) -> Complex<T> {
        other + self
    }
}

impl<T: Real> Sub<Complex<T>> for f64 {
    type Output = Complex<T>;
    fn sub(self, other: Complex<T>) -> Complex<T> {
        -other + self
    }
}

impl<T: Real> Mul<Complex<T>> for f64 {
    type Output = Complex<T>;
    fn mul(self, other: Complex<T>) -> Complex<T> {
        other * self
    }
}

impl<T: Real> Div<Complex<T>> for f64 {
    type Output = Complex<T>;
    fn div(self, other: Complex<T>) -> Complex<T> {
        Complex::from(T::from_f64(self)) / other
    }
}

impl<T: Real> AddAssign for Complex<T> {
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<T: Real> SubAssign for Complex<T> {
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl<T: Real> MulAssign for Complex<T> {
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

impl<T: Real> DivAssign for Complex<T> {
    fn div_assign(&mut self, other: Self) {
        *self = *self / other;
    }
}
