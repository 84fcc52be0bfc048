//! The explicit method of Dormand and Prince (1980), of order five with an error of order four, for few equations.

/// Weights of the stages of a step, the last of which is at its end, ...
const STAGES: [[f64; 6]; 6] = [
    [1.0 / 5.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0, 0.0],
    [44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0, 0.0, 0.0, 0.0],
    [
        19372.0 / 6561.0,
        -25360.0 / 2187.0,
        64448.0 / 6561.0,
        -212.0 / 729.0,
        0.0,
        0.0,
    ],
    [
        9017.0 / 3168.0,
        -355.0 / 33.0,
        46732.0 / 5247.0,
        49.0 / 176.0,
        -5103.0 / 18656.0,
        0.0,
    ],
    [
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
];
/// ... and of the estimate of its error.
const ERROR: [f64; 7] = [
    71.0 / 57600.0,
    0.0,
    -71.0 / 16695.0,
    71.0 / 1920.0,
    -17253.0 / 339_200.0,
    22.0 / 525.0,
    -1.0 / 40.0,
];
/// A step is this part of the one that would have just the error allowed, and no more than so many times longer or shorter
/// than the last (Hairer, Nørsett and Wanner 1993, II.4).
const SAFETY: f64 = 0.9;
const CHANGE: [f64; 2] = [0.2, 5.0];

/// What comes behind a step.
pub(super) enum Next {
    /// The next one.
    Step,
    /// The same one, shortened to this part.
    Shorter(f64),
    /// Nothing: it was the last.
    End,
}

/// Values that change along s by certain rates.
pub(super) trait Rates<const N: usize> {
    /// The rates dy/ds.
    fn rates(&self, y: &[f64; N]) -> [f64; N];

    /// The errors that are allowed in a step.
    fn allowed(&self, y: &[f64; N]) -> [f64; N];

    /// The values along s from a start at s = 0, with a first step, which may be negative, until `next` ends them; `None`
    /// if that takes more steps than `most`, or a rate is not finite. `next` is told both ends of every step.
    fn follow(
        &self,
        start: [f64; N],
        first: f64,
        most: usize,
        mut next: impl FnMut(&[f64; N], &[f64; N]) -> Next,
    ) -> Option<Vec<(f64, [f64; N])>> {
        let (mut s, mut h, mut here) = (0.0, first, start);
        let mut along = vec![(s, here)];
        let mut stages = [self.rates(&here); 7];
        for _ in 0..most {
            let mut there = here;
            for (stage, weights) in STAGES.iter().enumerate() {
                there = moved(&here, h, &stages, weights);
                stages[stage + 1] = self.rates(&there);
            }
            let errors = moved(&[0.0; N], h, &stages, &ERROR);
            let error = errors
                .iter()
                .zip(self.allowed(&here))
                .map(|(error, allowed)| error.abs() / allowed)
                .fold(0.0, |most: f64, error| match error.is_nan() {
                    true => f64::INFINITY,
                    false => most.max(error),
                });
            if error.is_infinite() {
                return None;
            }
            if error <= 1.0 {
                match next(&here, &there) {
                    Next::Shorter(part) => {
                        h *= part;
                        continue;
                    }
                    Next::End => {
                        along.push((s + h, there));
                        return Some(along);
                    }
                    Next::Step => {}
                }
                (s, here, stages[0]) = (s + h, there, stages[6]);
                along.push((s, here));
            }
            h *= (SAFETY * error.powf(-0.2)).clamp(CHANGE[0], CHANGE[1]);
        }
        None
    }
}

/// Values moved along by a sum of rates.
fn moved<const N: usize>(from: &[f64; N], h: f64, rates: &[[f64; N]], weights: &[f64]) -> [f64; N] {
    std::array::from_fn(|i| {
        let terms = rates.iter().zip(weights);
        from[i] + h * terms.map(|(rate, weight)| weight * rate[i]).sum::<f64>()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotation, with this error of a step.
    struct Rotation(f64);

    impl Rates<2> for Rotation {
        fn rates(&self, y: &[f64; 2]) -> [f64; 2] {
            [-y[1], y[0]]
        }

        fn allowed(&self, _: &[f64; 2]) -> [f64; 2] {
            [self.0; 2]
        }
    }

    /// The steps to the end of half a turn, and the error there.
    fn half_turn(allowed: f64) -> (usize, f64) {
        let next = |here: &[f64; 2], there: &[f64; 2]| match there[1].abs() < 1e-14 {
            true => Next::End,
            false if there[1] < 0.0 => Next::Shorter(here[1] / (here[1] - there[1])),
            false => Next::Step,
        };
        let along = Rotation(allowed)
            .follow([1.0, 0.0], 0.1, 5000, next)
            .unwrap();
        let (s, end) = along[along.len() - 1];
        let error = (end[0] + 1.0).abs() + (s - std::f64::consts::PI).abs();
        (along.len() - 1, error)
    }

    #[test]
    fn errors_fall_as_they_are_allowed_to() {
        let (few, coarse) = half_turn(1e-6);
        let (many, fine) = half_turn(1e-11);
        assert!(coarse < 1e-5 && fine < 1e-10, "{coarse} {fine}");
        // A tenth of the step has an error 10⁻⁵ times as large.
        let ratio = many as f64 / few as f64;
        assert!((6.0..14.0).contains(&ratio), "{few} {many}");
    }

    #[test]
    fn too_many_steps_lead_nowhere() {
        let along = Rotation(1e-6).follow([1.0, 0.0], 0.1, 5, |_, _| Next::Step);
        assert!(along.is_none());
    }
}
