//! The rating of a flat belt, whose limit is solved at every speed.

use super::range::{RatingEnd, Speeds};
use super::{LOCATED, RatedLoad, Rating, RatingStretch, at_lift_off, is_at_end, places, strongest};
use crate::SolveError;
use crate::answers::shares::each;
use crate::mechanics::maximum;

/// Bisections that locate a change of the reason to rounding.
const BISECTIONS: usize = 45;

pub(super) fn rating(
    speeds: &Speeds<'_>,
    range: [f64; 2],
    end: RatingEnd,
    stated: f64,
) -> Result<Rating, SolveError> {
    let load = |speed: f64| Ok(speeds.largest(speed, None, 1.0)?.0);
    let asked: Vec<f64> = places(range).collect();
    let last = asked.len() - 1;
    let found = each(asked.len(), |index| match (index == last, &end) {
        (true, RatingEnd::LiftsOff { speed }) => Ok(at_lift_off(*speed, speeds)),
        _ => load(asked[index]),
    });
    let (mut points, mut missing) = (Vec::new(), Vec::new());
    for (speed, found) in asked.into_iter().zip(found) {
        match found {
            Ok(point) => points.push(point),
            Err(error) => missing.push((speed, error)),
        }
    }
    let Some(best) = strongest(&points) else {
        return Err(missing.remove(0).1);
    };
    let beside = [best.saturating_sub(1), (best + 1).min(points.len() - 1)];
    let between = beside.map(|index| points[index].speed);
    let power = |speed: f64| load(speed).map_or(0.0, |load: RatedLoad| load.power);
    let located = load(maximum::between(power, between, LOCATED)).ok();
    let located = located.filter(|located| located.power > points[best].power);
    let optimum = located.unwrap_or_else(|| points[best].clone());
    Ok(Rating {
        drive: speeds.drive.clone(),
        stretches: stretches(&points, &load),
        stated: load(stated),
        optimum_at_end: is_at_end(&optimum, range),
        optimum,
        error: points.iter().map(|point| point.error).fold(0.0, f64::max),
        points,
        end,
        missing,
    })
}

/// The ranges of speed with one reason, with the changes between them.
fn stretches(
    points: &[RatedLoad],
    load: &impl Fn(f64) -> Result<RatedLoad, SolveError>,
) -> Vec<RatingStretch> {
    let mut stretches: Vec<RatingStretch> = Vec::new();
    // Where nothing is carried there is no reason to change to.
    for point in points.iter().filter(|point| point.factor > 0.0) {
        let change = match stretches.last_mut() {
            Some(last) if last.end.is_like(&point.end) => {
                last.range[1] = point.speed;
                continue;
            }
            Some(last) => {
                let (mut low, mut high) = (last.range[1], point.speed);
                for _ in 0..BISECTIONS {
                    let middle = f64::midpoint(low, high);
                    match load(middle) {
                        Ok(load) if load.end.is_like(&last.end) => low = middle,
                        _ => high = middle,
                    }
                }
                last.range[1] = low;
                high
            }
            None => point.speed,
        };
        stretches.push(RatingStretch {
            range: [change, point.speed],
            end: point.end.clone(),
        });
    }
    let last = points.last().map(|point| point.speed);
    if let (Some(stretch), Some(last)) = (stretches.last_mut(), last) {
        stretch.range[1] = last;
    }
    stretches
}
