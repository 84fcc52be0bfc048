//! From checked values to a load: two of the quantities that close a drive.

use super::{
    diagnostic::Finding,
    overrides,
    schema::{SLACK, TENSIONS, TIGHT, TORQUE},
    values::Values,
};
use crate::{BeltKind, Load, SpanTension};

/// The load: two of the slack tension, the tight tension and, for flat belts, the driven torque.
pub(super) fn load(values: &Values<'_>, belt: BeltKind) -> Result<Load, Finding> {
    let torque = values.number(TORQUE).map(SpanTension::DrivenTorque);
    let is_v_belt = matches!(belt, BeltKind::V(_));
    if is_v_belt && torque.is_some() {
        let message = format!("`{TORQUE}` is not supported for V-belts yet");
        return Err(Finding::new(values.key_place(TORQUE), message)
            .expected("one slack and one tight tension"));
    }
    let missing = |tensions: &[&str], other: &[&str]| match is_v_belt {
        true => values.missing(tensions),
        false => values.missing(&[tensions, other].concat()).help(
            "two of the slack tension, the tight tension and the driven torque state the load",
        ),
    };
    match (
        span_tension(values, SLACK)?,
        span_tension(values, TIGHT)?,
        torque,
    ) {
        (Some(slack), Some(tight), None)
        | (Some(slack), None, Some(tight))
        | (None, Some(tight), Some(slack)) => Ok(Load { slack, tight }),
        (Some(_), Some(_), Some(_)) => Err(overdetermined(values)),
        (None, None, Some(_)) => Err(missing(&TENSIONS, &[])),
        (Some(_), None, None) => Err(missing(&TIGHT, &[TORQUE])),
        (None, Some(_), None) => Err(missing(&SLACK, &[TORQUE])),
        (None, None, None) => Err(missing(&SLACK, &[])),
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

/// The finding that both tensions and the torque are given, at the last of them.
fn overdetermined(values: &Values<'_>) -> Finding {
    let given = |[tractive, belt]: [&'static str; 2]| match values.number(tractive) {
        Some(_) => tractive,
        None => belt,
    };
    let [slack, tight] = [SLACK, TIGHT].map(given);
    let mut in_order = [slack, tight, TORQUE];
    in_order.sort_by_key(|path| values.place(path).start);
    let [.., last] = in_order;
    let other = if last == TORQUE { tight } else { TORQUE };
    let message = format!(
        "overdetermined: `{slack}`, `{tight}` and `{TORQUE}` are given, any one of which follows \
         from the others"
    );
    Finding::new(values.place(last), message)
        .expected("two of them")
        .help(overrides::removal(other))
}
