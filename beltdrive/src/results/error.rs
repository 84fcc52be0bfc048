//! How a steady state is sought, and why there is none.

use crate::drive::layout::LayoutError;
use crate::quantity::precision::{rounded, six_digits};
use crate::results::difficulty;
use crate::{Check, Impossible, LimitReason};
use std::borrow::Cow;
use std::sync::Arc;

/// How a steady state is sought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveOptions {
    /// Relative tolerance of profiles and constants, 1e-12 to 1e-2.
    pub tolerance: f64,
}

impl Default for SolveOptions {
    /// Relative tolerance 1e-6.
    fn default() -> Self {
        Self { tolerance: 1e-6 }
    }
}

/// Why there is no answer.
///
/// Of several reasons why a drive has no steady state the first in this order is given: statement, layout,
/// slack at rest, lift-off, travel of the tensioner, gross slip, what the other friction laws and a linear
/// elastic belt do not allow.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SolveError {
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
    /// There is no model of such a drive.
    #[error("{0}")]
    NotModelled(Cow<'static, str>),
    /// The tolerance is out of range.
    #[error("tolerance {tolerance:e} is outside 1e-12 to 1e-2")]
    Tolerance {
        /// The tolerance asked for.
        tolerance: f64,
    },
    /// The tight tension is below the slack one, which is seen once the belt speed is known.
    #[error(
        "the tight tension {} N is below the slack tension {} N", six_digits(*.tight),
        six_digits(*.slack)
    )]
    Backwards {
        /// Belt tension of the slack span, N.
        slack: f64,
        /// Belt tension of the tight span, N.
        tight: f64,
    },
    /// The belt has no tension at rest.
    #[error("the belt is slack at rest: its tension would be {} N", rounded(*.tension, 4.0))]
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
        "the belt lifts off{}: its tractive tension would be {} N at {speed:.4} m/s",
        if *.is_loaded { "" } else { " even without load" }, rounded(*.tractive_tension, 4.0)
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
        "the tensioner `{pulley}` goes beyond its travel: {} is not between {} and {}",
        rounded(*.coordinate, 6.0), rounded(travel[0], 6.0), rounded(travel[1], 6.0)
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
    #[error(
        "the belt would be stretched by {} times its length, where no belt is linear elastic",
        six_digits(*.strain)
    )]
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
    Unreached {
        /// Factor on all torques up to which states were found; 0 where there were none.
        reached: f64,
        /// Why the next one was not.
        cause: &'static str,
    },
    /// The equations could not be solved in double precision.
    #[error("the {what} could not be found in double precision")]
    NotFound {
        /// Which unknown.
        what: &'static str,
    },
    /// No steady state of a drive that is closed by the tensions of both spans carries the load.
    #[error(
        "no steady state: {quantity} {}",
        beyond([*.asked, *.limit], .unit, *.reason, .driven_speed.zip(*.exit_inclination))
    )]
    NoSteadyState {
        /// The prescribed quantity that is too large.
        quantity: &'static str,
        /// Its unit.
        unit: &'static str,
        /// Its value, SI.
        asked: f64,
        /// The largest value that the drive carries, SI.
        limit: f64,
        /// What happens there.
        reason: LimitReason,
        /// Angular speed of the driven pulley there, rad/s; of V-belts.
        driven_speed: Option<f64>,
        /// Inclination of the belt where it leaves the driver there, rad; of V-belts.
        exit_inclination: Option<f64>,
    },
    /// A flat belt that is closed by the tensions of both spans does not press on the pulleys: it is too slack for
    /// its speed.
    #[error(
        "no steady state: at {} m/s centrifugal force takes up G V = {} N, and the slack tension of \
         {} N leaves nothing to press the belt on the pulleys",
        six_digits(*.speed), six_digits(*.centrifugal), six_digits(*.tension)
    )]
    TooSlack {
        /// Belt tension of the slack span, N.
        tension: f64,
        /// Belt speed V there, m/s.
        speed: f64,
        /// Momentum flow G V there, N.
        centrifugal: f64,
    },
    /// The way to the steady state of a V-belt that is closed by the tensions of both spans was not found.
    #[error("not converged: {}; {}", reached(*.tight), difficulty::of_solver(.cause))]
    NotConverged {
        /// Tight tension up to which the state was found, N.
        tight: Option<f64>,
        /// Why the next problem on the way was not solved.
        cause: Arc<bvp::Error>,
    },
    /// No limit was found on a branch.
    #[error("no limit was found up to {reached}; the branch was not followed further: {cause}")]
    NoLimit {
        /// Value of the entry up to which the branch was followed, SI.
        reached: f64,
        /// Why it was not followed further.
        cause: String,
    },
    /// The state found is that of no drive.
    #[error("no possible steady state was found: {0}")]
    Impossible(Impossible),
    /// A state was found that violates an invariant.
    #[error(
        "the state found violates an invariant, {}: relative deviation {:.1e}, limit {:.1e}",
        .0.name, .0.deviation, .0.limit
    )]
    Violated(Check),
    /// The eigenvalues of the axial motion were not found beyond doubt.
    #[error("the axial modes were not found beyond doubt: {cause}")]
    Stability {
        /// Why.
        cause: String,
    },
}

impl SolveError {
    /// One word for programs.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Statement { .. } => "statement",
            Self::Layout(_) => "layout",
            Self::Slack { .. } => "slack at rest",
            Self::LiftsOff { .. } | Self::TooSlack { .. } => "lift-off",
            Self::TensionerBeyondTravel { .. } => "tensioner beyond travel",
            Self::NoEquilibrium { .. } => "no equilibrium",
            Self::GrossSlip { .. } | Self::Overloaded { .. } | Self::NoSteadyState { .. } => {
                "gross slip"
            }
            Self::Stalls { .. } => "stall",
            Self::Overstretched { .. } => "overstretched",
            Self::PressedThrough { .. } => "pressed through groove",
            _ => "not found",
        }
    }

    /// Whether what was asked makes no sense, whatever the drive carries.
    #[must_use]
    pub fn is_of_statement(&self) -> bool {
        matches!(
            self,
            Self::Statement { .. }
                | Self::Layout(_)
                | Self::NotModelled(_)
                | Self::Backwards { .. }
                | Self::Tolerance { .. }
        )
    }

    /// Why there is no answer, in a sentence that also says whether there is no steady state at all or none was
    /// found; of what [`Self::is_of_statement`], only what is wrong.
    #[must_use]
    pub fn sentence(&self) -> String {
        match self {
            _ if self.is_of_statement() => self.to_string(),
            Self::NoSteadyState { .. }
            | Self::TooSlack { .. }
            | Self::NotConverged { .. }
            | Self::NoLimit { .. }
            | Self::Impossible(_)
            | Self::Violated(_)
            | Self::Stability { .. } => self.to_string(),
            _ => format!("no steady state: {self}"),
        }
    }
}

/// By how much a load is beyond a limit, and the driven speed and the inclination at the driver's exit there.
fn beyond(
    [asked, limit]: [f64; 2],
    unit: &str,
    reason: LimitReason,
    state: Option<(f64, f64)>,
) -> String {
    match state {
        None => {
            let [asked, limit] = [asked, limit].map(six_digits);
            format!("{asked} {unit} exceeds the limit {limit} {unit} of this drive, where {reason}")
        }
        Some((speed, inclination)) => format!(
            "{asked:.2} {unit} exceeds the limit {limit:.2} {unit} of this drive, where {reason} (driven speed \
             {speed:.2} rad/s, inclination at the driver's exit {:.1}°)",
            inclination.to_degrees()
        ),
    }
}

fn reached(tight: Option<f64>) -> String {
    match tight {
        Some(tight) => format!(
            "a first approximation was found at a tight tension of {} N, but no accurate state",
            six_digits(tight)
        ),
        None => "no state was found on the way".to_owned(),
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
