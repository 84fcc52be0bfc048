//! The largest load of a loop at one speed.

use crate::belt_loop::LoopState;
use crate::{Drive, SolveError};
use std::borrow::Cow;

/// What ends the load that a drive carries.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum LoadEnd {
    /// A pulley, by its index, slips on its whole contact.
    Slips(usize),
    /// A pulley, by its index, slips by a twentieth of the speed of the driver, and still slips so much under a tenth more
    /// load: the belt slows down or sinks into its grooves, presses more, and a largest load is far or there is none.
    GrowingSlip(usize),
    /// A V-belt overhangs itself where it leaves a pulley, by its index.
    Overhangs(usize),
    /// A pulley, by its index, stands still.
    Stalls(usize),
    /// There is no steady state beyond, for this reason.
    NoState(Box<SolveError>),
}

/// The largest load of a loop at one speed.
#[derive(Clone, Debug)]
pub(crate) struct LargestLoad {
    /// The factor on all torques.
    pub(crate) factor: f64,
    /// What ends it.
    pub(crate) end: LoadEnd,
    /// Torque of the driver there, N·m; positive where it puts power into the belt.
    pub(crate) driver_torque: f64,
    /// Power that pulleys take out of the belt there, W; none where the speed of a pulley falls to zero.
    pub(crate) power_out: Option<f64>,
    /// Estimated relative error of factor and torque.
    pub(crate) error: f64,
}

/// The last steady state of a loop as its load rises.
#[derive(Clone, Debug)]
pub(crate) struct LastState {
    /// The factor on all torques and powers.
    pub(crate) factor: f64,
    /// How far the limit of the load is from it at most, relative.
    pub(crate) error: f64,
    /// Why there is no state beyond.
    pub(crate) reason: SolveError,
    /// The state.
    pub(crate) state: LoopState,
}

impl LoadEnd {
    /// One word for programs.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Slips(_) => "gross slip",
            Self::GrowingSlip(_) => "growing slip",
            Self::Overhangs(_) => "overhang",
            Self::Stalls(_) => "stall",
            Self::NoState(error) => error.kind(),
        }
    }

    /// The index of the pulley where it ends, if it ends at one.
    #[must_use]
    pub fn pulley(&self) -> Option<usize> {
        match self {
            Self::Slips(pulley)
            | Self::GrowingSlip(pulley)
            | Self::Overhangs(pulley)
            | Self::Stalls(pulley) => Some(*pulley),
            Self::NoState(_) => None,
        }
    }

    /// Whether a pulley slips, and more under more load.
    pub(crate) fn is_growing(&self) -> bool {
        matches!(self, Self::GrowingSlip(_))
    }

    /// Whether it is the same reason, at the same pulley.
    #[must_use]
    pub fn is_like(&self, other: &Self) -> bool {
        self.kind() == other.kind() && self.pulley() == other.pulley()
    }

    /// In words, on one line.
    #[must_use]
    pub fn sentence(&self, drive: &Drive) -> Cow<'static, str> {
        let name = |pulley: &usize| &drive.pulleys[*pulley].name;
        match self {
            Self::Slips(pulley) => format!("pulley `{}` slips grossly", name(pulley)).into(),
            Self::GrowingSlip(pulley) => format!(
                "pulley `{}` slips by 5 %, and more under more load",
                name(pulley)
            )
            .into(),
            Self::Overhangs(pulley) => {
                format!("the belt overhangs itself on pulley `{}`", name(pulley)).into()
            }
            Self::Stalls(pulley) => format!("pulley `{}` stalls", name(pulley)).into(),
            Self::NoState(error) => match &**error {
                SolveError::TensionerBeyondTravel { pulley, .. } => {
                    format!("the tensioner `{pulley}` reaches the end of its travel").into()
                }
                SolveError::Overstretched { .. } => {
                    "the belt is stretched to twice its length".into()
                }
                error => error.to_string().into(),
            },
        }
    }
}
