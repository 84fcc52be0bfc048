//! From checked values to a friction law: which laws a belt can have, and what they need.

use super::{belt, check, diagnostic::Finding, schema, values::Values};
use crate::{BeltKind, FrictionLaw, NormalForce};

/// The friction law. Parameters of the other laws may stand in the file for other runs.
pub(super) fn law(values: &Values<'_>, belt: BeltKind) -> Result<FrictionLaw, Finding> {
    let name = values.required_text("friction.law")?;
    suits(name, belt, values)?;
    let number = |path| {
        let needed = |finding: Finding| finding.help(format!("the friction law `{name}` needs it"));
        values.required_number(path).map_err(needed)
    };
    Ok(match name {
        "epp" => FrictionLaw::Epp {
            stiffness: number("friction.stiffness")?,
        },
        "bristle" => FrictionLaw::Bristle {
            stiffness: number("friction.bristle_stiffness")?,
        },
        "creep-rate" => FrictionLaw::CreepRate {
            velocity: number("friction.velocity")?,
        },
        _ => FrictionLaw::Coulomb,
    })
}

/// Whether a belt can have the law of a name.
fn suits(name: &str, belt: BeltKind, values: &Values<'_>) -> Result<(), Finding> {
    if !is_for(name, belt) {
        let this = belt::name(belt);
        let others = match belt {
            BeltKind::V(_) => "flat belts",
            BeltKind::Flat { .. } => "V-belts",
        };
        let laws: Vec<_> = schema::LAWS
            .into_iter()
            .filter(|law| is_for(law, belt))
            .collect();
        let message = format!("{name} is a law for {others}; this drive has {this}");
        return Err(
            Finding::new(values.place("friction.law"), message).expected(check::one_of(&laws))
        );
    }
    let thesis = BeltKind::Flat {
        normal_force: NormalForce::Thesis,
    };
    if name == "creep-rate" && belt == thesis {
        let message = "creep-rate friction needs the inertia of the belt in the normal force, \
                       which `thesis` leaves out";
        let place = values.place(schema::NORMAL_FORCE);
        return Err(Finding::new(place, message).expected(check::one_of(&["inertia", "exact"])));
    }
    Ok(())
}

/// Whether a law is one for a type of belt.
fn is_for(law: &str, belt: BeltKind) -> bool {
    match law {
        "bristle" => matches!(belt, BeltKind::V(_)),
        "creep-rate" => matches!(belt, BeltKind::Flat { .. }),
        _ => true,
    }
}
