//! The V-belt drive: a string with axial stretch that sinks into the groove of each pulley, in
//! steady motion, as a boundary value problem.
//!
//! The belt meets pulley 1 (driven), the tight span, pulley 2 (driver) and the slack span in this
//! order. On each pulley the arc length s starts where the belt enters; angles are positive along
//! the motion, the inclination θ and all radial forces on the belt are positive outward, the
//! penetration x = R − r is positive inward.
//!
//! Sources: D. Kim, MS thesis, Georgia Institute of Technology (2009), chapter 3; L. Kong and
//! R. G. Parker, J. Mech. Des. 128 (2006); G. Gerbert and F. Sorge, J. Mech. Des. 124 (2002);
//! P. R. Dahl, Aerospace Corp. TOR-0158 (1968) for the bristles.

pub(crate) mod belt_loop;
mod belt_problem;
mod beyond;
mod by_branch;
mod carried;
mod chart;
mod closure;
mod contact;
mod creep;
mod cubic;
mod curve;
mod drive_problem;
mod family;
mod followed;
mod found;
mod groove;
mod guess;
mod laws;
mod limit;
mod limit_curve;
mod limits;
mod locked;
mod model;
mod numbers;
mod on_pulley;
mod other_zones;
mod over;
mod path;
mod piece;
mod scaling;
mod solve;
mod starts;
mod state;
mod steps;
mod trace;
mod tracer;
mod vector;
mod watched;
mod zones;

pub(crate) use belt_problem::BeltProblem;
pub(crate) use closure::{EndAngles, Layout};
pub(crate) use contact::{
    BREAKAWAY, Contact, beyond_breakaway, breakaway_excess, deepening, hold_excess, limit_excess,
};
pub(crate) use drive_problem::{DriveProblem, Instead};
pub(crate) use groove::{Groove, Law, Regime};
pub(crate) use guess::Guess;
pub(crate) use over::Over;
pub(crate) use path::Solved;
pub(crate) use scaling::{Scales, Strand, Units};
pub(crate) use state::sharper;

use groove::{ANGLE, INCLINATION, LAW, MAX_STATES, PENETRATION, TENSION};

pub(crate) use model::VBelts;

/// Index of the driven pulley, which comes first.
pub(crate) const DRIVEN: usize = 0;
/// Index of the driver.
pub(crate) const DRIVER: usize = 1;

/// Bristles deflected to this share of their limit count as slipping.
pub(crate) const SLIPPING_BRISTLES: f64 = 0.99;
