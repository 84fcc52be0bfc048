//! From `bvp4c`, `solve_bvp`, COLNEW or TWPBVPC in five minutes.
//!
//! # The same problem three times
//!
//! Bratu's problem y″ + λ eʸ = 0, y(0) = y(1) = 0 for λ = 1, from a guess of zero, to the tolerance
//! 1e-6. In MATLAB:
//!
//! ```matlab
//! lambda = 1;
//! odefun = @(x, y) [y(2); -lambda*exp(y(1))];
//! bcfun = @(ya, yb) [ya(1); yb(1)];
//! guess = bvpinit(linspace(0, 1, 11), [0 0]);
//! sol = bvp5c(odefun, bcfun, guess, bvpset('RelTol', 1e-6, 'AbsTol', 1e-6));
//! [y, dy] = deval(sol, 0.5);
//! ```
//!
//! In Python:
//!
//! ```python
//! import numpy as np
//! from scipy.integrate import solve_bvp
//!
//! lam = 1.0
//! fun = lambda x, y: np.vstack((y[1], -lam * np.exp(y[0])))
//! bc = lambda ya, yb: np.array([ya[0], yb[0]])
//! x = np.linspace(0, 1, 11)
//! sol = solve_bvp(fun, bc, x, np.zeros((2, x.size)), tol=1e-6)
//! y, dy = sol.sol(0.5), sol.sol(0.5, 1)
//! ```
//!
//! Here:
//!
//! ```
//! use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};
//!
//! struct Bratu {
//!     lambda: f64,
//! }
//!
//! impl Problem for Bratu {
//!     fn segments(&self) -> Vec<Segment> {
//!         vec![Segment::on(2, 0.0, 1.0)] // two states on 0 ≤ s ≤ 1
//!     }
//!
//!     fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
//!         dy[0] = y[1];
//!         dy[1] = -y[0].exp() * self.lambda;
//!     }
//!
//!     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//!         r[0] = at.start(0)[0];
//!         r[1] = at.end(0)[0];
//!     }
//! }
//!
//! let bratu = Bratu { lambda: 1.0 };
//! let guess = Constant { states: vec![vec![0.0, 0.0]], parameters: vec![] };
//! let solution = solve(&bratu, &guess, &Options::to(1e-6))?;
//!
//! let (mut y, mut dy) = ([0.0; 2], [0.0; 2]);
//! solution.state(0, 0.5, &mut y);
//! solution.derivative(0, 0.5, &mut dy);
//! println!("y(½) = {:.6}, y″(½) = {:.6}", y[0], dy[1]);
//! assert!((y[0] - 0.140_539_214).abs() < 1e-6);
//!
//! // The same problem has a second solution, which a higher guess leads to.
//! let guess = Constant { states: vec![vec![3.0, 0.0]], parameters: vec![] };
//! let hot = solve(&bratu, &guess, &Options::to(1e-6))?;
//! assert!((solution.start(0)[1] - 0.549_352_729).abs() < 1e-5);
//! assert!((hot.start(0)[1] - 10.846_899_019).abs() < 1e-4);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! What is unfamiliar:
//!
//! * Equations of higher order are written as systems of the first, as in MATLAB and Python and unlike
//!   COLNEW.
//! * The right-hand side is generic in its scalar [`Real`]; that is what makes the Jacobians exact.
//!   Numbers of type `f64` stand on the right, `y[0] * 2.0 - 1.0`, and on the left, `2.0 * y[0]`, where a
//!   function says `where f64: `[`LeftOf`](crate::LeftOf)`<T>`. A constant of type `T` is `T::from(2.0)`;
//!   powers are `powi`, `powf` and, with an unknown exponent, `pow`; any other function enters by
//!   [`Real::apply`].
//! * A condition at an interior point needs no segment of its own, but a [joined
//!   point](crate::Segment::joined).
//! * Given constants are fields of the struct; unknown ones are [`Problem::parameters`].
//! * Every entry of `dy` and `r` must be written, zeros too: one that is not is reported.
//! * Indices start at zero, those of segments too.
//! * A right-hand side that exists only for `f64` goes into
//!   [`FiniteDifferences`](crate::FiniteDifferences), one with Jacobians of its own is an
//!   [`Equations`](crate::Equations).
//! * There is no solution with a warning: what is not within the tolerance is an
//!   [`Error`](crate::Error), with its best iterate inside ([`failures`](super::failures)).
//!
//! # Concepts
//!
//! | | `bvp4c`, `bvp5c` | `solve_bvp` | COLNEW | TWPBVPC | here |
//! | --- | --- | --- | --- | --- | --- |
//! | equations | `odefun(x, y, p)` | `fun(x, y, p)`, all x at once | `fsub`, orders 1 to 4 | `fsub` | [`Problem::rhs`], one point at a time |
//! | conditions | `bcfun(ya, yb, p)` | `bc(ya, yb, p)` | `gsub(i, z, g)`, each at its own place `zeta(i)` | `gsub`, the first `nlbc` at the left end | [`Problem::conditions`], any functions of all [`Ends`](crate::Ends) |
//! | unknown parameters | `p` | `p` | states with derivative zero | states with derivative zero | [`Problem::parameters`] |
//! | conditions inside | region index | – | places `zeta(i)` inside | – | [joined points](crate::Segment::joined); or [`Segment`](crate::Segment)s, each with its own states |
//! | given nodes | – | – | `fixpnt` | `fixpnt` | [joined points](crate::Segment::joined) |
//! | guess | `bvpinit` | `x`, `y`, `p` | `guess` | `givmsh`, `giveu` | [`Constant`](crate::Constant), [`Function`](crate::Function), [`Table`](crate::Table) |
//! | a solution as guess | `bvpinit`, `bvpxtend` | `sol.x`, `sol.y` | `ipar(9)` = 2, 3, 4 | `givmsh`, `giveu` | the [`Solution`] itself, mesh included |
//! | Jacobians | `FJacobian`, `BCJacobian`, or differences | `fun_jac`, `bc_jac`, or differences | `dfsub`, `dgsub` | `dfsub`, `dgsub` | exact by themselves |
//! | S y/(x − a) | `SingularTerm` | `S` | as it stands | – | as it stands ([`forms`](super::forms)) |
//! | complex states | – | complex `y` | – | – | [`Complex`](crate::Complex) |
//! | tolerance | `RelTol`, `AbsTol` | `tol`, `bc_tol` | `tol` of component `ltol` | `tol` of component `ltol` | [`Options::tolerance`], [`Options::absolute`] |
//! | … is one for | the residual; `bvp5c`: the error | the residual | the error | the error | the error |
//! | largest mesh | `NMax` | `max_nodes` | sizes of `ispace`, `fspace` | sizes of the work arrays | [`Options::max_intervals`] |
//! | method | Lobatto IIIA, order 4; 5 | Lobatto IIIA, order 4 | Gauss, `ipar(2)` points | deferred correction, orders 4, 6, 8 | Gauss, 6 or 7 points; others by [`Options::scheme`] |
//! | value at x | `deval(sol, x)` | `sol.sol(x)` | `appsln` | at the mesh only | [`Solution::state`], [`Solution::derivative`] |
//! | success | a warning or an error if not | `sol.status` | `iflag` | `iflbvp` | `Result` |
//! | conditioning | – | – | – | `ckappa1`, `gamma1`, … | [`conditioning`](crate::Solution::conditioning) |
//! | from easy to hard | a loop | a loop | a loop | a loop | [`solve_embedded`](crate::solve_embedded), [`families`](super::families) |
//!
//! `bvp4c` and `solve_bvp` keep the residual of the differential equations, here called the defect, within
//! the tolerance; the error of the solution may be larger or smaller. [`solve`](crate::solve) keeps the
//! estimated error of the solution within the tolerance, as COLNEW does. The same number thus means
//! something else; [`accuracy`](super::accuracy) says what.
//!
//! # Reading a solution
//!
//! | question | [`Solution`] |
//! | --- | --- |
//! | states anywhere | [`state`](Solution::state)`(segment, s, &mut y)` |
//! | their derivatives | [`derivative`](Solution::derivative)`(segment, s, &mut dy)` |
//! | states at both ends | [`start`](Solution::start)`(segment)`, [`end`](Solution::end)`(segment)` |
//! | unknown parameters | [`parameters`](Solution::parameters)`()` |
//! | mesh, states at its nodes | [`mesh`](Solution::mesh)`(segment)`, [`node`](Solution::node)`(segment, i)` |
//! | estimated error: largest | [`error_estimate`](Solution::error_estimate)`()` |
//! | … of every state, of every parameter | [`state_errors`](Solution::state_errors)`(segment)`, [`parameter_errors`](Solution::parameter_errors)`()` |
//! | defect: largest, of every interval | [`defect`](Solution::defect)`()`, [`defects`](Solution::defects)`(segment)` |
//! | largest residual of the conditions | [`condition_residual`](Solution::condition_residual)`()` |
//! | cost | [`stats`](Solution::stats)`()` |
//! | all of this in six lines | `report()`, for printing |
//!
//! Errors are relative to 1 + |value|, as in COLNEW; [`Options::absolute`] has other numbers for the 1, which
//! makes an absolute tolerance of its product with the tolerance. The report of the
//! first solution above:
//!
//! ```text
//! Gauss, 7 stages: 3 intervals in 1 segment, meshes tried: 1
//! error       1.8e-10, estimated, relative: component 1 of segment 0
//! defect      6.6e-10, relative: segment 0, s = 0.666667 to 1.0
//! conditions  0.0e0, the largest residual: condition 1
//! cost        222 right-hand sides, 42 Jacobians,
//!             2 factorisations, 5 Newton steps, 1.4e-4 s
//! ```
//!
//! A table of the solution at equal distances, with the estimated error of every column:
//!
//! ```
//! # use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};
//! # struct Decay;
//! # impl Problem for Decay {
//! #     fn segments(&self) -> Vec<Segment> {
//! #         vec![Segment::on(2, 0.0, 1.0)]
//! #     }
//! #     fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
//! #         dy[0] = y[1];
//! #         dy[1] = y[0] * 100.0;
//! #     }
//! #     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//! #         r[0] = at.start(0)[0] - 1.0;
//! #         r[1] = at.end(0)[0];
//! #     }
//! # }
//! # let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![] };
//! // y″ = 100 y, y(0) = 1, y(1) = 0
//! let solution = solve(&Decay, &guess, &Options::to(1e-8))?;
//! let mut y = [0.0; 2];
//! for i in 0..=10 {
//!     let s = 0.1 * f64::from(i);
//!     solution.state(0, s, &mut y);
//!     println!("{s:4.1} {:14.10} {:14.10}", y[0], y[1]);
//!     let exact = (10.0 * (1.0 - s)).sinh() / 10f64.sinh();
//!     assert!((y[0] - exact).abs() < 1e-8 * (1.0 + exact));
//! }
//! let errors = solution.state_errors(0).expect("estimated by default");
//! println!("relative to 1 + |y| at most {:.1e} {:.1e}", errors[0], errors[1]);
//! assert!(errors.iter().all(|&error| error <= 1e-8));
//! # Ok::<(), bvp::Error>(())
//! ```

#[cfg(doc)]
use crate::{Options, Problem, Real, Solution};
