//! What the tolerance means, how the error is estimated, and what it costs.
//!
//! # What success means
//!
//! [`solve`] returns `Ok` only if both of these are at most [`Options::tolerance`]:
//!
//! * the estimated global error of every state, anywhere on its segment, and of every parameter,
//!   relative to 1 + |value|;
//! * the residual of every condition, relative to the size of its terms where that exceeds one;
//!
//! and if rounding does not hide the solution ([`Error::IllConditioned`]). The defect in the
//! differential equations is known too ([`Solution::defects`]), but it is not tested.
//!
//! What success does not mean:
//!
//! * that the solution is the only one, or the one that was wanted;
//! * that nothing was overlooked. Like every estimate, the estimate of the error uses the right-hand side
//!   at finitely many points: a peak of width 1e-4 in given data on an interval of length one was missed from 100 initial intervals and found from 300. Begin with more of them
//!   ([`Options::initial_intervals`]), with a [`Table`](crate::Table) whose nodes are dense there, or
//!   give the peak a short segment of its own;
//! * that small states have as many digits as large ones: the tolerance is relative to 1 + |y|, or to
//!   what stands in the place of 1 in [`Options::absolute`].
//!
//! # How the error is estimated
//!
//! A solution S has a defect d = S′ − f(s, S, p), known wherever f is evaluated. Its error e, with which
//! S + e would be exact, satisfies e′ = f(s, S + e) − f(s, S) − d with the conditions of the problem. To
//! first order this is a linear problem with the matrix of Newton's last step. It is solved by collocation
//! on the same mesh, which costs one evaluation of f at m + 1 points of every interval and no
//! factorisation. For every state, the largest error over the nodes, some points in between and the zeros
//! of the state is multiplied by 1.5 and reported.
//!
//! ```
//! # use bvp::{Constant, Ends, Problem, Real, Segment};
//! use bvp::{Control, Options, solve};
//! # struct Runge;
//! # impl Problem for Runge {
//! #     fn segments(&self) -> Vec<Segment> {
//! #         vec![Segment::on(2, -1.0, 1.0)]
//! #     }
//! #     fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
//! #         // The second derivative of 1/(1 + 25 s²).
//! #         let u = s * s * 25.0 + 1.0;
//! #         dy[0] = y[1];
//! #         dy[1] = (s * s * 75.0 - 1.0) * 50.0 * u.powi(-2) * y[0];
//! #     }
//! #     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//! #         r[0] = at.start(0)[0] - 1.0 / 26.0;
//! #         r[1] = at.end(0)[0] - 1.0 / 26.0;
//! #     }
//! # }
//! # let problem = Runge;
//! # let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![] };
//! // A problem with the solution 1/(1 + 25 s²) on −1 ≤ s ≤ 1.
//! for tolerance in [1e-3, 1e-6, 1e-9] {
//!     let solution = solve(&problem, &guess, &Options::to(tolerance))?;
//!     let (mut y, mut error) = ([0.0; 2], 0.0f64);
//!     for i in -100..=100 {
//!         let s = 0.01 * f64::from(i);
//!         let exact = 1.0 / (1.0 + 25.0 * s * s);
//!         solution.state(0, s, &mut y);
//!         error = error.max((y[0] - exact).abs() / (1.0 + exact));
//!     }
//!     let estimate = solution.state_errors(0).expect("the default")[0];
//!     println!("{tolerance:.0e}: error {error:.1e}, estimated {estimate:.1e}");
//!     assert!(error <= tolerance && estimate <= tolerance);
//! }
//!
//! // Without an estimate the mesh is chosen for the defect.
//! let options = Options { control: Control::Defect, ..Options::to(1e-6) };
//! let solution = solve(&problem, &guess, &options)?;
//! assert!(solution.defect() <= 1e-6 && solution.error_estimate().is_none());
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! With [`Control::Defect`] nothing is estimated; the tolerance holds for the defect relative to 1 + |f|,
//! as in `bvp4c`. This is meant for solutions on the way to another one. With [`Control::Both`] the
//! tolerance holds for both the error and the defect, for problems where slopes matter, or where integrals
//! of right-hand sides must balance.
//!
//! `tests/RESULTS.md` tabulates how true the estimates are on problems with known solutions. Over
//! 12 000 random problems with manufactured solutions the error of some state exceeds ten times its
//! estimate in 18 cases, and no error exceeds ten tolerances.
//!
//! # The order
//!
//! The Gauss scheme with m stages has order 2m at the nodes and m + 1 in between. On the reference
//! problems high orders took the least time, so [`Scheme::for_tolerance`] chooses six stages down to 3e-5
//! and seven below. [`Options::scheme`] serves other purposes than speed: set [`Scheme::LobattoIIIA`] for a
//! solution with a continuous derivative or a comparison with `bvp4c`, and any other number of stages for
//! a second opinion.
//!
//! # What it costs
//!
//! The cost of a Newton step is proportional to the number of intervals, and to the third power of the
//! number of states of a segment where that is large. [`Solution::stats`] counts what has been done.
//! To save:
//!
//! * start from a [`Solution`] of a neighbouring problem, which brings its mesh;
//! * ask for no more accuracy than needed;
//! * solve independent parts separately: the segments of one problem are solved together, with all of
//!   their states at both ends in one small dense system;
//! * put a junction where f is not smooth, so that the mesh need not be refined there
//!   ([`forms`](super::forms)).
//!
//! Times on the reference problems and where they go are in `benches/RESULTS.md`.
//!
//! # Many problems at once
//!
//! [`solve`] has no state of its own: any number of threads may call it, also for one and the same
//! problem.
//!
//! ```
//! # use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};
//! # struct Bratu {
//! #     lambda: f64,
//! # }
//! # impl Problem for Bratu {
//! #     fn segments(&self) -> Vec<Segment> {
//! #         vec![Segment::new(2)]
//! #     }
//! #     fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
//! #         dy[0] = y[1];
//! #         dy[1] = -y[0].exp() * self.lambda;
//! #     }
//! #     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//! #         r[0] = at.start(0)[0];
//! #         r[1] = at.end(0)[0];
//! #     }
//! # }
//! use std::thread;
//!
//! let hottest = |lambda: f64| {
//!     let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![] };
//!     let solution = solve(&Bratu { lambda }, &guess, &Options::default())?;
//!     let mut y = [0.0; 2];
//!     solution.state(0, 0.5, &mut y);
//!     Ok::<f64, bvp::Error>(y[0])
//! };
//! let lambdas: Vec<f64> = (1..=32).map(|i| 0.1 * f64::from(i)).collect();
//! let threads = thread::available_parallelism().map_or(1, usize::from);
//! let share = lambdas.len().div_ceil(threads);
//! let found = thread::scope(|scope| {
//!     let parts = lambdas.chunks(share);
//!     let running: Vec<_> = parts
//!         .map(|part| scope.spawn(move || part.iter().map(|&l| hottest(l)).collect::<Vec<_>>()))
//!         .collect();
//!     let finished = running.into_iter().map(|thread| thread.join().expect("no panic"));
//!     finished.flatten().collect::<Result<Vec<f64>, _>>()
//! })?;
//! assert_eq!(found.len(), lambdas.len());
//! assert!(found.windows(2).all(|pair| pair[0] < pair[1]));
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! One large problem can use several threads with the feature `parallel`, which shares its intervals among
//! them:
//!
//! ```text
//! bvp = { version = "0.1", features = ["parallel"] }
//! ```
//!
//! With many problems it is better to give each thread its own problems.

#[cfg(doc)]
use crate::{Control, Error, Options, Scheme, Solution, solve};
