//! The depth of the belt in a groove: the radial balance, one tridiagonal system.
//!
//! The depth x stands at the faces of an arc and is 0 at both ends. In a cell of length h of the pitch line the belt has
//! the length g h,
//!
//! ```text
//! g² = (1 − x̄/R)² + (Δx/h)²          x̄: mean of both faces
//! ```
//!
//! and the balance is that of virtual work: Σ h (F ∂g/∂x + ½ n g) = 0 over the two cells of a face.

/// Length of a cell per length of the pitch line, as a function of the depths at its faces.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Shape {
    /// g.
    pub(super) length: f64,
    /// r/R of the middle.
    pub(super) radius: f64,
    /// Slope ∂x/∂σ.
    pub(super) slope: f64,
    /// Derivatives of g with the depth at the face behind and at that before, 1/m.
    pub(super) by: [f64; 2],
}

/// Derivatives of r/R and of the slope with the depths at both faces, 1/m.
fn parts(radius: f64, cell: f64) -> [[f64; 2]; 2] {
    let across = -0.5 / radius;
    [[across, -cell.recip()], [across, cell.recip()]]
}

impl Shape {
    /// Of a cell of a length in m on a pitch radius in m, with the depths at its faces in m.
    pub(super) fn new([behind, before]: [f64; 2], radius: f64, cell: f64) -> Self {
        let (share, slope) = (
            1.0 - 0.5 * (behind + before) / radius,
            (before - behind) / cell,
        );
        let length = share.hypot(slope);
        Self {
            length,
            radius: share,
            slope,
            by: parts(radius, cell)
                .map(|[across, along]| (share * across + slope * along) / length),
        }
    }

    /// Second derivatives of g, 1/m².
    fn second(&self, radius: f64, cell: f64) -> [[f64; 2]; 2] {
        let parts = parts(radius, cell);
        [0, 1].map(|one| {
            [0, 1].map(|other| {
                let product: f64 = (0..2)
                    .map(|part| parts[one][part] * parts[other][part])
                    .sum();
                (product - self.by[one] * self.by[other]) / self.length
            })
        })
    }
}

/// What a cell adds to the radial balance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pull {
    /// Tractive tension F, N, and its derivative with g.
    pub(super) tractive: [f64; 2],
    /// Outward load n per length, N/m, and its derivative with x̄.
    pub(super) outward: [f64; 2],
}

/// A tridiagonal system over the faces of an arc, the ends of which are held.
#[derive(Clone, Debug, Default)]
pub(super) struct Tridiagonal {
    /// Below, on and above the diagonal.
    pub(super) rows: Vec<[f64; 3]>,
    work: Vec<f64>,
}

impl Tridiagonal {
    /// Zeros for a number of unknowns.
    pub(super) fn clear(&mut self, unknowns: usize) {
        self.rows.clear();
        self.rows.resize(unknowns, [0.0; 3]);
    }

    /// Adds to the rows and columns of both faces of a cell of an arc, whose first face is held.
    pub(super) fn add(&mut self, cell: usize, block: [[f64; 2]; 2]) {
        let count = self.rows.len();
        let inside = |face: usize| face.checked_sub(1).filter(|&row| row < count);
        for (side, row) in [cell, cell + 1].into_iter().map(inside).enumerate() {
            if let Some(row) = row {
                for (other, value) in block[side].into_iter().enumerate() {
                    self.rows[row][1 + other - side] += value;
                }
            }
        }
    }

    /// Solves for a right-hand side in its place.
    pub(super) fn solve(&mut self, side: &mut [f64]) {
        let count = self.rows.len();
        self.work.clear();
        let mut before = [0.0; 2];
        for (row, value) in self.rows.iter().zip(&mut *side) {
            let pivot = row[1] - row[0] * before[0];
            before = [row[2] / pivot, (*value - row[0] * before[1]) / pivot];
            self.work.push(before[0]);
            *value = before[1];
        }
        for row in (0..count.saturating_sub(1)).rev() {
            side[row] -= self.work[row] * side[row + 1];
        }
    }
}

/// A correction of the depth of this share of the pitch radius is the last one: Newton's method leaves its square.
const CORRECTION: f64 = 1e-8;

/// Most corrections of the depth; one step of time takes two or three.
const MOST_CORRECTIONS: usize = 30;

/// Room for the radial balance of an arc.
#[derive(Clone, Debug, Default)]
pub(super) struct Balance {
    /// Derivatives of the balance with the depths, at the last depths.
    pub(super) matrix: Tridiagonal,
    side: Vec<f64>,
}

impl Balance {
    /// Brings the depths at the faces of an arc, of cells of a length in m on a pitch radius in m, into balance with
    /// what its cells pull, which depends on their shape; whether that came to an end.
    pub(super) fn settle(
        &mut self,
        depths: &mut [f64],
        [radius, cell]: [f64; 2],
        pull: impl Fn(usize, f64, &Shape) -> Pull,
    ) -> bool {
        let last = depths.len() - 1;
        for _ in 0..MOST_CORRECTIONS {
            self.assemble(depths, [radius, cell], &pull);
            self.matrix.solve(&mut self.side);
            let mut largest: f64 = 0.0;
            for (depth, change) in depths[1..last].iter_mut().zip(&self.side) {
                *depth -= change;
                largest = largest.max(change.abs());
            }
            if largest <= CORRECTION * radius {
                return true;
            }
            if !largest.is_finite() {
                return false;
            }
        }
        false
    }

    /// The derivatives and the balance itself at depths.
    pub(super) fn assemble(
        &mut self,
        depths: &[f64],
        [radius, cell]: [f64; 2],
        pull: impl Fn(usize, f64, &Shape) -> Pull,
    ) {
        let cells = depths.len() - 1;
        self.matrix.clear(cells - 1);
        self.side.clear();
        self.side.resize(cells - 1, 0.0);
        for index in 0..cells {
            let ends = [depths[index], depths[index + 1]];
            let shape = Shape::new(ends, radius, cell);
            let Pull { tractive, outward } = pull(index, 0.5 * (ends[0] + ends[1]), &shape);
            let second = shape.second(radius, cell);
            let block = [0, 1].map(|one| {
                [0, 1].map(|other| {
                    let string = tractive[1] * shape.by[one] * shape.by[other]
                        + tractive[0] * second[one][other];
                    let groove = 0.5 * outward[1] * shape.length + outward[0] * shape.by[other];
                    cell * (string + 0.5 * groove)
                })
            });
            self.matrix.add(index, block);
            let balance = shape
                .by
                .map(|by| cell * (tractive[0] * by + 0.5 * outward[0] * shape.length));
            for (face, value) in [index, index + 1].into_iter().zip(balance) {
                if let Some(row) = face.checked_sub(1).filter(|&row| row < cells - 1) {
                    self.side[row] += value;
                }
            }
        }
    }
}
