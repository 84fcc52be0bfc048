//! What is simulated, and why it cannot be.

use super::axle::Axle;
use super::history::{Ending, History};
use super::transverse::Transverse;
use crate::{Drive, SolveError};

/// A drive in time.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulation {
    /// The drive, with pulleys at fixed centres: a flat belt with elastic/perfectly-plastic or creep-rate friction, or a
    /// V-belt with bristles in the grooves of all pulleys. Its duties and loads decide where the run starts, and where a V-belt meets
    /// and leaves its pulleys in all of it.
    pub drive: Drive,
    /// The axles of its pulleys, in belt order.
    pub axles: Vec<Axle>,
    /// Axial damping `c_d` of the belt, N·s: the tension is EA (λ − 1) + `c_d` λ̇. Not negative; 0 is no damping.
    pub axial_damping: f64,
    /// Damping `c_f` of the bristles of elastic/perfectly-plastic friction per unstretched length, N·s/m²: friction is
    /// `k_f` b + `c_f` (v − R ω) up to its limit μ n λ. Not negative; 0 is none.
    pub friction_damping: f64,
    /// Motion of the spans across; without it they stay straight.
    pub transverse: Option<Transverse>,
    /// The state at time 0.
    pub start: Start,
    /// Cells of the mesh.
    pub cells: Cells,
    /// When the run ends.
    pub until: Until,
    /// Time between two samples of the history, s; positive.
    pub interval: f64,
    /// Instants at which the belt along the loop is kept, s.
    pub instants: Vec<f64>,
    /// Most frames of an animation: the belt along the loop is kept at so many samples or fewer, at least half as many if
    /// there are; 0 keeps none.
    pub frames: usize,
    /// Largest time step, s, no longer than the largest stable one, which is taken without.
    pub step: Option<f64>,
}

/// The state at time 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// Nothing moves; the belt has the same tension everywhere, that of the drive at rest.
    Rest,
    /// The steady state of the drive.
    Running,
}

/// Cells of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cells {
    /// About so many in the whole loop, as long as each other but for short arcs and spans.
    Total(usize),
    /// So many on every arc, at least 4, and on every span, at least 2.
    Each {
        /// On every arc.
        arc: usize,
        /// On every span.
        span: usize,
    },
}

/// When a run ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Until {
    /// At a time, s.
    Time(f64),
    /// When nothing changes any more: no tension by more than 1e-6 of itself in a second and no rim speed by more
    /// than 1e-6 of the fastest one, in five samples one after the other, after the last corner of what is given
    /// over time.
    Steady {
        /// The time at which it ends if that has not happened, s.
        latest: f64,
    },
    /// When the belt first begins to slip on the whole contact with a pulley.
    Slip {
        /// The time at which it ends if that has not happened, s.
        latest: f64,
    },
    /// When the tension first falls below zero.
    Slack {
        /// The time at which it ends if that has not happened, s.
        latest: f64,
    },
}

impl Until {
    /// The time at which a run ends at the latest, s.
    #[must_use]
    pub fn latest(self) -> f64 {
        match self {
            Self::Time(latest)
            | Self::Steady { latest }
            | Self::Slip { latest }
            | Self::Slack { latest } => latest,
        }
    }
}

/// What makes the time steps of a run as short as they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StepBound {
    /// The step that was asked for.
    Asked,
    /// Waves along the belt and the length of the cells.
    Cells,
    /// The stiffness of friction, with the mass of the belt and the inertia of a pulley.
    Bristles {
        /// The pulley, by its place in belt order.
        pulley: usize,
    },
    /// Axial damping of the belt.
    AxialDamping,
    /// Damping of the motion of the spans across.
    DampingAcross,
    /// Torques of an axle that depend on its speed, with its inertia.
    Torque {
        /// The pulley, by its place in belt order.
        pulley: usize,
    },
    /// A sine that is added to what an axle is given.
    Pulsation {
        /// The pulley, by its place in belt order.
        pulley: usize,
    },
    /// The waves of a rim with run-out, and the speed of the pulley.
    RunOut {
        /// The pulley, by its place in belt order.
        pulley: usize,
    },
}

impl StepBound {
    /// What it is, in words that end a sentence.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Asked => "the step asked for",
            Self::Cells => "waves along short cells",
            Self::Bristles { .. } => "stiff friction on a light pulley or belt",
            Self::AxialDamping => "axial damping",
            Self::DampingAcross => "damping of the spans across",
            Self::Torque { .. } => "torques that depend on the speed of a light pulley",
            Self::Pulsation { .. } => "a pulsation",
            Self::RunOut { .. } => "run-out",
        }
    }
}

/// Why there is no history.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TransientError {
    /// A number of the statement is out of its range, or the parts of the statement do not belong together.
    #[error("{subject}: {problem}")]
    Statement {
        /// Of which part: the name of a pulley, or the part itself.
        subject: String,
        /// What is wrong with it.
        problem: String,
        /// The key of a drive file that states it, with `*` for the name of the pulley; none where several do.
        key: Option<&'static str>,
    },
    /// The drive has no state to start from.
    #[error("no state to start from: {0}")]
    Start(#[from] SolveError),
    /// The step that was asked for is not stable.
    #[error(
        "a time step of {asked:.3e} s is unstable: the largest stable one is {stable:.3e} s at {time:.6} s"
    )]
    Unstable {
        /// The step asked for, s.
        asked: f64,
        /// The largest stable step, s.
        stable: f64,
        /// When it is, s.
        time: f64,
    },
    /// The run takes more time steps than a computer can be asked for.
    #[error(
        "up to {end} s there are {steps:.0e} time steps of {step:.1e} s, more than {:.0e}, because of {}",
        super::run::MOST_IN_ALL,
        bound.name()
    )]
    TooManySteps {
        /// Time up to which the steps are counted, s.
        end: f64,
        /// How many there are.
        steps: f64,
        /// How long they are, s.
        step: f64,
        /// What makes them short.
        bound: StepBound,
    },
    /// The belt was shortened to nothing or numbers grew beyond all bounds.
    #[error("the belt has no possible state after {time:.6} s: {problem}")]
    Impossible {
        /// The last time at which it had one, s.
        time: f64,
        /// What became impossible.
        problem: &'static str,
        /// What was followed up to there; none at time 0.
        history: Option<Box<History>>,
    },
    /// The eigenvalues of the linearised equations are out of reach of finite arithmetic.
    #[error("the eigenvalues of the linearised drive cannot be computed")]
    Eigenvalues,
    /// Rates of the linearised equations are so fast that slow modes are lost in rounding beside them.
    #[error(
        "modes below {least:.1e} Hz are lost in rounding: friction is too steep beside waves along the belt; take softer or \
         less damped bristles, or a larger velocity of creep-rate friction"
    )]
    Lost {
        /// The least frequency that would be told, Hz.
        least: f64,
    },
    /// Energy was lost or won beside what the ledger accounts for.
    #[error(
        "the energy ledger does not close: {residual:.2e} J of {turnover:.2e} J are not accounted for at {time:.6} s, \
         more than {:.0e} of them; take more cells or a shorter time step",
        super::ledger::BOUND
    )]
    Ledger {
        /// What is missing, J.
        residual: f64,
        /// What the ledger is measured by, J.
        turnover: f64,
        /// When it was found, s.
        time: f64,
        /// What was followed up to there.
        history: Option<Box<History>>,
    },
}

impl TransientError {
    /// What a run that failed had followed up to there, with [`Ending::Failed`]; none if none had begun.
    #[must_use]
    pub fn history(&self) -> Option<&History> {
        match self {
            Self::Impossible { history, .. } | Self::Ledger { history, .. } => history.as_deref(),
            _ => None,
        }
    }

    /// The error of a run that had come as far as this.
    pub(super) fn after(mut self, told: History) -> Self {
        if let Self::Impossible { history, .. } | Self::Ledger { history, .. } = &mut self {
            *history = Some(Box::new(History {
                ending: Ending::Failed,
                ..told
            }));
        }
        self
    }

    /// Whether what was asked makes no sense, whatever the drive does.
    #[must_use]
    pub fn is_of_statement(&self) -> bool {
        match self {
            Self::Statement { .. } | Self::Unstable { .. } | Self::TooManySteps { .. } => true,
            Self::Start(error) => error.is_of_statement(),
            Self::Impossible { .. }
            | Self::Eigenvalues
            | Self::Lost { .. }
            | Self::Ledger { .. } => false,
        }
    }
}
