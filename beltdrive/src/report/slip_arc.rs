//! The part of a wrap over which the belt slides.

use crate::{Zone, ZoneKind};

/// The sum of the slip zones of a pulley, rad.
pub(crate) fn slip_arc(zones: &[Zone]) -> f64 {
    let slip = zones.iter().filter(|zone| zone.kind == ZoneKind::Slip);
    // A sum of nothing is a negative zero.
    0.0 + slip.map(|zone| zone.to - zone.from).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_slip_zones_count() {
        let zone = |kind, from, to| Zone { kind, from, to };
        let zones = [
            zone(ZoneKind::Slip, 0.0, 0.5),
            zone(ZoneKind::Elastic, 0.5, 2.0),
            zone(ZoneKind::Slip, 2.0, 3.0),
        ];
        assert_eq!(slip_arc(&zones), 1.5);
        assert_eq!(slip_arc(&zones[1..2]).to_string(), "0");
    }
}
