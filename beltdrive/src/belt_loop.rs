//! Belts round any number of pulleys: layout, loads, tensioner, and the steady state.
//!
//! A [`Drive`](crate::Drive) states the belt, the pulleys in the order in which the belt meets them, what each of
//! them does, and one [`Closure`](crate::Closure) that fixes how tight the belt is. [`solve`] finds its steady state, or
//! says why there is none ([`SolveError`](crate::SolveError)). [`Layout`](crate::Layout) is the plane geometry by itself.
//!
//! # Equations
//!
//! Span i leaves pulley i. With the speed c = G/m of the unstretched belt and D = EA − m c²,
//!
//! ```text
//! belt              V = c (1 + T/EA)        F = T − G V = T D/EA − m c²
//! torque            (P_i − P_{i−1}) R_i = M_i                    M > 0 where power leaves the belt
//! friction law      R_i ω_i = c (1 + T_o,i/EA)                   T_o: reference tension of the contact
//! tensioner         Q(q) − F_t dL/dq = 0                         F_t: tractive tension of its idler
//! ```
//!
//! with the load Q of the tensioner, −k (q − q₀) of a spring, and the closure. Contacts are those of the
//! two-pulley flat belt, with its friction laws and conventions for the normal force. The traction P is the
//! tractive tension F with [`crate::NormalForce::Inertia`] and [`crate::NormalForce::Exact`]. With
//! [`crate::NormalForce::Thesis`] it is T (1 − m v²/EA), where v is the speed of the slackest span of the
//! loop: friction then leaves out that momentum takes pressure off the pulleys. Hub loads, the equilibrium
//! of the tensioner and the frequencies of spans take the momentum of the belt into account with every
//! convention; a torque differs from that change of F times R by a share of m (v² − c²)/EA with `thesis`.
//!
//! Assumptions: those of the flat belt; no friction in bearings and in the tensioner; the belt at rest has
//! one tension everywhere.
//!
//! # V-belts
//!
//! Pulleys inside the loop are grooves, each with a half angle and a coefficient of friction of its own;
//! pulleys outside are flat and touch the back of the belt, which bends round them at their stated radius.
//! The belt sinks into every groove, so that it leaves a pulley at the pitch radius R with an inclination θ,
//! tangent to the circle R cos θ. The loop is one boundary value problem, with the laws of friction of
//! the two-pulley V-belt:
//!
//! ```text
//! torque            R_i (F_i cos θ_out − F_{i−1} cos θ_in) = M_i       so that Σ M_i/R_i is not 0
//! wrap              φ_i − (θ_out − θ_in)                               angle between the spans
//! span              ℓ_i = ℓ(tangent) − R_i sin θ_out,i + R_j sin θ_in,j
//! tensioner         Q(q) + H · dC/dq = 0                               H: hub load of its idler
//! ```
//!
//! The contacts are those of the two-pulley V-belt. On its back the belt presses with F/R per length, and
//! friction has the same law in one direction; an idler there turns with the belt. The belt at rest is one
//! without friction, as deep in every groove as its tension presses it; a groove carries up to k R² tan β/6
//! at rest ([`SolveError::PressedThrough`](crate::SolveError::PressedThrough)), and a loop whose belt cannot be at rest so is refused even where
//! friction holds it in motion. The bristles of the loop are found from nothing; where they are not, and for
//! the margins ([`solve_with_margins`]), all torques are raised together from a small share. A state whose
//! invariants fail is an error ([`LoopState::checks`], [`SolveError::Violated`](crate::SolveError::Violated)).
//!
//! With elastic/perfectly-plastic friction the displacement in grooves grows from the tension `T_o` of the slackest
//! span on every pulley (its tractive tension where the closure gives one), as in a drive with two pulleys. A pulley
//! that the belt enters with about that tension is driven by friction that has hardly developed: if it is soft, the
//! loop carries far less than with Coulomb friction, or with the vector law. The back of the belt has the friction of a
//! flat belt, with a tension `T_o` of its own on every pulley.
//!
//! Sources: M. B. Rubin, An exact solution for steady motion of an extensible belt in multipulley belt
//! drive systems, J. Mech. Des. 122 (2000); S. E. Bechtel, S. Vohra, K. I. Jacob and C. D. Carlson, J.
//! Appl. Mech. 67 (2000), for the contact; R. S. Beikmann, N. C. Perkins and A. G. Ulsoy, J. Mech. Des. 118
//! (1996), for the equilibrium of the tensioner and the tensioner constant.
//!
//! # Example
//!
//! A driver, a fan and a water pump on the back of the belt, set up with 400 N:
//!
//! ```
//! use beltdrive::belt_loop::solve;
//! use beltdrive::{
//!     Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, NormalForce, Pulley, Sense, Side,
//! };
//!
//! let pulley = |name, centre, radius, duty| Pulley::new(name, centre, radius, 0.7, duty);
//! let pump = pulley("pump", [0.2, 0.03], 0.03, Duty::Torque(0.5));
//! let drive = Drive {
//!     title: None,
//!     belt: Belt {
//!         ribs: 1,
//!         mass_per_length: 0.15,
//!         axial_stiffness: 60e3,
//!         kind: BeltKind::Flat { normal_force: NormalForce::Inertia },
//!     },
//!     law: FrictionLaw::Coulomb,
//!     sense: Sense::Clockwise,
//!     turning_number: 1,
//!     pulleys: vec![
//!         pulley("driver", [0.0, 0.0], 0.06, Duty::Driver(200.0)),
//!         Pulley { side: Side::Outside, ..pump },
//!         pulley("fan", [0.4, 0.05], 0.1, Duty::Torque(20.0)),
//!     ],
//!     closure: Closure::SetupTension(400.0),
//! };
//! let state = solve(&drive)?;
//! let [driver, pump, fan] = &state.pulleys[..] else { panic!("three pulleys") };
//! assert!((driver.torque + 12.0 + 1.0).abs() < 1e-12);
//! assert!(pump.torque_margin.is_some_and(|margin| margin > 1.0));
//! assert!(fan.speed_loss > 0.0 && state.load_limit.is_some());
//! # Ok::<(), beltdrive::SolveError>(())
//! ```

pub use crate::answers::{
    LoopBranch, LoopEnd, LoopLimit, LoopLimitCurve, LoopLimitPoint, LoopLimits, LoopPoint, Refusal,
    Refusals, Varied, limit_curve, limits, trace,
};
pub use crate::answers::{solve, solve_to, solve_with_margins};
pub use crate::results::loop_state::{
    FrictionParts, GrooveState, LoadLimit, LoopConvergence, LoopState, PulleyState, SpanState,
    TensionerState,
};
