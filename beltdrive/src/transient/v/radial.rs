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
    /// 1/g.
    pub(super) per_length: f64,
    /// r/R of the middle.
    pub(super) radius: f64,
    /// Slope ∂x/∂σ.
    pub(super) slope: f64,
    /// Derivatives of g with the depth at the face behind and at that before, 1/m.
    pub(super) by: [f64; 2],
}

/// The cells of an arc, which are of one length.
#[derive(Clone, Copy, Debug)]
pub(super) struct Measure {
    /// Pitch radius R, m.
    pub(super) radius: f64,
    /// Length h of the pitch line in a cell, m.
    pub(super) cell: f64,
    /// Derivative −1/(2 R) of r/R with the depth at either face, 1/m.
    across: f64,
    /// Derivative 1/h of the slope with the depth at the face before, minus that with the depth at the face behind, 1/m.
    along: f64,
}

impl Measure {
    /// Of cells of a length in m on a pitch radius in m.
    pub(super) fn new(radius: f64, cell: f64) -> Self {
        Self {
            radius,
            cell,
            across: -0.5 / radius,
            along: cell.recip(),
        }
    }

    /// Shape of a cell with the depths at its faces in m.
    pub(super) fn shape(&self, [behind, before]: [f64; 2]) -> Shape {
        let radius = 1.0 + self.across * (behind + before);
        let slope = self.along * (before - behind);
        // No depth makes it overflow, as `hypot` would mind.
        let length = (radius * radius + slope * slope).sqrt();
        let per_length = length.recip();
        let across = radius * self.across * per_length;
        let along = slope * self.along * per_length;
        Shape {
            length,
            per_length,
            radius,
            slope,
            by: [across - along, across + along],
        }
    }

    /// Second derivatives of g, 1/m²: twice with the depth at the face behind, with both, twice with that at the face
    /// before.
    fn second(&self, shape: &Shape) -> [f64; 3] {
        let [behind, before] = shape.by;
        let (across, along) = (self.across * self.across, self.along * self.along);
        [
            (across + along - behind * behind) * shape.per_length,
            (across - along - behind * before) * shape.per_length,
            (across + along - before * before) * shape.per_length,
        ]
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

impl Pull {
    /// Of a belt with a tractive tension, and its derivative with g, that lies at a mean depth in m in a groove with a
    /// stiffness in N/m²; one that lies above it is held by nothing.
    pub(super) fn new(tractive: [f64; 2], stiffness: f64, depth: f64) -> Self {
        let stiffness = if depth > 0.0 { stiffness } else { 0.0 };
        Self {
            tractive,
            outward: [stiffness * depth, stiffness],
        }
    }
}

/// A tridiagonal system over the faces of an arc, at the ends of which the unknowns are held at 0.
#[derive(Clone, Debug, Default)]
pub(super) struct Tridiagonal {
    /// Below, on and above the diagonal; those of both ends are not looked at.
    rows: Vec<[f64; 3]>,
    work: Vec<f64>,
}

impl Tridiagonal {
    /// Zeros for a number of faces.
    pub(super) fn new(faces: usize) -> Self {
        Self {
            rows: vec![[0.0; 3]; faces],
            work: vec![0.0; faces],
        }
    }

    /// Takes the entries of another one with as many faces.
    pub(super) fn copy(&mut self, other: &Self) {
        self.rows.copy_from_slice(&other.rows);
    }

    /// Adds to the rows and columns of both faces of a cell.
    pub(super) fn add(&mut self, cell: usize, block: [[f64; 2]; 2]) {
        let [behind, before] = block;
        self.rows[cell][1] += behind[0];
        self.rows[cell][2] += behind[1];
        self.rows[cell + 1][0] += before[0];
        self.rows[cell + 1][1] += before[1];
    }

    /// Solves for a right-hand side in its place.
    pub(super) fn solve(&mut self, side: &mut [f64]) {
        let last = self.rows.len() - 1;
        (side[0], side[last]) = (0.0, 0.0);
        let (mut above, mut before) = (0.0, 0.0);
        let rows = self.rows[1..last].iter().zip(&mut self.work[1..last]);
        for ((row, work), value) in rows.zip(&mut side[1..last]) {
            let per_pivot = (row[1] - row[0] * above).recip();
            above = row[2] * per_pivot;
            before = (*value - row[0] * before) * per_pivot;
            *work = above;
            *value = before;
        }
        let mut next = 0.0;
        for (value, work) in side[1..last].iter_mut().zip(&self.work[1..last]).rev() {
            next = *value - work * next;
            *value = next;
        }
    }
}

/// A correction of the depth of this share of the pitch radius is the last one: Newton's method leaves its square, and
/// the derivatives are right to as much.
const CORRECTION: f64 = 1e-8;

/// Most corrections of the depth; one step of time takes one or two.
const MOST_CORRECTIONS: usize = 30;

/// Room for the radial balance of an arc.
#[derive(Clone, Debug)]
pub(super) struct Balance {
    /// Derivatives of the balance with the depths, at those before the last correction.
    pub(super) matrix: Tridiagonal,
    side: Vec<f64>,
}

impl Balance {
    /// Room for a number of faces.
    pub(super) fn new(faces: usize) -> Self {
        Self {
            matrix: Tridiagonal::new(faces),
            side: vec![0.0; faces],
        }
    }

    /// Brings the depths at the faces of an arc into balance with what its cells pull, which depends on their mean depth
    /// and shape; whether that came to an end.
    pub(super) fn settle(
        &mut self,
        depths: &mut [f64],
        measure: &Measure,
        pull: impl Fn(usize, f64, &Shape) -> Pull,
    ) -> bool {
        for _ in 0..MOST_CORRECTIONS {
            self.assemble(depths, measure, &pull);
            self.matrix.solve(&mut self.side);
            let mut largest: f64 = 0.0;
            for (depth, change) in depths.iter_mut().zip(&self.side) {
                *depth -= change;
                largest = largest.max(change.abs());
            }
            if largest <= CORRECTION * measure.radius {
                // What is not a number in one row is none in any.
                return !depths[1].is_nan();
            }
        }
        false
    }

    /// The derivatives and the balance itself at depths.
    fn assemble(
        &mut self,
        depths: &[f64],
        measure: &Measure,
        pull: &impl Fn(usize, f64, &Shape) -> Pull,
    ) {
        self.matrix.rows.fill([0.0; 3]);
        self.side.fill(0.0);
        for (index, ends) in depths.windows(2).enumerate() {
            let shape = measure.shape([ends[0], ends[1]]);
            let [behind, before] = shape.by;
            let Pull { tractive, outward } = pull(index, 0.5 * (ends[0] + ends[1]), &shape);
            let second = measure.second(&shape);
            let products = [behind * behind, behind * before, before * before];
            let string = [0, 1, 2].map(|of| tractive[1] * products[of] + tractive[0] * second[of]);
            let groove = shape
                .by
                .map(|by| 0.5 * (0.5 * outward[1] * shape.length + outward[0] * by));
            let block = [
                [string[0] + groove[0], string[1] + groove[1]],
                [string[1] + groove[0], string[2] + groove[1]],
            ];
            self.matrix.add(
                index,
                block.map(|row| row.map(|entry| measure.cell * entry)),
            );
            let load = 0.5 * outward[0] * shape.length;
            self.side[index] += measure.cell * (tractive[0] * behind + load);
            self.side[index + 1] += measure.cell * (tractive[0] * before + load);
        }
    }
}
