//! The steady state of a drive: everything that reports, tables and figures show.

use crate::results::possible;
use crate::results::warning::Warning;
use crate::vbelt::{Solved, sharper};
use crate::{Drive, SolveError};
use serde::Serialize;
use std::sync::Arc;

/// The steady state of a two-pulley drive. SI units; the names of serialised keys carry theirs.
#[derive(Clone, Debug)]
pub struct SteadyState {
    /// The drive that was solved.
    pub drive: Drive,
    /// Mass flow G through every cross-section, kg/s.
    pub mass_flow: f64,
    /// Unstretched length of the whole belt, m.
    pub belt_length: f64,
    /// Length of the free slack span, m.
    pub slack_span: f64,
    /// Length of the free tight span, m.
    pub tight_span: f64,
    /// Belt tension T in the slack span, N.
    pub slack_tension: f64,
    /// Belt tension T in the tight span, N.
    pub tight_tension: f64,
    /// Tractive tension F = T − G V in the slack span, N.
    pub slack_tractive_tension: f64,
    /// Tractive tension F = T − G V in the tight span, N.
    pub tight_tractive_tension: f64,
    /// Power taken by the driven pulley over power given by the driver. Where no power flows it is 0 on
    /// V-belts, and its limit 1 on flat belts.
    pub efficiency: f64,
    /// Power lost in friction, W; not negative.
    pub friction_loss: f64,
    /// Power spent on compressing the belt where it sinks into the grooves less the power that it gives back
    /// where it rises, W; either sign, 0 on flat belts. With the friction loss it is the power lost. It is
    /// not 0 since the belt speed differs between entry and exit.
    pub compression_power: f64,
    /// State of the driver.
    pub driver: PulleyState,
    /// State of the driven pulley.
    pub driven: PulleyState,
    /// Remarks on the validity of the state that a user must read.
    pub warnings: Vec<Warning>,
    /// The verified invariants of the state, each with its relative deviation.
    pub checks: Vec<Check>,
    /// How the numbers were reached and how accurate they are.
    pub convergence: Convergence,
    /// The solution behind the numbers, from which a neighbouring drive is solved.
    pub(crate) restart: Option<Arc<Solved>>,
}

impl SteadyState {
    /// The drive of this state as a loop that is closed by its slack tension, with the torque of the driven pulley.
    pub fn as_loop(&self) -> Drive {
        let torque = self.driven.torque;
        self.drive.as_loop(torque, self.slack_tractive_tension)
    }

    /// The state of a V-belt once more: corrected to first order for a quarter of the smoothing of friction, or with
    /// bristles solved to a tenth of the estimated error. The error of any number that is computed from a state is estimated
    /// by its difference from that of the sharper state, whatever cancels in it, and the relative error of that. At most a
    /// third of the difference is left behind it, since both errors vanish at least in proportion.
    ///
    /// `None` of a flat belt, which is solved in closed form, and where no sharper state is found, as near rounding.
    #[must_use]
    pub fn sharper(&self) -> Option<Self> {
        sharper(self, self.restart.as_deref()?)
    }

    /// The state if it passes all of its checks, first those of what no drive does.
    ///
    /// # Errors
    /// [`SolveError::Impossible`] or [`SolveError::Violated`], with the first check that it fails.
    pub(crate) fn verified(&self) -> Result<(), SolveError> {
        if self.checks.iter().all(Check::holds) {
            return Ok(());
        }
        if let Some(reason) = possible::fault(self) {
            return Err(SolveError::Impossible(reason));
        }
        match self.checks.iter().find(|check| !check.holds()) {
            Some(check) => Err(SolveError::Violated(check.clone())),
            None => Ok(()),
        }
    }
}

/// The state of one pulley and of the belt on it.
#[derive(Clone, Debug)]
pub struct PulleyState {
    /// Angular speed, rad/s.
    pub angular_speed: f64,
    /// Torque between belt and pulley, N·m; positive in the sense of power transmission.
    pub torque: f64,
    /// Angle swept by the belt on the pulley, rad.
    pub wrap_angle: f64,
    /// The wrap angle π ± 2 asin((R₁ − R₂)/C) of the pitch circles, rad, on which the belt neither sinks into
    /// the groove nor leaves the tangent.
    pub geometric_wrap_angle: f64,
    /// Largest penetration of the belt into the groove, m.
    pub max_penetration: f64,
    /// Inclination θ of the belt to the local circle at entry and exit, rad; positive outward.
    pub inclination: [f64; 2],
    /// Friction zones in the order in which the belt passes them.
    pub zones: Vec<Zone>,
    /// How the belt enters the pulley; of flat belts.
    pub entry: Option<Entry>,
    /// Where the belt hardly slips; of V-belts.
    pub least_slip: Option<LeastSlip>,
    /// The belt along the pulley, from entry to exit.
    pub profile: Profile,
}

/// How a flat belt enters a pulley.
///
/// The rim of the pulley has the speed that the belt would have at the tension `T_o`; where the belt
/// enters, it is stretched against that by the strain u′(0) = (T(0) − `T_o`)/EA.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Tension `T_o` at which the belt would run as fast as the rim, N.
    pub reference_tension: f64,
    /// Strain u′(0) of the belt against the rim; positive on the driven pulley, negative on the
    /// driver.
    pub strain: f64,
    /// Friction stiffness below which friction stays elastic over the whole arc at the tractions of
    /// this state, N/m²; only for EPP friction, and only if there is one.
    pub smallest_stiffness: Option<f64>,
}

/// Where a V-belt hardly slips on a pulley: friction has its full value there, and yet nothing can be seen to move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastSlip {
    /// Smallest slip velocity against the pulley, in the plane of a groove face, as a share of the belt speed. What is
    /// below 1e-14 is rounding.
    pub slip: f64,
    /// By how much the slip may be off where the direction of friction is that of a slip normalised by ε: 100 ε, otherwise
    /// zero.
    pub normalised: f64,
    /// The longest arc of friction at its limit on which the slip is below [`LeastSlip::LOCKED`]: angles from the
    /// entry, rad.
    pub locked: Option<[f64; 2]>,
}

impl LeastSlip {
    /// The slip, as a share of the belt speed, below which a belt at full friction counts as locked: a micrometre in
    /// ten metres of belt.
    pub const LOCKED: f64 = 1e-7;

    /// The smallest slip, as a share of the belt speed, from which on a pulley is said to slip grossly: on the example
    /// `v-power` it is 0.005 at nine tenths of the limit of the load, beyond which it rises to 1 within a few percent of that.
    pub(crate) const GROSS: f64 = 0.05;

    /// Whether the slip is so accurate that the arc on which the belt is locked can be told.
    pub(crate) fn tells_locked(&self) -> bool {
        self.normalised < Self::LOCKED
    }
}

/// What the belt does over a part of the wrap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum ZoneKind {
    /// Friction below its limit: the belt sticks through its bristles.
    Elastic,
    /// Friction at its limit: the belt slides.
    Slip,
    /// The belt sticks and its tension is constant. There is no friction (flat belts, Coulomb friction), or
    /// friction below its limit that only holds the belt in the groove (V-belts, EPP friction).
    Adhesion,
    /// Friction below its limit that grows with the slip velocity (flat belts, creep-rate friction).
    Creep,
}

impl ZoneKind {
    /// Every kind.
    pub(crate) const ALL: [Self; 4] = [Self::Elastic, Self::Adhesion, Self::Creep, Self::Slip];

    /// The name of the kind in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Elastic => "elastic",
            Self::Slip => "slip",
            Self::Adhesion => "adhesion",
            Self::Creep => "creep",
        }
    }
}

/// A part of the wrap where friction is of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zone {
    /// Kind of friction.
    pub kind: ZoneKind,
    /// Angle from the entry where the zone begins, rad.
    pub from: f64,
    /// Angle from the entry where the zone ends, rad.
    pub to: f64,
}

/// Quantities along the belt on one pulley, all of one length, from entry to exit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// Angle φ from the entry, rad.
    pub angle: Vec<f64>,
    /// Arc length s along the belt from the entry, m.
    pub arc_length: Vec<f64>,
    /// Belt tension T, N.
    pub tension: Vec<f64>,
    /// Tractive tension F = T − G V, N.
    pub tractive_tension: Vec<f64>,
    /// Inclination θ to the local circle, rad; positive outward.
    pub inclination: Vec<f64>,
    /// Penetration x into the groove, m.
    pub penetration: Vec<f64>,
    /// Axial displacement u of the belt against the pulley, m.
    pub displacement: Vec<f64>,
    /// Sliding angle γ, rad: direction of the slip velocity from the outward radius towards the
    /// motion of the pulley; where a V-belt sticks, that in which it came to rest.
    pub sliding_angle: Vec<f64>,
    /// Normal force per length, N/m: p on each groove face of a V-belt, n of a flat belt.
    pub normal_force: Vec<f64>,
    /// Friction force f per length, N/m: on each groove face of a V-belt, on all of a flat belt.
    pub friction_force: Vec<f64>,
}

/// One of the two pulleys of a drive, by what it does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Role {
    /// The pulley that is driven by the belt.
    Driven,
    /// The pulley that drives the belt.
    Driver,
}

impl Role {
    /// The name of the pulley in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Driven => "driven pulley",
            Self::Driver => "driver",
        }
    }
}

/// A verified invariant.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What was verified.
    pub name: &'static str,
    /// Relative deviation found.
    pub deviation: f64,
    /// Relative deviation allowed.
    pub limit: f64,
}

impl Check {
    /// Whether the deviation is a number within the limit.
    pub(crate) fn holds(&self) -> bool {
        self.deviation <= self.limit
    }
}

/// How a steady state was reached and how accurate it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Convergence {
    /// Relative tolerance asked for.
    pub tolerance: f64,
    /// Largest relative defect of the profiles in the differential equations. With Coulomb friction, whose meshes are for the
    /// error, it may be above the tolerance.
    pub defect: f64,
    /// Estimated largest relative error of all profiles and constants.
    pub error_estimate: f64,
    /// Final number of mesh intervals: driver, driven.
    pub mesh_intervals: [usize; 2],
    /// Newton steps in all, starting from the drive file.
    pub newton_iterations: usize,
    /// Evaluations of the right-hand side (with or without its derivatives).
    pub rhs_evaluations: usize,
    /// Factorisations of the Newton matrix.
    pub factorisations: usize,
    /// Boundary value problems solved on the way to this one.
    pub continuation_steps: usize,
    /// What smooths the direction of friction in the final state: the length ℓ/R over which the traction of
    /// Coulomb friction follows the slip, or, with EPP friction and Coulomb friction next to no load, the
    /// normalisation ε of the slip direction. 0 for the bristle law.
    pub slip_normalisation: f64,
    /// Estimated relative effect of that on the constants of the drive.
    pub slip_normalisation_effect: f64,
    /// Wall-clock seconds.
    pub seconds: f64,
}
