//! The arc on which a belt leaves a pulley into a span.

use super::arc::{Origin, Point};
use super::rest::Rest;
use crate::SpanTension;
use crate::vbelt::groove::INCLINATION;

/// How far off a belt may come by the place of rest, as [`Origin::deeper`]: where it comes by is known to a tenth of the slip with
/// which it breaks away, so that the arc is as accurate as a thousandth of that.
const EXIT_ACCURACY: f64 = 0.01;
/// The same where friction held it, in slips with which it begins to rise: as accurate as that slip has to be.
const HELD_ACCURACY: f64 = 0.01;
/// Between these shares of the inclination of a belt that hardly slips as it breaks away lies that at an exit: on the drive of
/// Kim (2009) it is 1.03 of it with 105 N, and 1.6 with 200 N.
const EXITS: [f64; 2] = [0.3, 3.0];
/// The same of λ times the depth where friction held the belt, of which it is 0.087 to 1.9 on random drives without load. It is
/// nowhere steeper than this, almost upright.
const LOOSE_EXITS: [f64; 2] = [0.03, 30.0];
const STEEPEST: f64 = 1.5;
/// Between these shares of an inclination lies the next one, as the displacement is corrected by some hundredths.
const BESIDE: [f64; 2] = [0.97, 1.03];
/// Inclinations are told apart by this share of themselves: some hundred roundings.
const NARROWEST: f64 = 1e-13;
/// Between inclinations this near to each other, as a share, an arc that takes too many steps ends the search: without it states of
/// drives whose loads are raised in vain take 1.5 to 2 times as long, and with 1e-3 a state found in 0.12 s takes 0.8 s.
const NARROW: f64 = 1e-5;
/// A slip at which the direction has one digit in a million: a belt that slips less is taken for one that does not slip.
const NO_SLIP: f64 = 1e-10;
/// The share of friction along the pulley of a belt that follows the groove with the slip at which it breaks away. With
/// more it slides along an arc before it is lifted: on the drive of Kim (2009) Newton's method failed with 0.148.
const SLIDES: f64 = 0.13;

/// A belt that leaves a pulley.
pub(super) struct Leaving {
    pub(super) exit: Vec<Point>,
    /// The slip at which it breaks away.
    pub(super) slip: f64,
    /// The displacement of elastic friction with which it breaks loose where friction held it.
    pub(super) displacement: f64,
    /// The same at the exit.
    at_exit: f64,
}

/// A belt that leaves its place of rest into a span. Where friction held it the displacement of that is about `displacement` as it
/// breaks loose.
pub(super) fn leaving(rest: &Rest, span: SpanTension, displacement: f64) -> Option<Leaving> {
    match rest.is_held {
        true => loose(rest, span, displacement, None),
        false => sliding(&rest.sliding(), span),
    }
}

impl Leaving {
    /// The same where friction held the belt, with another displacement.
    pub(super) fn corrected(&self, rest: &Rest, span: SpanTension, missed: f64) -> Option<Self> {
        loose(rest, span, self.at_exit + missed, Some(self.theta()))
    }

    /// The inclination at the exit.
    pub(super) fn theta(&self) -> f64 {
        self.exit[self.exit.len() - 1].states[INCLINATION]
    }
}

/// Whether a belt that friction does not hold at its place of rest slides along the pulley before it leaves into a span.
pub(super) fn slides_along(rest: &Rest, span: SpanTension) -> bool {
    !rest.is_held && hardly_slipping(&rest.sliding(), span).is_none()
}

/// The arc on which a belt with full friction leaves its place of rest without slip, and the slip with which it breaks away if the
/// span has another tension; `None` if it slides along the pulley with that.
fn hardly_slipping(rest: &Rest, span: SpanTension) -> Option<(Vec<Point>, f64)> {
    let plain = rest.plain_exit()?;
    let [tractive, ..] = plain[plain.len() - 1].states;
    let strand = rest.rim.groove.strand;
    let asked = strand.tractive_of(span, rest.rim.flow);
    let slip = strand.compliance * (asked - tractive).abs();
    (slip * rest.turning <= SLIDES).then_some((plain, slip))
}

/// As [`leaving`], of a belt with full friction.
fn sliding(rest: &Rest, span: SpanTension) -> Option<Leaving> {
    let (plain, slip) = hardly_slipping(rest, span)?;
    let exit = match slip < NO_SLIP {
        true => plain,
        false => {
            let asked = rest.rim.groove.strand.tractive_of(span, rest.rim.flow);
            let theta = plain[plain.len() - 1].states[INCLINATION];
            let range = EXITS.map(|share| share * theta);
            let origin = |theta| rest.origin(asked, theta, slip);
            rest.arc_from(search(range, EXIT_ACCURACY, origin)?)
        }
    };
    Some(Leaving {
        exit,
        slip,
        displacement: 0.0,
        at_exit: 0.0,
    })
}

/// A belt that friction held and that leaves into a span with the displacement `at_exit`, at about the inclination `beside` if one is
/// known.
fn loose(rest: &Rest, span: SpanTension, at_exit: f64, beside: Option<f64>) -> Option<Leaving> {
    let asked = rest.rim.groove.strand.tractive_of(span, rest.rim.flow);
    let within = |range| {
        [true, false].into_iter().find_map(|by_slip| {
            let origin = |theta| rest.held_origin([asked, theta, at_exit], by_slip);
            search(range, HELD_ACCURACY, origin)
        })
    };
    let near = beside.and_then(|theta| {
        let range = BESIDE.map(|share| share * theta);
        let [low, high] = range.map(|theta| rest.held_origin([asked, theta, at_exit], true).deeper);
        (low < 0.0 && high > 0.0).then(|| within(range))?
    });
    let origin = near.or_else(|| {
        let theta = rest.rate * rest.depth;
        within(LOOSE_EXITS.map(|share| (share * theta).min(STEEPEST)))
    })?;
    Some(Leaving {
        slip: origin.slip(),
        displacement: origin.displacement(),
        at_exit,
        exit: rest.arc_from(origin),
    })
}

/// The arc from the place of rest to an exit at whose inclination `origin` tells by how much it comes from deeper, by bisection and,
/// as soon as arcs come by on both sides, by the secant between them.
fn search(
    [mut low, mut high]: [f64; 2],
    accuracy: f64,
    origin: impl Fn(f64) -> Origin,
) -> Option<Origin> {
    let mut beside = [f64::NEG_INFINITY, f64::INFINITY];
    let mut nearest: Option<Origin> = None;
    let mut before = 0.0;
    loop {
        let share = match beside {
            [from, to] if from.is_finite() && to.is_finite() => from / (from - to),
            _ => 0.5,
        };
        let middle = low + share * (high - low);
        if middle <= low || middle >= high || high - low < NARROWEST * high {
            break;
        }
        let found = origin(middle);
        let deeper = found.deeper;
        if found.is_cut_off() && high - low < NARROW * high {
            break;
        }
        // Illinois: an end that stays twice counts half.
        let stays = if deeper * before > 0.0 { 0.5 } else { 1.0 };
        match deeper < 0.0 {
            true => (low, beside) = (middle, [deeper, stays * beside[1]]),
            false => (high, beside) = (middle, [stays * beside[0], deeper]),
        }
        before = deeper;
        if nearest
            .as_ref()
            .is_none_or(|nearest| deeper.abs() <= nearest.deeper.abs())
        {
            nearest = Some(found);
        }
        if deeper.abs() <= accuracy {
            break;
        }
    }
    nearest.filter(|nearest| nearest.deeper.is_finite())
}
