//! Events, ends and limits in words: for people and, as fixed words, for programs.

use super::words;
use crate::input::Key;
use crate::{BeltKind, BranchEnd, Drive, EventKind, LimitReason, RangeEnd, Role, ZoneKind};

/// The word for a kind of event in JSON and CSV.
pub(crate) fn event_kind(kind: EventKind) -> &'static str {
    match kind {
        EventKind::Start => "start",
        EventKind::LimitPoint => "fold",
        EventKind::BranchPoint => "branch point",
        EventKind::Overhang(_) => "overhang",
        EventKind::GrossSlip(_) => "gross slip",
        EventKind::ZoneAppears { .. } => "zone appears",
        EventKind::ZoneVanishes { .. } => "zone vanishes",
        EventKind::BeltHeight(_) => "belt height",
        EventKind::End => "end",
    }
}

/// The pulley an event is about, if it is about one.
pub(crate) fn event_pulley(kind: EventKind) -> Option<Role> {
    match kind {
        EventKind::Overhang(pulley)
        | EventKind::GrossSlip(pulley)
        | EventKind::BeltHeight(pulley)
        | EventKind::ZoneAppears { pulley, .. }
        | EventKind::ZoneVanishes { pulley, .. } => Some(pulley),
        EventKind::Start | EventKind::LimitPoint | EventKind::BranchPoint | EventKind::End => None,
    }
}

/// The kind of the friction zone an event is about, if it is about one.
pub(crate) fn event_zone(kind: EventKind) -> Option<ZoneKind> {
    match kind {
        EventKind::ZoneAppears { kind, .. } | EventKind::ZoneVanishes { kind, .. } => Some(kind),
        _ => None,
    }
}

/// An event in at most 21 letters, for a column.
pub(crate) fn event_label(kind: EventKind) -> String {
    match kind {
        EventKind::ZoneAppears { pulley, kind } => {
            format!("+{}, {}", kind.name(), words::pulley(pulley))
        }
        EventKind::ZoneVanishes { pulley, kind } => {
            format!("−{}, {}", kind.name(), words::pulley(pulley))
        }
        EventKind::Overhang(pulley) => format!("90°, {}", words::pulley(pulley)),
        _ => match event_pulley(kind) {
            Some(pulley) => format!("{}, {}", event_kind(kind), words::pulley(pulley)),
            None => event_kind(kind).to_owned(),
        },
    }
}

/// What happens at an event of a branch of a drive over an entry.
pub(crate) fn event(kind: EventKind, key: Key, drive: &Drive) -> String {
    match kind {
        EventKind::Start => "the branch starts".to_owned(),
        EventKind::LimitPoint => format!("limit point: the {} turns back", key.name()),
        EventKind::BranchPoint => "branch point: another branch crosses".to_owned(),
        EventKind::Overhang(pulley) => {
            format!(
                "the inclination of the belt reaches 90° on the {}",
                pulley.name()
            )
        }
        EventKind::GrossSlip(pulley) => gross_slip(pulley, drive),
        EventKind::ZoneAppears { pulley, kind } => {
            let kind = kind.name();
            format!("a zone of {kind} friction appears on the {}", pulley.name())
        }
        EventKind::ZoneVanishes { pulley, kind } => {
            let kind = kind.name();
            format!(
                "a zone of {kind} friction vanishes from the {}",
                pulley.name()
            )
        }
        EventKind::BeltHeight(pulley) => format!(
            "the belt sinks into the groove of the {} by its whole height",
            pulley.name()
        ),
        EventKind::End => "the branch ends".to_owned(),
    }
}

/// Gross slip in words. That of a flat belt may or may not stop the driven pulley.
fn gross_slip(pulley: Role, drive: &Drive) -> String {
    match (drive.belt.kind, pulley) {
        (BeltKind::V(_), Role::Driven) => LimitReason::DrivenSlips.to_string(),
        (BeltKind::V(_), Role::Driver) => LimitReason::DriverSlips.to_string(),
        (BeltKind::Flat { .. }, _) => BranchEnd::GrossSlip(pulley).to_string(),
    }
}

/// The word for the end of a branch in JSON.
pub(crate) fn end_kind(end: &BranchEnd) -> &'static str {
    match end {
        BranchEnd::Target => "target",
        BranchEnd::Returned => "returned",
        BranchEnd::GrossSlip(_) => "gross slip",
        BranchEnd::NoLoad => "no load",
        BranchEnd::LiftsOff => "lift-off",
        BranchEnd::Closed => "closed",
        BranchEnd::NotConverged { .. } => "not converged",
    }
}

/// The word for the reason of a limit in JSON and CSV.
pub(crate) fn limit_kind(reason: LimitReason) -> &'static str {
    match reason {
        LimitReason::DriverSlips | LimitReason::Overhang => "fold",
        LimitReason::DrivenSlips | LimitReason::Capstan(_) => "gross slip",
        LimitReason::LiftsOff => "lift-off",
    }
}

/// The pulley a limit is about, if it is about one.
pub(crate) fn limit_pulley(reason: LimitReason) -> Option<Role> {
    match reason {
        LimitReason::DriverSlips | LimitReason::Overhang => Some(Role::Driver),
        LimitReason::DrivenSlips => Some(Role::Driven),
        LimitReason::Capstan(pulley) => Some(pulley),
        LimitReason::LiftsOff => None,
    }
}

/// Reason of a limit in few letters, for columns and legends.
pub(crate) fn limit_label(reason: LimitReason) -> &'static str {
    match reason {
        LimitReason::Overhang => "fold: driver overhangs",
        LimitReason::DriverSlips => "fold: driver slips",
        LimitReason::DrivenSlips | LimitReason::Capstan(Role::Driven) => "driven pulley slips",
        LimitReason::Capstan(Role::Driver) => "driver slips",
        LimitReason::LiftsOff => "belt lifts off",
    }
}

/// The word for the end of a range in JSON and CSV.
pub(crate) fn range_end_kind(end: RangeEnd) -> &'static str {
    match end {
        RangeEnd::Limit(reason) => limit_kind(reason),
        RangeEnd::NoLoad => "no load",
        RangeEnd::NotFound => "none found",
    }
}

/// The pulley the end of a range is about, if it is about one.
pub(crate) fn range_end_pulley(end: RangeEnd) -> Option<Role> {
    match end {
        RangeEnd::Limit(reason) => limit_pulley(reason),
        RangeEnd::NoLoad | RangeEnd::NotFound => None,
    }
}

/// The end of a range in few letters.
pub(crate) fn range_end_label(end: RangeEnd) -> &'static str {
    match end {
        RangeEnd::Limit(reason) => limit_label(reason),
        RangeEnd::NoLoad | RangeEnd::NotFound => range_end_kind(end),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::samples::{flat, v_belt};

    #[test]
    fn every_event_has_a_short_label_and_words() {
        let pulleys = [Role::Driver, Role::Driven];
        let of_pulley = pulleys.into_iter().flat_map(|pulley| {
            let kind = ZoneKind::Elastic;
            [
                EventKind::Overhang(pulley),
                EventKind::GrossSlip(pulley),
                EventKind::BeltHeight(pulley),
                EventKind::ZoneAppears { pulley, kind },
                EventKind::ZoneVanishes { pulley, kind },
            ]
        });
        let plain = [
            EventKind::Start,
            EventKind::LimitPoint,
            EventKind::BranchPoint,
        ];
        let kinds = plain.into_iter().chain([EventKind::End]).chain(of_pulley);
        let drive = v_belt::loaded().drive;
        let key = Key::load(&drive);
        let mut words = Vec::new();
        for kind in kinds {
            let label = event_label(kind);
            assert!((3..=21).contains(&label.chars().count()), "{label}");
            assert_eq!(
                event_zone(kind).is_some(),
                event_kind(kind).starts_with("zone")
            );
            let is_plain = event_pulley(kind).is_none();
            assert_eq!(is_plain, !label.contains(", "), "{label}");
            words.push(event(kind, key, &drive));
        }
        words.sort_unstable();
        words.dedup();
        assert_eq!(words.len(), 14);
    }

    #[test]
    fn gross_slip_of_a_flat_belt_need_not_stop_a_pulley() {
        let drive = flat::epp().drive;
        let key = Key::load(&drive);
        let words = event(EventKind::GrossSlip(Role::Driven), key, &drive);
        assert_eq!(words, "the driven pulley slips grossly");
        let reason = LimitReason::Capstan(Role::Driver);
        let end = RangeEnd::Limit(reason);
        assert_eq!(range_end_kind(end), "gross slip");
        assert_eq!(range_end_pulley(end), Some(Role::Driver));
    }

    #[test]
    fn ends_of_ranges_have_a_word_a_pulley_and_a_label() {
        let of = |end| {
            (
                range_end_kind(end),
                range_end_pulley(end),
                range_end_label(end),
            )
        };
        let limit = |reason| of(RangeEnd::Limit(reason));
        let driver = Some(Role::Driver);
        let overhang = ("fold", driver, "fold: driver overhangs");
        assert_eq!(limit(LimitReason::Overhang), overhang);
        let slips = ("fold", driver, "fold: driver slips");
        assert_eq!(limit(LimitReason::DriverSlips), slips);
        let driven = Some(Role::Driven);
        let slips = ("gross slip", driven, "driven pulley slips");
        assert_eq!(limit(LimitReason::DrivenSlips), slips);
        assert_eq!(of(RangeEnd::NoLoad), ("no load", None, "no load"));
        assert_eq!(of(RangeEnd::NotFound), ("none found", None, "none found"));
        let words = RangeEnd::Limit(LimitReason::DrivenSlips).to_string();
        assert_eq!(words, LimitReason::DrivenSlips.to_string());
        assert!(RangeEnd::NotFound.to_string().starts_with("no limit"));
    }

    #[test]
    fn every_end_has_a_word_and_a_description() {
        let cause = "mesh limit".to_owned();
        let ends = [
            (BranchEnd::Target, "target"),
            (BranchEnd::Returned, "returned"),
            (BranchEnd::GrossSlip(Role::Driven), "gross slip"),
            (BranchEnd::NoLoad, "no load"),
            (BranchEnd::Closed, "closed"),
            (BranchEnd::NotConverged { cause }, "not converged"),
        ];
        for (end, word) in &ends {
            assert_eq!(end_kind(end), *word);
        }
        assert_eq!(ends[2].0.to_string(), "the driven pulley slips grossly");
        assert!(ends[5].0.to_string().ends_with("not found: mesh limit"));
    }
}
