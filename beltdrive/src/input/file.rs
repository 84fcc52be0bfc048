//! From checked values to a drive: what must be there, and relations between the values.

use super::{
    belt, belt_loop, diagnostic::Finding, friction, load, schema, section, values::Values,
};
use crate::{Closure, Drive, Duty, Load, Pulley, Sense, SpanTension, TwoPulleys};

/// The drive that the values state.
pub(super) fn drive(values: &Values<'_>) -> Result<Drive, Finding> {
    section::check(values)?;
    if values.has(schema::PULLEY) {
        return belt_loop::of_list(values);
    }
    let missing = missing(values);
    if missing.len() > 1 {
        return Err(values.all_missing(&missing));
    }
    let belt = belt::belt(values)?;
    let (duty, closure) = load::load(values, belt.kind)?;
    let law = friction::law(values, belt.kind)?;
    let friction_coefficient = values.required_number("friction.coefficient")?;
    let pulley = |name: &str, x: f64, duty: Duty| {
        let radius = radius(values, &format!("pulleys.{name}"))?;
        let half_angle = values.number(&format!("pulleys.{name}.half_angle"));
        Ok(Pulley {
            half_angle,
            ..Pulley::new(name, [x, 0.0], radius, friction_coefficient, duty)
        })
    };
    let speed = values.required_number("pulleys.driver.speed")?;
    let driver = pulley("driver", 0.0, Duty::Driver(speed))?;
    let distance = values.required_number("layout.centre_distance")?;
    let driven = pulley("driven", distance, duty)?;
    let found = overlap(driver.radius + driven.radius, distance);
    if let Some(found) = found.or_else(|| backwards(closure)) {
        return Err(found.finding(values));
    }
    one_groove(values, closure)?;
    Ok(Drive {
        title: values.text("title").map(str::to_owned),
        belt,
        law,
        sense: Sense::CounterClockwise,
        turning_number: 1,
        pulleys: vec![driver, driven],
        closure,
    })
}

/// The finding for a pulley with a groove of its own in a drive that is closed by the tensions of both spans.
fn one_groove(values: &Values<'_>, closure: Closure) -> Result<(), Finding> {
    let own = ["pulleys.driver.half_angle", "pulleys.driven.half_angle"];
    let path = own.into_iter().find(|path| values.has(path));
    match (closure, path) {
        (Closure::BothSpans(_), Some(path)) => {
            let message = format!(
                "`{path}` differs from the groove of the belt, and two tensions close a drive with one \
                 groove angle"
            );
            Err(Finding::new(values.key_place(path), message).expected(
                "one `groove.half_angle`, or a torque or power in [load] with what closes the drive",
            ))
        }
        _ => Ok(()),
    }
}

/// What a drive with two pulleys needs and the file does not have, but for its load.
fn missing(values: &Values<'_>) -> Vec<&'static str> {
    let of_belt: &[_] = match values.text("belt.type") {
        Some("v") => &["belt.radial_stiffness", "groove.half_angle"],
        _ => &[],
    };
    let of_law = friction::row(values).and_then(|row| row.parameter.as_ref());
    let of_law = of_law.map(|parameter| parameter.path);
    let of_all = [
        "belt.type",
        "belt.mass_per_length",
        "belt.axial_stiffness",
        "friction.law",
        "friction.coefficient",
        "pulleys.driver.radius",
        "pulleys.driver.speed",
        "pulleys.driven.radius",
        "layout.centre_distance",
    ];
    let needed = of_all.iter().chain(of_belt).copied().chain(of_law);
    let is_given = |path: &str| {
        let is_other = |other: &String| values.has(other);
        values.has(path) || schema::alternatives(path).iter().any(is_other)
    };
    needed.filter(|path| !is_given(path)).collect()
}

/// The radius of a pulley of a drive with two.
pub(super) fn radius(values: &Values<'_>, table: &str) -> Result<f64, Finding> {
    let [radius, diameter] = ["radius", "diameter"].map(|name| format!("{table}.{name}"));
    match (values.number(&radius), values.number(&diameter)) {
        (Some(_), Some(_)) => {
            let message = format!(
                "both `radius` and `diameter` are given in {}",
                schema::header(table)
            );
            Err(Finding::new(values.key_place(&diameter), message).expected("one of them"))
        }
        (Some(radius), None) => Ok(radius),
        (None, Some(diameter)) => Ok(0.5 * diameter),
        (None, None) => Err(values.missing(&[&radius, &diameter])),
    }
}

/// Values of a drive that do not fit each other.
pub(super) struct Contradiction {
    /// The entry at fault in a drive file.
    path: &'static str,
    /// The entries that do not fit each other.
    pub(super) between: &'static [&'static str],
    /// What does not fit.
    pub(super) message: String,
    /// What that entry should be.
    expected: String,
}

impl Contradiction {
    fn finding(self, values: &Values<'_>) -> Finding {
        Finding::new(values.place(self.path), self.message).expected(self.expected)
    }
}

/// Pulleys with a sum of radii that is too large for their distance, m.
fn overlap(radii: f64, distance: f64) -> Option<Contradiction> {
    (distance <= radii).then(|| Contradiction {
        path: "layout.centre_distance",
        between: &[
            "pulleys.driver.radius",
            "pulleys.driven.radius",
            "layout.centre_distance",
        ],
        message: format!(
            "the pulleys overlap: their radii add up to {} m, the centre distance is {} m",
            rounded(radii),
            rounded(distance)
        ),
        expected: format!("a length greater than {} m", rounded(radii)),
    })
}

/// The first contradiction between the values of a drive with two pulleys.
pub(super) fn contradiction(two: &TwoPulleys) -> Option<Contradiction> {
    let radii = two.driver_radius + two.driven_radius;
    overlap(radii, two.centre_distance).or_else(|| backwards(Closure::BothSpans(two.load)))
}

/// A tight tension below the slack one.
fn backwards(closure: Closure) -> Option<Contradiction> {
    let Closure::BothSpans(Load { slack, tight }) = closure else {
        return None;
    };
    let [tractive, belt] = schema::TIGHT;
    let (path, low, high) = match (slack, tight) {
        (SpanTension::Tractive(low), SpanTension::Tractive(high)) => (tractive, low, high),
        (SpanTension::Belt(low), SpanTension::Belt(high)) => (belt, low, high),
        _ => return None,
    };
    let is_contradiction = high < low;
    let [low, high] = [low, high].map(rounded);
    is_contradiction.then(|| Contradiction {
        path,
        between: schema::TENSIONS.as_slice(),
        message: format!("the tight tension {high} N is below the slack tension {low} N"),
        expected: format!(
            "a force of at least {low} N; a driven pulley that drives the belt has a negative torque in [[pulley]] tables"
        ),
    })
}

/// A number for a message, with a millionth of its SI unit as last digit.
fn rounded(value: f64) -> String {
    let digits = format!("{value:.6}");
    digits
        .trim_end_matches('0')
        .trim_end_matches('.')
        .to_owned()
}
