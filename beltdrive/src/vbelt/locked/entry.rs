//! The place of rest of a belt that enters a pulley with the tension of a span, and the way there.

use super::arc::Point;
use super::rest::{On, Rest};
use crate::SpanTension;
use crate::mechanics::root::bracketed;
use crate::vbelt::Groove;
use crate::vbelt::groove::{LAW, TENSION};

/// Relative accuracy of the tensions at which the belt enters: its slip behind the place of rest is the rest of two
/// tensions that may differ by as little as 1e-7.
const TENSION_ACCURACY: f64 = 1e-9;
/// The most secant steps to that.
const MOST_SECANTS: usize = 20;
/// The displacements over that at which elastic friction reaches its limit with which it is tried whether friction holds a belt:
/// the largest, by how much the next one is smaller, and the smallest.
const JUST_HELD: f64 = 0.999;
const SMALLER: f64 = 0.7;
const LEAST_HELD: f64 = 1e-3;

/// A place of rest and the way there.
pub(super) type Entering = (Rest, Vec<Point>);

/// The place of rest of a belt that comes from a span, and the way there.
pub(super) fn entering(on: On, groove: &Groove, span: SpanTension) -> Option<Entering> {
    let asked = span.value();
    let mut tractive = groove.strand.tractive_of(span, 1.0);
    let mut before: Option<[f64; 2]> = None;
    for _ in 0..MOST_SECANTS {
        let (there, entry) = coming_to_rest(on, groove, tractive)?;
        let found = entry[0].states[TENSION];
        let excess = groove.strand.prescribed(span, found, there.rim.flow) - asked;
        if excess.abs() <= TENSION_ACCURACY * asked {
            return Some((there, entry));
        }
        // The tension at the entry is nearly that at the place of rest.
        let slope = before.map_or(1.0, |[other, then]| (excess - then) / (tractive - other));
        before = Some([tractive, excess]);
        tractive -= excess / slope;
    }
    None
}

/// The way to rest with a tractive tension there, on which the displacement of elastic friction grows from zero.
fn coming_to_rest(on: On, groove: &Groove, tractive: f64) -> Option<Entering> {
    let of = |displaced: f64| {
        let rest = Rest::new(groove, on, tractive, displaced)?;
        rest.entry().map(|entry| (rest, entry))
    };
    if groove.elastic().is_none() {
        return of(0.0);
    }
    let growing = Rest::new(groove, on, tractive, 1.0)?.growing().signum();
    [growing, -growing].into_iter().find_map(|sense| {
        let displaced = with_sense(|displaced| of(sense * displaced))?;
        // A displacement that falls lets a belt go.
        let holds = displaced > 1.0 || sense == growing;
        holds.then(|| of(sense * displaced))?
    })
}

/// The displacement over that at the limit with which it is zero at the entry, if there is one.
fn with_sense(of: impl Fn(f64) -> Option<Entering>) -> Option<f64> {
    // The displacement at the entry over that at the limit.
    let at_entry = |displaced: f64| {
        of(displaced).map_or(f64::NAN, |(rest, entry)| {
            displaced * entry[0].states[LAW + 1] / rest.displacement
        })
    };
    let mut from = (JUST_HELD, at_entry(JUST_HELD));
    // Where the belt slides into its place of rest the displacement is only carried along.
    let is_held = from.1 > 0.0;
    let mut further = -from.1;
    loop {
        let to = match is_held {
            true => SMALLER * from.0,
            false => from.0 + further,
        };
        let to = (to, at_entry(to));
        if to.1.is_nan() || to.0 < LEAST_HELD {
            return None;
        }
        if is_held != (to.1 > 0.0) {
            return bracketed(at_entry, [from.0, to.0], [from.1, to.1]);
        }
        from = to;
        further *= 2.0;
    }
}
