//! The least of the largest of smooth functions within smooth limits: sequential quadratic programming in a trust region
//! with an exact penalty and a second-order correction (R. Fletcher, Practical Methods of Optimization, 2nd edition,
//! sections 12.4 and 14.4), with Powell's damped update of the curvature (1978).

use super::least_distance::dot;
use super::programme::{Linear, Programme, Step};
use crate::answers::shares::each;

/// The trust region at first, as a share of the range of each number.
const FIRST_RADIUS: f64 = 0.25;

/// Most steps, tried ones included: problems of up to five numbers take 5 to 40.
const STEPS: usize = 150;

/// Shares of the predicted gain: less is no gain; less is a reason for shorter steps; more for longer ones. The usual
/// values of the literature.
const ACCEPTED: f64 = 1e-4;
const SHORTER: f64 = 0.25;
const LONGER: f64 = 0.75;

/// The values of all functions at a place.
#[derive(Clone, Debug)]
pub(super) struct Values {
    /// The functions of which the largest is to be small.
    pub(super) pieces: Vec<f64>,
    /// The functions that are not to be positive.
    pub(super) limits: Vec<f64>,
    /// Which of several smooth functions each piece, then each limit, is the largest of; the same number everywhere for one
    /// that is smooth itself.
    pub(super) kinds: Vec<usize>,
}

/// Functions of numbers between 0 and 1; `None` where they have no value.
pub(super) type Functions<'f> = dyn Fn(&[f64]) -> Option<Values> + Sync + 'f;

/// How accurately a search is done.
#[derive(Clone, Copy)]
pub(super) struct Accuracy {
    /// A step that changes no number by more than this share of its range ends the search.
    pub(super) settled: f64,
    /// Errors of the functions: no smaller gain counts.
    pub(super) noise: f64,
}

/// Where a search ended.
#[derive(Clone, Debug)]
pub(super) struct Minimum {
    pub(super) place: Vec<f64>,
    pub(super) values: Values,
    /// The multipliers there.
    pub(super) multipliers: Step,
    /// The gradient of the Lagrangian without the ends of the ranges, whose multipliers it is.
    pub(super) slopes: Vec<f64>,
    /// The largest component of the gradient of the Lagrangian over that of the pieces.
    pub(super) residual: f64,
    /// Which numbers change no function.
    pub(super) idle: Vec<bool>,
}

impl Values {
    pub(super) fn largest_piece(&self) -> f64 {
        self.pieces
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max)
    }

    /// A piece, or behind them a limit.
    fn function(&self, index: usize) -> f64 {
        let limit = index.checked_sub(self.pieces.len());
        limit.map_or_else(|| self.pieces[index], |limit| self.limits[limit])
    }

    /// By how much a limit is exceeded; 0 if none is.
    pub(super) fn excess(&self) -> f64 {
        self.limits.iter().copied().fold(0.0, f64::max)
    }
}

/// A search.
pub(super) struct Search<'s> {
    pub(super) functions: &'s Functions<'s>,
    /// Steps of differences of each number.
    pub(super) steps: Vec<f64>,
    pub(super) accuracy: Accuracy,
    /// The search ends where the largest piece is this small.
    pub(super) enough: Option<f64>,
}

/// Pieces and limits with their gradients.
struct Model {
    pieces: Vec<Linear>,
    limits: Vec<Linear>,
}

/// A smooth function that took the place of another one nearby, as it is there.
struct Cut {
    /// Of which piece, or behind them of which limit.
    function: usize,
    kind: usize,
    place: Vec<f64>,
    linear: Linear,
}

/// The piece or limit to which each cut of a model belongs, and how far away it was met.
type Owners = Vec<(usize, f64)>;

/// The cuts that were met.
#[derive(Default)]
struct Cuts(Vec<Cut>);

impl Cuts {
    /// Keeps what decides at a place and did not where `beside` was found.
    fn keep(&mut self, place: &[f64], model: &Model, kinds: &[usize], beside: &[usize]) {
        let linear = model.pieces.iter().chain(&model.limits).enumerate();
        for (function, linear) in linear {
            let kind = kinds[function];
            if kind == beside[function] {
                continue;
            }
            let is_other = |cut: &Cut| (cut.function, cut.kind) != (function, kind);
            self.0.retain(is_other);
            self.0.push(Cut {
                function,
                kind,
                place: place.to_vec(),
                linear: linear.clone(),
            });
        }
    }

    /// A model with those functions that do not decide at its place, and the piece or limit to which each belongs with its
    /// distance.
    fn beside(&self, model: &Model, place: &[f64], kinds: &[usize]) -> (Model, [Owners; 2]) {
        let mut more = Model {
            pieces: model.pieces.clone(),
            limits: model.limits.clone(),
        };
        let mut owners = [Vec::new(), Vec::new()];
        for cut in self.0.iter().filter(|cut| cut.kind != kinds[cut.function]) {
            let change: Vec<_> = { place.iter().zip(&cut.place) }
                .map(|(here, there)| here - there)
                .collect();
            let distance = change.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let linear = Linear {
                value: cut.linear.after(&change),
                gradient: cut.linear.gradient.clone(),
            };
            match cut.function.checked_sub(model.pieces.len()) {
                None => {
                    more.pieces.push(linear);
                    owners[0].push((cut.function, distance));
                }
                Some(limit) => {
                    more.limits.push(linear);
                    owners[1].push((limit, distance));
                }
            }
        }
        (more, owners)
    }
}

impl Search<'_> {
    /// The minimum that is reached from a place with values; `None` if there are no derivatives at the first place.
    pub(super) fn minimum(&self, start: &[f64], values: Values) -> Option<Minimum> {
        let size = start.len();
        let mut place = start.to_vec();
        let mut values = values;
        let mut model = self.model(&place, &values)?;
        let mut curvature: Option<Vec<Vec<f64>>> = None;
        let flat = vec![vec![0.0; size]; size];
        let (mut radius, mut penalty) = (FIRST_RADIUS, 0.0);
        let (mut last, mut cuts) = (None, Cuts::default());
        for _ in 0..STEPS {
            let within: Vec<_> = { place.iter() }
                .map(|at| [-at.min(radius), (1.0 - at).min(radius)])
                .collect();
            let excess = values.excess();
            let (all, owners) = cuts.beside(&model, &place, &values.kinds);
            let relaxed = match excess > 0.0 {
                true => all.least_excess(&within, &flat),
                false => 0.0,
            };
            let bent = curvature.as_ref().unwrap_or(&flat);
            let of = |limits: &[Linear], relaxed: f64| {
                let pieces = &all.pieces;
                Programme {
                    curvature: bent,
                    pieces,
                    limits,
                    relaxed,
                    within: &within,
                }
                .step()
            };
            let highest = all.limits.iter().map(|limit| limit.value);
            let highest = highest.fold(0.0, f64::max);
            let step = of(&all.limits, relaxed).or_else(|| of(&all.limits, highest))?;
            let length = step
                .change
                .iter()
                .fold(0.0, |most: f64, x| most.max(x.abs()));
            let gain = all.gain(&step.change, bent, &values);
            penalty = f64::max(penalty, 2.0 * step.limits.iter().sum::<f64>());
            let predicted = gain.0 + penalty * gain.1;
            let is_enough = self
                .enough
                .is_some_and(|enough| values.largest_piece() <= enough);
            let is_last = is_enough
                || length <= self.accuracy.settled
                || predicted <= self.accuracy.noise && excess <= self.accuracy.noise;
            let end = End::new(&all, &owners, &step, &place);
            let far = end.farthest_cut;
            last = Some(end);
            // The place follows from a cut with the square of its distance: it has to be met anew nearby.
            if is_last && (is_enough || far * far <= self.accuracy.settled) {
                break;
            }
            if is_last {
                radius = far * far;
                cuts.0.clear();
                continue;
            }
            let merit = |values: &Values| values.largest_piece() + penalty * values.excess();
            let here = merit(&values);
            let tried = |change: &[f64]| {
                let next: Vec<_> = { place.iter().zip(change) }
                    .map(|(at, by)| (at + by).clamp(0.0, 1.0))
                    .collect();
                (self.functions)(&next).map(|values| (next, values))
            };
            let mut found = tried(&step.change);
            // A curved limit may spoil a good step: try it once more with the limits as they are at its end.
            if let Some((_, there)) = &found
                && here - merit(there) < LONGER * predicted
                && there.excess() > excess.max(self.accuracy.noise)
            {
                // Only where the same smooth functions decide.
                let is_same = there.kinds == values.kinds;
                let limits: Vec<_> = { all.limits.iter().zip(&there.limits) }
                    .map(|(limit, value)| Linear {
                        value: value - dot(&limit.gradient, &step.change),
                        gradient: limit.gradient.clone(),
                    })
                    .chain(all.limits.iter().skip(there.limits.len()).cloned())
                    .collect();
                let corrected = is_same.then(|| of(&limits, relaxed)).flatten();
                let corrected = corrected.and_then(|step| tried(&step.change));
                if let Some((next, better)) = corrected
                    && merit(&better) < merit(there)
                {
                    found = Some((next, better));
                }
            }
            let share = found
                .as_ref()
                .map(|(_, there)| (here - merit(there)) / predicted);
            match share {
                Some(share) if share < SHORTER => radius = 0.5 * radius.min(length),
                Some(share) if share > LONGER && length > 0.9 * radius => {
                    radius = (2.0 * radius).min(1.0);
                }
                Some(_) => {}
                None => radius = 0.25 * radius.min(length),
            }
            let Some((next, there)) = found else {
                continue;
            };
            let is_taken = share.is_some_and(|share| share >= ACCEPTED);
            let is_other = there.kinds != values.kinds;
            let known = match is_taken || is_other {
                true => self.model(&next, &there),
                false => None,
            };
            match known {
                Some(known) if is_taken => {
                    cuts.keep(&place, &model, &values.kinds, &there.kinds);
                    let change: Vec<_> = { next.iter().zip(&place) }
                        .map(|(new, old)| new - old)
                        .collect();
                    // A change of the slope at a kink is no curvature.
                    if !is_other {
                        let bend: Vec<_> = { known.lagrangian(&step).into_iter() }
                            .zip(model.lagrangian(&step))
                            .map(|(new, old)| new - old)
                            .collect();
                        update(&mut curvature, &change, &bend);
                    }
                    (place, values, model) = (next, there, known);
                }
                Some(known) => {
                    cuts.keep(&next, &known, &there.kinds, &values.kinds);
                    radius = radius.min(0.5 * length);
                }
                None => radius = radius.min(0.5 * length),
            }
        }
        let End {
            multipliers,
            slopes,
            residual,
            ..
        } = last?;
        let all = || model.pieces.iter().chain(&model.limits);
        let idle = (0..size).map(|index| all().all(|of| of.gradient[index] == 0.0));
        Some(Minimum {
            idle: idle.collect(),
            place,
            values,
            multipliers,
            slopes,
            residual,
        })
    }

    /// The functions with their gradients by differences: central ones, or of three places on one side at an end of the
    /// range, where there is no value on the other side, and where another function decides there.
    fn model(&self, place: &[f64], values: &Values) -> Option<Model> {
        let at = |index: usize, times: f64| {
            let mut there = place.to_vec();
            there[index] += times * self.steps[index];
            let is_inside = (0.0..=1.0).contains(&there[index]);
            is_inside.then(|| (self.functions)(&there)).flatten()
        };
        let sides = [1.0, -1.0];
        let near = each(2 * place.len(), |index| at(index / 2, sides[index % 2]));
        let mut columns = Vec::new();
        for (index, near) in near.chunks(2).enumerate() {
            // Where three places on a side are needed.
            let is_partial = |other: &Option<Values>| {
                let other = other.as_ref();
                other.is_none_or(|other| other.kinds != values.kinds)
            };
            let far: Vec<_> = { near.iter().rev().zip(sides) }
                .map(|(other, side)| is_partial(other).then(|| at(index, 2.0 * side)).flatten())
                .collect();
            let column = (0..values.kinds.len()).map(|function| {
                let same = |there: &Option<Values>| {
                    let there = there.as_ref();
                    let there =
                        there.filter(|there| there.kinds[function] == values.kinds[function]);
                    there.map(|there| there.function(function))
                };
                let any =
                    |there: &Option<Values>| there.as_ref().map(|there| there.function(function));
                let one_sided = |side: usize, near: f64| {
                    let here = values.function(function);
                    sides[side]
                        * match same(&far[side]) {
                            Some(far) => 2.0 * near - 1.5 * here - 0.5 * far,
                            None => near - here,
                        }
                };
                Some(
                    match (same(&near[0]), same(&near[1])) {
                        (Some(above), Some(below)) => 0.5 * (above - below),
                        (Some(above), None) => one_sided(0, above),
                        (None, Some(below)) => one_sided(1, below),
                        (None, None) => match (any(&near[0]), any(&near[1])) {
                            (Some(above), Some(below)) => 0.5 * (above - below),
                            (Some(above), None) => one_sided(0, above),
                            (None, below) => one_sided(1, below?),
                        },
                    } / self.steps[index],
                )
            });
            columns.push(column.collect::<Option<Vec<_>>>()?);
        }
        let linear = |from: usize, values: &[f64]| {
            let all = values.iter().enumerate().map(|(index, &value)| Linear {
                value,
                gradient: columns.iter().map(|column| column[from + index]).collect(),
            });
            all.collect()
        };
        Some(Model {
            pieces: linear(0, &values.pieces),
            limits: linear(values.pieces.len(), &values.limits),
        })
    }
}

impl Model {
    /// The least excess that a step of the box leaves in the linearised limits.
    fn least_excess(&self, within: &[[f64; 2]], flat: &[Vec<f64>]) -> f64 {
        // A step of the whole box may lead there; the limits of the programme need some room.
        let within: Vec<_> = { within.iter() }
            .map(|[low, high]| [0.8 * low, 0.8 * high])
            .collect();
        let none = Linear {
            value: 0.0,
            gradient: vec![0.0; within.len()],
        };
        let pieces: Vec<_> = self.limits.iter().cloned().chain([none]).collect();
        let step = Programme {
            curvature: flat,
            pieces: &pieces,
            limits: &[],
            relaxed: 0.0,
            within: &within,
        }
        .step();
        let change = step.map_or_else(|| vec![0.0; within.len()], |step| step.change);
        let left = self.limits.iter().map(|limit| limit.after(&change));
        left.fold(0.0, f64::max)
    }

    /// By how much the model says that the largest piece and the excess fall from what they are.
    fn gain(&self, change: &[f64], curvature: &[Vec<f64>], here: &Values) -> (f64, f64) {
        let bent: f64 = { curvature.iter().zip(change) }
            .map(|(row, part)| 0.5 * part * dot(row, change))
            .sum();
        let after = |of: &[Linear], least: f64| {
            let after = of.iter().map(|linear| linear.after(change));
            after.fold(least, f64::max)
        };
        (
            here.largest_piece() - after(&self.pieces, f64::NEG_INFINITY) - bent,
            here.excess() - after(&self.limits, 0.0),
        )
    }

    /// The gradient of the Lagrangian, without the ends of the ranges.
    fn lagrangian(&self, multipliers: &Step) -> Vec<f64> {
        let size = multipliers.change.len();
        let pieces = self.pieces.iter().zip(&multipliers.pieces);
        let limits = self.limits.iter().zip(&multipliers.limits);
        let mut sum = vec![0.0; size];
        for (linear, weight) in pieces.chain(limits) {
            for (sum, slope) in sum.iter_mut().zip(&linear.gradient) {
                *sum += weight * slope;
            }
        }
        sum
    }

    /// What is left of the gradient of the Lagrangian at a place, over the largest slope of a piece.
    fn residual(&self, multipliers: &Step, place: &[f64]) -> f64 {
        let slopes = self.pieces.iter().flat_map(|piece| &piece.gradient);
        let scale = slopes.fold(0.0, |most: f64, slope| most.max(slope.abs()));
        let parts = self.lagrangian(multipliers).into_iter().zip(place);
        let left = parts.map(|(slope, at)| match slope {
            // The range ends here: the slope is the multiplier of its end.
            slope if slope > 0.0 && *at <= AT_END || slope < 0.0 && 1.0 - at <= AT_END => 0.0,
            slope => slope.abs(),
        });
        let left = left.fold(0.0, f64::max);
        if left == 0.0 {
            0.0
        } else {
            left / scale.max(f64::MIN_POSITIVE)
        }
    }
}

/// What a step tells of the place where it begins.
struct End {
    multipliers: Step,
    slopes: Vec<f64>,
    residual: f64,
    /// How far away the farthest of the cuts with a multiplier was met.
    farthest_cut: f64,
}

impl End {
    fn new(model: &Model, owners: &[Owners; 2], step: &Step, place: &[f64]) -> Self {
        let mut multipliers = step.clone();
        let mut farthest_cut = 0.0;
        let [pieces, limits] = owners;
        for (own, owners) in [
            (&mut multipliers.pieces, pieces),
            (&mut multipliers.limits, limits),
        ] {
            let of_cuts = own.split_off(own.len() - owners.len());
            for (multiplier, &(owner, distance)) in of_cuts.iter().zip(owners) {
                own[owner] += multiplier;
                if *multiplier > 0.0 {
                    farthest_cut = distance.max(farthest_cut);
                }
            }
        }
        Self {
            multipliers,
            slopes: model.lagrangian(step),
            residual: model.residual(step, place),
            farthest_cut,
        }
    }
}

/// A number this near to an end of its range, as a share of it, is there.
pub(super) const AT_END: f64 = 1e-9;

/// Powell's damped update of the curvature by a change of the place and of the gradient of the Lagrangian.
fn update(curvature: &mut Option<Vec<Vec<f64>>>, change: &[f64], bend: &[f64]) {
    /// Powell's share of the curvature that an update keeps.
    const KEPT: f64 = 0.2;
    let along = dot(change, bend);
    let length = dot(change, change);
    let size = change.len();
    if curvature.is_none() {
        if along <= 0.0 {
            return;
        }
        // Shanno and Phua's first curvature.
        let first = dot(bend, bend) / along;
        let row = |index: usize| {
            (0..size)
                .map(|column| if column == index { first } else { 0.0 })
                .collect()
        };
        *curvature = Some((0..size).map(row).collect());
    }
    let Some(matrix) = curvature else {
        return;
    };
    let bent: Vec<_> = matrix.iter().map(|row| dot(row, change)).collect();
    let known = dot(change, &bent);
    if known <= f64::EPSILON * length || length == 0.0 {
        return;
    }
    let share = match along < KEPT * known {
        true => (1.0 - KEPT) * known / (known - along),
        false => 1.0,
    };
    let mixed: Vec<_> = { bend.iter().zip(&bent) }
        .map(|(new, old)| share * new + (1.0 - share) * old)
        .collect();
    let along = dot(change, &mixed);
    for (row, matrix) in matrix.iter_mut().enumerate() {
        for (column, part) in matrix.iter_mut().enumerate() {
            *part += mixed[row] * mixed[column] / along - bent[row] * bent[column] / known;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ACCURACY: Accuracy = Accuracy {
        settled: 1e-9,
        noise: 1e-13,
    };

    fn minimum(functions: &Functions<'_>, start: &[f64]) -> Minimum {
        let search = Search {
            functions,
            steps: vec![1e-5; start.len()],
            accuracy: ACCURACY,
            enough: None,
        };
        search.minimum(start, functions(start).unwrap()).unwrap()
    }

    #[test]
    fn a_point_on_a_circle() {
        // −x − y on a circle of radius ½ about 0: at 1/√8 each, with multiplier √2 for r − ½.
        let functions = |x: &[f64]| {
            Some(Values {
                pieces: vec![-x[0] - x[1]],
                limits: vec![x[0].hypot(x[1]) - 0.5],
                kinds: vec![0; 2],
            })
        };
        let found = minimum(&functions, &[0.7, 0.1]);
        // Along the circle the value changes by the square of the way: by 1e-13 at 3e-7.
        let at = 0.125_f64.sqrt();
        assert!((found.place[0] - at).abs() < 1e-6, "{found:?}");
        let multiplier = found.multipliers.limits[0];
        assert!((multiplier - 2.0_f64.sqrt()).abs() < 1e-6, "{found:?}");
        assert!(found.residual < 1e-6);
    }

    #[test]
    fn a_curved_valley_without_limits() {
        // Rosenbrock's function on [−2, 2]².
        let functions = |p: &[f64]| {
            let [x, y] = [4.0 * p[0] - 2.0, 4.0 * p[1] - 2.0];
            let value = (1.0 - x).powi(2) + 100.0 * (y - x * x).powi(2);
            Some(Values {
                pieces: vec![value],
                limits: Vec::new(),
                kinds: vec![0],
            })
        };
        let found = minimum(&functions, &[0.2, 0.75]);
        assert!((found.place[0] - 0.75).abs() < 1e-5, "{found:?}");
    }

    #[test]
    fn functions_without_a_value_stop_no_search() {
        // x² y with x y ≥ 0.04, known where x y > 0.03 only; x = 0.2 at y = 0.2, or y at its end.
        let functions = |x: &[f64]| {
            (x[0] * x[1] > 0.03).then(|| Values {
                pieces: vec![x[0] * x[0] * x[1]],
                limits: vec![1.0 - x[0] * x[1] / 0.04],
                kinds: vec![0; 2],
            })
        };
        let found = minimum(&functions, &[0.9, 0.5]);
        assert!(
            (found.place[1] - 1.0).abs() < 1e-8 && (found.place[0] - 0.04).abs() < 1e-8,
            "{found:?}"
        );
    }

    #[test]
    fn a_limit_that_is_the_larger_one_of_two_functions() {
        // y is least at the kink of y ≥ max(x², 1 − x) shrunk by ½: x² = 1 − x for 2 x.
        let functions = |p: &[f64]| {
            let [x, y] = [2.0 * p[0], 2.0 * p[1]];
            let sides = [x * x - y, 1.0 - x - y];
            let kind = usize::from(sides[1] > sides[0]);
            Some(Values {
                pieces: vec![p[1]],
                limits: vec![sides[kind]],
                kinds: vec![0, kind],
            })
        };
        let found = minimum(&functions, &[0.8, 0.9]);
        let x = 0.5 * (5.0_f64.sqrt() - 1.0);
        assert!((found.place[0] - 0.5 * x).abs() < 1e-8, "{found:?}");
        // By y = 1 − x + d and y = x² + d with d the limit: half of it for p.
        assert!(
            (found.multipliers.limits[0] - 0.5).abs() < 1e-6,
            "{found:?}"
        );
        assert!(found.residual < 1e-6, "{found:?}");
    }
}
