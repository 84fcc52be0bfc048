//! A family is its members, and differentiated exactly.

use super::*;
use crate::vbelt::Regime;
use crate::vbelt::belt_problem::tests::assert_dependences;
use crate::vbelt::scaling::tests::kim;
use crate::{FrictionLaw, SpanTension};
use bvp::Equations;

/// States and parameters in front of those of a law.
const STATE: [f64; 6] = [0.6, 0.2, 0.03, 1.0, 0.2, -0.1];
const SPEED_AND_FLOW: [f64; 2] = [0.97, 0.96];

/// A drive of every law, with zones and formulations of its direction, under tensions of both kinds.
fn problems() -> Vec<(Drive, DriveProblem)> {
    let [elastic, slip, stick, either] =
        [Regime::Elastic, Regime::Slip, Regime::Stick, Regime::Either];
    let split = vec![vec![elastic, slip], vec![slip, elastic, stick, slip, slip]];
    let whole = |regime| vec![vec![regime]; 2];
    let epp = FrictionLaw::Epp { stiffness: 8.1e6 };
    let vector = FrictionLaw::VectorEpp { stiffness: 8.1e6 };
    let cases = [
        (FrictionLaw::Coulomb, whole(slip), true),
        (FrictionLaw::Coulomb, whole(slip), false),
        (epp, split, true),
        (epp, vec![vec![elastic, slip]; 2], false),
        (vector, whole(either), true),
        (vector, vec![vec![elastic, slip]; 2], true),
        (
            FrictionLaw::Bristle { stiffness: 1620.0 },
            whole(slip),
            true,
        ),
    ];
    let loads: [fn(f64) -> SpanTension; 2] = [SpanTension::Tractive, SpanTension::Belt];
    let loaded = loads.into_iter().flat_map(|kind| {
        cases.clone().map(|(law, zones, has_direction)| {
            let mut drive = kim(law, 0.2);
            drive.load.slack = kind(drive.load.slack.value());
            drive.load.tight = kind(drive.load.tight.value());
            let problem = DriveProblem::new(&drive, Scales::with_force(&drive, 650.0), 0.02)
                .with_direction(has_direction)
                .with_zones(&zones);
            (Drive::from(drive), problem)
        })
    });
    loaded.collect()
}

/// The family over each entry of each drive, whose value there counts as one.
fn families() -> impl Iterator<Item = (DriveFamily, String)> {
    problems().into_iter().flat_map(|(drive, problem)| {
        let keys: Vec<_> = Key::all(&drive).collect();
        assert!(keys.len() >= 11);
        keys.into_iter().map(move |key| {
            let unit = key.get(&drive);
            let label = format!("{} of {:?}", key.path(), problem.law());
            let family = DriveFamily::new(&drive, &problem, vec![Entry { key, unit }]);
            (family, label)
        })
    })
}

/// Parameters of the members.
fn own(family: &DriveFamily) -> Vec<f64> {
    let lengths = (LENGTHS..family.first_entry()).map(|index| 0.5 + 0.1 * index as f64);
    SPEED_AND_FLOW.into_iter().chain(lengths).collect()
}

const LENGTHS: usize = SPEED_AND_FLOW.len();

/// States at all ends.
fn ends(segments: &[Segment]) -> Vec<f64> {
    let each = segments.iter().flat_map(|segment| {
        let state = &STATE[..segment.states];
        [state, state].concat()
    });
    let moved = each.enumerate().map(|(i, y)| y * (1.0 + 0.01 * i as f64));
    moved.collect()
}

/// Whether numbers agree to a share of their size, which is at least one.
fn agree(one: &[f64], other: &[f64], share: f64) -> bool {
    let mut pairs = one.iter().zip(other);
    one.len() == other.len()
        && pairs.all(|(one, other)| (one - other).abs() <= share * one.abs().max(1.0))
}

/// Right-hand sides of all segments, one behind the other, and the conditions.
fn values(problem: &impl Problem, p: &[f64]) -> [Vec<f64>; 2] {
    let segments = problem.segments();
    let rates = segments.iter().enumerate().flat_map(|(index, segment)| {
        let mut dy = vec![f64::NAN; segment.states];
        problem.rhs(index, 0.0, &STATE[..segment.states], p, &mut dy);
        dy
    });
    let rates = rates.collect();
    let mut r = vec![f64::NAN; problem.condition_count()];
    problem.conditions(Ends::new(&segments, &ends(&segments)), p, &mut r);
    [rates, r]
}

/// Their derivatives by all parameters, row by row.
fn derivatives(family: &DriveFamily, p: &[f64]) -> [Vec<Vec<f64>>; 2] {
    let segments = Problem::segments(family);
    let rows = |jacobian: &[f64], before: usize| -> Vec<Vec<f64>> {
        let rows = jacobian.chunks_exact(before + p.len());
        rows.map(|row| row[before..].to_vec()).collect()
    };
    let rates = segments.iter().enumerate().flat_map(|(index, segment)| {
        let n = segment.states;
        let (mut dy, mut jacobian) = (vec![0.0; n], vec![f64::NAN; n * (n + p.len())]);
        family.rhs_jacobian(index, 0.0, &STATE[..n], p, &mut dy, &mut jacobian);
        rows(&jacobian, n)
    });
    let rates = rates.collect();
    let values = ends(&segments);
    let mut r = vec![0.0; family.condition_count()];
    let mut jacobian = vec![f64::NAN; r.len() * (values.len() + p.len())];
    family.conditions_jacobian(Ends::new(&segments, &values), p, &mut r, &mut jacobian);
    [rates, rows(&jacobian, values.len())]
}

#[test]
fn a_family_has_the_equations_of_its_members() {
    for (family, label) in families() {
        for value in [1.0, 1.07] {
            let own = own(&family);
            let p = [&own[..], &[value]].concat();
            let member = family.member(&[value]);
            let pairs = values(&family, &p).into_iter().zip(values(&member, &own));
            for (of_family, of_member) in pairs {
                assert!(of_family.iter().all(|value| value.is_finite()), "{label}");
                assert!(agree(&of_family, &of_member, 1e-12), "{label}");
            }
        }
    }
}

#[test]
fn derivatives_by_entries_are_those_of_differences_of_members() {
    const STEP: f64 = 1e-5;
    for (family, label) in families() {
        let own = own(&family);
        let p = [&own[..], &[1.0]].concat();
        let [below, above] = [-STEP, STEP].map(|step| values(&family.member(&[1.0 + step]), &own));
        let both = below.into_iter().zip(above);
        for ((below, above), rows) in both.zip(derivatives(&family, &p)) {
            let pairs = below.iter().zip(&above);
            let differences: Vec<_> = pairs.map(|(b, a)| (a - b) / (2.0 * STEP)).collect();
            let exact: Vec<_> = rows.iter().map(|row| row[own.len()]).collect();
            assert!(
                agree(&exact, &differences, 1e-6),
                "{label}: {exact:?} {differences:?}"
            );
        }
    }
}

#[test]
fn segments_depend_on_entries_that_change_their_rates() {
    for (family, label) in families() {
        let p = [&own(&family)[..], &[1.0]].concat();
        assert_dependences(&family, &p);
        let rates = |p: &[f64]| values(&family, p)[0].clone();
        let mut moved = p.clone();
        *moved.last_mut().unwrap() = 1.25;
        let any = (0..Problem::segments(&family).len())
            .any(|segment| family.depends(segment, p.len() - 1));
        assert_eq!(rates(&p) != rates(&moved), any, "{label}");
    }
}

#[test]
fn two_entries_vary_at_once_and_the_smoothing_with_them() {
    let (drive, problem) = problems().swap_remove(2);
    let entries = ["friction.stiffness", "pulleys.driver.radius"].map(|path| {
        let key = Key::all(&drive).find(|key| key.path() == path).unwrap();
        let unit = key.get(&drive);
        Entry { key, unit }
    });
    let family = DriveFamily::new(&drive, &problem, entries.to_vec()).finer(2);
    let scaled = [1.2, 0.9];
    let member = family.member(&scaled);
    assert_eq!(member.smoothing(), 0.5 * problem.smoothing());
    let own = own(&family);
    let p = [&own[..], &scaled].concat();
    let pairs = values(&family, &p).into_iter().zip(values(&member, &own));
    for (of_family, of_member) in pairs {
        assert!(agree(&of_family, &of_member, 1e-12));
    }
}
