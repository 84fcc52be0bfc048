//! The cost of a solution.

/// The cost of a solution, over all meshes and including its error estimate.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Stats {
    /// Evaluations of the right-hand side at one point, with or without derivatives.
    pub rhs_evaluations: usize,
    /// Evaluations of the Jacobian of the right-hand side at one point.
    pub jacobian_evaluations: usize,
    /// Linearisations and factorisations of the Newton matrix.
    pub factorisations: usize,
    /// Newton steps taken, with a new or a kept Jacobian.
    pub newton_steps: usize,
    /// Meshes on which a solution was sought.
    pub meshes: usize,
    /// Wall-clock time in seconds.
    pub seconds: f64,
}

impl std::ops::AddAssign for Stats {
    fn add_assign(&mut self, other: Self) {
        self.rhs_evaluations += other.rhs_evaluations;
        self.jacobian_evaluations += other.jacobian_evaluations;
        self.factorisations += other.factorisations;
        self.newton_steps += other.newton_steps;
        self.meshes += other.meshes;
        self.seconds += other.seconds;
    }
}
