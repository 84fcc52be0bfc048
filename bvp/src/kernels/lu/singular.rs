//! Why a matrix has no factors.

/// The matrix is singular: the pivot of this row vanishes or is not finite.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SingularRow(pub(crate) usize);
