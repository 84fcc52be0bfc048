//! Eigenvalues: unknown parameters, normalisation, the k-th one.
//!
//! # An eigenvalue is a parameter
//!
//! A column of length 1 that stands upright under its own weight λ buckles where
//!
//! ```text
//! θ″ + λ s θ = 0,   θ′(0) = 0 (free top),   θ(1) = 0 (clamped foot)
//! ```
//!
//! has a solution other than zero; θ is its inclination, s the distance from the top. The smallest λ is
//! 7.8373, after A. G. Greenhill, Proc. Camb. Phil. Soc. 4 (1881) 65-73; with the zeros jₖ of the Bessel
//! function J₋₁/₃ all of them are λₖ = 9 jₖ²/4. Two states and one parameter need three conditions. The
//! third one is the *normalisation*, which excludes zero and fixes the size of θ:
//!
//! * one state at one end, θ(0) = 1, which is the simplest where that state cannot vanish;
//! * or an integral, ∫ θ² ds = 1, by one more state ([`forms`](super::forms)); it always holds, but does
//!   not tell θ from −θ.
//!
//! Newton's method finds an eigenvalue near the guess. For the k-th one guess a function with as many
//! zeros as its eigenfunction, k − 1 inside for a Sturm-Liouville problem, and λ roughly, here from
//! ∫ √(λ s) ds = (k − ½) π. Then count the zeros of what was found:
//!
//! ```
//! use bvp::{Function, Options, Solution, TwoPoint, solve};
//! use std::f64::consts::PI;
//!
//! // States θ and θ′, parameter λ.
//! let column = TwoPoint::new(
//!     [2, 1],
//!     [0.0, 1.0],
//!     |s, y, p, dy| dy.copy_from_slice(&[y[1], -p[0] * s * y[0]]),
//!     |start, end, _p, r| r.copy_from_slice(&[start[0] - 1.0, start[1], end[0]]),
//! );
//!
//! /// The zeros of θ between the ends.
//! fn zeros(solution: &Solution) -> usize {
//!     let mut y = [0.0; 2];
//!     let mut theta = |i: u32| {
//!         solution.state(0, (f64::from(i) + 0.5) / 1000.0, &mut y);
//!         y[0]
//!     };
//!     (1..1000).filter(|&i| theta(i - 1) * theta(i) < 0.0).count()
//! }
//!
//! let bessel_zeros = [1.866_350_859, 4.987_853_231, 8.124_265_382, 11.263_514_825];
//! for (k, zero) in (1..).zip(bessel_zeros) {
//!     let waves = (f64::from(k) - 0.5) * PI;
//!     let guess = Function {
//!         state: |_segment: usize, s: f64| [(waves * s).cos(), -waves * (waves * s).sin()],
//!         parameters: vec![(1.5 * waves).powi(2)],
//!     };
//!     let solution = solve(&column, &guess, &Options::to(1e-9))?;
//!     let lambda = solution.parameters()[0];
//!     println!("{k} {lambda:14.8}, {} zeros inside", zeros(&solution));
//!     assert_eq!(zeros(&solution) + 1, k as usize);
//!     assert!((lambda / (2.25 * zero * zero) - 1.0).abs() < 2e-9);
//! }
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! # Conditions that name k
//!
//! The angle φ of Prüfer, tan φ = σ θ/θ′, grows through every multiple of π, the zeros of θ:
//!
//! ```text
//! φ′ = σ cos² φ + (λ s/σ) sin² φ,   φ(0) = π/2,   φ(1) = k π
//! ```
//!
//! One state, one parameter, two conditions, no normalisation, and no solution but the k-th. The
//! constant σ is best near √(λ s), where φ is a straight line.
//!
//! ```
//! # use bvp::{Function, Options, Real, TwoPoint, solve};
//! # use std::f64::consts::{FRAC_PI_2, PI};
//! let k = 4;
//! let waves = (f64::from(k) - 0.5) * PI;
//! let scale = 1.5 * waves;
//! let guess = Function {
//!     state: |_segment: usize, s: f64| [FRAC_PI_2 + waves * s],
//!     parameters: vec![scale * scale],
//! };
//! let angle = TwoPoint::new(
//!     [1, 1],
//!     [0.0, 1.0],
//!     |s, y, p, dy| {
//!         let (sin, cos) = y[0].sin_cos();
//!         dy[0] = scale * cos * cos + p[0] * s * sin * sin / scale;
//!     },
//!     |start, end, _p, r| r.copy_from_slice(&[start[0] - FRAC_PI_2, end[0] - PI * f64::from(k)]),
//! );
//! let solution = solve(&angle, &guess, &Options::to(1e-9))?;
//! assert!((solution.parameters()[0] / 285.450_224_0 - 1.0).abs() < 2e-9);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! # Which way to the k-th one
//!
//! | the problem | the way |
//! | --- | --- |
//! | the shape of the eigenfunction is known roughly | guess it, count its zeros afterwards |
//! | another value of a constant has known eigenvalues | follow k from there, each solution the next guess (example `mathieu`), or [`solve_embedded`](crate::solve_embedded) |
//! | Sturm-Liouville, eigenvalues close together or k large | the angle of Prüfer (example `sturm_liouville`) |
//! | complex eigenvalues | [`Complex`](crate::Complex) states, two parameters, two more conditions (example `orr_sommerfeld`) |
//!
//! # When it does not work
//!
//! * *The solution is zero everywhere.* The normalisation does not exclude it.
//! * *[`Error::SingularConditions`](crate::Error::SingularConditions) or no convergence with a sensible
//!   guess.* The normalised state vanishes in the eigenfunction wanted; or nothing fixes the size of the
//!   eigenfunction, so that the solutions are a family.
//! * *The eigenfunction changes with the guess, the eigenvalue does not, or a family of solutions is
//!   reported although the size is fixed.* The eigenvalue is a double one, its eigenfunctions are a
//!   plane. Symmetry selects one of them, such as even or odd on half of the
//!   interval.
//! * *Another eigenvalue was found.* The parameter was guessed too roughly. A Rayleigh quotient of the
//!   guessed function is good to second order.
//! * *The estimated error is that of λ, but the eigenfunction is wanted, or the other way round.*
//!   [`parameter_errors`](crate::Solution::parameter_errors) and
//!   [`state_errors`](crate::Solution::state_errors) have both.
