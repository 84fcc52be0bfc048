//! The modes of vibration of a running drive, at its speed and over a range of speeds.

use super::belt_loop::{closed_once, solve_to};
use super::rating::{at_speed, kept};
use super::simulate::in_time;
use crate::belt_loop::LoopState;
use crate::transient::mesh::Mesh;
use crate::transient::{
    Cells, Motion, Schedule, Simulation, Start, TransientError, Until, VibrationMode, initial,
    statement, vibration,
};
use crate::{BeltKind, Drive, SolveOptions, ZoneKind};

/// What is asked of the modes of a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModesQuestion {
    /// Number of modes, in the order of frequency; positive.
    pub count: usize,
    /// The range of the speed of the driver over which they are sought, rad/s.
    pub speeds: Option<[f64; 2]>,
}

impl ModesQuestion {
    /// So many modes at the speed of the drive; and up to the speed `to` of the driver, rad/s, if it is given, from `from`
    /// or from a tenth of it.
    #[must_use]
    pub fn new(count: usize, from: Option<f64>, to: Option<f64>) -> Self {
        Self {
            count,
            speeds: to.map(|to| [from.unwrap_or(0.1 * to), to]),
        }
    }
}

/// The modes of a drive.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Modes {
    /// The drive as stated.
    pub drive: Drive,
    /// The steady state about which it vibrates, with spans and their transverse frequencies.
    pub state: LoopState,
    /// Length of the loop along which the shapes are given, from where the belt meets the first pulley, m.
    pub length: f64,
    /// Places of the velocities of the shapes on it, m.
    pub faces: Vec<f64>,
    /// The ends of the contacts on it, in belt order, m.
    pub arcs: Vec<[f64; 2]>,
    /// Axial and torsional modes with the slip zones of the steady state held, in the order of frequency.
    pub slipping: Vec<VibrationMode>,
    /// The same where friction is below its limit on all of the contacts, as without load: bristles stick, and with
    /// creep-rate friction the belt creeps.
    pub sticking: Vec<VibrationMode>,
    /// The modes at other speeds, in ascending order; empty unless asked for.
    pub over_speed: Vec<ModesAtSpeed>,
    /// Speeds of the range at which there are none, rad/s, and why.
    pub missing: Vec<(f64, TransientError)>,
}

/// The modes at a speed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ModesAtSpeed {
    /// Angular speed of the driver, rad/s.
    pub speed: f64,
    /// The steady state.
    pub state: LoopState,
    /// Modes with its slip zones held.
    pub modes: Vec<VibrationMode>,
}

/// Speeds of a range: enough for smooth lines.
const SPEEDS: usize = 25;

/// The axial and torsional modes of a drive about its steady state.
///
/// The steady state is that of the drive itself; of the simulation, axles, damping and cells count, not how it starts
/// and ends. Pulleys whose speed is given over time keep that of the steady state; the torque of a motor over
/// speed counts by its slope there. The equations are those of [`simulate`](crate::simulate()) on its mesh, linearised
/// about the steady state with its slip zones held. Damping `c_f` of bristles acts where friction is below its limit; it
/// is left out of the steady state itself, whose slip zones it moves by the order of `c_f`/`k_f` times the belt speed.
/// Told are vibrations with less than a fifth of the critical damping on which a mesh with half the cells agrees.
///
/// Over a range of speeds the torques and the length of the belt are kept.
///
/// ```
/// use beltdrive::input::DriveFile;
/// use beltdrive::{ModesQuestion, examples, modes};
///
/// let example = examples::find("slip-pulse").expect("a shipped example");
/// let mut drive = DriveFile::read(example.name, example.text, &[])?.simulation(None)?;
/// drive.cells = beltdrive::transient::Cells::Total(40);
/// let found = modes(&drive, ModesQuestion { count: 3, speeds: None }, &mut |_, _| {})?;
/// let first = &found.slipping[0];
/// assert!(first.is_torsional() && first.growth < 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`TransientError`]: what [`simulate`](crate::simulate()) refuses to start from, a range of speeds that is
/// none, a drive without steady state at its own speed.
pub fn modes(
    simulation: &Simulation,
    question: ModesQuestion,
    progress: &mut (dyn FnMut(f64, &str) + Send),
) -> Result<Modes, TransientError> {
    let checked = Simulation {
        start: Start::Running,
        until: Until::Time(1.0),
        interval: 1.0,
        instants: vec![],
        frames: 0,
        step: None,
        axles: simulation.axles.clone(),
        drive: simulation.drive.clone(),
        transverse: simulation.transverse.clone(),
        ..*simulation
    };
    if let BeltKind::V(_) = simulation.drive.belt.kind {
        return statement::refuse_key(
            "belt.type",
            "belt",
            "only flat belts have modes here: the depth of a V-belt in its grooves, and its contact with them, which \
             moves, are not linearised",
        );
    }
    statement::check(&checked)?;
    if question.count == 0 {
        return statement::refuse("modes", "their number must be positive");
    }
    if let Some([from, to]) = question.speeds
        && !(0.0 < from && from < to && to.is_finite())
    {
        return statement::refuse("speed", "the range must be one of positive speeds");
    }
    let options = SolveOptions::default();
    let stated = in_time(&simulation.drive);
    let drive = closed_once(&stated, &options)?.into_owned();
    let work = 2.0 + question.speeds.map_or(0.0, |_| SPEEDS as f64);
    progress(0.0, "at the speed of the drive file");
    let state = solve_to(&drive, &options)?;
    let of = |drive: &Drive, state: &LoopState, slips: bool| {
        about(&checked, drive, state, (question.count, slips))
    };
    let (slipping, mesh) = of(&drive, &state, true)?;
    progress(1.0 / work, "sticking");
    let (sticking, _) = of(&drive, &state, false)?;
    let (mut over_speed, mut missing) = (vec![], vec![]);
    if let Some([from, to]) = question.speeds {
        let kept = kept(&stated, &options)?;
        for index in 0..SPEEDS {
            let share = index as f64 / (SPEEDS - 1) as f64;
            let speed = from + share * (to - from);
            progress((2.0 + index as f64) / work, "over speed");
            let drive = at_speed(&kept, speed);
            let found = solve_to(&drive, &options).map_err(TransientError::from);
            let found = found.and_then(|state| Ok((of(&drive, &state, true)?.0, state)));
            match found {
                Ok((modes, state)) => over_speed.push(ModesAtSpeed {
                    speed,
                    state,
                    modes,
                }),
                Err(error) => missing.push((speed, error)),
            }
        }
    }
    let faces = mesh.middles().zip(&mesh.lengths);
    let faces: Vec<f64> = faces.map(|(middle, cell)| middle - 0.5 * cell).collect();
    let face = |face: usize| faces.get(face).copied().unwrap_or(mesh.length());
    let arcs = mesh.arcs.iter();
    Ok(Modes {
        drive: simulation.drive.clone(),
        state,
        length: mesh.length(),
        arcs: arcs.map(|arc| [face(arc.start), face(arc.end)]).collect(),
        faces,
        slipping,
        sticking,
        over_speed,
        missing,
    })
}

/// The modes about a steady state, at most so many, with its slip zones or as if friction were below its limit; and the
/// mesh.
fn about(
    simulation: &Simulation,
    drive: &Drive,
    state: &LoopState,
    (count, slips): (usize, bool),
) -> Result<(Vec<VibrationMode>, Mesh), TransientError> {
    let mut simulation = simulation.clone();
    // Spans that move across leave straight ones alone to first order.
    simulation.transverse = None;
    simulation.cells = match simulation.cells {
        Cells::Total(cells) => Cells::Total(cells.div_ceil(2)),
        Cells::Each { arc, span } => initial::halved(arc, span),
    };
    for (axle, known) in simulation.axles.iter_mut().zip(&state.pulleys) {
        if let Motion::Speed(_) = axle.motion {
            axle.motion = Motion::Speed(Schedule::constant(known.angular_speed));
        }
    }
    let layout = drive.layout(0.0).map_err(crate::SolveError::from)?;
    let coarse = initial::system(&simulation, drive, &layout)?;
    let fine = coarse.refined(2);
    let on = |system| -> Result<_, TransientError> {
        let running = initial::running(system, state)?;
        let slips = slips.then(|| slipping(&system.mesh, state));
        Ok((system, running, slips))
    };
    let found = vibration::modes([on(&coarse)?, on(&fine)?], count)?;
    Ok((found, fine.mesh))
}

/// Whether the belt slips in the cells of all arcs in a steady state.
fn slipping(mesh: &Mesh, state: &LoopState) -> Vec<bool> {
    let mut slipping = vec![false; mesh.bristle_cells()];
    for (bristles, pulley) in mesh.bristles.iter().zip(&state.pulleys) {
        let cells = bristles.len() as f64;
        for (index, slipping) in slipping[bristles.clone()].iter_mut().enumerate() {
            let at = (index as f64 + 0.5) / cells * pulley.wrap;
            let mut zones = pulley.zones.iter();
            *slipping =
                zones.any(|zone| zone.kind == ZoneKind::Slip && zone.from <= at && at <= zone.to);
        }
    }
    slipping
}
