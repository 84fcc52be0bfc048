//! One Householder reflection.

/// The reflection I − τ v vᵀ that maps a vector to β times the first unit vector. The first entry of v is
/// one; the others are those of the vector times `scale`. The determinant is −1. Golub & Van
/// Loan, *Matrix Computations*, 4th ed., section 5.1.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reflection {
    pub(crate) beta: f64,
    pub(crate) tau: f64,
    pub(crate) scale: f64,
}

impl Reflection {
    /// From the first entry of the vector and the sum of squares of all its entries; `None` if that
    /// is not positive and finite.
    #[inline]
    pub(crate) fn new(head: f64, square: f64) -> Option<Self> {
        let norm = square.sqrt();
        if !(norm > 0.0 && norm.is_finite()) {
            return None;
        }
        let beta = -norm.copysign(head);
        Some(Self {
            beta,
            tau: (beta - head) / beta,
            scale: 1.0 / (head - beta),
        })
    }
}
