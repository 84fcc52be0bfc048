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
//! Conditions may be nonlinear and may couple everything with everything. This one form holds
//!
//! * two-point problems: one segment;
//! * [eigenvalues](guide::eigenvalues) and unknown loads: parameters, each with one more condition;
//! * periodic orbits: y(a) = y(b), the period a parameter, and a phase condition;
//! * multipoint problems: conditions at [joined points](Segment::joined) inside a segment;
//! * [interface](guide::forms#interfaces) problems: several segments, coupled by conditions;
//! * [free ends](guide::free_boundaries) and lengths: s in \[0, 1\], the length a parameter that
//!   multiplies f;
//! * [integrals](guide::forms#integrals): a state each, y' = integrand, with a parameter for an unknown
//!   value;
//! * [complex states](guide::forms#complex-states): two real ones each, by [`Complex`];
//! * kinks and jumps of f at known places: joined points, or junctions of segments;
//! * [singular ends](guide::forms#singular-ends), as of cylindrical and spherical coordinates, and
//!   [infinite intervals](guide::forms#infinite-intervals).
//!
//! The [`guide`] shows all of it by example, begins with [what users of `bvp4c`, `solve_bvp`, COLNEW and
//! TWPBVPC know](guide::other_solvers), and says [what to do when a problem does not
//! solve](guide::failures).
//!
//! # Example
//!
//! Bratu's problem y'' + eʸ = 0 with y(0) = y(1) = 0, as two equations of first order for the states
//! (y, y'), stated by closures:
//!
//! ```
//! use bvp::{Constant, Options, Real, TwoPoint, solve};
//!
//! let bratu = TwoPoint::new(
//!     [2, 0], // two states, no unknown parameters
//!     [0.0, 1.0],
//!     |_s, y, _p, dy| dy.copy_from_slice(&[y[1], -y[0].exp()]),
//!     |start, end, _p, r| r.copy_from_slice(&[start[0], end[0]]),
//! );
//! let solution = solve(&bratu, &Constant::new([0.0, 0.0]), &Options::default())?;
//! println!("y'(0) = {:.6}", solution.start(0)[1]);
//! # assert_eq!(format!("{:.6}", solution.start(0)[1]), "0.549353");
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! In general a problem is a type with a right-hand side that is generic in its scalar [`Real`]. The fourth eigenvalue of Mathieu's equation y'' + (λ − 2q cos 2s) y = 0 for q = 5, even and of
//! period π, the amplitude fixed by y(0) = 1: two states, one parameter, three conditions.
//!
//! ```
//! use bvp::{Ends, Function, LeftOf, Options, Problem, Real, Segment, solve};
//! use std::f64::consts::PI;
//!
//! struct Mathieu;
//!
//! impl Problem for Mathieu {
//!     fn segments(&self) -> Vec<Segment> {
//!         vec![Segment::on(2, 0.0, PI)]
//!     }
//!
//!     fn parameters(&self) -> usize {
//!         1
//!     }
//!
//!     fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], p: &[T], dy: &mut [T])
//!     where
//!         f64: LeftOf<T>, // for numbers on the left of a T
//!     {
//!         dy[0] = y[1];
//!         dy[1] = -(p[0] - 10.0 * (2.0 * s).cos()) * y[0];
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
//!     state: |_segment: usize, s: f64| [(4.0 * s).cos(), -4.0 * (4.0 * s).sin()],
//!     parameters: vec![15.0],
//! };
//! let solution = solve(&Mathieu, &guess, &Options::to(1e-9))?;
//!
//! let mut y = [0.0; 2];
//! solution.state(0, PI / 2.0, &mut y);
//! println!("y(π/2) = {:.9}", y[0]);
//! assert!((solution.parameters()[0] - 17.096_581_684_366).abs() < 1e-8);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! Either way the solver has exact Jacobians without being given any.
//!
//! Where a parameter is left free, the solutions form a curve. [`Family`] is the discretised problem as
//! the curve sees it, for a continuation method; [`guide::families`] has an example.
//!
//! # The method
//!
//! **Discretisation.** Collocation with a [`Scheme`] of m stages: on every interval of a mesh the
//! solution is a polynomial of degree m that satisfies the differential equations at m points, and
//! the polynomials join continuously.
//!
//! | scheme | stages m | order at the nodes | order in between |
//! | --- | --- | --- | --- |
//! | Gauss; default m = 6 or 7, [by the tolerance](Scheme::for_tolerance) | 1 … 7 | 2m | m + 1 |
//! | Lobatto IIIA | 3, 4 | 2m − 2 | m + 1 |
//!
//! **Newton's method** with affine-invariant damping: a step is judged by corrections, not by
//! residuals, so the scaling of equations and conditions does not matter; Jacobians are kept while
//! corrections contract fast. Where it fails, the slopes of the guess are integrated, the mesh is
//! halved, and at last a homotopy from a straight line is followed, also where no mesh resolves the
//! solution ([`Options::retries`]).
//! [`solve_embedded`] is for problems that have an easy case of their own.
//!
//! **Linear algebra.** The stages of every interval are condensed, the interior nodes eliminated by
//! Householder reflections, and a small dense system is left for all ends and parameters. The cost
//! is proportional to the number of intervals. Orthogonal elimination is stable for growing and
//! decaying modes with coupled ends, where row pivoting is not.
//!
//! **Error estimate.** The defect S' − f(s, S, p) of the polynomials S of the solution drives the linearised
//! equation of its error, which is solved on the same mesh with the factors of the last Newton step:
//! defect correction, see [`guide::accuracy`].
//!
//! **Mesh selection.** From one mesh to the next, nodes are added, moved and removed. With S the
//! polynomials of the solution, the local defects h |S' − f(s, S, p)| / (1 + |y|) of intervals of
//! length h are equidistributed over as many intervals as the estimated error asks. Where a mesh does
//! not resolve the solution yet, its largest relative defect |S' − f| / (1 + |f|) above one half, that
//! takes the place of the error. With [`Control::Defect`] nothing is estimated and the mesh is chosen
//! for the relative defect, with [`Control::Both`] for both.
//!
//! **Derivative states.** A state whose derivative is another state, or a power of two times it (that state in other
//! units), as in an equation of second order, is eliminated from the stage systems in advance, so that writing such an equation as a
//! first-order system costs nothing.
//!
//! # What success means
//!
//! [`solve`] returns `Ok` only if these are at most [`Options::tolerance`]:
//!
//! * the estimated global error of every state and parameter relative to 1 + |value|, or, with
//!   [`Control::Defect`], the defect of every interval relative to 1 + |f|, root mean square over the
//!   interval; with other sizes than 1 by [`Options::absolute`];
//! * the residual of every condition, relative to the size of its terms where that exceeds one;
//!
//! and, where the error is estimated, if the solution withstands an examination: Newton's method has ended at
//! it, rounding does not hide it, it is the only solution near it, the right-hand side between the points of
//! the mesh is what they show, and no layer that the mesh cannot show stands at an end of a segment. Everything else is an [`Error`]: mistakes of the
//! statement are found before any arithmetic, and numerical failures carry their best iterate, which is
//! a [`Guess`] for another attempt. What it does not mean is said in [`guide::accuracy`].
//!
//! # Features
//!
//! `serde` writes and reads a [`Solution`], which then is a guess as before, and [`Options`], whose missing
//! fields have their defaults. The format must keep every digit, as `serde_json` does with its feature
//! `float_roundtrip`.
//!
//! `parallel` shares the intervals of large problems among the threads of
//! [rayon](https://docs.rs/rayon)'s pool: right-hand sides, Jacobians, the condensation of the stages, not
//! the elimination of the nodes. A solution is the same to the last bit. Without it a call uses one thread;
//! either way, any number of threads may call.
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

mod accuracy;
mod discretisation;
mod family;
pub mod guide;
mod kernels;
mod newton;
mod newton_matrix;
mod problem;
mod result;
mod shares;
mod solver;

pub use discretisation::scheme::Scheme;
pub use family::family::Family;
pub use problem::check::{JacobianCheck, check_jacobians};
pub use problem::complex::Complex;
pub use problem::difference::FiniteDifferences;
pub use problem::dual::Dual;
pub use problem::equations::{Equations, Shape};
pub use problem::guess::{Constant, Function, Guess, Table};
pub use problem::problem::{Ends, Problem, Segment};
pub use problem::real::{LeftOf, Real};
pub use problem::two_point::TwoPoint;
pub use problem::unknown::Unknown;
pub use result::error::Error;
pub use result::solution::Solution;
pub use result::stats::Stats;
pub use solver::conditioning::Conditioning;
pub use solver::embedding::{Embedding, solve_embedded};
pub use solver::options::{Control, Options};
pub use solver::solver::solve;

/// The examples of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
