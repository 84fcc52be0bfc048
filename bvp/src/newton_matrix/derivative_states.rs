//! States whose derivative is another state.
//!
//! An equation of order two or more becomes a system by y' = z, z' = …: rows of the Jacobian that are
//! unit vectors. On an interval the slopes of such a state, `K = h A K_source + known`, follow from those
//! of its source, so that only those of the other, *free* states are unknown: the system for the slopes
//! is as small as if the equation were collocated in its own form, and its solution is the same. The
//! stages see y⁽ᵈ⁾ through h^(d+1) A^(d+1), the Runge-Kutta-Nyström form of the scheme (Hairer, Nørsett &
//! Wanner, *Solving Ordinary Differential Equations I*, section II.14).

use crate::discretisation::tableau::POWERS;
use std::ops::Range;

/// What the rows of the Jacobian of a segment have shown so far of one component.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Row {
    /// Nothing yet.
    Unseen,
    /// Unit vectors with the one in this column.
    Unit(usize),
    /// Something else.
    Other,
}

/// Watches Jacobians for rows that are the same unit vector at all stages of a segment.
#[derive(Clone, Debug)]
pub(crate) struct Watch {
    rows: Vec<Row>,
}

impl Watch {
    /// For n states.
    pub(crate) fn new(n: usize) -> Self {
        Self {
            rows: vec![Row::Unseen; n],
        }
    }

    /// Forgets what was seen.
    pub(crate) fn restart(&mut self) {
        self.rows.fill(Row::Unseen);
    }

    /// Sees what another watch of the same segment has seen elsewhere.
    pub(crate) fn learn(&mut self, other: &Self) {
        for (seen, other) in self.rows.iter_mut().zip(&other.rows) {
            *seen = match (*seen, *other) {
                (Row::Unseen, one) | (one, Row::Unseen) => one,
                (one, other) if one == other => one,
                _ => Row::Other,
            };
        }
    }

    /// Looks at the Jacobians of any number of stages, one after the other, a row per state; a row may go
    /// on with derivatives with respect to parameters.
    #[inline(always)]
    pub(crate) fn look(&mut self, jacobians: &[f64], n: usize, columns: usize) {
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

/// The free and the chained states of a segment.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chains {
    /// The rows that they follow from.
    rows: Vec<Row>,
    /// The free states.
    pub(crate) free: Vec<usize>,
    /// Each chained state and its source, a source before what is chained to it.
    pub(crate) chained: Vec<(usize, usize)>,
    /// For every state the place among the free ones of that which its chain ends at, and how many
    /// links are between.
    pub(crate) ends: Vec<(usize, usize)>,
    /// For every place the states whose chains end there, with the numbers of links: a part of `members`.
    pub(crate) groups: Vec<Range<usize>>,
    pub(crate) members: Vec<(usize, usize)>,
}

impl Chains {
    /// Brings the chains up to what a watch has seen; returns whether that is anything new.
    pub(crate) fn update(&mut self, watch: &Watch) -> bool {
        if self.rows == watch.rows {
            return false;
        }
        let n = watch.rows.len();
        *self = Self {
            rows: watch.rows.clone(),
            ..Self::default()
        };
        let mut place = vec![None; n];
        for (c, (place, row)) in place.iter_mut().zip(&watch.rows).enumerate() {
            if !matches!(row, Row::Unit(source) if *source != c) {
                *place = Some((self.free.len(), 0));
                self.free.push(c);
            }
        }
        // What is chained to a state with a place has one, too; where nothing is, chains are closed or
        // too long, and are cut.
        while let Some(cut) = place.iter().position(Option::is_none) {
            let before = self.chained.len();
            for c in 0..n {
                if let (None, Row::Unit(source)) = (place[c], watch.rows[c])
                    && let Some((end, links)) = place[source]
                    && links + 1 < POWERS
                {
                    place[c] = Some((end, links + 1));
                    self.chained.push((c, source));
                }
            }
            if self.chained.len() == before {
                place[cut] = Some((self.free.len(), 0));
                self.free.push(cut);
            }
        }
        self.ends = place.into_iter().flatten().collect();
        for place in 0..self.free.len() {
            let first = self.members.len();
            let ends = self.ends.iter().enumerate();
            let ending = ends.filter(|(_, (end, _))| *end == place);
            self.members
                .extend(ending.map(|(c, &(_, links))| (c, links)));
            self.groups.push(first..self.members.len());
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chains(rows: &[Row]) -> Chains {
        let watch = Watch {
            rows: rows.to_vec(),
        };
        let mut chains = Chains::default();
        assert!(chains.update(&watch));
        assert!(!chains.update(&watch));
        assert_eq!(chains.free.len() + chains.chained.len(), rows.len());
        chains
    }

    #[test]
    fn equal_unit_rows_of_all_stages_are_seen() {
        let mut watch = Watch::new(3);
        watch.look(
            &[0.0, 1.0, 0.0, 9.0, 0.0, 0.0, 1.0, 9.0, 1.0, 1.0, 0.0, 9.0],
            3,
            4,
        );
        assert_eq!(watch.rows, [Row::Unit(1), Row::Unit(2), Row::Other]);
        watch.look(
            &[0.0, 1.0, 0.0, 8.0, 0.0, 1.0, 0.0, 8.0, 1.0, 0.0, 0.0, 8.0],
            3,
            4,
        );
        assert_eq!(watch.rows, [Row::Unit(1), Row::Other, Row::Other]);
    }

    #[test]
    fn watches_of_two_parts_see_together_what_one_of_the_whole_sees() {
        let rows = [Row::Unseen, Row::Unit(0), Row::Unit(1), Row::Other];
        // The first of two rows; the second is never a unit vector.
        let shown = |row: Row| match row {
            Row::Unit(0) => [1.0, 0.0, 0.5, 0.5],
            Row::Unit(_) => [0.0, 1.0, 0.5, 0.5],
            _ => [0.5; 4],
        };
        for (one, other) in rows.iter().flat_map(|a| rows.map(|b| (*a, b))) {
            let [mut first, mut second, mut whole] = [(); 3].map(|()| Watch::new(2));
            for (watch, row) in [(&mut first, one), (&mut second, other)] {
                if row != Row::Unseen {
                    watch.look(&shown(row), 2, 2);
                    whole.look(&shown(row), 2, 2);
                }
            }
            first.learn(&second);
            assert_eq!(first.rows, whole.rows);
        }
    }

    #[test]
    fn chains_end_at_free_states() {
        use Row::{Other, Unit};
        // y₀' = y₁, y₁' = y₂, y₃' = y₁, and y₄' = y₄ is no chain.
        let found = chains(&[Unit(1), Unit(2), Other, Unit(1), Unit(4)]);
        assert_eq!(found.free, [2, 4]);
        assert_eq!(found.chained, [(1, 2), (3, 1), (0, 1)]);
        assert_eq!(found.ends, [(0, 2), (0, 1), (0, 0), (0, 2), (1, 0)]);
    }

    #[test]
    fn closed_and_long_chains_are_cut() {
        use Row::{Other, Unit};
        let closed = chains(&[Unit(1), Unit(0)]);
        assert_eq!((closed.free, closed.chained), (vec![0], vec![(1, 0)]));
        let long: Vec<Row> = (1..8).map(Unit).chain([Other]).collect();
        let long = chains(&long);
        assert!(long.ends.iter().all(|(_, links)| *links < POWERS));
        assert_eq!(long.free.len() + long.chained.len(), 8);
    }
}
