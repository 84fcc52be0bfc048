//! From checked values to a friction law: which laws a belt can have, and what they need.

use super::{belt, check, diagnostic::Finding, schema, values::Values};
use crate::friction::{ROWS, Row};
use crate::{BeltKind, FrictionLaw, NormalForce};

/// The entry that names the law.
pub(super) const LAW: &str = "friction.law";

/// The friction law. Parameters of the other laws may stand in the file for other runs.
pub(super) fn law(values: &Values<'_>, belt: BeltKind) -> Result<FrictionLaw, Finding> {
    let name = values.required_text(LAW)?;
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
    let name = values.text(LAW)?;
    let row = ROWS.iter().copied().find(|row| row.name == name)?;
    Some(match &row.other {
        Some(other) if values.text(other.path) == Some(other.words[1]) => other.row,
        _ => row,
    })
}

/// How a law is asked for of which a kind was given in place of its name, or with it, as in `vector_epp`.
pub(super) fn kind_of(text: &str) -> Option<String> {
    let text = text.to_lowercase();
    let parts = text.split(['_', '-', '.', ' ']);
    ROWS.iter().find_map(|row| {
        let (name, other) = (row.name, row.other.as_ref()?);
        let word = parts.clone().find(|part| other.words.contains(part))?;
        let is_this = parts.clone().all(|part| part == name || part == word);
        is_this.then(|| format!("did you mean `{name}` with `{} = \"{word}\"`?", other.path))
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
    Err(Finding::new(values.place(LAW), message).expected(check::one_of(&laws)))
}
