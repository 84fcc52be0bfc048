//! Belt drives in time: start-up, load steps, slip and its end, the way to the steady state.
//!
//! The belt is a one-dimensional continuum that flows through a fixed mesh along the loop, with bristles on the arcs
//! that it carries along; the pulleys turn with their inertia. [`simulate`](crate::simulate()) follows them; `docs/transient.md` has the equations, the scheme and its limits of validity.
//!
//! ```text
//! mass       ∂ρ/∂t + ∂(ρ v)/∂σ = 0                                 ρ = 1/λ
//! momentum   m (∂v/∂t + v ∂v/∂σ) = λ ∂T/∂σ − q                     T = EA (λ − 1) + c_d λ̇
//! bristles   ∂b/∂t + v ∂b/∂σ = v − R ω,  b = 0 at the entry        |b| ≤ μ n λ/k_f
//! friction   q = k_f b                                             n = max(EA (λ − 1) − m v²/λ, 0)/R
//! pulleys    J dω/dt = R ∫ q ρ dσ + M
//! ```
//!
//! Force and mass are per unstretched length, λ is the stretch. What stands still in these equations is the closed
//! form of the steady drive with [`NormalForce::Exact`](crate::NormalForce::Exact), whatever the convention that
//! the drive states.
//!
//! Every arc and every span has cells of one length, with faces on the tangent points, so that no cell ever enters
//! or leaves a contact: the steady state is a fixed point of the scheme, of order two. Time steps are those of the
//! classical Runge–Kutta method, bound by the time in which a wave passes a cell and by a light pulley on stiff bristles.
//! On the way to a steady state, from where nothing changes any more of what is given, they are those of an implicit
//! method, as long as the motion allows, which damps vibrations.
//!
//! As an option the spans move across ([`Transverse`]), with explicit steps only.
//!
//! V-belts with bristles have equations of their own, in the module `v`, and the same runs.
//!
//! Flat belts have elastic/perfectly-plastic friction, with damped bristles or without, or creep-rate friction.
//!
//! Not modelled: tensioners, bending, other friction laws.

mod axle;
mod axles;
mod bordered;
mod bristle;
mod dynamics;
mod events;
mod explicit;
mod frames;
pub(crate) mod history;
mod implicit;
pub(crate) mod initial;
mod jacobian;
mod ledger;
mod linearised;
pub(crate) mod mesh;
pub(crate) mod rates;
pub(crate) mod run;
mod schedule;
mod simulation;
mod slip;
mod state;
pub(crate) mod statement;
mod steady;
mod string;
mod sums;
mod system;
#[cfg(test)]
mod tests;
mod transverse;
pub(crate) mod v;
pub(crate) mod vibration;

pub use axle::{Axle, Load, Motion, Motor};
pub use events::{SlackSpan, TransientEvent, TransientEventKind};
pub use history::{BeltAlongLoop, Effort, Ending, History, PulleySample, Sample};
pub use implicit::ImplicitWork;
pub use ledger::Ledger;
pub use schedule::{Pulsation, Schedule};
pub use simulation::{Cells, Simulation, Start, StepBound, TransientError, Until};
pub use transverse::{Pluck, RunOut, Transverse};
pub use vibration::VibrationMode;
