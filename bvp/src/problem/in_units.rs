//! Equations whose states and parameters are measured in units.
//!
//! With units u of the states and v of the parameters, y = u ŷ and p = v p̂, the equations of the numbers
//! ŷ and p̂ are
//!
//! ```text
//! dŷ/ds = f(s, u ŷ, v p̂) / u,     g(u · ends, v p̂) = 0
//! ```
//!
//! s and the conditions keep their units. All units are powers of two, so that nothing is rounded.

use crate::problem::equations::{Equations, Shape};
use crate::problem::problem::{Ends, Segment};
use std::cell::Cell;
use std::sync::Arc;

/// The units of all states and parameters of some equations.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Units {
    /// For every segment one number per state.
    states: Vec<Vec<f64>>,
    /// The same for all values at ends and joined points, in the order of [`Ends`].
    ends: Vec<f64>,
    /// One number per parameter.
    parameters: Vec<f64>,
}

impl Units {
    /// The largest powers of two that are not larger than the numbers in `absolute`: normal positive
    /// ones, for the states of all segments and then for the parameters, or without these for
    /// parameters in units of one.
    fn new(segments: &[Segment], parameters: usize, absolute: &[f64]) -> Self {
        let mut rest = absolute.iter().map(|&size| power_of_two(size));
        let mut take = |count: usize| rest.by_ref().take(count).collect::<Vec<f64>>();
        let states: Vec<_> = segments
            .iter()
            .map(|segment| take(segment.states))
            .collect();
        let mut parameter_units = take(parameters);
        parameter_units.resize(parameters, 1.0);
        let ends = segments.iter().zip(&states).flat_map(|(segment, units)| {
            let sides = 2 * (segment.joined.len() + 1);
            units.iter().copied().cycle().take(sides * segment.states)
        });
        Self {
            ends: ends.collect(),
            states,
            parameters: parameter_units,
        }
    }

    /// The units of the states of a segment.
    pub(crate) fn of_states(&self, segment: usize) -> &[f64] {
        &self.states[segment]
    }

    /// The units of the parameters.
    pub(crate) fn of_parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// The units of the states of all segments, then of the parameters.
    pub(crate) fn all(&self) -> Vec<f64> {
        let states = self.states.iter().flatten();
        states.chain(&self.parameters).copied().collect()
    }
}

/// The largest power of two that is not larger than a normal positive number: without its fraction.
#[inline(always)]
pub(crate) fn power_of_two(size: f64) -> f64 {
    const SIGN_AND_EXPONENT: u64 = 0xfff0_0000_0000_0000;
    f64::from_bits(size.to_bits() & SIGN_AND_EXPONENT)
}

/// values ← values · units, for rows of as many values as there are units.
pub(crate) fn multiply(values: &mut [f64], units: &[f64]) {
    values
        .iter_mut()
        .zip(units.iter().cycle())
        .for_each(|(value, unit)| *value *= unit);
}

/// values ← values / units, for rows of as many values as there are units.
pub(crate) fn divide(values: &mut [f64], units: &[f64]) {
    values
        .iter_mut()
        .zip(units.iter().cycle())
        .for_each(|(value, unit)| *value /= unit);
}

thread_local! {
    /// States and parameters in the units of the statement, so that no evaluation allocates.
    static STATED: Cell<Vec<f64>> = const { Cell::new(vec![]) };
}

/// Calls a function with states and parameters in the units of the statement.
fn with_stated(
    (y, y_units): (&[f64], &[f64]),
    (p, p_units): (&[f64], &[f64]),
    function: impl FnOnce(&[f64], &[f64]),
) {
    let mut stated = STATED.take();
    stated.clear();
    stated.extend(y.iter().zip(y_units).map(|(y, unit)| y * unit));
    stated.extend(p.iter().zip(p_units).map(|(p, unit)| p * unit));
    let (stated_y, stated_p) = stated.split_at(y.len());
    function(stated_y, stated_p);
    STATED.set(stated);
}

/// Equations of numbers that count units; without units the equations as they are.
#[derive(Clone)]
pub(crate) struct InUnits<'a> {
    equations: &'a dyn Equations,
    units: Option<Arc<Units>>,
}

impl<'a> InUnits<'a> {
    /// The equations as they are.
    pub(crate) fn none(equations: &'a dyn Equations) -> Self {
        Self {
            equations,
            units: None,
        }
    }

    /// The same equations in the units of [`Units::new`]; as they are if `absolute` is empty.
    pub(crate) fn with(&self, absolute: &[f64]) -> Self {
        let units = || {
            let shape = self.equations.shape();
            Units::new(&shape.segments, shape.parameters, absolute)
        };
        Self {
            equations: self.equations,
            units: (!absolute.is_empty()).then(|| Arc::new(units())),
        }
    }

    /// Other equations in the same units.
    pub(crate) fn exchanged<'b>(&self, equations: &'b dyn Equations) -> InUnits<'b> {
        InUnits {
            equations,
            units: self.units.clone(),
        }
    }

    /// The units, if there are any.
    #[inline(always)]
    pub(crate) fn units(&self) -> Option<&Units> {
        self.units.as_deref()
    }

    /// The equations as stated, if there are no units.
    #[inline(always)]
    pub(crate) fn as_stated(&self) -> Option<&'a dyn Equations> {
        match self.units {
            None => Some(self.equations),
            Some(_) => None,
        }
    }

    /// The unit of a parameter.
    pub(crate) fn parameter_unit(&self, index: usize) -> f64 {
        self.units().map_or(1.0, |units| units.parameters[index])
    }
}

impl Equations for InUnits<'_> {
    fn shape(&self) -> Shape {
        self.equations.shape()
    }

    fn evaluate_rhs(&self, segment: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        let Some(units) = self.units() else {
            return self.equations.evaluate_rhs(segment, s, y, p, dy);
        };
        let y_units = units.of_states(segment);
        with_stated((y, y_units), (p, &units.parameters), |y, p| {
            self.equations.evaluate_rhs(segment, s, y, p, dy);
        });
        divide(dy, y_units);
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let Some(units) = self.units() else {
            return self.equations.rhs_jacobian(segment, s, y, p, dy, jacobian);
        };
        let y_units = units.of_states(segment);
        with_stated((y, y_units), (p, &units.parameters), |y, p| {
            self.equations.rhs_jacobian(segment, s, y, p, dy, jacobian);
        });
        divide(dy, y_units);
        let rows = jacobian.chunks_exact_mut(y.len() + p.len());
        for (row, unit) in rows.zip(y_units) {
            let (of_states, of_parameters) = row.split_at_mut(y.len());
            multiply(of_states, y_units);
            multiply(of_parameters, &units.parameters);
            row.iter_mut().for_each(|entry| *entry /= unit);
        }
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        let Some(units) = self.units() else {
            return self.equations.evaluate_conditions(at, p, r);
        };
        let ends = (at.values(), &units.ends[..]);
        with_stated(ends, (p, &units.parameters), |ends, p| {
            self.equations.evaluate_conditions(at.with(ends), p, r);
        });
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        let Some(units) = self.units() else {
            return self.equations.conditions_jacobian(at, p, r, jacobian);
        };
        let ends = (at.values(), &units.ends[..]);
        with_stated(ends, (p, &units.parameters), |ends, p| {
            self.equations
                .conditions_jacobian(at.with(ends), p, r, jacobian);
        });
        let columns = units.ends.len() + p.len();
        for row in jacobian.chunks_exact_mut(columns) {
            let (of_ends, of_parameters) = row.split_at_mut(units.ends.len());
            multiply(of_ends, &units.ends);
            multiply(of_parameters, &units.parameters);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_the_powers_of_two_not_above_the_numbers_given() {
        let segments = [Segment::new(2).joined(&[0.5]), Segment::new(1)];
        let units = Units::new(&segments, 2, &[1.0, 0.3, 1e8]);
        assert_eq!(units.all(), [1.0, 0.25, 67_108_864.0, 1.0, 1.0]);
        let (one, two) = ([1.0, 0.25].repeat(4), [67_108_864.0; 2]);
        assert_eq!(units.ends, [&one[..], &two].concat());
        let units = Units::new(&segments[1..], 1, &[f64::MIN_POSITIVE, f64::MAX]);
        let largest = 2f64.powi(1023);
        assert_eq!(units.all(), [f64::MIN_POSITIVE, largest]);
    }
}
