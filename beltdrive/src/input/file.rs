//! From checked values to a drive: what must be there, and relations between the values.

use super::{diagnostic::Finding, schema, values::Values};
use crate::{Belt, BeltKind, Drive, FrictionLaw, Load, SpanTension, VBelt};

/// The drive the values state.
pub(super) fn drive(values: &Values<'_>) -> Result<Drive, Finding> {
    // Only V-belts pass the schema; that it is one must still be said.
    values.required_text("belt.type")?;
    let drive = Drive {
        title: values.text("title").map(str::to_owned),
        belt: Belt {
            mass_per_length: values.required_number("belt.mass_per_length")?,
            axial_stiffness: values.required_number("belt.axial_stiffness")?,
            kind: BeltKind::V(VBelt {
                radial_stiffness: values.required_number("belt.radial_stiffness")?,
                half_angle: values.required_number("groove.half_angle")?,
                height: values.number("belt.height"),
            }),
        },
        law: law(values)?,
        friction_coefficient: values.required_number("friction.coefficient")?,
        driver_radius: values.required_number("pulleys.driver.radius")?,
        driver_speed: values.required_number("pulleys.driver.speed")?,
        driven_radius: values.required_number("pulleys.driven.radius")?,
        centre_distance: values.required_number("layout.centre_distance")?,
        load: load(values)?,
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

/// The friction law. Parameters of the other laws may stand in the file for other runs.
fn law(values: &Values<'_>) -> Result<FrictionLaw, Finding> {
    let name = values.required_text("friction.law")?;
    let stiffness = |path| {
        let needed = |finding: Finding| finding.help(format!("the friction law `{name}` needs it"));
        values.required_number(path).map_err(needed)
    };
    Ok(match name {
        "epp" => FrictionLaw::Epp {
            stiffness: stiffness("friction.stiffness")?,
        },
        "bristle" => FrictionLaw::Bristle {
            stiffness: stiffness("friction.bristle_stiffness")?,
        },
        _ => FrictionLaw::Coulomb,
    })
}

fn load(values: &Values<'_>) -> Result<Load, Finding> {
    Ok(Load {
        slack: span_tension(values, schema::SLACK)?,
        tight: span_tension(values, schema::TIGHT)?,
    })
}

/// The tension of a span, stated as tractive or as belt tension.
fn span_tension(
    values: &Values<'_>,
    [tractive, belt]: [&'static str; 2],
) -> Result<SpanTension, Finding> {
    match (values.number(tractive), values.number(belt)) {
        (Some(value), None) => Ok(SpanTension::Tractive(value)),
        (None, Some(value)) => Ok(SpanTension::Belt(value)),
        (None, None) => Err(values.missing(&[tractive, belt])),
        (Some(_), Some(_)) => {
            let message = format!("both `{tractive}` and `{belt}` are given");
            Err(Finding::new(values.place(belt), message)
                .expected("one of them: the tension of a span is stated once"))
        }
    }
}

/// A number for a message, with a millionth of its SI unit as last digit.
fn rounded(value: f64) -> String {
    let digits = format!("{value:.6}");
    digits
        .trim_end_matches('0')
        .trim_end_matches('.')
        .to_owned()
}
