//! Scalars of states beside constants of another kind.

use bvp::Real;
use std::ops::{Add, Div, Mul, Sub};

/// A scalar of states that is combined with constants `S`: with numbers (`f64`) where the drive is fixed, and with
/// scalars of the same kind where its numbers vary, too.
pub(crate) trait Over<S>:
    Real
    + From<S>
    + Add<S, Output = Self>
    + Sub<S, Output = Self>
    + Mul<S, Output = Self>
    + Div<S, Output = Self>
{
}

impl<S, T> Over<S> for T where
    T: Real
        + From<S>
        + Add<S, Output = Self>
        + Sub<S, Output = Self>
        + Mul<S, Output = Self>
        + Div<S, Output = Self>
{
}
