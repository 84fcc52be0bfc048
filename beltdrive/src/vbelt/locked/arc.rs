//! The arc between the place of rest of a belt and an end of its contact.
//!
//! The belt has the rates of `contact`, with friction along the slip, and the slip `e_t` along the pulley as a state in
//! place of the tension, since it keeps its digits however small it is. Into the place of rest leads one way only; it is
//! integrated backwards, in which all errors decay. From there lead ways of two dimensions, and an exit with a given
//! tension lies on one of them. Backwards from that exit, a belt that leaves too steeply comes from deeper in the groove,
//! where friction along the pulley holds it, and one that leaves too flatly has sunk through the place of rest.

use super::held::WayLeft;
use super::rest::{Rest, Rim};
use super::runge_kutta::{Next, Rates};
use crate::vbelt::groove::{ANGLE, INCLINATION, LAW, PENETRATION};
use crate::vbelt::zones::{Sample, displacement_felt};
use crate::vbelt::{BREAKAWAY, Contact, Regime, deepening, limit_excess};

/// Error of a step as a share of the slip. With 1e-5 the slowest of 100 random drives at 1.001 times the slack tension takes 9 s in
/// place of 0.5 s.
const ACCURACY: f64 = 1e-6;
/// The tension is at least this much more accurate than to that: with 1 rounding of steps moves the one at an entry by 3e-8,
/// more than is asked of it.
const TENSION_ACCURACY: f64 = 0.01;
/// The most steps from an exit: the nearer a belt is to its place of rest, the stiffer are its equations. Arcs of random drives with
/// a slip of 1e-6 take 60 to 130 steps, one with 1e-9 takes 1240.
const MOST_STEPS: usize = 1500;
/// A belt that enters is at its place of rest to this share of its penetration, ...
const NEAR: f64 = 1e-3;
/// ... and on the straight line x − `x_P` = θ/λ to this share: friction S along the pulley takes S²/2 from that up the groove, so that
/// x − `x_P` is longer by θ (S/θ)²/(6 r λ) of itself at most. With 0.1 the states of 2 of 400 random drives at light loads are not found.
const STRAIGHT: f64 = 0.01;
/// Share of the slip of a belt that is about to break away, from which on it is at its place of rest.
const AT_REST: f64 = 0.1;
/// A belt that leaves the place of rest gets deeper before it is lifted, by 0.02 to 0.12 of √(e S/θ) of the depth there where it breaks
/// away with a slip e. One that is deeper by this share comes from elsewhere: followed on, such took 10 of 35 ms on the drive of
/// Kim (2009) at 101 N.
const DEEP: f64 = 1.0;
/// Depth at which the belt is out of the groove, as a share of that of the place of rest: more than rounding.
const SURFACE: f64 = 1e-9;

/// `e_t`, θ, x, φ and u, scaled.
pub(super) type Belt = [f64; 5];

/// Index of the displacement u in a belt and in the states of normalised slip.
pub(super) const DISPLACEMENT: usize = LAW;

/// A point of an arc, scaled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Arc length from the place where the integration begins.
    pub(super) s: f64,
    /// F, θ, ξ, φ, the direction γ of the slip in (−π, π], and u.
    pub(super) states: [f64; LAW + 2],
    /// Their derivatives with respect to s.
    pub(super) rates: [f64; LAW + 2],
    /// Whether friction holds the belt from here to the next point.
    pub(super) sticks: bool,
}

/// The states of a normalised slip.
pub(super) type States = [f64; DISPLACEMENT + 1];

impl Rim {
    /// F, θ, ξ, φ and u.
    pub(super) fn states(&self, &[slip, theta, x, phi, displacement]: &Belt) -> States {
        let stretch = self.speed * (1.0 - x) / (theta.cos() - slip);
        let strand = self.groove.strand;
        let tension = (stretch - 1.0) / strand.compliance;
        [
            strand.tractive(tension, self.flow),
            theta,
            deepening(self.speed) * x,
            phi,
            displacement,
        ]
    }

    /// A belt at the surface of the groove, with a tractive tension, an inclination and a displacement.
    pub(super) fn at_surface(&self, tractive: f64, theta: f64, displacement: f64) -> Belt {
        let strand = self.groove.strand;
        let strain = strand.strain(strand.tension(tractive, self.flow));
        let slip = theta.cos() - self.speed / (1.0 + strain);
        [slip, theta, 0.0, 0.0, displacement]
    }

    pub(super) fn contact(&self, states: &States) -> Contact<f64> {
        Contact::new(&self.groove, Regime::Either, states, self.speed, self.flow)
    }

    /// Derivatives of F, θ, ξ, φ and u with respect to the arc length.
    fn belt_rates(&self, contact: &Contact<f64>, states: &States) -> States {
        let mut rates = [0.0; DISPLACEMENT + 1];
        contact.rates(&self.groove, states, &mut rates);
        rates
    }

    /// Slip along the pulley and up the groove.
    pub(super) fn slip(&self, belt: &Belt) -> [f64; 2] {
        [belt[0], belt[1].sin() / self.groove.cos_beta]
    }

    pub(super) fn size_of_slip(&self, belt: &Belt) -> f64 {
        let [along, up] = self.slip(belt);
        along.hypot(up)
    }

    pub(super) fn points(&self, along: Vec<(f64, Belt)>) -> Vec<Point> {
        let point = |(s, belt)| {
            let states = self.states(&belt);
            let contact = self.contact(&states);
            let rates = self.belt_rates(&contact, &states);
            let [slip_t, slip_w] = self.slip(&belt);
            let [rate_t, rate_w] = contact.slip_rates(&self.groove, &rates);
            let direction = slip_t.atan2(slip_w);
            let turning = (slip_w * rate_t - slip_t * rate_w) / (slip_t * slip_t + slip_w * slip_w);
            let with = |[tension, theta, deep, phi, displacement]: States, direction| {
                [tension, theta, deep, phi, direction, displacement]
            };
            Point {
                s,
                states: with(states, direction),
                rates: with(rates, turning),
                sticks: false,
            }
        };
        along.into_iter().map(point).collect()
    }

    /// What is seen of a belt at a point of an arc.
    pub(super) fn sample(&self, point: &Point) -> Sample {
        let [tension, theta, deep, phi, direction, displacement] = point.states;
        let states = [tension, theta, deep, phi, displacement];
        let contact = self.contact(&states);
        let limit = limit_excess(&self.groove, Regime::Slip, &states, self.speed, self.flow);
        Sample {
            place: point.s,
            limit,
            displacement: displacement_felt(&self.groove, &states, limit),
            turn: match point.sticks {
                true => -1.0,
                false => {
                    contact.turn_excess(&self.groove) / contact.friction().max(f64::MIN_POSITIVE)
                }
            },
            direction,
            slip: contact.slip_norm,
            sticks: point.sticks,
            gained: 0.0,
            share: 1.0,
        }
    }
}

impl Rates<5> for Rest {
    fn rates(&self, belt: &Belt) -> Belt {
        let states = self.rim.states(belt);
        let contact = self.rim.contact(&states);
        let rates = self.rim.belt_rates(&contact, &states);
        let [slip, _] = contact.slip_rates(&self.rim.groove, &rates);
        [
            slip,
            rates[INCLINATION],
            rates[PENETRATION] / deepening(self.rim.speed),
            rates[ANGLE],
            rates[DISPLACEMENT],
        ]
    }

    /// The tension is as accurate as `e_t` over the compliance.
    fn allowed(&self, belt: &Belt) -> Belt {
        let slip = self.rim.size_of_slip(belt);
        let tension = slip.min(TENSION_ACCURACY * self.rim.groove.strand.compliance);
        let displacement = match self.rim.groove.elastic() {
            Some(_) => self.displacement.abs(),
            None => f64::INFINITY,
        };
        [tension, slip, slip, 1.0, displacement].map(|allowed| ACCURACY * allowed)
    }
}

/// Where a belt comes from that leaves a pulley.
pub(super) struct Origin {
    /// By how much it comes from deeper than the place of rest, infinite where it does not come by: over its way from that place,
    /// and where friction held it there over its slip as it begins to rise.
    pub(super) deeper: f64,
    /// What is left of the way to where friction held it.
    pub(super) left: Option<WayLeft>,
    /// The way there from the exit.
    pub(super) along: Vec<(f64, Belt)>,
}

impl Origin {
    /// Whether the belt was followed for the most steps.
    pub(super) fn is_cut_off(&self) -> bool {
        self.along.len() > MOST_STEPS
    }

    /// The slip along the pulley where it begins to rise.
    pub(super) fn slip(&self) -> f64 {
        self.along[self.along.len() - 1].1[0].abs()
    }

    /// The displacement of elastic friction there.
    pub(super) fn displacement(&self) -> f64 {
        let last = &self.along[self.along.len() - 1].1;
        self.left.as_ref().map_or(last, |left| &left.rest)[DISPLACEMENT]
    }
}

/// Arcs begin with short steps, which grow as they may.
impl Rest {
    /// Ends where the belt leaves the groove, x = 0.
    fn ends_at_surface(&self) -> impl FnMut(&Belt, &Belt) -> Next {
        let nearly = SURFACE * self.depth;
        move |here, there| match [here[2], there[2]] {
            [_, after] if after.abs() <= nearly => Next::End,
            [before, after] if after < 0.0 => Next::Shorter(before / (before - after)),
            _ => Next::Step,
        }
    }

    /// From the entry of the pulley to the neighbourhood of the place of rest.
    pub(super) fn entry(&self) -> Option<Vec<Point>> {
        let (start, first) = match self.is_held {
            true => self.about_to_be_held(),
            false => {
                let straight =
                    6.0 * STRAIGHT * (1.0 - self.depth) * self.rate / self.turning.powi(2);
                let theta = -(self.rate * NEAR * self.depth).min(straight);
                let start = self.beside([theta, self.turning * theta], 1.0);
                (start, -0.1 / self.rate)
            }
        };
        let along = self.follow(start, first, 2 * MOST_STEPS, self.ends_at_surface())?;
        let mut points = self.rim.points(along);
        points.reverse();
        Some(points)
    }

    /// From the place of rest to the exit of a belt that hardly slips as it breaks away.
    pub(super) fn plain_exit(&self) -> Option<Vec<Point>> {
        // So near to that place that the slip is nothing beside any that matters.
        let theta = -1e-6 * BREAKAWAY / self.turning;
        let start = self.beside([theta, BREAKAWAY], -1.0);
        let first = -0.01 * theta / self.rate;
        let along = self.follow(start, first, 2 * MOST_STEPS, self.ends_at_surface())?;
        Some(self.rim.points(along))
    }

    /// Where the belt comes from that leaves the pulley with a tractive tension and an inclination, and slips by about
    /// `slip` as it breaks away.
    pub(super) fn origin(&self, tractive: f64, theta: f64, slip: f64) -> Origin {
        let deepest = DEEP * (slip * self.turning).sqrt() * self.depth;
        let start = self.rim.at_surface(tractive, theta, self.displacement);
        self.origin_of(start, |there| {
            let [_, up] = self.rim.slip(there);
            let [deeper, theta] = [there[2] - self.depth, there[1]];
            if self.rim.size_of_slip(there) < AT_REST * slip {
                // On the line on which a belt leaves it x − x_P is −θ/λ; backwards what is off it grows.
                return Some((self.rate * deeper / theta + 1.0) * theta.signum());
            }
            match (up < 0.0 && deeper < 0.0, deeper > deepest) {
                (true, _) => Some(f64::NEG_INFINITY),
                (_, true) => Some(f64::INFINITY),
                _ => None,
            }
        })
    }

    /// Follows a belt back from an exit until it is known by how much it comes from deeper.
    pub(super) fn origin_of(
        &self,
        start: Belt,
        mut known: impl FnMut(&Belt) -> Option<f64>,
    ) -> Origin {
        let (mut deeper, mut steps) = (f64::INFINITY, 0);
        let along = self.follow(start, -1e-3 / self.rate, 2 * MOST_STEPS, |_, there| {
            steps += 1;
            match known(there) {
                Some(found) => {
                    deeper = found;
                    Next::End
                }
                None if steps == MOST_STEPS => Next::End,
                None => Next::Step,
            }
        });
        Origin {
            deeper,
            left: None,
            along: along.unwrap_or_else(|| vec![(0.0, start)]),
        }
    }

    /// The arc from an origin to the exit.
    pub(super) fn arc_from(&self, origin: Origin) -> Vec<Point> {
        let last = origin.along[origin.along.len() - 1];
        let mut arc = self.rim.points(origin.along);
        if let Some(left) = origin.left {
            arc.append(&mut left.points(&self.rim, last));
        }
        arc.reverse();
        arc
    }

    /// A sinking belt with an inclination and a share of friction along the pulley, on the line on which it nears the
    /// place of rest (1) or leaves it (−1).
    fn beside(&self, [theta, share]: [f64; 2], side: f64) -> Belt {
        let up = theta.sin() / self.rim.groove.cos_beta;
        let slip = -up / (1.0 - share * share).sqrt();
        [
            share * slip,
            theta,
            self.depth + side * theta / self.rate,
            0.0,
            self.displacement,
        ]
    }
}
