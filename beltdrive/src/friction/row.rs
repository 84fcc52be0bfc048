//! What there is to know of a friction law.

use crate::quantity::Measure;
use crate::{BeltKind, FrictionLaw, NormalForce};

/// A friction law.
#[derive(Debug)]
pub(crate) struct Row {
    /// Its name in drive files and outputs.
    pub(crate) name: &'static str,
    /// What it is called in text.
    pub(crate) title: &'static str,
    /// Another kind of law with the same name.
    pub(crate) other: Option<Other>,
    /// Its parameter beside the coefficient of friction, if it has one.
    pub(crate) parameter: Option<Parameter>,
    /// The law with a value of its parameter, SI; without a parameter the value is ignored.
    pub(crate) with: fn(f64) -> FrictionLaw,
    /// Whether it is one for V-belts.
    pub(crate) in_grooves: bool,
    /// What it does with flat belts, if it is a law for these.
    pub(crate) on_rims: Option<OnRims>,
}

/// A law with the name of another one.
#[derive(Debug)]
pub(crate) struct Other {
    /// The dotted path of the entry that tells them apart.
    pub(crate) path: &'static str,
    /// The words for the law that is meant without that entry, and for this one.
    pub(crate) words: [&'static str; 2],
    /// A right value as TOML.
    pub(crate) example: &'static str,
    /// This one.
    pub(crate) row: &'static Row,
}

/// The parameter of a law in drive files.
#[derive(Debug)]
pub(crate) struct Parameter {
    /// Its dotted path.
    pub(crate) path: &'static str,
    /// What it is called.
    pub(crate) name: &'static str,
    /// Its symbol.
    pub(crate) symbol: &'static str,
    /// What it measures.
    pub(crate) measure: Measure,
    /// A right value as TOML.
    pub(crate) example: &'static str,
}

/// A law on the rim of a pulley.
#[derive(Debug)]
pub(crate) struct OnRims {
    /// The convention in whose equations the law is stated, if one serves them all: friction that depends on
    /// speeds and forces alone is the same with small and with finite strains.
    pub(crate) convention: Option<NormalForce>,
}

impl Row {
    /// Whether it is a law for a kind of belt.
    pub(crate) fn is_for(&self, belt: BeltKind) -> bool {
        match belt {
            BeltKind::V(_) => self.in_grooves,
            BeltKind::Flat { .. } => self.on_rims.is_some(),
        }
    }

    /// The convention in which the law is stated for a flat belt with this one.
    pub(crate) fn convention(&self, stated: NormalForce) -> NormalForce {
        let own = self.on_rims.as_ref().and_then(|on_rims| on_rims.convention);
        own.unwrap_or(stated)
    }

    /// Why a belt cannot have the law, if it cannot.
    pub(crate) fn unsuited(&self, belt: BeltKind) -> Option<String> {
        let name = self.name;
        match belt {
            _ if !self.is_for(belt) => Some(format!(
                "{name} is a law for {}",
                match belt {
                    BeltKind::V(_) => "flat belts",
                    BeltKind::Flat { .. } => "V-belts",
                }
            )),
            BeltKind::Flat {
                normal_force: stated @ NormalForce::Thesis,
            } if self.convention(stated) != stated => Some(format!(
                "{name} friction needs the inertia of the belt in the normal force, which `{}` leaves out",
                stated.name()
            )),
            _ => None,
        }
    }
}
