//! Steady mechanics of belt drives: from a drive to its slip, wrap angles, torque and limits.
//!
//! A two-pulley V-belt drive is a string with axial stretch that sinks into the groove of each
//! pulley. [`solve`] finds its steady state — as a boundary value problem with unknown contact
//! lengths, closed by the plane geometry of the drive — for Coulomb, elastic/perfectly-plastic and
//! bristle friction, from nothing but the [`Drive`], and says how accurate it is; a load that no
//! steady state carries is refused with the limit and its reason ([`SolveError`]).
//!
//! # Conventions
//!
//! SI units throughout, angles in radians; units exist only in drive files ([`input`]). The driven
//! pulley has index 1 in formulas, the driver 2. The belt runs driven pulley, tight span, driver,
//! slack span. On each pulley the arc length s and the angle φ start where the belt enters;
//! tension is positive in traction, the inclination θ of the belt to the local circle is positive
//! outward, the penetration x is positive inward. The tractive tension is F = T − G V with the
//! belt tension T, the mass flow G and the belt speed V.
//!
//! # Assumptions
//!
//! Steady motion in one plane; a string without bending stiffness; a linear elastic belt, axially
//! and radially; equal faces of a groove; no thermal effects. Beyond an inclination of 90° the belt
//! overhangs itself: such states solve the equations and carry a [`Warning`].
//!
//! # Example
//!
//! ```
//! use beltdrive::{SolveOptions, examples, input, solve};
//!
//! let example = examples::find("kim2009").expect("a shipped example");
//! let load = ["load.tight_tractive_tension = 1200 N".to_owned()];
//! let drive = input::parse(example.name, example.text, &load)?;
//! let state = solve(&drive, &SolveOptions::default())?;
//! assert!((state.driven.angular_speed - 100.426086).abs() < 1e-4);
//! assert!(state.convergence.error_estimate < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Branches and limits
//!
//! [`trace`] follows the steady states over any numeric entry of the drive file, an
//! [`input::Key`], around limit points, and locates what happens on the way ([`EventKind`]).
//! [`limits`] gives both ends of the range of a load and why it ends there, [`limit_curve`] the
//! limit of one entry over a second one. With less friction the drive above does not carry 3 kN:
//!
//! ```
//! use beltdrive::input::{self, Key};
//! use beltdrive::{EventKind, Pulley, SolveOptions, examples, trace};
//!
//! let example = examples::find("kim2009").expect("a shipped example");
//! let friction = ["friction.coefficient = 0.3".to_owned()];
//! let drive = input::parse(example.name, example.text, &friction)?;
//! let load = Key::load(&drive);
//! let range = [1500.0, 3000.0];
//! let branch = trace(&drive, &load, range, &SolveOptions::default(), &mut |_, _| {})?;
//!
//! let last = branch.events.last().expect("a start and an end");
//! println!("{} N: {}", last.point.value, branch.end); // the driven pulley slips grossly
//! assert_eq!(last.kind, EventKind::GrossSlip(Pulley::Driven));
//! assert!((last.point.value - 2233.7022).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod branch;
mod drive;
pub mod examples;
mod flat;
pub mod input;
mod limit_curve;
mod limits;
pub mod plot;
pub mod report;
mod solve;
mod stability;
mod state_summary;
mod steady_state;
mod vbelt;

pub use branch::{Branch, BranchEnd, BranchEvent, EventKind, TraceConvergence, TracePoint, trace};
pub use drive::{Belt, BeltKind, Drive, FrictionLaw, Load, NormalForce, SpanTension, VBelt};
pub use limit_curve::{LimitCurve, LimitCurvePoint, limit_curve};
pub use limits::{Limit, LimitReason, Limits, RangeEnd, limits};
pub use solve::{SolveError, SolveOptions, solve, solve_from};
pub use stability::{
    AxialMode, FormStability, LinearisedForm, Onset, PulleyStability, ShapePoint, Stability,
    stability,
};
pub use state_summary::{PulleyErrors, PulleySummary, StateErrors, StateSummary};
pub use steady_state::{
    Check, Convergence, Entry, Profile, Pulley, PulleyState, SteadyState, Warning, Zone, ZoneKind,
};

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
