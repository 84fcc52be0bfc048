//! A random boundary value problem with a known solution.

use super::Draw;
use super::modes::{Modes, dot};
use super::shapes::Shape;
use bvp::{Ends, Guess, Problem, Real, Segment};

/// Conditions whose linearisation is worse conditioned than this are drawn again.
const WORST_CONDITION: f64 = 300.0;

/// One condition ℓ = 0 or ℓ + κ m² = 0 or sinh ℓ = 0, with linear forms ℓ, m of the distances from
/// the exact ends and parameters.
#[derive(Clone, Debug)]
struct Condition {
    kind: usize,
    form: Vec<f64>,
    other: Vec<f64>,
}

/// One state Y = σ Σ wᵢ φᵢ(s).
#[derive(Clone, Debug)]
struct Exact {
    /// Its size σ.
    size: f64,
    /// Weights in \[−1, 1) and shapes.
    shapes: Vec<(f64, Shape)>,
}

/// Equations, conditions and exact solution.
#[derive(Clone, Debug)]
pub(super) struct Drawn {
    segments: Vec<Segment>,
    modes: Vec<Modes>,
    /// Every state of every segment.
    exact: Vec<Vec<Exact>>,
    /// The exact parameters, which are their own sizes.
    parameters: Vec<f64>,
    conditions: Vec<Condition>,
}

impl Drawn {
    pub(super) fn draw(draw: &mut Draw) -> Self {
        loop {
            let mut drawn = Self::equations(draw);
            for _ in 0..20 {
                drawn.conditions = drawn.draw_conditions(draw);
                if drawn.condition_number() < WORST_CONDITION {
                    return drawn;
                }
            }
        }
    }

    /// Without conditions.
    fn equations(draw: &mut Draw) -> Self {
        let k = draw.below(3);
        let parameters = (0..k).map(|_| draw.sign() * draw.log_between(1e-3, 1e3));
        let mut drawn = Self {
            parameters: parameters.collect(),
            segments: vec![],
            modes: vec![],
            exact: vec![],
            conditions: vec![],
        };
        for _ in 0..=draw.below(3) {
            let (n, a) = (1 + draw.below(5), draw.between(-2.0, 2.0));
            let ends = [a, a + draw.between(0.5, 2.0)];
            drawn.segments.push(Segment::on(n, ends[0], ends[1]));
            drawn.modes.push(Modes::draw(draw, ends, n, k));
            let exact = (0..n).map(|_| {
                let size = draw.log_between(1e-3, 1e3);
                let shapes = (0..=draw.below(3))
                    .map(|_| (draw.between(-1.0, 1.0), Shape::draw(draw, ends)))
                    .collect();
                Exact { size, shapes }
            });
            drawn.exact.push(exact.collect());
        }
        drawn
    }

    /// Separated conditions, each mode at its large end; junctions and periods; or such that couple
    /// everything.
    fn draw_conditions(&self, draw: &mut Draw) -> Vec<Condition> {
        let columns = self.columns();
        let kind = draw.below(3);
        let nonlinear = draw.chance(0.5);
        let mut forms: Vec<Vec<f64>> = vec![];
        for (segment, modes) in self.modes.iter().enumerate() {
            let n = self.segments[segment].states;
            for i in 0..n {
                let mut form = vec![0.0; columns];
                match kind {
                    0 => {
                        let end = modes.large_end(i);
                        let mut direction = vec![0.0; n];
                        direction[i] = 1.0;
                        modes.mix(self.end(segment, end), &mut direction);
                        form[self.column(segment, end)..][..n].copy_from_slice(&direction);
                    }
                    1 => {
                        let before = (segment + self.segments.len() - 1) % self.segments.len();
                        let there = i % self.segments[before].states;
                        form[self.column(segment, 0) + i] = 1.0;
                        form[self.column(before, 1) + there] -= 1.0;
                    }
                    _ => form.fill_with(|| draw.between(-1.0, 1.0)),
                }
                forms.push(form);
            }
        }
        for _ in &self.parameters {
            let mut form = vec![0.0; columns];
            let segment = draw.below(self.segments.len());
            let (n, end) = (self.segments[segment].states, draw.below(2));
            let here = &mut form[self.column(segment, end)..][..n];
            if self.modes[segment].has_integral() && end == 1 {
                here[n - 1] = 1.0;
            } else {
                here.fill_with(|| draw.between(-1.0, 1.0));
            }
            forms.push(form);
        }
        let condition = |form| Condition {
            kind: if nonlinear { draw.below(3) } else { 0 },
            form,
            other: (0..columns).map(|_| draw.between(-0.3, 0.3)).collect(),
        };
        forms.into_iter().map(condition).collect()
    }

    /// Number of states at all ends and of parameters.
    fn columns(&self) -> usize {
        self.column(self.segments.len(), 0) + self.parameters.len()
    }

    /// Where the states at an end, 0 or 1, of a segment begin among all ends.
    fn column(&self, segment: usize, end: usize) -> usize {
        let before: usize = self.segments[..segment].iter().map(|s| 2 * s.states).sum();
        before
            + if end == 1 {
                self.segments[segment].states
            } else {
                0
            }
    }

    fn end(&self, segment: usize, end: usize) -> f64 {
        [self.segments[segment].from, self.segments[segment].to][end]
    }

    /// The condition number, in the largest norm, of the matrix that maps the sizes of all modes and
    /// parameters to the linearised conditions.
    fn condition_number(&self) -> f64 {
        // A column of all ends and parameters for every mode and parameter.
        let mut responses: Vec<Vec<f64>> = vec![];
        for (segment, modes) in self.modes.iter().enumerate() {
            for mode in 0..self.segments[segment].states {
                let mut response = vec![0.0; self.columns()];
                for end in 0..2 {
                    let values = modes.response(end, mode);
                    response[self.column(segment, end)..][..values.len()].copy_from_slice(&values);
                }
                responses.push(response);
            }
        }
        for parameter in 0..self.parameters.len() {
            let mut response = vec![0.0; self.columns()];
            for (segment, modes) in self.modes.iter().enumerate() {
                for end in 0..2 {
                    let values = modes.response(end, self.segments[segment].states + parameter);
                    response[self.column(segment, end)..][..values.len()].copy_from_slice(&values);
                }
            }
            response[self.column(self.segments.len(), 0) + parameter] = 1.0;
            responses.push(response);
        }
        let forms = self.conditions.iter().map(|c| &c.form);
        let matrix: Vec<Vec<f64>> = forms
            .map(|form| responses.iter().map(|r| dot(form, r)).collect())
            .collect();
        norm(&matrix) * norm(&inverse(matrix))
    }

    /// The size σ of a state.
    pub(super) fn size(&self, segment: usize, state: usize) -> f64 {
        self.exact[segment][state].size
    }

    /// Value and derivative of a state at s.
    fn exact(&self, segment: usize, state: usize, s: f64) -> [f64; 2] {
        let Exact { size, shapes } = &self.exact[segment][state];
        let mut sum = [0.0; 2];
        for (weight, shape) in shapes {
            let [value, slope] = shape.at(s);
            sum[0] += size * weight * value;
            sum[1] += size * weight * slope;
        }
        sum
    }

    /// The distances (y − Y) / σ at s.
    fn distances<T: Real>(&self, segment: usize, s: f64, y: &[T]) -> Vec<T> {
        let states = y.iter().enumerate();
        states
            .map(|(i, y)| (*y - self.exact(segment, i, s)[0]) / self.size(segment, i))
            .collect()
    }

    fn parameter_distances<T: Real>(&self, p: &[T]) -> Vec<T> {
        let pairs = p.iter().zip(&self.parameters);
        pairs.map(|(p, exact)| *p / *exact - 1.0).collect()
    }
}

impl Problem for Drawn {
    fn segments(&self) -> Vec<Segment> {
        self.segments.clone()
    }

    fn parameters(&self) -> usize {
        self.parameters.len()
    }

    fn rhs<T: Real>(&self, segment: usize, s: T, y: &[T], p: &[T], dy: &mut [T]) {
        let s = s.value();
        let mut u = self.distances(segment, s, y);
        self.modes[segment].slope(s, &mut u, &self.parameter_distances(p));
        for (i, (dy, slope)) in dy.iter_mut().zip(u).enumerate() {
            *dy = slope * self.size(segment, i) + self.exact(segment, i, s)[1];
        }
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, p: &[T], r: &mut [T]) {
        let mut all = vec![];
        for segment in 0..self.segments.len() {
            all.extend(self.distances(segment, self.end(segment, 0), at.start(segment)));
            all.extend(self.distances(segment, self.end(segment, 1), at.end(segment)));
        }
        all.extend(self.parameter_distances(p));
        for (r, condition) in r.iter_mut().zip(&self.conditions) {
            let form = dot(&condition.form, &all);
            *r = match condition.kind {
                0 => form,
                1 => form + dot(&condition.other, &all).powi(2),
                _ => form.sinh(),
            };
        }
    }
}

/// The exact solution.
impl Guess for Drawn {
    fn state(&self, segment: usize, s: f64, y: &mut [f64]) {
        for (i, y) in y.iter_mut().enumerate() {
            *y = self.exact(segment, i, s)[0];
        }
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }
}

/// The largest row sum of sizes.
fn norm(matrix: &[Vec<f64>]) -> f64 {
    let sums = matrix.iter().map(|row| row.iter().map(|x| x.abs()).sum());
    sums.fold(0.0, f64::max)
}

/// The inverse by Gauss-Jordan elimination with row pivoting; infinite if there is none.
fn inverse(mut a: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let n = a.len();
    for (i, row) in a.iter_mut().enumerate() {
        row.extend((0..n).map(|j| f64::from(u8::from(i == j))));
    }
    for column in 0..n {
        let size = |row: &usize| a[*row][column].abs();
        let pivot = (column..n)
            .max_by(|i, j| size(i).total_cmp(&size(j)))
            .unwrap_or(column);
        a.swap(column, pivot);
        let scale = a[column][column];
        if scale == 0.0 {
            return vec![vec![f64::INFINITY; n]; n];
        }
        a[column].iter_mut().for_each(|x| *x /= scale);
        let pivot_row = a[column].clone();
        for (_, row) in a.iter_mut().enumerate().filter(|(i, _)| *i != column) {
            let factor = row[column];
            row.iter_mut()
                .zip(&pivot_row)
                .for_each(|(x, p)| *x -= factor * p);
        }
    }
    a.into_iter().map(|row| row[n..].to_vec()).collect()
}
