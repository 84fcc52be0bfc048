//! Second derivatives of a system along a line.

use crate::curve::curve::ahead;
use crate::system::difference::{Difference, Stencil, UNCHANGED, largest};
use crate::system::system::System;

/// How accurately a second derivative is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Precision {
    /// To about 1e-7: enough for Newton's method.
    Rough,
    /// To about 1e-10, or 1e-12 where the system has exact derivatives.
    Fine,
}

/// Step of the rough differences in the arclength norm: second differences of second order have an error of
/// 1e-8 by truncation and 1e-8 by rounding.
const ROUGH: f64 = 2e-4;
/// Step of the fine ones, of sixth order: 1e-14 by truncation and 1e-11 by rounding.
const FINE: f64 = 5e-3;
/// Steps tried, as shares of these: shorter ones where G is not finite, or not resolved.
const SHARES: [f64; 3] = [1.0, 1.0 / 8.0, 1.0 / 64.0];
/// A step resolves G if formulas of sixth and of fourth order differ by no more than this share of their
/// terms: the former is then accurate to about the power 3/2 of it.
const RESOLVED: f64 = 1e-6;
/// A shorter step is taken for better if it resolves G this many times better. Truncation falls by 4096;
/// less may be noise, which shorter steps enlarge.
const BETTER: f64 = 10.0;

/// Where a second derivative changes by more than this share over a step, a shorter one shows whether G has
/// a kink: with smaller ones corrections still shrink to a tenth.
const SKEW: f64 = 0.1;

/// The line z + s d, on which the last unknown stays within bounds. Where z and d have one number more than
/// the system has unknowns, that is μ.
pub(crate) struct Line<'l> {
    pub(crate) z: &'l [f64],
    pub(crate) direction: &'l [f64],
    pub(crate) bounds: [f64; 2],
    /// The sizes of the equations: how well a step resolves each is measured relative to its own.
    pub(crate) sizes: &'l [f64],
}

/// A second derivative of G.
pub(crate) struct Second {
    pub(crate) values: Vec<f64>,
    /// By how much formulas of sixth and of fourth order differ, the largest relative to the sizes of the
    /// equations: more than the error where G is smooth. Infinite for rough derivatives, of which it is not
    /// known.
    pub(crate) doubt: f64,
    /// What the derivative jumps by at a kink of G nearby, in the same measure: zero or small where G is
    /// smooth.
    pub(crate) kink: f64,
}

impl Line<'_> {
    /// d²G/ds² at s = 0. `prepare` is called with every place before the system is evaluated there.
    pub(crate) fn second_derivative<S: System>(
        &self,
        system: &mut S,
        precision: Precision,
        mut prepare: impl FnMut(&mut S, &[f64]),
    ) -> Second {
        let unknowns = system.unknowns();
        let mut centre = vec![f64::NAN; unknowns - 1];
        prepare(system, self.z);
        let z = &self.z[..unknowns];
        let exact = system.derivative_along(z, self.direction, &mut centre);
        if !exact {
            system.residual(z, &mut centre);
        }
        let mut at = |s: f64, g: &mut [f64]| {
            let moved = self.moved(s);
            prepare(system, &moved);
            let z = &moved[..unknowns];
            if !exact {
                system.residual(z, g);
            } else if !system.derivative_along(z, self.direction, g) {
                g.fill(f64::NAN);
            }
        };
        let [behind, ahead] = self.room();
        if precision == Precision::Rough && behind.min(ahead) >= ROUGH {
            Second {
                values: self.rough(exact, &centre, &mut at),
                doubt: f64::INFINITY,
                kink: 0.0,
            }
        } else {
            self.fine(exact, &centre, &mut at)
        }
    }

    /// The second difference of G, or the difference of its exact derivatives, at two places.
    fn rough(&self, exact: bool, centre: &[f64], at: &mut impl FnMut(f64, &mut [f64])) -> Vec<f64> {
        let [mut ahead, mut behind] = [(); 2].map(|()| vec![f64::NAN; centre.len()]);
        let mut second = Vec::new();
        for h in SHARES.map(|share| share * ROUGH) {
            at(h, &mut ahead);
            at(-h, &mut behind);
            let triples = ahead.iter().zip(&behind).zip(centre);
            second = triples
                .map(|((ahead, behind), centre)| {
                    if exact {
                        (ahead - behind) / (2.0 * h)
                    } else {
                        (ahead - centre + behind - centre) / (h * h)
                    }
                })
                .collect();
            if second.iter().all(|g| g.is_finite()) {
                break;
            }
        }
        second
    }

    /// By formulas of sixth order, with shorter steps where these do not resolve G.
    fn fine(&self, exact: bool, centre: &[f64], at: &mut impl FnMut(f64, &mut [f64])) -> Second {
        let (room, order) = (self.room(), if exact { 1 } else { 2 });
        let mut with_step = |h: f64| {
            let formula = if exact {
                Stencil::first
            } else {
                Stencil::second
            };
            let (stencil, h) = formula(room, h);
            stencil.apply(centre, h, &mut *at)
        };
        let mut best: Option<(f64, Difference)> = None;
        for h in SHARES.map(|share| share * FINE) {
            let found = with_step(h);
            let unresolved = found.unresolved(self.sizes, 0.0);
            let least = best.as_ref().map_or(f64::INFINITY, |best| best.0);
            if best.is_none() || BETTER * unresolved < least {
                best = Some((unresolved, found));
            }
            if unresolved <= RESOLVED || unresolved == UNCHANGED {
                break;
            }
        }
        let Some((_, found)) = best else {
            return Second {
                values: Vec::new(),
                doubt: f64::INFINITY,
                kink: 0.0,
            };
        };
        let rate = |changes: &[f64], found: &Difference| {
            largest(changes, self.sizes) / found.step.powi(order)
        };
        let doubt = rate(&found.misses, &found);
        let mut kink = doubt;
        if rate(&found.skews, &found) > SKEW * largest(&found.values, self.sizes) {
            // A smooth function is less skew over a shorter step, and one with a kink is not.
            let shortest = with_step(SHARES[SHARES.len() - 1] * FINE);
            let jumps = [&shortest.skews, &shortest.misses].map(|each| rate(each, &shortest));
            kink = jumps.into_iter().fold(kink, f64::max);
        }
        Second {
            values: found.values,
            doubt,
            kink,
        }
    }

    /// The place at s.
    pub(crate) fn moved(&self, s: f64) -> Vec<f64> {
        let mut moved = ahead(self.z, self.direction, s);
        let [low, high] = self.bounds;
        if let Some(last) = moved.last_mut() {
            // Rounding may lead beyond.
            *last = last.clamp(low, high);
        }
        moved
    }

    /// How far s may go back and ahead.
    pub(crate) fn room(&self) -> [f64; 2] {
        let n = self.z.len() - 1;
        let [low, high] = self
            .bounds
            .map(|bound| (bound - self.z[n]) / self.direction[n]);
        if self.direction[n] == 0.0 {
            [f64::INFINITY; 2]
        } else {
            [-low.min(high), low.max(high)]
        }
    }
}

/// The mixed derivative ∂²G(a, b) from those along a + b, a and b.
pub(crate) fn mixed(both: &[f64], a: &[f64], b: &[f64]) -> Vec<f64> {
    let triples = both.iter().zip(a).zip(b);
    triples.map(|((both, a), b)| 0.5 * (both - a - b)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::system::dense::DenseSystem;

    fn second(
        system: &mut DenseSystem,
        z: [f64; 2],
        bounds: [f64; 2],
        precision: Precision,
    ) -> f64 {
        let line = Line {
            z: &z,
            direction: &[1.0, 1.0],
            bounds,
            sizes: &[1.0],
        };
        line.second_derivative(system, precision, |_, _| {}).values[0]
    }

    const ANYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

    #[test]
    fn second_derivatives_are_as_accurate_as_they_say() {
        let curve = |x: &[f64], p: &[f64], g: &mut [f64]| g[0] = (x[0] + p[0]).exp();
        let mut plain = DenseSystem::new(1, &[0.0], 0, curve);
        let mut exact = plain
            .clone()
            .with_jacobian(|x, p, j| j.fill((x[0] + p[0]).exp()));
        for (system, rough, fine) in [(&mut plain, 4e-7, 4e-10), (&mut exact, 2e-7, 1e-12)] {
            let found = second(system, [0.0; 2], ANYWHERE, Precision::Rough);
            assert!((found - 4.0).abs() < rough, "{found}");
            let found = second(system, [0.0; 2], ANYWHERE, Precision::Fine);
            assert!((found - 4.0).abs() < fine, "{found}");
        }
        // Within the bounds, at one of them.
        let found = second(&mut exact, [0.0; 2], [0.0, 1.0], Precision::Fine);
        assert!((found - 4.0).abs() < 1e-11, "{found}");
        // Defined for x > −1e-3 only.
        let edge = |x: &[f64], _: &[f64], g: &mut [f64]| g[0] = (x[0] + 1e-3).powf(2.5);
        let mut system = DenseSystem::new(1, &[0.0], 0, edge);
        let exact = 3.75 * 1e-3f64.sqrt();
        let found = second(&mut system, [0.0; 2], ANYWHERE, Precision::Fine);
        assert!((found / exact - 1.0).abs() < 1e-6, "{found}");
    }

    #[test]
    fn narrow_features_are_resolved() {
        for width in [1e-2, 3e-3] {
            let bump = move |x: &[f64], _: &[f64], g: &mut [f64]| g[0] = (x[0] / width).tanh();
            let mut system = DenseSystem::new(1, &[0.0], 0, bump);
            let z = [0.3 * width, 0.0];
            let t = 0.3f64.tanh();
            let exact = -2.0 * t * (1.0 - t * t) / (width * width);
            let found = second(&mut system, z, ANYWHERE, Precision::Fine);
            assert!((found / exact - 1.0).abs() < 1e-5, "{found} {exact}");
        }
    }

    #[test]
    fn each_equation_is_resolved_relative_to_its_size() {
        let width = 3e-3;
        let t = 0.3f64.tanh();
        let exact = -2.0 * t * (1.0 - t * t) / (width * width);
        for exponent in (-12..=12).step_by(4) {
            let size = 10f64.powi(exponent);
            let mut system = DenseSystem::new(2, &[0.0], 0, move |x, _, g| {
                g[0] = size * (x[0] / width).tanh();
                g[1] = x[1].exp();
            });
            let line = Line {
                z: &[0.3 * width, 0.0, 0.0],
                direction: &[1.0, 1.0, 0.0],
                bounds: ANYWHERE,
                sizes: &[size, 1.0],
            };
            let found = line.second_derivative(&mut system, Precision::Fine, |_, _| {});
            let found = found.values[0] / size;
            assert!(
                (found / exact - 1.0).abs() < 1e-5,
                "{size:e}: {found} {exact}"
            );
        }
    }
}
