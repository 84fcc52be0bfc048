//! Why a belt loop has no steady state.

use crate::Check;
use crate::drive::layout::LayoutError;
use std::borrow::Cow;
use thiserror::Error;

/// Why a belt loop has no steady state.
///
/// Of several reasons the first in this order is given: statement, layout, slack at rest, lift-off, travel
/// of the tensioner, gross slip, what the other friction laws and a linear elastic belt do not allow.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum LoopError {
    /// A number of the statement is out of its range, or the parts of the statement do not belong together.
    #[error("{subject}: {problem}")]
    Statement {
        /// Of which part: the name of a pulley, or the part itself.
        subject: String,
        /// What is wrong with it.
        problem: Cow<'static, str>,
    },
    /// The belt cannot be laid round the pulleys.
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// The belt has no tension at rest.
    #[error("the belt is slack at rest: its tension would be {tension:.4} N")]
    Slack {
        /// Uniform belt tension that the equations give, N; not positive.
        tension: f64,
    },
    /// A V-belt at rest is pressed through a groove: the tension that the groove carries falls where the belt
    /// sinks deeper.
    #[error(
        "the belt at rest is pressed through the groove of `{pulley}`, which carries at most {largest:.4} N; \
         check its radial stiffness"
    )]
    PressedThrough {
        /// The pulley.
        pulley: String,
        /// The largest belt tension that the groove carries at rest, N: k R² tan β/6.
        largest: f64,
    },
    /// The belt does not press on the pulleys: even without torques; or under them with
    /// [`crate::NormalForce::Thesis`], whose friction does not know of it.
    #[error(
        "the belt lifts off{}: its tractive tension would be {tractive_tension:.4} N at {speed:.4} m/s",
        if *.is_loaded { "" } else { " even without load" }
    )]
    LiftsOff {
        /// Tractive tension F = T − G V, N; not positive. That of the whole belt without torques, or of the
        /// slackest span.
        tractive_tension: f64,
        /// Belt speed V there, m/s.
        speed: f64,
        /// Whether the torques are at work.
        is_loaded: bool,
    },
    /// The tensioner would have to go beyond one of its stops.
    #[error(
        "the tensioner `{pulley}` goes beyond its travel: {coordinate:.6} is not between {:.6} and {:.6}",
        travel[0],
        travel[1]
    )]
    TensionerBeyondTravel {
        /// The pulley on the tensioner.
        pulley: String,
        /// Coordinate of the equilibrium, or the last one from which it was sought beyond the stop; rad
        /// or m.
        coordinate: f64,
        /// The stops, rad or m.
        travel: [f64; 2],
    },
    /// No stable equilibrium of the tensioner was found from its start coordinate.
    #[error("the tensioner `{pulley}` has no stable equilibrium {which}")]
    NoEquilibrium {
        /// The pulley on the tensioner.
        pulley: String,
        /// At rest or running.
        which: &'static str,
    },
    /// A pulley cannot carry its torque.
    #[error(
        "gross slip: pulley `{pulley}` carries {load_factor:.4} of the load{}",
        margin.map_or(String::new(), |margin| format!(
            "; its torque margin at the tension of this load is {margin:.4}"
        ))
    )]
    GrossSlip {
        /// The pulley that slips first as the load is raised.
        pulley: String,
        /// Load factor limit: the factor on all torques at which it slips; at most 1.
        load_factor: f64,
        /// Torque capacity of this pulley over its torque in the formal state, where there is one.
        margin: Option<f64>,
        /// The state at the load factor limit.
        at_limit: Box<LoadedState>,
        /// The formal state of the whole load: friction is raised on pulleys that lack it until they slip
        /// on their whole contact. `None` where the belt lifts off first.
        formal: Option<Box<LoadedState>>,
    },
    /// Rigid friction would carry the load, but elastic friction has to creep so far that a pulley stalls.
    #[error(
        "pulley `{pulley}` stalls: friction of this law carries its torque only with full slip"
    )]
    Stalls {
        /// The pulley.
        pulley: String,
    },
    /// The belt would be stretched to more than twice its length, where no belt is linear elastic.
    #[error("the belt would be stretched by {strain:.3e} of its length")]
    Overstretched {
        /// Largest strain T/EA.
        strain: f64,
    },
    /// A V-belt does not carry its load.
    #[error(
        "the loop carries {load_factor:.4} of the load, where {}",
        match overhangs {
            true => format!("the belt overhangs itself on pulley `{pulley}`"),
            false => format!("pulley `{pulley}` slips on its whole contact"),
        }
    )]
    Overloaded {
        /// The pulley that slips, or where the belt overhangs.
        pulley: String,
        /// The largest factor on all torques at which there is a steady state; at most 1.
        load_factor: f64,
        /// Whether the belt overhangs itself there, beyond an inclination of 90°, instead of slipping.
        overhangs: bool,
    },
    /// The way to the steady state of a V-belt was not found.
    #[error("no state was found beyond {reached:.4} of the load: {cause}")]
    NotConverged {
        /// Factor on all torques up to which states were found; 0 where there were none.
        reached: f64,
        /// Why the next one was not.
        cause: &'static str,
    },
    /// A state was found that violates an invariant.
    #[error(
        "the state found violates an invariant, {}: relative deviation {:.1e}, limit {:.1e}",
        .0.name, .0.deviation, .0.limit
    )]
    Violated(Check),
    /// The tolerance is out of range.
    #[error("tolerance {tolerance:e} is outside 1e-12 to 1e-2")]
    Tolerance {
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// The equations could not be solved in double precision.
    #[error("the {what} could not be found in double precision")]
    NotFound {
        /// Which unknown.
        what: &'static str,
    },
}

impl LoopError {
    /// One word for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Statement { .. } => "statement",
            Self::Layout(_) => "layout",
            Self::Slack { .. } => "slack at rest",
            Self::LiftsOff { .. } => "lift-off",
            Self::TensionerBeyondTravel { .. } => "tensioner beyond travel",
            Self::NoEquilibrium { .. } => "no equilibrium",
            Self::GrossSlip { .. } => "gross slip",
            Self::Stalls { .. } => "stall",
            Self::Overstretched { .. } => "overstretched",
            Self::Overloaded { .. } => "gross slip",
            Self::PressedThrough { .. } => "pressed through groove",
            _ => "not found",
        }
    }
}

/// A state of the loop under load with rigid friction; lists are in belt order.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct LoadedState {
    /// Torque M of each pulley, N·m; positive where power leaves the belt.
    pub torques: Vec<f64>,
    /// Tractive tension F of each span, N.
    pub tractive_tensions: Vec<f64>,
    /// Belt tension T of each span, N.
    pub tensions: Vec<f64>,
    /// Mass flow G, kg/s.
    pub mass_flow: f64,
    /// Coordinate of the tensioner, rad or m.
    pub tensioner_coordinate: Option<f64>,
    /// Friction utilisation of each pulley with its own friction: 1 and more is gross slip.
    pub friction_utilisations: Vec<f64>,
    /// Torque capacity of each pulley at its slacker tension, with its own friction, N·m.
    pub torque_capacities: Vec<f64>,
    /// Torque capacity over torque; `None` for an idler.
    pub torque_margins: Vec<Option<f64>>,
}
