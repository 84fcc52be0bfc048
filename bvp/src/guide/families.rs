//! Problems with several solutions or none: curves of solutions and their folds.
//!
//! Nonlinear problems have several solutions more often than not, and over a load, a temperature or a
//! speed they form curves that turn back. At such a *fold* two solutions merge, and beyond it there is
//! none: [`solve`](crate::solve) ends in [`Error::NoConvergence`](crate::Error::NoConvergence), whatever
//! the guess, and [`solve_embedded`](crate::solve_embedded) in
//! [`Error::Unreached`](crate::Error::Unreached) with a value just below the fold.
//!
//! # Is there a fold?
//!
//! Bratu's problem u″ + λ eᵘ = 0, u(0) = u(1) = 0 has two solutions up to λ = 3.513830719 and none
//! beyond:
//!
//! ```
//! use bvp::{Constant, Embedding, Error, Options, Real, TwoPoint, solve_embedded};
//!
//! // Two states and one parameter, p = (λ), but two conditions.
//! let bratu = TwoPoint::new(
//!     [2, 1],
//!     [0.0, 1.0],
//!     |_s, y, p, dy| dy.copy_from_slice(&[y[1], -p[0] * y[0].exp()]),
//!     |start, end, _p, r| r.copy_from_slice(&[start[0], end[0]]),
//! )
//! .with_condition_count(2);
//! let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![1.0] };
//! let embedding = Embedding { parameter: 0, from: 1.0, to: 5.0 };
//! match solve_embedded(&bratu, &embedding, &guess, &Options::default()) {
//!     Err(Error::Unreached { reached, best, .. }) => {
//!         println!("λ = {reached}, u′(0) = {}", best.start(0)[1]);
//!         assert!((3.4..3.514).contains(&reached));
//!     }
//!     other => panic!("{other:?}"),
//! }
//! # Ok::<(), Error>(())
//! ```
//!
//! # Around the fold
//!
//! With λ free, the solutions are a [`Family`](crate::Family): the discretised problem as the curve sees
//! it, n equations for n + 1 unknowns, on a mesh that follows the solution. Nothing of it is special at a
//! fold.
//!
//! ```
//! # use bvp::{Constant, Real, TwoPoint};
//! use bvp::{Family, Options};
//! # let bratu = TwoPoint::new(
//! #     [2, 1],
//! #     [0.0, 1.0],
//! #     |_s, y, p, dy| dy.copy_from_slice(&[y[1], -p[0] * y[0].exp()]),
//! #     |start, end, _p, r| r.copy_from_slice(&[start[0], end[0]]),
//! # )
//! # .with_condition_count(2);
//! # let guess = Constant { states: vec![vec![0.0; 2]], parameters: vec![1.0] };
//!
//! let (mut family, mut z) = Family::new(&bratu, 0, &[], &guess, &Options::default())?;
//! let n = family.unknowns() - 1; // λ is z[n]
//! let (mut g, mut v, mut t) = (vec![0.0; n], vec![0.0; n + 1], vec![0.0; n + 1]);
//!
//! family.linearise(&z)?;
//! family.null_vector(&mut t);
//! let forward = t[n].signum(); // λ grows at first
//!
//! // Steps along the tangent, each with corrections by Newton's method, until λ turns back.
//! let mut before = f64::NEG_INFINITY;
//! while z[n] > before {
//!     before = z[n];
//!     let length = t.iter().map(|t| t * t).sum::<f64>().sqrt();
//!     z.iter_mut().zip(&t).for_each(|(z, t)| *z += forward * 2.0 / length * t);
//!     for _ in 0..4 {
//!         family.residual(&z, &mut g);
//!         family.linearise(&z)?;
//!         family.particular(&g, &mut v);
//!         z.iter_mut().zip(&v).for_each(|(z, v)| *z -= v);
//!     }
//!     family.linearise(&z)?;
//!     family.null_vector(&mut t); // keeps its direction around the fold
//!     println!("λ = {:.4}, u′(0) = {:.4}", z[n], family.start(&z, 0)[1]);
//! }
//! assert!(family.start(&z, 0)[1] > 4.0); // it is 4 at the fold
//! assert!(before < 3.514 && z[n] > 3.0);
//! assert!(family.solution(&z).defect() < 1e-3);
//! # Ok::<(), bvp::Error>(())
//! ```
//!
//! This is the principle; the crate `continuation` does it with steps of the right length, locates folds and
//! crossings of curves, switches to the other curve, and finds solutions on curves that are connected to no
//! known one. With its feature `bvp` a [`Family`](crate::Family) is one of its systems:
//!
//! ```text
//! let (mut family, start) = Family::new(&bratu, 0, &[], &guess, &bvp::Options::default())?;
//! let options = continuation::Options::within(0.0, 4.0);
//! let mut branch = continuation::Branch::new(&mut family, &start, Direction::Increasing, &options)?;
//! while let Some(point) = branch.next() {
//!     let solution = branch.system().solution(&point.z); // on the mesh of this point
//! }
//! ```
//!
//! Each of its points has a z, of which [`Family::solution`](crate::Family::solution) makes a
//! [`Solution`](crate::Solution). Other parameters than λ are held at fixed values, among them the
//! second parameter of a curve of folds.
//!
//! A family goes on with the same program later if z, [`Family::mesh`](crate::Family::mesh) and the values
//! held are kept: [`Family::on_mesh`](crate::Family::on_mesh).
//!
//! # The fold itself
//!
//! The fold is where the linearised problem has a solution v other than zero. Stated together, u, v and
//! λ are an ordinary problem: twice the states, λ a parameter, v normalised. Example: `explosion`.
