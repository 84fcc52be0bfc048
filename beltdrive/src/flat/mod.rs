//! The flat-belt drive.
mod closed_form;
mod contact;
mod coulomb;
mod creep_rate;
mod epp;
mod geometry;
mod root;
mod traction;

/// Indices of the pulleys.
pub(crate) const DRIVEN: usize = 0;
/// As [`DRIVEN`].
pub(crate) const DRIVER: usize = 1;

use crate::{Branch, Drive, LimitCurve, Limits, SolveError, SolveOptions, SteadyState, input::Key};
pub(crate) fn solve(_: &Drive) -> Result<SteadyState, SolveError> {
    Err(SolveError::NotModelled(""))
}
pub(crate) fn trace(
    _: &Drive,
    _: &Key,
    _: [f64; 2],
    _: &SolveOptions,
) -> Result<Branch, SolveError> {
    Err(SolveError::NotModelled(""))
}
pub(crate) fn limits(_: &Drive, _: &Key, _: &SolveOptions) -> Result<Limits, SolveError> {
    Err(SolveError::NotModelled(""))
}
pub(crate) fn limit_curve(
    _: &Drive,
    _: &Key,
    _: &Key,
    _: [f64; 2],
    _: &SolveOptions,
) -> Result<LimitCurve, SolveError> {
    Err(SolveError::NotModelled(""))
}

#[cfg(test)]
mod facts;
