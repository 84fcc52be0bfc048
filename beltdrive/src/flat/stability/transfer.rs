//! The exact solution in a zone.
//!
//! With d² = a² + b, C = cosh d x and S = sinh(d x)/d, both even in d and therefore entire in σ,
//!
//! ```text
//! ⎡f (x)⎤             ⎡C − a S     S    ⎤ ⎡f (0)⎤
//! ⎣f'(x)⎦ = exp(a x)  ⎣  b S    C + a S ⎦ ⎣f'(0)⎦
//! ```

use super::scaled::Coefficients;
use faer::c64;

/// Below this |d x|² the hyperbolic functions come from their power series.
const SMALL: f64 = 1.0;
/// Terms of the series, whose last is below rounding.
const TERMS: u32 = 12;

/// A matrix that takes (f, f') from the start of a zone to a place in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Transfer {
    /// The matrix above without exp(a x), divided by exp(`log`).
    pub(super) matrix: [[c64; 2]; 2],
    /// Its derivative with respect to σ, divided by exp(`log`).
    pub(super) slope: [[c64; 2]; 2],
    /// Logarithm of a positive factor that keeps the matrix within bounds.
    pub(super) log: f64,
    /// The exponent a x.
    pub(super) drift: c64,
}

impl Transfer {
    /// The transfer over the length x.
    pub(super) fn new(coefficients: &Coefficients, x: f64) -> Self {
        let Coefficients {
            a,
            a_slope,
            b,
            b_slope,
        } = *coefficients;
        let square = a * a + b;
        let square_slope = a * (2.0 * a_slope) + b_slope;
        let Hyperbolic {
            cosh,
            sinh,
            sinh_slope,
            log,
        } = Hyperbolic::new(square, x);
        let cosh_slope = sinh * square_slope * (0.5 * x);
        let sinh_slope = sinh_slope * square_slope;
        let inclined = a * sinh;
        let inclined_slope = sinh * a_slope + a * sinh_slope;
        Self {
            matrix: [[cosh - inclined, sinh], [b * sinh, cosh + inclined]],
            slope: [
                [cosh_slope - inclined_slope, sinh_slope],
                [b_slope * sinh + b * sinh_slope, cosh_slope + inclined_slope],
            ],
            log,
            drift: a * x,
        }
    }

    /// The state at the end, without exp(a x) and divided by exp(`log`).
    pub(super) fn apply(&self, start: [c64; 2]) -> [c64; 2] {
        product(&self.matrix, start)
    }

    /// The derivative of [`apply`](Self::apply) where the start varies too, by `slope`.
    pub(super) fn apply_slope(&self, start: [c64; 2], slope: [c64; 2]) -> [c64; 2] {
        let [f, df] = product(&self.slope, start);
        let [g, dg] = product(&self.matrix, slope);
        [f + g, df + dg]
    }
}

fn product(matrix: &[[c64; 2]; 2], state: [c64; 2]) -> [c64; 2] {
    matrix.map(|row| row[0] * state[0] + row[1] * state[1])
}

/// cosh d x and sinh(d x)/d as functions of d², divided by exp(`log`).
struct Hyperbolic {
    cosh: c64,
    sinh: c64,
    /// Derivative of `sinh` with respect to d².
    sinh_slope: c64,
    log: f64,
}

impl Hyperbolic {
    fn new(square: c64, x: f64) -> Self {
        let z = square * (x * x);
        if z.norm_sqr() < SMALL * SMALL {
            return Self::series(z, x);
        }
        let d = square.sqrt();
        let (log, angle) = (d.re * x, d.im * x);
        let up = c64::from_polar(0.5, angle);
        let down = c64::from_polar(0.5 * (-2.0 * log).exp(), -angle);
        let (cosh, sinh) = (up + down, (up - down) / d);
        Self {
            cosh,
            sinh,
            sinh_slope: (cosh * x - sinh) / (square * 2.0),
            log,
        }
    }

    /// Horner's rule for Σ z^n/(2n)!, x Σ z^n/(2n + 1)! and x³ Σ (n + 1) z^n/(2n + 3)!.
    fn series(z: c64, x: f64) -> Self {
        let zero = c64::new(0.0, 0.0);
        let (mut cosh, mut sinh, mut slope) = (zero, zero, zero);
        for n in (0..TERMS).rev() {
            let n = f64::from(n);
            cosh = cosh * z / ((2.0 * n + 1.0) * (2.0 * n + 2.0)) + 1.0;
            sinh = sinh * z / ((2.0 * n + 2.0) * (2.0 * n + 3.0)) + 1.0;
            let ratio = (n + 2.0) / ((n + 1.0) * (2.0 * n + 4.0) * (2.0 * n + 5.0));
            slope = slope * z * ratio + 1.0;
        }
        Self {
            cosh,
            sinh: sinh * x,
            sinh_slope: slope * (x * x * x / 6.0),
            log: 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_series_continues_the_closed_form() {
        for angle in [0.0, 1.0, 2.0, 3.1] {
            let at = |r: f64| Hyperbolic::new(c64::from_polar(r, angle), 0.5);
            // z = ±1 apart from rounding, from both sides.
            let (inside, outside) = (at(4.0 - 1e-13), at(4.0 + 1e-13));
            let factor = outside.log.exp();
            assert!((inside.cosh - outside.cosh * factor).norm() < 1e-13);
            assert!((inside.sinh - outside.sinh * factor).norm() < 1e-13);
            assert!((inside.sinh_slope - outside.sinh_slope * factor).norm() < 1e-14);
        }
    }

    #[test]
    fn the_factor_keeps_stiff_zones_within_bounds() {
        let stiff = Hyperbolic::new(c64::new(1e12, 0.0), 1.0);
        assert_eq!(stiff.log, 1e6);
        assert!((stiff.cosh - 0.5).norm() < 1e-15);
    }
}
