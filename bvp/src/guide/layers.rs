//! A thin layer: how the mesh adapts, and what to do if a direct solution fails.
//!
//! # The problem
//!
//! ```text
//! ε y″ = y (1 − y′),   y(0) = −7/6,   y(1) = 3/2
//! ```
//!
//! For small ε either y′ = 1 or y = 0: the solution follows the line y = s − 7/6 from the left and
//! y = s + 1/2 from the right, and jumps from one to the other where they are opposite, at s = 1/3. In
//! the jump, whose width is a few ε, ε y″ = −y y′ nearly: y = a tanh(a (s − 1/3)/(2ε)) with a = 5/6, so
//! that y′(1/3) = a²/(2ε) up to terms of order one. J. Kevorkian & J. D. Cole, *Perturbation Methods in
//! Applied Mathematics* (Springer 1981), chapter 2.
//!
//! # The mesh
//!
//! For ε = 1e-2 nothing needs to be known of the layer:
//!
//! ```
//! use bvp::{Constant, Ends, LeftOf, Options, Problem, Real, Segment, solve};
//!
//! struct Shock {
//!     epsilon: f64,
//! }
//!
//! impl Problem for Shock {
//!     fn segments(&self) -> Vec<Segment> {
//!         vec![Segment::new(2)]
//!     }
//!
//!     fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T])
//!     where
//!         f64: LeftOf<T>, // for 1.0 on the left of a T
//!     {
//!         dy[0] = y[1];
//!         dy[1] = y[0] * (1.0 - y[1]) / self.epsilon;
//!     }
//!
//!     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//!         r[0] = at.start(0)[0] + 7.0 / 6.0;
//!         r[1] = at.end(0)[0] - 1.5;
//!     }
//! }
//!
//! let epsilon = 1e-2;
//! let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![] };
//! let solution = solve(&Shock { epsilon }, &guess, &Options::default())?;
//!
//! let mut y = [0.0; 2];
//! solution.state(0, 1.0 / 3.0, &mut y);
//! assert!(y[0].abs() < 1e-6);
//! assert!((y[1] * epsilon - 25.0 / 72.0).abs() < 3.0 * epsilon);
//!
//! // The shortest interval lies in the layer, the longest outside of it.
//! let intervals = || solution.mesh(0).windows(2).map(|pair| (pair[1] - pair[0], pair[0]));
//! let shortest = intervals().min_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
//! let longest = intervals().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
//! println!("{} intervals, {:.4} to {:.4}", intervals().count(), shortest.0, longest.0);
//! assert!((shortest.1 - 1.0 / 3.0).abs() < 0.1 && (longest.1 - 1.0 / 3.0).abs() > 0.1);
//! assert!(shortest.0 < 0.2 * longest.0);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! The first mesh has equal intervals, few of them. From the solution on one mesh the next is chosen:
//!
//! 1. While the largest relative defect |S′ − f|/(1 + |f|) exceeds one half, the mesh does not resolve
//!    the solution S yet. Where the linearised equations allow a layer at an end of a segment, the next
//!    mesh is graded towards it; otherwise it equidistributes the relative defect, which draws nodes into
//!    a layer wherever it is.
//! 2. After that the error is estimated. The next mesh equidistributes the local defects
//!    h |S′ − f|/(1 + |y|), which are what an interval of length h adds to the error. Its number of
//!    intervals follows from the estimated error.
//! 3. Once the estimate is within the tolerance, the solution is examined
//!    ([`accuracy`](super::accuracy)) and returned.
//!
//! Nodes are removed as well as added.
//!
//! # Where the direct way fails
//!
//! Newton's method must start close to the layer, and closer if ε is smaller. For small enough ε it fails
//! even with everything that [`Options::retries`](crate::Options::retries) lists. Then make ε a parameter
//! without a condition of its own and let [`solve_embedded`](crate::solve_embedded) lead it from a value
//! for which the problem is easy to the value wanted. Each solution, with its mesh, is the guess for the
//! next.
//!
//! ```
//! use bvp::{Constant, Embedding, Ends, Error, LeftOf, Options, Problem, Real, Segment};
//! use bvp::{solve, solve_embedded};
//!
//! /// p = (ε): two states and one parameter, but two conditions.
//! struct Shock;
//!
//! impl Problem for Shock {
//!     fn segments(&self) -> Vec<Segment> {
//!         vec![Segment::new(2)]
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
//!     fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], p: &[T], dy: &mut [T])
//!     where
//!         f64: LeftOf<T>,
//!     {
//!         dy[0] = y[1];
//!         dy[1] = y[0] * (1.0 - y[1]) / p[0];
//!     }
//!
//!     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//!         r[0] = at.start(0)[0] + 7.0 / 6.0;
//!         r[1] = at.end(0)[0] - 1.5;
//!     }
//! }
//!
//! let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![1.0] };
//! let embedding = Embedding { parameter: 0, from: 1.0, to: 1e-5 };
//! let solution = solve_embedded(&Shock, &embedding, &guess, &Options::default())?;
//!
//! let mut y = [0.0; 2];
//! solution.state(0, 1.0 / 3.0, &mut y);
//! assert!((y[1] * 1e-5 - 25.0 / 72.0).abs() < 1e-4);
//! println!("{} meshes on the way", solution.stats().meshes);
//!
//! // Without a value for ε the solutions are a family, and `solve` says so.
//! assert!(matches!(
//!     solve(&Shock, &guess, &Options::default()),
//!     Err(Error::ConditionCount { conditions: 2, unknowns: 3, .. })
//! ));
//! # Ok::<(), Error>(())
//! ```
//!
//! The solutions on the way are rough; the last one meets all options. If the way ends early,
//! [`Error::Unreached`](crate::Error::Unreached) has the value that was reached and the solution there.
//! A Reynolds number, a load, or a nonlinearity that is switched on gradually is embedded in the same way
//! (`cargo run -p bvp --example reynolds`).
//!
//! # What helps with layers
//!
//! * A guess with the layer in about its right place, by [`Function`](crate::Function); or the
//!   [`Solution`](crate::Solution) for a larger ε, or a [`Table`](crate::Table) whose nodes are dense
//!   where the layer is expected.
//! * States of moderate size. If y′ is a state, its error counts relative to 1 + |y′|, and y′ is as large as
//!   1/ε. With ε y′ as the state less accuracy is needed.
//! * The place of some layers is ill-conditioned: that of ε y″ = −y y′ with y(0) = −1, y(1) = 1 moves
//!   more than the conditions do by a factor that grows exponentially with 1/ε. In double precision no
//!   finer mesh finds it, but half of the interval does, with y = 0 in the middle by symmetry.
//!   [`failures`](super::failures) tells how to recognise this.
