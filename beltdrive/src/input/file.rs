//! From checked values to what they state: what must be there, and relations between the values.

use super::{
    belt, belt_loop, diagnostic::Finding, friction, load, load::Closed, schema, values::Values,
};
use crate::belt_loop::BeltLoop;
use crate::{Drive, Load, SpanTension};

/// What a drive file states.
#[derive(Clone, Debug, PartialEq)]
pub enum Stated {
    /// Two pulleys, closed by the tensions of their spans or by one of them and the driven torque.
    Drive(Drive),
    /// A loop of any number of pulleys.
    Loop(BeltLoop),
}

/// What the values state.
pub(super) fn stated(values: &Values<'_>) -> Result<Stated, Finding> {
    if values.has(schema::PULLEY) {
        return belt_loop::of_list(values).map(Stated::Loop);
    }
    let missing = missing(values);
    if missing.len() > 1 {
        return Err(values.all_missing(&missing));
    }
    let belt = belt::belt(values)?;
    match load::load(values, belt.kind)? {
        Closed::Drive(load) => drive(values, load).map(Stated::Drive),
        Closed::Loop(duty, closure) => {
            let belt_loop = belt_loop::of_two(values, duty, closure)?;
            let distance = values.required_number("layout.centre_distance")?;
            let radii = belt_loop.pulleys.iter().map(|pulley| pulley.radius).sum();
            match overlap(radii, distance) {
                Some(found) => Err(found.finding(values)),
                None => Ok(Stated::Loop(belt_loop)),
            }
        }
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
        let mut others = schema::alternatives(path).into_iter();
        values.has(path) || others.any(|other| values.has(&other))
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

/// The drive the values state with a load.
fn drive(values: &Values<'_>, load: Load) -> Result<Drive, Finding> {
    let belt = belt::belt(values)?;
    let drive = Drive {
        title: values.text("title").map(str::to_owned),
        belt,
        law: friction::law(values, belt.kind)?,
        friction_coefficient: values.required_number("friction.coefficient")?,
        driver_radius: radius(values, "pulleys.driver")?,
        driver_speed: values.required_number("pulleys.driver.speed")?,
        driven_radius: radius(values, "pulleys.driven")?,
        centre_distance: values.required_number("layout.centre_distance")?,
        load,
    };
    match contradiction(&drive) {
        Some(found) => Err(found.finding(values)),
        None => Ok(drive),
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

/// The first contradiction between the values of a drive.
pub(super) fn contradiction(drive: &Drive) -> Option<Contradiction> {
    let radii = drive.driver_radius + drive.driven_radius;
    if let Some(found) = overlap(radii, drive.centre_distance) {
        return Some(found);
    }
    let [tractive, belt] = schema::TIGHT;
    let (path, low, high) = match (drive.load.slack, drive.load.tight) {
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
        expected: format!("a force of at least {low} N"),
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
