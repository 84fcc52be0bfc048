//! The drives of the sources, from the drive files that come with the program.

use crate::transient::TransientError;
use crate::{Drive, SolveError, SolveOptions, SteadyState, examples, input, solve};

/// Why a number is not computed.
#[derive(Debug, thiserror::Error)]
pub(super) enum Failure {
    /// A drive file is missing.
    #[error(transparent)]
    Example(#[from] examples::UnknownExample),
    /// A drive file has a fault.
    #[error(transparent)]
    Input(#[from] input::Diagnostic),
    /// No steady state was found.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A drive could not be followed in time.
    #[error(transparent)]
    Transient(#[from] TransientError),
    /// Something that a state or a branch should show does not happen.
    #[error("{0} was not found")]
    Missing(&'static str),
}

/// A drive file that comes with the program, with overrides.
pub(super) fn drive(example: &str, overrides: &[String]) -> Result<Drive, Failure> {
    let example = examples::find(example)?;
    Ok(input::parse(example.name, example.text, overrides)?)
}

/// The flat-belt drive of Kim (2009) in the convention of the thesis, at a friction stiffness in N/m²
/// and belt tensions in N.
pub(super) fn kim_flat(stiffness: f64, [slack, tight]: [f64; 2]) -> Result<Drive, Failure> {
    let overrides = [
        "model.normal_force=thesis".to_owned(),
        format!("friction.stiffness={stiffness:e}"),
        format!("load.slack_tension={slack:e}"),
        format!("load.tight_tension={tight:e}"),
    ];
    drive("kim2009-flat", &overrides)
}

/// The V-belt drive of Kim (2009) with a friction law, at a tractive tension of the tight span in N.
pub(super) fn kim_v(law: &str, tight: f64) -> Result<Drive, Failure> {
    let overrides = [
        format!("friction.law={law}"),
        format!("load.tight_tractive_tension={tight:e}"),
    ];
    drive("kim2009", &overrides)
}

/// The steady state of a drive to the usual tolerance.
pub(super) fn state(drive: &Drive) -> Result<SteadyState, Failure> {
    Ok(solve(drive, &SolveOptions::default())?)
}
