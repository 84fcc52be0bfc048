//! States whose slopes on an interval follow from those of others: derivative states, quadratures and followers.
//!
//! An equation of order two or more is written as a first-order system with y' = z, z' = …, or y' = c z in
//! other units, which are powers of two, so that c is one. Other factors, which may change from step to step
//! as an unknown length does, would ask for another reduction each time. Here y is a *derivative state*, z is
//! its *source* and c its *factor*; the row of y in the Jacobian is c times a unit vector. On an interval the
//! slopes of a derivative state follow from those of its source, `K = c h A K_source + known`, so only the
//! slopes of the other states, the *free* states, are unknown. The linear system for them is as small as if
//! the equation were collocated without reducing its order, and the solution is the same. A free state acts
//! on a derivative state of order d through C h^(d+1) A^(d+1), C the product of all d factors, as in the
//! Runge-Kutta-Nyström form of the scheme (Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations
//! I*, section II.14).
//!
//! A *quadrature* q is a state on which no right-hand side depends, its own included, such as an arc length or a lost
//! energy: its column in the Jacobian is zero. Its slopes follow from those of the others, `K_q = known + Σ_c J_qc h A
//! K_c`, so that it is no free state either.
//!
//! A *follower* c is a state whose right-hand side depends on a single state, its *leader* s, by factors that are not one
//! constant, such as a depth with x' = −sin θ. If the leader is a free state, `K_c = known + J_cs h A K_s`, and M has the
//! product of the two dependences in the place of the follower. That is so only where `h |J_cs|` is at most one at all stages:
//! the multipliers of this elimination are then no larger than those of one with pivots. On an infinite interval mapped to
//! a finite one, where factors reach 1e14, Newton's method failed without this.

use crate::discretisation::tableau::POWERS;
use crate::problem::in_units::power_of_two;
use std::ops::Range;

/// What the Jacobians of a segment have shown so far about the row of one state.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Row {
    /// No Jacobian has been observed.
    Unseen,
    /// Every row was zero but for this factor in the column of this source.
    Multiple { source: usize, factor: f64 },
    /// Every row was zero but in the column of this source, by factors that differ or are no power of two.
    Single { source: usize },
    /// Anything else.
    Other,
}

/// Which rows of the Jacobian are multiples of the same unit vector at all stages of a segment, and which columns are
/// zero.
#[derive(Clone, Debug)]
pub(crate) struct ObservedJacobians {
    rows: Vec<Row>,
    /// The states whose columns have been zero so far, in order.
    unused: Vec<usize>,
    /// For every state whose row has one entry whether that times the length of the interval was larger than one.
    steep: Vec<bool>,
}

impl ObservedJacobians {
    /// For n states.
    pub(crate) fn new(n: usize) -> Self {
        Self {
            rows: vec![Row::Unseen; n],
            unused: (0..n).collect(),
            steep: vec![false; n],
        }
    }

    /// Forgets all observations.
    pub(crate) fn restart(&mut self) {
        self.rows.fill(Row::Unseen);
        self.steep.fill(false);
        self.unused.clear();
        self.unused.extend(0..self.rows.len());
    }

    /// Adds the observations of other intervals of the same segment.
    pub(crate) fn merge(&mut self, other: &Self) {
        self.unused.retain(|state| other.unused.contains(state));
        let steep = self.steep.iter_mut().zip(&other.steep);
        let rows = self.rows.iter_mut().zip(&other.rows);
        for ((seen, other), (steep, steep_other)) in rows.zip(steep) {
            *seen = match (*seen, *other) {
                (Row::Unseen, one) | (one, Row::Unseen) => one,
                (one, other) if one == other => one,
                (one, other) if one.source() == other.source() => one.with_any_factor(),
                _ => Row::Other,
            };
            *steep = (*steep || *steep_other) && seen.source().is_some();
        }
    }

    /// Observes the Jacobians of any number of stages of intervals of the length h, stored one after the other with
    /// `columns` numbers per row: derivatives with respect to n states, then with respect to parameters.
    #[inline(always)]
    pub(crate) fn observe(&mut self, h: f64, jacobians: &[f64], [n, columns]: [usize; 2]) {
        let states = self.rows[..n].iter_mut().zip(&mut self.steep);
        for (state, (seen, steep)) in states.enumerate() {
            let mut rows = jacobians[state * columns..]
                .chunks(n * columns)
                .map(|rows| &rows[..n]);
            let expected = match *seen {
                Row::Unseen => first_entry(&jacobians[state * columns..][..n]),
                row => row,
            };
            let Some(source) = expected.source() else {
                (*seen, *steep) = (Row::Other, false);
                continue;
            };
            *steep |= rows.clone().any(|row| (h * row[source]).abs() > 1.0);
            *seen = match expected {
                Row::Multiple { factor, .. }
                    if rows.clone().all(|row| is_multiple(row, source, factor)) =>
                {
                    expected
                }
                _ if rows.all(|row| is_multiple(row, source, row[source])) => {
                    Row::Single { source }
                }
                _ => Row::Other,
            };
            *steep &= *seen != Row::Other;
        }
        for row in jacobians.chunks_exact(columns) {
            if self.unused.is_empty() {
                break;
            }
            self.unused.retain(|&state| row[state] == 0.0);
        }
    }

    /// The states that are quadratures. A derivative state needs no Jacobian as it is; and one state is always free.
    fn quadratures(&self) -> impl Iterator<Item = usize> + '_ {
        let is_one = |&&state: &&usize| !matches!(self.rows[state], Row::Multiple { .. });
        let found = self.unused.iter().filter(is_one).count();
        let most = if found < self.rows.len() { found } else { 0 };
        self.unused.iter().filter(is_one).take(most).copied()
    }
}

impl Row {
    /// The column that has the only entry, if it is known.
    fn source(self) -> Option<usize> {
        match self {
            Self::Multiple { source, .. } | Self::Single { source } => Some(source),
            Self::Unseen | Self::Other => None,
        }
    }

    /// The same with factors that differ.
    fn with_any_factor(self) -> Self {
        let single = self.source().map(|source| Self::Single { source });
        single.unwrap_or(Self::Other)
    }
}

/// The first entry of a row that is not zero, as if the others were.
#[inline(always)]
fn first_entry(row: &[f64]) -> Row {
    match row.iter().position(|&x| x != 0.0) {
        Some(source) if is_power_of_two(row[source]) => Row::Multiple {
            source,
            factor: row[source],
        },
        Some(source) => Row::Single { source },
        None => Row::Other,
    }
}

/// Whether a number is a power of two.
#[inline(always)]
fn is_power_of_two(x: f64) -> bool {
    x.is_normal() && x > 0.0 && x == power_of_two(x)
}

/// Whether a row is zero but for this factor in the column of this source.
#[inline(always)]
fn is_multiple(row: &[f64], source: usize, factor: f64) -> bool {
    let expected = |j: usize| if j == source { factor } else { 0.0 };
    let entries = row.iter().enumerate();
    entries.fold(true, |all, (j, &x)| all & (x == expected(j)))
}

/// The free states, the derivative states, the quadratures and the followers of a segment.
#[derive(Clone, Debug, Default)]
pub(crate) struct StageReduction {
    /// The observed rows that this reduction was made for.
    rows: Vec<Row>,
    /// Each follower with its leader.
    led: Vec<(usize, usize)>,
    /// Room for those of the next observation, so that it allocates nothing.
    spare: Vec<(usize, usize)>,
    /// The free states.
    pub(crate) free: Vec<usize>,
    /// The quadratures; none of them is a derivative state or the source of one.
    pub(crate) quadratures: Vec<usize>,
    /// Each follower with the index in `free` of its leader; none of them is a leader or the source of a derivative
    /// state.
    pub(crate) followers: Vec<(usize, usize)>,
    /// Each derivative state with its source and its factor; a derivative state that is itself a source
    /// comes first.
    pub(crate) sources: Vec<(usize, usize, f64)>,
    /// For each state: the index in `free` of its highest derivative that is a state, and the order of that
    /// derivative (0 for a free state). Of no meaning for a quadrature or a follower.
    pub(crate) highest: Vec<(usize, usize)>,
    /// For each state: the product of the factors from it to its highest derivative (1 for a free state, 0 for a
    /// quadrature or a follower).
    pub(crate) factors: Vec<f64>,
    /// For each free state: the range of `members` with the states whose highest derivative it is.
    pub(crate) groups: Vec<Range<usize>>,
    /// States with the orders of their highest derivatives and their [`factors`](Self::factors), grouped by
    /// free state.
    pub(crate) members: Vec<(usize, usize, f64)>,
}

impl StageReduction {
    /// Adapts the reduction to what has been observed; returns whether it has changed.
    pub(crate) fn update(&mut self, observed: &ObservedJacobians) -> bool {
        let quadratures = || observed.quadratures();
        let mut led = std::mem::take(&mut self.spare);
        find_followers(observed, &mut led);
        let is_the_same = self.rows == observed.rows && self.led == led;
        if is_the_same && quadratures().eq(self.quadratures.iter().copied()) {
            self.spare = led;
            return false;
        }
        let n = observed.rows.len();
        *self = Self {
            rows: observed.rows.clone(),
            led,
            spare: Vec::with_capacity(n),
            quadratures: quadratures().collect(),
            factors: vec![1.0; n],
            ..Self::default()
        };
        let mut highest = vec![None; n];
        for &c in &self.quadratures {
            highest[c] = Some((0, 0));
            self.factors[c] = 0.0;
        }
        for &(c, _) in &self.led {
            highest[c] = Some((0, 0));
            self.factors[c] = 0.0;
        }
        for (c, (highest, row)) in highest.iter_mut().zip(&observed.rows).enumerate() {
            if highest.is_none() && !matches!(row, Row::Multiple { source, .. } if *source != c) {
                *highest = Some((self.free.len(), 0));
                self.free.push(c);
            }
        }
        // Each pass adds the states whose source is known. If a pass adds none, the remaining states form
        // a cycle or would exceed the highest order, and one of them is made free.
        while let Some(cut) = highest.iter().position(Option::is_none) {
            let before = self.sources.len();
            for c in 0..n {
                if let (None, Row::Multiple { source, factor }) = (highest[c], observed.rows[c])
                    && let Some((place, order)) = highest[source]
                    && order + 1 < POWERS
                {
                    highest[c] = Some((place, order + 1));
                    self.factors[c] = factor * self.factors[source];
                    self.sources.push((c, source, factor));
                }
            }
            if self.sources.len() == before {
                highest[cut] = Some((self.free.len(), 0));
                self.free.push(cut);
            }
        }
        self.highest = highest.into_iter().flatten().collect();
        let place = |&(c, leader): &(usize, usize)| (c, self.highest[leader].0);
        self.followers = self.led.iter().map(place).collect();
        for place in 0..self.free.len() {
            let first = self.members.len();
            let states = self.highest.iter().enumerate();
            let is_led = |c: usize| self.led.iter().any(|&(follower, _)| follower == c);
            let is_member = |c: usize| !self.quadratures.contains(&c) && !is_led(c);
            let group = states.filter(|&(c, &(of, _))| of == place && is_member(c));
            self.members
                .extend(group.map(|(c, &(_, order))| (c, order, self.factors[c])));
            self.groups.push(first..self.members.len());
        }
        true
    }
}

/// The followers among observed states, with their leaders.
fn find_followers(observed: &ObservedJacobians, found: &mut Vec<(usize, usize)>) {
    let rows = &observed.rows;
    let is_derived = |c: usize| {
        let mut sources = rows.iter().enumerate();
        sources
            .any(|(d, row)| d != c && matches!(row, Row::Multiple { source, .. } if *source == c))
    };
    found.clear();
    for (c, row) in rows.iter().enumerate() {
        let &Row::Single { source: leader } = row else {
            continue;
        };
        let is_free = |c: usize| !matches!(rows[c], Row::Multiple { source, .. } if source != c);
        let leads = found.iter().any(|&(_, leader)| leader == c);
        let is_led = found.iter().any(|&(follower, _)| follower == leader);
        let may_follow = leader != c
            && !leads
            && !is_derived(c)
            && observed.quadratures().all(|quadrature| quadrature != c)
            && !observed.steep[c];
        if may_follow && !is_led && is_free(leader) {
            found.push((c, leader));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn multiple(source: usize, factor: f64) -> Row {
        Row::Multiple { source, factor }
    }

    fn unit(source: usize) -> Row {
        multiple(source, 1.0)
    }

    fn reduction(rows: &[Row]) -> StageReduction {
        reduction_with(rows, &[])
    }

    fn reduction_with(rows: &[Row], unused: &[usize]) -> StageReduction {
        let observed = ObservedJacobians {
            rows: rows.to_vec(),
            unused: unused.to_vec(),
            steep: vec![false; rows.len()],
        };
        let mut reduction = StageReduction::default();
        assert!(reduction.update(&observed));
        assert!(!reduction.update(&observed));
        let found = [reduction.free.len(), reduction.sources.len()];
        let others = [reduction.quadratures.len(), reduction.followers.len()];
        assert_eq!(found.iter().chain(&others).sum::<usize>(), rows.len());
        reduction
    }

    #[test]
    fn equal_rows_with_one_entry_at_all_stages_are_observed() {
        let mut observed = ObservedJacobians::new(3);
        observed.observe(
            0.1,
            &[0.0, 1.0, 0.0, 9.0, 0.0, 0.0, 4.0, 9.0, 1.0, 1.0, 0.0, 9.0],
            [3, 4],
        );
        assert_eq!(observed.rows, [unit(1), multiple(2, 4.0), Row::Other]);
        observed.observe(
            0.1,
            &[0.0, 1.0, 0.0, 8.0, 0.0, 0.0, 2.0, 8.0, 1.0, 0.0, 0.0, 8.0],
            [3, 4],
        );
        assert_eq!(
            observed.rows,
            [unit(1), Row::Single { source: 2 }, Row::Other]
        );
    }

    #[test]
    fn merged_observations_of_two_parts_equal_those_of_the_whole() {
        let rows = [Row::Unseen, unit(0), multiple(1, 2.0), Row::Other];
        // The first of two rows; the second always has two entries.
        let shown = |row: Row| match row {
            Row::Multiple { source: 0, factor } => [factor, 0.0, 0.5, 0.5],
            Row::Multiple { factor, .. } => [0.0, factor, 0.5, 0.5],
            _ => [0.5; 4],
        };
        for (one, other) in rows.iter().flat_map(|a| rows.map(|b| (*a, b))) {
            let [mut first, mut second, mut whole] = [(); 3].map(|()| ObservedJacobians::new(2));
            for (observed, row) in [(&mut first, one), (&mut second, other)] {
                if row != Row::Unseen {
                    observed.observe(0.7, &shown(row), [2, 2]);
                    whole.observe(0.7, &shown(row), [2, 2]);
                }
            }
            first.merge(&second);
            assert_eq!((first.rows, first.steep), (whole.rows, whole.steep));
        }
    }

    #[test]
    fn derivative_states_lead_to_free_states() {
        // y₀' = y₁, y₁' = 3 y₂, y₃' = 2 y₁, and y₄' = y₄ is its own derivative.
        let found = reduction(&[
            unit(1),
            multiple(2, 3.0),
            Row::Other,
            multiple(1, 2.0),
            unit(4),
        ]);
        assert_eq!(found.free, [2, 4]);
        assert_eq!(found.sources, [(1, 2, 3.0), (3, 1, 2.0), (0, 1, 1.0)]);
        assert_eq!(found.highest, [(0, 2), (0, 1), (0, 0), (0, 2), (1, 0)]);
        assert_eq!(found.factors, [3.0, 3.0, 1.0, 6.0, 1.0]);
    }

    #[test]
    fn states_that_none_depends_on_are_quadratures() {
        let mut observed = ObservedJacobians::new(3);
        observed.observe(1.0, &[0.0, 0.0, 3.0, 0.0, 0.0, 0.5, 0.0, 0.0, 1.0], [3, 3]);
        assert_eq!(observed.unused, [0, 1]);
        let mut other = ObservedJacobians::new(3);
        other.observe(1.0, &[0.0, 2.0, 3.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0], [3, 3]);
        observed.merge(&other);
        assert_eq!(observed.unused, [0]);
        // A derivative state stays one, and of states that all are unused all are free.
        let found = reduction_with(&[unit(1), Row::Other, Row::Other], &[0, 2]);
        assert_eq!((found.free, found.quadratures), (vec![1], vec![2]));
        assert_eq!(found.members, [(0, 1, 1.0), (1, 0, 1.0)]);
        let found = reduction_with(&[Row::Other, Row::Other], &[0, 1]);
        assert_eq!((found.free, found.quadratures), (vec![0, 1], vec![]));
    }

    #[test]
    fn states_with_one_source_and_factors_that_differ_follow_it() {
        let mut observed = ObservedJacobians::new(3);
        observed.observe(0.3, &[0.0, 3.0, 0.0, 0.5, 1.0, 0.5, 0.0, 2.0, 0.0], [3, 3]);
        let [single, twice] = [Row::Single { source: 1 }, multiple(1, 2.0)];
        assert_eq!(observed.rows, [single, Row::Other, twice]);
        let mut other = ObservedJacobians::new(3);
        other.observe(0.3, &[0.0, 0.0, 0.0, 0.5, 1.0, 0.5, 0.0, 4.0, 0.0], [3, 3]);
        observed.merge(&other);
        assert_eq!(observed.rows[2], single);
        observed.observe(0.3, &[0.0, 1.0, 0.1, 0.5, 1.0, 0.5, 0.0, 2.0, 0.0], [3, 3]);
        assert_eq!(observed.rows, [Row::Other, Row::Other, single]);
        // By 0.3 · 4.
        assert_eq!(observed.steep, [false, false, true]);

        // Of a chain every second state follows; one does not follow itself, and none that is followed or differentiated
        // follows another.
        let single = |source| Row::Single { source };
        let found = reduction(&[single(1), single(2), single(3), Row::Other, single(4)]);
        assert_eq!(found.free, [1, 3, 4]);
        assert_eq!(found.followers, [(0, 0), (2, 1)]);
        let found = reduction(&[unit(1), single(2), Row::Other, single(2)]);
        assert_eq!((found.free, found.followers), (vec![1, 2], vec![(3, 1)]));
        assert_eq!(found.members, [(0, 1, 1.0), (1, 0, 1.0), (2, 0, 1.0)]);
        let mut steep = ObservedJacobians::new(2);
        steep.observe(0.5, &[0.0, 3.0, 0.5, 0.5], [2, 2]);
        let mut reduction = StageReduction::default();
        assert!(reduction.update(&steep));
        assert_eq!((reduction.free, reduction.followers), (vec![0, 1], vec![]));
    }

    #[test]
    fn cycles_and_orders_above_the_highest_are_cut() {
        let cycle = reduction(&[unit(1), multiple(0, -4.0)]);
        assert_eq!((cycle.free, cycle.sources), (vec![0], vec![(1, 0, -4.0)]));
        let high: Vec<Row> = (1..8).map(unit).chain([Row::Other]).collect();
        let high = reduction(&high);
        assert!(high.highest.iter().all(|(_, order)| *order < POWERS));
        assert_eq!(high.free.len() + high.sources.len(), 8);
    }
}
