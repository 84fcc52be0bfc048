//! Drives in time, against the closed form of the steady state, against histories of another code, and against what
//! a drive has to do.

mod events;
mod laws;
mod load_step;
mod long_runs;
mod loops;
#[path = "../support/random.rs"]
mod random;
mod random_loops;
mod statements;
mod steady_states;
mod v_belts;

use beltdrive::transient::{
    Axle, Cells, History, Load, Motion, Schedule, Simulation, Start, Until,
};
use beltdrive::{
    Belt, BeltKind, Closure, Drive, Duty, FrictionLaw, NormalForce, Pulley, Sense, simulate,
};

/// A flat belt with a mass per length in kg/m and an axial stiffness in N, in the convention of runs in time.
pub(crate) fn flat_belt(mass_per_length: f64, axial_stiffness: f64) -> Belt {
    Belt {
        mass_per_length,
        axial_stiffness,
        kind: BeltKind::Flat {
            normal_force: NormalForce::Exact,
        },
        ribs: 1,
    }
}

/// The belt and the pulleys of Kim (2009), table 2: the driver first, then the driven pulley.
pub(crate) fn kim(stiffness: f64, strain: f64, torque: f64) -> Drive {
    let axial_stiffness = 80_068.0;
    let pulley = |name, x, duty| Pulley::new(name, [x, 0.0], 0.08125, 1.2, duty);
    Drive {
        title: None,
        belt: flat_belt(0.1036, axial_stiffness),
        law: FrictionLaw::Epp { stiffness },
        sense: Sense::CounterClockwise,
        turning_number: 1,
        pulleys: vec![
            pulley("driver", 0.0, Duty::Driver(120.0)),
            pulley("driven", 0.25, Duty::Torque(torque)),
        ],
        closure: Closure::SetupTension(axial_stiffness * strain),
    }
}

/// An axle with a prescribed speed.
pub(crate) fn driver(speed: Schedule) -> Axle {
    Axle {
        inertia: 0.01,
        motion: Motion::Speed(speed),
    }
}

/// An axle with a load.
pub(crate) fn loaded(inertia: f64, load: Load) -> Axle {
    Axle {
        inertia,
        motion: Motion::Torques { motor: None, load },
    }
}

/// A run from rest with samples every millisecond.
pub(crate) fn from_rest(drive: Drive, axles: Vec<Axle>, cells: usize, end: f64) -> Simulation {
    Simulation {
        drive,
        axles,
        axial_damping: 0.1,
        friction_damping: 0.0,
        transverse: None,
        start: Start::Rest,
        cells: Cells::Total(cells),
        until: Until::Time(end),
        interval: 1e-3,
        instants: vec![],
        frames: 0,
        step: None,
    }
}

pub(crate) fn follow(simulation: &Simulation) -> History {
    simulate(simulation, &mut |_, _| true).unwrap()
}
