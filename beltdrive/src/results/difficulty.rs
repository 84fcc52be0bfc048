//! Why a state was not found, in words for who designs a drive: what solver and tracer say of meshes,
//! iterations and components helps no one who cannot reach them.

use continuation::Stop;

/// Steps of a branch became too short, or led nowhere.
pub(crate) const TOO_ABRUPT: &str = "the states change too abruptly there to be followed; a start from the other end of the range \
     or a larger tolerance may help";

/// Why the boundary value problem of a drive was not solved.
pub(crate) fn of_solver(error: &bvp::Error) -> &'static str {
    use bvp::Error;
    match error {
        Error::MeshLimit { .. } | Error::Unresolved { .. } => {
            "what follows changes too abruptly along the belt to be computed; softer friction, a larger \
             tolerance or a load farther from the limits of the drive may help"
        }
        Error::ConditionViolated { .. } | Error::IllConditioned { .. } => {
            "rounding errors hide what follows: values of the drive file may differ by too many powers of \
             ten; check their units, or ask for a larger tolerance"
        }
        Error::NonFiniteRhs { .. } | Error::NonFiniteCondition { .. } => {
            "the equations have no finite values for what follows; check the values of the drive file and \
             their units"
        }
        _ => {
            "no state was found near the last one: the drive may not carry more, or its values may be far \
             from those of a real drive; check them and their units, or begin with a lighter load"
        }
    }
}

/// Why a branch could not be followed from its first state.
pub(crate) fn of_branch(_: &continuation::Error) -> &'static str {
    "no branch leads on from the state there; another start or a larger tolerance may help"
}

/// Why a branch could not be followed farther.
pub(crate) fn of_stop(stop: &Stop) -> String {
    match stop {
        Stop::Steps { steps } => {
            format!("the branch is longer than {steps} states; trace it in shorter ranges")
        }
        Stop::Inaccurate { error, tolerance } => format!(
            "the state there is known to {error:.1e} only, not to the tolerance {tolerance:.1e}; a larger \
             tolerance may help"
        ),
        Stop::Asymptote { .. } => {
            "the branch approaches the end of its range but does not reach it".to_owned()
        }
        _ => TOO_ABRUPT.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_said_that_a_user_cannot_reach() {
        let stops = [
            Stop::Steps { steps: 300 },
            Stop::Inaccurate {
                error: 1e-3,
                tolerance: 1e-6,
            },
            Stop::Asymptote { lambda: 0.5 },
            Stop::Closed,
        ];
        let solver = [
            bvp::Error::NoSegments,
            bvp::Error::NoIntervals,
            bvp::Error::NoStates { segment: 1 },
        ];
        let texts = stops.iter().map(of_stop);
        let texts = texts.chain(solver.iter().map(|error| of_solver(error).to_owned()));
        for text in texts {
            for word in [
                "lambda",
                "newton",
                "mesh",
                "component",
                "segment",
                "max_",
                "solve_",
            ] {
                assert!(!text.contains(word), "{text}");
            }
        }
    }
}
