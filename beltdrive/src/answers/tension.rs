//! How tight to set up a drive: the smallest tension at which it holds in all of its load cases.

mod question;
mod search;
mod setting;
mod start;
mod travel;

pub use question::SetupQuestion;
pub use setting::{Set, Setting};
pub use travel::Travel;

use super::check::{CheckedService, check};
use super::shares::each;
use crate::model::model;
use crate::vbelt::belt_loop::limit_accuracy;
use crate::{BeltKind, Closure, Drive, LoadCase, Mount, Service, SolveError, SolveOptions};
use search::{Found, Judged, Search};
use std::borrow::Cow;

/// The smallest setup tension of a drive, and what follows from it.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Setup {
    /// What was asked.
    pub question: SetupQuestion,
    /// What has to be set.
    pub setting: Set,
    /// Belt tension at rest, N.
    pub tension: f64,
    /// Relative accuracy: the setting is larger than the smallest one by about this at most, where the margin jumps by a
    /// thousandth.
    pub accuracy: f64,
    /// Length of the unstretched belt that has this tension, m.
    pub unstretched_length: f64,
    /// The load case that decides, by its index: the others have larger margins, or the same.
    pub deciding_case: usize,
    /// Why the drive has no steady state with less tension, if it is this that decides and not slip.
    pub ends_below: Option<SolveError>,
    /// The drive so set up in all load cases, judged by the asked slip margin and the other requirements.
    pub checked: CheckedService,
    /// The same with the coefficients of friction of all pulleys times 0.8 and times 1.2.
    pub other_friction: Vec<OtherFriction>,
    /// The same with a belt that has grown.
    pub elongated: Elongated,
    /// How far a centre is moved; none with a tensioner, and where it is not said which of more than two pulleys.
    pub travel: Option<Travel>,
}

/// A drive whose friction is not what was stated.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct OtherFriction {
    /// Factor on all coefficients of friction.
    pub factor: f64,
    /// The setup tension that has the asked margin, N, or why none was found.
    pub tension: Result<f64, SolveError>,
    /// Its relative accuracy, as [`Setup::accuracy`].
    pub accuracy: f64,
    /// The smallest slip margin of all cases at the tension that was set; below 1 where a case is not carried, and
    /// none without a state.
    pub slip_margin: Option<f64>,
}

/// A belt that has grown by a share of its unstretched length.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Elongated {
    /// Tension at rest that is left, N, or why there is none.
    pub tension: Result<f64, SolveError>,
    /// The smallest slip margin of all cases that is left; as [`OtherFriction::slip_margin`].
    pub slip_margin: Option<f64>,
    /// Tension at rest of the new belt that leaves the asked margin once it has grown, N.
    pub tension_before: Result<f64, SolveError>,
}

/// Factors on the coefficients of friction of a band.
const FRICTION_BAND: [f64; 2] = [0.8, 1.2];

/// Accuracy of the tensions of a band of a V-belt, relative: a band of friction is known to two digits.
const BAND: f64 = 1e-4;

/// The smallest setup tension at which a drive has the asked slip margin in all of its load cases.
///
/// What closes the drive in the file decides what is varied ([`Setting`]). The tension is found on the states of the
/// drive themselves: their load limit grows with the tension, about in proportion to what centrifugal force leaves of
/// it. A limit of a V-belt is known to about 1e-6, a limit of a flat belt to rounding: so is the margin that the
/// answer has, which is never below the asked one. `progress` is called with the share of the work that is done.
///
/// ```
/// use beltdrive::input::DriveFile;
/// use beltdrive::{SetupQuestion, SolveOptions, examples, tension};
///
/// let example = examples::find("back-side-idler").expect("a shipped example");
/// let file = DriveFile::read(example.name, example.text, &[])?;
/// let question = SetupQuestion { slip_margin: 2.0, elongation: 0.005, moved: None };
/// let found = tension(&file.service()?, question, &SolveOptions::default(), &mut |_, _| {})?;
/// let state = found.checked.cases[0].outcome.as_ref().expect("a steady state");
/// let limit = state.state.load_limit.as_ref().expect("a load");
/// assert!((2.0..2.0 + 1e-6).contains(&limit.factor));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`SolveError::Statement`] if the question is out of range, no load case has a load, or the pulley to move cannot be
/// moved; else those of the states at the tensions that were tried, where they do not say that the belt is too slack.
pub fn tension(
    service: &Service,
    question: SetupQuestion,
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<Setup, SolveError> {
    progress(0.0, "tension");
    let (cases, search, found) = sought(service, question, options)?;
    let (setting, accuracy) = (search.setting, found.accuracy);
    let drives: Vec<_> = cases.iter().map(|case| case.drive.clone()).collect();
    progress(0.5, "load cases");
    let set: Vec<_> = { cases.iter() }
        .map(|case| LoadCase {
            drive: setting.applied(&case.drive, found.value),
            ..case.clone()
        })
        .collect();
    let mut asked = Service {
        cases: set,
        ..service.clone()
    };
    asked.requirements.smallest_slip_margin = Some(question.slip_margin);
    let checked = check(&asked, options, &mut |_, _| {})?;
    let here = &asked.cases[0].drive;
    let rest = model(here.belt.kind).at_rest(here, options)?;
    let of_length = |drive: &Drive, length: f64| with_length(drive, length, rest.coordinate);
    let band_accuracy = search.accuracy.max(match here.belt.kind {
        BeltKind::V(_) => BAND,
        BeltKind::Flat { .. } => 0.0,
    });
    let of_band = Search {
        accuracy: band_accuracy,
        ..search
    };
    progress(0.6, "other friction");
    let other_friction = each(FRICTION_BAND.len(), |index| {
        let factor = FRICTION_BAND[index];
        let others: Vec<_> = { drives.iter() }
            .map(|drive| with_friction(drive, factor))
            .collect();
        let needed = of_band.of_all(&others, found.value);
        let tension = |needed: &Found| {
            let drive = setting.applied(&others[0], needed.value);
            Ok(model(drive.belt.kind).at_rest(&drive, options)?.tension)
        };
        OtherFriction {
            factor,
            slip_margin: needed
                .as_ref()
                .ok()
                .and_then(|needed| needed.margin_at_start),
            accuracy: needed.as_ref().map_or(0.0, |needed| needed.accuracy),
            tension: needed.and_then(|needed| tension(&needed)),
        }
    });
    progress(0.9, "longer belt");
    let grown = 1.0 + question.elongation;
    let tension_of = |length: f64| {
        let drive = of_length(here, length);
        Ok(model(drive.belt.kind).at_rest(&drive, options)?.tension)
    };
    let longer =
        { asked.cases.iter() }.map(|case| of_length(&case.drive, rest.unstretched_length * grown));
    let elongated = Elongated {
        tension: tension_of(rest.unstretched_length * grown),
        slip_margin: smallest(longer, options),
        tension_before: tension_of(rest.unstretched_length / grown),
    };
    Ok(Setup {
        question,
        setting: setting.set(here, found.value),
        tension: rest.tension,
        accuracy,
        unstretched_length: rest.unstretched_length,
        deciding_case: found.case,
        ends_below: found.ends_below,
        other_friction,
        elongated,
        travel: travel::travel(here, question, rest.unstretched_length)?,
        checked,
    })
}

/// The belt tension at rest, N, that [`tension`] finds.
pub(super) fn smallest_tension(
    service: &Service,
    question: SetupQuestion,
    options: &SolveOptions,
) -> Result<f64, SolveError> {
    let (cases, search, found) = sought(service, question, options)?;
    let drive = search.setting.applied(&cases[0].drive, found.value);
    Ok(model(drive.belt.kind).at_rest(&drive, options)?.tension)
}

/// The load cases with torques, and the smallest value of what is varied.
fn sought<'o>(
    service: &Service,
    question: SetupQuestion,
    options: &'o SolveOptions,
) -> Result<(Vec<LoadCase>, Search<'o>, Found), SolveError> {
    question::in_range(question)?;
    let mut cases = service.cases.clone();
    for case in &mut cases {
        case.drive = loaded(&case.drive, options)?;
    }
    let first = &cases[0].drive;
    travel::movable(first, question.moved)?;
    let accuracy = accuracy(first, options);
    let setting = Setting::of(first);
    let search = Search {
        setting,
        margin: question.slip_margin,
        accuracy,
        options,
    };
    if cases.iter().all(|case| case.drive.is_idle()) {
        return Err(SolveError::Statement {
            subject: "load".to_owned(),
            problem: Cow::Borrowed(
                "no pulley has a torque or a power in any load case, so that none slips",
            ),
        });
    }
    let start = cases
        .iter()
        .map(|case| search.start(&case.drive))
        .fold(0.0, f64::max);
    let drives: Vec<_> = cases.iter().map(|case| case.drive.clone()).collect();
    let found = search.of_all(&drives, start)?;
    Ok((cases, search, found))
}

/// How accurately a margin is met, relative: that of a V-belt as accurately as it is known, one of a flat belt,
/// which is in closed form, nearly to rounding.
fn accuracy(drive: &Drive, options: &SolveOptions) -> f64 {
    match drive.belt.kind {
        BeltKind::V(_) => limit_accuracy(options.tolerance),
        BeltKind::Flat { .. } => 1e-9,
    }
}

/// The drive with a torque on its driven pulley, where the tensions of both spans stated it.
fn loaded(drive: &Drive, options: &SolveOptions) -> Result<Drive, SolveError> {
    use crate::{Duty, SpanTension};
    let Closure::BothSpans(load) = drive.closure else {
        return Ok(drive.clone());
    };
    let stated = [load.slack, load.tight]
        .into_iter()
        .find_map(|tension| match tension {
            SpanTension::DrivenTorque(torque) => Some(torque),
            _ => None,
        });
    match stated {
        None => Ok(super::belt_loop::closed_once(drive, options)?.into_owned()),
        Some(torque) => {
            let mut drive = drive.clone();
            let driven = 1 - drive.driver();
            drive.pulleys[driven].duty = Duty::Torque(torque);
            Ok(drive)
        }
    }
}

/// The drive with other coefficients of friction.
fn with_friction(drive: &Drive, factor: f64) -> Drive {
    let mut drive = drive.clone();
    for pulley in &mut drive.pulleys {
        pulley.friction_coefficient *= factor;
    }
    drive
}

/// The drive with a belt of an unstretched length, near a coordinate of its tensioner.
pub(super) fn with_length(drive: &Drive, length: f64, coordinate: f64) -> Drive {
    let mut drive = drive.clone();
    drive.closure = Closure::UnstretchedLength(length);
    for pulley in &mut drive.pulleys {
        if let Mount::Tensioner(tensioner) = &mut pulley.mount {
            tensioner.start_coordinate = coordinate;
        }
    }
    drive
}

/// The smallest slip margin of drives, if all of them have one.
fn smallest(drives: impl Iterator<Item = Drive>, options: &SolveOptions) -> Option<f64> {
    let mut smallest = f64::INFINITY;
    for drive in drives {
        match search::judge(&drive, options) {
            Ok(Judged::Slips(factor)) => smallest = smallest.min(factor),
            Ok(Judged::Idle) => {}
            Ok(Judged::Loose(_)) | Err(_) => return None,
        }
    }
    smallest.is_finite().then_some(smallest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_go_between_threads() {
        fn is_shared<T: Send + Sync>() {}
        is_shared::<Setup>();
    }
}
