//! What a model of belts answers. A model is a folder with an implementation of [`Model`], and a line of
//! [`model`].

use crate::belt_loop::LoopState;
use crate::flat::belt_loop::Derivatives;
use crate::input::Key;
use crate::results::largest_load::{LargestLoad, LastState};
use crate::results::loop_state::RestState;
use crate::{
    BeltKind, Branch, Drive, LimitCurve, Limits, SolveError, SolveOptions, Stability, StateSummary,
    SteadyState, flat, vbelt,
};

/// What is called with the share of the work that is done, from 0 to 1, and what is being done.
pub(crate) type Progress<'p> = dyn FnMut(f64, &str) + 'p;

/// A model of belts. Statements and options are in range.
pub(crate) trait Model {
    /// As [`crate::solve`].
    fn solve(&self, drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError>;

    /// As [`crate::solve_from`].
    fn solve_from(
        &self,
        neighbour: &SteadyState,
        drive: &Drive,
        options: &SolveOptions,
    ) -> Result<SteadyState, SolveError>;

    /// The scalars of the steady state, sought from that of a neighbour, and the state from which the next one is sought,
    /// where that helps.
    fn summary(
        &self,
        neighbour: Option<&SteadyState>,
        drive: &Drive,
        options: &SolveOptions,
    ) -> Result<(StateSummary, Option<SteadyState>), SolveError> {
        let state = match neighbour {
            Some(neighbour) => self.solve_from(neighbour, drive, options)?,
            None => self.solve(drive, options)?,
        };
        Ok((StateSummary::from(&state), Some(state)))
    }

    /// As [`crate::trace`].
    fn trace(
        &self,
        drive: &Drive,
        key: &Key,
        range: [f64; 2],
        options: &SolveOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Branch, SolveError>;

    /// As [`crate::limits`].
    fn limits(
        &self,
        drive: &Drive,
        key: &Key,
        options: &SolveOptions,
        progress: &mut Progress<'_>,
    ) -> Result<Limits, SolveError>;

    /// As [`crate::limit_curve`].
    fn limit_curve(
        &self,
        drive: &Drive,
        key: &Key,
        second: &Key,
        range: [f64; 2],
        options: &SolveOptions,
        progress: &mut Progress<'_>,
    ) -> Result<LimitCurve, SolveError>;

    /// As [`crate::stability`].
    fn stability(
        &self,
        drive: &Drive,
        modes: usize,
        progress: &mut Progress<'_>,
    ) -> Result<Stability, SolveError>;

    /// As [`crate::belt_loop::solve_to`].
    fn solve_loop(
        &self,
        belt_loop: &Drive,
        options: &SolveOptions,
    ) -> Result<LoopState, SolveError>;

    /// The loop at rest, where the closure is one of it.
    fn at_rest(&self, belt_loop: &Drive, options: &SolveOptions) -> Result<RestState, SolveError>;

    /// As [`Model::solve_loop`], fast from a neighbour, and the neighbour of the next one.
    fn solve_loop_from(
        &self,
        belt_loop: &Drive,
        neighbour: Option<&Neighbour>,
        options: &SolveOptions,
    ) -> Result<(LoopState, Neighbour), SolveError>;

    /// The factor on all torques, expected to be about `expected`, up to which the loop has a steady state at its
    /// closure; fast from that at another speed of the driver, with what the next one is found from. Pulleys have
    /// torques, not powers.
    fn largest_load(
        &self,
        belt_loop: &Drive,
        near: Option<&NearLargest>,
        expected: f64,
        options: &SolveOptions,
    ) -> Result<(LargestLoad, NearLargest), SolveError>;

    /// The last steady state of a loop as all its torques and powers rise together from its own, where it is found
    /// along the curve of these states.
    fn last_state(&self, _: &Drive, _: &SolveOptions) -> Option<LastState> {
        None
    }

    /// How a steady state changes with the numbers of its drive, where that is known to rounding.
    fn derivatives<'d>(&self, _: &'d Drive, _: &LoopState) -> Option<Derivatives<'d>> {
        None
    }

    /// As [`crate::belt_loop::solve_with_margins`].
    fn solve_with_margins(
        &self,
        belt_loop: &Drive,
        options: &SolveOptions,
    ) -> Result<LoopState, SolveError>;
}

/// A solved loop from which its neighbours are found.
#[derive(Clone, Debug)]
pub(crate) enum Neighbour {
    /// In closed form there is nothing to begin with.
    Flat,
    /// The solution.
    V(Box<vbelt::belt_loop::LoopNeighbour>),
}

/// What the largest load at another speed is found from.
#[derive(Clone, Debug)]
pub(crate) enum NearLargest {
    /// In closed form there is nothing to begin with.
    Flat,
    /// A state below it.
    V(Box<vbelt::belt_loop::NearLargestLoad>),
}

/// The model of a kind of belt.
pub(crate) fn model(kind: BeltKind) -> &'static dyn Model {
    match kind {
        BeltKind::V(_) => &vbelt::VBelts,
        BeltKind::Flat { .. } => &flat::FlatBelts,
    }
}
