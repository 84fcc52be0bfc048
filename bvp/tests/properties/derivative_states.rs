//! States whose derivative is another state, in its units or in others, are eliminated, which changes nothing
//! but the cost.

use bvp::{
    Constant, Control, Ends, Equations, Family, Options, Scheme, Segment, Shape, Solution, solve,
};

/// Numbers of derivative states: y₀' = c y₁, y₁' = c y₂, …
const DERIVATIVES: std::ops::RangeInclusive<usize> = 1..=4;
/// Powers of two, with which states are eliminated, and others.
const FACTORS: [f64; 5] = [1.0, 0.5, 0.25, 1.25, -0.3];

/// y₀⁽ⁿ⁻¹⁾ = cⁿ⁻¹ (−y₀ + p y₀² / 20 + cos s), n − 2 derivative states, and a last state with the slope y₀ y₁.
struct Oscillator {
    segments: [Segment; 1],
    derivatives: usize,
    /// The factor c.
    factor: f64,
    /// The last entry of the Jacobian row of a derivative state, zero for a unit vector.
    extra: f64,
    /// Whether p is left free.
    free: bool,
}

impl Oscillator {
    fn new(derivatives: usize, factor: f64, extra: f64, free: bool) -> Self {
        Self {
            segments: [Segment::on(derivatives + 2, 0.0, 1.0)],
            derivatives,
            factor,
            extra,
            free,
        }
    }

    fn states(&self) -> usize {
        self.derivatives + 2
    }
}

impl Equations for Oscillator {
    fn shape(&self) -> Shape {
        Shape {
            segments: self.segments.to_vec(),
            parameters: 1,
            conditions: self.states() + usize::from(!self.free),
        }
    }

    fn evaluate_rhs(&self, _: usize, s: f64, y: &[f64], p: &[f64], dy: &mut [f64]) {
        for (dy, next) in dy.iter_mut().zip(&y[1..=self.derivatives]) {
            *dy = self.factor * next;
        }
        dy[self.derivatives] = 0.05 * p[0] * y[0] * y[0] - y[0] + s.cos();
        dy[self.derivatives + 1] = y[0] * y[1];
    }

    fn rhs_jacobian(
        &self,
        segment: usize,
        s: f64,
        y: &[f64],
        p: &[f64],
        dy: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.evaluate_rhs(segment, s, y, p, dy);
        jacobian.fill(0.0);
        let (n, derivatives, columns) = (self.states(), self.derivatives, self.states() + 1);
        for state in 0..derivatives {
            jacobian[state * columns + state + 1] = self.factor;
            jacobian[state * columns + n - 1] = self.extra;
        }
        jacobian[derivatives * columns] = 0.1 * p[0] * y[0] - 1.0;
        jacobian[derivatives * columns + n] = 0.05 * y[0] * y[0];
        jacobian[(derivatives + 1) * columns] = y[1];
        jacobian[(derivatives + 1) * columns + 1] = y[0];
    }

    fn evaluate_conditions(&self, at: Ends<'_, f64>, p: &[f64], r: &mut [f64]) {
        let n = self.states();
        // One at the right end, the others at the left one.
        for (r, y) in r.iter_mut().zip(&at.start(0)[..n]) {
            *r = y - 0.1;
        }
        r[0] = at.end(0)[0] - 0.2;
        if !self.free {
            r[n] = p[0] - 1.0;
        }
    }

    fn conditions_jacobian(
        &self,
        at: Ends<'_, f64>,
        p: &[f64],
        r: &mut [f64],
        jacobian: &mut [f64],
    ) {
        self.evaluate_conditions(at, p, r);
        let (n, columns) = (self.states(), 2 * self.states() + 1);
        jacobian.fill(0.0);
        jacobian[n] = 1.0;
        for i in 1..n {
            jacobian[i * columns + i] = 1.0;
        }
        if !self.free {
            jacobian[n * columns + 2 * n] = 1.0;
        }
    }
}

/// A small number that makes a row no multiple of a unit vector: it changes no sum.
const TINY: f64 = 1e-300;

fn cases() -> impl Iterator<Item = (usize, f64)> {
    DERIVATIVES.flat_map(|derivatives| FACTORS.map(|factor| (derivatives, factor)))
}

fn guess(derivatives: usize) -> Constant {
    Constant {
        states: vec![vec![0.1; derivatives + 2]],
        parameters: vec![1.0],
    }
}

fn options(stages: usize) -> Options {
    Options {
        scheme: Some(Scheme::Gauss { stages }),
        control: Control::Defect,
        tolerance: 1e-2,
        ..Options::default()
    }
}

fn near(x: &[f64], y: &[f64]) -> bool {
    x.iter()
        .zip(y)
        .all(|(x, y)| (x - y).abs() < 1e-12 * (1.0 + x.abs()))
}

#[test]
fn order_reduction_changes_neither_the_solution_nor_the_way_to_it() {
    for (derivatives, factor) in cases() {
        for stages in [3, 4, 6, 7] {
            let [reduced, plain] = [0.0, TINY].map(|extra| -> Solution {
                let equations = Oscillator::new(derivatives, factor, extra, false);
                solve(&equations, &guess(derivatives), &options(stages)).unwrap()
            });
            let [one, two] = [&reduced, &plain].map(|solution| {
                let stats = solution.stats();
                (stats.newton_steps, stats.factorisations, stats.meshes)
            });
            assert_eq!(one, two, "{derivatives} derivative states, {stages} stages");
            assert_eq!(reduced.mesh(0), plain.mesh(0));
            let [mut y, mut z] = [vec![0.0; derivatives + 2], vec![0.0; derivatives + 2]];
            for i in 0..=50 {
                let s = 0.02 * f64::from(i);
                reduced.state(0, s, &mut y);
                plain.state(0, s, &mut z);
                assert!(
                    near(&y, &z),
                    "{derivatives} derivative states, {stages} stages: {y:?} {z:?}"
                );
                reduced.derivative(0, s, &mut y);
                plain.derivative(0, s, &mut z);
                assert!(
                    near(&y, &z),
                    "{derivatives} derivative states, {stages} stages: {y:?} {z:?}"
                );
            }
        }
    }
}

#[test]
fn order_reduction_changes_neither_corrections_nor_null_vectors_of_a_family() {
    for (derivatives, factor) in cases() {
        for stages in [3, 4, 6, 7] {
            let [one, two] = [0.0, TINY].map(|extra| {
                let equations = Oscillator::new(derivatives, factor, extra, true);
                let (mut family, mut z) =
                    Family::new(&equations, 0, &[], &guess(derivatives), &options(stages)).unwrap();
                // Off the curve, where the correction is not nothing.
                for (i, z) in z.iter_mut().enumerate() {
                    *z += 1e-2 * (i as f64).sin();
                }
                let mut g = vec![0.0; z.len() - 1];
                let [mut correction, mut t] = [z.clone(), z.clone()];
                family.residual(&z, &mut g);
                family.linearise(&z).unwrap();
                family.particular(&g, &mut correction);
                family.null_vector(&mut t);
                assert!(correction.iter().any(|v| v.abs() > 1e-3));
                (correction, t)
            });
            assert!(
                near(&one.0, &two.0) && near(&one.1, &two.1),
                "{derivatives} derivative states, {stages} stages"
            );
        }
    }
}
