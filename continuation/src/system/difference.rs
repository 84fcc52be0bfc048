//! Derivatives by differences, with steps that resolve the function.
//!
//! Every formula has sixth order, and one of fourth order on the same places beside it. Their difference
//! says whether a step resolves the function: it falls with the fourth power of steps that are too long,
//! and grows with the reciprocal of those so short that rounding dominates.

/// The step relative to 1 + |z| at which truncation and rounding of sixth order balance for functions that
/// vary on the scale of one: ε^(1/7).
const STEP: f64 = 5.8e-3;
/// A step resolves a function when both orders differ by this share of the terms that are added up: the
/// formula of sixth order is then accurate to about the power 3/2 of it.
const RESOLVED: f64 = 1e-8;
/// The rounding of functions, relative to the largest change that steps of the usual length make: a change
/// may vanish in it and look linear.
pub(crate) const ROUNDING: f64 = f64::EPSILON / STEP;
/// Where they differ by more than this, a step is no good.
pub(crate) const IRREGULAR: f64 = 1e-2;
/// Where they differ by less than this, the functions are regular on the scale of the step: those a little
/// shorter resolve them, and much shorter ones would only resolve noise.
const REGULAR: f64 = 1e-4;
/// The shorter steps that are tried then.
const FEW_TRIALS: i32 = 2;
/// A step is taken for better if it resolves the function this many times better. Truncation changes by 4096
/// from step to step; less may be chance in noise, which shorter steps enlarge.
const BETTER: f64 = 4.0;
/// Functions that do not change over a step count as unresolved to this share.
pub(crate) const UNCHANGED: f64 = f64::MAX;
/// A longer step is taken for no better if it changes a derivative by more than this many times what is
/// unresolved of it: over a narrow feature formulas with long steps agree that there is none.
const UNCERTAIN: f64 = 30.0;
/// Shorter steps are tried at once where the unknown is expected to change by less than this share of the
/// usual scale, ...
const NARROW: f64 = 1e-2;
/// ... and taken if they contradict a difference by this share of its terms.
const CONTRADICTION: f64 = 1e-3;
/// From one step to the next one tried.
const RATIO: f64 = 8.0;
/// The most steps tried in either direction: they span the factor 7e10.
const TRIALS: i32 = 12;
/// What is accepted without a search exceeds what the last search found at most by this factor: noise
/// varies that much.
const VARIATION: f64 = 10.0;

/// A place, in steps, with its weights in the formulas of sixth and of fourth order and in that of the skewness:
/// the change of the derivative over a step, which symmetric formulas do not see. None from one side.
type Place = (f64, f64, f64, f64);

/// A formula for a derivative of this order.
pub(crate) struct Stencil {
    order: i32,
    places: &'static [Place],
}

/// The first derivative from both sides.
const CENTRAL: Stencil = Stencil {
    order: 1,
    places: &[
        (-3.0, -1.0 / 60.0, 0.0, 0.0),
        (-2.0, 3.0 / 20.0, 1.0 / 12.0, 0.0),
        (-1.0, -3.0 / 4.0, -2.0 / 3.0, 1.0),
        (1.0, 3.0 / 4.0, 2.0 / 3.0, 1.0),
        (2.0, -3.0 / 20.0, -1.0 / 12.0, 0.0),
        (3.0, 1.0 / 60.0, 0.0, 0.0),
    ],
};
/// The first derivative from one side.
const ONE_SIDED: Stencil = Stencil {
    order: 1,
    places: &[
        (1.0, 6.0, 4.0, 0.0),
        (2.0, -15.0 / 2.0, -3.0, 0.0),
        (3.0, 20.0 / 3.0, 4.0 / 3.0, 0.0),
        (4.0, -15.0 / 4.0, -1.0 / 4.0, 0.0),
        (5.0, 6.0 / 5.0, 0.0, 0.0),
        (6.0, -1.0 / 6.0, 0.0, 0.0),
    ],
};
/// The second derivative from both sides.
const SECOND: Stencil = Stencil {
    order: 2,
    places: &[
        (-3.0, 1.0 / 90.0, 0.0, 0.0),
        (-2.0, -3.0 / 20.0, -1.0 / 12.0, -1.0),
        (-1.0, 3.0 / 2.0, 4.0 / 3.0, 2.0),
        (1.0, 3.0 / 2.0, 4.0 / 3.0, -2.0),
        (2.0, -3.0 / 20.0, -1.0 / 12.0, 1.0),
        (3.0, 1.0 / 90.0, 0.0, 0.0),
    ],
};

/// The second derivative from one side.
const SECOND_ONE_SIDED: Stencil = Stencil {
    order: 2,
    places: &[
        (1.0, -223.0 / 10.0, -77.0 / 6.0, 0.0),
        (2.0, 879.0 / 20.0, 107.0 / 6.0, 0.0),
        (3.0, -949.0 / 18.0, -13.0, 0.0),
        (4.0, 41.0, 61.0 / 12.0, 0.0),
        (5.0, -201.0 / 10.0, -5.0 / 6.0, 0.0),
        (6.0, 1019.0 / 180.0, 0.0, 0.0),
        (7.0, -7.0 / 10.0, 0.0, 0.0),
    ],
};

/// A derivative of several functions, and how well it is resolved.
#[derive(Clone, Debug)]
pub(crate) struct Difference {
    pub(crate) step: f64,
    pub(crate) values: Vec<f64>,
    /// Σ |weight · change|, in units of the functions.
    pub(crate) terms: Vec<f64>,
    /// |sixth order − fourth order|, in the same units.
    pub(crate) misses: Vec<f64>,
    /// |change of the derivative over a step|, in the same units.
    pub(crate) skews: Vec<f64>,
}

impl Stencil {
    /// The formula for the first derivative that stays within these distances to the bounds of the
    /// variable, behind and ahead, and its step of length h or less, negative where it looks back.
    pub(crate) fn first(room: [f64; 2], h: f64) -> (Self, f64) {
        Self::within(room, h, [CENTRAL, ONE_SIDED])
    }

    /// The same for the second derivative.
    pub(crate) fn second(room: [f64; 2], h: f64) -> (Self, f64) {
        Self::within(room, h, [SECOND, SECOND_ONE_SIDED])
    }

    fn within([behind, ahead]: [f64; 2], h: f64, [both, one]: [Self; 2]) -> (Self, f64) {
        let reach = |stencil: &Self| stencil.places.iter().fold(0.0, |m: f64, p| m.max(p.0));
        if behind.min(ahead) >= reach(&both) * h {
            return (both, h);
        }
        let step = h.min(behind.max(ahead) / reach(&one));
        (one, if ahead >= behind { step } else { -step })
    }

    /// The derivative at s = 0, where `centre` has the functions, which `at` evaluates at s.
    pub(crate) fn apply(
        &self,
        centre: &[f64],
        h: f64,
        mut at: impl FnMut(f64, &mut [f64]),
    ) -> Difference {
        let n = centre.len();
        let [mut values, mut terms, mut misses, mut skews] = [(); 4].map(|()| vec![0.0; n]);
        let mut there = vec![f64::NAN; n];
        for &(place, sixth, fourth, skew) in self.places {
            there.fill(f64::NAN);
            at(place * h, &mut there);
            for i in 0..n {
                let change = there[i] - centre[i];
                values[i] += sixth * change;
                terms[i] += (sixth * change).abs();
                misses[i] += (sixth - fourth) * change;
                skews[i] += skew * change;
            }
        }
        let scale = h.powi(self.order);
        values.iter_mut().for_each(|value| *value /= scale);
        let absolute = |x: &mut f64| *x = x.abs();
        misses.iter_mut().chain(&mut skews).for_each(absolute);
        Difference {
            step: h.abs(),
            values,
            terms,
            misses,
            skews,
        }
    }
}

impl Difference {
    /// The share of the terms by which both orders differ, each function relative to its size, or by which
    /// `rounding` of these sizes may move them; infinite where the functions are not finite, `UNCHANGED`
    /// where they do not change.
    pub(crate) fn unresolved(&self, sizes: &[f64], rounding: f64) -> f64 {
        if !self.values.iter().all(|value| value.is_finite()) {
            return f64::INFINITY;
        }
        let (miss, terms) = (largest(&self.misses, sizes), largest(&self.terms, sizes));
        if terms == 0.0 {
            return UNCHANGED;
        }
        miss.max(rounding) / terms
    }

    /// Whether a difference with a much shorter step shows something else: functions may vary on a scale so
    /// small that they look linear on longer ones.
    pub(crate) fn contradicts(&self, shorter: &Self, sizes: &[f64]) -> bool {
        largest(&self.gaps(shorter), sizes)
            > CONTRADICTION * largest(&self.terms, sizes) / self.step
    }

    /// Whether another difference of the same functions has the same values within what is unresolved of
    /// this one.
    fn agrees(&self, other: &Self, sizes: &[f64]) -> bool {
        let unresolved = self.unresolved(sizes, ROUNDING);
        let uncertain = unresolved * largest(&self.terms, sizes) / self.step;
        unresolved >= UNCHANGED || largest(&self.gaps(other), sizes) <= UNCERTAIN * uncertain
    }

    /// By how much the values of another difference of the same functions are less.
    fn gaps(&self, other: &Self) -> Vec<f64> {
        let pairs = self.values.iter().zip(&other.values);
        pairs.map(|(a, b)| a - b).collect()
    }
}

/// The largest absolute value relative to its size, of which those of vanishing functions do not count.
pub(crate) fn largest(values: &[f64], sizes: &[f64]) -> f64 {
    let pairs = values.iter().zip(sizes).filter(|(_, size)| **size > 0.0);
    pairs.fold(0.0, |m: f64, (value, size)| m.max(value.abs() / size))
}

/// The step for an unknown, and how well it resolved the functions when it was chosen.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Step {
    /// Its length, where the usual one was not good.
    length: Option<f64>,
    unresolved: f64,
}

impl Step {
    /// Its length where the unknown has this value.
    pub(crate) fn length(&self, z: f64) -> f64 {
        self.length.unwrap_or(STEP * (1.0 + z.abs()))
    }

    /// The length for an unknown that is expected to change by `reach`, where that is much shorter than the
    /// usual one.
    pub(crate) fn narrow(z: f64, reach: f64) -> Option<f64> {
        let scale = z.abs() + reach;
        (scale > 0.0 && scale < NARROW * (1.0 + z.abs())).then_some(STEP * scale)
    }

    /// Whether the step serves, with which a difference is unresolved to this share.
    pub(crate) fn serves(&self, unresolved: f64) -> bool {
        if self.unresolved > IRREGULAR {
            // No step was any good: nothing is gained by another search before one would be.
            unresolved <= RESOLVED || (IRREGULAR..=UNCHANGED).contains(&unresolved)
        } else {
            unresolved <= RESOLVED.max(VARIATION * self.unresolved)
        }
    }

    /// A better difference than `first`, which leaves the share `left` unresolved, with its step: shorter steps are tried, then longer ones, of which
    /// those count that agree with the best so far. `at` takes the difference with a step.
    pub(crate) fn searched(
        first: Difference,
        left: f64,
        sizes: &[f64],
        mut at: impl FnMut(f64) -> Difference,
    ) -> (Self, Difference) {
        let length = first.step;
        let (mut unresolved, mut best) = (left, first);
        for ratio in [RATIO.recip(), RATIO] {
            let few = ratio < 1.0 && unresolved <= REGULAR;
            for trial in 1..=if few { FEW_TRIALS } else { TRIALS } {
                if unresolved <= RESOLVED {
                    break;
                }
                let other = at(length * ratio.powi(trial));
                let left = other.unresolved(sizes, ROUNDING);
                let better = BETTER * left < unresolved;
                if better && (ratio < 1.0 || best.agrees(&other, sizes)) {
                    (unresolved, best) = (left, other);
                }
            }
        }
        let step = Self {
            length: Some(best.step).filter(|_| unresolved <= IRREGULAR),
            unresolved,
        };
        (step, best)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The best derivative of a function at zero with a step that is searched from `h`.
    fn derivative(f: impl Fn(f64) -> f64, h: f64) -> f64 {
        let at = |h: f64| {
            let (stencil, h) = Stencil::first([f64::INFINITY; 2], h);
            stencil.apply(&[f(0.0)], h, |s, g| g[0] = f(s))
        };
        let first = at(h);
        let left = first.unresolved(&[1.0], ROUNDING);
        if Step::default().serves(left) {
            first.values[0]
        } else {
            Step::searched(first, left, &[1.0], at).1.values[0]
        }
    }

    #[test]
    fn steps_resolve_features_of_any_width() {
        for exponent in -9..=9 {
            let width = 10f64.powi(exponent);
            let exact = 0.3f64.exp() / width;
            let error = derivative(|s| (s / width + 0.3).exp(), STEP) / exact - 1.0;
            assert!(error.abs() < 1e-8, "width {width:e}: {error:e}");
            let slope = width.recip() * (1.0 - 0.2f64.tanh().powi(2));
            let error = derivative(|s| (s / width + 0.2).tanh(), STEP) / slope - 1.0;
            assert!(error.abs() < 1e-8, "tanh of width {width:e}: {error:e}");
        }
    }

    #[test]
    fn noise_does_not_shorten_steps() {
        let noise = |s: f64| 1e-8 * (1e9 * s + 1.0).sin();
        let found = derivative(|s| s.exp() + noise(s), STEP);
        assert!((found - 1.0).abs() < 1e-5, "{found}");
    }

    type Formula = fn([f64; 2], f64) -> (Stencil, f64);

    #[test]
    fn formulas_on_one_side_stay_there() {
        for (below, above) in [(0.0, 1.0), (1.0, 0.0), (1e-3, 0.1), (0.2, 2e-3)] {
            for (formula, accuracy) in [(Stencil::first as Formula, 1e-12), (Stencil::second, 1e-9)]
            {
                let (stencil, h) = formula([below, above], 0.01);
                let found = stencil.apply(&[1.0], h, |s, g| {
                    assert!((-below..=above).contains(&s));
                    g[0] = s.exp();
                });
                assert!((found.values[0] - 1.0).abs() < accuracy);
            }
        }
    }

    #[test]
    fn second_derivatives_are_of_sixth_order() {
        for formula in [SECOND, SECOND_ONE_SIDED] {
            let error = |h: f64| {
                let found = formula.apply(&[0.5f64.sin()], h, |s, g| g[0] = (0.5 + s).sin());
                (found.values[0] + 0.5f64.sin()).abs()
            };
            let order = (error(0.1) / error(0.05)).log2();
            assert!((order - 6.0).abs() < 0.3, "{order}");
        }
    }
}
