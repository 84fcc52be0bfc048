//! From checked values to a belt: what each type of belt has.

use super::{diagnostic::Finding, overrides, schema::NORMAL_FORCE, values::Values};
use crate::{Belt, BeltKind, NormalForce, VBelt};

/// The belt. What only a V-belt has may stand in the file of a flat belt for other runs.
pub(super) fn belt(values: &Values<'_>) -> Result<Belt, Finding> {
    let is_flat = values.required_text("belt.type")? == "flat";
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number from 1 to 1000"
    )]
    let ribs = values.number("belt.ribs").map_or(1, |ribs| ribs as u32);
    Ok(Belt {
        ribs,
        mass_per_length: values.required_number("belt.mass_per_length")?,
        axial_stiffness: values.required_number("belt.axial_stiffness")?,
        kind: match is_flat {
            true => BeltKind::Flat {
                normal_force: normal_force(values),
            },
            false => BeltKind::V(v_belt(values)?),
        },
    })
}

/// What messages say that a drive with a belt has.
pub(super) fn name(kind: BeltKind) -> &'static str {
    match kind {
        BeltKind::V(_) => "a V-belt",
        BeltKind::Flat { .. } => "a flat belt",
    }
}

fn v_belt(values: &Values<'_>) -> Result<VBelt, Finding> {
    let belt = VBelt {
        radial_stiffness: values.required_number("belt.radial_stiffness")?,
        half_angle: values.required_number("groove.half_angle")?,
        height: values.number("belt.height"),
    };
    // A choice of model, unlike a parameter, would be believed in if it were passed over.
    match values.text(NORMAL_FORCE) {
        None => Ok(belt),
        Some(_) => {
            let message = format!("`{NORMAL_FORCE}` is for flat belts; this drive has a V-belt");
            Err(Finding::new(values.key_place(NORMAL_FORCE), message)
                .help(overrides::removal(NORMAL_FORCE)))
        }
    }
}

fn normal_force(values: &Values<'_>) -> NormalForce {
    let stated = values.text(NORMAL_FORCE);
    NormalForce::ALL
        .into_iter()
        .find(|force| Some(force.name()) == stated)
        .unwrap_or_default()
}
