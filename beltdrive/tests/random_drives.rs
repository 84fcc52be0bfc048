//! Many random drives within the range of ordinary V-belt drives: every one is solved, or refused
//! with the reason why no steady state carries its load.

#[path = "support/random.rs"]
mod random;
#[path = "support/wide_family.rs"]
mod wide_family;

use beltdrive::{
    Belt, BeltKind, FrictionLaw, Load, SolveError, SolveOptions, SpanTension, SteadyState,
    TwoPulleys, VBelt, ZoneKind, solve,
};
use std::f64::consts::PI;
use std::time::Instant;

/// A reproducible sequence of numbers in \[0, 1): the minimal standard generator of Park & Miller.
struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0 * 48_271 % 2_147_483_647;
        self.0 as f64 / 2_147_483_647.0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in the logarithm.
    fn scale(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }
}

fn drive(random: &mut Random, law: FrictionLaw) -> TwoPulleys {
    loop {
        let driver_radius = random.scale(0.04, 0.4);
        let driven_radius = driver_radius * random.scale(1.0 / 3.0, 3.0);
        let largest = driver_radius.max(driven_radius);
        let slack = random.scale(50.0, 800.0);
        let tight = slack * random.scale(1.02, 12.0);
        let radial_stiffness = random.scale(3e5, 3e6);
        let half_angle = random.between(15.0, 20.0).to_radians();
        // A belt that would sink through a tenth of the smaller pulley is no sensible drive.
        let smallest = driver_radius.min(driven_radius);
        let depth = tight / (radial_stiffness * smallest * half_angle.tan());
        let drive = TwoPulleys {
            belt: Belt {
                ribs: 1,
                mass_per_length: random.scale(0.05, 0.6),
                axial_stiffness: random.scale(30e3, 300e3),
                kind: BeltKind::V(VBelt {
                    radial_stiffness,
                    half_angle,
                    height: None,
                }),
            },
            friction_coefficient: random.between(0.15, 0.8),
            law,
            driver_radius,
            driver_speed: random.scale(300.0, 4000.0) * PI / 30.0,
            driven_radius,
            centre_distance: largest * random.between(2.5, 10.0),
            load: Load {
                slack: SpanTension::Tractive(slack),
                tight: SpanTension::Tractive(tight),
            },
        };
        let speed = drive.driver_speed * driver_radius;
        let subsonic =
            drive.belt.mass_per_length * speed.powi(2) < 0.2 * drive.belt.axial_stiffness;
        let fits = (0.04..=0.4).contains(&driven_radius)
            && drive.centre_distance > 1.02 * (driver_radius + driven_radius);
        if fits && subsonic && depth < 0.1 * smallest {
            return drive;
        }
    }
}

/// What the user reads of a state is that of a drive.
fn assert_possible(state: &SteadyState) {
    let powers = [&state.driver, &state.driven].map(|on| on.torque * on.angular_speed);
    assert!((0.0..=1.0).contains(&state.efficiency) && state.friction_loss >= 0.0);
    let explained = state.friction_loss + state.compression_power;
    assert!((powers[0] - powers[1] - explained).abs() < 1e-4 * powers[0]);
    let lengths = [state.belt_length, state.slack_span, state.tight_span];
    assert!(lengths.into_iter().all(|length| length > 0.0));
    for pulley in [&state.driver, &state.driven] {
        let profile = &pulley.profile;
        let largest = profile.normal_force.iter().copied().fold(0.0, f64::max);
        let mu = state.drive.pulleys[0].friction_coefficient;
        for (p, f) in profile.normal_force.iter().zip(&profile.friction_force) {
            assert!(*p >= -1e-12 * largest && *f <= mu * p + 1e-5 * largest);
        }
        let tensions = profile.tension.iter().chain(&profile.tractive_tension);
        assert!(tensions.into_iter().all(|tension| *tension > 0.0));
    }
}

/// Tension ratios of the wide family, from hardly any load to beyond most limits.
const RATIOS: [f64; 2] = [1.0001, 20.0];
/// Drives that take longer, s, are told.
const SLOW: f64 = 3.0;

/// Solves drives of the wide family with the law of a number and tension ratios in a range, all or that of one index, as
/// [`score`].
fn wide_survey(
    number: usize,
    ratios: [f64; 2],
    count: usize,
    seed: u64,
    only: Option<usize>,
) -> usize {
    let mut random = random::Random(seed);
    let drives = (0..count).map(|_| wide_family::drive(&mut random, number, ratios));
    score(
        drives
            .enumerate()
            .filter(|&(index, _)| only.is_none_or(|only| only == index)),
    )
}

#[test]
fn coulomb_friction_of_every_kind_of_drive() {
    assert_eq!(wide_survey(0, RATIOS, 100, 777, None), 0);
}

#[test]
fn coulomb_friction_without_load_and_just_above() {
    // The belt rests on most of both pulleys, and slips by 1e-9 to 1e-4 where it breaks away.
    for ratio in [1.0, 1.0001, 1.001] {
        assert_eq!(wide_survey(0, [ratio, ratio], 40, 4711, None), 0);
    }
}

#[test]
fn epp_friction_without_load_and_just_above() {
    // Elastic friction holds the belt on most pulleys.
    for ratio in [1.0, 1.01] {
        assert_eq!(wide_survey(1, [ratio, ratio], 15, 4711 + 1, None), 0);
    }
}

#[test]
fn vector_friction_of_every_kind_of_drive() {
    assert_eq!(wide_survey(2, RATIOS, 40, 777 + 2, None), 0);
}

#[test]
fn bristle_friction_of_every_kind_of_drive() {
    assert_eq!(wide_survey(3, RATIOS, 200, 777 + 3, None), 0);
}

/// Prints the score of as many drives of the wide family as `DRIVES` says, 200 by default, with the law of the number
/// `LAW`, or all; or of that of the index `ONLY`. Their tension ratio is `RATIO`, if that is given.
#[test]
#[ignore = "minutes: the score, run by hand for benches/RESULTS.md"]
fn wide_score() {
    let number = |name: &str| std::env::var(name).ok()?.parse().ok();
    let ratio = std::env::var("RATIO").ok();
    let ratio = ratio.and_then(|ratio| ratio.parse().ok());
    let ratios = ratio.map_or(RATIOS, |ratio: f64| [ratio, ratio]);
    let count = number("DRIVES").unwrap_or(200);
    let seed = number("SEED").unwrap_or(777) as u64;
    for law in (0..4).filter(|&law| number("LAW").is_none_or(|asked| asked == law)) {
        wide_survey(law, ratios, count, seed + law as u64, number("ONLY"));
    }
}

/// Solves `count` random drives, as [`score`].
fn survey(law: FrictionLaw, count: usize, seed: u64) -> usize {
    let mut random = Random(seed);
    score((0..count).map(|_| drive(&mut random, law)).enumerate())
}

/// Solves drives with one law, prints the score and returns how many failed.
fn score(drives: impl Iterator<Item = (usize, TwoPulleys)>) -> usize {
    let (mut refused, mut failed) = (0, Vec::new());
    let (mut seconds, mut work) = (Vec::new(), Vec::new());
    let mut law = "";
    for (index, drive) in drives {
        law = drive.law.name();
        let start = Instant::now();
        let found = solve(&drive.into(), &SolveOptions::default());
        let took = start.elapsed().as_secs_f64();
        seconds.push(took);
        if took > SLOW {
            println!("{index}: {took:.1} s, {drive:?}");
        }
        match found {
            Ok(state) => {
                assert!(state.driven.angular_speed > 0.0);
                assert_possible(&state);
                work.push(state.convergence.factorisations);
            }
            Err(SolveError::NoSteadyState { asked, limit, .. }) => {
                refused += 1;
                assert!(limit < asked * (1.0 + 1e-6));
            }
            Err(error) => failed.push(format!("{index}: {error}\n{drive:?}")),
        }
    }
    seconds.sort_by(f64::total_cmp);
    work.sort_unstable();
    let milliseconds = |share: usize| 1e3 * seconds[(seconds.len() - 1) * share / 100];
    // None is solved of one drive that is refused.
    let factorisations = |share: usize| {
        work.get(work.len().saturating_sub(1) * share / 100)
            .copied()
            .unwrap_or(0)
    };
    println!(
        "{law}: {} solved, {refused} refused with a reason, {} failed; \
         median {:.1} ms, 90 % {:.1} ms, slowest {:.1} ms; \
         factorisations: median {}, 90 % {}, most {}",
        work.len(),
        failed.len(),
        milliseconds(50),
        milliseconds(90),
        milliseconds(100),
        factorisations(50),
        factorisations(90),
        factorisations(100),
    );
    for failure in &failed {
        println!("{failure}");
    }
    failed.len()
}

#[test]
fn coulomb_friction() {
    assert_eq!(survey(FrictionLaw::Coulomb, 40, 20_260_001), 0);
}

#[test]
fn bristle_friction() {
    assert_eq!(
        survey(FrictionLaw::Bristle { stiffness: 2000.0 }, 100, 20_260_002),
        0
    );
}

#[test]
fn epp_friction() {
    let law = FrictionLaw::Epp { stiffness: 8e6 };
    assert_eq!(survey(law, 40, 20_260_003), 0);
}

#[test]
fn vector_friction() {
    let law = FrictionLaw::VectorEpp { stiffness: 8e6 };
    assert_eq!(survey(law, 40, 20_260_004), 0);
}

#[test]
fn vector_friction_is_found_from_soft_to_stiff() {
    // A stiff groove round small pulleys: with the softest friction the belt hardly slips, with the stiffest friction
    // is all but Coulomb's.
    let with = |law| TwoPulleys {
        belt: Belt {
            ribs: 1,
            mass_per_length: 0.075,
            axial_stiffness: 174e3,
            kind: BeltKind::V(VBelt {
                radial_stiffness: 27.7e6,
                half_angle: 15f64.to_radians(),
                height: None,
            }),
        },
        friction_coefficient: 0.27,
        law,
        driver_radius: 0.0367,
        driver_speed: 312.0,
        driven_radius: 0.122,
        centre_distance: 0.458,
        load: Load {
            slack: SpanTension::Tractive(305.0),
            tight: SpanTension::Tractive(880.0),
        },
    };
    let solved = |law| {
        let state = solve(&with(law).into(), &SolveOptions::default()).unwrap();
        assert_possible(&state);
        state
    };
    let wrap = |law| {
        let state = solved(law);
        assert!(state.convergence.newton_iterations <= 90);
        state.driver.wrap_angle
    };
    for stiffness in [5e5, 1.6e6] {
        wrap(FrictionLaw::VectorEpp { stiffness });
    }
    let coulomb = wrap(FrictionLaw::Coulomb);
    let difference = |stiffness| (wrap(FrictionLaw::VectorEpp { stiffness }) - coulomb).abs();
    let [soft, stiff, stiffest] = [1e7, 1e8, 1e9].map(difference);
    // The first order in 1/k_f is a factor of 0.1.
    assert!(stiff < 0.25 * soft && stiffest < 0.15 * stiff);
}

#[test]
fn a_belt_that_sticks_up_to_its_exit_slips_at_the_very_end() {
    // Where it leaves it presses no longer. The slip zones are shorter than the distance of two looks at the
    // friction; without them the normal force at the exits is negative.
    let mut random = Random(12);
    let law = FrictionLaw::Epp { stiffness: 1e6 };
    let mut drive = (0..3).map(|_| drive(&mut random, law)).last().unwrap();
    drive.load.tight = SpanTension::Tractive(57.0);
    let state = solve(&drive.into(), &SolveOptions::default()).unwrap();
    assert_possible(&state);
    for pulley in [&state.driver, &state.driven] {
        let last = pulley.zones.last().unwrap();
        assert_eq!(last.kind, ZoneKind::Slip);
        assert!(last.to - last.from < 0.01);
    }
}

#[test]
#[ignore = "minutes: the full score, run by hand for benches/RESULTS.md"]
fn full_score() {
    for seed in [20_260_001, 20_260_011] {
        survey(FrictionLaw::Coulomb, 200, seed);
        survey(FrictionLaw::Bristle { stiffness: 2000.0 }, 200, seed + 1);
        survey(FrictionLaw::Epp { stiffness: 8e6 }, 100, seed + 2);
        survey(FrictionLaw::VectorEpp { stiffness: 8e6 }, 100, seed + 3);
    }
}
