//! How the steady state of a loop changes with the numbers of its drive, to rounding.
//!
//! The unknowns x of a state solve F(x, p) = 0. With a number p of the drive they change by
//!
//! ```text
//! dx/dp = −(∂F/∂x)⁻¹ ∂F/∂p
//! ```
//!
//! and what can be measured follows from both. The equations are those that were solved, on dual numbers.
//!
//! All derivatives are exact but for rounding, with every friction law, convention and closure, with two exceptions that
//! are left to others: by a number with which those of the drive do not change along straight lines, as the direction of
//! a slide, and by the torque of a pulley that has none, whose belt pulls the other way on either side. Where a zone of
//! friction is about to vanish a derivative is that on the side of the state.

use super::evaluated::{Evaluated, unknowns};
use super::numbers::constant;
use crate::Drive;
use crate::drive::Direction;
use crate::results::loop_state::LoopState;
use crate::results::measured::Measured;
use bvp::Dual;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// Steps of Newton's method on dual numbers. The derivatives are linear in themselves, so that the first one is the last
/// but for rounding in units far apart, which the second one takes off.
const STEPS: usize = 2;

/// The derivatives of a state.
pub(crate) struct Derivatives<'d> {
    drive: &'d Drive,
    unknowns: Vec<f64>,
    /// ∂F/∂x.
    by_unknowns: LU<f64, Dyn, Dyn>,
}

impl<'d> Derivatives<'d> {
    /// Those of the state of a loop; `None` if its equations cannot be evaluated.
    pub(crate) fn new(drive: &'d Drive, state: &LoopState) -> Option<Self> {
        let unknowns = unknowns(drive, state);
        let column = |direction: usize| {
            let along = unknowns.iter().enumerate().map(|(index, &value)| Dual {
                value,
                gradient: [f64::from(u8::from(index == direction))],
            });
            let along: Vec<_> = along.collect();
            let evaluated = Evaluated::new(drive, &along, constant(drive))?;
            Some(derivatives(&evaluated))
        };
        let columns = (0..unknowns.len()).map(column);
        let columns = columns.collect::<Option<Vec<_>>>()?;
        let by_unknowns = DMatrix::from_columns(&columns).lu();
        Some(Self {
            drive,
            unknowns,
            by_unknowns,
        })
    }

    /// The derivatives of measured numbers along a direction; `None` if a number of the drive does not change along a
    /// straight line, or a torque changes its sign, with which other equations hold, or one of them is no number.
    pub(crate) fn along<'m>(
        &self,
        direction: &Direction<'_>,
        measured: impl Iterator<Item = &'m Measured>,
    ) -> Option<Vec<f64>> {
        let unknowns = self.unknowns.iter().map(|&value| Dual::constant(value));
        let mut unknowns: Vec<Dual<1>> = unknowns.collect();
        let at = |unknowns: &[_]| Evaluated::new(self.drive, unknowns, |of| direction.read(of));
        for _ in 0..STEPS {
            let step = self.by_unknowns.solve(&derivatives(&at(&unknowns)?))?;
            for (unknown, step) in unknowns.iter_mut().zip(&step) {
                unknown.gradient[0] -= step;
            }
        }
        let found = at(&unknowns)?;
        let mut changes = found.belt.changes.iter();
        let turns = changes.any(|change| change.value == 0.0 && change.gradient != [0.0]);
        if turns || !direction.is_straight() {
            return None;
        }
        let solved = found.solved();
        let derivatives = measured.map(|measured| {
            let [derivative] = measured.on(&solved)?.gradient;
            derivative.is_finite().then_some(derivative)
        });
        derivatives.collect()
    }
}

/// The derivatives of the equations.
fn derivatives(evaluated: &Evaluated<Dual<1>>) -> DVector<f64> {
    let residuals = evaluated.residuals.iter();
    DVector::from_iterator(
        evaluated.residuals.len(),
        residuals.map(|residual| residual.gradient[0]),
    )
}

#[cfg(test)]
mod tests;
