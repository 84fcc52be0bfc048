//! Adaptive collocation for boundary value problems.

mod almost_block_diagonal;
mod check;
mod collocation;
mod dense;
mod difference;
mod dual;
mod equations;
mod error;
mod error_control;
mod guess;
mod mesh;
mod newton;
mod options;
mod problem;
mod real;
mod scheme;
mod solution;
mod solver;
mod stats;

pub use check::{Differenced, JacobianCheck, Place, check_jacobians};
pub use difference::FiniteDifferences;
pub use dual::Dual;
pub use equations::Equations;
pub use error::Error;
pub use guess::{Constant, Function, Guess, Table};
pub use options::{GlobalError, Options};
pub use problem::{Ends, Problem, Segment};
pub use real::Real;
pub use scheme::Scheme;
pub use solution::Solution;
pub use solver::solve;
pub use stats::Stats;
