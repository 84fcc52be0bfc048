//! A belt without friction on its way into a groove, and out of it.
//!
//! Without friction F − k tan β x²/2 and the moment F r cos θ do not change along the contact. With both
//! the inclination follows from the depth, and the belt approaches the depth x* at which it runs along a
//! circle: with w = x* − x, in units of R and of the tension of the span,
//!
//! ```text
//! g = F r = g* + K w² (1 − 3 x* + w)/2        K x* (1 − x*) = 1 + K x*²/2,   K = k tan β R²/T
//! cos θ = g*/g                                dw/ds = −|sin θ|
//! ```
//!
//! This holds up to what is left of w in the middle of the contact, e^(−λΦ/2) of it.

use super::super::Groove;

/// Steps over the layer, each of this part of a decay of w: Runge and Kutta's fourth order leaves 1e-6.
const STEPS_PER_DECAY: f64 = 8.0;
const STEPS: usize = 120;

/// A point of the layer.
#[derive(Clone, Copy, Debug)]
struct Point {
    s: f64,
    /// ln w.
    left: f64,
    angle: f64,
}

/// The layer where a belt enters a groove; where it leaves it is the mirror image.
#[derive(Clone, Debug)]
pub(super) struct Seating {
    stiffness: f64,
    tension: f64,
    /// Depth x* on which the belt settles.
    depth: f64,
    /// g*.
    moment: f64,
    points: Vec<Point>,
}

impl Seating {
    /// Of a belt with a scaled tension, if the groove carries it.
    pub(super) fn new(groove: &Groove, tension: f64) -> Option<Self> {
        let share = tension / groove.largest_tension();
        let stiffness = 6.0 / share;
        let root = 1.0 - share;
        if root.is_nan() || root <= 0.0 {
            return None;
        }
        let depth = (1.0 - root.sqrt()) / 3.0;
        let moment = (1.0 + 0.5 * stiffness * depth * depth) * (1.0 - depth);
        let mut seating = Self {
            stiffness,
            tension,
            depth,
            moment,
            points: Vec::with_capacity(STEPS + 1),
        };
        let decay = -seating.rates(f64::MIN_POSITIVE.ln())[0];
        let step = 1.0 / (STEPS_PER_DECAY * decay);
        let mut here = Point {
            s: 0.0,
            left: depth.ln(),
            angle: 0.0,
        };
        seating.points.push(here);
        for _ in 0..STEPS {
            let mut slopes = [[0.0; 2]; 4];
            for stage in 0..4 {
                let ahead = [0.0, 0.5, 0.5, 1.0][stage] * step;
                let before = slopes[stage.saturating_sub(1)][0];
                slopes[stage] = seating.rates(here.left + ahead * before);
            }
            let mean = |axis: usize| {
                let [a, b, c, d] = slopes.map(|slope| slope[axis]);
                (a + 2.0 * b + 2.0 * c + d) / 6.0
            };
            here.s += step;
            here.left += step * mean(0);
            here.angle += step * mean(1);
            seating.points.push(here);
        }
        Some(seating)
    }

    /// 1 − cos θ and sin θ at ln w.
    fn inclination(&self, left: f64) -> [f64; 2] {
        let w = left.exp();
        let gained = 0.5 * self.stiffness * w * w * (1.0 - 3.0 * self.depth + w);
        let versine = gained / (self.moment + gained);
        [versine, -(versine * (2.0 - versine)).sqrt()]
    }

    /// d(ln w)/ds and dφ/ds at ln w.
    fn rates(&self, left: f64) -> [f64; 2] {
        let w = left.exp();
        let [versine, _] = self.inclination(left);
        // sin θ/w, which has a limit for w → 0.
        let gained = 0.5 * self.stiffness * (1.0 - 3.0 * self.depth + w);
        let per_depth = (gained / (self.moment + gained * w * w) * (2.0 - versine)).sqrt();
        [-per_depth, (1.0 - versine) / (1.0 - self.depth + w)]
    }

    /// Inclination where the belt enters, rad; negative.
    pub(super) fn entry(&self) -> f64 {
        let [versine, sine] = self.inclination(self.depth.ln());
        sine.atan2(1.0 - versine)
    }

    /// Length of a contact on which the belt sweeps an angle, in units of R.
    pub(super) fn length(&self, swept: f64) -> f64 {
        let half = 0.5 * swept;
        let after = self.points.partition_point(|point| point.angle < half);
        let share = |a: Point, b: Point| a.s + (half - a.angle) / (b.angle - a.angle) * (b.s - a.s);
        let reached = match (
            after.checked_sub(1).map(|i| self.points[i]),
            self.points.get(after),
        ) {
            (Some(before), Some(&after)) => share(before, after),
            (Some(last), None) => last.s + (half - last.angle) * (1.0 - self.depth),
            (None, _) => 0.0,
        };
        2.0 * reached
    }

    /// F, θ, x and φ at a place of a contact of this length, on which the belt sweeps an angle.
    pub(super) fn state(&self, s: f64, length: f64, swept: f64) -> [f64; 4] {
        let is_entry = s <= 0.5 * length;
        let place = if is_entry { s } else { length - s };
        let after = self.points.partition_point(|point| point.s < place).max(1);
        let [left, angle] = match self.points.get(after) {
            Some(b) => {
                let a = self.points[after - 1];
                let share = (place - a.s) / (b.s - a.s);
                [
                    a.left + share * (b.left - a.left),
                    a.angle + share * (b.angle - a.angle),
                ]
            }
            None => {
                let last = self.points[self.points.len() - 1];
                let [decay, sweep] = self.rates(last.left);
                [
                    last.left + decay * (place - last.s),
                    last.angle + sweep * (place - last.s),
                ]
            }
        };
        let [versine, sine] = self.inclination(left);
        let depth = self.depth - left.exp();
        let theta = sine.atan2(1.0 - versine);
        let force = self.tension * (1.0 + 0.5 * self.stiffness * depth * depth);
        match is_entry {
            true => [force, theta, depth, angle],
            false => [force, -theta, depth, swept - angle],
        }
    }
}
