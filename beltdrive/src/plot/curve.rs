//! Smooth curves through places.

use super::sheet::{Sheet, Spot, Stroke, pair};

/// Places of a line that are on average this far apart, px, have a smooth curve through them; a line through
/// closer ones has no corner that could be seen.
const SPARSE: f64 = 6.0;

/// Draws a curve through places.
pub(super) fn draw(sheet: &mut Sheet, places: &[Spot], stroke: Stroke) {
    let length: f64 = places
        .windows(2)
        .map(|ends| (ends[1] - ends[0]).norm())
        .sum();
    if length > SPARSE * places.len() as f64 {
        sheet.path(&smooth(places), stroke);
    } else {
        sheet.line(&straightened(places), stroke);
    }
}

/// The places of a line without those that lie on the line through their neighbours.
fn straightened(places: &[Spot]) -> Vec<Spot> {
    /// Less is not seen, px.
    const OFF: f64 = 0.02;
    let mut kept: Vec<Spot> = Vec::new();
    for place in places {
        if let [.., start, middle] = kept[..] {
            let along = place - start;
            let is_between = (middle - start).dot(&(place - middle)) >= 0.0;
            if is_between && along.perp(&(middle - start)).abs() <= OFF * along.norm() {
                kept.pop();
            }
        }
        kept.push(*place);
    }
    kept
}

/// The path of a curve through places that has no corner and, across and up, does not leave the range between
/// neighbouring places: cubics in the distance between the places, with the slopes of Fritsch and Butland
/// (SIAM J. Sci. Stat. Comput. 5, 1984).
pub(super) fn smooth(places: &[Spot]) -> String {
    let steps: Vec<_> = { places.windows(2) }
        .map(|ends| ends[1] - ends[0])
        .filter(|step| step.norm() > 0.0)
        .collect();
    let Some(first) = places.first() else {
        return String::new();
    };
    let slopes = slopes(&steps);
    let mut path = format!("M {}", pair(*first));
    let mut at = *first;
    for (step, ends) in steps.iter().zip(slopes.windows(2)) {
        let reach = step.norm() / 3.0;
        let next = at + step;
        let controls = [at + reach * ends[0], next - reach * ends[1], next];
        path += &format!(" C {}", controls.map(pair).join(" "));
        at = next;
    }
    path
}

/// The slopes at the ends of steps.
fn slopes(steps: &[Spot]) -> Vec<Spot> {
    let rates: Vec<_> = steps.iter().map(|step| step / step.norm()).collect();
    let inner = (1..steps.len()).map(|index| {
        let [before, behind] = [steps[index - 1].norm(), steps[index].norm()];
        let weights = [2.0 * behind + before, behind + 2.0 * before];
        rates[index - 1].zip_map(&rates[index], |one, other| {
            if one * other <= 0.0 {
                0.0
            } else {
                (weights[0] + weights[1]) / (weights[0] / one + weights[1] / other)
            }
        })
    });
    let inner: Vec<_> = inner.collect();
    // At an end, that of the parabola whose slope at the next place is known, as far as it keeps the sign.
    let end = |rate: &Spot, next: Option<&Spot>| match next {
        Some(next) => rate.zip_map(next, |rate, next| {
            let slope = 1.5 * rate - 0.5 * next;
            if slope * rate <= 0.0 { 0.0 } else { slope }
        }),
        None => *rate,
    };
    let (Some(first), Some(last)) = (rates.first(), rates.last()) else {
        return Vec::new();
    };
    let ends = [end(first, inner.first()), end(last, inner.last())];
    let [start, finish] = ends;
    std::iter::once(start)
        .chain(inner)
        .chain([finish])
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::sheet::spot;
    use super::*;

    /// Numbers of a path.
    fn numbers(path: &str) -> Vec<f64> {
        let parts = path.split(' ');
        parts.filter_map(|part| part.parse().ok()).collect()
    }

    #[test]
    fn a_curve_passes_its_places_without_corner_or_overshoot() {
        let places = [
            spot(0.0, 0.0),
            spot(100.0, 0.0),
            spot(150.0, 80.0),
            spot(160.0, 300.0),
            spot(120.0, 310.0),
            spot(120.0, 310.0),
            spot(40.0, 305.0),
        ];
        let found = numbers(&smooth(&places));
        let spots: Vec<_> = found.chunks(2).map(|pair| spot(pair[0], pair[1])).collect();
        let knots: Vec<_> = spots.iter().step_by(3).copied().collect();
        let mut known = places.to_vec();
        known.dedup();
        assert_eq!(knots, known);
        for piece in spots.windows(4).step_by(3) {
            let [low, high] = [piece[0].inf(&piece[3]), piece[0].sup(&piece[3])];
            for control in &piece[1..3] {
                assert!((low - control).max() < 0.1 && (control - high).max() < 0.1);
            }
        }
        for around in spots.windows(3).skip(2).step_by(3) {
            let [into, out] = [around[1] - around[0], around[2] - around[1]];
            // The same direction, but for the rounding of places.
            assert!(
                (into.normalize() - out.normalize()).norm() < 0.02,
                "{around:?}"
            );
        }
    }

    #[test]
    fn a_curve_through_few_places_is_a_line() {
        assert_eq!(smooth(&[]), "");
        let line = smooth(&[spot(0.0, 0.0), spot(30.0, 60.0)]);
        assert_eq!(line, "M 0 0 C 10 20 20 40 30 60");
    }

    #[test]
    fn places_on_a_line_are_left_out() {
        let places: Vec<_> = [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 1.0), (4.0, 2.0)]
            .map(|(x, y)| spot(x, y))
            .into();
        let corners = [places[0], places[2], places[4]];
        assert_eq!(straightened(&places), corners);
    }
}
