//! Where a Newton matrix is singular.

/// Where the Newton matrix is singular to working precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Singular {
    /// The states of this node are not determined by their neighbours.
    Node { segment: usize, node: usize },
    /// The conditions do not determine the ends and the parameters.
    Ends,
}
