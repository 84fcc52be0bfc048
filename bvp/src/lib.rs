//! Adaptive collocation for boundary value problems of ordinary differential equations.
//!
//! # The problem
//!
//! Find functions yᵢ on one or several smooth *segments* and constants p with
//!
//! ```text
//! dyᵢ/ds = fᵢ(s, yᵢ, p),    aᵢ ≤ s ≤ bᵢ,    i = 1 … number of segments
//! g( y₁(a₁), y₁(b₁), y₂(a₂), y₂(b₂), …, p ) = 0
//! ```
//!
//! Segment i has nᵢ states and there are k parameters. A solution of the differential equations is
//! fixed by nᵢ constants per segment, so with the parameters
//!
//! ```text
//! unknown constants  Σ nᵢ + k  =  number of conditions g
//! ```
//!
//! and [`solve`] refuses any other count; with fewer conditions the solutions form a [`Family`].
//! Conditions may be nonlinear and may couple everything
//! with everything. This one form holds
//!
//! * two-point problems: one segment;
//! * eigenvalues and unknown loads: parameters, each with one more condition;
//! * periodic orbits: y(a) = y(b), the period a parameter, and a phase condition;
//! * multipoint and interface problems: several segments, joined by conditions;
//! * free ends and lengths: s in \[0, 1\], the length a parameter that multiplies f;
//! * integrals: a state each, y' = integrand, with a parameter for an unknown value;
//! * complex states: two real ones each, by [`Complex`];
//! * kinks and jumps of f at known places: junctions of segments.
//!
//! # Singular ends and infinite intervals
//!
//! With the default scheme f is never evaluated at the ends of a segment, so a term S y/(s − a), as of
//! cylindrical and spherical coordinates, is written as it stands. What keeps the solution finite,
//! S y(a) = 0, is among the conditions. Where the solution is smooth the order in between is kept and
//! the mesh is not refined towards a. A solution with a fractional power of s − a is not smooth:
//! substitute s − a = tᵏ. Lobatto schemes ask for f at a; there write its limit, (I − S)⁻¹ times the
//! rest of f.
//!
//! An infinite interval is cut off, with conditions that forbid the growing solutions of the equations
//! linearised about the state at infinity, and lengthened until that changes nothing. Or it is mapped,
//! x = L s/(1 − s), with f multiplied by dx/ds: shorter to write, but the factor magnifies the rounding
//! of states that decay, so that the mesh is to be chosen for the error ([`Options::to`]), and states
//! must be bounded.
//!
//! # Example
//!
//! The fourth eigenvalue of Mathieu's equation y'' + (λ − 2q cos 2s) y = 0 for q = 5, even and of
//! period π, the amplitude fixed by y(0) = 1: two states, one parameter, three conditions.
//!
//! ```
//! use bvp::{Ends, Function, Options, Problem, Real, Segment, solve};
//! use std::f64::consts::PI;
//!
//! struct Mathieu;
//!
//! impl Problem for Mathieu {
//!     fn segments(&self) -> &[Segment] {
//!         &[Segment { states: 2, from: 0.0, to: PI }]
//!     }
//!
//!     fn parameters(&self) -> usize {
//!         1
//!     }
//!
//!     fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
//!         dy[0] = y[1];
//!         dy[1] = -(p[0] - (s * 2.0).cos() * 10.0) * y[0];
//!     }
//!
//!     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//!         r[0] = at.start(0)[1];
//!         r[1] = at.end(0)[1];
//!         r[2] = at.start(0)[0] - 1.0;
//!     }
//! }
//!
//! let guess = Function {
//!     state: |_segment: usize, s: f64, y: &mut [f64]| {
//!         y[0] = (4.0 * s).cos();
//!         y[1] = -4.0 * (4.0 * s).sin();
//!     },
//!     parameters: vec![15.0],
//! };
//! let options = Options { tolerance: 1e-9, ..Options::default() };
//! let solution = solve(&Mathieu, &guess, &options)?;
//!
//! let mut y = [0.0; 2];
//! solution.state(0, PI / 2.0, &mut y);
//! println!("y(π/2) = {:.9}", y[0]);
//! assert!((solution.parameters()[0] - 17.096_581_684_366).abs() < 1e-8);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! The right-hand side is generic in its scalar [`Real`], so the solver has exact Jacobians
//! without being given any.
//!
//! # Families of solutions
//!
//! Where a parameter is left free, the solutions form a curve. [`Family`] is the discretised problem
//! as the curve sees it, n equations for n + 1 unknowns, on a mesh that follows the solution: what a
//! continuation method needs. Bratu's problem u'' + λ eᵘ = 0, u(0) = u(1) = 0, which has two
//! solutions up to λ = 3.5138… and none beyond:
//!
//! ```
//! use bvp::{Constant, Ends, Family, Options, Problem, Real, Segment};
//!
//! struct Bratu;
//!
//! impl Problem for Bratu {
//!     fn segments(&self) -> &[Segment] {
//!         const { &[Segment::new(2)] }
//!     }
//!
//!     fn parameters(&self) -> usize {
//!         1
//!     }
//!
//!     fn condition_count(&self) -> usize {
//!         2
//!     }
//!
//!     fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T]) {
//!         dy[0] = y[1];
//!         dy[1] = -p[0] * y[0].exp();
//!     }
//!
//!     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//!         r[0] = at.start(0)[0];
//!         r[1] = at.end(0)[0];
//!     }
//! }
//!
//! let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![1.0] };
//! let (mut family, mut z) = Family::new(&Bratu, 0, &[], &guess, &Options::default())?;
//! let n = family.unknowns() - 1;
//! let (mut g, mut v, mut t) = (vec![0.0; n], vec![0.0; n + 1], vec![0.0; n + 1]);
//!
//! // Along the tangent to the solution with λ = 1.2, then corrections by Newton's method.
//! family.linearise(&z)?;
//! family.null_vector(&mut t);
//! let step = 0.2 / t[n];
//! z.iter_mut().zip(&t).for_each(|(z, t)| *z += step * t);
//! for _ in 0..3 {
//!     family.residual(&z, &mut g);
//!     family.linearise(&z)?;
//!     family.particular(&g, &mut v);
//!     z.iter_mut().zip(&v).for_each(|(z, v)| *z -= v);
//! }
//! assert!(family.solution(&z).defect() < 1e-6 && (z[n] - 1.2).abs() < 0.1);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! # The method
//!
//! **Discretisation.** Collocation with a [`Scheme`] of m stages: on every interval of a mesh the
//! solution is a polynomial of degree m that satisfies the differential equations at m points, and
//! the polynomials join continuously.
//!
//! | scheme | stages m | order at the nodes | order in between |
//! | --- | --- | --- | --- |
//! | Lobatto IIIA | 3, 4 | 2m − 2 | m + 1 |
//! | Gauss (default, m = 4) | 1 … 7 | 2m | m + 1 |
//!
//! **Newton's method** with affine-invariant damping: a step is judged by corrections, not by
//! residuals, so the scaling of equations and conditions does not matter; Jacobians are kept while
//! corrections contract fast.
//!
//! **Linear algebra.** The stages of every interval are condensed, the interior nodes eliminated by
//! Householder reflections, and a small dense system is left for all ends and parameters. The cost
//! is proportional to the number of intervals. Orthogonal elimination is stable for growing and
//! decaying modes with coupled ends, where row pivoting is not.
//!
//! **Mesh selection.** The defect S' − f(s, S, p) of the polynomials S, measured on every interval,
//! decides where nodes are added, moved and removed; the tolerance is one for the defect, or for the
//! error alone ([`Control`]). [`Options::to`] chooses the scheme and the mesh for the least time.
//!
//! # What success means
//!
//! [`solve`] returns `Ok` only if all of these are at most [`Options::tolerance`]:
//!
//! * the defect of every interval relative to 1 + |f|, root mean square over the interval
//!   ([`Control::Error`] omits it);
//! * the residual of every condition, relative to the size of its terms where that exceeds one;
//! * the estimated global error of every state and parameter relative to 1 + |value|, from one
//!   Newton correction on the mesh with every interval halved ([`GlobalError::Skip`] omits it).
//!
//! Everything else is an [`Error`]: mistakes of the statement are found before any arithmetic, and
//! numerical failures carry their best iterate, which is a [`Guess`] for another attempt.
//! Like every estimate, the one of the error sees the problem only at finitely many points; and a
//! solution found need not be the only one.
//!
//! # From `bvp4c` or `solve_bvp`
//!
//! | `bvp4c` | `solve_bvp` | here |
//! | --- | --- | --- |
//! | `odefun(x, y, p)` | `fun(x, y, p)`, vectorised | [`Problem::rhs`], one point at a time |
//! | `bcfun(ya, yb, p)` | `bc(ya, yb, p)` | [`Problem::conditions`] on [`Ends`] |
//! | `bvpinit` | `x`, `y`, `p` | [`Constant`], [`Function`], [`Table`], or a [`Solution`] |
//! | `FJacobian`, `BCJacobian` | `fun_jac`, `bc_jac` | exact; or [`Equations`] by hand, or [`FiniteDifferences`] |
//! | region index of multipoint problems | — | segment index |
//! | `RelTol`, `AbsTol` | `tol`, `bc_tol` | [`Options::tolerance`], of defect and global error |
//! | `NMax` | `max_nodes` | [`Options::max_intervals`] |
//! | Lobatto IIIA, order 4 | the same | [`Scheme::LobattoIIIA`] with 3 stages; default Gauss, order 8 |
//! | `deval(sol, x)` | `sol.sol(x)` | [`Solution::state`], [`Solution::derivative`] |
//! | `sol.stats` | `rms_residuals`, `niter` | [`Solution::defects`], [`Solution::stats`] |
//! | `SingularTerm` | `S` | S y/(s − a) as part of [`Problem::rhs`]; Gauss points avoid the ends |
//!
//! # References
//!
//! * U. M. Ascher, R. M. M. Mattheij & R. D. Russell, *Numerical Solution of Boundary Value
//!   Problems for Ordinary Differential Equations*, SIAM 1995: the theory, collocation, mesh
//!   selection.
//! * J. Kierzenka & L. F. Shampine, "A BVP solver based on residual control and the MATLAB PSE",
//!   ACM Trans. Math. Softw. 27 (2001) 299-316: control of the defect.
//! * P. Deuflhard, *Newton Methods for Nonlinear Problems*, Springer 2004: damping.
//! * S. J. Wright, "Stable parallel algorithms for two-point boundary value problems", SIAM J. Sci.
//!   Stat. Comput. 13 (1992) 742-764: orthogonal elimination.

mod almost_block_diagonal;
mod automatic;
mod chains;
mod check;
mod collocation;
mod complex;
mod condensation;
mod conditioning;
mod defect;
mod dense;
mod dependence;
mod difference;
mod dual;
mod embedding;
mod end_system;
mod equations;
mod error;
mod error_control;
mod failure;
mod family;
mod global_error;
mod guess;
mod held;
mod homotopy;
mod householder;
mod iterate;
mod large;
mod layers;
mod lq;
mod mesh;
mod newton;
mod options;
mod problem;
mod random;
mod real;
mod reflections;
mod report;
mod restriction;
mod rounding;
mod scheme;
mod solution;
mod solver;
mod specialise;
mod statement;
mod stats;
mod stepping;
mod straight;
mod unknown;

pub use check::{Differenced, JacobianCheck, Place, check_jacobians};
pub use complex::Complex;
pub use conditioning::{Conditioning, conditioning};
pub use difference::FiniteDifferences;
pub use dual::Dual;
pub use embedding::{Embedding, solve_embedded};
pub use equations::Equations;
pub use error::Error;
pub use family::Family;
pub use guess::{Constant, Function, Guess, Table};
pub use options::{GlobalError, Options};
pub use problem::{Ends, Problem, Segment};
pub use real::Real;
pub use report::Report;
pub use scheme::Scheme;
pub use solution::Solution;
pub use solver::solve;
pub use stats::Stats;
pub use unknown::Unknown;
