//! What the tolerance means, how the error is estimated, and what it costs.
//!
//! # What success means
//!
//! [`solve`] returns `Ok` only if both of these are at most [`Options::tolerance`]:
//!
//! * the estimated global error of every state, anywhere on its segment, and of every parameter,
//!   relative to 1 + |value|;
//! * the residual of every condition, relative to the size of its terms where that exceeds one.
//!
//! [`Options::absolute`] puts the typical size of each state and parameter in the place of 1. The defect in
//! the differential equations is known, too ([`Solution::defects`]), but it is not tested.
//!
//! Before a solution that meets this is returned, it is examined once more:
//!
//! 1. **Newton's method has ended at it.** The equations are linearised at the solution itself, unless the
//!    last linearisation is that of the solution, as where the Jacobians at one place of every interval and those
//!    of the conditions have not changed since, and what Newton's method would still change must be at most 0.3
//!    tolerances. If it is more, the method goes on from there.
//! 2. **Rounding does not hide it.** The linearised equations are solved with random forcings of the size of
//!    the solution, which shows how much they amplify. If that amplification times the largest state is 1000
//!    or more, the rounding error is measured by a linear system whose solution is known; if it is too large,
//!    the error is [`IllConditioned`](Error::IllConditioned).
//! 3. **It is the only solution near it.** Where the amplification is 3.3 or more, the direction that is
//!    amplified may lead to other solutions: a periodic orbit without a condition on its phase can be shifted in time.
//!    Such a solution is one of a family, and refused as
//!    [`SingularConditions`](Error::SingularConditions), which names the direction.
//! 4. **The right-hand side has been seen between the points of the mesh**: next to every node on both
//!    sides, and at 64 or more further places of every segment, at least one in every interval. Where
//!    the defect there is much larger than the mesh has shown, or the right-hand side is not finite at any
//!    state within the tolerance, the intervals are cut and the solution is sought again. See
//!    [below](#what-may-be-missed).
//! 5. **No layer hides at an end of a segment.** Where the linearised equations allow one that is thinner than
//!    the interval there, a mesh that resolves it must give the same solution.
//! 6. **What grows from below the tolerance is resolved.** Where a state is smaller than the tolerance no mesh is
//!    too coarse for its defect. If forcings of the size of the tolerance grow there by 3.3 or more, the solution
//!    must be the same on halved intervals.
//!
//! With [`Control::Defect`] only the defect and the conditions are tested, and nothing is examined. What is found in 3, 5 and 6
//! holds for neighbours, too, so that it is left out with [`Options::from_neighbour`], and the last linearisation is taken for that at
//! the solution: for a path of problems, each solved from the solution of the one before.
//!
//! # What may be missed
//!
//! A right-hand side is known only where it is evaluated, and a peak of width w is seen only if one of the
//! places falls into it. If the peak is anywhere on a segment of length L with equal probability, then K
//! random places all miss it with the probability (1 − w/L)^K. The look before the solution is returned
//! takes 64 places on every segment or, if that is more, as many as there are intervals:
//!
//! | w/L | K = 64 | K = 256 | K = 1024 |
//! | --- | --- | --- | --- |
//! | 1e-1 | 0.1 % | 0.0 % | 0.0 % |
//! | 1e-2 | 53 % | 7.6 % | 0.0 % |
//! | 1e-3 | 94 % | 77 % | 36 % |
//!
//! The collocation points and the points of the error estimate, m + (m + 1) in an interval with m stages, are
//! places as well: on ten intervals with seven stages there are 150 of them. So a peak of a tenth of the
//! segment is found, and one of a thousandth is found by luck. If there may be narrow peaks, say where:
//! by a [`Table`](crate::Table) whose nodes are dense there as the guess, by
//! [joined points](crate::Segment::joined) around them, or by more
//! [`initial_intervals`](Options::initial_intervals) if nothing is known.
//!
//! A jump or a kink of f at an s that no joined point names has a side that is seen, however near to a
//! node it is. The mesh is refined around it until its part of the error is within the tolerance, and where
//! that would take intervals as short as the spacing of numbers the error is
//! [`Unresolved`](Error::Unresolved).
//!
//! # The error of what is computed from a solution
//!
//! The estimates are those of states and parameters. The error of anything else, such as an integral or a small
//! difference of large states, is seen by computing it from the [`corrected`](Solution::corrected) solution, too:
//!
//! ```
//! use bvp::{Constant, Options, Real, Solution, TwoPoint, solve};
//!
//! let bratu = TwoPoint::new(
//!     [2, 0],
//!     [0.0, 1.0],
//!     |_s, y, _p, dy| dy.copy_from_slice(&[y[1], -y[0].exp()]),
//!     |start, end, _p, r| r.copy_from_slice(&[start[0], end[0] - 1.0]),
//! );
//! let solution = solve(&bratu, &Constant::new([0.0, 0.0]), &Options::to(1e-3))?;
//!
//! // The energy ½ y'² + eʸ does not change.
//! let energy = |y: &[f64]| 0.5 * y[1] * y[1] + y[0].exp();
//! let change = |of: &Solution| energy(of.end(0)) - energy(of.start(0));
//! let estimated = change(&solution) - change(&solution.corrected(&bratu)?);
//! assert!((estimated / change(&solution) - 1.0).abs() < 0.1);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! # What can still go wrong
//!
//! * The solution need not be the only one, or the one that was wanted: only solutions near it are excluded.
//! * Near a limit point, where a change of the problem by far less than the tolerance makes a solution out of
//!   none, such a solution may be returned: p² + ε = 0 has one within √ε of zero. Likewise where a condition tends
//!   to zero at infinity and Newton's corrections become smaller than the tolerance on the way there.
//! * The estimate of the error is one of first order. On a mesh that is too coarse for it, it can be too
//!   small; how often is said below.
//! * The amplification is a lower bound, by one set of random signs. A direction that these signs do not
//!   excite is not seen.
//! * The estimate may be less than what rounding leaves anywhere, 1e-16 of a number.
//! * Rounding inside the right-hand side is not seen. Where f is a small difference of large numbers, the
//!   solution has no more digits than f.
//! * The estimate uses the Jacobians. Derivatives written by hand, if they are wrong, make it wrong, too
//!   ([`check_jacobians`](crate::check_jacobians)). A jump of f that a state decides on is in no Jacobian: the
//!   error grows there by the ratio of the slopes on both sides, which the estimate does not know.
//! * A layer inside a segment that no place falls into, and that neither the conditions nor the equations
//!   elsewhere feel, is a peak as above.
//! * Values far below 1 have an absolute error within the tolerance, and perhaps no correct digit, unless
//!   [`Options::absolute`] says how large they are. A state that passes through zero has no relative accuracy
//!   there in any case.
//! * The tolerance holds for states, not for what [`Solution::derivative`] returns ([`Control::Both`]).
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
//! * name the places where f is not smooth as joined points, so that the mesh need not be refined there
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
//! use bvp::{Constant, Options, Real, TwoPoint, solve};
//! use std::thread;
//!
//! let hottest = |lambda: f64| {
//!     let bratu = TwoPoint::new(
//!         [2, 0],
//!         [0.0, 1.0],
//!         |_s, y, _p, dy| dy.copy_from_slice(&[y[1], -lambda * y[0].exp()]),
//!         |start, end, _p, r| r.copy_from_slice(&[start[0], end[0]]),
//!     );
//!     let solution = solve(&bratu, &Constant::new([0.0, 0.0]), &Options::default())?;
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
