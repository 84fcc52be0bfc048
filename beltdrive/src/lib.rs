//! Steady mechanics of belt drives: from a drive to its slip, wrap angles, torque and limits.
//!
//! A [`Drive`] is a belt round two or more pulleys, and a [`Closure`] that fixes how tight it is. [`solve`] finds
//! the steady state of one with two pulleys that is closed by the tensions of both spans, from nothing but the
//! drive, and says how accurate it is; a load that no steady state carries is refused with the limit and its reason
//! ([`SolveError`]). The [`BeltKind`] decides between two models:
//!
//! - A **V-belt** is a string with axial stretch that sinks into the groove of each pulley. Its state
//!   is the solution of a boundary value problem with unknown contact lengths, closed by the plane
//!   geometry of the drive, for Coulomb, elastic/perfectly-plastic and bristle friction.
//! - A **flat belt** is a string on the rims. Its state is known in closed form, for Coulomb,
//!   elastic/perfectly-plastic and creep-rate friction and three conventions for the normal force
//!   ([`NormalForce`]). [`flat::ClosedForm`] gives it without profiles. [`stability`](stability()) examines its axial motion.
//!
//! Drives with any number of pulleys, a tensioner or another closure are answered by [`belt_loop`], which
//! answers for those with two pulleys as well, with what it has more to tell: rest, hub loads, margins.
//!
//! [`simulate`](simulate()) follows a drive with a flat belt in time ([`transient`]); [`modes`](modes()) are its
//! vibrations about the steady state.
//!
//! [`mod@verify`] computes published results again.
//!
//! # Conventions
//!
//! SI units throughout, angles in radians; units exist only in drive files ([`input`]). The driven
//! pulley has index 1 in formulas, the driver 2. The belt runs driven pulley, tight span, driver,
//! slack span. On each pulley the arc length s and the angle φ start where the belt enters;
//! tension is positive in traction. The tractive tension is F = T − G V with the belt tension T, the
//! mass flow G and the belt speed V. On V-belts the inclination θ of the belt to the local circle is
//! positive outward, the penetration x is positive inward.
//!
//! A flat belt is displaced by u against the rim, positive forward: u is positive on the driven pulley,
//! where the belt outruns the rim and the tension grows, and negative on the driver. u′ = (T − `T_o`)/EA
//! with the tension `T_o` at which the belt would run as fast as the rim ([`Entry`]). Friction forces
//! are magnitudes.
//!
//! # Assumptions
//!
//! Steady motion in one plane; a string without bending stiffness; a linear elastic belt; V-belts also
//! radially elastic in a groove with equal faces; no thermal effects. Beyond an inclination of 90° a
//! V-belt overhangs itself: such states solve the equations and carry a [`Warning`].
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
//! A flat belt with bristles so stiff that it all but sticks where it enters:
//!
//! ```
//! use beltdrive::{SolveOptions, ZoneKind, examples, input, solve};
//!
//! let example = examples::find("kim2009-flat").expect("a shipped example");
//! let drive = input::parse(example.name, example.text, &[])?;
//! let state = solve(&drive, &SolveOptions::default())?;
//! let [elastic, slip] = &state.driven.zones[..] else {
//!     panic!("two zones")
//! };
//! assert_eq!([elastic.kind, slip.kind], [ZoneKind::Elastic, ZoneKind::Slip]);
//! assert!((elastic.to.to_degrees() - 141.6926).abs() < 1e-4);
//! // The rims are as fast as the belt at its reference tensions.
//! let rim = |entry: Option<beltdrive::Entry>| {
//!     drive.belt.axial_stiffness + entry.map_or(0.0, |entry| entry.reference_tension)
//! };
//! let ratio = rim(state.driven.entry) / rim(state.driver.entry);
//! assert!((state.driven.angular_speed / state.driver.angular_speed - ratio).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Branches and limits
//!
//! [`trace`] follows the steady states over any numeric entry of the drive file, an
//! [`input::Key`], around limit points, and locates what happens on the way ([`EventKind`]).
//! [`limits`] gives both ends of the range of a load and why it ends there, [`limit_curve`] the
//! limit of one entry over a second one. With less friction the first drive does not carry 3 kN:
//!
//! ```
//! use beltdrive::input::{self, Key};
//! use beltdrive::{EventKind, Role, SolveOptions, examples, trace};
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
//! assert_eq!(last.kind, EventKind::GrossSlip(Role::Driven));
//! assert!((last.point.value - 2233.7022).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod answers;
mod belt;
pub mod belt_loop;
mod drive;
pub mod examples;
pub mod flat;
mod friction;
pub mod input;
mod mechanics;
mod model;
pub mod page;
pub mod plot;
pub mod quantity;
pub mod report;
mod results;
pub mod sections;
pub mod transient;
mod vbelt;

pub use answers::calibrate::{self, Calibration, calibrate};
pub use answers::check::{
    CaseState, CheckedCase, CheckedService, Failing, OnPulley, SlipMargin, check,
};
pub use answers::design::{
    Combination, DecidingLimit, DesignError, DesignLimit, Designed, LimitPlace, Unfit, design,
};
pub use answers::drive::{limit_curve, limits, solve, solve_from, stability, trace};
pub use answers::losses::Losses;
pub use answers::map::{MapAxis, MapState, OperatingMap, map};
pub use answers::modes::{Modes, ModesAtSpeed, ModesQuestion, modes};
pub use answers::rating::{RatedLoad, Rating, RatingEnd, RatingQuestion, RatingStretch, rating};
pub use answers::simulate::simulate;
pub use answers::sweep::{
    Grid, LatinHypercube, Sobol, Sweep, SweepError, SweepQuestion, SweepRow, SweepSummary,
    SweepTable, Swept, TableError, TableRows,
};
pub use answers::tension::{
    Elongated, OtherFriction, Set, Setting, Setup, SetupQuestion, Travel, tension,
};
pub use answers::uncertainty;
pub use answers::verify::{self, Verification, verify};
pub use answers::{Solved, solve_any};
pub use belt::{Belt, BeltKind, NormalForce, VBelt};
pub use drive::layout::{Layout, LayoutError, PlacedPulley, Sense, Side, Span};
pub use drive::{
    BendingLoss, Closure, Drive, Duty, GivenLosses, Guide, Load, LoadCase, Mount, Pulley,
    Requirements, Service, SpanTension, Tensioner, TensionerLoad, TwoPulleys,
};
pub use friction::FrictionLaw;
pub use results::branch::{
    Branch, BranchEnd, BranchEvent, EventKind, TraceConvergence, TracePoint,
};
pub use results::error::{LoadedState, SolveError, SolveOptions};
pub use results::impossible::Impossible;
pub use results::largest_load::LoadEnd;
pub use results::limit_curve::{LimitCurve, LimitCurvePoint};
pub use results::limits::{Limit, LimitReason, Limits, RangeEnd};
pub use results::measured::Measured;
pub use results::stability::{
    AxialMode, FormStability, LinearisedForm, Onset, PulleyStability, ShapePoint, Stability,
};
pub use results::state_summary::{PulleyErrors, PulleySummary, StateErrors, StateSummary};
pub use results::steady_state::{
    Check, Convergence, Entry, LeastSlip, Profile, PulleyState, Role, SteadyState, Zone, ZoneKind,
};
pub use results::warning::Warning;

/// The examples of the README are tests.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;

/// The example of the page on sweeps is a test.
#[cfg(doctest)]
#[doc = include_str!("../../docs/sweeps.md")]
struct Sweeps;

/// The examples of the page on the crates are tests.
#[cfg(doctest)]
#[doc = include_str!("../../docs/solvers.md")]
struct Solvers;
