//! A look at the right-hand side where no mesh has looked.
//!
//! The defect of a solution is known at the points of a rule, and a right-hand side with a jump or a
//! narrow peak between them looks smooth. Before a solution is accepted, its defect is therefore evaluated
//! at further places, at
//!
//! * both ends of every interval, just inside: a jump in the gaps next to the nodes, where no point of the
//!   rule lies, is seen there. Nearer to a node it changes the solution by less than the tolerance;
//! * pseudo-random places in between, other ones each time.
//!
//! On a segment of the length L, with K places in all, a peak of the width w is missed with the probability
//! (1 − w / L)^K, where K is at least 64 and, for N intervals, at least N, besides the 2N next to the nodes.
//! A place once found is looked at again on every later mesh.

use crate::discretisation::iterate::{Interval, Iterate};
use crate::discretisation::mesh::{Mesh, split};
use crate::discretisation::scheme::MAX_STAGES;
use crate::discretisation::tableau::Tableau;
use crate::problem::equations::Equations;
use crate::result::quality::Defects;
use crate::result::stats::Stats;

/// Random places of a segment, at least. With as many the look costs as much as four to five intervals.
const PLACES: usize = 64;
/// What an unseen defect may add to the solution, in tolerances.
const ALLOWED: f64 = 0.3;
/// A defect at a random place that is at most this many times the root mean square over its interval is
/// that of the polynomials: Legendre's of degree m ≤ 7 is √(2m + 1) < 4 times its root mean square at
/// its ends, and the next ones are beside it.
const EXPECTED: f64 = 10.0;
/// The widest gap between the points at which an interval has been seen, with six or seven stages and the
/// points of the defect: as much of it may have a defect found in between.
const GAP: f64 = 0.1;
/// How near to a node a jump may be unseen: there it adds this share of the tolerance to the solution.
const NEAR: f64 = 0.1;
/// A place is that many spacings of floating-point numbers off a node, so that it is on its own side.
const SPACINGS: f64 = 16.0;
/// The rungs of the ladder by which a defect near a node is integrated are this far apart, which is how
/// precisely a jump between two of them is placed.
const RUNG: f64 = 0.1;
/// Into how many parts an interval with an unseen defect is cut.
const PARTS: usize = 4;

/// The places looked at so far.
#[derive(Clone, Debug)]
pub(crate) struct FurtherPlaces {
    /// The last member of the additive recurrence with the golden ratio, equidistributed in \[0, 1).
    last: f64,
    /// Segments and places where an unseen defect was found.
    found: Vec<(usize, f64)>,
}

impl FurtherPlaces {
    pub(crate) fn new() -> Self {
        Self {
            last: 0.5,
            found: vec![],
        }
    }

    /// The next place in \[0, 1).
    fn next(&mut self) -> f64 {
        const INVERSE_GOLDEN_RATIO: f64 = 0.618_033_988_749_894_8;
        self.last = (self.last + INVERSE_GOLDEN_RATIO).fract();
        self.last
    }

    /// The mesh with all intervals cut in which an unseen defect adds more to the solution `x` than is
    /// allowed; `None` if there is none. A place where the right-hand side is not finite is passed over: the
    /// solution may touch the end of its domain.
    pub(crate) fn look(
        &mut self,
        equations: &dyn Equations,
        t: &Tableau,
        mesh: &Mesh,
        (x, defects): (&Iterate, &Defects),
        tolerance: f64,
        stats: &mut Stats,
    ) -> Option<Mesh> {
        let mut finer = None;
        for (index, nodes) in mesh.iter().enumerate() {
            let segment = SegmentLook {
                equations,
                t,
                x,
                index,
                nodes,
                local: &defects.local[index],
                allowed: ALLOWED * tolerance,
                near: NEAR * tolerance,
                tolerance,
            };
            let mut pieces = vec![1; nodes.len() - 1];
            segment.near_nodes(&mut pieces, &mut self.found, stats);
            for _ in 0..PLACES.div_ceil(pieces.len()) {
                let theta = self.next();
                segment.inside(theta, &mut pieces, &mut self.found, stats);
            }
            segment.again(&mut pieces, &self.found, stats);
            if pieces.iter().any(|&pieces| pieces > 1) {
                let finer = finer.get_or_insert_with(|| mesh.clone());
                finer[index] = split(nodes, &pieces);
            }
        }
        finer
    }
}

/// A solution on one segment, and what is allowed of its defect.
struct SegmentLook<'a> {
    equations: &'a dyn Equations,
    t: &'a Tableau,
    x: &'a Iterate,
    index: usize,
    nodes: &'a [f64],
    /// The local defects of its intervals.
    local: &'a [f64],
    /// The largest addition to the solution, relative to 1 + |y|, ...
    allowed: f64,
    /// ... and that of a jump next to a node.
    near: f64,
    tolerance: f64,
}

impl SegmentLook<'_> {
    /// Looks next to all nodes from both sides.
    fn near_nodes(&self, pieces: &mut [usize], found: &mut Vec<(usize, f64)>, stats: &mut Stats) {
        let gap = self.t.defect_rule.points[0];
        let slope = self.largest_slope();
        let mut scratch = Scratch::new(self.n());
        for (i, pieces) in pieces.iter_mut().enumerate() {
            let interval = self.interval(i);
            for right in [false, true] {
                let theta = |distance: f64| if right { 1.0 - distance } else { distance };
                let nearest = self.nearest(i, slope).min(0.5 * gap);
                let mut last = gap;
                let at = |distance: f64, scratch: &mut Scratch, stats: &mut Stats| {
                    self.defect(&interval, theta(distance), scratch, stats)
                };
                let mut sum = interval.h * gap * at(nearest, &mut scratch, stats);
                if self.is_unseen(sum, self.local[i]) {
                    sum = 0.0;
                    while last > nearest {
                        let distance = (RUNG * last).max(nearest);
                        let defect =
                            self.unexplained(&interval, theta(distance), &mut scratch, stats);
                        sum += interval.h * (last - distance) * defect;
                        last = distance;
                    }
                    if self.is_unseen(sum, self.local[i]) {
                        *pieces = PARTS;
                        found.push((self.index, interval.place(theta(nearest))));
                    }
                }
            }
        }
    }

    /// Looks at the same place of all intervals.
    fn inside(
        &self,
        theta: f64,
        pieces: &mut [usize],
        found: &mut Vec<(usize, f64)>,
        stats: &mut Stats,
    ) {
        let mut scratch = Scratch::new(self.n());
        for (i, pieces) in pieces.iter_mut().enumerate() {
            if self.is_unseen_at(i, theta, &mut scratch, stats) {
                *pieces = PARTS;
                found.push((self.index, self.interval(i).place(theta)));
            }
        }
    }

    /// Looks where something was found before.
    fn again(&self, pieces: &mut [usize], found: &[(usize, f64)], stats: &mut Stats) {
        let mut scratch = Scratch::new(self.n());
        for &(_, s) in found.iter().filter(|(index, _)| *index == self.index) {
            let i = self
                .nodes
                .partition_point(|&node| node <= s)
                .clamp(1, pieces.len())
                - 1;
            let theta = (s - self.nodes[i]) / (self.nodes[i + 1] - self.nodes[i]);
            if pieces[i] == 1 && self.is_unseen_at(i, theta, &mut scratch, stats) {
                pieces[i] = PARTS;
            }
        }
    }

    /// Whether the defect at a place of interval i is neither that of the polynomials nor harmless.
    fn is_unseen_at(&self, i: usize, theta: f64, scratch: &mut Scratch, stats: &mut Stats) -> bool {
        let interval = self.interval(i);
        let expected = GAP * EXPECTED * self.local[i];
        let seen = GAP * interval.h * self.defect(&interval, theta, scratch, stats);
        self.is_unseen(seen, expected) && {
            let defect = self.unexplained(&interval, theta, scratch, stats);
            self.is_unseen(GAP * interval.h * defect, expected)
        }
    }

    /// Whether an addition to the solution is more than is allowed and than is expected.
    fn is_unseen(&self, addition: f64, expected: f64) -> bool {
        addition > self.allowed && addition > expected
    }

    /// The number of states n.
    fn n(&self) -> usize {
        self.x.segments[self.index].nodes.len() / self.nodes.len()
    }

    fn interval(&self, i: usize) -> Interval<'_> {
        let x = &self.x.segments[self.index];
        Interval::new(x, self.n(), self.t, i, &self.nodes[i..i + 2])
    }

    /// How near to the nodes of interval i a jump by as much as the largest slope is harmless, as a share of
    /// the interval.
    fn nearest(&self, i: usize, slope: f64) -> f64 {
        let (left, right) = (self.nodes[i], self.nodes[i + 1]);
        let spacing = f64::EPSILON * left.abs().max(right.abs());
        (self.near / slope).max(SPACINGS * spacing) / (right - left)
    }

    /// The largest |dy/ds| / (1 + |y|) at the collocation points of the segment, at least that of a state
    /// that changes by one.
    fn largest_slope(&self) -> f64 {
        let least = 1.0 / (self.nodes[self.nodes.len() - 1] - self.nodes[0]);
        let intervals = (0..self.nodes.len() - 1).map(|i| self.interval(i));
        intervals.fold(least, |m, interval| {
            m.max(interval.largest_relative_slope())
        })
    }

    /// The largest defect at a place of an interval, relative to 1 + |y|, less what an error of the states
    /// within the tolerance makes of the right-hand side: next to a singular end that is much.
    fn unexplained(
        &self,
        interval: &Interval<'_>,
        theta: f64,
        scratch: &mut Scratch,
        stats: &mut Stats,
    ) -> f64 {
        self.defect(interval, theta, scratch, stats);
        let Scratch { y, f, slope } = scratch;
        let (n, columns) = (y.len(), y.len() + self.x.p.len());
        let (mut jacobian, s) = (vec![0.0; n * columns], interval.place(theta));
        self.equations
            .rhs_jacobian(self.index, s, y, &self.x.p, f, &mut jacobian);
        stats.jacobian_evaluations += 1;
        let rows = jacobian.chunks_exact(columns);
        let each = slope.iter().zip(&*f).zip(&*y).zip(rows);
        let largest = each.fold(0.0f64, |m, (((slope, f), y_own), row)| {
            let terms = row.iter().zip(&*y);
            let explained: f64 = terms.map(|(j, y)| j.abs() * (1.0 + y.abs())).sum();
            let defect = (slope - f).abs() - self.tolerance * explained;
            m.max(defect / (1.0 + y_own.abs()))
        });
        if largest.is_finite() { largest } else { 0.0 }
    }

    /// The largest defect at a place of an interval, relative to 1 + |y|; zero where it is not finite.
    fn defect(
        &self,
        interval: &Interval<'_>,
        theta: f64,
        scratch: &mut Scratch,
        stats: &mut Stats,
    ) -> f64 {
        let Scratch { y, f, slope } = scratch;
        let mut weights = [0.0; MAX_STAGES];
        let weights = &mut weights[..self.t.stages];
        self.t.value_weights(theta, weights);
        interval.state(weights, y);
        self.t.slope_weights(theta, weights);
        interval.slope(weights, slope);
        f.fill(f64::NAN);
        let s = interval.place(theta);
        self.equations.evaluate_rhs(self.index, s, y, &self.x.p, f);
        stats.rhs_evaluations += 1;
        let defects = slope.iter().zip(&*f).zip(&*y);
        let largest = defects.fold(0.0f64, |m, ((slope, f), y)| {
            m.max((slope - f).abs() / (1.0 + y.abs()))
        });
        if largest.is_finite() { largest } else { 0.0 }
    }
}

/// One state, its right-hand side and its slope.
struct Scratch {
    y: Vec<f64>,
    f: Vec<f64>,
    slope: Vec<f64>,
}

impl Scratch {
    fn new(n: usize) -> Self {
        let [y, f, slope] = [(); 3].map(|()| vec![0.0; n]);
        Self { y, f, slope }
    }
}
