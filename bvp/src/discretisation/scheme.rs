//! Runge-Kutta collocation schemes.

/// The largest number of stages of any scheme.
pub(crate) const MAX_STAGES: usize = 7;

/// A collocation scheme with m stages per interval.
///
/// On an interval \[sᵢ, sᵢ + h\] the solution is the polynomial of degree m that satisfies the
/// differential equation at the m points sᵢ + cⱼ h:
///
/// ```text
/// y(sᵢ + θ h) = yᵢ + h Σⱼ βⱼ(θ) Kⱼ,   Kⱼ = f(sᵢ + cⱼ h, yᵢ + h Σₗ aⱼₗ Kₗ, p)
/// ```
///
/// Ascher, Mattheij & Russell, *Numerical Solution of Boundary Value Problems for Ordinary
/// Differential Equations* (SIAM 1995), section 5.4.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Scheme {
    /// Lobatto IIIA: both ends of the interval are collocation points, so the solution is
    /// continuously differentiable. Order 2m − 2 at the nodes.
    LobattoIIIA {
        /// Number of stages, 3 (the method of bvp4c, order 4) or 4 (order 6).
        stages: usize,
    },
    /// Gauss-Legendre points, all interior. Order 2m at the nodes, m + 1 in between; never
    /// evaluates the right-hand side at the ends of a segment.
    Gauss {
        /// Number of stages, 1 (implicit midpoint rule) to 7.
        stages: usize,
    },
}

impl Scheme {
    /// The scheme of Gauss that takes the least time to a tolerance, as measured over the reference
    /// problems.
    pub fn for_tolerance(tolerance: f64) -> Self {
        let stages = match tolerance {
            _ if tolerance >= 3e-5 => 6,
            _ => 7,
        };
        Self::Gauss { stages }
    }

    /// Number of stages m.
    pub fn stages(self) -> usize {
        match self {
            Self::LobattoIIIA { stages } | Self::Gauss { stages } => stages,
        }
    }

    /// Order of the error at the mesh nodes: 2m − 2 for Lobatto IIIA, 2m for Gauss.
    pub fn order(self) -> usize {
        match self {
            Self::LobattoIIIA { stages } => 2 * stages - 2,
            Self::Gauss { stages } => 2 * stages,
        }
    }

    /// Order of the error of the continuous solution between the nodes, at most m + 1.
    pub fn dense_order(self) -> usize {
        self.order().min(self.stages() + 1)
    }

    /// Whether this number of stages is provided.
    pub(crate) fn is_valid(self) -> bool {
        match self {
            Self::LobattoIIIA { stages } => (3..=4).contains(&stages),
            Self::Gauss { stages } => (1..=MAX_STAGES).contains(&stages),
        }
    }
}
