//! Interfaces, inner conditions, kinks, integrals, singular ends, infinite intervals, complex states.
//!
//! All of them are segments, states and conditions of one problem.
//!
//! # Interfaces
//!
//! A wall of two layers with conductivities k, heated inside: u is the temperature, q the heat flux,
//!
//! ```text
//! u′ = −q/k,   q′ = 1,   u(0) = u(1) = 0,   u and q continuous at s = 0.3
//! ```
//!
//! Each layer is a segment, and continuity is a condition like any other. With the flux as a state
//! rather than u′ nothing jumps:
//!
//! ```
//! use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};
//!
//! const CONDUCTIVITY: [f64; 2] = [1.0, 0.1];
//!
//! struct Wall;
//!
//! impl Problem for Wall {
//!     fn segments(&self) -> Vec<Segment> {
//!         vec![Segment::on(2, 0.0, 0.3), Segment::on(2, 0.3, 1.0)]
//!     }
//!
//!     fn rhs<T: Real>(&self, segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
//!         dy[0] = -y[1] / CONDUCTIVITY[segment];
//!         dy[1] = T::from(1.0);
//!     }
//!
//!     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//!         r[0] = at.start(0)[0];
//!         r[1] = at.end(1)[0];
//!         for state in 0..2 {
//!             r[2 + state] = at.end(0)[state] - at.start(1)[state];
//!         }
//!     }
//! }
//!
//! let guess = Constant { states: vec![vec![0.0; 2]; 2], parameters: vec![] };
//! let solution = solve(&Wall, &guess, &Options::to(1e-9))?;
//! // q = s − c, and ∫ q/k ds = 0 over the wall.
//! let c = (0.5 * 0.09 + 5.0 * 0.91) / (0.3 + 7.0);
//! assert!((solution.end(1)[1] - (1.0 - c)).abs() < 1e-8);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! A contact resistance or a given jump changes only the conditions, and segments may differ in their
//! states and in the direction in which s runs. Where all states are continuous, a joined point does the same
//! in fewer words.
//!
//! # Kinks and inner conditions
//!
//! Where the right-hand side has a kink or a jump at a known place and the states are continuous, the place is
//! a [joined point](crate::Segment::joined) of its segment. Continuity holds by itself, and the right-hand
//! side may ask on which side it is. Conditions may name the states there, as
//! [`Ends::joined`](crate::Ends::joined). A beam on two supports and a third one at 0.4, w⁗ = q, whose load
//! q begins at 0.7:
//!
//! ```
//! # use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};
//! /// States w, w′, w″ and w‴, without the jump that the third support makes of w‴.
//! struct Beam;
//!
//! impl Problem for Beam {
//!     fn segments(&self) -> Vec<Segment> {
//!         vec![Segment::on(4, 0.0, 1.0).joined(&[0.4, 0.7])]
//!     }
//!
//!     fn parameters(&self) -> usize {
//!         1 // the force of the third support
//!     }
//!
//!     fn rhs<T: Real>(&self, _segment: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
//!         dy[0] = y[1];
//!         dy[1] = y[2];
//!         dy[2] = if s > 0.4 { y[3] + p[0] } else { y[3] };
//!         dy[3] = if s > 0.7 { T::ONE } else { T::ZERO };
//!     }
//!
//!     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//!         let (left, support, right) = (at.start(0), at.joined(0, 0), at.end(0));
//!         r.copy_from_slice(&[left[0], left[2], support[0], right[0], right[2]]);
//!     }
//! }
//!
//! let guess = Constant { states: vec![vec![0.0; 4]], parameters: vec![0.0] };
//! let solution = solve(&Beam, &guess, &Options::to(1e-9))?;
//! let force = solution.parameters()[0];
//! assert!((force + 0.124_218_75).abs() < 1e-9); // it pushes against the load
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! Without the joined point the order of the method is lost at the place, the mesh shrinks around it, and
//! where it shrinks to the spacing of numbers the error is [`Unresolved`](crate::Error::Unresolved).
//! Example: `osmosis`. Where a state jumps, or the pieces have different states, they are segments, joined by
//! conditions as the wall above. If the place of the kink depends on the solution, its length is a parameter
//! ([`free_boundaries`](super::free_boundaries)).
//!
//! # Integrals
//!
//! An integral is a state: E′ = integrand, E = 0 at the start, and its value is E at the end. A given
//! value is a condition; an unknown one that appears in the equations is a parameter p with the
//! condition E = p. Here a chain hangs between two points at a distance of one and its length is two;
//! the parameter is the horizontal tension:
//!
//! ```
//! use bvp::{Function, Options, Real, TwoPoint, solve};
//!
//! // T y″ = √(1 + y′²), ∫ √(1 + y′²) dx = 2: the states y, y′ and the length so far.
//! let chain = TwoPoint::new(
//!     [3, 1],
//!     [0.0, 1.0],
//!     |_x, y, p, dy| {
//!         let arc = (1.0 + y[1] * y[1]).sqrt();
//!         dy.copy_from_slice(&[y[1], arc / p[0], arc]);
//!     },
//!     |start, end, _p, r| r.copy_from_slice(&[start[0], end[0], start[2], end[2] - 2.0]),
//! );
//! let guess = Function {
//!     state: |_segment: usize, x: f64| [4.0 * x * (x - 1.0), 8.0 * x - 4.0, 2.0 * x],
//!     parameters: vec![0.2],
//! };
//! let solution = solve(&chain, &guess, &Options::to(1e-9))?;
//! // The catenary: 2 T sinh(1/(2 T)) = 2.
//! let tension = solution.parameters()[0];
//! assert!((tension * (0.5 / tension).sinh() - 1.0).abs() < 1e-8);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! Example: `heat_budget`.
//!
//! # Singular ends
//!
//! With the schemes of Gauss, the default, f is never evaluated at the ends of a segment, so a term
//! S y/(s − a), as of cylindrical and spherical coordinates, is written as it stands. What keeps the
//! solution finite, S y(a) = 0, is among the conditions:
//!
//! ```
//! # use bvp::{Constant, Options, TwoPoint, solve};
//! // u″ + 2 u′/r = u in a sphere, u′(0) = 0, u(1) = 1.
//! let sphere = TwoPoint::new(
//!     [2, 0],
//!     [0.0, 1.0],
//!     |r, y, _p, dy| dy.copy_from_slice(&[y[1], y[0] - 2.0 * y[1] / r]),
//!     |start, end, _p, r| r.copy_from_slice(&[start[1], end[0] - 1.0]),
//! );
//! let solution = solve(&sphere, &Constant::new([1.0, 0.0]), &Options::to(1e-9))?;
//! assert!((solution.start(0)[0] - 1.0 / 1f64.sinh()).abs() < 1e-8); // u = sinh r/(r sinh 1)
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! Solutions that grow from a like (s − a)^λ with λ > 0, an eigenvalue of S, vanish there by themselves: every c sᵏ
//! solves y' = k y/s with y(0) = 0. Their size is set by a condition elsewhere, y(1) = 1. Conditions at a that say
//! nothing on such solutions are found, and refused as
//! [`SingularConditions`](crate::Error::SingularConditions).
//!
//! Where the solution is smooth the order in between is kept and the mesh is not refined towards a. A
//! solution with a fractional power of s − a is not smooth: substitute s − a = tᵏ. Lobatto schemes ask
//! for f at a; there write its limit, (I − S)⁻¹ times the rest of f. Examples: `emden`, `explosion`.
//!
//! # Infinite intervals
//!
//! *Cut off*: solve on 0 ≤ x ≤ L with conditions at L that forbid the growing solutions of the equations
//! linearised about the state at infinity, such as u′ = −u where u decays like exp(−x). Lengthen L until
//! that changes nothing: the estimated error is that of the problem on 0 ≤ x ≤ L, without what cutting off does
//! (5·10⁻⁴ of f″(0) in Blasius' boundary layer with L = 6, and 10⁻⁹ with L = 10). Example: `front`.
//!
//! *Mapped*: with x = L s/(1 − s), 0 ≤ s < 1, and f multiplied by dx/ds = L/(1 − s)². It is shorter to
//! write; s = 1 is never asked for, but states must be bounded, and L should be the length over which
//! they decay. The factor magnifies the rounding of states that decay, and with it the defect near
//! s = 1, which does not matter to a mesh that is chosen for the error, the default. Example:
//! `rotating_disk`.
//!
//! # Complex states
//!
//! A complex state is two real ones, [`Complex`](crate::Complex) reads and writes them. w″ = i w is
//! the oscillating flow over a wall, with w(0) = 1 and w′ = −√i w where it has nearly decayed:
//!
//! ```
//! # use bvp::{Constant, Ends, Options, Problem, Real, Segment, solve};
//! use bvp::Complex;
//!
//! struct Stokes;
//!
//! impl Problem for Stokes {
//!     fn segments(&self) -> Vec<Segment> {
//!         vec![Segment::on(4, 0.0, 10.0)] // w and w′
//!     }
//!
//!     fn rhs<T: Real>(&self, _segment: usize, _z: T, y: &[T], _p: &[T], dy: &mut [T]) {
//!         Complex::read(y, 1).write(dy, 0);
//!         Complex::read(y, 0).times_i().write(dy, 1);
//!     }
//!
//!     fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
//!         let (wall, top) = (at.start(0), at.end(0));
//!         let root = Complex::new(T::from(0.5f64.sqrt()), T::from(0.5f64.sqrt()));
//!         (Complex::read(wall, 0) - 1.0).write(r, 0);
//!         (Complex::read(top, 1) + root * Complex::read(top, 0)).write(r, 1);
//!     }
//! }
//! # let guess = Constant { states: vec![vec![0.0; 4]], parameters: vec![] };
//! let solution = solve(&Stokes, &guess, &Options::to(1e-9))?;
//! let mut y = [0.0; 4];
//! solution.state(0, 2.0, &mut y);
//! let (sin, cos) = 2f64.sqrt().sin_cos(); // w = exp(−√i z)
//! let exact = [cos, -sin].map(|w| w * (-2f64.sqrt()).exp());
//! assert!((y[0] - exact[0]).hypot(y[1] - exact[1]) < 1e-8);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! The equations need not be differentiable as complex functions. Example: `orr_sommerfeld`.
