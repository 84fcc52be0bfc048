//! Why a command fails.

use beltdrive::SolveError;
use beltdrive::belt_loop::Refusal;
use beltdrive::input::DriveFile;
use std::error::Error;

/// Why a command fails: a message for standard error, by exit status.
pub(super) enum Failure {
    /// The drive has no steady state or none was found.
    Unsolved(String),
    /// A requirement of the drive file is not met.
    Unmet(String),
    /// An input, an output or the command line is at fault.
    Usage(String),
    /// An interrupt has ended the command, whose results are written up to there.
    Interrupted(String),
}

impl Failure {
    /// A fault of the input or the command line.
    pub(super) fn usage(message: impl ToString) -> Self {
        Self::Usage(message.to_string())
    }

    /// The same failure; if the drive has no steady state, with what its file may say otherwise than was meant.
    pub(super) fn of(self, file: &DriveFile) -> Self {
        match (self, file.bare_speed()) {
            (Self::Unsolved(text), Some(help)) => Self::Unsolved(format!("{text}\nhelp: {help}")),
            (failure, _) => failure,
        }
    }

    /// The failure to do something with a file or stream.
    pub(super) fn io(action: &str, error: &dyn Error) -> Self {
        Self::Usage(format!("error: cannot {action}: {error}"))
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Loop(error) => Self::from(*error),
            Refusal::Input(error) => Self::usage(error),
        }
    }
}

impl From<SolveError> for Failure {
    fn from(error: SolveError) -> Self {
        let text = format!("error: {}", error.sentence());
        match error.is_of_statement() {
            true => Self::Usage(text),
            false => Self::Unsolved(text),
        }
    }
}
