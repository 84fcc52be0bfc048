//! The bands of an answer, by linearisation and by sampling.

use super::{Band, Distribution, Found, Sampled, Uncertainty};
use crate::LatinHypercube;
use crate::answers::shares::each;
use crate::input::{Diagnostic, DriveFile, Spread, Uncertain};
use statrs::distribution::{ContinuousCDF, Normal};
use std::sync::Mutex;

/// The probabilities below the ends of a band.
pub(super) const QUANTILES: [f64; 2] = [0.025, 0.975];

/// Step of the difference quotients, in standard deviations. The errors of the states, 1e-6 and less, change an effect by
/// 2e-6 of the number; the curvature of a margin that grows as exp(μ φ) over half a turn changes it by 1e-3 of itself
/// where σ is a tenth of μ.
const STEP: f64 = 0.25;

/// What the samples are drawn by: any number does.
const SEED: u64 = 1979;

/// An answer to drive files with uncertain numbers.
pub(super) struct Propagation<'a> {
    file: &'a DriveFile,
    inputs: Vec<Uncertain>,
    /// The answer to a file; `None` if it is no drive.
    answer: &'a (dyn Fn(&DriveFile) -> Option<Found> + Sync),
    samples: usize,
}

impl<'a> Propagation<'a> {
    pub(super) fn new(
        file: &'a DriveFile,
        answer: &'a (dyn Fn(&DriveFile) -> Option<Found> + Sync),
        samples: usize,
    ) -> Result<Self, Diagnostic> {
        Ok(Self {
            file,
            inputs: file.uncertainty()?,
            answer,
            samples,
        })
    }

    /// The bands around what the file as it stands gives.
    pub(super) fn of(
        self,
        here: &Found,
        progress: &mut (dyn FnMut(f64, &str) + Send),
    ) -> Uncertainty {
        let steps = self.inputs.iter().enumerate();
        let steps = steps.flat_map(|(index, _)| [-STEP, STEP].map(|step| self.moved(index, step)));
        let unit = vec![[0.0, 1.0]; self.inputs.len()];
        let points = LatinHypercube::new(unit, self.samples, SEED);
        let samples = points.rows(0).map(|point| self.sample(&point.values));
        let files: Vec<_> = steps.chain(samples).collect();
        let done = Mutex::new((0.0, progress));
        let mut found = each(files.len(), |index| {
            let found = (self.answer)(&files[index]);
            if let Ok(mut done) = done.lock() {
                done.0 += 1.0;
                let share = done.0 / files.len() as f64;
                (done.1)(share, "uncertainty");
            }
            found
        });
        let drawn = found.split_off(2 * self.inputs.len());
        let no_drive = drawn.iter().filter(|found| found.is_none()).count();
        let drawn: Vec<Found> = drawn.into_iter().flatten().collect();
        let bands = here.numbers.iter().enumerate();
        let bands = bands.filter_map(|(index, &(number, case, value))| {
            let value = value?;
            let effects = self.effects(value, |at| found[at].as_ref()?.numbers[index].2);
            let linear = self.linear(value, &effects);
            let values = drawn.iter().filter_map(|found| found.numbers[index].2);
            let sampled = sampled(values.collect());
            Some(Band {
                number,
                case,
                value,
                effects,
                linear,
                sampled,
            })
        });
        let cases = 0..if drawn.is_empty() {
            0
        } else {
            here.holds.len()
        };
        let holds = cases.map(|case| {
            let holding = drawn.iter().filter(|found| found.holds[case]).count();
            holding as f64 / drawn.len() as f64
        });
        let (bands, holds) = (bands.collect(), holds.collect());
        Uncertainty {
            samples: self.samples,
            no_drive,
            bands,
            holds,
            inputs: self.inputs,
        }
    }

    /// The file with an input moved by so many standard deviations.
    fn moved(&self, index: usize, by: f64) -> DriveFile {
        let input = &self.inputs[index];
        let value = input.value + by * input.standard_deviation();
        self.file.with(&input.key, value)
    }

    /// The file with the inputs of a point of the unit cube.
    fn sample(&self, point: &[f64]) -> DriveFile {
        let inputs = self.inputs.iter().zip(point);
        inputs.fold(self.file.clone(), |file, (input, &probability)| {
            let value = match input.spread {
                Spread::Normal(deviation) => {
                    // The quantile of 0 is infinite.
                    let probability = probability.max(f64::EPSILON);
                    input.value + deviation * Normal::standard().inverse_cdf(probability)
                }
                Spread::Interval([from, to]) => from + probability * (to - from),
            };
            file.with(&input.key, value)
        })
    }

    /// By how much a number changes with a standard deviation of each input, from its values a step below and above;
    /// from one of them where the other has none.
    fn effects(&self, here: f64, at: impl Fn(usize) -> Option<f64>) -> Vec<Option<f64>> {
        let inputs = 0..self.inputs.len();
        let effects = inputs.map(|input| match (at(2 * input), at(2 * input + 1)) {
            (Some(below), Some(above)) => Some((above - below) / (2.0 * STEP)),
            (None, Some(above)) => Some((above - here) / STEP),
            (Some(below), None) => Some((here - below) / STEP),
            (None, None) => None,
        });
        effects.collect()
    }

    /// Where a number lies by these effects.
    fn linear(&self, here: f64, effects: &[Option<f64>]) -> Option<Distribution> {
        let (mut mean, mut variance) = (here, 0.0);
        for (input, effect) in self.inputs.iter().zip(effects) {
            let effect = (*effect)?;
            mean += effect * (input.mean() - input.value) / input.standard_deviation();
            variance += effect * effect;
        }
        let standard_deviation = variance.sqrt();
        let end = |p| mean + standard_deviation * Normal::standard().inverse_cdf(p);
        Some(Distribution {
            mean,
            standard_deviation,
            interval: QUANTILES.map(end),
        })
    }
}

/// Where samples lie.
fn sampled(mut values: Vec<f64>) -> Option<Sampled> {
    let count = values.len();
    if count < 2 {
        return None;
    }
    values.sort_by(f64::total_cmp);
    let mean = values.iter().sum::<f64>() / count as f64;
    let squares = values.iter().map(|value| (value - mean).powi(2));
    let standard_deviation = (squares.sum::<f64>() / (count - 1) as f64).sqrt();
    // Linear between the values in their order (R. J. Hyndman and Y. Fan 1996, definition 7).
    let quantile = |p: f64| {
        let place = p * (count - 1) as f64;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a place in the list"
        )]
        let below = place as usize;
        let above = (below + 1).min(count - 1);
        values[below] + place.fract() * (values[above] - values[below])
    };
    Some(Sampled {
        count,
        distribution: Distribution {
            mean,
            standard_deviation,
            interval: QUANTILES.map(quantile),
        },
    })
}
