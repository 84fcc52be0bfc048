//! The rate of the depth of an arc: the derivative of the radial balance with time.
//!
//! In the balance stand the depths, the tractive tension and the bristles, the rates of which depend on that of the
//! depths. With J the derivatives of the balance with the depths, ẋ at the faces and s its mean in a cell,
//!
//! ```text
//! 0 = J ẋ + Σ h Ḟ ∂g/∂x + Σ ½ h g (∂n/∂B_w) Ḃ_w
//! Ḟ = (∂F/∂a) ȧ − m ρ (v₋ v̇₋ + v₊ v̇₊)             v̇ = v̇₀ − ½ v Σ ρ ġ h/(â h̄)       ġ = (∂g/∂x) ẋ
//! Ḃ_w = c + κ (e_w − |e| B_w/μ)                    e_w = e₀ − s/cos β
//! ```
//!
//! Newton's method on one tridiagonal system takes |e| from its tangent, and v̇ from the last ẋ: what that leaves of a
//! correction is 2 m v²/EA of it at most, as Σ m ρ v² ρ ġ h stands beside EA ġ/a in J ẋ. There are spans
//! between the arcs, so that each arc is by itself.

use super::radial::Tridiagonal;

/// What the rate of the depth of an arc depends on in a cell.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Drawn {
    /// Derivatives of g with the depths at both faces, 1/m.
    pub(super) by: [f64; 2],
    /// Unstretched length ρ h per g, m.
    pub(super) belt: f64,
    /// Rate h Ḟ with v̇₀ for v̇, N·m/s.
    pub(super) drawing: f64,
    /// Its part m ρ h per v² there, kg.
    pub(super) inertia: f64,
    /// ½ h g ∂n/∂`B_w`, N.
    pub(super) pressed: f64,
    /// Rate of `B_w` without that of slip, 1/s.
    pub(super) carried: f64,
    /// Slip `e_t` and that e₀ up the groove faces of a belt that does not sink, m/s.
    pub(super) slip: [f64; 2],
    /// `B_w`/μ.
    pub(super) bent: f64,
}

/// What the cells of an arc have in common.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// Stiffness κ of the bristles, 1/m.
    pub(super) stiffness: f64,
    /// 1/cos β.
    pub(super) per_cosine: f64,
    /// Share of a correction that is left by its v̇ at most.
    pub(super) moved: f64,
    /// Error that is allowed, m/s.
    pub(super) error: f64,
}

/// Most corrections; they take one or two.
const MOST_CORRECTIONS: usize = 30;

/// Velocity that keeps the derivative of the slip |e| finite where the belt does not slip, m/s.
const GUARD: f64 = 1e-20;

/// Size |e| of a slip, m/s.
pub(super) fn size(slip: [f64; 2]) -> f64 {
    (slip[0] * slip[0] + slip[1] * slip[1] + GUARD * GUARD).sqrt()
}

/// The rate of the depth of an arc.
#[derive(Clone, Debug)]
pub(super) struct Sinking {
    /// ẋ at the faces, m/s.
    pub(super) rate: Vec<f64>,
    matrix: Tridiagonal,
    side: Vec<f64>,
    /// ρ ġ h of the cells, between zeros for the spans, m/s.
    lengthening: Vec<f64>,
    /// |e| − `e_w` `B_w`/μ of the cells at the last correction, m/s.
    following: Vec<f64>,
    /// The rate at an earlier time, and the time from then to the last one, s.
    before: Vec<f64>,
    passed: f64,
}

/// Times closer than this share of the last difference are one: they are equal but for rounding, or so close to each other
/// that the rate does not change.
const SAME_TIME: f64 = 1e-3;

impl Sinking {
    /// None at a number of faces.
    pub(super) fn new(faces: usize) -> Self {
        Self {
            rate: vec![0.0; faces],
            matrix: Tridiagonal::new(faces),
            side: vec![0.0; faces],
            lengthening: vec![0.0; faces + 1],
            following: vec![0.0; faces - 1],
            before: vec![0.0; faces],
            passed: 0.0,
        }
    }

    /// Takes rate and depths on over a time in s as they changed before.
    pub(super) fn go_on(&mut self, passed: f64, depths: &mut [f64]) {
        if passed <= SAME_TIME * self.passed {
            return;
        }
        let ahead = match self.passed > 0.0 {
            true => passed / self.passed,
            false => 0.0,
        };
        self.passed = passed;
        let rates = self.rate.iter_mut().zip(&mut self.before);
        for (depth, (rate, before)) in depths.iter_mut().zip(rates) {
            let change = ahead * (*rate - *before);
            *depth += passed * (*rate + 0.5 * change);
            *before = *rate;
            *rate += change;
        }
    }

    /// Finds the rate from the last one, with the derivatives of the balance, the cells, and v in m/s and ½ v/(â h̄) in
    /// 1/s at the faces.
    pub(super) fn find(
        &mut self,
        balance: &Tridiagonal,
        cells: &[Drawn],
        faces: [&[f64]; 2],
        contact: &Contact,
    ) {
        for _ in 0..MOST_CORRECTIONS {
            self.matrix.copy(balance);
            self.assemble(cells, faces, contact);
            self.matrix.solve(&mut self.side);
            // From here on the side is the correction.
            let mut largest: f64 = 0.0;
            for (rate, side) in self.rate.iter_mut().zip(&mut self.side) {
                (*side, *rate) = (*side - *rate, *side);
                largest = largest.max(side.abs());
            }
            if largest <= contact.error || self.is_straight(largest, cells, contact) {
                break;
            }
        }
    }

    /// Whether what the last correction, the largest of a size in m/s, has left by v̇ and by |e| is no error: with `e_w`
    /// |e| has a second derivative of 1/|e| at most.
    fn is_straight(&self, largest: f64, cells: &[Drawn], contact: &Contact) -> bool {
        let left = contact.error - contact.moved * largest;
        let changes = self.side.windows(2).map(|ends| 0.5 * (ends[0] + ends[1]));
        let mut parts = changes.zip(cells).zip(&self.following);
        parts.all(|((change, cell), following)| {
            let bent = 0.5 * contact.per_cosine * cell.bent.abs();
            bent * change * change <= left * following
        })
    }

    /// Adds what the cells depend on to the derivatives, and makes the right-hand side for ẋ.
    fn assemble(&mut self, cells: &[Drawn], faces: [&[f64]; 2], contact: &Contact) {
        let rate = &self.rate[..=cells.len()];
        let lengthening = &mut self.lengthening[..cells.len() + 2];
        for (index, cell) in cells.iter().enumerate() {
            let grows = cell.by[0] * rate[index] + cell.by[1] * rate[index + 1];
            lengthening[index + 1] = cell.belt * grows;
        }
        self.side.fill(0.0);
        let side = &mut self.side[..=cells.len()];
        let [velocity, slowing] = faces.map(|faces| &faces[..=cells.len()]);
        let following = &mut self.following[..cells.len()];
        for (index, cell) in cells.iter().enumerate() {
            let around = [index, index + 1].map(|face| {
                velocity[face] * slowing[face] * (lengthening[face] + lengthening[face + 1])
            });
            let drawing = cell.drawing + cell.inertia * (around[0] + around[1]);
            let sinks = 0.5 * (rate[index] + rate[index + 1]);
            let up = cell.slip[1] - sinks * contact.per_cosine;
            let norm = size([cell.slip[0], up]);
            following[index] = norm - up * cell.bent;
            let bends = cell.carried + contact.stiffness * (up - norm * cell.bent);
            let by_sinking = -contact.stiffness * contact.per_cosine * following[index] / norm;
            let bent = cell.pressed * (bends - by_sinking * sinks);
            side[index] -= drawing * cell.by[0] + bent;
            side[index + 1] -= drawing * cell.by[1] + bent;
            let entry = 0.5 * cell.pressed * by_sinking;
            self.matrix.add(index, [[entry; 2]; 2]);
        }
    }
}
