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
    /// Work done on all pulleys, by gravity and by run-out without regard to its sign, J.
    pub(crate) turnover: usize,
    /// Those of spans that move across, if they do.
    pub(crate) across: Option<AcrossParts>,
}

/// Where the parts of spans that move across stand.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct AcrossParts {
    /// Displacement w away from the inside of the loop at the faces of all spans, both ends included, m.
    pub(crate) displacement: Range<usize>,
    /// Velocity u of the belt in that direction at the same places, m/s.
    pub(crate) velocity: Range<usize>,
    /// Angle by which each pulley has turned, rad.
    pub(crate) angle: Range<usize>,
    /// Work of gravity, J.
    pub(crate) gravity: usize,
    /// Work of the run-out of pulleys, J.
    pub(crate) run_out: usize,
    /// Work lost in the damping of motion across, J.
    pub(crate) damped: usize,
}

/// Hands out places in a list, one part behind the other.
pub(crate) struct Places {
    end: usize,
}

impl Places {
    /// Those behind the first `count`.
    pub(crate) fn after(count: usize) -> Self {
        Self { end: count }
    }

    /// The next `count` places.
    pub(crate) fn next(&mut self, count: usize) -> Range<usize> {
        let start = self.end;
        self.end += count;
        start..self.end
    }

    /// The next place.
    pub(crate) fn one(&mut self) -> usize {
        self.next(1).start
    }
}

impl Parts {
    /// The parts of a state on a mesh.
    pub(crate) fn new(mesh: &Mesh) -> Self {
        let (cells, pulleys) = (mesh.cells(), mesh.arcs.len());
        let mut places = Places::after(0);
        Self {
            density: places.next(cells + 1),
            velocity: places.next(cells + 1),
            bristle: places.next(mesh.bristle_cells()),
            speed: places.next(pulleys),
            work: places.next(pulleys),
            damped: places.one(),
            contact: places.one(),
            turnover: places.one(),
            across: None,
        }
    }

    /// The parts of a state on a mesh whose spans move across.
    pub(crate) fn across(mesh: &Mesh) -> Self {
        let parts = Self::new(mesh);
        let faces = mesh.spans.iter().map(|span| span.len() + 1).sum();
        let mut places = Places::after(parts.len());
        let across = AcrossParts {
            displacement: places.next(faces),
            velocity: places.next(faces),
            angle: places.next(mesh.arcs.len()),
            gravity: places.one(),
            run_out: places.one(),
            damped: places.one(),
        };
        Self {
            across: Some(across),
            ..parts
        }
    }

    /// Length of the list.
    pub(crate) fn len(&self) -> usize {
        let across = self.across.as_ref();
        across.map_or(self.turnover, |across| across.damped) + 1
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
