//! Pseudo-arclength continuation of nonlinear systems.
//!
//! **Nothing is implemented yet.** The crate has no items; this page states what it is for.
//!
//! # The problem
//!
//! Follow the curve of solutions of
//!
//! ```text
//! G(x, λ) = 0,    n equations, n unknowns x and one parameter λ
//! ```
//!
//! from a known point, through limit points (folds), where the solution cannot be followed by λ
//! because the curve turns back.
//!
//! # The method
//!
//! From a point of the curve and its unit tangent (x', λ') a step of length Δσ predicts the next
//! point. Newton's method brings the prediction back to the curve under one more condition, that
//! the step along the tangent keeps its length:
//!
//! ```text
//! G(x, λ) = 0
//! x'·(x − x₀) + λ' (λ − λ₀) = Δσ
//! ```
//!
//! This system is regular at a limit point, where the matrix of G alone is singular. On the way,
//! test functions of the curve change sign at limit points and branch points, which are then
//! located as events.
//!
//! The crate is to know neither matrices nor discretisations: a system supplies one particular
//! solution and the null vector of the linearised equations in its own way, the tracer supplies
//! predictor, corrector, step length and events. So a discretised boundary value problem is traced
//! with its own structured factorisation.
//!
//! # References
//!
//! * H. B. Keller, "Numerical solution of bifurcation and nonlinear eigenvalue problems", in
//!   *Applications of Bifurcation Theory* (P. H. Rabinowitz, ed.), Academic Press 1977, 359-384.
//! * E. L. Allgower & K. Georg, *Numerical Continuation Methods*, Springer 1990.
