//! The arc between the place of rest of a belt and an end of its contact.
//!
//! The belt has the rates of `contact`, with friction along the slip, and the slip `e_t` along the pulley as a state in
//! place of the tension, since it keeps its digits however small it is. Into the place of rest leads one way only; it is
//! integrated backwards, in which all errors decay. From there lead ways of two dimensions, and an exit with a given
//! tension lies on one of them. Backwards from that exit, a belt that leaves too steeply comes from deeper in the groove,
//! where friction along the pulley holds it, and one that leaves too flatly has sunk through the place of rest.

use super::runge_kutta::{Next, Rates};
use super::saddle::{Rim, Saddle};
use crate::vbelt::groove::{ANGLE, INCLINATION, PENETRATION};
use crate::vbelt::{BREAKAWAY, Contact, Regime};

/// Error of a step as a share of the slip. With 1e-5 the slowest of 100 random drives at 1.001 times the slack tension takes 9 s in
/// place of 0.5 s.
const ACCURACY: f64 = 1e-6;
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

/// `e_t`, θ, x and φ, scaled.
type Belt = [f64; 4];

/// A point of an arc, scaled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Arc length from the place where the integration begins.
    pub(super) s: f64,
    /// F, θ, x, φ and the direction γ of the slip in (−π, π].
    pub(super) states: [f64; 5],
    /// Their derivatives with respect to s.
    pub(super) rates: [f64; 5],
    /// As [`Contact::turn_excess`].
    pub(super) turn: f64,
}

impl Rim {
    /// F, θ, x and φ.
    fn states(&self, &[slip, theta, x, phi]: &Belt) -> [f64; 4] {
        let speed = self.omega * (1.0 - x) / (theta.cos() - slip);
        let strand = self.groove.strand;
        let tension = (speed / self.flow - 1.0) / strand.compliance;
        [strand.tractive(tension, self.flow), theta, x, phi]
    }

    fn contact(&self, states: &[f64]) -> Contact<f64> {
        Contact::new(&self.groove, Regime::Slip, states, self.omega, self.flow)
    }

    /// Derivatives of F, θ, x and φ with respect to the arc length.
    fn belt_rates(&self, contact: &Contact<f64>, states: &[f64; 4]) -> [f64; 4] {
        let mut rates = [0.0; 4];
        contact.rates(&self.groove, states, &mut rates);
        rates
    }

    /// Slip along the pulley and up the groove.
    fn slip(&self, belt: &Belt) -> [f64; 2] {
        [belt[0], belt[1].sin() / self.groove.cos_beta]
    }

    fn points(&self, along: Vec<(f64, Belt)>) -> Vec<Point> {
        let point = |(s, belt)| {
            let states = self.states(&belt);
            let contact = self.contact(&states);
            let rates = self.belt_rates(&contact, &states);
            let [slip_t, slip_w] = self.slip(&belt);
            let [rate_t, rate_w] = contact.slip_rates(&self.groove, &rates);
            let direction = slip_t.atan2(slip_w);
            let turning = (slip_w * rate_t - slip_t * rate_w) / (slip_t * slip_t + slip_w * slip_w);
            let with =
                |[tension, theta, x, phi]: [f64; 4], direction| [tension, theta, x, phi, direction];
            Point {
                s,
                states: with(states, direction),
                rates: with(rates, turning),
                turn: contact.turn_excess(&self.groove),
            }
        };
        along.into_iter().map(point).collect()
    }
}

impl Rates<4> for Rim {
    fn rates(&self, belt: &Belt) -> Belt {
        let states = self.states(belt);
        let contact = self.contact(&states);
        let rates = self.belt_rates(&contact, &states);
        let [slip, _] = contact.slip_rates(&self.groove, &rates);
        [slip, rates[INCLINATION], rates[PENETRATION], rates[ANGLE]]
    }

    /// The tension is as accurate as `e_t` over the compliance.
    fn allowed(&self, belt: &Belt) -> Belt {
        let [along, up] = self.slip(belt);
        let slip = along.hypot(up);
        let allowed = [slip.min(self.groove.strand.compliance), slip, slip, 1.0];
        allowed.map(|allowed| ACCURACY * allowed)
    }
}

/// Where a belt comes from that leaves a pulley.
pub(super) struct Origin {
    /// Whether it has sunk through the place of rest.
    pub(super) is_shallow: bool,
    /// How far off the line on which a belt leaves the place of rest it comes by there, as a share of its way from that
    /// place; infinite where it does not come by.
    pub(super) off: f64,
    /// The way there from the exit.
    along: Vec<(f64, Belt)>,
}

/// Arcs begin with short steps, which grow as they may.
impl Saddle {
    /// Ends where the belt leaves the groove, x = 0.
    fn at_surface(&self) -> impl FnMut(&Belt, &Belt) -> Next {
        let nearly = SURFACE * self.depth;
        move |here, there| match [here[2], there[2]] {
            [_, after] if after.abs() <= nearly => Next::End,
            [before, after] if after < 0.0 => Next::Shorter(before / (before - after)),
            _ => Next::Step,
        }
    }

    /// From the entry of the pulley to the neighbourhood of the place of rest.
    pub(super) fn entry(&self) -> Option<Vec<Point>> {
        let straight = 6.0 * STRAIGHT * (1.0 - self.depth) * self.rate / self.turning.powi(2);
        let theta = -(self.rate * NEAR * self.depth).min(straight);
        let start = self.beside([theta, self.turning * theta], 1.0);
        let along = self
            .rim
            .follow(start, -0.1 / self.rate, 2 * MOST_STEPS, self.at_surface())?;
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
        let along = self
            .rim
            .follow(start, first, 2 * MOST_STEPS, self.at_surface())?;
        Some(self.rim.points(along))
    }

    /// Where the belt comes from that leaves the pulley with a tractive tension and an inclination, and slips by about
    /// `slip` as it breaks away.
    pub(super) fn origin(&self, tractive: f64, theta: f64, slip: f64) -> Origin {
        let Rim {
            groove,
            omega,
            flow,
        } = self.rim;
        let speed = groove
            .strand
            .speed(groove.strand.tension(tractive, flow), flow);
        let start = [theta.cos() - omega / speed, theta, 0.0, 0.0];
        let deepest = DEEP * (slip * self.turning).sqrt() * self.depth;
        let (mut is_shallow, mut off, mut steps) = (false, f64::INFINITY, 0);
        let along = self
            .rim
            .follow(start, -1e-3 / self.rate, 2 * MOST_STEPS, |_, there| {
                let [along, up] = self.rim.slip(there);
                let rests = along.hypot(up) < AT_REST * slip;
                let [deeper, theta] = [there[2] - self.depth, there[1]];
                // On that line x − x_P is −θ/λ; backwards what is off it grows.
                let share = self.rate * deeper / theta + 1.0;
                steps += 1;
                is_shallow = match rests {
                    true => share * theta < 0.0,
                    false => up < 0.0 && deeper < 0.0,
                };
                if rests {
                    off = share.abs();
                }
                let is_deep = deeper > deepest;
                match is_shallow || is_deep || rests || steps == MOST_STEPS {
                    true => Next::End,
                    false => Next::Step,
                }
            });
        Origin {
            is_shallow,
            off,
            along: along.unwrap_or_default(),
        }
    }

    /// The arc from an origin to the exit.
    pub(super) fn arc_from(&self, origin: Origin) -> Vec<Point> {
        let mut arc = self.rim.points(origin.along);
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
        ]
    }
}
