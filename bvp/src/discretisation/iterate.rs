//! The unknowns of the discretised problem, all together and interval by interval.

use crate::discretisation::mesh::Mesh;
use crate::discretisation::tableau::Tableau;
use crate::kernels::dense::{add_scaled, combine, max_or_nan};
use crate::kernels::room::make_room;
use crate::kernels::specialise::specialise;
use crate::problem::guess::Guess;
use crate::problem::problem::Segment;

/// The unknowns of the discretised problem, or a correction of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Iterate {
    pub(crate) segments: Vec<SegmentIterate>,
    /// Parameters p.
    pub(crate) p: Vec<f64>,
}

/// The unknowns of one segment with N intervals.
#[derive(Clone, Debug, Default)]
pub(crate) struct SegmentIterate {
    /// States at the nodes, (N + 1) × n.
    pub(crate) nodes: Vec<f64>,
    /// Stage slopes dy/ds, N × m × n.
    pub(crate) stages: Vec<f64>,
}

/// Makes room for the given segments, mesh and stages. What was empty is zero then.
pub(crate) fn resize(
    all: &mut Vec<SegmentIterate>,
    segments: &[Segment],
    mesh: &Mesh,
    stages: usize,
) {
    all.resize_with(segments.len(), Default::default);
    for ((segment, nodes), x) in segments.iter().zip(mesh).zip(all) {
        let (n, intervals) = (segment.states, nodes.len() - 1);
        make_room(&mut x.nodes, (intervals + 1) * n);
        make_room(&mut x.stages, intervals * stages * n);
    }
}

impl SegmentIterate {
    /// Takes the polynomials with m stages that interpolate n states from zero slopes.
    #[inline(always)]
    fn interpolate(
        &mut self,
        [m, n]: [usize; 2],
        nodes: &[f64],
        t: &Tableau,
        state: impl Fn(f64, &mut [f64]),
    ) {
        let mut values = vec![0.0; (m + 1) * n];
        let values = &mut values[..(m + 1) * n];
        let unknowns = self.nodes.chunks_exact_mut(n);
        let unknowns = unknowns.zip(self.stages.chunks_exact_mut(m * n));
        for (pair, (node, stages)) in nodes.windows(2).zip(unknowns) {
            let h = pair[1] - pair[0];
            for (value, theta) in values.chunks_exact_mut(n).zip(&t.guess_points) {
                state(pair[0] + theta * h, value);
            }
            node.copy_from_slice(&values[..n]);
            let stages = stages.chunks_exact_mut(n);
            for (stage, slopes) in stages.zip(t.guess_slope.chunks_exact(m + 1)) {
                for (value, slope) in values.chunks_exact(n).zip(slopes) {
                    add_scaled(stage, slope / h, value);
                }
            }
        }
        let last = nodes.len() - 1;
        state(nodes[last], &mut self.nodes[last * n..]);
    }
}

impl Iterate {
    /// Makes room for the given segments, mesh, stages and k parameters.
    pub(crate) fn resize(&mut self, segments: &[Segment], mesh: &Mesh, stages: usize, k: usize) {
        resize(&mut self.segments, segments, mesh, stages);
        self.p.resize(k, 0.0);
    }

    /// The iterate whose collocation polynomials interpolate a guess.
    pub(crate) fn interpolate(
        segments: &[Segment],
        mesh: &Mesh,
        t: &Tableau,
        k: usize,
        guess: &dyn Guess,
    ) -> Self {
        let m = t.stages;
        let mut x = Self::default();
        x.resize(segments, mesh, m, k);
        guess.parameters(&mut x.p);
        let each = segments.iter().zip(mesh).zip(&mut x.segments);
        for (index, ((segment, nodes), unknowns)) in each.enumerate() {
            let n = segment.states;
            specialise!(n in [1, 2, 3, 4, 5, 6] => specialise!(m in [6, 7] =>
                unknowns.interpolate([m, n], nodes, t, |s, y| guess.state(index, s, y))));
        }
        x
    }

    /// The largest state at a node.
    pub(crate) fn largest_state(&self) -> f64 {
        let states = self.segments.iter().flat_map(|segment| &segment.nodes);
        states.fold(0.0, |largest, y| max_or_nan(largest, y.abs()))
    }

    /// self ← x + factor · correction.
    pub(crate) fn set_sum(&mut self, x: &Self, factor: f64, correction: &Self) {
        let set = |target: &mut [f64], x: &[f64], d: &[f64]| {
            for ((target, x), d) in target.iter_mut().zip(x).zip(d) {
                *target = x + factor * d;
            }
        };
        for ((target, x), d) in self
            .segments
            .iter_mut()
            .zip(&x.segments)
            .zip(&correction.segments)
        {
            set(&mut target.nodes, &x.nodes, &d.nodes);
            set(&mut target.stages, &x.stages, &d.stages);
        }
        set(&mut self.p, &x.p, &correction.p);
    }

    /// self += factor · other.
    pub(crate) fn add(&mut self, factor: f64, other: &Self) {
        for (to, other) in self.segments.iter_mut().zip(&other.segments) {
            add_scaled(&mut to.nodes, factor, &other.nodes);
            add_scaled(&mut to.stages, factor, &other.stages);
        }
        add_scaled(&mut self.p, factor, &other.p);
    }
}

/// The residual of the discretised problem.
#[derive(Clone, Debug, Default)]
pub(crate) struct Residual {
    /// Continuity residuals in the slots of nodes 1 … N, stage residuals in those of the stages.
    pub(crate) equations: Vec<SegmentIterate>,
    /// Residuals of the conditions.
    pub(crate) conditions: Vec<f64>,
}

impl Residual {
    /// Sets all residuals to zero.
    pub(crate) fn clear(&mut self) {
        for equations in &mut self.equations {
            equations.nodes.fill(0.0);
            equations.stages.fill(0.0);
        }
        self.conditions.fill(0.0);
    }
}

/// A value of the right-hand side or of a condition that is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum NonFinite {
    Rhs {
        segment: usize,
        s: f64,
        component: usize,
    },
    Condition {
        index: usize,
    },
}

/// The unknowns on one interval.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval<'a> {
    /// Stages m and states n.
    m: usize,
    n: usize,
    /// Left end.
    s: f64,
    /// Right end.
    end: f64,
    /// Length.
    pub(crate) h: f64,
    /// States at both nodes.
    pub(crate) y: &'a [f64],
    pub(crate) next: &'a [f64],
    stages: &'a [f64],
}

impl<'a> Interval<'a> {
    /// Interval `index` of a segment with m stages and n states.
    #[inline(always)]
    pub(crate) fn new(
        x: &'a SegmentIterate,
        [m, n]: [usize; 2],
        index: usize,
        ends: &[f64],
    ) -> Self {
        Self {
            m,
            n,
            s: ends[0],
            end: ends[1],
            h: ends[1] - ends[0],
            y: &x.nodes[index * n..][..n],
            next: &x.nodes[(index + 1) * n..][..n],
            stages: &x.stages[index * m * n..][..m * n],
        }
    }

    /// y = yᵢ + h Σ weightsₗ Kₗ.
    #[inline(always)]
    pub(crate) fn state(&self, weights: &[f64], y: &mut [f64]) {
        combine(y, weights, self.stages, |state, sum| {
            self.y[state] + self.h * sum
        });
    }

    /// The largest |Kⱼ| relative to 1 + |yᵢ| of all stages and states.
    #[inline(always)]
    pub(crate) fn largest_relative_slope(&self) -> f64 {
        let states = self.y.iter().enumerate();
        states.fold(0.0, |largest, (state, y)| {
            let slopes = (0..self.m).map(|j| self.stages[j * self.n + state].abs());
            largest.max(slopes.fold(0.0, f64::max) / (1.0 + y.abs()))
        })
    }

    /// slope = Σ weightsₗ Kₗ.
    #[inline(always)]
    pub(crate) fn slope(&self, weights: &[f64], slope: &mut [f64]) {
        combine(slope, weights, self.stages, |_, sum| sum);
    }

    /// The point θ of the interval, which rounding does not move outside.
    #[inline(always)]
    pub(crate) fn place(&self, theta: f64) -> f64 {
        let place = self.s + theta * self.h;
        if place < self.end { place } else { self.end }
    }

    /// The largest term of the continuity of a component: its states at both nodes, h times its slopes.
    pub(crate) fn size(&self, component: usize) -> f64 {
        let slopes = self.stages.iter().skip(component).step_by(self.n);
        let largest = slopes.fold(0.0, |m: f64, k| m.max(k.abs()));
        let states = self.y[component].abs().max(self.next[component].abs());
        states.max(self.h * largest)
    }

    /// The slopes of stage j.
    pub(crate) fn stage_slope(&self, j: usize) -> &'a [f64] {
        &self.stages[j * self.n..][..self.n]
    }

    /// The state at stage j.
    pub(crate) fn stage_state(&self, t: &Tableau, j: usize, y: &mut [f64]) {
        self.state(&t.a[j * self.m..][..self.m], y);
    }

    /// Replaces f by r = Kⱼ − f; refuses an f that is not finite.
    #[inline(always)]
    pub(crate) fn stage_residual(
        &self,
        j: usize,
        r: &mut [f64],
        segment: usize,
        s: f64,
    ) -> Result<(), NonFinite> {
        let slopes = &self.stages[j * self.n..][..self.n];
        for (component, (r, slope)) in r.iter_mut().zip(slopes).enumerate() {
            if !r.is_finite() {
                return Err(NonFinite::Rhs {
                    segment,
                    s,
                    component,
                });
            }
            *r = slope - *r;
        }
        Ok(())
    }

    /// Writes the continuity residual c = yᵢ₊₁ − yᵢ − h Σ bⱼ Kⱼ.
    #[inline(always)]
    pub(crate) fn continuity(&self, t: &Tableau, c: &mut [f64]) {
        self.state(&t.b[..self.m], c);
        for (c, next) in c.iter_mut().zip(self.next) {
            *c = next - *c;
        }
    }
}
