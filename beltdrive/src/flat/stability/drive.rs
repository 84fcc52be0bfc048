//! The stability of a drive: both pulleys, every form, and the load at which it is lost.

use super::super::closed_form::ClosedForm;
use super::super::limits::largest_load;
use super::super::range::Members;
use super::super::solve::refused;
use super::super::{DRIVEN, DRIVER};
use super::{AxialMotion, LinearisedForm, Spectrum, StabilityError, mode_shape, spectrum};
use crate::input::Key;
use crate::mechanics::root::bracketed;
use crate::results::stability::ROUNDING;
use crate::{
    AxialMode, Drive, FormStability, FrictionLaw, Onset, PulleyStability, ShapePoint, SolveError,
    Stability, ZoneKind,
};
use web_time::Instant;

/// Modes of which shapes are given, and points of a shape.
const SHAPES: usize = 3;
const POINTS: usize = 401;
/// Modes among which the first that grows is looked for, and the loads tried.
const ONSET_MODES: usize = 8;
const LOADS: usize = 24;
/// Share of the largest load that is hardly any.
const FIRST: f64 = 1e-6;

/// The stability of a flat-belt drive.
pub(crate) fn stability(
    drive: &Drive,
    modes: usize,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Stability, SolveError> {
    let start = Instant::now();
    let solved = ClosedForm::find(&drive.pair()).map_err(|refusal| refused(drive, refusal))?;
    let mut done = 0.0;
    let mut pulley = |pulley: usize| {
        let motion = motion(drive, &solved, pulley)?;
        let mut form = |form: LinearisedForm| {
            progress(done / 6.0, "finding eigenvalues");
            done += 1.0;
            form_stability(drive, pulley, &motion, form, modes)
        };
        let [thesis, natural, conservative] = LinearisedForm::ALL;
        let forms = [form(thesis)?, form(natural)?, form(conservative)?];
        Ok::<_, SolveError>(PulleyStability {
            belt_speed: motion.speed,
            contact_length: motion.length,
            transition: motion.transition,
            forms,
        })
    };
    let [driven, driver] = [pulley(DRIVEN)?, pulley(DRIVER)?];
    Ok(Stability {
        drive: drive.clone(),
        critical_speed: motion(drive, &solved, DRIVER)?.critical_speed(),
        driver,
        driven,
        seconds: start.elapsed().as_secs_f64(),
    })
}

/// The belt on a pulley in its steady state. The zones must be elastic or adhering, then slipping.
fn motion(drive: &Drive, solved: &ClosedForm, pulley: usize) -> Result<AxialMotion, SolveError> {
    let contact = &solved.contact[pulley];
    let arc = contact.arc;
    let elastic = match drive.law {
        FrictionLaw::Epp { stiffness } => Some(stiffness),
        FrictionLaw::Coulomb => None,
        _ => {
            return Err(SolveError::NotModelled(
                "the stability of a drive is modelled for the friction laws epp and coulomb only"
                    .into(),
            ));
        }
    };
    let slips = |zone: usize| contact.zones[zone].friction.kind() == ZoneKind::Slip;
    let transition = match contact.zones.len() {
        1 => arc.length,
        2 if slips(1) => contact.zones[0].end,
        _ => {
            return Err(SolveError::NotModelled(
                "the stability of a belt that sticks again behind a slip zone is not modelled"
                    .into(),
            ));
        }
    };
    let tension = arc.belt.tension(arc.entry());
    let pair = drive.pair();
    let radius = [pair.driven_radius, pair.driver_radius][pulley];
    Ok(AxialMotion {
        mass_per_length: drive.belt.mass_per_length,
        axial_stiffness: drive.belt.axial_stiffness,
        speed: solved.speed * (1.0 + tension / drive.belt.axial_stiffness),
        length: arc.length,
        transition,
        elastic,
        slip_rate: arc.sense * pair.friction_coefficient / radius,
    })
}

/// The spectrum in one form.
fn form_stability(
    drive: &Drive,
    pulley: usize,
    motion: &AxialMotion,
    form: LinearisedForm,
    modes: usize,
) -> Result<FormStability, SolveError> {
    let Spectrum {
        modes: found,
        counted,
        within,
        least_stable,
    } = spectrum(motion, form, modes).map_err(failed)?;
    let places: Vec<f64> = (0..POINTS)
        .map(|point| motion.length * point as f64 / (POINTS - 1) as f64)
        .collect();
    let mode = |(index, mode): (usize, &super::Mode)| {
        let shape = match index < SHAPES {
            true => mode_shape(motion, form, mode.value, &places)?,
            false => Vec::new(),
        };
        Ok(AxialMode {
            growth: mode.value.re,
            frequency: mode.value.im,
            difference: mode.difference,
            shape: shape
                .iter()
                .map(|sample| ShapePoint {
                    arc_length: sample.s,
                    value: [sample.value.re, sample.value.im],
                })
                .collect(),
        })
    };
    let modes: Result<Vec<_>, StabilityError> = found.iter().enumerate().map(mode).collect();
    Ok(FormStability {
        form,
        modes: modes.map_err(failed)?,
        least_stable,
        high_mode_limit: motion.high_mode_limit(form),
        counted,
        within,
        onset: match form {
            LinearisedForm::Conservative => None,
            _ => Some(onset(drive, pulley, form)?),
        },
    })
}

/// The load from which on a motion on a pulley grows.
fn onset(drive: &Drive, pulley: usize, form: LinearisedForm) -> Result<Onset, SolveError> {
    let key = Key::load(drive);
    let members = Members::new(drive, &key);
    let [low, _] = members.domain();
    let Some(limit) = largest_load(drive, &key) else {
        return Ok(Onset::Never);
    };
    let motion_at = |load: f64| {
        let drive = members.drive_at(load);
        let solved = ClosedForm::find(&drive.pair()).map_err(|refusal| refused(&drive, refusal))?;
        motion(&drive, &solved, pulley)
    };
    // Relative growth beyond rounding, and the mode that grows.
    let growth = |load: f64| {
        let motion = motion_at(load)?;
        let found = spectrum(&motion, form, ONSET_MODES).map_err(failed)?;
        let mode = found.modes[found.least_stable].value;
        let highest = motion.high_mode_limit(form) / mode.norm();
        let lowest = mode.re / mode.norm();
        // Under rigid friction all modes may grow alike.
        let number = (lowest > highest + ROUNDING).then_some(found.least_stable + 1);
        Ok::<_, SolveError>((lowest.max(highest) - ROUNDING, number))
    };
    // Rigid friction lets the belt move as soon as it slips, however little.
    let (excess, mode) = growth(low + FIRST * (limit.value - low))?;
    if excess > 0.0 {
        return Ok(Onset::At { load: low, mode });
    }
    let load = |share: f64| low + (limit.value - low) * share * share;
    let mut before = low;
    for step in 1..=LOADS {
        let after = load(step as f64 / LOADS as f64);
        let (excess, _) = growth(after)?;
        if excess > 0.0 {
            let ends = [before, after];
            // A drive without load has no growth to speak of.
            let place = bracketed(
                |load| growth(load).map_or(f64::NAN, |(excess, _)| excess),
                ends,
                [-ROUNDING, excess],
            );
            let load = place.unwrap_or(after);
            let (_, mode) = growth(load)?;
            return Ok(Onset::At { load, mode });
        }
        before = after;
    }
    Ok(Onset::Never)
}

fn failed(error: StabilityError) -> SolveError {
    let cause = match error {
        StabilityError::Invalid(_) | StabilityError::Supercritical { .. } => error.to_string(),
        StabilityError::Unresolved(mode) => {
            format!("mode {mode} varies too abruptly along the belt; ask for fewer modes")
        }
        StabilityError::NoConvergence { number, .. }
        | StabilityError::Disagreement { number, .. }
        | StabilityError::Duplicate { number, .. } => format!(
            "two methods do not agree about mode {number}; ask for fewer modes, or for a belt speed farther \
             below that of axial waves"
        ),
        StabilityError::Uncountable { .. } | StabilityError::Missing { .. } => {
            "some may be missing; ask for another number of modes".to_owned()
        }
    };
    SolveError::Stability { cause }
}
