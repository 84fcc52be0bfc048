//! What a drive carries: its largest load against speed at the tension to which it is set up.

mod exact;
mod fitted;
mod range;
mod rated;

pub use range::RatingEnd;
pub(super) use range::at_speed;
pub(super) use rated::kept;

use crate::results::largest_load::LoadEnd;
use crate::{BeltKind, Drive, SolveError, SolveOptions};
use range::Speeds;
use std::borrow::Cow;

/// What is asked of a rating: angular speeds of the driver, rad/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RatingQuestion {
    /// Where it begins; near standstill, a thousandth of where it ends, unless given.
    pub from: Option<f64>,
    /// Where it ends, if the drive still carries something there; where it no longer does unless given.
    pub to: Option<f64>,
}

/// The largest load of a drive against speed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Rating {
    /// The drive as it is rated: with torques in place of powers, and with the belt length of its state in place of the
    /// tensions of both spans.
    pub drive: Drive,
    /// The loads at speeds in ascending order.
    pub points: Vec<RatedLoad>,
    /// The load with the largest power; that of a speed that was found, not one of `points`.
    pub optimum: RatedLoad,
    /// Whether the power still grows at this end of the range of speeds, so that the optimum is there.
    pub optimum_at_end: bool,
    /// The load at the speed of the drive file, if the drive carries any there.
    pub stated: Result<RatedLoad, SolveError>,
    /// The ranges of speed in which the load is limited for one reason, in ascending order.
    pub stretches: Vec<RatingStretch>,
    /// Why the range of speeds ends where it does.
    pub end: RatingEnd,
    /// Estimated relative error of the loads in `points`, `optimum` and `stated`: the largest of all.
    pub error: f64,
    /// Speeds at which no limit was found, and why.
    pub missing: Vec<(f64, SolveError)>,
}

/// The largest load at a speed.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct RatedLoad {
    /// Angular speed of the driver, rad/s.
    pub speed: f64,
    /// The factor on the torques of [`Rating::drive`].
    pub factor: f64,
    /// Torque of the driver, N·m; positive where it puts power into the belt.
    pub torque: f64,
    /// Power of the driver, W.
    pub power: f64,
    /// Power that pulleys take out of the belt, W; none where the speed of a pulley falls to zero, and between the
    /// speeds at which states were found.
    pub power_out: Option<f64>,
    /// Why there is no more.
    pub end: LoadEnd,
    /// Estimated relative error of factor, torque and power.
    pub error: f64,
}

/// A range of speed in which the load is limited for one reason.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct RatingStretch {
    /// Its ends, rad/s.
    pub range: [f64; 2],
    /// The reason.
    pub end: LoadEnd,
}

/// How many speeds a rating has: enough for a smooth curve.
const COUNT: usize = 61;

/// How accurately the speed of the largest power is found, as a share of the speeds between which it lies: the power
/// there is then known to rounding.
const LOCATED: f64 = 1e-7;

/// The largest torques of a drive against the speed of its driver.
///
/// What closes the drive stays as it is, and so does the ratio of all torques; powers are turned into torques at the speed
/// of the drive file, as without creep. Where the tensions of both spans close a drive, the length of the belt that has them
/// at that speed is kept. At each speed the torques are raised until no steady state carries more. Flat belts are
/// solved at every speed, to rounding. The limit of a V-belt is solved at some speeds; the others follow by a polynomial
/// of the limit over the tension that centrifugal force leaves, in the square of the speed, or of the limit itself where the
/// belt overhangs. Its error is measured at further speeds, and by leaving out the nearest. The speed with the largest power
/// is found by maximisation, its load solved. `progress` is called with the share of the work that is done.
///
/// ```
/// use beltdrive::input::DriveFile;
/// use beltdrive::{RatingEnd, RatingQuestion, SolveOptions, examples, rating};
///
/// let example = examples::find("crossed").expect("a shipped example");
/// let drive = DriveFile::read(example.name, example.text, &[])?.drive()?;
/// let question = RatingQuestion::default();
/// let found = rating(&drive, question, &SolveOptions::default(), &mut |_, _| {})?;
/// let RatingEnd::LiftsOff { speed } = found.end else {
///     panic!("centrifugal force lifts it off");
/// };
/// // The power is largest where centrifugal force takes about a third of the tension.
/// assert!((found.optimum.speed / speed - 3_f64.sqrt().recip()).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`SolveError::Statement`] if the range of speeds is empty or no pulley has a load; else why there is no state at
/// rest, at any of the speeds or, where the tensions of both spans close the drive, as stated.
pub fn rating(
    drive: &Drive,
    question: RatingQuestion,
    options: &SolveOptions,
    progress: &mut (dyn FnMut(f64, &str) + Send),
) -> Result<Rating, SolveError> {
    in_order(question)?;
    let stated = drive.driver_speed();
    let drive = rated::rated(drive, options)?;
    let speeds = Speeds::new(&drive, options);
    let (range, end) = speeds.range(question, stated)?;
    match drive.belt.kind {
        BeltKind::Flat { .. } => exact::rating(&speeds, range, end, stated),
        BeltKind::V(_) => fitted::rating(&speeds, range, end, stated, progress),
    }
}

/// Refuses a range of speeds that is none.
fn in_order(question: RatingQuestion) -> Result<(), SolveError> {
    let problem = match (question.from, question.to) {
        (from, to)
            if [from, to]
                .into_iter()
                .flatten()
                .any(|speed| !is_speed(speed)) =>
        {
            "a speed must be a positive number"
        }
        (Some(from), Some(to)) if from >= to => "the range must begin below its end",
        _ => return Ok(()),
    };
    Err(SolveError::Statement {
        subject: "speed".to_owned(),
        problem: Cow::Borrowed(problem),
    })
}

fn is_speed(speed: f64) -> bool {
    speed > 0.0 && speed < 1e30
}

/// The speeds of a rating.
fn places([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    (0..COUNT).map(move |index| match index as f64 / (COUNT - 1) as f64 {
        1.0 => to,
        share => from + share * (to - from),
    })
}

/// The point of the largest power, by its index.
fn strongest(points: &[RatedLoad]) -> Option<usize> {
    let powers = points.iter().map(|point| point.power).enumerate();
    let strongest = powers.max_by(|(_, one), (_, other)| one.total_cmp(other));
    strongest.map(|(index, _)| index)
}

/// Whether an optimum is an end of the range of speeds.
fn is_at_end(optimum: &RatedLoad, [from, to]: [f64; 2]) -> bool {
    let within = 10.0 * LOCATED * (to - from);
    [from, to]
        .iter()
        .any(|end| (optimum.speed - end).abs() <= within)
}

/// The load where the belt lifts off: none.
fn at_lift_off(speed: f64, speeds: &Speeds<'_>) -> RatedLoad {
    let drive = speeds.drive;
    RatedLoad {
        speed,
        factor: 0.0,
        torque: 0.0,
        power: 0.0,
        power_out: Some(0.0),
        end: LoadEnd::NoState(Box::new(SolveError::LiftsOff {
            tractive_tension: 0.0,
            speed: speed * drive.driver_radius(),
            is_loaded: false,
        })),
        error: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_go_between_threads() {
        fn is_shared<T: Send + Sync>() {}
        is_shared::<Rating>();
    }
}
