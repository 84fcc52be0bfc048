//! The state of a drive on the mesh, as one list of numbers.

use super::mesh::Mesh;
use std::ops::Range;

/// Where the parts of a state stand in its list.
///
/// The loop is closed by one cell and one face more: the density of the last cell stands before that of the first,
/// and the speed of the first face after that of the last, so that every sum over neighbours runs straight through.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Parts {
    /// Unstretched length per length ρ in the cells; that of the last cell first, then all.
    pub(crate) density: Range<usize>,
    /// Belt speed v at the faces, m/s; all, then that of the first face.
    pub(crate) velocity: Range<usize>,
    /// Displacement b of the belt against the pulley in the cells of all arcs, m.
    pub(crate) bristle: Range<usize>,
    /// Speed ω of the pulleys, rad/s.
    pub(crate) speed: Range<usize>,
    /// Work that the axle of each pulley has done on it, J.
    pub(crate) work: Range<usize>,
    /// Work lost in axial damping, J.
    pub(crate) damped: usize,
    /// Work that went into the contact between belt and pulleys, J.
    pub(crate) contact: usize,
    /// Work done on all pulleys without regard to its sign, J.
    pub(crate) turnover: usize,
}

impl Parts {
    /// The parts of a state on a mesh.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let (cells, pulleys) = (mesh.cells(), mesh.arcs.len());
        let mut end = 0;
        let mut next = |count: usize| {
            let start = end;
            end += count;
            start..end
        };
        Self {
            density: next(cells + 1),
            velocity: next(cells + 1),
            bristle: next(mesh.bristle_cells()),
            speed: next(pulleys),
            work: next(pulleys),
            damped: next(1).start,
            contact: next(1).start,
            turnover: next(1).start,
        }
    }

    /// Length of the list.
    pub(crate) fn len(&self) -> usize {
        self.turnover + 1
    }

    /// A state with one density and one belt speed, and everything else 0.
    pub(crate) fn uniform(&self, density: f64, velocity: f64) -> Vec<f64> {
        let mut state = vec![0.0; self.len()];
        state[self.density.clone()].fill(density);
        state[self.velocity.clone()].fill(velocity);
        state
    }

    /// Repeats the ends of the loop.
    pub(crate) fn close(&self, state: &mut [f64]) {
        state[self.density.start] = state[self.density.end - 1];
        state[self.velocity.end - 1] = state[self.velocity.start];
    }
}
