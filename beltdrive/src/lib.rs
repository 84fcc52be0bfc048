//! Steady mechanics of belt drives.

mod drive;
pub mod examples;
pub mod input;
pub mod plot;
pub mod report;
mod steady_state;
mod vbelt;

pub use drive::{Belt, Drive, FrictionLaw, Load, SpanTension};
pub use steady_state::{
    Check, Convergence, Profile, Pulley, PulleyState, SteadyState, Warning, Zone, ZoneKind,
};
pub use vbelt::{LimitReason, SolveError, SolveOptions, solve};
