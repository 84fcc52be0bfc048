//! The statement is complete, free of units, and differentiated exactly.

use super::*;
use crate::vbelt::belt_problem::tests::assert_dependences;
use crate::vbelt::limit_excess;
use crate::vbelt::scaling::tests::kim;
use crate::{BeltKind, FrictionLaw, VBelt};
use bvp::Equations;
use proptest::prelude::*;

const LAWS: [FrictionLaw; 3] = [
    FrictionLaw::Coulomb,
    FrictionLaw::Epp { stiffness: 8.1e6 },
    FrictionLaw::Bristle { stiffness: 1620.0 },
];

fn problem(law: FrictionLaw) -> DriveProblem {
    let drive = kim(law, 0.2);
    DriveProblem::new(&drive, Scales::new(&drive), 0.02)
}

#[test]
fn every_condition_is_written_and_none_is_missing() {
    let epp = problem(LAWS[1]).with_zones(&[
        vec![Regime::Elastic, Regime::Slip],
        vec![Regime::Slip, Regime::Elastic, Regime::Slip],
    ]);
    let sticking = problem(LAWS[1]).with_zones(&[
        vec![
            Regime::Elastic,
            Regime::Stick,
            Regime::Elastic,
            Regime::Slip,
        ],
        vec![Regime::Slip, Regime::Slip],
    ]);
    let normalised = epp.clone().with_direction(false);
    let fixed = epp
        .clone()
        .with_unknown_tight_tension(Instead::DriverLength(3.4));
    let zoned = [epp, sticking, normalised, fixed];
    for (problem, unknowns) in LAWS.map(problem).into_iter().chain(zoned).zip([
        2 * 5 + 4,
        2 * 6 + 4,
        2 * 6 + 4,
        5 * 6 + 7,
        6 * 6 + 8,
        5 * 5 + 7,
        5 * 6 + 8,
    ]) {
        assert_eq!(problem.condition_count(), unknowns);
        let segments = problem.segments();
        let values = vec![0.1; segments.iter().map(|s| 2 * s.states).sum()];
        let p = vec![1.0; problem.parameters()];
        // One entry more than there are conditions must stay untouched.
        let mut r = vec![f64::NAN; unknowns + 1];
        problem.conditions(Ends::new(&segments, &values), &p, &mut r);
        assert!(r[..unknowns].iter().all(|r| r.is_finite()));
        assert!(r[unknowns].is_nan());
        assert_dependences(&problem, &p);
    }
}

#[test]
fn belt_and_tractive_tension_state_the_same_load() {
    let tractive = kim(FrictionLaw::Coulomb, 0.2);
    let scales = Scales::new(&tractive);
    let flow = 0.95;
    let mut belt = tractive;
    let strand = scales.units.strand();
    let tension = |span: SpanTension| {
        SpanTension::Belt(
            strand.tension(span.value() / scales.units.force, flow) * scales.units.force,
        )
    };
    belt.load.slack = tension(belt.load.slack);
    belt.load.tight = tension(belt.load.tight);
    let p = [1.03, 1.0 / flow, 3.2, 3.5];
    let slack = tractive.load.slack.value() / scales.units.force;
    for drive in [tractive, belt] {
        let problem = DriveProblem::new(&drive, scales, 0.0);
        for (pulley, from, force) in [(DRIVEN, DRIVER, slack), (DRIVER, DRIVEN, 1.0)] {
            let excess = problem.tension_excess(&problem.scaled, (pulley, from), &[force], &p);
            assert!(excess.abs() < 1e-14);
        }
    }
}

#[test]
fn the_equations_do_not_depend_on_units() {
    let y = [0.6, 0.1, 0.02, 1.0, 0.2, -0.1];
    let p = [1.01, 1.04, 3.2, 3.5];
    for law in LAWS {
        let drive = kim(law, 0.2);
        // Lengths in other units by a factor l, times by t, masses by m.
        let (l, t, m) = (3.7, 0.21, 11.0);
        let force = m * l / (t * t);
        let mut other = drive;
        other.belt.mass_per_length *= m / l;
        other.belt.axial_stiffness *= force;
        other.belt.kind = BeltKind::V(VBelt {
            radial_stiffness: drive.belt.v().radial_stiffness * force / (l * l),
            ..*drive.belt.v()
        });
        other.driver_radius *= l;
        other.driven_radius *= l;
        other.driver_speed /= t;
        other.centre_distance *= l;
        for span in [&mut other.load.slack, &mut other.load.tight] {
            *span = span.with_value(span.value() * force);
        }
        match &mut other.law {
            FrictionLaw::Coulomb => {}
            FrictionLaw::Epp { stiffness } => *stiffness *= force / (l * l),
            FrictionLaw::Bristle { stiffness } => *stiffness /= l,
            _ => unreachable!("no law of this list"),
        }
        let [one, two] =
            [drive, other].map(|drive| DriveProblem::new(&drive, Scales::new(&drive), 0.02));
        let states = one.groove(DRIVEN).states();
        let (mut a, mut b) = (vec![0.0; states], vec![0.0; states]);
        for segment in [DRIVEN, DRIVER] {
            Problem::rhs(&one, segment, 0.0, &y[..states], &p, &mut a);
            Problem::rhs(&two, segment, 0.0, &y[..states], &p, &mut b);
            for (a, b) in a.iter().zip(&b) {
                assert!((a - b).abs() <= 1e-12 * a.abs().max(1.0));
            }
        }
    }
}

proptest! {
    #[test]
    fn automatic_and_central_differences_agree(
        unit in prop::array::uniform6(0.0..1.0_f64),
        rim_speed in 0.3..1.3_f64,
        segment in 0..2_usize,
    ) {
        let (low, high) = ([0.2, -1.0, 0.01, 0.0, -0.3, -0.3], [1.2, 1.0, 0.2, 3.0, 0.3, 0.3]);
        let y: Vec<f64> = (0..6).map(|i| low[i] + (high[i] - low[i]) * unit[i]).collect();
        let p = [rim_speed, 1.05, 3.2, 3.5];
        for law in LAWS {
            let problem = problem(law);
            if matches!(law, FrictionLaw::Epp { .. }) {
                // Keep away from the kinks at u = 0 and at the limit of the elastic friction.
                let [speed, flow] = [problem.rim_speed(segment, &p), problem.flow(&p)];
                let excess = limit_excess(problem.groove(segment), Regime::Slip, &y, speed, flow);
                prop_assume!(y[5].abs() > 1e-4 && excess.abs() > 1e-2);
            }
            let n = problem.groove(segment).states();
            let z: Vec<f64> = y[..n].iter().chain(&p).copied().collect();
            let (mut dy, mut jacobian) = (vec![0.0; n], vec![0.0; n * z.len()]);
            problem.rhs_jacobian(segment, 0.0, &z[..n], &p, &mut dy, &mut jacobian);
            for j in 0..z.len() {
                let [up, down] = [1e-6, -1e-6].map(|step| {
                    let mut z = z.clone();
                    z[j] += step;
                    let mut dy = vec![0.0; n];
                    Problem::rhs(&problem, segment, 0.0, &z[..n], &z[n..], &mut dy);
                    dy
                });
                for i in 0..n {
                    let difference = (up[i] - down[i]) / 2e-6;
                    let exact = jacobian[i * z.len() + j];
                    prop_assert!((difference - exact).abs() < 1e-5 * exact.abs().max(1e2));
                }
            }
        }
    }
}
