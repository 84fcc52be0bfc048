//! What is asked of flat belts.

use super::belt_loop::Derivatives;
use crate::belt_loop::LoopState;
use crate::input::Key;
use crate::model::{Model, NearLargest, Neighbour, Progress};
use crate::results::largest_load::LargestLoad;
use crate::results::loop_state::RestState;
use crate::{
    Branch, Drive, LimitCurve, Limits, SolveError, SolveOptions, Stability, StateSummary,
    SteadyState,
};

/// Flat belts: strings on the rims, in closed form.
pub(crate) struct FlatBelts;

impl Model for FlatBelts {
    fn solve(&self, drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
        super::solve::solve(drive, options)
    }

    fn solve_from(
        &self,
        _: &SteadyState,
        drive: &Drive,
        options: &SolveOptions,
    ) -> Result<SteadyState, SolveError> {
        self.solve(drive, options)
    }

    fn summary(
        &self,
        _: Option<&SteadyState>,
        drive: &Drive,
        options: &SolveOptions,
    ) -> Result<(StateSummary, Option<SteadyState>), SolveError> {
        Ok((super::solve::summary(drive, options)?, None))
    }

    fn trace(
        &self,
        drive: &Drive,
        key: &Key,
        range: [f64; 2],
        options: &SolveOptions,
        _: &mut Progress<'_>,
    ) -> Result<Branch, SolveError> {
        super::trace::trace(drive, key, range, options)
    }

    fn limits(
        &self,
        drive: &Drive,
        key: &Key,
        options: &SolveOptions,
        _: &mut Progress<'_>,
    ) -> Result<Limits, SolveError> {
        super::limits::limits(drive, key, options)
    }

    fn limit_curve(
        &self,
        drive: &Drive,
        key: &Key,
        second: &Key,
        range: [f64; 2],
        options: &SolveOptions,
        _: &mut Progress<'_>,
    ) -> Result<LimitCurve, SolveError> {
        super::limit_curve::limit_curve(drive, key, second, range, options)
    }

    fn stability(
        &self,
        drive: &Drive,
        modes: usize,
        progress: &mut Progress<'_>,
    ) -> Result<Stability, SolveError> {
        super::stability::stability(drive, modes, progress)
    }

    fn solve_loop(&self, drive: &Drive, _: &SolveOptions) -> Result<LoopState, SolveError> {
        super::belt_loop::solve(drive)
    }

    fn at_rest(&self, drive: &Drive, _: &SolveOptions) -> Result<RestState, SolveError> {
        super::belt_loop::at_rest(drive)
    }

    fn solve_loop_from(
        &self,
        drive: &Drive,
        _: Option<&Neighbour>,
        _: &SolveOptions,
    ) -> Result<(LoopState, Neighbour), SolveError> {
        let state = super::belt_loop::solve(drive)?;
        Ok((state, Neighbour::Flat))
    }

    fn largest_load(
        &self,
        drive: &Drive,
        _: Option<&NearLargest>,
        _: f64,
        _: &SolveOptions,
    ) -> Result<(LargestLoad, NearLargest), SolveError> {
        let found = super::belt_loop::largest_load(drive)?;
        Ok((found, NearLargest::Flat))
    }

    fn derivatives<'d>(&self, drive: &'d Drive, state: &LoopState) -> Option<Derivatives<'d>> {
        Derivatives::new(drive, state)
    }

    fn solve_with_margins(
        &self,
        drive: &Drive,
        options: &SolveOptions,
    ) -> Result<LoopState, SolveError> {
        self.solve_loop(drive, options)
    }
}
