//! The Levenberg–Marquardt method (K. Levenberg 1944, D. W. Marquardt 1963) with the singular values of the
//! derivatives, from which every damped step of a place follows.

use super::Error;
use super::model::{At, Column, Evaluated, Model, Predictions, RowFailure};
use faer::Mat;

/// Most steps, tried ones included: with good starts four to eight are enough, and a factor of ten in a stiffness
/// takes fifteen.
const STEPS: usize = 60;

/// Damping at first, relative to the largest singular value squared: a step of Gauss and Newton all but for directions
/// that the rows hardly determine.
const DAMPING: f64 = 1e-3;

/// What damping is multiplied by after a step that failed, and divided by after one that did not.
const FACTOR: f64 = 8.0;

/// Largest change of a coordinate by a step: a factor of 3 in a positive number, beyond which the derivatives say little.
const LONGEST: f64 = 1.1;

/// The search ends with a step of which no more than this share of the scatter is expected: S falls by less than
/// 1e-8 of S/(n − m), or of 1 where standard deviations are known and S is smaller; standard errors are 1e4 times as large.
const SETTLED: f64 = 1e-8;

/// A search that finds no smaller S ends where less than this share was to be gained: a hundredth of the
/// standard errors, below which the errors of the states decide.
const STALLED: f64 = 1e-4;

/// The least sum of squares.
pub(super) struct Fit {
    /// The place.
    pub(super) place: Vec<f64>,
    /// The model there.
    pub(super) predictions: Predictions,
    /// The residuals there.
    residuals: Vec<f64>,
    /// The derivatives of the model over σ there.
    pub(super) derivatives: Derivatives,
    /// Steps, tried ones included.
    pub(super) steps: usize,
    /// Steady states.
    pub(super) states: usize,
}

impl Fit {
    /// S at the place.
    pub(super) fn sum_of_squares(&self) -> f64 {
        squares(&self.residuals)
    }
}

/// The derivatives U diag(s) Vᵀ.
pub(super) struct Derivatives {
    /// The right singular vectors, one each.
    pub(super) right: Vec<Vec<f64>>,
    /// The singular values, from large to small.
    pub(super) values: Vec<f64>,
    /// The components of the residuals along the left singular vectors.
    along: Vec<f64>,
    /// Their relative error.
    pub(super) error: f64,
}

/// The place of the least sum of squares.
pub(super) fn fit(model: &Model<'_>, progress: &mut dyn FnMut(f64, &str)) -> Result<Fit, Error> {
    let count = model.keys().len();
    let rows = model.readings();
    let mut place = vec![0.0; count];
    let of_place = model.row_count();
    let of_differences = |known: &[Column]| {
        let open = known.iter().filter(|column| column.is_none());
        2 * open.count() * of_place
    };
    let first = model.at(std::slice::from_ref(&place), &[]).remove(0);
    let mut at = first.map_err(Error::Start)?;
    let mut residuals = model.residuals(&at.predictions);
    let known = model.derivatives(&place, &at);
    let mut states = of_place + of_differences(&known);
    let mut derivatives = completed(known, model, &place, &residuals, &at).map_err(Error::Start)?;
    let mut damping = DAMPING;
    let mut failure = "the sum of squares does not fall".to_owned();
    for step in 1..=STEPS {
        progress(
            step as f64 / STEPS as f64,
            &format!("step {step}, S = {:.4e}", squares(&residuals)),
        );
        let sum = squares(&residuals);
        let freedom = rows.saturating_sub(count).max(1) as f64;
        let scatter = (sum / freedom).max(f64::MIN_POSITIVE);
        let (change, gain) = derivatives.step(damping);
        let is_settled = gain <= SETTLED * scatter || gain <= 4.0 * f64::EPSILON * sum;
        let longest = change.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        // Residuals that vanish leave nothing to compare a gain with.
        if is_settled || longest <= at.error {
            return Ok(Fit {
                place,
                predictions: at.predictions,
                residuals,
                derivatives,
                steps: step,
                states,
            });
        }
        let shorter = (LONGEST / longest).min(1.0);
        let next: Vec<_> = place
            .iter()
            .zip(&change)
            .map(|(from, by)| from + shorter * by)
            .collect();
        let tried = model.at(std::slice::from_ref(&next), &at.near).remove(0);
        states += of_place;
        let tried = tried.map(|found| (model.residuals(&found.predictions), found));
        match tried {
            Ok((left, found)) if squares(&left) < sum => {
                let known = model.derivatives(&next, &found);
                states += of_differences(&known);
                match completed(known, model, &next, &left, &found) {
                    Ok(of_next) => {
                        (place, residuals, at, derivatives) = (next, left, found, of_next);
                        damping /= FACTOR;
                        continue;
                    }
                    Err(row) => failure = reason(&row),
                }
            }
            Ok(_) if gain <= STALLED * scatter => {
                return Ok(Fit {
                    place,
                    predictions: at.predictions,
                    residuals,
                    derivatives,
                    steps: step,
                    states,
                });
            }
            Ok(_) => {}
            Err(row) => failure = reason(&row),
        }
        damping *= FACTOR;
    }
    Err(Error::NotConverged {
        steps: STEPS,
        reason: failure,
    })
}

fn reason(row: &RowFailure) -> String {
    format!("line {}: {}", row.line, row.reason)
}

fn squares(residuals: &[f64]) -> f64 {
    residuals.iter().map(|residual| residual * residual).sum()
}

/// The derivatives at a place from those that are known to rounding, the others by central differences from what is known
/// there: over a step h they err by h², relatively, and by the error of the states over h, which the cube root of that error
/// balances.
fn completed(
    known: Vec<Column>,
    model: &Model<'_>,
    place: &[f64],
    residuals: &[f64],
    at: &At,
) -> Result<Derivatives, RowFailure> {
    let step = at.error.cbrt();
    let open = known.iter().enumerate();
    let open = open.filter_map(|(index, column)| column.is_none().then_some(index));
    let places: Vec<_> = open
        .flat_map(|index| {
            [1.0, -1.0].map(|side| {
                let mut beside = place.to_vec();
                beside[index] += side * step;
                beside
            })
        })
        .collect();
    let mut error = if places.is_empty() {
        at.error
    } else {
        step * step
    };
    let found = model.at(&places, &at.near);
    let mut pairs = found.chunks(2);
    let mut difference = || {
        let residuals_at = |side: &Evaluated| match side {
            Ok(At { predictions, .. }) => Ok(model.residuals(predictions)),
            Err(row) => Err(row.clone()),
        };
        let pair = pairs.next().expect("two places for each open column");
        for side in pair {
            let of_side = match side {
                Ok(at) => at.error / step,
                // A difference on one side errs by h.
                Err(_) => step,
            };
            error = error.max(of_side);
        }
        // On one side where the other has no answer, as at the limit of a load.
        let (above, below, width) = match (residuals_at(&pair[0]), residuals_at(&pair[1])) {
            (Ok(above), Ok(below)) => (above, below, 2.0 * step),
            (Ok(above), Err(_)) => (above, residuals.to_vec(), step),
            (Err(_), Ok(below)) => (residuals.to_vec(), below, step),
            (Err(row), Err(_)) => return Err(row),
        };
        let sides = above.iter().zip(&below);
        // The model less the reading changes against the residual.
        Ok(sides
            .map(|(above, below)| (below - above) / width)
            .collect())
    };
    let columns = known
        .into_iter()
        .map(|column| column.map_or_else(&mut difference, Ok));
    let columns = columns.collect::<Result<Vec<_>, _>>()?;
    Ok(Derivatives::new(&columns, residuals, error))
}

impl Derivatives {
    fn new(columns: &[Vec<f64>], residuals: &[f64], error: f64) -> Self {
        let (rows, count) = (residuals.len(), columns.len());
        let matrix = Mat::from_fn(rows, count, |row, column| columns[column][row]);
        let decomposed = matrix.thin_svd().expect("finite derivatives");
        let (left, values, right) = (decomposed.U(), decomposed.S(), decomposed.V());
        let along = (0..count).map(|index| {
            let parts = (0..rows).map(|row| left[(row, index)] * residuals[row]);
            parts.sum()
        });
        Self {
            right: (0..count)
                .map(|index| (0..count).map(|row| right[(row, index)]).collect())
                .collect(),
            values: (0..count).map(|index| values[index]).collect(),
            along: along.collect(),
            error,
        }
    }

    /// The damped step, and by how much the linearised S falls with it.
    fn step(&self, damping: f64) -> (Vec<f64>, f64) {
        let largest = self.values.first().copied().unwrap_or_default();
        let damping = damping * largest * largest;
        let mut step = vec![0.0; self.right.len()];
        let mut gain = 0.0;
        for ((vector, value), along) in self.right.iter().zip(&self.values).zip(&self.along) {
            let denominator = value * value + damping;
            if denominator == 0.0 {
                continue;
            }
            let size = value * along / denominator;
            for (part, direction) in step.iter_mut().zip(vector) {
                *part += size * direction;
            }
            let left = along - value * size;
            gain += along * along - left * left;
        }
        (step, gain)
    }
}
