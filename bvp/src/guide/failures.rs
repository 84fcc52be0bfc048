//! What to do if there is no solution, or one that cannot be trusted.
//!
//! # Symptom, meaning, remedy
//!
//! [`Error`] says in one line what was wrong and where. Remedies in the order in which to try them:
//!
//! | symptom | it means | try |
//! | --- | --- | --- |
//! | [`ConditionCount`](Error::ConditionCount), and what else stands before the numerical failures | The statement is not consistent; nothing was computed | Count: Σ states + parameters = conditions. With fewer conditions give the parameter to [`solve_embedded`] or [`Family`](crate::Family) |
//! | [`NonFiniteRhs`](Error::NonFiniteRhs), [`NonFiniteCondition`](Error::NonFiniteCondition) | NaN or ∞ where the iterate is, or an entry that is never written | 1. Write every entry. 2. A guess inside the domain of logarithms, roots, quotients. 3. States that cannot leave it: ln y instead of y. 4. Data for all s: none may be missing between its ends |
//! | [`NoConvergence`](Error::NoConvergence) | The guess is too far away, there is no solution, a derivative is wrong, or f jumps where a state passes a value | 1. [Look at the best iterate](#look-at-the-best-iterate). 2. [Check the derivatives](#check-the-derivatives) if they are by hand. 3. [A better guess](#a-better-guess). 4. [`solve_embedded`]. 5. Ask whether there is [a fold](super::families). 6. A jump that depends on the solution: smooth it, or segments that meet there |
//! | [`SingularConditions`](Error::SingularConditions) | At the iterate, or at the solution found, the conditions do not determine the solution | 1. A family of solutions: a constant, a phase or an amplitude left free? The message names what is free, and says if it is a shift of s. 2. Two conditions that say the same? 3. A guess of zero, where a product vanishes. 4. A normalisation that the solution cannot meet ([`eigenvalues`](super::eigenvalues)). 5. A [fold](super::families) |
//! | [`SingularNode`](Error::SingularNode) | The stages on an interval are not determined; this is rare and depends on its length | Another [`Options::initial_intervals`] |
//! | [`Unreached`](Error::Unreached) | [`solve_embedded`] stopped on the way | 1. Is the value reached [a fold](super::families)? 2. Another parameter, another start |
//! | [`MeshLimit`](Error::MeshLimit) | More intervals needed than allowed | 1. Where are the nodes? Dense at a kink or jump: a [joined point](crate::Segment::joined). Dense everywhere: noise in the right-hand side, such as interpolated data or an inner iteration. 2. [`conditioning`](Solution::conditioning). 3. Larger [`Options::max_intervals`], from the best iterate. 4. Larger tolerance |
//! | [`Unresolved`](Error::Unresolved) | No mesh helps, or intervals shrank to the spacing of numbers | 1. A kink, jump or singularity at the place named: a [joined point](crate::Segment::joined), or a substitution ([`forms`](super::forms)). 2. A narrow layer inside: [`solve_embedded`] from a wider one. 3. [`conditioning`](Solution::conditioning) |
//! | [`ConditionViolated`](Error::ConditionViolated) | Newton's method has converged, yet a condition does not hold | Its derivative is wrong, or it is not smooth |
//! | [`IllConditioned`](Error::IllConditioned) | Rounding alone changes the solution by more than the tolerance | [Ill-conditioned problems](#ill-conditioned-problems) |
//! | A solution, but small states are inaccurate | They are far below one | [`Options::absolute`] |
//! | A solution, but the wrong one | There are several | Another guess; [`families`](super::families) finds how they are connected |
//! | A solution, but slowly | Poor guess, many intervals, many states | [`Stats`](crate::Stats): after many Newton steps a better guess, with many intervals a joined point; for the rest see [`accuracy`](super::accuracy) |
//!
//! Before it gives up, the solver tries damping, a step of Picard's iteration from the guess, finer meshes,
//! and a homotopy from a straight line ([`Options::retries`]). A second call with the same guess finds
//! nothing new.
//!
//! # Look at the best iterate
//!
//! Every numerical failure carries its last iterate, a [`Solution`] that can be plotted
//! and that is also a [`Guess`](crate::Guess). If it grows without bounds, there may be no solution. If it
//! has steps between neighbouring nodes, there is a layer. If it looks right, only the limits were too
//! tight:
//!
//! ```
//! # use bvp::{Constant, Ends, Problem, Real, Segment};
//! use bvp::{Error, Options, solve};
//! # struct Layer;
//! # impl Problem for Layer {
//! #     fn segments(&self) -> Vec<Segment> {
//! #         vec![Segment::on(2, -1.0, 1.0)]
//! #     }
//! #     fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
//! #         dy[0] = y[1];
//! #         dy[1] = -s * y[1] * 1e4;
//! #     }
//! #     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//! #         r[0] = at.start(0)[0] + 1.0;
//! #         r[1] = at.end(0)[0] - 1.0;
//! #     }
//! # }
//! # let problem = Layer;
//! # let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![] };
//! // ε y″ + s y′ = 0 on −1 ≤ s ≤ 1 with a layer at s = 0, ε = 1e-4
//! let few = Options { max_intervals: 50, ..Options::to(1e-11) };
//! let error = solve(&problem, &guess, &few).unwrap_err();
//! println!("{error}");
//! assert!(matches!(error, Error::MeshLimit { .. }));
//!
//! let best = error.best().expect("the iterate of a numerical failure");
//! let length = |pair: &[f64]| pair[1] - pair[0];
//! let pairs = best.mesh(0).windows(2);
//! let shortest = pairs.min_by(|a, b| length(a).total_cmp(&length(b))).expect("a mesh");
//! println!("the shortest interval: {shortest:?}");
//! assert!(shortest[0].abs() < 0.2);
//!
//! let solution = solve(&problem, best, &Options::default())?;
//! assert!((solution.end(0)[0] - 1.0).abs() < 1e-6);
//! # Ok::<(), Error>(())
//! ```
//!
//! # Check the derivatives
//!
//! The derivatives of a [`Problem`](crate::Problem) are exact. Derivatives written by hand, for
//! [`Equations`](crate::Equations), can be compared with differences, best in a unit test:
//!
//! ```
//! # use bvp::{Constant, Ends, Problem, Real, Segment};
//! use bvp::{FiniteDifferences, check_jacobians};
//! # struct Pendulum;
//! # impl Problem for Pendulum {
//! #     fn segments(&self) -> Vec<Segment> {
//! #         vec![Segment::new(2)]
//! #     }
//! #     fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
//! #         dy[0] = y[1];
//! #         dy[1] = -y[0].sin();
//! #     }
//! #     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//! #         r[0] = at.start(0)[0] - 1.0;
//! #         r[1] = at.end(0)[0];
//! #     }
//! # }
//! # let by_hand = Pendulum;
//! # let guess = Constant { states: vec![vec![0.7, -0.3]], parameters: vec![] };
//! let check = check_jacobians(&by_hand, &FiniteDifferences::of(&by_hand), &guess);
//! assert!(check.difference < 1e-8, "{check:?}");
//! ```
//!
//! A large difference where the right-hand side is a [`Problem`](crate::Problem) means that it is not
//! smooth along the guess.
//!
//! # A better guess
//!
//! 1. Parameters of the right size and sign; they matter more than the states.
//! 2. States that meet the conditions, and derivatives that belong to them: y₁ = y₀′ where the equations
//!    say so.
//! 3. The right shape: the right number of waves, a layer roughly in its place.
//! 4. The solution of a simpler problem: linearised, with a larger ε, a smaller load, on half of the
//!    interval. A [`Solution`] is a guess for any problem with the same segments;
//!    [`Function`](crate::Function) makes one from whatever else is known.
//! 5. Each of these in steps: [`solve_embedded`].
//!
//! # Ill-conditioned problems
//!
//! [`conditioning`](Solution::conditioning) tells how strongly the solution responds to changes of the
//! conditions (κ₁) and of the equations (κ₂), and how large its rounding error is:
//!
//! ```
//! # use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};
//!
//! /// ε y″ = s y′ − y, y(−1) = 1, y(1) = 2.
//! struct TwoLayers {
//!     epsilon: f64,
//! }
//! # impl Problem for TwoLayers {
//! #     fn segments(&self) -> Vec<Segment> {
//! #         vec![Segment::on(2, -1.0, 1.0)]
//! #     }
//! #     fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], _p: &[T], dy: &mut [T]) {
//! #         dy[0] = y[1];
//! #         dy[1] = (s * y[1] - y[0]) / self.epsilon;
//! #     }
//! #     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//! #         r[0] = at.start(0)[0] - 1.0;
//! #         r[1] = at.end(0)[0] - 2.0;
//! #     }
//! # }
//! # let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![] };
//! // Harmless: what layers of the width 1/10 make of slopes.
//! let problem = TwoLayers { epsilon: 0.1 };
//! let solution = solve(&problem, &guess, &Options::to(1e-3))?;
//! let harmless = solution.conditioning(&problem)?;
//! assert!(harmless.kappa < 1e3 && harmless.rounding < 1e-10);
//!
//! // A multiple of s is fixed by the conditions through both layers only: refused.
//! let problem = TwoLayers { epsilon: 0.01 };
//! let error = solve(&problem, &guess, &Options::to(1e-3)).unwrap_err();
//! println!("{error}");
//! let best = error.best().expect("the iterate of a numerical failure");
//! let hopeless = best.conditioning(&problem)?;
//! assert!(hopeless.kappa > 1e10 && hopeless.rounding > 1e-3);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! No finer mesh and no other method in double precision helps against a large κ. What may help:
//!
//! * conditions at the other end: a growing solution should be fixed where it is large, a decaying one
//!   where it starts;
//! * known integration constants: a conserved quantity instead of one of its terms, a symmetry instead of
//!   the whole interval;
//! * other variables, such as logarithms and Riccati variables;
//! * a shorter interval, where an infinite one has been cut off;
//! * a larger tolerance, where the amplified rounding is small enough for the purpose.
//!
//! # Success
//!
//! [`accuracy`](super::accuracy) says what `Ok` means and what it does not mean. To be more certain of a
//! solution, solve to a smaller tolerance, from another guess, and with another [`Scheme`].

#[cfg(doc)]
use crate::{Error, Options, Scheme, Solution, solve_embedded};
