//! Unknown lengths, places and periods.
//!
//! A segment runs between given ends. Where an end is part of the answer, its place is an unknown
//! parameter: with the length L and x = a + L s, s runs from 0 to 1 and
//!
//! ```text
//! dy/ds = L f(a + L s, y, p)
//! ```
//!
//! One more unknown constant, one more condition.
//!
//! # How deep oxygen goes
//!
//! A tissue consumes oxygen at a constant rate wherever there is some. The concentration u falls from
//! its value h at the surface to zero at the depth L, and nothing flows on from there:
//!
//! ```text
//! u″ = 1,   u(0) = h,   u(L) = u′(L) = 0          u = (L − x)²/2,   L = √(2h)
//! ```
//!
//! ```
//! use bvp::{Function, Options, TwoPoint, solve};
//!
//! // States u and du/dx, parameter L.
//! let surface = 3.0;
//! let oxygen = TwoPoint::new(
//!     [2, 1],
//!     [0.0, 1.0],
//!     |_s, y, p, dy| dy.copy_from_slice(&[p[0] * y[1], p[0]]),
//!     |start, end, _p, r| r.copy_from_slice(&[start[0] - surface, end[0], end[1]]),
//! );
//!
//! // From a straight line: no length may be guessed as zero.
//! let guess = Function {
//!     state: |_segment: usize, s: f64| [surface * (1.0 - s), -surface],
//!     parameters: vec![1.0],
//! };
//! let solution = solve(&oxygen, &guess, &Options::to(1e-9))?;
//! let depth = solution.parameters()[0];
//! assert!((depth - (2.0 * surface).sqrt()).abs() < 1e-9);
//!
//! // The solution is one of s; at the place x it is that at s = x/L.
//! let mut y = [0.0; 2];
//! solution.state(0, 1.0 / depth, &mut y);
//! assert!((y[0] - 0.5 * (depth - 1.0).powi(2)).abs() < 1e-9);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! Keep derivatives with respect to x as states, as here: their values and their errors are then
//! physical, and interfaces between segments of different lengths read as usual.
//!
//! # Other unknown places
//!
//! * **Both ends**: a and L are two parameters.
//! * **A place inside**, such as a front between ice and water: two segments with lengths L and 1 − L,
//!   joined by conditions ([`forms`](super::forms)), and the condition that defines the front.
//! * **A time**: the shortest time, the time of an impact (example `brachistochrone`).
//! * **A period**: y(0) = y(1), and because with y(t) every y(t + c) is a solution, a phase condition,
//!   such as one state given at t = 0. The period T multiplies the right-hand side:
//!
//! ```
//! # use bvp::{Function, Options, TwoPoint, solve};
//! # use std::f64::consts::TAU;
//! // Van der Pol's oscillator x″ − (1 − x²) x′ + x = 0.
//! let oscillator = TwoPoint::new(
//!     [2, 1],
//!     [0.0, 1.0],
//!     |_s, y, p, dy| {
//!         dy[0] = p[0] * y[1];
//!         dy[1] = p[0] * ((1.0 - y[0] * y[0]) * y[1] - y[0]);
//!     },
//!     |start, end, _p, r| {
//!         r[0] = end[0] - start[0];
//!         r[1] = end[1] - start[1];
//!         r[2] = start[1]; // the phase: x is largest at the start
//!     },
//! );
//! let guess = Function {
//!     state: |_segment: usize, s: f64| [2.0 * (TAU * s).cos(), -2.0 * (TAU * s).sin()],
//!     parameters: vec![TAU],
//! };
//! let solution = solve(&oscillator, &guess, &Options::default())?;
//! assert!((solution.parameters()[0] - 6.663_286_86).abs() < 1e-5);
//! assert!((solution.start(0)[0] - 2.008_62).abs() < 1e-4);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! # When it does not work
//!
//! * *The length goes to zero or below.* With L = 0 every constant state solves the equations. Guess L
//!   generously, or make ln L the parameter.
//! * *A family of solutions, and a shift of s takes one to the other.* There is no phase condition: not even the
//!   exact period makes up for it.
//! * *A periodic solution turns out to be constant.* A state at rest has every period. Guess an
//!   amplitude nearer to that of the oscillation, or follow it from another case.
