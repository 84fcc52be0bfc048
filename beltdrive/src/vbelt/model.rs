//! What is asked of V-belts.

use crate::belt_loop::LoopState;
use crate::input::Key;
use crate::model::{Model, NearLargest, Neighbour, Progress};
use crate::results::largest_load::{LargestLoad, LastState};
use crate::results::loop_state::RestState;
use crate::{Branch, Drive, LimitCurve, Limits, SolveError, SolveOptions, Stability, SteadyState};

/// V-belts: strings that sink into the grooves, as boundary value problems.
pub(crate) struct VBelts;

impl Model for VBelts {
    fn solve(&self, drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
        super::solve::solve(drive, options)
    }

    fn solve_from(
        &self,
        neighbour: &SteadyState,
        drive: &Drive,
        options: &SolveOptions,
    ) -> Result<SteadyState, SolveError> {
        super::solve::solve_from(neighbour, drive, options)
    }

    fn trace(
        &self,
        drive: &Drive,
        key: &Key,
        range: [f64; 2],
        options: &SolveOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Branch, SolveError> {
        super::trace::trace(drive, key, range, options, progress)
    }

    fn limits(
        &self,
        drive: &Drive,
        key: &Key,
        options: &SolveOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Limits, SolveError> {
        super::limits::limits(drive, key, options, progress)
    }

    fn limit_curve(
        &self,
        drive: &Drive,
        key: &Key,
        second: &Key,
        range: [f64; 2],
        options: &SolveOptions,
        progress: &mut Progress<'_>,
    ) -> Result<LimitCurve, SolveError> {
        super::limit_curve::limit_curve(drive, key, second, range, options, progress)
    }

    fn stability(
        &self,
        _: &Drive,
        _: usize,
        _: &mut Progress<'_>,
    ) -> Result<Stability, SolveError> {
        let reason = "the stability of V-belt drives is not modelled, only that of flat belts";
        Err(SolveError::NotModelled(reason.into()))
    }

    fn solve_loop(&self, drive: &Drive, options: &SolveOptions) -> Result<LoopState, SolveError> {
        super::belt_loop::solve(drive, options.tolerance)
    }

    fn at_rest(&self, drive: &Drive, options: &SolveOptions) -> Result<RestState, SolveError> {
        super::belt_loop::at_rest(drive, options.tolerance)
    }

    fn solve_loop_from(
        &self,
        drive: &Drive,
        neighbour: Option<&Neighbour>,
        options: &SolveOptions,
    ) -> Result<(LoopState, Neighbour), SolveError> {
        let near = neighbour.and_then(|neighbour| match neighbour {
            Neighbour::V(near) => Some(&**near),
            Neighbour::Flat => None,
        });
        let (state, near) = super::belt_loop::solve_from(drive, near, options.tolerance)?;
        Ok((state, Neighbour::V(Box::new(near))))
    }

    fn largest_load(
        &self,
        drive: &Drive,
        near: Option<&NearLargest>,
        expected: f64,
        options: &SolveOptions,
    ) -> Result<(LargestLoad, NearLargest), SolveError> {
        let near = near.and_then(|near| match near {
            NearLargest::V(near) => Some(&**near),
            NearLargest::Flat => None,
        });
        let (found, near) =
            super::belt_loop::largest_load(drive, near, expected, options.tolerance)?;
        Ok((found, NearLargest::V(Box::new(near))))
    }

    fn last_state(&self, drive: &Drive, options: &SolveOptions) -> Option<LastState> {
        super::belt_loop::last_state(drive, options.tolerance)
    }

    fn solve_with_margins(
        &self,
        drive: &Drive,
        options: &SolveOptions,
    ) -> Result<LoopState, SolveError> {
        super::belt_loop::solve_with_margins(drive, options.tolerance)
    }
}
