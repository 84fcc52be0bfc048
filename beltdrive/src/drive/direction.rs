//! How the numbers of a drive change with one of its file.

use super::Drive;
use bvp::Dual;
use std::cell::Cell;

/// The drives are read this far from a coordinate, in its unit, and half as far on the other side. The derivative of a
/// number is then known to 64 roundings, and what is near enough for a belt to be laid round its pulleys stays so.
const STEP: f64 = 1.0 / 64.0;

/// How far the numbers of three drives may be from a straight line, in roundings: a few operations lead from the file to
/// each.
const ROUNDINGS: f64 = 8.0;

/// The direction of a coordinate in the numbers of a drive.
///
/// Nearly all numbers of a drive change with one of its file along straight lines, so that the difference of two drives
/// is their derivative.
pub(crate) struct Direction<'d> {
    here: &'d Drive,
    /// The drive a step ahead, and half a step behind.
    beside: [Drive; 2],
    /// Whether all numbers that were read lie on straight lines.
    is_straight: Cell<bool>,
}

impl<'d> Direction<'d> {
    /// From a drive, with the drive at a distance along a coordinate; `None` if there is none.
    pub(crate) fn new(here: &'d Drive, at: impl Fn(f64) -> Option<Drive>) -> Option<Self> {
        Some(Self {
            here,
            beside: [at(STEP)?, at(-0.5 * STEP)?],
            is_straight: Cell::new(true),
        })
    }

    /// A number of the drive with its derivative.
    pub(crate) fn read(&self, of: &dyn Fn(&Drive) -> f64) -> Dual<1> {
        let here = of(self.here);
        let [ahead, behind] = self.beside.each_ref().map(of);
        let change = ahead - here;
        let off = (behind - here) + 0.5 * change;
        let rounding = ROUNDINGS * f64::EPSILON * here.abs().max(ahead.abs());
        let is_straight = off.abs() <= rounding;
        self.is_straight.set(self.is_straight.get() && is_straight);
        Dual {
            value: here,
            gradient: [change / STEP],
        }
    }

    /// Whether all numbers that were read lie on straight lines.
    pub(crate) fn is_straight(&self) -> bool {
        self.is_straight.get()
    }
}
