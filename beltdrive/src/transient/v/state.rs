//! The state of a drive with a V-belt on the mesh, as one list of numbers.

use super::super::mesh::Mesh;
use super::super::state::Places;
use std::ops::Range;

/// Where the parts of a state stand in its list.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Parts {
    /// Unstretched length a per length of the pitch line in the cells.
    pub(crate) amount: Range<usize>,
    /// Belt speed v at the faces, m/s.
    pub(crate) velocity: Range<usize>,
    /// Deflection `B_t` of the bristles along the pulley in the cells of all arcs.
    pub(crate) along: Range<usize>,
    /// Deflection `B_w` up the groove faces.
    pub(crate) up: Range<usize>,
    /// Speed ω of the pulleys, rad/s.
    pub(crate) speed: Range<usize>,
    /// Work that the axle of each pulley has done on it, J.
    pub(crate) work: Range<usize>,
    /// Work lost in axial damping, J.
    pub(crate) damped: usize,
    /// Work of friction between belt and groove faces, J.
    pub(crate) friction: usize,
    /// Work that went into the transverse compression of the belt, J.
    pub(crate) compression: usize,
    /// Work done on all pulleys without regard to its sign, J.
    pub(crate) turnover: usize,
}

impl Parts {
    /// The parts of a state on a mesh.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let (cells, pulleys) = (mesh.cells(), mesh.arcs.len());
        let mut places = Places::after(0);
        Self {
            amount: places.next(cells),
            velocity: places.next(cells),
            along: places.next(mesh.bristle_cells()),
            up: places.next(mesh.bristle_cells()),
            speed: places.next(pulleys),
            work: places.next(pulleys),
            damped: places.one(),
            friction: places.one(),
            compression: places.one(),
            turnover: places.one(),
        }
    }

    /// Length of the list.
    pub(crate) fn len(&self) -> usize {
        self.turnover + 1
    }
}
