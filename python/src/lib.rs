//! The native half of the Python package `beltdrive`: `beltdrive/*.py` is what its users see.

mod answer;
mod bvp;
mod failure;
mod numbers;
mod questions;
mod stated;
mod table;

use pyo3::prelude::*;

#[pymodule]
mod _native {
    #[pymodule_export]
    use super::answer::Answer;
    #[pymodule_export]
    use super::bvp::{BvpSolution, solve_bvp};
    #[pymodule_export]
    use super::failure::{InputError, UnsolvedError};
    #[pymodule_export]
    use super::numbers::Numbers;
    #[pymodule_export]
    use super::questions::{
        calibrate, check, design, example, examples, limits, map, modes, rating, report, sections,
        simulate, solve, stability, tension, trace, verify,
    };
    #[pymodule_export]
    use super::table::{Table, solve_table};
}
