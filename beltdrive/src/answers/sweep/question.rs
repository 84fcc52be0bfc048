//! What is asked of every drive of a sweep.

/// What is asked of every drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepQuestion {
    /// Its steady state.
    Solve,
    /// Its steady state, slip margin and losses, in every load case, against what its file requires.
    Check,
    /// The smallest and the largest load.
    Limits,
}

impl SweepQuestion {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Solve, Self::Check, Self::Limits];

    /// Its name: that of the command that asks it of one drive.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Solve => "solve",
            Self::Check => "check",
            Self::Limits => "limits",
        }
    }
}
