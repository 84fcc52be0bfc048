//! A V-belt drive in, a steady state or the reason why there is none out.

use super::BeltProblem;
use super::by_branch::{by_branch, is_led_from_rest};
use super::found::{carried, checked, pressed_through_without_states};
use super::limit::{Found, may_be_another};
use super::path::{ForError, Path, Stuck};
use crate::{Drive, FrictionLaw, SolveError, SolveOptions, SteadyState};
use std::mem::discriminant;
use web_time::Instant;

/// The steady state of a V-belt drive, from nothing but the drive: at its own load if it is found there, else along the
/// branch that leads there or to the limit of the load. Where there is no such branch, from states near the load.
///
/// Scalar elastic friction may have several states under one load. Where the one at its own load is found only with a normalised
/// direction, or its friction is reversed where the belt comes to rest and stays so, that to which the branch of the load leads takes
/// its place, if it leads there. One random drive has two states from 307 to 322 N, of which that with reversed friction is found
/// first; it is 0.4 % faster, and loads of 1.5 to 3 times the slack tension lead to the other one. Where it is reversed back behind
/// that place the same state is found along the branch: of 61 random drives seven, which would take 2 to 20 times the time.
pub(crate) fn solve(drive: &Drive, options: &SolveOptions) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let tolerance = options.tolerance;
    let mut path = Path::new(drive, tolerance).with_meshes(ForError::Answers);
    let is_elastic = matches!(drive.law, FrictionLaw::Epp { .. });
    // Whether a state that is known stays the answer where no branch leads to the load.
    let mut stays = false;
    let direct = match path.at_load(path.target()) {
        Ok(solved) if solved.driven_speed() > 0.0 && path.is_before_limit(&solved) => {
            let is_sure = !may_be_another(&solved)
                || path.is_reached(&solved)
                || is_led_from_rest(&mut path, &solved);
            let problem = &solved.problem;
            let may_be_one_of_two =
                is_elastic && (!problem.has_direction() || problem.stays_reversed());
            match checked(&path, solved, start) {
                fault @ Err(SolveError::Violated(_) | SolveError::Impossible(_)) => Some(fault),
                Ok(state) if is_sure && may_be_one_of_two => {
                    stays = true;
                    Some(Ok(state))
                }
                answer if is_sure => return answer,
                answer => Some(answer),
            }
        }
        _ => None,
    };
    if direct.is_none()
        && let Some(refused) = pressed_through_without_states(&mut path)
    {
        return Err(refused);
    }
    // Sooner found than a branch, if the belt locks under a smaller load.
    if let Some(raised) = path.raised_to_load()
        && path.is_before_limit(&raised)
        && let Ok(state) = checked(&path, raised, start)
    {
        return Ok(state);
    }
    // Beside the ends of contacts the pressure, which may not be negative, may need a small defect.
    path.for_error = ForError::Never;
    let led = by_branch(&mut path, start, stays).filter(|answer| answer.is_ok() || !stays);
    if let Some(answer) = led.or(direct) {
        return answer;
    }
    let found = path.find(path.target());
    conclude(&path, found, start)
}

/// The steady state of a V-belt drive that differs little from one that is solved.
pub(crate) fn solve_from(
    neighbour: &SteadyState,
    drive: &Drive,
    options: &SolveOptions,
) -> Result<SteadyState, SolveError> {
    let start = Instant::now();
    let tolerance = options.tolerance;
    let law = |drive: &Drive| discriminant(&drive.law);
    let Some(solved) = neighbour.restart.as_deref() else {
        return solve(drive, options);
    };
    if law(drive) != law(&neighbour.drive) || tolerance < neighbour.convergence.tolerance {
        return solve(drive, options);
    }
    let mut path = Path::new(drive, tolerance).with_meshes(ForError::Answers);
    path.smoothing_effect = neighbour.convergence.slip_normalisation_effect;
    match path.neighbour(solved) {
        Ok(solved) => {
            let found = path.classify(solved);
            match conclude(&path, found, start) {
                Err(SolveError::Violated(_) | SolveError::Impossible(_)) => solve(drive, options),
                answer => answer,
            }
        }
        Err(_) => solve(drive, options),
    }
}

/// The answer: a state that has passed its checks, or the reason why there is none.
fn conclude(
    path: &Path<'_>,
    found: Result<Found, Stuck>,
    start: Instant,
) -> Result<SteadyState, SolveError> {
    checked(path, carried(path, found)?, start)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::belt_loop;
    use crate::input::Key;
    use crate::trace;
    use crate::vbelt::limits::limits;
    use crate::vbelt::scaling::tests::{kim, tractive, v_belt};
    use crate::{Closure, Duty, Load, SpanTension, TwoPulleys};

    const LAWS: [FrictionLaw; 4] = [
        FrictionLaw::Coulomb,
        FrictionLaw::Epp { stiffness: 1e7 },
        FrictionLaw::VectorEpp { stiffness: 1e7 },
        FrictionLaw::Bristle { stiffness: 1e3 },
    ];

    #[test]
    fn a_belt_that_is_pressed_through_a_groove_is_refused_for_that() {
        // As with a radial stiffness in kN/m² that was meant in MN/m².
        let (stiffness, half_angle) = (1e3, 0.3);
        for law in LAWS {
            let drive = Drive::from(TwoPulleys {
                belt: v_belt([0.1, 1e5, stiffness, half_angle]),
                driven_radius: 0.2,
                load: tractive(100.0, 300.0),
                ..kim(law, 0.25)
            });
            let key = Key::load(&drive);
            let options = SolveOptions::default();
            let refusals = [
                solve(&drive, &options).map(drop),
                limits(&drive, &key, &options, &mut |_, _| {}).map(drop),
                trace(&drive, &key, [300.0, 400.0], &options, &mut |_, _| {}).map(drop),
            ];
            for refused in refusals {
                let Err(SolveError::PressedThrough { pulley, largest }) = refused else {
                    panic!("{law:?}: {refused:?}")
                };
                let borne = stiffness * half_angle.tan() * 0.2 * 0.2 / 6.0;
                assert!(pulley == "driven" && (largest / borne - 1.0).abs() < 1e-12);
            }
        }
    }

    /// A fast belt, which with a strain of 0.044 takes 2454.8 N to go round, and 2563.7 N without.
    fn fast(law: FrictionLaw, slack: f64, tight: f64) -> Drive {
        Drive::from(TwoPulleys {
            belt: v_belt([0.388_145_69, 56_845.341_5, 1.2e7, 0.358_321_54]),
            friction_coefficient: 0.205_326_957,
            driver_radius: 0.351_314_721,
            driver_speed: 231.335_127,
            driven_radius: 0.098_631_521,
            centre_distance: 1.591_730_52,
            load: Load {
                slack: SpanTension::Belt(slack),
                tight: SpanTension::Belt(tight),
            },
            ..kim(law, 0.25)
        })
    }

    #[test]
    fn a_belt_that_lifts_off_is_refused_for_that() {
        for law in LAWS {
            let refused = solve(&fast(law, 2400.0, 2450.0), &SolveOptions::default()).unwrap_err();
            let SolveError::LiftsOff {
                tractive_tension, ..
            } = refused
            else {
                panic!("{law:?}: {refused:?}")
            };
            assert!((tractive_tension + 60.0).abs() < 1.0, "{tractive_tension}");
        }
    }

    #[test]
    fn a_loop_whose_tension_is_nearly_that_of_centrifugal_force_is_found() {
        let drive = fast(FrictionLaw::Coulomb, 2_522.578_69, 2580.0);
        let state = solve(&drive, &SolveOptions::default()).unwrap();
        let mut as_loop = state.as_loop();
        as_loop.closure = Closure::SpanTension {
            span: drive.driver(),
            tension: state.slack_tension,
        };
        let found = belt_loop::solve(&as_loop).unwrap();
        let (single, told) = (found.pulleys[1].angular_speed, state.driven.angular_speed);
        assert!((single / told - 1.0).abs() < 1e-5, "{single} {told}");
    }

    #[test]
    fn of_two_states_that_of_the_branch_is_told() {
        // The other one is 0.4 % faster and has an efficiency of 0.910.
        let law = FrictionLaw::Epp {
            stiffness: 1.438_469e8,
        };
        let drive = Drive::from(TwoPulleys {
            belt: v_belt([0.062_115_38, 46_517.37, 4_957_713.0, 0.205_842_2]),
            friction_coefficient: 0.677_472_3,
            driver_radius: 0.208_645_5,
            driver_speed: 35.497_14,
            driven_radius: 0.159_542_6,
            centre_distance: 0.851_132_5,
            load: tractive(274.847_1, 320.719_7),
            ..kim(law, 0.25)
        });
        let state = solve(&drive, &SolveOptions::default()).unwrap();
        let speed = state.driven.angular_speed;
        assert!((speed - 46.568_37).abs() < 1e-4, "{speed}");
        let restart = state.restart.unwrap();
        assert!(restart.problem.sticks(), "{:?}", restart.problem.regimes());
    }

    /// The angular speed of the driven pulley at the end of the branch from a lighter load, N, to that of a drive, and the
    /// drive as a loop with the torque there.
    fn at_the_end_of_its_branch(from: f64, drive: &Drive) -> (f64, Drive) {
        let key = Key::load(drive);
        let range = [from, key.get(drive)];
        let mut light = drive.clone();
        key.set(&mut light, range[0]);
        let options = SolveOptions::default();
        let branch = trace(&light, &key, range, &options, &mut |_, _| {}).unwrap();
        let last = branch.points.last().unwrap();
        assert_eq!(last.value, range[1]);
        let state = &last.state;
        let as_loop = drive.as_loop(state.driven.torque, state.slack_tractive_tension);
        (state.driven.angular_speed, as_loop)
    }

    fn with_bristles(stiffness: f64, friction_coefficient: f64) -> TwoPulleys {
        TwoPulleys {
            friction_coefficient,
            ..kim(FrictionLaw::Bristle { stiffness }, 0.25)
        }
    }

    #[test]
    fn of_two_states_whose_driver_slips_that_of_the_branch_is_told() {
        // Those found first have a slip of 0.39 and 0.025 on the driver: one is on a branch of its own, at 5.46 rad/s, one behind
        // the limit point at 476.12 N, at 12.0726 rad/s.
        let own = TwoPulleys {
            belt: v_belt([0.034_545_626, 321_495.76, 4_802_507.59, 0.197_677_912]),
            driver_radius: 0.071_366_084,
            driver_speed: 22.424_554,
            driven_radius: 0.191_362_569,
            centre_distance: 0.684_460_506,
            load: tractive(40.943_674, 600.0),
            ..with_bristles(14_960.34, 0.175_713_744)
        };
        let behind = TwoPulleys {
            belt: v_belt([0.035_783_162, 72_465.358, 9_496_927.42, 0.202_065_507]),
            driver_radius: 0.248_238_37,
            driver_speed: 41.441_05,
            driven_radius: 0.824_344_242,
            centre_distance: 1.505_899_26,
            load: tractive(20.729_408_4, 473.275_343),
            ..with_bristles(1_060.514_19, 0.261_736_542)
        };
        for two in [own, behind] {
            let drive = Drive::from(two);
            let state = solve(&drive, &SolveOptions::default()).unwrap();
            let single = state.driven.angular_speed;
            let (led, _) = at_the_end_of_its_branch(60.0, &drive);
            assert!((single / led - 1.0).abs() < 1e-5, "{single} {led}");
        }
    }

    #[test]
    fn of_two_states_of_a_loop_that_to_which_a_load_leads_is_told() {
        // Those found first slip by 0.059 on the driver, with an efficiency of 0.529 in place of 0.706, and at 9.974 rad/s in
        // place of 10.248.
        let of_driver = TwoPulleys {
            belt: v_belt([0.380_022_039, 211_839.902, 21_744_620.8, 0.248_865_761]),
            driver_radius: 0.099_742_289_8,
            driver_speed: 156.292_803,
            driven_radius: 0.201_090_315,
            centre_distance: 0.597_830_525,
            load: tractive(40.691_509_2, 3_384.032_02),
            ..with_bristles(14_137.501_2, 0.313_247_218)
        };
        let of_driven = TwoPulleys {
            belt: v_belt([0.282_418_474, 478_279.041, 3_772_408.04, 0.355_050_649]),
            driver_radius: 0.273_341_871,
            driver_speed: 26.855_416_7,
            driven_radius: 0.655_773_461,
            centre_distance: 2.617_354,
            load: tractive(79.272_372_2, 3_728.933_67),
            ..with_bristles(1_549.519_7, 0.396_460_704)
        };
        for two in [of_driver, of_driven] {
            let (led, as_loop) = at_the_end_of_its_branch(120.0, &Drive::from(two));
            let found = belt_loop::solve(&as_loop).unwrap();
            let single = found.pulleys[1].angular_speed;
            assert!((single / led - 1.0).abs() < 1e-5, "{single} {led}");
        }
    }

    #[test]
    fn a_loop_with_stiff_vector_friction_carries_what_the_drive_does() {
        // With friction a hundredth as stiff the driver slips at 889 N·m, where the driven pulley does at 944.5 N·m, and from
        // there the driver slipped by 0.065 at 880 N·m.
        let law = FrictionLaw::VectorEpp {
            stiffness: 544_085_698.0,
        };
        let two = TwoPulleys {
            belt: v_belt([0.273_196_608, 479_719.408, 22_907_006.4, 0.350_676_157]),
            friction_coefficient: 0.413_711_08,
            driver_radius: 0.323_897_005,
            driver_speed: 16.751_587_6,
            driven_radius: 0.340_537_434,
            centre_distance: 0.821_964_088,
            load: tractive(61.438_045_7, 2_653.0),
            ..kim(law, 0.25)
        };
        let (led, mut as_loop) = at_the_end_of_its_branch(120.0, &Drive::from(two));
        let found = belt_loop::solve(&as_loop).unwrap();
        let single = found.pulleys[1].angular_speed;
        assert!((single / led - 1.0).abs() < 1e-5, "{single} {led}");
        as_loop.pulleys[1].duty = Duty::Torque(1000.0);
        let refused = belt_loop::solve(&as_loop).unwrap_err();
        let SolveError::Overloaded {
            pulley,
            load_factor,
            ..
        } = refused
        else {
            panic!("more than the loop carries, {refused:?}")
        };
        assert_eq!(pulley, "driven");
        assert!((load_factor - 0.9445).abs() < 2e-4, "{load_factor}");
    }
}
