//! The belt of a drive in words: for people and, as fixed words, for programs.

use crate::quantity::words;
use crate::{BeltKind, Drive};
use serde::Serialize;

/// What a drive is called without a title of its own.
pub(super) fn description(drive: &Drive) -> &'static str {
    match drive.belt.kind {
        BeltKind::V(_) => "Two-pulley V-belt drive",
        BeltKind::Flat { .. } => "Two-pulley flat-belt drive",
    }
}

/// How the normal force of a flat belt follows from its tension; nothing for a V-belt.
pub(crate) fn convention(drive: &Drive) -> Option<&'static str> {
    words::convention(drive.belt.kind)
}

/// The kind of the belt as JSON.
#[derive(Serialize)]
pub(super) struct BeltReport {
    belt_type: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    normal_force: Option<&'static str>,
}

impl From<&Drive> for BeltReport {
    fn from(drive: &Drive) -> Self {
        let (belt_type, normal_force) = match drive.belt.kind {
            BeltKind::V(_) => ("v", None),
            BeltKind::Flat { normal_force } => ("flat", Some(normal_force.name())),
        };
        Self {
            belt_type,
            normal_force,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::NormalForce;
    use crate::report::{sample, sample_flat};

    #[test]
    fn every_convention_is_told_from_the_others() {
        let mut drive = sample_flat::epp().drive;
        let mut words = NormalForce::ALL.map(|normal_force| {
            drive.belt.kind = BeltKind::Flat { normal_force };
            convention(&drive).unwrap()
        });
        words.sort_unstable();
        assert!(words.windows(2).all(|pair| pair[0] != pair[1]), "{words:?}");
        assert_eq!(convention(&sample::loaded().drive), None);
    }
}
