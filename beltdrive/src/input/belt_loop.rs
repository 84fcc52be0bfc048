//! From checked values to a belt loop: a list of pulleys in belt order, and what closes the loop.

use super::{
    belt, diagnostic::Finding, file, friction, overrides, schema, tensioner, values::Values,
};
use crate::{Closure, Drive, Duty, LayoutError, Mount, Pulley, Sense, Side, Tensioner};

/// What a pulley of a list may do, one of which it does; without one it is an idler.
const DUTIES: [&str; 3] = ["speed", "torque", "power"];

/// The loop that a list of pulleys states.
pub(super) fn of_list(values: &Values<'_>) -> Result<Drive, Finding> {
    let belt = belt::belt(values)?;
    let law = friction::law(values, belt.kind)?;
    let tensioner = tensioner::tensioner(values)?;
    let pulleys = values.pulleys().iter();
    let pulleys = pulleys
        .map(|name| pulley(values, name, tensioner.as_ref()))
        .collect::<Result<Vec<_>, _>>()?;
    one_driver(values, &pulleys)?;
    foreign(values)?;
    let drive = Drive {
        title: values.text("title").map(str::to_owned),
        belt,
        law,
        sense: Sense::CounterClockwise,
        turning_number: turning_number(&pulleys),
        closure: closure(values, tensioner.is_some())?,
        pulleys,
    };
    oriented(values, drive)
}

/// A pulley of the list.
fn pulley(
    values: &Values<'_>,
    name: &str,
    tensioner: Option<&(String, Tensioner)>,
) -> Result<Pulley, Finding> {
    let key = |name_of_key: &str| format!("pulley.{name}.{name_of_key}");
    let number = |name_of_key: &str| values.number(&key(name_of_key));
    let both = |one: &str, other: &str, expected: &str| {
        let place = values.key_place(&key(other));
        let message = format!("both `{one}` and `{other}` are given in [[pulley]] `{name}`");
        Finding::new(place, message).expected(expected)
    };
    let radius = file::radius(values, &format!("pulley.{name}"))?;
    let is_held = tensioner.is_some_and(|(held, _)| held == name);
    let has_centre = values.has(&key("centre"));
    let mount = match tensioner {
        Some((_, tensioner)) if is_held => {
            if has_centre {
                let message = format!("`{name}` has a centre, but it is on the tensioner");
                return Err(Finding::new(values.key_place(&key("centre")), message)
                    .expected("no centre: it follows from [tensioner]"));
            }
            Mount::Tensioner(*tensioner)
        }
        _ if !has_centre => {
            let place = values.key_place(&format!("pulley.{name}"));
            let message = format!("missing key `centre` in [[pulley]] `{name}`");
            return Err(Finding::new(place, message).expected("centre = [\"120 mm\", \"80 mm\"]"));
        }
        _ => Mount::Fixed([
            values.required_number(&key("centre.x"))?,
            values.required_number(&key("centre.y"))?,
        ]),
    };
    let given: Vec<_> = DUTIES
        .into_iter()
        .filter(|duty| number(duty).is_some())
        .collect();
    let duty = match given[..] {
        [] => Duty::Torque(0.0),
        ["speed"] => Duty::Driver(number("speed").unwrap_or_default()),
        ["torque"] => Duty::Torque(number("torque").unwrap_or_default()),
        ["power"] => Duty::Power(number("power").unwrap_or_default()),
        [one, other, ..] => {
            let expected = "one of `speed`, `torque` and `power`, or none for an idler";
            return Err(both(one, other, expected));
        }
        [_] => Duty::Torque(0.0),
    };
    if is_held && !given.is_empty() {
        let message = format!("`{name}` is on the tensioner, so it is an idler");
        return Err(Finding::new(values.key_place(&key(given[0])), message)
            .expected("neither `speed` nor `torque` nor `power`"));
    }
    let friction_coefficient = match number("friction_coefficient") {
        Some(coefficient) => coefficient,
        None => values.required_number("friction.coefficient")?,
    };
    Ok(Pulley {
        name: name.to_owned(),
        mount,
        radius,
        side: match values.text(&key("side")) {
            Some("outside") => Side::Outside,
            _ => Side::Inside,
        },
        friction_coefficient,
        half_angle: number("half_angle"),
        duty,
    })
}

/// Whether exactly one pulley has a speed.
fn one_driver(values: &Values<'_>, pulleys: &[Pulley]) -> Result<(), Finding> {
    let drivers = pulleys.iter();
    let drivers = drivers.filter(|pulley| matches!(pulley.duty, Duty::Driver(_)));
    let drivers: Vec<_> = drivers.map(|pulley| &pulley.name).collect();
    match drivers[..] {
        [_] => Ok(()),
        [] => Err(Finding::new(
            values.key_place(schema::PULLEY),
            "no pulley has a `speed`: one of them drives the belt",
        )
        .expected("speed = \"1000 rpm\" in one [[pulley]]")),
        [one, other, ..] => Err(Finding::new(
            values.key_place(&format!("pulley.{other}.speed")),
            format!("`{one}` and `{other}` both have a `speed`, which the belt does not allow"),
        )
        .expected("one pulley with a speed; a torque or a power below 0 also drives the belt")),
    }
}

/// The turning number: 0 for a crossed belt.
fn turning_number(pulleys: &[Pulley]) -> u32 {
    match pulleys {
        [one, other] if one.side != other.side => 0,
        _ => 1,
    }
}

/// What only a drive with a driver and a driven pulley has.
fn foreign(values: &Values<'_>) -> Result<(), Finding> {
    let places = ["pulleys", "layout.centre_distance", "load.driver_torque"];
    let loads = schema::EFFORT.iter().chain(&schema::TENSIONS);
    let found = places.iter().chain(loads).find(|path| values.has(path));
    found.map_or(Ok(()), |path| {
        let message = format!("`{path}` does not go with a list of pulleys");
        let finding = Finding::new(values.key_place(path), message);
        Err(match *path {
            "pulleys" => finding.expected("[[pulley]] tables only, in belt order"),
            "layout.centre_distance" => finding.expected("a `centre` in each [[pulley]]"),
            path if schema::EFFORT.contains(&path) => {
                finding.expected("`torque` or `power` in a [[pulley]]")
            }
            _ => finding.expected("`span_tension` or `span_tractive_tension`, with `span`"),
        })
    })
}

/// What closes a loop.
fn closure(values: &Values<'_>, has_tensioner: bool) -> Result<Closure, Finding> {
    let at_rest = ["tensioner.arm.rest_angle", "tensioner.slide.rest_position"];
    let paths = [&schema::CLOSURE[..], &at_rest].concat();
    let given = values.given(&paths);
    let number = |path| values.required_number(path);
    let or_tensioner = match has_tensioner {
        true => ", or the position of the tensioner at rest",
        false => "",
    };
    let [path] = given[..] else {
        let expected = format!(
            "one of `belt_length`, `setup_tension`, `span_tension` and `span_tractive_tension` in \
             [load]{or_tensioner}"
        );
        let names: Vec<_> = given.iter().map(|path| format!("`{path}`")).collect();
        let last = given.iter().max_by_key(|path| values.place(path).start);
        return Err(match last {
            None => Finding::new(
                values.key_place("load"),
                "nothing says how tight the belt is: one quantity closes the loop, none is given",
            ),
            Some(last) => Finding::new(
                values.key_place(last),
                format!(
                    "one quantity closes the loop, {} are given: {}",
                    names.len(),
                    names.join(", ")
                ),
            )
            .help(overrides::removal(last)),
        }
        .expected(expected));
    };
    let closure = match path {
        "load.setup_tension" => Closure::SetupTension(number(path)?),
        "load.belt_length" => Closure::UnstretchedLength(number(path)?),
        "load.span_tension" => Closure::SpanTension {
            span: span(values)?,
            tension: number(path)?,
        },
        "load.span_tractive_tension" => Closure::SpanTractiveTension {
            span: span(values)?,
            tension: number(path)?,
        },
        _ => Closure::RestCoordinate(number(path)?),
    };
    Ok(closure)
}

/// The index of the span whose tension is given: that of the pulley it leaves.
fn span(values: &Values<'_>) -> Result<usize, Finding> {
    let asked = values.required_text("load.span").map_err(|finding| {
        finding.help("the tension is that of the span which leaves this pulley")
    })?;
    values.pulley("load.span", asked)
}

/// The loop with the sense in which the belt can run round its pulleys.
fn oriented(values: &Values<'_>, mut drive: Drive) -> Result<Drive, Finding> {
    let senses = [Sense::CounterClockwise, Sense::Clockwise];
    let stated = values.text("layout.sense").map(|word| match word {
        "clockwise" => Sense::Clockwise,
        _ => Sense::CounterClockwise,
    });
    let coordinate = drive.start_coordinate();
    let mut layout = |sense| {
        drive.sense = sense;
        drive.layout(coordinate)
    };
    let found = match stated {
        Some(sense) => layout(sense).map(|_| sense),
        None => {
            let [one, other] = senses.map(&mut layout);
            match (one, other) {
                // A belt round two pulleys is the same either way, but for its direction.
                (Ok(_), Ok(_)) if values.pulleys().len() > 2 => {
                    let place = values.key_place(schema::PULLEY);
                    let message = "the belt can run round these pulleys either way";
                    return Err(Finding::new(place, message)
                        .expected("sense = \"clockwise\" or \"counter-clockwise\" in [layout]"));
                }
                (Ok(_), _) => Ok(senses[0]),
                (_, Ok(_)) => Ok(senses[1]),
                // The better way turns the stated number of times.
                (Err(LayoutError::TurningNumber { .. }), Err(error)) | (Err(error), Err(_)) => {
                    Err(error)
                }
            }
        }
    };
    match found {
        Ok(sense) => {
            drive.sense = sense;
            Ok(drive)
        }
        Err(error) => Err(impossible(values, &error)),
    }
}

/// The finding for a belt that cannot be laid round its pulleys, at the pulley that is in the way.
fn impossible(values: &Values<'_>, error: &LayoutError) -> Finding {
    let pulley = match error {
        LayoutError::NoPulley { pulley }
        | LayoutError::Overlap { other: pulley, .. }
        | LayoutError::NegativeWrap { pulley, .. }
        | LayoutError::SpanThroughPulley { pulley, .. } => format!("pulley.{pulley}"),
        _ => schema::PULLEY.to_owned(),
    };
    let finding = Finding::new(values.key_place(&pulley), error.to_string());
    match error {
        LayoutError::TurningNumber { .. } | LayoutError::NegativeWrap { .. } => finding.help(
            "the pulleys stand in belt order; `side = \"outside\"` is for one that runs on the back of the \
             belt",
        ),
        _ => finding,
    }
}
