//! Pseudo-arclength continuation of nonlinear systems.
//!
//! # The problem
//!
//! All solutions of a nonlinear system with a parameter λ that are connected to a first one,
//!
//! ```text
//! G(x, λ) = 0,        n equations for n + 1 unknowns z = (x, λ).
//! ```
//!
//! Where the n × (n + 1) Jacobian J = \[Gₓ `G_λ`\] has rank n they form a smooth curve, a *branch*. It
//! may turn back in λ, cross other branches, or close; with a second parameter μ its special points
//! form curves themselves. States of equilibrium, discretised differential equations and boundary
//! value problems all have this form, and only a [`System`] knows how its equations are best solved.
//!
//! # Example
//!
//! The steady states of a stirred tank reactor (Uppal, Ray & Poore 1974): conversion x₁ and
//! temperature x₂ against the Damköhler number p₁, from the cold tank through ignition and
//! extinction.
//!
//! ```
//! use continuation::{Branch, DenseSystem, Direction, Kind, Options};
//!
//! let mut tank = DenseSystem::new(2, &[0.0, 18.0, 3.0], 0, |x, p, g| {
//!     let rate = p[0] * (1.0 - x[0]) * x[1].exp();
//!     g[0] = rate - x[0];
//!     g[1] = p[1] * rate - (1.0 + p[2]) * x[1];
//! });
//! let options = Options { targets: vec![0.1], ..Options::within(0.0, 0.3) };
//! let start = [0.0, 0.0, 0.0];
//! let mut branch = Branch::new(&mut tank, &start, Direction::Increasing, &options)?;
//!
//! let mut limits = Vec::new();
//! let mut states = 0;
//! while let Some(point) = branch.next() {
//!     match point.kind {
//!         Kind::LimitPoint => limits.push(point),
//!         Kind::Target => states += 1,
//!         _ => {}
//!     }
//! }
//! println!("{}", branch.stop().expect("the branch has ended"));
//!
//! // Ignition at x₂ = 3/2 and extinction at x₂ = 3; three states at p₁ = 0.1 in between.
//! assert_eq!((limits.len(), states), (2, 3));
//! assert!((limits[0].lambda() - 0.5 * (-1.5f64).exp()).abs() < 1e-12);
//! assert!((limits[1].x()[1] - 3.0).abs() < 1e-10);
//! # Ok::<(), continuation::Error>(())
//! ```
//!
//! # The method
//!
//! 1. **The system** supplies, for J at any z, one particular solution v of J v = r and the null vector
//!    t, J t = 0; all solutions are v + α t. Neither bordered matrices nor a regular Gₓ are needed.
//! 2. **The predictor** is the tangent t, of unit length, or the polynomial in the arclength through
//!    the last points and the tangent ([`Predictor`]).
//! 3. **The corrector** is Newton's method for G with one more condition: that the component along the
//!    tangent, or λ itself, stays as predicted ([`Parameterisation`]; Keller 1977). The linearisation
//!    is kept as long as corrections shrink fast, so that a step takes about one.
//! 4. **The step** grows and shrinks with the contraction of the corrector, the error of the
//!    prediction and the angles by which the tangent and, as far as [`Options::branch_points`] asks for
//!    it, a second null vector turn (Deuflhard 2011, chapter 5; Allgower & Georg 1990, chapter 6). It is
//!    repeated shorter where Newton's method fails, G is not finite or the tangent turns too much.
//! 5. **Special points** between two points are recognised by the sign of a function, and located on the
//!    branch down to rounding, or as far as [`Options::location`] asks for; branch points, where that does
//!    not determine them, by a regular extended system.
//! 6. **Branch switching** starts along the tangent of the other branch, known from the second
//!    derivatives at the branch point, and verifies that the first point lies there
//!    ([`Branch::switch`]).
//! 7. **Two parameters**: [`LimitPointCurve`] and [`BranchPointCurve`] are systems themselves, whose
//!    parameter is μ. Their derivatives come from second derivatives of G along directions and the
//!    linearisation of the system itself (compare Govaerts 2000, chapters 4 and 8).
//! 8. **Deflation** ([`deflate`]; Farrell, Birkisson & Funke 2015) finds solutions on branches that are
//!    connected to no known one, and a [`homotopy`] one solution at a wanted λ.
//!
//! The **arclength** is that of the norm Σ wᵢ zᵢ², by default with weights such that the range of λ
//! counts as one and every group of unknowns ([`System::groups`]) counts alike, relative to the
//! largest value met. Neither units nor the number of mesh points nor copies of equations change it,
//! nor the steps taken. [`Options::weights`] replace it.
//!
//! # What is found
//!
//! | [`Kind`] | where | how |
//! |---|---|---|
//! | [`Start`](Kind::Start) | the first point | Newton's method at its λ |
//! | [`Regular`](Kind::Regular) | every step | corrected to [`Options::accuracy`] |
//! | [`LimitPoint`](Kind::LimitPoint) | λ turns back | the λ component of t changes its sign, or does so twice by the cubic through both points |
//! | [`BranchPoint`](Kind::BranchPoint) | another branch crosses | det \[J; tᵀ\] changes its sign; both tangents; if [`Options::branch_points`] |
//! | [`Cusp`](Kind::Cusp) | limit points meet | on a [`LimitPointCurve`], where λ and μ both turn back |
//! | [`Event`](Kind::Event) | a function of yours is zero | it changes its sign ([`Branch::event`]) |
//! | [`Target`](Kind::Target) | λ has a wanted value | exactly, as often as it is passed |
//! | [`Bound`](Kind::Bound) | λ reaches a bound | exactly; G is never evaluated beyond |
//! | [`Closed`](Kind::Closed) | the first point again | met in the direction in which it was left |
//!
//! A branch ends with a [`Stop`] that says why. Extrema of any quantity are events of its derivative;
//! extrema of μ on a curve of limit points, where isolated branches are born or merge, are limit points
//! of that curve. Branch points at which the determinant does not change its sign (of even multiplicity)
//! and Hopf bifurcations are not detected.
//!
//! # Boundary value problems
//!
//! `bvp::Family` is a boundary value problem with one condition fewer than unknown constants,
//! discretised on a mesh that follows the solution. With the feature `bvp` it is a [`System`], and every
//! labelled point has an estimate of its discretisation error ([`Point::error`]).
//!
//! ```
//! use bvp::{Constant, Ends, Family, Problem, Real, Segment};
//! use continuation::{Branch, Direction, Kind, Options};
//!
//! /// u'' + λ eᵘ = 0, u(0) = u(1) = 0
//! struct Bratu;
//!
//! impl Problem for Bratu {
//!     fn segments(&self) -> Vec<Segment> {
//!         vec![Segment::on(2, 0.0, 1.0)]
//!     }
//!     fn parameters(&self) -> usize { 1 }
//!     fn condition_count(&self) -> usize { 2 }
//!     fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
//!         dy[0] = y[1];
//!         dy[1] = -p[0] * y[0].exp();
//!     }
//!     fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
//!         r[0] = at.start(0)[0];
//!         r[1] = at.end(0)[0];
//!     }
//! }
//!
//! let guess = Constant { states: vec![vec![0.0, 0.0]], parameters: vec![0.0] };
//! let (mut family, start) = Family::new(&Bratu, 0, &[], &guess, &bvp::Options::default())?;
//! let options = Options::within(0.0, 4.0);
//! let branch = Branch::new(&mut family, &start, Direction::Increasing, &options)?;
//! let mut limits = branch.filter(|point| point.kind == Kind::LimitPoint);
//! let limit = limits.next().expect("a limit point");
//! let error = limit.error.expect("an estimate");
//! assert!((limit.lambda() - 3.513_830_719_125).abs() < 1e-8 && error.lambda < 1e-8);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Further parameters are held by the family, and the first of these is the second parameter μ of
//! [`TwoParameter`]. A clone of [`Branch::system`] belongs to the point yielded last: keep it with a
//! branch point to switch there later.
//!
//! # From AUTO-07p, `BifurcationKit` and MATCONT
//!
//! | AUTO-07p | `BifurcationKit` | MATCONT | here |
//! |---|---|---|---|
//! | `NDIM`, `NBC`, `NINT` | the size of `u0` | the length of `x0` | [`System::unknowns`]; integral conditions are states |
//! | `NTST`, `NCOL`, `IAD` | `PeriodicOrbitOCollProblem(Ntst, m)` | `ntst`, `ncol` | the tolerance and the scheme of `bvp::Options` |
//! | `ICP` | `lens` | `ap` | the parameter of the system, and [`TwoParameter`] |
//! | `DS`, `DSMAX`, `DSMIN` | `ds`, `dsmax`, `dsmin` | `InitStepsize`, `MaxStepsize`, `MinStepsize` | [`Options::first_step`], [`largest_step`](Options::largest_step), [`smallest_step`](Options::smallest_step), in units of the range of λ; the sign of `DS` is the [`Direction`] |
//! | `NMX` | `max_steps` | `MaxNumPoints` | [`Options::steps`] |
//! | `RL0`, `RL1` | `p_min`, `p_max` | | [`Options::bounds`], never passed |
//! | `UZR` in λ | `SaveAtEvent` | `Userfunctions` | [`Options::targets`] |
//! | `UZR` in others, `PVLS` | `ContinuousEvent` | `Userfunctions` | [`Branch::event`] |
//! | `EPSL`, `EPSU`, `EPSS` | `tol` | `FunTolerance`, `VarTolerance` | [`Options::accuracy`]; special points always to rounding |
//! | `ITNW`, `NWTN` | `max_iterations` | `MaxNewtonIters` | [`Options::corrections`] |
//! | `THL`, `THU` | `θ` | | [`Options::weights`] |
//! | `ILP`, `ISP`, `SP` | `detect_bifurcation`, `detect_fold` | `Singularities` | always |
//! | `NPR` | `save_sol_every_step` | | the iterator yields every point; keep what is wanted |
//! | `ISW = −1` | `continuation(br, ind)` | `init_BP_EP` | [`Branch::switch`], one [`HalfBranch`] each |
//! | `ISW = 2` at LP | `continuation` of a fold | `init_LP_LP` | [`LimitPointCurve`] |
//! | `ISW = 2` at BP | `continuation` of a branch point | `init_BP_BP` | [`BranchPointCurve`] |
//! | `IRS` | | | [`Branch::resume`] |
//! | | `DefCont` | | [`deflate`] |
//!
//! # Literature
//!
//! * H. B. Keller, "Numerical solution of bifurcation and nonlinear eigenvalue problems", in
//!   P. H. Rabinowitz (ed.), *Applications of Bifurcation Theory*, Academic Press 1977, 359-384.
//! * E. J. Doedel, H. B. Keller & J. P. Kernévez, "Numerical analysis and control of bifurcation
//!   problems (I), (II)", Int. J. Bifurcation Chaos 1 (1991) 493-520, 745-772.
//! * E. L. Allgower & K. Georg, *Numerical Continuation Methods*, Springer 1990.
//! * W. J. F. Govaerts, *Numerical Methods for Bifurcations of Dynamical Equilibria*, SIAM 2000.
//! * P. Deuflhard, *Newton Methods for Nonlinear Problems*, Springer 2011, chapter 5.
//! * P. E. Farrell, Á. Birkisson & S. W. Funke, "Deflation techniques for finding distinct solutions of
//!   nonlinear partial differential equations", SIAM J. Sci. Comput. 37 (2015) A2026-A2045.

mod branch;
mod curve;
mod deflation;
mod difficulty;
mod error;
mod homotopy;
mod number;
mod options;
mod point;
mod special_points;
mod stop;
mod system;
mod two_parameters;

pub use branch::branch::{Branch, Direction};
pub use branch::switching::HalfBranch;
pub use curve::root::root;
pub use deflation::deflate;
pub use difficulty::{Cause, Difficulty};
pub use error::Error;
pub use homotopy::homotopy;
pub use options::{Options, Parameterisation, Predictor};
pub use point::{DiscretisationError, Kind, Point};
pub use stop::Stop;
pub use system::dense::DenseSystem;
#[cfg(feature = "bvp")]
pub use system::exact::Differentiable;
#[cfg(feature = "sparse")]
pub use system::sparse::SparseSystem;
pub use system::system::{System, TwoParameter};
pub use two_parameters::branch_point_curve::BranchPointCurve;
pub use two_parameters::limit_point_curve::LimitPointCurve;

/// The examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
