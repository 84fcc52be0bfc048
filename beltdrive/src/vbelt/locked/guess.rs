//! The guess of a drive whose belt locks on both pulleys.

use super::entry::entering;
use super::exit::slides_along;
use super::pulley::{Course, Pulley, at};
use super::rest::On;
use crate::vbelt::{DRIVEN, DRIVER, DriveProblem, Regime};

/// Points of an arc per mesh interval: the method of the arcs is of order five, collocation of order eight. With three states take
/// 10 % more time, with eight as much.
const POINTS: usize = 5;

/// Accuracy of the displacement of elastic friction where a belt that it held breaks loose: with 1e-6, below what rounding of the
/// steps of its arc makes of it, three more of 30 random drives have no guess, and with 1e-2 zones of guesses are up to 4 % off.
const DISPLACEMENT_ACCURACY: f64 = 1e-3;
/// A correction is to leave less of what is missed than this. What rounding makes of it does not shrink: as long as corrections leave
/// any less the refusal of one drive, which locks at smaller loads, takes 1.6 times as long.
const CONTRACTION: f64 = 0.5;

/// A drive whose belt locks on both pulleys.
pub(in crate::vbelt) struct Locked {
    /// The rim speeds of both pulleys.
    speeds: [f64; 2],
    /// The slip at which it breaks away, on the pulley on which that is smaller.
    slip: f64,
    /// The zones of both pulleys, with the belt along each.
    pulleys: Vec<Vec<(Regime, Course)>>,
}

impl Locked {
    /// The drive of a problem with Coulomb or scalar EPP friction, if its belt locks on both pulleys.
    pub(in crate::vbelt) fn of(problem: &DriveProblem) -> Option<Self> {
        let [slack, tight] = problem.load();
        let [driven, driver] = [DRIVEN, DRIVER].map(|pulley| problem.groove(pulley));
        let on_driver = entering(On::Driver(1.0), driver, tight)?;
        // One arc tells that, the way to the place of rest on the driven pulley takes tens.
        if slides_along(&on_driver.0, slack) {
            return None;
        }
        let flow = on_driver.0.rim.flow;
        let on_driven = entering(On::Driven(flow), driven, slack)?;
        let speeds = [&on_driven, &on_driver].map(|(rest, _)| rest.rim.speed);
        let mut pulleys = [
            Pulley::new(on_driven, tight)?,
            Pulley::new(on_driver, slack)?,
        ];
        // Where friction holds the belt its displacement there depends on the wraps, and they on where the belt leaves.
        let mut before = f64::MAX;
        loop {
            let angles = [DRIVEN, DRIVER].map(|pulley| pulleys[pulley].angles());
            let wraps = problem.layout().wraps(angles);
            let swept = pulleys.iter_mut().zip(wraps);
            let missed: f64 = swept.map(|(pulley, wrap)| pulley.sweep(wrap)).sum();
            if missed <= DISPLACEMENT_ACCURACY {
                let [driven, driver] = &pulleys;
                return Some(Self {
                    speeds,
                    slip: driven.slip().min(driver.slip()),
                    pulleys: vec![driven.zones()?, driver.zones()?],
                });
            }
            if missed.is_nan() || missed > CONTRACTION * before {
                return None;
            }
            before = missed;
            for pulley in &mut pulleys {
                pulley.correct()?;
            }
        }
    }

    /// The smaller one of the slips at which the belt breaks away on both pulleys, scaled.
    pub(in crate::vbelt) fn slip(&self) -> f64 {
        self.slip
    }

    /// The zones of both pulleys.
    pub(in crate::vbelt) fn zones(&self) -> Vec<Vec<Regime>> {
        let regimes = |zones: &Vec<(Regime, Course)>| zones.iter().map(|zone| zone.0).collect();
        self.pulleys.iter().map(regimes).collect()
    }

    fn segments(&self) -> impl Iterator<Item = &Course> {
        self.pulleys.iter().flatten().map(|(_, course)| course)
    }
}

/// The length of a segment.
fn length(course: &Course) -> f64 {
    course[course.len() - 1].s
}

impl bvp::Guess for Locked {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        let course = self
            .segments()
            .nth(segment)
            .expect("a segment for every zone");
        let states = at(course, s * length(course), true).states;
        y.iter_mut().zip(states).for_each(|(y, state)| *y = state);
    }

    fn parameters(&self, p: &mut [f64]) {
        p[DriveProblem::DRIVEN_RIM_SPEED] = self.speeds[DRIVEN];
        p[DriveProblem::DRIVER_RIM_SPEED] = self.speeds[DRIVER];
        let lengths = &mut p[DriveProblem::length_index(0)..];
        for (parameter, course) in lengths.iter_mut().zip(self.segments()) {
            *parameter = length(course);
        }
    }

    fn mesh(&self) -> Option<Vec<Vec<f64>>> {
        let nodes = |course: &Course| {
            let inside = course[..course.len() - 1].iter().step_by(POINTS);
            let nodes = inside.map(|point| point.s / length(course));
            nodes.chain([1.0]).collect()
        };
        Some(self.segments().map(nodes).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vbelt::laws::AtLoad;
    use crate::vbelt::path::Path;
    use crate::vbelt::scaling::tests::{kim, tractive, v_belt};
    use crate::vbelt::{BeltProblem, Scales};
    use crate::{Drive, FrictionLaw, TwoPulleys};

    fn loaded(tight: f64, driven_radius: f64) -> TwoPulleys {
        TwoPulleys {
            load: tractive(100.0, tight),
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
            let speeds = off_by(&guess, p);
            assert!(speeds.iter().all(|off| *off < 1e-6), "{speeds:?}");
            for (pulley, zones) in guess.pulleys.iter().enumerate() {
                let found: f64 = zones.iter().map(|(_, course)| length(course)).sum();
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
            belt: v_belt([0.109_932_6, 487_863.0, 594_450.8, 0.284_936_2]),
            friction_coefficient: 0.233_402_7,
            driver_radius: 0.140_955_4,
            driver_speed: 107.471_95,
            driven_radius: 0.076_843_4,
            centre_distance: 0.576_421_9,
            load: tractive(26.626_23, 26.626_23),
            ..loaded(100.0, 0.25)
        };
        let (_, longest, ..) = off(stiff);
        assert!(longest < 1e-3, "{longest}");
    }

    /// A belt in soft friction, which holds it on both pulleys.
    fn held() -> TwoPulleys {
        TwoPulleys {
            belt: v_belt([0.148_296_9, 35_256.83, 1_086_470.3, 0.241_321_5]),
            friction_coefficient: 0.461_251_2,
            law: FrictionLaw::Epp { stiffness: 2.621e6 },
            driver_radius: 0.182_384_2,
            driver_speed: 53.986_3,
            driven_radius: 0.228_941,
            centre_distance: 0.503_388_3,
            load: tractive(553.489_9, 553.489_9),
        }
    }

    /// How far the rim speeds of a guess are from those of a solution.
    fn off_by(guess: &Locked, p: &[f64]) -> [f64; 2] {
        [DRIVEN, DRIVER].map(|pulley| (guess.speeds[pulley] / p[pulley] - 1.0).abs())
    }

    /// How far the guess of a drive is from its state: the rim speeds, the lengths of the zones, and the Newton steps to it.
    fn off(two: TwoPulleys) -> ([f64; 2], f64, usize, Vec<Vec<Regime>>) {
        let guess = Locked::of(&problem(&two)).unwrap();
        let drive = Drive::from(two);
        let mut path = Path::new(&drive, 1e-6);
        let solved = path.at_locked_load().unwrap();
        assert_eq!(solved.problem.regimes(), guess.zones());
        let p = solved.solution.parameters();
        let lengths = guess.segments().enumerate();
        let lengths = lengths
            .map(|(segment, course)| length(course) / solved.problem.length(segment, p) - 1.0);
        let longest = lengths.map(f64::abs).fold(0.0, f64::max);
        let steps = path.stats.newton_steps;
        (off_by(&guess, p), longest, steps, guess.zones())
    }

    #[test]
    fn elastic_friction_holds_a_belt() {
        let (speeds, longest, steps, zones) = off(held());
        assert!(
            zones
                .iter()
                .all(|zones| zones[..2] == [Regime::Elastic, Regime::Stick]),
            "{zones:?}"
        );
        assert!(speeds.iter().all(|off| *off < 1e-6), "{speeds:?}");
        assert!(longest < 0.03 && steps <= 20, "{longest} {steps}");
    }

    #[test]
    fn a_belt_slides_to_rest_behind_elastic_friction() {
        let stiff = TwoPulleys {
            law: FrictionLaw::Epp { stiffness: 8.1e6 },
            ..loaded(101.0, 0.25)
        };
        let (speeds, longest, steps, zones) = off(stiff);
        let expected = [Regime::Elastic, Regime::Slip, Regime::Slip, Regime::Slip];
        assert!(zones.iter().all(|zones| zones[..] == expected), "{zones:?}");
        assert!(speeds.iter().all(|off| *off < 1e-6), "{speeds:?}");
        assert!(longest < 0.01 && steps <= 25, "{longest} {steps}");
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
