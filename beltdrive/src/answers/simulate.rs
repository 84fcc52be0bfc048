//! A drive in time.

use super::belt_loop::closed_once;
use super::solve_to;
use crate::belt_loop::LoopState;
use crate::model::model;
use crate::transient::history::Entry;
use crate::transient::rates::Rates;
use crate::transient::{History, Simulation, Start, TransientError, initial, run, statement, v};
use crate::{BeltKind, Closure, Drive, NormalForce, SolveOptions, VBelt};

/// Follows a drive in time: with a flat belt and elastic/perfectly-plastic or creep-rate friction, or with a V-belt
/// and bristles.
///
/// A V-belt keeps the places where it meets and leaves its pulleys in the steady state of the drive, which must have
/// one: `docs/transient.md` has what that costs.
///
/// `progress` is told the time in s and the share of the run that is done, at every sample; where it answers no, the
/// run ends and keeps what it has.
///
/// ```
/// use beltdrive::transient::{Axle, Cells, Load, Motion, Schedule, Simulation, Start, Until};
/// use beltdrive::{examples, input, simulate};
///
/// let example = examples::find("kim2009-flat").expect("a shipped example");
/// let drive = input::parse(example.name, example.text, &[])?;
/// let speed = Schedule::ramp([0.0, 0.1], [0.0, 120.0]);
/// let simulation = Simulation {
///     axles: vec![
///         Axle { inertia: 0.01, motion: Motion::Speed(speed) },
///         Axle {
///             inertia: 0.005,
///             motion: Motion::Torques { motor: None, load: Load::new(Schedule::constant(5.0)) },
///         },
///     ],
///     drive,
///     axial_damping: 0.1,
///     friction_damping: 0.0,
///     transverse: None,
///     start: Start::Rest,
///     cells: Cells::Total(60),
///     until: Until::Time(0.12),
///     interval: 0.01,
///     instants: vec![],
///     frames: 0,
///     step: None,
/// };
/// let history = simulate(&simulation, &mut |_, _| true)?;
/// let last = history.samples.last().expect("a sample at the end");
/// assert!((last.pulleys[1].angular_speed - 120.0).abs() < 5.0);
/// assert!(last.ledger.residual().abs() < 1e-5 * last.ledger.work);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`TransientError`], the statement first.
pub fn simulate(
    simulation: &Simulation,
    progress: &mut dyn FnMut(f64, f64) -> bool,
) -> Result<History, TransientError> {
    statement::check(simulation)?;
    let options = SolveOptions::default();
    match simulation.drive.belt.kind {
        BeltKind::Flat { .. } => of_flat(simulation, &options, progress),
        BeltKind::V(belt) => {
            let found = solve_to(&simulation.drive, &options)?;
            of_v(simulation, (&belt, &found), progress)
        }
    }
}

fn of_flat(
    simulation: &Simulation,
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, f64) -> bool,
) -> Result<History, TransientError> {
    let stated = in_time(&simulation.drive);
    let drive = closed_once(&stated, options)?;
    let layout = drive.layout(0.0).map_err(crate::SolveError::from)?;
    let system = initial::system(simulation, &drive, &layout)?;
    let mut state = match (simulation.start, drive.closure) {
        (Start::Running, _) => initial::running(&system, &solve_to(&drive, options)?)?,
        (Start::Rest, Closure::SetupTension(_) | Closure::UnstretchedLength(_)) => {
            let rest = model(drive.belt.kind).at_rest(&drive, options)?;
            initial::at_rest(&system, rest.tension)
        }
        (Start::Rest, _) => {
            let running = solve_to(&drive, options)?;
            initial::at_rest(&system, running.rest_tension)
        }
    };
    if let Some(stated) = &simulation.transverse {
        initial::pluck(&system, &drive, stated, &mut state)?;
    }
    let sense = layout.sense();
    let entries = layout.pulleys().iter().enumerate().map(|(index, pulley)| {
        let [entering, _] = layout.spans_of(index);
        Entry {
            direction: entering.direction,
            turns: pulley.turns(sense),
        }
    });
    let entries: Vec<_> = entries.collect();
    let parts = (Rates::new(&system), &entries[..], &layout);
    run::run(simulation, parts, state, progress)
}

/// A V-belt with the places of contact of its steady state.
fn of_v(
    simulation: &Simulation,
    (belt, found): (&VBelt, &LoopState),
    progress: &mut dyn FnMut(f64, f64) -> bool,
) -> Result<History, TransientError> {
    let system = v::initial::system(simulation, belt, found)?;
    let mut rates = v::rates::Rates::new(&system);
    let state = match simulation.start {
        Start::Running => v::initial::running(&mut rates, found)?,
        Start::Rest => v::initial::at_rest(&mut rates, found)?,
    };
    let entries = v::initial::entries(found);
    let parts = (rates, &entries[..], &found.layout);
    let history = run::run(simulation, parts, state, progress)?;
    Ok(History {
        coarse: v::initial::coarse(&system, found),
        ..history
    })
}

/// A drive with a flat belt with finite strains and the momentum of the belt, as in time.
pub(super) fn in_time(drive: &Drive) -> Drive {
    let kind = BeltKind::Flat {
        normal_force: NormalForce::Exact,
    };
    Drive {
        belt: crate::Belt { kind, ..drive.belt },
        ..drive.clone()
    }
}
