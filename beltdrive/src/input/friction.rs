//! From checked values to a friction law: which laws a belt can have, and what they need.

use super::{belt, check, diagnostic::Finding, schema, values::Values};
use crate::friction::{ROWS, Row};
use crate::{BeltKind, FrictionLaw, NormalForce};

/// The friction law. Parameters of the other laws may stand in the file for other runs.
pub(super) fn law(values: &Values<'_>, belt: BeltKind) -> Result<FrictionLaw, Finding> {
    let name = values.required_text("friction.law")?;
    let row = row(values).expect("a law of the list");
    suits(row, belt, values)?;
    let value = row.parameter.as_ref().map(|parameter| {
        let needed = |finding: Finding| finding.help(format!("the friction law `{name}` needs it"));
        values.required_number(parameter.path).map_err(needed)
    });
    Ok((row.with)(value.transpose()?.unwrap_or_default()))
}

/// The row of the law that the values name.
pub(super) fn row(values: &Values<'_>) -> Option<&'static Row> {
    let name = values.text("friction.law")?;
    let row = ROWS.iter().copied().find(|row| row.name == name)?;
    Some(match &row.other {
        Some(other) if values.text(other.path) == Some(other.words[1]) => other.row,
        _ => row,
    })
}

/// Whether a belt can have a law.
fn suits(row: &Row, belt: BeltKind, values: &Values<'_>) -> Result<(), Finding> {
    let Some(reason) = row.unsuited(belt) else {
        return Ok(());
    };
    if row.is_for(belt) {
        let conventions: Vec<_> = NormalForce::ALL
            .into_iter()
            .filter(|&normal_force| row.unsuited(BeltKind::Flat { normal_force }).is_none())
            .map(NormalForce::name)
            .collect();
        let place = values.place(schema::NORMAL_FORCE);
        return Err(Finding::new(place, reason).expected(check::one_of(&conventions)));
    }
    let laws: Vec<_> = ROWS
        .iter()
        .copied()
        .filter(|row| row.is_for(belt))
        .map(|row| row.name)
        .collect();
    let message = format!("{reason}; this drive has {}", belt::name(belt));
    Err(Finding::new(values.place("friction.law"), message).expected(check::one_of(&laws)))
}
