//! The statement is complete, with any zones, on the back of the belt and with a tensioner.

use super::super::super::belt_problem::tests::assert_dependences;
use super::*;
use crate::drive::layout::{Sense, Side};
use crate::vbelt::scaling::tests::v_belt;
use crate::{Closure, Guide, Mount, Pulley, TensionerLoad};

/// Angle of the arm, rad.
const COORDINATE: f64 = 4.7;

/// Driver, a pulley under a torque on the back, two driven pulleys inside, and an idler on a weighted arm on the back.
fn drive() -> Drive {
    let pulley = |name, centre, radius, duty| Pulley::new(name, centre, radius, 0.4, duty);
    let on_back = |pulley| Pulley {
        side: Side::Outside,
        ..pulley
    };
    let mut idler = on_back(pulley("idler", [0.0; 2], 0.03, Duty::Torque(0.0)));
    idler.mount = Mount::Tensioner(Tensioner {
        guide: Guide::Rotary {
            pivot: [0.18, 0.27],
            arm_length: 0.1,
        },
        load: TensionerLoad::Weight(100.0),
        start_coordinate: COORDINATE,
        travel: None,
    });
    Drive {
        title: None,
        belt: v_belt([0.1, 60e3, 3e7, 0.3]),
        law: FrictionLaw::Coulomb,
        sense: Sense::Clockwise,
        turning_number: 1,
        pulleys: vec![
            pulley("driver", [0.0, 0.0], 0.08, Duty::Driver(200.0)),
            on_back(pulley("pump", [-0.15, 0.14], 0.03, Duty::Torque(1.0))),
            pulley("alternator", [-0.15, 0.3], 0.035, Duty::Torque(4.0)),
            pulley("fan", [0.2, 0.35], 0.06, Duty::Torque(8.0)),
            idler,
        ],
        closure: Closure::SetupTension(500.0),
    }
}

#[test]
fn every_condition_is_written_and_none_is_missing() {
    let drive = drive();
    let layout = drive.layout(COORDINATE).unwrap();
    let units = Units::new(&drive.belt, drive.rim_speed(), 500.0);
    let problem = |law| {
        let target = Target::Length(1.3);
        LoopProblem::new(&drive, &layout, units, target, law, 1e-3)
    };
    let epp = problem(FrictionLaw::Epp { stiffness: 1e8 });
    let [elastic, slip, stick] = [Regime::Elastic, Regime::Slip, Regime::Stick];
    let zoned = epp.clone().with_zones(&[
        vec![elastic, stick, elastic, slip, slip],
        vec![Regime::Either],
        vec![slip],
        vec![slip, elastic, slip],
        vec![],
    ]);
    // States in grooves and on the back, lengths, and besides these the mass flow, the coordinate, three speeds and
    // the tension of EPP friction.
    for (problem, unknowns) in [
        (problem(FrictionLaw::Coulomb), 3 * 6 + 2 + 4 + 5),
        (
            problem(FrictionLaw::Bristle { stiffness: 1e3 }),
            3 * 7 + 3 + 4 + 5,
        ),
        (epp.clone().with_bristles(1e3), 3 * 8 + 4 + 4 + 6),
        (epp.clone().with_direction(false), 3 * 6 + 3 + 4 + 6),
        (epp, 3 * 7 + 3 + 4 + 6),
        (zoned, 9 * 7 + 3 + 10 + 6),
    ] {
        assert_eq!(problem.condition_count(), unknowns);
        let segments = problem.segments();
        let values = vec![0.1; segments.iter().map(|segment| 2 * segment.states).sum()];
        let mut p = vec![1.0; problem.parameters()];
        p[problem.unknowns.coordinate.unwrap()] = COORDINATE / problem.coordinate_unit();
        // One entry more than there are conditions must stay untouched.
        let mut r = vec![f64::NAN; unknowns + 1];
        problem.conditions(Ends::new(&segments, &values), &p, &mut r);
        assert!(r[..unknowns].iter().all(|r| r.is_finite()));
        assert!(r[unknowns].is_nan());
        assert_dependences(&problem, &p);
    }
}
