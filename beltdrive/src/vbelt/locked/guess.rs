//! The guess of a drive whose belt locks on both pulleys.

use super::arc::{Origin, Point};
use super::saddle::Saddle;
use crate::SpanTension;
use crate::vbelt::groove::{ANGLE, INCLINATION, LAW, PENETRATION, TENSION};
use crate::vbelt::{DRIVEN, DRIVER, DriveProblem, EndAngles, Groove, Regime, beyond_breakaway};
use std::f64::consts::{PI, TAU};

/// Relative accuracy of the tensions at which the belt enters: its slip behind the place of rest is the rest of two
/// tensions that may differ by as little as 1e-7.
const TENSION_ACCURACY: f64 = 1e-9;
/// The most secant steps to that.
const MOST_SECANTS: usize = 20;
/// How far off a belt may come by the place of rest, as [`Origin::off`]: where it comes by is known to a tenth of the slip with
/// which it breaks away, so that the arc is as accurate as a thousandth of that.
const EXIT_ACCURACY: f64 = 0.01;
/// Between these shares of the inclination of a belt that hardly slips as it breaks away lies that at an exit: on the drive of
/// Kim (2009) it is 1.03 of it with 105 N, and 1.6 with 200 N.
const EXITS: [f64; 2] = [0.3, 3.0];
/// A slip at which the direction has one digit in a million: a belt that slips less is taken for one that does not slip.
const NO_SLIP: f64 = 1e-10;
/// The share of friction along the pulley of a belt that follows the groove with the slip at which it breaks away. With
/// more it slides along an arc before it is lifted: on the drive of Kim (2009) Newton's method failed with 0.148.
const SLIDES: f64 = 0.13;
/// λ times the least arc on which the belt is locked: on shorter ones what is left of the entry reaches the exit.
const LOCKED: f64 = 2.0;
/// First step of the places on that arc over 1/λ, and by how much each is longer than the one before.
const STEP: f64 = 0.25;
const LONGER: f64 = 1.3;
/// Points of an arc per mesh interval: the method of the arcs is of order five, collocation of order eight. With three states take
/// 10 % more time, with eight as much.
const POINTS: usize = 5;

/// The belt along a segment, from its beginning.
type Course = Vec<Point>;

/// A drive whose belt locks on both pulleys.
pub(in crate::vbelt) struct Locked {
    driven_speed: f64,
    flow: f64,
    /// The slip at which it breaks away, on the pulley on which that is smaller.
    slip: f64,
    segments: Vec<Course>,
}

/// A pulley, but for the length of the arc on which the belt is locked.
struct Ends {
    saddle: Saddle,
    entry: Vec<Point>,
    exit: Vec<Point>,
    /// The slip at which the belt breaks away.
    slip: f64,
}

impl Locked {
    /// The zones of such a drive: the belt sinks and locks, it breaks away, it is lifted.
    pub(in crate::vbelt) fn zones(regime: Regime) -> [Vec<Regime>; 2] {
        [DRIVEN, DRIVER].map(|_| vec![regime; 3])
    }

    /// The drive of a problem with Coulomb friction, if its belt locks on both pulleys.
    pub(in crate::vbelt) fn of(problem: &DriveProblem) -> Option<Self> {
        let [slack, tight] = problem.load();
        let [driven, driver] = [DRIVEN, DRIVER].map(|pulley| problem.groove(pulley));
        let on_driver = |tractive| Saddle::on_driver(driver, 1.0, tractive);
        let on_driver = entering(on_driver, driver, tight)?;
        let flow = on_driver.0.rim.flow;
        let on_driven = |tractive| Saddle::on_driven(driven, flow, tractive);
        let on_driven = entering(on_driven, driven, slack)?;
        let driven_speed = on_driven.0.rim.omega;
        let pulleys = [leaving(on_driven, tight)?, leaving(on_driver, slack)?];
        let angles = |ends: &Ends| EndAngles {
            entry: ends.entry[0].states[INCLINATION],
            exit: ends.exit[ends.exit.len() - 1].states[INCLINATION],
        };
        let [driven, driver] = &pulleys;
        let wraps = problem.layout().wraps([angles(driven), angles(driver)]);
        let mut segments = Vec::new();
        for (ends, wrap) in pulleys.iter().zip(wraps) {
            segments.extend(ends.segments(wrap)?);
        }
        Some(Self {
            driven_speed,
            flow,
            slip: pulleys
                .iter()
                .map(|ends| ends.slip)
                .fold(f64::INFINITY, f64::min),
            segments,
        })
    }

    /// The smaller one of the slips at which the belt breaks away on both pulleys, scaled.
    pub(in crate::vbelt) fn slip(&self) -> f64 {
        self.slip
    }
}

/// The place of rest of a belt that comes from a span, and the way there.
fn entering(
    saddle: impl Fn(f64) -> Option<Saddle>,
    groove: &Groove,
    span: SpanTension,
) -> Option<(Saddle, Vec<Point>)> {
    let asked = span.value();
    let mut tractive = groove.strand.tractive_of(span, 1.0);
    let mut before: Option<[f64; 2]> = None;
    for _ in 0..MOST_SECANTS {
        let there = saddle(tractive)?;
        let entry = there.entry()?;
        let found = entry[0].states[TENSION];
        let excess = groove.strand.prescribed(span, found, there.rim.flow) - asked;
        if excess.abs() <= TENSION_ACCURACY * asked {
            return Some((there, entry));
        }
        // The tension at the entry is nearly that at the place of rest.
        let slope = before.map_or(1.0, |[other, then]| (excess - then) / (tractive - other));
        before = Some([tractive, excess]);
        tractive -= excess / slope;
    }
    None
}

/// A pulley that the belt leaves into a span, from the place of rest behind its entry.
fn leaving((saddle, entry): (Saddle, Vec<Point>), span: SpanTension) -> Option<Ends> {
    let (groove, flow) = (&saddle.rim.groove, saddle.rim.flow);
    let plain = saddle.plain_exit()?;
    let [_, theta, ..] = plain[plain.len() - 1].states;
    let asked = groove.strand.tractive_of(span, flow);
    let slip = groove.strand.compliance * (asked - plain[plain.len() - 1].states[TENSION]).abs();
    if slip * saddle.turning > SLIDES {
        return None;
    }
    let exit = match slip < NO_SLIP {
        true => plain,
        false => exit(&saddle, asked, theta, slip)?,
    };
    Some(Ends {
        saddle,
        entry,
        exit,
        slip,
    })
}

/// The arc from the place of rest to an exit with a tractive tension, by bisection of the inclination about `theta` there.
fn exit(saddle: &Saddle, tractive: f64, theta: f64, slip: f64) -> Option<Vec<Point>> {
    let [mut low, mut high] = EXITS.map(|share| share * theta);
    let mut nearest: Option<Origin> = None;
    while nearest
        .as_ref()
        .is_none_or(|nearest| nearest.off > EXIT_ACCURACY)
    {
        let middle = 0.5 * (low + high);
        if middle == low || middle == high {
            break;
        }
        let origin = saddle.origin(tractive, middle, slip);
        match origin.is_shallow {
            true => low = middle,
            false => high = middle,
        }
        if nearest
            .as_ref()
            .is_none_or(|nearest| origin.off <= nearest.off)
        {
            nearest = Some(origin);
        }
    }
    nearest
        .filter(|nearest| nearest.off.is_finite())
        .map(|origin| saddle.arc_from(origin))
}

impl Ends {
    /// The segments of the pulley, if a belt that sweeps this angle locks on it.
    fn segments(&self, wrap: f64) -> Option<[Course; 3]> {
        let whole = self.whole(wrap)?;
        let turns = |point: &Point| point.turn;
        let breaks_away = |point: &Point| beyond_breakaway(point.states[LAW]);
        let turn = rise(&whole, turns)?;
        let breakaway = rise(&whole[..turn], breaks_away)?;
        let [first, second] = [
            junction(&whole[breakaway - 1..], breaks_away),
            junction(&whole[turn - 1..], turns),
        ];
        let with = |before: &[Point], between: &[Point], behind: &[Point]| {
            course([before, between, behind].concat())
        };
        Some([
            with(&[], &whole[..breakaway], &[first]),
            with(&[first], &whole[breakaway..turn], &[second]),
            with(&[second], &whole[turn..], &[]),
        ])
    }

    /// The belt along the whole pulley.
    fn whole(&self, wrap: f64) -> Option<Vec<Point>> {
        let Saddle {
            rate,
            depth,
            tractive,
            turning,
            ..
        } = self.saddle;
        let [entry, exit] = [&self.entry, &self.exit].map(|arc| moved(arc, 0.0, 0.0));
        let [enters, leaves] = [entry[entry.len() - 1], exit[0]];
        let last = exit[exit.len() - 1];
        let swept = enters.states[ANGLE] + last.states[ANGLE];
        let locked = (wrap - swept) * (1.0 - depth);
        if locked.is_nan() || locked * rate < LOCKED {
            return None;
        }
        let beside = [enters, leaves].map(|point| {
            let [tension, theta, x, ..] = point.states;
            [tension - tractive, theta, x - depth]
        });
        let mut places = Vec::new();
        let (mut place, mut step) = (STEP / rate, STEP / rate);
        while place < 0.5 * locked {
            places.push(place);
            step *= LONGER;
            place += step;
        }
        let from_exit: Vec<_> = places.iter().rev().map(|place| locked - place).collect();
        places.extend(from_exit);
        // What is left of the entry, and what becomes of the exit.
        let between = places.into_iter().map(|s| {
            let [decayed, grown] = [-rate * s, rate * (s - locked)].map(f64::exp);
            let rest = |i: usize| decayed * beside[0][i] + grown * beside[1][i];
            let rest_rate = |i: usize| rate * (grown * beside[1][i] - decayed * beside[0][i]);
            let mut states = [0.0; LAW + 1];
            states[TENSION] = tractive + rest(0);
            states[INCLINATION] = rest(1);
            states[PENETRATION] = depth + rest(2);
            states[ANGLE] = enters.states[ANGLE] + s / (1.0 - depth);
            states[LAW] = PI - turning * rest(1);
            let mut rates = [0.0; LAW + 1];
            rates[TENSION] = rest_rate(0);
            rates[INCLINATION] = rest_rate(1);
            rates[PENETRATION] = rest_rate(2);
            rates[ANGLE] = 1.0 / (1.0 - depth);
            rates[LAW] = -turning * rest_rate(1);
            Point {
                s: enters.s + s,
                states,
                rates,
                turn: -1.0,
            }
        });
        let mut whole: Vec<_> = entry.iter().copied().chain(between).collect();
        let angle = enters.states[ANGLE] + locked / (1.0 - depth);
        whole.extend(moved(&self.exit, enters.s + locked, angle));
        let mut before = PI;
        for point in &mut whole {
            let direction = &mut point.states[LAW];
            *direction += TAU * ((before - *direction) / TAU).round();
            before = *direction;
        }
        Some(whole)
    }
}

/// An arc that begins at a place and a swept angle.
fn moved(arc: &[Point], s: f64, angle: f64) -> Vec<Point> {
    let first = arc[0];
    let moved = arc.iter().map(|point| {
        let mut moved = *point;
        moved.s += s - first.s;
        moved.states[ANGLE] += angle - first.states[ANGLE];
        moved
    });
    moved.collect()
}

/// The index of the first point behind the last place at which a value rises through zero.
fn rise(points: &[Point], value: impl Fn(&Point) -> f64) -> Option<usize> {
    let rises = |pair: &[Point]| value(&pair[0]) < 0.0 && value(&pair[1]) >= 0.0;
    points.windows(2).rposition(rises).map(|before| before + 1)
}

/// The point between the first two at which a value is zero, linearly.
fn junction(points: &[Point], value: impl Fn(&Point) -> f64) -> Point {
    let [before, after] = [points[0], points[1]];
    let share = value(&before) / (value(&before) - value(&after));
    let between = |before: f64, after: f64| before + share * (after - before);
    let s = between(before.s, after.s);
    Point {
        s,
        states: cubic(&before, &after, s),
        rates: std::array::from_fn(|i| between(before.rates[i], after.rates[i])),
        turn: between(before.turn, after.turn),
    }
}

/// The states at a place between two points, on the cubic with the states and rates there (Hermite).
fn cubic(before: &Point, after: &Point, place: f64) -> [f64; 5] {
    let length = after.s - before.s;
    let share = (place - before.s) / length;
    let rest = 1.0 - share;
    std::array::from_fn(|i| {
        let [from, to] = [before, after].map(|point| point.states[i]);
        let [leaves, arrives] = [before, after].map(|point| length * point.rates[i]);
        let bent = rest * (leaves - (to - from)) - share * (arrives - (to - from));
        rest * from + share * to + share * rest * bent
    })
}

/// The belt along a segment.
fn course(points: Vec<Point>) -> Course {
    moved(&points, 0.0, points[0].states[ANGLE])
}

/// The length of a segment.
fn length(course: &Course) -> f64 {
    course[course.len() - 1].s
}

impl bvp::Guess for Locked {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let course = &self.segments[segment];
        let place = s * length(course);
        let next = course.partition_point(|point| point.s < place);
        let next = next.clamp(1, course.len() - 1);
        let states = cubic(&course[next - 1], &course[next], place);
        y.iter_mut().zip(states).for_each(|(y, state)| *y = state);
    }

    fn parameters(&self, p: &mut [f64]) {
        p[DriveProblem::DRIVEN_SPEED] = self.driven_speed;
        p[DriveProblem::MASS_FLOW] = self.flow;
        let lengths = &mut p[DriveProblem::length_index(0)..];
        for (parameter, course) in lengths.iter_mut().zip(&self.segments) {
            *parameter = length(course);
        }
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        let nodes = |course: &Course| {
            let inside = course[..course.len() - 1].iter().step_by(POINTS);
            let nodes = inside.map(|point| point.s / length(course));
            nodes.chain([1.0]).collect()
        };
        Some(self.segments.iter().map(nodes).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vbelt::laws::AtLoad;
    use crate::vbelt::path::Path;
    use crate::vbelt::scaling::tests::kim;
    use crate::vbelt::{BeltProblem, Scales};
    use crate::{Belt, BeltKind, Drive, FrictionLaw, Load, TwoPulleys, VBelt};

    fn loaded(tight: f64, driven_radius: f64) -> TwoPulleys {
        TwoPulleys {
            load: Load {
                slack: SpanTension::Tractive(100.0),
                tight: SpanTension::Tractive(tight),
            },
            ..kim(FrictionLaw::Coulomb, driven_radius)
        }
    }

    fn problem(drive: &TwoPulleys) -> DriveProblem {
        DriveProblem::new(drive, Scales::new(drive), 1e-8)
    }

    #[test]
    fn it_is_the_state_as_accurately_as_its_arcs_are() {
        for (tight, radius) in [(105.0, 0.25), (101.0, 0.2), (100.0, 0.15)] {
            let two = loaded(tight, radius);
            let guess = Locked::of(&problem(&two)).unwrap();
            let drive = Drive::from(two);
            let mut path = Path::new(&drive, 1e-6);
            let target = path.target();
            // By way of bristles, or a normalised direction.
            let asked = AtLoad {
                drive: &drive,
                tight: target,
            };
            let solved = path.seek(&asked).unwrap();
            let p = solved.solution.parameters();
            let speed = guess.driven_speed / p[DriveProblem::DRIVEN_SPEED] - 1.0;
            let flow = guess.flow / p[DriveProblem::MASS_FLOW] - 1.0;
            assert!(speed.abs() < 1e-6 && flow.abs() < 1e-6, "{speed} {flow}");
            for (pulley, segments) in guess.segments.chunks(3).enumerate() {
                let found: f64 = segments.iter().map(length).sum();
                let off = found / solved.problem.contact_length(pulley, p) - 1.0;
                assert!(off.abs() < 1e-4, "{off}");
            }
        }
    }

    #[test]
    fn the_state_is_a_few_newton_steps_away() {
        // At no load, on both sides of that at which the slip of the turn changes its sense on the driver, and above.
        let steps = [100.0, 100.5, 101.0, 105.0].map(|tight| {
            let drive = Drive::from(loaded(tight, 0.25));
            let mut path = Path::new(&drive, 1e-6);
            path.at_locked_load().unwrap();
            path.stats.newton_steps
        });
        assert!(steps.into_iter().all(|steps| steps <= 16), "{steps:?}");
    }

    #[test]
    fn a_stiff_belt_comes_to_rest_on_a_curve() {
        // S/θ is 4e4: at the entry the way to the place of rest is straight only where friction along the pulley is 2e-4.
        let stiff = TwoPulleys {
            belt: Belt {
                mass_per_length: 0.109_932_6,
                axial_stiffness: 487_863.0,
                kind: BeltKind::V(VBelt {
                    radial_stiffness: 594_450.8,
                    half_angle: 0.284_936_2,
                    height: None,
                }),
                ..loaded(100.0, 0.25).belt
            },
            friction_coefficient: 0.233_402_7,
            driver_radius: 0.140_955_4,
            driver_speed: 107.471_95,
            driven_radius: 0.076_843_4,
            centre_distance: 0.576_421_9,
            load: Load {
                slack: SpanTension::Tractive(26.626_23),
                tight: SpanTension::Tractive(26.626_23),
            },
            ..loaded(100.0, 0.25)
        };
        let guess = Locked::of(&problem(&stiff)).unwrap();
        let drive = Drive::from(stiff);
        let solved = Path::new(&drive, 1e-6).at_locked_load().unwrap();
        let p = solved.solution.parameters();
        for (segment, course) in guess.segments.iter().enumerate() {
            let found = length(course) / solved.problem.length(segment, p);
            assert!((found - 1.0).abs() < 1e-3, "{segment} {found}");
        }
    }

    #[test]
    fn belts_that_slide_along_a_pulley_or_jam_have_none() {
        assert!(Locked::of(&problem(&loaded(106.0, 0.25))).is_some());
        assert!(Locked::of(&problem(&loaded(200.0, 0.25))).is_none());
        let mut jams = loaded(101.0, 0.25);
        jams.friction_coefficient = 4.0;
        assert!(Locked::of(&problem(&jams)).is_none());
    }
}
