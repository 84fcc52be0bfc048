//! A drive with two pulleys by its numbers.

use super::Drive;
use super::closure::{Closure, Load};
use super::layout::{Sense, Side};
use super::pulley::{Duty, Mount, Pulley};
use crate::{Belt, FrictionLaw};

/// An open belt round a driver and a driven pulley, closed by the tensions of both spans: the numbers that
/// decide its steady state.
///
/// [`Drive::two_pulleys`] gives those of a drive. The drive of such numbers has its driver at the origin and the
/// driven pulley to the right of it, and its belt runs counter-clockwise: the slack span leaves the driver below.
///
/// ```
/// use beltdrive::{
///     Belt, BeltKind, Drive, FrictionLaw, Load, NormalForce, SolveOptions, SpanTension, TwoPulleys, solve,
/// };
///
/// let numbers = TwoPulleys {
///     belt: Belt {
///         mass_per_length: 0.25,
///         axial_stiffness: 150e3,
///         kind: BeltKind::Flat { normal_force: NormalForce::Inertia },
///         ribs: 1,
///     },
///     friction_coefficient: 0.5,
///     law: FrictionLaw::Coulomb,
///     driver_radius: 0.1,
///     driver_speed: 150.0,
///     driven_radius: 0.1,
///     centre_distance: 0.7,
///     load: Load {
///         slack: SpanTension::Belt(300.0),
///         tight: SpanTension::DrivenTorque(40.0),
///     },
/// };
/// let drive = Drive::from(numbers);
/// assert_eq!(drive.two_pulleys(), Some(numbers));
/// let state = solve(&drive, &SolveOptions::default())?;
/// assert!(state.driven.angular_speed < 150.0 && state.tight_tension > 700.0);
/// # Ok::<(), beltdrive::SolveError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoPulleys {
    /// The belt.
    pub belt: Belt,
    /// Coefficient of friction μ > 0 between belt and pulleys.
    pub friction_coefficient: f64,
    /// How friction depends on slip.
    pub law: FrictionLaw,
    /// Pitch radius of the driver, m.
    pub driver_radius: f64,
    /// Angular speed ω₂ of the driver, rad/s; positive.
    pub driver_speed: f64,
    /// Pitch radius of the driven pulley, m.
    pub driven_radius: f64,
    /// Distance between the pulley centres, m; greater than the sum of the radii.
    pub centre_distance: f64,
    /// The tensions that close the drive.
    pub load: Load,
}

impl From<TwoPulleys> for Drive {
    fn from(two: TwoPulleys) -> Self {
        let pulley = |name, x, radius, duty| {
            Pulley::new(name, [x, 0.0], radius, two.friction_coefficient, duty)
        };
        Self {
            title: None,
            belt: two.belt,
            law: two.law,
            sense: Sense::CounterClockwise,
            turning_number: 1,
            pulleys: vec![
                pulley(
                    "driver",
                    0.0,
                    two.driver_radius,
                    Duty::Driver(two.driver_speed),
                ),
                pulley(
                    "driven",
                    two.centre_distance,
                    two.driven_radius,
                    Duty::Driven,
                ),
            ],
            closure: Closure::BothSpans(two.load),
        }
    }
}

impl Drive {
    /// The numbers of this drive, if it is closed by the tensions of both spans: it then has two pulleys at fixed
    /// centres, both inside the loop, with one coefficient of friction and the groove of the belt.
    pub fn two_pulleys(&self) -> Option<TwoPulleys> {
        let (Closure::BothSpans(load), [one, other]) = (self.closure, &self.pulleys[..]) else {
            return None;
        };
        let (driver, driven, driver_speed) = match (one.duty, other.duty) {
            (Duty::Driver(speed), Duty::Driven) => (one, other, speed),
            (Duty::Driven, Duty::Driver(speed)) => (other, one, speed),
            _ => return None,
        };
        let (Mount::Fixed(here), Mount::Fixed(there)) = (driver.mount, driven.mount) else {
            return None;
        };
        let is_plain = |pulley: &Pulley| pulley.side == Side::Inside && pulley.half_angle.is_none();
        let friction_coefficient = driver.friction_coefficient;
        let is_open = self.turning_number == 1
            && is_plain(driver)
            && is_plain(driven)
            && driven.friction_coefficient == friction_coefficient;
        is_open.then(|| TwoPulleys {
            belt: self.belt,
            friction_coefficient,
            law: self.law,
            driver_radius: driver.radius,
            driver_speed,
            driven_radius: driven.radius,
            centre_distance: (there[0] - here[0]).hypot(there[1] - here[1]),
            load,
        })
    }

    /// Gives a drive that has such numbers other ones: the driven pulley moves along the line of centres.
    pub(crate) fn set_two_pulleys(&mut self, two: TwoPulleys) {
        let driver = self.driver();
        let centre = |pulley: &Pulley| match pulley.mount {
            Mount::Fixed(centre) => centre,
            Mount::Tensioner(_) => [f64::NAN; 2],
        };
        let [here, there] = [driver, 1 - driver].map(|pulley| centre(&self.pulleys[pulley]));
        let [x, y] = [there[0] - here[0], there[1] - here[1]];
        self.belt = two.belt;
        self.law = two.law;
        self.closure = Closure::BothSpans(two.load);
        for pulley in &mut self.pulleys {
            pulley.friction_coefficient = two.friction_coefficient;
            (pulley.radius, pulley.duty) = match pulley.duty {
                Duty::Driver(_) => (two.driver_radius, Duty::Driver(two.driver_speed)),
                duty => (two.driven_radius, duty),
            };
        }
        let distance = x.hypot(y);
        if two.centre_distance != distance {
            let along = |part: f64| part / distance * two.centre_distance;
            let at = [here[0] + along(x), here[1] + along(y)];
            self.pulleys[1 - driver].mount = Mount::Fixed(at);
        }
    }

    /// The same drive with other tensions of both spans.
    pub(crate) fn with_load(&self, load: Load) -> Self {
        Self {
            closure: Closure::BothSpans(load),
            ..self.clone()
        }
    }

    /// A loop as the drive with two pulleys that it is with these tensions of both spans: if it is one but for its closure, and the
    /// driven pulley takes power.
    pub(crate) fn closed_by(&self, load: Load) -> Option<Self> {
        let [_, _] = &self.pulleys[..] else {
            return None;
        };
        let mut drive = self.with_load(load);
        drive.pulleys[1 - self.driver()].duty = Duty::Driven;
        let takes_power = load.slack.value() <= load.tight.value();
        (takes_power && drive.two_pulleys().is_some()).then_some(drive)
    }

    /// As [`Drive::two_pulleys`].
    ///
    /// # Panics
    /// If it is none of them: what is asked of two pulleys is only asked where they are.
    pub(crate) fn pair(&self) -> TwoPulleys {
        self.two_pulleys()
            .expect("two pulleys, closed by the tensions of both spans")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flat::ClosedForm;
    use crate::results::samples::flat;
    use crate::{Role, SpanTension};

    fn drive() -> Drive {
        flat::epp().drive
    }

    /// The same drive elsewhere in the plane, begun at its driven pulley.
    fn elsewhere() -> Drive {
        let mut drive = drive();
        let distance = drive.pair().centre_distance;
        let [x, y] = [1.0 + 0.6 * distance, 2.0 - 0.8 * distance];
        drive.pulleys[0].mount = Mount::Fixed([1.0, 2.0]);
        drive.pulleys[1].mount = Mount::Fixed([x, y]);
        drive.pulleys.rotate_left(1);
        drive
    }

    #[test]
    fn the_place_of_a_drive_and_where_it_begins_do_not_matter() {
        let [one, other] = [drive(), elsewhere()].map(|drive| drive.pair());
        let distance = one.centre_distance;
        assert!((other.centre_distance / distance - 1.0).abs() < 1e-14);
        assert_eq!(one.driver_radius, other.driver_radius);
        let speeds = [drive(), elsewhere()].map(|drive| {
            let two_pulleys = ClosedForm::new(&drive).unwrap();
            let as_loop = crate::belt_loop::solve(&drive).unwrap();
            let driven = &as_loop.pulleys[1 - drive.driver()];
            [
                two_pulleys.angular_speed(Role::Driven),
                driven.angular_speed,
            ]
        });
        let known = speeds[0][0];
        for speed in speeds.concat() {
            assert!((speed / known - 1.0).abs() < 1e-12, "{speeds:?}");
        }
    }

    #[test]
    fn other_numbers_move_the_driven_pulley_along_the_line_of_centres() {
        for mut drive in [drive(), elsewhere()] {
            let mut two = drive.pair();
            drive.set_two_pulleys(two);
            assert_eq!(drive.pair(), two);
            two.centre_distance *= 2.0;
            two.driven_radius *= 1.5;
            two.load.tight = SpanTension::DrivenTorque(7.0);
            drive.set_two_pulleys(two);
            let found = drive.pair();
            assert!((found.centre_distance / two.centre_distance - 1.0).abs() < 1e-14);
            assert_eq!(found.driven_radius, two.driven_radius);
            assert_eq!(found.load, two.load);
        }
    }

    #[test]
    fn only_an_open_belt_round_a_driver_and_a_driven_pulley_has_them() {
        let changes: [fn(&mut Drive); 6] = [
            |drive| drive.turning_number = 0,
            |drive| drive.closure = Closure::SetupTension(100.0),
            |drive| drive.pulleys[1].side = Side::Outside,
            |drive| drive.pulleys[1].friction_coefficient *= 2.0,
            |drive| drive.pulleys[0].half_angle = Some(0.3),
            |drive| drive.pulleys[1].duty = Duty::Torque(1.0),
        ];
        assert!(drive().two_pulleys().is_some());
        for change in changes {
            let mut drive = drive();
            change(&mut drive);
            assert_eq!(drive.two_pulleys(), None);
            // What closes it is not the tensions of both spans, or they do not.
            assert!(crate::solve(&drive, &crate::SolveOptions::default()).is_err());
        }
    }
}
