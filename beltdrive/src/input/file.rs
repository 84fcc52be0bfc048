//! From checked values to a drive: what must be there, and relations between the values.

use super::{belt, diagnostic::Finding, friction, load, schema, values::Values};
use crate::{Drive, SpanTension};

/// The drive the values state.
pub(super) fn drive(values: &Values<'_>) -> Result<Drive, Finding> {
    let belt = belt::belt(values)?;
    let drive = Drive {
        title: values.text("title").map(str::to_owned),
        belt,
        law: friction::law(values, belt.kind)?,
        friction_coefficient: values.required_number("friction.coefficient")?,
        driver_radius: values.required_number("pulleys.driver.radius")?,
        driver_speed: values.required_number("pulleys.driver.speed")?,
        driven_radius: values.required_number("pulleys.driven.radius")?,
        centre_distance: values.required_number("layout.centre_distance")?,
        load: load::load(values, belt.kind)?,
    };
    match contradiction(&drive) {
        Some(found) => {
            Err(Finding::new(values.place(found.path), found.message).expected(found.expected))
        }
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

/// The first contradiction between the values of a drive.
pub(super) fn contradiction(drive: &Drive) -> Option<Contradiction> {
    let radii = drive.driver_radius + drive.driven_radius;
    if drive.centre_distance <= radii {
        return Some(Contradiction {
            path: "layout.centre_distance",
            between: &[
                "pulleys.driver.radius",
                "pulleys.driven.radius",
                "layout.centre_distance",
            ],
            message: format!(
                "the pulleys overlap: their radii add up to {} m, the centre distance is {} m",
                rounded(radii),
                rounded(drive.centre_distance)
            ),
            expected: format!("a length greater than {} m", rounded(radii)),
        });
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
