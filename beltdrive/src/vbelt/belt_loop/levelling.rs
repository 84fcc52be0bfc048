//! The largest value of a curve of states before the curve gets there.
//!
//! A curve that turns back has a tangent whose component along the parameter falls to zero at the limit point, and
//! one that slips ever faster a component that decays. Close to the limit its last two values tell how much is left,
//! so that the limit point itself, whose labelled state would be refined in several turns, is not needed: it took
//! 2.6 s of the 3.3 s that the load limit of three stiff grooves did.

use continuation::{Kind, Point};

/// The limit is known where the rest of the way up is no more than this, relative: the digits that are shown.
const KNOWN: f64 = 1e-6;

/// Largest share of the parameter in the direction of the curve there, against that at its first point: a curve that
/// rises more is not level.
const LEVEL: f64 = 1e-2;

/// What is known of a rising curve.
#[derive(Default)]
pub(super) struct Levelling {
    /// Slope with the arclength at the first point.
    first: Option<f64>,
    /// Arclength and slope at the last point.
    last: Option<[f64; 2]>,
}

impl Levelling {
    /// The largest parameter, if it is known from this next point of the curve, which begins anew with every piece. `scale`
    /// is what it is relative to.
    pub(super) fn top(&mut self, point: &Point, scale: f64) -> Option<f64> {
        if point.kind == Kind::Start {
            *self = Self::default();
        }
        let slope = point.tangent[point.tangent.len() - 1];
        let first = *self.first.get_or_insert(slope);
        let [arclength, before] = self.last.replace([point.arclength, slope])?;
        // The slope falls in proportion to the way.
        let rest = 0.5 * slope * slope * (point.arclength - arclength) / (before - slope);
        let is_level = 0.0 < slope && slope < before && slope < LEVEL * first;
        (is_level && rest < KNOWN * scale).then(|| point.lambda() + rest)
    }
}
