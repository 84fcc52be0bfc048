//! From checked values to a tensioner: an arm or a slide, with a spring or a weight.

use super::{diagnostic::Finding, values::Values};
use crate::{Guide, Tensioner, TensionerLoad};

/// The words of a kind of tensioner in a drive file.
struct Words {
    table: &'static str,
    /// Where it starts, where it is at rest and where its spring is free.
    start: &'static str,
    rest: &'static str,
    free: &'static str,
}

const ARM: Words = Words {
    table: "tensioner.arm",
    start: "tensioner.arm.angle",
    rest: "tensioner.arm.rest_angle",
    free: "tensioner.arm.free_angle",
};

const SLIDE: Words = Words {
    table: "tensioner.slide",
    start: "tensioner.slide.position",
    rest: "tensioner.slide.rest_position",
    free: "tensioner.slide.free_position",
};

/// The tensioner and the name of the pulley on it, if there is one.
pub(super) fn tensioner(values: &Values<'_>) -> Result<Option<(String, Tensioner)>, Finding> {
    if !values.has("tensioner") {
        return Ok(None);
    }
    let pulley = values.required_text("tensioner.pulley")?;
    values.pulley("tensioner.pulley", pulley)?;
    let (words, guide) = match [ARM, SLIDE].map(|words| values.has(words.table)) {
        [true, false] => (ARM, arm(values)?),
        [false, true] => (SLIDE, slide(values)?),
        [is_both, _] => {
            let given = if is_both {
                "both are given"
            } else {
                "neither is given"
            };
            let message = format!("a tensioner has an arm or a slide, {given}");
            return Err(Finding::new(values.key_place("tensioner"), message)
                .expected("[tensioner.arm] or [tensioner.slide]"));
        }
    };
    let start_coordinate = match (values.number(words.start), values.number(words.rest)) {
        (Some(start), None) => start,
        (None, Some(rest)) => rest,
        (None, None) => return Err(values.missing(&[words.start, words.rest])),
        (Some(_), Some(_)) => {
            let message = format!("both `{}` and `{}` are given", words.start, words.rest);
            return Err(Finding::new(values.key_place(words.start), message).expected(
                "the position at rest where it closes the loop, otherwise the position near which the \
                 tensioner is",
            ));
        }
    };
    let load = load(values, &words, start_coordinate)?;
    Ok(Some((
        pulley.to_owned(),
        Tensioner {
            guide,
            load,
            start_coordinate,
            travel: travel(values, &words)?,
        },
    )))
}

fn arm(values: &Values<'_>) -> Result<Guide, Finding> {
    Ok(Guide::Rotary {
        pivot: place(values, "tensioner.arm.pivot")?,
        arm_length: values.required_number("tensioner.arm.length")?,
    })
}

fn slide(values: &Values<'_>) -> Result<Guide, Finding> {
    let direction = values.required_number("tensioner.slide.direction")?;
    Ok(Guide::Translating {
        origin: place(values, "tensioner.slide.origin")?,
        direction: [direction.cos(), direction.sin()],
    })
}

fn place(values: &Values<'_>, path: &str) -> Result<[f64; 2], Finding> {
    if !values.has(path) {
        let (table, name) = super::schema::split(path);
        let message = format!("missing key `{name}` in [{table}]");
        return Err(Finding::new(values.key_place(table), message)
            .expected(format!("{name} = [\"120 mm\", \"80 mm\"]")));
    }
    Ok([
        values.required_number(&format!("{path}.x"))?,
        values.required_number(&format!("{path}.y"))?,
    ])
}

/// A weight, or a spring that is free somewhere or has a load where the tensioner starts.
fn load(values: &Values<'_>, words: &Words, start: f64) -> Result<TensionerLoad, Finding> {
    let key = |name: &str| format!("{}.{name}", words.table);
    let stiffness = key("stiffness");
    let preload = key("preload");
    let of_spring = [stiffness.as_str(), words.free, &preload];
    if let Some(weight) = values.number(&key("weight")) {
        return match values.given(&of_spring).first() {
            None => Ok(TensionerLoad::Weight(weight)),
            Some(path) => {
                let message =
                    format!("`{path}` belongs to a spring, but the tensioner has a weight");
                Err(Finding::new(values.key_place(path), message).expected("a spring or a weight"))
            }
        };
    }
    let stiffness = values.number(&stiffness).ok_or_else(|| {
        let weight = key("weight");
        values.missing(&[&stiffness, &weight])
    })?;
    let free_coordinate = match (values.number(words.free), values.number(&preload)) {
        (Some(free), None) => free,
        // −k (q − q₀) is the preload at the start.
        (None, Some(preload)) => start + preload / stiffness,
        (None, None) => return Err(values.missing(&[words.free, &preload])),
        (Some(_), Some(_)) => {
            let message = format!("both `{}` and `{preload}` are given", words.free);
            return Err(Finding::new(values.key_place(&preload), message).expected("one of them"));
        }
    };
    Ok(TensionerLoad::Spring {
        stiffness,
        free_coordinate,
    })
}

/// The stops.
fn travel(values: &Values<'_>, words: &Words) -> Result<Option<[f64; 2]>, Finding> {
    let stops = format!("{}.stops", words.table);
    if !values.has(&stops) {
        return Ok(None);
    }
    let low = values.required_number(&format!("{stops}.low"))?;
    let high = values.required_number(&format!("{stops}.high"))?;
    match low < high {
        true => Ok(Some([low, high])),
        false => {
            let message = "the first stop must be below the second one";
            Err(Finding::new(values.place(&stops), message))
        }
    }
}
