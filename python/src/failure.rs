//! Why there is no answer, as exceptions with the words of the program.

use beltdrive::belt_loop::Refusal;
use beltdrive::calibrate::Error as CalibrateError;
use beltdrive::input::{Diagnostic, DriveFile};
use beltdrive::transient::TransientError;
use beltdrive::{DesignError, SolveError};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

pyo3::create_exception!(
    beltdrive,
    InputError,
    PyValueError,
    "A drive file, a table or an argument is at fault; the message says where and what was expected."
);
pyo3::create_exception!(
    beltdrive,
    UnsolvedError,
    PyRuntimeError,
    "The drive has no steady state, or none was found. `reason` is why, in one word or two, as in the tables of sweeps."
);

/// Why there is no answer.
pub(crate) enum Failure {
    /// The input is at fault.
    Input(String),
    /// There is no steady state, or none was found: in words, and in one for programs.
    Unsolved(String, &'static str),
}

impl Failure {
    /// A fault of the input.
    pub(crate) fn input(error: impl ToString) -> Self {
        Self::Input(error.to_string())
    }

    /// The same failure, with what the drive file may say otherwise than was meant.
    pub(crate) fn of(self, file: &DriveFile) -> Self {
        match (self, file.bare_speed()) {
            (Self::Unsolved(text, reason), Some(help)) => {
                Self::Unsolved(format!("{text}\nhelp: {help}"), reason)
            }
            (failure, _) => failure,
        }
    }
}

impl From<Diagnostic> for Failure {
    fn from(error: Diagnostic) -> Self {
        Self::input(error)
    }
}

impl From<SolveError> for Failure {
    fn from(error: SolveError) -> Self {
        match error.is_of_statement() {
            true => Self::Input(error.sentence()),
            false => Self::Unsolved(error.sentence(), error.kind()),
        }
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Loop(error) => Self::from(*error),
            Refusal::Input(error) => Self::from(*error),
        }
    }
}

impl From<TransientError> for Failure {
    fn from(error: TransientError) -> Self {
        match error.is_of_statement() {
            true => Self::input(error),
            false => Self::Unsolved(error.to_string(), "no simulation"),
        }
    }
}

impl From<DesignError> for Failure {
    fn from(error: DesignError) -> Self {
        match error {
            DesignError::Input(error) => Self::input(error),
            error => Self::Unsolved(error.to_string(), "no design"),
        }
    }
}

impl From<CalibrateError> for Failure {
    fn from(error: CalibrateError) -> Self {
        match error {
            CalibrateError::Set { .. } | CalibrateError::TooFew { .. } => Self::input(error),
            error => Self::Unsolved(error.to_string(), "no calibration"),
        }
    }
}

/// The type of the exception stands in place of the word `error`.
impl From<Failure> for PyErr {
    fn from(failure: Failure) -> Self {
        let own = |text: String| match text.strip_prefix("error: ") {
            Some(rest) => rest.to_owned(),
            None => text,
        };
        match failure {
            Failure::Input(text) => InputError::new_err(own(text)),
            Failure::Unsolved(text, reason) => Python::attach(|py| {
                let error = UnsolvedError::new_err(own(text));
                match error.value(py).setattr("reason", reason) {
                    Ok(()) => error,
                    Err(error) => error,
                }
            }),
        }
    }
}
