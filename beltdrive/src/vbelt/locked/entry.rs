//! The place of rest of a belt that enters a pulley with the tension of a span, and the way there.

use super::arc::Point;
use super::rest::{On, Rest};
use crate::SpanTension;
use crate::mechanics::root::bracketed_to;
use crate::vbelt::Groove;
use crate::vbelt::groove::{LAW, TENSION};

/// Relative accuracy of the tensions at which the belt enters: its slip behind the place of rest is the rest of two
/// tensions that may differ by as little as 1e-7.
const TENSION_ACCURACY: f64 = 1e-9;
/// The most secant steps to that.
const MOST_SECANTS: usize = 20;
/// Accuracy of the displacement at the entry over that at which friction reaches its limit, and the most secant steps to that from
/// one near by: from afar five to nine are taken before there is a bracket.
const DISPLACEMENT_ACCURACY: f64 = 1e-9;
const MOST_SECANTS_NEAR: usize = 8;
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
    let mut displaced = None;
    for _ in 0..MOST_SECANTS {
        let to_rest = ToRest {
            on,
            groove,
            tractive,
        };
        let (there, entry) = match groove.elastic() {
            None => to_rest.with(0.0)?,
            Some(_) => {
                let near = displaced.and_then(|near| to_rest.displaced_near(near));
                let (found, entering) = near.or_else(|| {
                    let found = to_rest.displaced()?;
                    Some((found, to_rest.with(found)?))
                })?;
                displaced = Some(found);
                entering
            }
        };
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

/// A belt that comes to rest with a tractive tension.
struct ToRest<'g> {
    on: On,
    groove: &'g Groove,
    tractive: f64,
}

impl ToRest<'_> {
    /// The place of rest and the way there with a displacement, as in [`Rest::new`].
    fn with(&self, displaced: f64) -> Option<Entering> {
        let rest = Rest::new(self.groove, self.on, self.tractive, displaced)?;
        rest.entry().map(|entry| (rest, entry))
    }

    /// The displacement at the entry over that at the limit.
    fn at_entry(&self, displaced: f64) -> f64 {
        let with = self.with(displaced);
        with.map_or(f64::NAN, |entering| over_limit(&entering, displaced))
    }

    /// The displacement with which it is zero at the entry, if there is one.
    fn displaced(&self) -> Option<f64> {
        let growing = Rest::new(self.groove, self.on, self.tractive, 1.0)?.growing();
        let sense = growing.signum();
        [sense, -sense].into_iter().find_map(|sense| {
            let displaced = self.with_sense(sense)?;
            // A displacement that falls lets a belt go.
            let holds = displaced.abs() > 1.0 || displaced * growing > 0.0;
            holds.then_some(displaced)
        })
    }

    /// The same with a sense, from where friction is just held to either side.
    fn with_sense(&self, sense: f64) -> Option<f64> {
        let at_entry = |displaced| sense * self.at_entry(displaced);
        let mut from = (sense * JUST_HELD, at_entry(sense * JUST_HELD));
        // Where the belt slides into its place of rest the displacement is only carried along.
        let is_held = from.1 > 0.0;
        let mut further = -from.1;
        loop {
            let to = match is_held {
                true => SMALLER * from.0,
                false => from.0 + sense * further,
            };
            let to = (to, at_entry(to));
            if to.1.is_nan() || to.0.abs() < LEAST_HELD {
                return None;
            }
            if is_held != (to.1 > 0.0) {
                let ends = [from, to].map(|end| end.0);
                return bracketed_to(DISPLACEMENT_ACCURACY, at_entry, ends, [from.1, to.1]);
            }
            from = to;
            further *= 2.0;
        }
    }

    /// The same, and the way there, by the secant from a displacement near by with which friction is at its limit or not, too.
    fn displaced_near(&self, near: f64) -> Option<(f64, Entering)> {
        let mut place = near;
        let mut before: Option<[f64; 2]> = None;
        for _ in 0..MOST_SECANTS_NEAR {
            let entering = self.with(place)?;
            let off = over_limit(&entering, place);
            if off.abs() <= DISPLACEMENT_ACCURACY {
                return Some((place, entering));
            }
            // What is there too much at the rest is so at the entry.
            let slope = before.map_or(1.0, |[other, then]| (off - then) / (place - other));
            before = Some([place, off]);
            place -= off / slope;
            let is_alike = place * near > 0.0 && (place.abs() < 1.0) == (near.abs() < 1.0);
            if !is_alike {
                return None;
            }
        }
        None
    }
}

/// The displacement at the entry of a belt that comes to rest with one, over that at the limit.
fn over_limit((rest, entry): &Entering, displaced: f64) -> f64 {
    displaced * entry[0].states[LAW + 1] / rest.displacement
}
