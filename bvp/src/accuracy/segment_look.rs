//! A look at the right-hand side on one segment, at places where no mesh has looked.

use crate::accuracy::looked_at::{At, finite};
use crate::discretisation::iterate::{Interval, Iterate};
use crate::discretisation::powers::Powers;
use crate::discretisation::tableau::Tableau;
use crate::kernels::dense::max_or_nan;
use crate::kernels::few::Few;
use crate::problem::equations::Equations;
use crate::problem::held::Held;
use crate::result::stats::Stats;
use crate::shares::{AIM, ONE_SAMPLE, SPACINGS, UNNOTICED};
use std::slice::ChunksExact;

/// A solution on one segment, what is allowed of its defect, and what is found.
pub(super) struct SegmentLook<'a> {
    pub(super) equations: &'a Held<'a>,
    pub(super) t: &'a Tableau,
    pub(super) x: &'a Iterate,
    pub(super) index: usize,
    pub(super) nodes: &'a [f64],
    /// The local defects of its intervals.
    pub(super) local: &'a [f64],
    pub(super) tolerance: f64,
    pub(super) found: &'a mut Vec<(usize, f64)>,
    /// The intervals with an unseen defect.
    pub(super) cut: Vec<usize>,
    pub(super) powers: &'a mut Powers,
    pub(super) stats: &'a mut Stats,
}

impl<'a> SegmentLook<'a> {
    /// Looks at all intervals next to their nodes and at these shares of their lengths. Its stages m and
    /// states n are known to the compiler.
    #[inline(always)]
    pub(super) fn everywhere(&mut self, size: [usize; 2], places: &[f64]) {
        let slope = self.largest_slope(size);
        let mut values = Few::zeros(3 * size[1]);
        let mut at = At::new(size[1], &mut values);
        let at_once = self.rhs_at_once(size, slope, places);
        at.given = at_once.as_ref().map(|rhs| rhs.chunks_exact(size[1]));
        for i in 0..self.nodes.len() - 1 {
            let interval = self.interval(size, i);
            self.powers.expand(size, self.t, &interval);
            let nearest = self.nearest(i, slope);
            let mut unseen = self.is_unseen_near_nodes(size, (i, &interval), nearest, &mut at);
            let allowed = self.allowed(i, &interval);
            for &theta in places {
                if self.is_unseen_at(size, &interval, allowed, theta, &mut at) {
                    unseen = true;
                    self.found.push((self.index, interval.place(theta)));
                }
            }
            if unseen {
                self.cut.push(i);
            }
        }
    }

    /// The right-hand side where [`everywhere`](Self::everywhere) looks, in its order, if that takes one call.
    #[inline(never)]
    fn rhs_at_once(&mut self, size: [usize; 2], slope: f64, places: &[f64]) -> Option<Vec<f64>> {
        if !self.equations.is_vectorised() {
            return None;
        }
        let intervals = self.nodes.len() - 1;
        let count = intervals * (places.len() + 2);
        let mut at = Vec::with_capacity(count);
        let [mut states, mut rhs] = [0.0, f64::NAN].map(|value| vec![value; count * size[1]]);
        let mut states_left = states.chunks_exact_mut(size[1]);
        for i in 0..intervals {
            let interval = self.interval(size, i);
            self.powers.expand(size, self.t, &interval);
            let nearest = self.nearest(i, slope);
            let near = [nearest, 1.0 - nearest];
            for (theta, y) in near.iter().chain(places).zip(states_left.by_ref()) {
                at.push(interval.place(*theta));
                self.powers.state(size, 2.0 * theta - 1.0, y);
            }
        }
        self.equations
            .evaluate_rhs_at(self.index, &at, &states, &self.x.p, &mut rhs);
        Some(rhs)
    }

    /// Looks next to both nodes of interval i, at a distance of which its length is that share.
    #[inline(always)]
    fn is_unseen_near_nodes(
        &mut self,
        size: [usize; 2],
        (i, interval): (usize, &Interval<'_>),
        nearest: f64,
        at: &mut At<'_>,
    ) -> bool {
        let first = self.t.defect_rule.points[0].max(2.0 * nearest);
        let mut unseen = false;
        for right in [false, true] {
            let theta = if right { 1.0 - nearest } else { nearest };
            let defect = finite(self.defect(size, interval, theta, at));
            let jumps = self.is_unseen(interval.h * first * defect, self.local[i]);
            let grows = interval.h * nearest * at.rate() > 2.0 * UNNOTICED * self.tolerance;
            if jumps || grows {
                let sum = self.near_node(interval, right, [first, nearest]);
                if sum > AIM * self.tolerance && (grows || sum > self.local[i]) {
                    unseen = true;
                    self.found.push((self.index, interval.place(theta)));
                }
            }
        }
        unseen
    }

    /// The integral of the defect beside the left or right node of an interval, over the shares of it up to
    /// the first one: down to the nearest by the rungs of a ladder, each of which does not show in the one
    /// before, beyond it that of the right-hand side by the power law of the last two.
    #[inline(never)]
    fn near_node(
        &mut self,
        interval: &Interval<'_>,
        right: bool,
        [first, nearest]: [f64; 2],
    ) -> f64 {
        let mut at = |distance: f64| {
            let theta = if right { 1.0 - distance } else { distance };
            self.unexplained(interval, theta)
        };
        let (mut sum, mut power, mut last) = (0.0, 0.0f64, first);
        let [mut defect, mut rate] = at(first);
        while last > nearest {
            let distance = (UNNOTICED * last).max(nearest);
            let before = rate;
            [defect, rate] = at(distance);
            sum += (last - distance) * defect;
            power = (rate / before).ln() / (last / distance).ln();
            last = distance;
        }
        // What is steeper than nearly the power −1 is the little that is not explained beside a mapped
        // infinite end.
        let beyond = match power > 0.0 {
            true => rate * power / (1.0 - power).max(UNNOTICED),
            false => 0.0,
        };
        interval.h * (sum + nearest * (defect + beyond))
    }

    /// Looks where something was found before.
    pub(super) fn again(&mut self) {
        let size = self.size();
        for which in 0..self.found.len() {
            let (index, s) = self.found[which];
            if index != self.index {
                continue;
            }
            let behind = self.nodes.partition_point(|&node| node <= s);
            let i = behind.clamp(1, self.nodes.len() - 1) - 1;
            if !self.cut.contains(&i) {
                let interval = self.interval(size, i);
                self.powers.expand(size, self.t, &interval);
                let theta = (s - self.nodes[i]) / interval.h;
                let mut values = Few::zeros(3 * size[1]);
                let at = &mut At::new(size[1], &mut values);
                let allowed = self.allowed(i, &interval);
                if self.is_unseen_at(size, &interval, allowed, theta, at) {
                    self.cut.push(i);
                }
            }
        }
    }

    /// The largest defect at one place of interval i that is either that of the polynomials or harmless. As much
    /// of the interval may have it as there is between the points at which it has been seen.
    ///
    /// That of the polynomials is larger than its root mean square over the interval by less than the factor
    /// of one sample: Legendre's of degree m ≤ 7 is √(2m + 1) < 4 times that at its ends, and the next ones
    /// are beside it.
    #[inline(always)]
    fn allowed(&self, i: usize, interval: &Interval<'_>) -> f64 {
        let width = self.t.widest_gap * interval.h;
        let expected = self.t.widest_gap * ONE_SAMPLE * self.local[i];
        expected.max(AIM * self.tolerance) / width
    }

    /// Whether the defect at a place of an interval is larger than is allowed there.
    #[inline(always)]
    fn is_unseen_at(
        &mut self,
        size: [usize; 2],
        interval: &Interval<'_>,
        allowed: f64,
        theta: f64,
        at: &mut At<'_>,
    ) -> bool {
        let defect = self.defect(size, interval, theta, at);
        if defect <= allowed {
            return false;
        }
        match defect.is_finite() {
            true => self.unexplained(interval, theta)[0] > allowed,
            false => !self.is_finite_beside(interval.place(theta), at),
        }
    }

    /// Whether the right-hand side is finite at a state within the tolerance of this one, all of whose entries
    /// are larger or all smaller: the solution may touch the end of the domain of the right-hand side.
    #[inline(never)]
    fn is_finite_beside(&mut self, s: f64, at: &mut At<'_>) -> bool {
        let At { y, f, slope, .. } = at;
        [1.0, -1.0].into_iter().any(|sign| {
            for (beside, y) in slope.iter_mut().zip(&**y) {
                *beside = y + sign * self.tolerance * (1.0 + y.abs());
            }
            f.fill(f64::NAN);
            self.equations
                .evaluate_rhs(self.index, s, slope, &self.x.p, f);
            self.stats.rhs_evaluations += 1;
            f.iter().all(|f| f.is_finite())
        })
    }

    /// Whether an addition to the solution is more than is allowed and than is expected.
    fn is_unseen(&self, addition: f64, expected: f64) -> bool {
        addition > AIM * self.tolerance && addition > expected
    }

    /// The numbers of stages m and of states n.
    pub(super) fn size(&self) -> [usize; 2] {
        let states = self.x.segments[self.index].nodes.len();
        [self.t.stages, states / self.nodes.len()]
    }

    #[inline(always)]
    fn interval(&self, size: [usize; 2], i: usize) -> Interval<'a> {
        let x = &self.x.segments[self.index];
        Interval::new(x, size, i, &self.nodes[i..i + 2])
    }

    /// How near to the nodes of interval i a jump by as much as the largest slope is harmless, as a share of
    /// the interval: no nearer than places are told apart, and no farther than the middle.
    fn nearest(&self, i: usize, slope: f64) -> f64 {
        let (left, right) = (self.nodes[i], self.nodes[i + 1]);
        let spacing = f64::EPSILON * left.abs().max(right.abs());
        let h = right - left;
        let harmless =
            (UNNOTICED * self.tolerance / slope / h).min(0.5 * self.t.defect_rule.points[0]);
        harmless.max(SPACINGS * spacing / h).min(0.5)
    }

    /// The largest |dy/ds| / (1 + |y|) at the collocation points of the segment, at least that of a state
    /// that changes by one.
    #[inline(always)]
    fn largest_slope(&self, size: [usize; 2]) -> f64 {
        let least = 1.0 / (self.nodes[self.nodes.len() - 1] - self.nodes[0]);
        let intervals = (0..self.nodes.len() - 1).map(|i| self.interval(size, i));
        intervals.fold(least, |m, interval| {
            m.max(interval.largest_relative_slope())
        })
    }

    /// The largest defect and the largest right-hand side at a place of the interval, relative to 1 + |y|,
    /// less what an error of the states within the tolerance makes of the right-hand side: next to a singular
    /// end that is much.
    #[inline(never)]
    fn unexplained(&mut self, interval: &Interval<'_>, theta: f64) -> [f64; 2] {
        let [m, n] = self.size();
        let mut values = Few::zeros(3 * n);
        let At { y, f, slope, .. } = At::new(n, &mut values);
        let u = 2.0 * theta - 1.0;
        self.powers.state([m, n], u, y);
        self.powers.slope([m, n], u, slope);
        let columns = n + self.x.p.len();
        let (mut jacobian, s) = (vec![0.0; n * columns], interval.place(theta));
        self.equations
            .rhs_jacobian(self.index, s, y, &self.x.p, f, &mut jacobian);
        self.stats.jacobian_evaluations += 1;
        let rows = jacobian.chunks_exact(columns);
        let each = slope.iter().zip(&*f).zip(&*y).zip(rows);
        let largest = each.fold([0.0f64; 2], |largest, (((slope, f), y_own), row)| {
            let terms = row.iter().zip(&*y);
            let explained: f64 = terms.map(|(j, y)| j.abs() * (1.0 + y.abs())).sum();
            let sizes = [(slope - f).abs(), f.abs()];
            let sizes = sizes.map(|size| (size - self.tolerance * explained) / (1.0 + y_own.abs()));
            [0, 1].map(|i| largest[i].max(sizes[i]))
        });
        largest.map(finite)
    }

    /// The largest defect at a place of the interval relative to 1 + |y|. The right-hand side is the next one given.
    #[inline(always)]
    fn defect(
        &mut self,
        size: [usize; 2],
        interval: &Interval<'_>,
        theta: f64,
        at: &mut At<'_>,
    ) -> f64 {
        let At { y, f, slope, given } = at;
        let u = 2.0 * theta - 1.0;
        self.powers.state(size, u, y);
        self.powers.slope(size, u, slope);
        match given.as_mut().and_then(ChunksExact::next) {
            Some(given) => f.copy_from_slice(given),
            None => {
                f.fill(f64::NAN);
                let s = interval.place(theta);
                self.equations.evaluate_rhs(self.index, s, y, &self.x.p, f);
            }
        }
        self.stats.rhs_evaluations += 1;
        let defects = slope.iter().zip(&**f).zip(&**y);
        defects.fold(0.0f64, |m, ((slope, f), y)| {
            max_or_nan(m, (slope - f).abs() / (1.0 + y.abs()))
        })
    }
}
