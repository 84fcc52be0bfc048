//! Order reduction: states whose derivative is another state.
//!
//! An equation of order two or more is written as a first-order system with y' = z, z' = …. Here y is a
//! *derivative state* and z is its *source*; the row of y in the Jacobian is a unit vector. On an interval
//! the slopes of a derivative state follow from those of its source, `K = h A K_source + known`, so only
//! the slopes of the other states, the *free* states, are unknown. The linear system for them is as small
//! as if the equation were collocated without reducing its order, and the solution is the same. A free
//! state y⁽ᵈ⁾ acts on y through h^(d+1) A^(d+1), as in the Runge-Kutta-Nyström form of the scheme (Hairer,
//! Nørsett & Wanner, *Solving Ordinary Differential Equations I*, section II.14).

use crate::discretisation::tableau::POWERS;
use std::ops::Range;

/// What the Jacobians of a segment have shown so far about the row of one state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Row {
    /// No Jacobian has been observed.
    Unseen,
    /// Every row was the unit vector with its one in this column.
    Unit(usize),
    /// Anything else.
    Other,
}

/// Which rows of the Jacobian are the same unit vector at all stages of a segment.
#[derive(Clone, Debug)]
pub(crate) struct ObservedRows {
    rows: Vec<Row>,
}

impl ObservedRows {
    /// For n states.
    pub(crate) fn new(n: usize) -> Self {
        Self {
            rows: vec![Row::Unseen; n],
        }
    }

    /// Forgets all observations.
    pub(crate) fn restart(&mut self) {
        self.rows.fill(Row::Unseen);
    }

    /// Adds the observations of other intervals of the same segment.
    pub(crate) fn merge(&mut self, other: &Self) {
        for (seen, other) in self.rows.iter_mut().zip(&other.rows) {
            *seen = match (*seen, *other) {
                (Row::Unseen, one) | (one, Row::Unseen) => one,
                (one, other) if one == other => one,
                _ => Row::Other,
            };
        }
    }

    /// Observes the Jacobians of any number of stages, stored one after the other with `columns` numbers
    /// per row: derivatives with respect to n states, then with respect to parameters.
    #[inline(always)]
    pub(crate) fn observe(&mut self, jacobians: &[f64], n: usize, columns: usize) {
        for (state, seen) in self.rows[..n].iter_mut().enumerate() {
            let mut rows = jacobians[state * columns..]
                .chunks(n * columns)
                .map(|rows| &rows[..n]);
            let column = match *seen {
                Row::Other => None,
                Row::Unit(column) => Some(column),
                Row::Unseen => jacobians[state * columns..][..n]
                    .iter()
                    .position(|&x| x == 1.0),
            };
            *seen = match column {
                Some(column) if rows.all(|row| is_unit(row, column)) => Row::Unit(column),
                _ => Row::Other,
            };
        }
    }
}

/// Whether a row is the unit vector with the one in this column.
#[inline(always)]
fn is_unit(row: &[f64], column: usize) -> bool {
    let unit = |j: usize| if j == column { 1.0 } else { 0.0 };
    let entries = row.iter().enumerate();
    entries.fold(true, |all, (j, &x)| all & (x == unit(j)))
}

/// The free and the derivative states of a segment.
#[derive(Clone, Debug, Default)]
pub(crate) struct OrderReduction {
    /// The observed rows that this reduction was made for.
    rows: Vec<Row>,
    /// The free states.
    pub(crate) free: Vec<usize>,
    /// Each derivative state with its source; a derivative state that is itself a source comes first.
    pub(crate) sources: Vec<(usize, usize)>,
    /// For each state: the index in `free` of its highest derivative that is a state, and the order of that
    /// derivative (0 for a free state).
    pub(crate) highest: Vec<(usize, usize)>,
    /// For each free state: the range of `members` with the states whose highest derivative it is.
    pub(crate) groups: Vec<Range<usize>>,
    /// States with the orders of their highest derivatives, grouped by free state.
    pub(crate) members: Vec<(usize, usize)>,
}

impl OrderReduction {
    /// Adapts the reduction to what has been observed; returns whether it has changed.
    pub(crate) fn update(&mut self, observed: &ObservedRows) -> bool {
        if self.rows == observed.rows {
            return false;
        }
        let n = observed.rows.len();
        *self = Self {
            rows: observed.rows.clone(),
            ..Self::default()
        };
        let mut highest = vec![None; n];
        for (c, (highest, row)) in highest.iter_mut().zip(&observed.rows).enumerate() {
            if !matches!(row, Row::Unit(source) if *source != c) {
                *highest = Some((self.free.len(), 0));
                self.free.push(c);
            }
        }
        // Each pass adds the states whose source is known. If a pass adds none, the remaining states form
        // a cycle or would exceed the highest order, and one of them is made free.
        while let Some(cut) = highest.iter().position(Option::is_none) {
            let before = self.sources.len();
            for c in 0..n {
                if let (None, Row::Unit(source)) = (highest[c], observed.rows[c])
                    && let Some((place, order)) = highest[source]
                    && order + 1 < POWERS
                {
                    highest[c] = Some((place, order + 1));
                    self.sources.push((c, source));
                }
            }
            if self.sources.len() == before {
                highest[cut] = Some((self.free.len(), 0));
                self.free.push(cut);
            }
        }
        self.highest = highest.into_iter().flatten().collect();
        for place in 0..self.free.len() {
            let first = self.members.len();
            let states = self.highest.iter().enumerate();
            let group = states.filter(|(_, (of, _))| *of == place);
            self.members
                .extend(group.map(|(c, &(_, order))| (c, order)));
            self.groups.push(first..self.members.len());
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reduction(rows: &[Row]) -> OrderReduction {
        let observed = ObservedRows {
            rows: rows.to_vec(),
        };
        let mut reduction = OrderReduction::default();
        assert!(reduction.update(&observed));
        assert!(!reduction.update(&observed));
        assert_eq!(reduction.free.len() + reduction.sources.len(), rows.len());
        reduction
    }

    #[test]
    fn equal_unit_rows_of_all_stages_are_observed() {
        let mut observed = ObservedRows::new(3);
        observed.observe(
            &[0.0, 1.0, 0.0, 9.0, 0.0, 0.0, 1.0, 9.0, 1.0, 1.0, 0.0, 9.0],
            3,
            4,
        );
        assert_eq!(observed.rows, [Row::Unit(1), Row::Unit(2), Row::Other]);
        observed.observe(
            &[0.0, 1.0, 0.0, 8.0, 0.0, 1.0, 0.0, 8.0, 1.0, 0.0, 0.0, 8.0],
            3,
            4,
        );
        assert_eq!(observed.rows, [Row::Unit(1), Row::Other, Row::Other]);
    }

    #[test]
    fn merged_observations_of_two_parts_equal_those_of_the_whole() {
        let rows = [Row::Unseen, Row::Unit(0), Row::Unit(1), Row::Other];
        // The first of two rows; the second is never a unit vector.
        let shown = |row: Row| match row {
            Row::Unit(0) => [1.0, 0.0, 0.5, 0.5],
            Row::Unit(_) => [0.0, 1.0, 0.5, 0.5],
            _ => [0.5; 4],
        };
        for (one, other) in rows.iter().flat_map(|a| rows.map(|b| (*a, b))) {
            let [mut first, mut second, mut whole] = [(); 3].map(|()| ObservedRows::new(2));
            for (observed, row) in [(&mut first, one), (&mut second, other)] {
                if row != Row::Unseen {
                    observed.observe(&shown(row), 2, 2);
                    whole.observe(&shown(row), 2, 2);
                }
            }
            first.merge(&second);
            assert_eq!(first.rows, whole.rows);
        }
    }

    #[test]
    fn derivative_states_lead_to_free_states() {
        use Row::{Other, Unit};
        // y₀' = y₁, y₁' = y₂, y₃' = y₁, and y₄' = y₄ is its own derivative.
        let found = reduction(&[Unit(1), Unit(2), Other, Unit(1), Unit(4)]);
        assert_eq!(found.free, [2, 4]);
        assert_eq!(found.sources, [(1, 2), (3, 1), (0, 1)]);
        assert_eq!(found.highest, [(0, 2), (0, 1), (0, 0), (0, 2), (1, 0)]);
    }

    #[test]
    fn cycles_and_orders_above_the_highest_are_cut() {
        use Row::{Other, Unit};
        let cycle = reduction(&[Unit(1), Unit(0)]);
        assert_eq!((cycle.free, cycle.sources), (vec![0], vec![(1, 0)]));
        let high: Vec<Row> = (1..8).map(Unit).chain([Other]).collect();
        let high = reduction(&high);
        assert!(high.highest.iter().all(|(_, order)| *order < POWERS));
        assert_eq!(high.free.len() + high.sources.len(), 8);
    }
}
