//! What there is to tell of the largest load of a drive against speed.

use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value, belt_loop};
use crate::{BeltKind, Drive, Duty, FrictionLaw, LoadEnd, RatedLoad, Rating, RatingEnd};

/// What to know of scalar EPP friction in grooves.
const SCALAR: &str = "scalar EPP friction in a groove: its displacement grows from the slack belt tension, or from the \
                      slack tractive tension where the drive file states that, which changes the limit";

/// The optimum and the load at the speed of the drive file, the reasons of the limit, and the limit against speed.
pub fn answer(rating: &Rating) -> Answer {
    let drive = &rating.drive;
    let mut heading = belt_loop::heading(drive);
    heading.push("Largest torque and power of the driver against its speed".to_owned());
    heading.push(end(rating));
    let points = rating.points.iter();
    let points = points.map(|point| {
        let mut row = load(drive, point);
        row.push(Quantity::word(
            "",
            "limited by",
            point.end.kind().to_owned(),
        ));
        Subject::new("", row)
    });
    let mut groups = vec![
        Group::single("", statement(rating)),
        Group::single("optimum", unlabelled(load(drive, &rating.optimum))),
        Group::single("stated", stated(rating)),
        Group::new("", Layout::Columns, columns(rating)),
        Group::new("points", Layout::Rows, points.collect()),
    ];
    groups.push(Group::new("stretches", Layout::Rows, stretches(rating)));
    Answer {
        heading,
        groups,
        notes: notes(rating),
        ..Answer::default()
    }
}

/// What was asked and why it ends, for programs.
fn statement(rating: &Rating) -> Vec<Quantity> {
    let (kind, speed) = match &rating.end {
        RatingEnd::LiftsOff { speed } => ("lift-off", Some(*speed)),
        RatingEnd::NoState { speed, reason } => (reason.kind(), Some(*speed)),
        RatingEnd::SlipsEverMore { speed } => ("growing slip", Some(*speed)),
        RatingEnd::Given => ("given", None),
        RatingEnd::Chosen { .. } => ("none found", None),
    };
    let mut quantities = belt_loop::statement(&rating.drive);
    quantities.extend([
        Quantity::word("end", "", kind.to_owned()),
        Quantity::word("end_description", "", end(rating)),
        Quantity::number("end_speed", "", Measure::AngularSpeed, speed, 0.0),
        Quantity::json("optimum_at_end", rating.optimum_at_end),
        Quantity::number("error", "", Measure::Number, rating.error, 0.0),
    ]);
    quantities
}

/// Why the range of speeds ends, in a sentence.
fn end(rating: &Rating) -> String {
    let shown = |speed: f64| of_speed("", "", speed).shown(6.0).unwrap_or_default();
    match &rating.end {
        RatingEnd::LiftsOff { speed } => format!(
            "at {} the belt lifts off: centrifugal force takes up its whole tension",
            shown(*speed)
        ),
        RatingEnd::NoState { speed, reason } => {
            let reason = LoadEnd::NoState(reason.clone()).sentence(&rating.drive);
            format!(
                "faster than {} the belt does not run: {reason}",
                shown(*speed)
            )
        }
        RatingEnd::SlipsEverMore { speed } => {
            let driver = &rating.drive.pulleys[rating.drive.driver()].name;
            format!(
                "faster than {} there is no largest load: pulley `{driver}` slips ever more as it rises",
                shown(*speed)
            )
        }
        RatingEnd::Given => "the belt lifts off at none of these speeds".to_owned(),
        RatingEnd::Chosen { factor } => {
            let factor = super::precision::six_digits(*factor);
            format!(
                "the belt lifts off at no speed: shown is up to {factor} times that of the drive file"
            )
        }
    }
}

/// A speed of the driver, which has all its digits: it is chosen.
fn of_speed(key: &'static str, label: &'static str, speed: f64) -> Quantity {
    let error = f64::EPSILON * speed;
    Quantity::number(key, label, Measure::AngularSpeed, speed, error)
}

/// A load; all of it is for programs, and what is labelled for people.
fn load(drive: &Drive, load: &RatedLoad) -> Vec<Quantity> {
    let relative = |key, label, measure, value: f64| {
        Quantity::number(key, label, measure, value, load.error * value.abs())
    };
    let pulleys = drive.pulleys.iter().filter_map(|pulley| {
        let torque = match pulley.duty {
            Duty::Torque(torque) if torque != 0.0 => load.factor * torque,
            _ => return None,
        };
        let torque = relative("torque", "", Measure::Torque, torque);
        let name = Quantity::word("name", "", pulley.name.clone());
        Some(Subject::new(pulley.name.clone(), vec![name, torque]))
    });
    let pulleys = Value::List(pulleys.collect());
    let out_error = load.error * load.power.abs();
    vec![
        of_speed("speed", "speed", load.speed),
        relative("torque", "torque", Measure::Torque, load.torque),
        relative("power", "power", Measure::Power, load.power),
        Quantity::number("power_out", "", Measure::Power, load.power_out, out_error),
        relative("load_factor", "", Measure::Number, load.factor),
        Quantity::word("reason", "", load.end.kind().to_owned()),
        Quantity::word("pulley", "", name(drive, &load.end)),
        Quantity::word("description", "", load.end.sentence(drive).into_owned()),
        Quantity::data("pulleys", Measure::Number, pulleys),
        Quantity::number("error", "", Measure::Number, load.error, 0.0),
    ]
}

/// The name of the pulley that limits a load.
fn name(drive: &Drive, end: &LoadEnd) -> Option<String> {
    end.pulley()
        .map(|pulley| drive.pulleys[pulley].name.clone())
}

fn unlabelled(quantities: Vec<Quantity>) -> Vec<Quantity> {
    quantities.into_iter().map(Quantity::unlabelled).collect()
}

/// The load at the speed of the drive file, for programs, or why there is none.
fn stated(rating: &Rating) -> Vec<Quantity> {
    match &rating.stated {
        Ok(stated) => unlabelled(load(&rating.drive, stated)),
        Err(error) => vec![
            Quantity::word("reason", "", error.kind().to_owned()),
            Quantity::word("description", "", error.to_string()),
        ],
    }
}

/// The same two for people.
fn columns(rating: &Rating) -> Vec<Subject> {
    let drive = &rating.drive;
    let column = |head: &str, load: &RatedLoad| {
        let share = |value: f64| (load.error * value.abs()).max(f64::EPSILON);
        let number =
            |label, measure, value: f64| Quantity::number("", label, measure, value, share(value));
        let rim = load.speed * drive.driver_radius();
        let out = load.power_out;
        let out_error = share(load.power);
        Subject::new(
            head,
            vec![
                of_speed("", "speed of the driver", load.speed),
                Quantity::number("", "  of its rim", Measure::Velocity, rim, share(rim)),
                number("largest torque", Measure::Torque, load.torque),
                number("largest power", Measure::Power, load.power),
                Quantity::number("", "  taken out", Measure::Power, out, out_error),
                number("load factor", Measure::Number, load.factor),
                Quantity::word("", "limited by", load.end.kind().to_owned()),
                Quantity::word("", "  at", name(drive, &load.end)),
            ],
        )
    };
    let best = match rating.optimum_at_end {
        true => "end of the range",
        false => "largest power",
    };
    let optimum = column(best, &rating.optimum);
    let stated = rating.stated.as_ref().ok();
    let stated = stated.map(|stated| column("drive file", stated));
    std::iter::once(optimum).chain(stated).collect()
}

/// The ranges of speed with one reason.
fn stretches(rating: &Rating) -> Vec<Subject> {
    let drive = &rating.drive;
    let stretches = rating.stretches.iter().map(|stretch| {
        Subject::new(
            "",
            vec![
                of_speed("from", "from", stretch.range[0]),
                of_speed("to", "to", stretch.range[1]),
                Quantity::word("reason", "", stretch.end.kind().to_owned()),
                Quantity::word("pulley", "", name(drive, &stretch.end)),
                Quantity::word(
                    "description",
                    "limited by",
                    stretch.end.sentence(drive).into_owned(),
                ),
            ],
        )
    });
    stretches.collect()
}

/// What else has to be said.
fn notes(rating: &Rating) -> Vec<String> {
    let mut notes = Vec::new();
    if rating.optimum_at_end {
        notes.push("the power is largest at an end of the range of speeds".to_owned());
    }
    if let Err(error) = &rating.stated {
        notes.push(format!("at the speed of the drive file: {error}"));
    }
    let count = rating.missing.len();
    if let Some((speed, error)) = rating.missing.first() {
        let speed = of_speed("", "", *speed).shown(6.0).unwrap_or_default();
        notes.push(format!(
            "no limit was found at {count} of the speeds that were tried, first at {speed}: {error}"
        ));
    }
    if let (FrictionLaw::Epp { .. }, BeltKind::V(_)) = (rating.drive.law, rating.drive.belt.kind) {
        notes.push(SCALAR.to_owned());
    }
    let mut errors: Vec<f64> = rating.points.iter().map(|point| point.error).collect();
    errors.sort_by(f64::total_cmp);
    let half = errors.get(errors.len() / 2).copied().unwrap_or_default();
    let [half, most] = [half, rating.error].map(|error| format!("{error:.0e}"));
    let told = match half == most {
        true => most,
        false => format!("{half} at half of the speeds, {most} at most"),
    };
    notes.push(format!(
        "estimated relative error of torques and powers: {told}"
    ));
    notes
}
