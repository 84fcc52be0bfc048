//! Arcs beside a place at which elastic friction holds the belt.
//!
//! Friction grows along the entry, until it holds the belt as that comes to rest. Where the belt breaks loose friction is more than
//! held it. The belt slips in one direction, in which friction up the groove is what held it, by a slip that grows in
//! proportion to the way; then it begins to rise.

use super::arc::{Belt, DISPLACEMENT, Origin, Point};
use super::rest::{Rest, Rim};
use crate::vbelt::groove::{ANGLE, INCLINATION, LAW, PENETRATION, TENSION};

/// A belt that is brought to rest is integrated from this share of the depth in front of that place: what is neglected of its slip
/// changes the tension by less than this share of the whole change on the way.
const NEAR: f64 = 1e-6;
/// A belt is followed back until λ times the way left to where it was held is this, from where on its slip is in proportion to that
/// way, ...
///
/// With 0.05 the arcs of one of 30 random drives take 1 s, with 1 the states of four more are not found from their integrals.
const WAY_LEFT: f64 = 0.2;
/// ... and until its slip has the direction of that, to this share: with 0.05 those of eight more are not.
const STEADY: f64 = 0.01;
/// Where points lie on the way that is left.
const PLACES_LEFT: [f64; 5] = [0.1, 0.3, 0.5, 0.75, 1.0];
/// The slip at its end as a share of that at its beginning: it is zero there, and has a direction.
const LEAST_SLIP: f64 = 1e-6;
/// A belt that is twice as deep, or half as deep and sinks, does not come by.
const FAR: [f64; 2] = [0.5, 2.0];

/// What is left of the way back to where friction held a belt that slips a little.
pub(super) struct WayLeft {
    length: f64,
    /// The belt there.
    pub(super) rest: Belt,
    /// The share of its slip up the groove on that way.
    up: f64,
}

impl WayLeft {
    /// Points on that way, from the place and the belt at which it begins.
    pub(super) fn points(&self, rim: &Rim, (from, belt): (f64, Belt)) -> Vec<Point> {
        let along = PLACES_LEFT.map(|share| {
            let between = |i: usize| belt[i] + share * (self.rest[i] - belt[i]);
            (from - share * self.length, std::array::from_fn(between))
        });
        let mut points = rim.points(along.to_vec());
        for point in &mut points {
            point.rates[LAW] = 0.0;
        }
        points
    }
}

impl Rest {
    /// A belt that elastic friction is about to hold, and a first step back. Along the pulley friction hardly follows the slip there:
    ///
    /// ```text
    /// de_t/ds = −θ K + 2 q_t c,   K = (F/r − dF/dx) c,   q_t = y μ p e_t/|e|,   |e| = −θ/cos β = a s²/(2 cos β)
    /// e_t = −a K s⁴/(2 (B + 3 |s|)),   B = 4 y μ p c cos β/a
    /// ```
    ///
    /// to first order where |s| is small or large beside B; c is (dV/dF)/V.
    pub(super) fn about_to_be_held(&self) -> (Belt, f64) {
        let Rim { groove, flow, .. } = self.rim;
        let strand = groove.strand;
        let tension = strand.tension(self.tractive, flow);
        let stretching = strand.stretching(tension, strand.speed(tension, flow));
        let elastic = groove.elastic();
        let stiffness = elastic.map_or(0.0, |elastic| elastic.stiffness);
        let bending = 2.0 * stiffness * self.growing().abs() / (self.tractive * groove.cos_beta);
        let back = (6.0 * NEAR * self.depth / bending).cbrt();
        let friction = 2.0 * stiffness * self.displacement.abs();
        let creeping = self.turning * friction * stretching;
        let held_along = 2.0 * friction * stretching * groove.cos_beta / bending;
        let start = [
            -0.5 * bending * creeping * back.powi(4) / (held_along + 3.0 * back),
            -0.5 * bending * back * back,
            self.depth - bending * back.powi(3) / 6.0,
            0.0,
            self.displacement - self.growing() * back,
        ];
        (start, -0.1 * back)
    }

    /// Where friction held the belt that leaves the pulley with a tractive tension, an inclination and a displacement. A belt that
    /// does not come by is told by its slip along the pulley where it began to rise, which is larger the deeper it was, or
    /// else by its depth.
    pub(super) fn held_origin(
        &self,
        [tractive, theta, displacement]: [f64; 3],
        by_slip: bool,
    ) -> Origin {
        let start = self.rim.at_surface(tractive, theta, displacement);
        let (mut rose, mut left, mut rises) = (None, None, true);
        let mut origin = self.origin_of(start, |there| {
            let [along, up] = self.rim.slip(there);
            let depth = there[PENETRATION] / self.depth;
            let rises_again = !rises && up > 0.0;
            rises = up > 0.0;
            if !rises {
                rose.get_or_insert(along);
                let size = self.rim.size_of_slip(there);
                match self.way_left(there) {
                    Ok(way)
                        if way.length * self.rate < WAY_LEFT
                            && (up / size - way.up).abs() < STEADY =>
                    {
                        let deeper = way.rest[PENETRATION] - self.depth;
                        left = Some(way);
                        return Some(deeper / along.abs());
                    }
                    Ok(_) => {}
                    Err(deeper) => return Some(deeper),
                }
            }
            match depth > FAR[1] || by_slip && rises_again {
                true => Some(f64::INFINITY),
                false if depth < FAR[0] && !rises => Some(f64::NEG_INFINITY),
                false => None,
            }
        });
        if let (true, None, Some(along)) = (by_slip, &left, rose) {
            origin.deeper = along.signum() * f64::INFINITY;
        }
        Origin { left, ..origin }
    }

    /// The way back from a belt that slips a little and does not yet rise to where it was held. Where friction is too small to hold
    /// it up or down, by how much the place is deeper than this one: infinite, with its sign.
    fn way_left(&self, there: &Belt) -> Result<WayLeft, f64> {
        let Rim { groove, .. } = self.rim;
        let states = self.rim.states(there);
        let contact = self.rim.contact(&states);
        let tan_beta = groove.sin_beta / groove.cos_beta;
        let held = states[TENSION] / contact.radius - contact.transverse * tan_beta;
        let friction = contact.friction();
        let up = -0.5 * groove.cos_beta * held / friction;
        let along = (1.0 - up * up).sqrt();
        if along.is_nan() || along == 0.0 {
            return Err(-held.signum() * f64::INFINITY);
        }
        let stretching = groove.strand.stretching(contact.tension, contact.speed);
        let slip = there[0];
        let length = slip.abs() / (2.0 * friction * along * stretching);
        let theta = slip.abs() * up / along * groove.cos_beta;
        let mut rest = *there;
        rest[0] = LEAST_SLIP * slip;
        rest[INCLINATION] = LEAST_SLIP * theta;
        rest[PENETRATION] += 0.5 * theta * length;
        rest[ANGLE] -= length / contact.radius;
        rest[DISPLACEMENT] -= self.rim.growing(states[TENSION]) * length;
        Ok(WayLeft { length, rest, up })
    }
}
