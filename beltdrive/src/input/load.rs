//! From checked values to what closes a drive with a driver and a driven pulley: two of its load.

use super::{
    diagnostic::Finding,
    overrides,
    schema::{CLOSURE, EFFORT, SLACK, TENSIONS, TIGHT, TORQUE},
    values::Values,
};
use crate::{BeltKind, Closure, Duty, Load, SpanTension};

/// The span that leaves the driver, and the one that leaves the driven pulley.
const SPANS: [usize; 2] = [0, 1];

/// What the driven pulley takes and what closes the drive: two tensions, or one of them, the setup tension or
/// the length of the belt beside the torque or the power of the driven pulley. Of a flat belt a torque beside
/// a tension stands for the tension of the other span.
pub(super) fn load(values: &Values<'_>, belt: BeltKind) -> Result<(Duty, Closure), Finding> {
    let slack = span_tension(values, SLACK)?;
    let tight = span_tension(values, TIGHT)?;
    let effort = once(values, &EFFORT)?;
    let closure = once(values, &CLOSURE)?;
    if let Some(path) = closure.filter(|path| CLOSURE[2..].contains(path)) {
        let message = format!("`{path}` is for a list of pulleys");
        return Err(Finding::new(values.key_place(path), message)
            .expected("the tension of the slack or of the tight span"));
    }
    let duty = |path: &str| {
        let number = values.number(path).unwrap_or_default();
        if path == "load.power" {
            Duty::Power(number)
        } else {
            Duty::Torque(number)
        }
    };
    let is_flat = matches!(belt, BeltKind::Flat { .. });
    let torque = effort.filter(|path| is_flat && *path != "load.power");
    let torque = torque.and_then(|path| values.number(path));
    let torque = torque.map(SpanTension::DrivenTorque);
    let both = |slack, tight| (Duty::Driven, Closure::BothSpans(Load { slack, tight }));
    match (slack, tight, effort, closure) {
        (Some(slack), Some(tight), None, None) => Ok(both(slack, tight)),
        (Some(slack), None, Some(effort), None) => Ok(match torque {
            Some(tight) => both(slack, tight),
            None => (duty(effort), of_span(SPANS[0], slack)),
        }),
        (None, Some(tight), Some(effort), None) => Ok(match torque {
            Some(slack) => both(slack, tight),
            None => (duty(effort), of_span(SPANS[1], tight)),
        }),
        (None, None, Some(effort), Some(path)) => {
            let number = values.number(path).unwrap_or_default();
            let closure = match path {
                "load.setup_tension" => Closure::SetupTension(number),
                _ => Closure::UnstretchedLength(number),
            };
            Ok((duty(effort), closure))
        }
        (Some(_), None, None, None) => {
            Err(values.missing(&[&TIGHT[..], &[TORQUE]].concat()).help(TWO))
        }
        (None, Some(_), None, None) => {
            Err(values.missing(&[&SLACK[..], &[TORQUE]].concat()).help(TWO))
        }
        (None, None, None, None) => Err(values.missing(&SLACK).help(TWO)),
        (None, None, Some(_), None) => Err(values
            .missing(&[&TENSIONS[..], &CLOSURE[..2]].concat())
            .help(TWO)),
        (None, None, None, Some(_)) => Err(values.missing(&EFFORT).help(TWO)),
        _ => Err(overdetermined(values)),
    }
}

/// What states a load.
const TWO: &str = "two quantities close a drive: two tensions, or the torque or power of the driven pulley \
                   with a span tension, the setup tension or the belt length";

/// The one of several ways to state a quantity that is given, if any is.
fn once(values: &Values<'_>, paths: &[&'static str]) -> Result<Option<&'static str>, Finding> {
    match values.given(paths)[..] {
        [] => Ok(None),
        [path] => Ok(paths.iter().copied().find(|known| *known == path)),
        [one, other, ..] => {
            let message = format!("both `{one}` and `{other}` are given");
            Err(Finding::new(values.key_place(other), message).expected("one of them"))
        }
    }
}

/// The closure by the tension of a span.
fn of_span(span: usize, tension: SpanTension) -> Closure {
    match tension {
        SpanTension::Tractive(tension) => Closure::SpanTractiveTension { span, tension },
        _ => Closure::SpanTension {
            span,
            tension: tension.value(),
        },
    }
}

/// The tension of a span, if it is stated as tractive or as belt tension.
fn span_tension(
    values: &Values<'_>,
    [tractive, belt]: [&'static str; 2],
) -> Result<Option<SpanTension>, Finding> {
    let [tractive_value, belt_value] = [tractive, belt].map(|path| values.number(path));
    if tractive_value.is_some() && belt_value.is_some() {
        let message = format!("both `{tractive}` and `{belt}` are given");
        return Err(Finding::new(values.place(belt), message)
            .expected("one of them: the tension of a span is stated once"));
    }
    let tractive = tractive_value.map(SpanTension::Tractive);
    Ok(tractive.or(belt_value.map(SpanTension::Belt)))
}

/// The finding that more than two quantities of the load are given, or two that do not go together, at the
/// last of them.
fn overdetermined(values: &Values<'_>) -> Finding {
    let mut given = values.given(&[&TENSIONS[..], &EFFORT, &CLOSURE].concat());
    given.sort_by_key(|path| values.place(path).start);
    let names: Vec<_> = given.iter().map(|path| format!("`{path}`")).collect();
    let Some((&last, others)) = given.split_last() else {
        return values.missing(&TENSIONS);
    };
    // A tension makes room for anything else, and the torque or the power for a tension.
    let is_tension = |path: &&str| TENSIONS.contains(path);
    let makes_room = |path: &&&str| is_tension(path) != is_tension(&last);
    let other = others.iter().rev().find(makes_room).or(others.last());
    let other = other.copied().unwrap_or(last);
    let message = match given.len() {
        2 => format!("{} do not close a drive together", names.join(" and ")),
        count => format!(
            "overdetermined: two quantities close a drive, {count} are given: {}",
            names.join(", ")
        ),
    };
    Finding::new(values.place(last), message)
        .expected(TWO.trim_start_matches("two quantities close a drive: "))
        .help(overrides::removal(other))
}
