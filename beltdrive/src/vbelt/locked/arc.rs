//! The arc between the place of rest of a belt and an end of its contact.
//!
//! The belt has the rates of `contact`, with friction along the slip, and the slip `e_t` along the pulley as a state in
//! place of the tension, since it keeps its digits however small it is. Into the place of rest leads one way only; it is
//! integrated backwards, in which all errors decay. From there lead ways of two dimensions, and an exit with a given
//! tension lies on one of them. Backwards from that exit, a belt that leaves too steeply comes from deeper in the groove,
//! where friction along the pulley holds it, and one that leaves too flatly has sunk through the place of rest.

use super::runge_kutta::{Next, Rates};
use super::saddle::{Rim, Saddle};
use crate::vbelt::groove::{ANGLE, INCLINATION, MAX_STATES, PENETRATION, TENSION};
use crate::vbelt::{BREAKAWAY, Contact, Regime};

/// Error of a step as a share of the slip. On the drive of Kim (2009) with 100.5 N no state is found from the guess with
/// 1e-5.
const ACCURACY: f64 = 1e-6;
/// The most steps from an exit: the nearer a belt is to its place of rest, the stiffer are its equations. Of 36 light loads of
/// stiff belts the states of 8 are not found from the guess with 600, of 22 with 300.
const MOST_STEPS: usize = 1500;
/// A belt that enters is at its place of rest to this share of its penetration, and slides straight down to this share of
/// friction along the pulley: equations about the place of rest are accurate to their squares.
const NEAR: f64 = 0.02;
const STRAIGHT: f64 = 0.05;
/// Share of the slip of a belt that is about to break away, from which on it is at its place of rest.
const AT_REST: f64 = 0.1;

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

    /// Slip along the pulley and up the groove.
    fn slip(&self, belt: &Belt) -> [f64; 2] {
        [belt[0], belt[1].sin() / self.groove.cos_beta]
    }

    fn points(&self, along: Vec<(f64, Belt)>) -> Vec<Point> {
        let point = |(s, belt)| {
            let states = self.states(&belt);
            let [slip_t, slip_w] = self.slip(&belt);
            Point {
                s,
                states: [
                    states[TENSION],
                    states[INCLINATION],
                    states[PENETRATION],
                    states[ANGLE],
                    slip_t.atan2(slip_w),
                ],
                turn: self.contact(&states).turn_excess(&self.groove),
            }
        };
        along.into_iter().map(point).collect()
    }
}

impl Rates<4> for Rim {
    fn rates(&self, belt: &Belt) -> Belt {
        let states = self.states(belt);
        let contact = self.contact(&states);
        let mut rates = [0.0; MAX_STATES];
        let rates = &mut rates[..states.len()];
        contact.rates(&self.groove, &states, rates);
        let [slip, _] = contact.slip_rates(&self.groove, rates);
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
    /// Its least slip before it is lifted.
    pub(super) slip: f64,
    /// The arc from there to the exit.
    pub(super) arc: Vec<Point>,
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
        let theta = -(self.rate * NEAR * self.depth).min(STRAIGHT / self.turning);
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
        let (mut is_shallow, mut steps) = (false, 0);
        let (mut least, mut nearest) = (f64::INFINITY, 0);
        let along = self
            .rim
            .follow(start, -1e-3 / self.rate, 2 * MOST_STEPS, |_, there| {
                let [along, up] = self.rim.slip(there);
                let here = along.hypot(up);
                let rests = here < AT_REST * slip;
                steps += 1;
                is_shallow = (up < 0.0 || rests) && there[2] < self.depth;
                if up < 0.0 && here < least {
                    (least, nearest) = (here, steps);
                }
                match is_shallow || rests || steps == MOST_STEPS {
                    true => Next::End,
                    false => Next::Step,
                }
            });
        let mut along = along.unwrap_or_default();
        along.truncate(nearest + 1);
        along.reverse();
        Origin {
            is_shallow,
            slip: least,
            arc: self.rim.points(along),
        }
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
