//! The form in which the solver sees the segments of a problem: pieces on ascending intervals.
//!
//! A joined point divides its segment into two pieces with continuity conditions between them. On a
//! segment that runs from larger to smaller s the variable of its pieces is t = −s, so that they
//! ascend:
//!
//! ```text
//! dy/dt = −f(−t, y, p),    −from ≤ t ≤ −to
//! ```

use crate::problem::problem::Segment;

/// The pieces of the segments of a problem.
#[derive(Clone, Debug)]
pub(crate) struct Pieces {
    /// The segments as stated.
    stated: Vec<Segment>,
    /// All pieces in turn, without joined points, ascending.
    pieces: Vec<Segment>,
    /// What becomes of each piece.
    origins: Vec<Origin>,
    /// Whether every segment is its own piece.
    plain: bool,
}

/// Where a piece comes from.
#[derive(Clone, Copy, Debug)]
struct Origin {
    /// Index of the segment.
    segment: usize,
    /// Whether the variable is −s.
    reversed: bool,
    /// The interval of the variable in which right-hand sides are evaluated: at a joined point, where
    /// they may jump, only places inside the piece.
    inside: [f64; 2],
}

impl Pieces {
    pub(crate) fn new(stated: Vec<Segment>) -> Self {
        let (mut pieces, mut origins) = (vec![], vec![]);
        for (segment, shape) in stated.iter().enumerate() {
            let reversed = shape.is_reversed();
            let sign = sign(reversed);
            let inner = shape.joined.iter().copied();
            let last = shape.joined.len();
            let mut from = sign * shape.from;
            for (i, to) in inner.chain([shape.to]).enumerate() {
                let to = sign * to;
                pieces.push(Segment::on(shape.states, from, to));
                let inside = [
                    if i > 0 { from.next_up() } else { from },
                    if i < last { to.next_down() } else { to },
                ];
                origins.push(Origin {
                    segment,
                    reversed,
                    inside,
                });
                from = to;
            }
        }
        let plain = pieces == stated;
        Self {
            stated,
            pieces,
            origins,
            plain,
        }
    }

    /// The segments as stated.
    pub(crate) fn stated(&self) -> &[Segment] {
        &self.stated
    }

    /// All pieces in turn.
    pub(crate) fn all(&self) -> &[Segment] {
        &self.pieces
    }

    /// Whether every segment is its own piece.
    pub(crate) fn are_plain(&self) -> bool {
        self.plain
    }

    /// Number of conditions of continuity.
    pub(crate) fn continuity(&self) -> usize {
        let points = |segment: &Segment| segment.states * segment.joined.len();
        self.stated.iter().map(points).sum()
    }

    /// The pieces of a segment.
    pub(crate) fn of(&self, segment: usize) -> std::ops::Range<usize> {
        let count = |segment: &Segment| segment.joined.len() + 1;
        let first = self.stated[..segment].iter().map(count).sum();
        first..first + count(&self.stated[segment])
    }

    /// The segment of a piece, and ds/dt = ±1 on it.
    pub(crate) fn origin(&self, piece: usize) -> (usize, f64) {
        let origin = self.origins[piece];
        (origin.segment, sign(origin.reversed))
    }

    /// The segment of a piece, s where its variable is t, and ds/dt = ±1.
    #[inline]
    pub(crate) fn place(&self, piece: usize, t: f64) -> (usize, f64, f64) {
        let Origin {
            segment,
            reversed,
            inside: [from, to],
        } = self.origins[piece];
        let sign = sign(reversed);
        (segment, sign * t.max(from).min(to), sign)
    }

    /// The mesh of the pieces that has the nodes of a mesh of the segments, and the joined points.
    pub(crate) fn divide(&self, mesh: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
        if self.plain {
            return mesh;
        }
        let nodes = |(piece, origin): (&Segment, &Origin)| {
            let sign = sign(origin.reversed);
            let all = mesh[origin.segment].iter().map(|s| sign * s);
            let inner = all.filter(|t| piece.from < *t && *t < piece.to);
            let from_start = [piece.from].into_iter().chain(inner);
            from_start.chain([piece.to]).collect()
        };
        self.pieces.iter().zip(&self.origins).map(nodes).collect()
    }
}

fn sign(reversed: bool) -> f64 {
    if reversed { -1.0 } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_ascend_and_meshes_are_divided_among_them() {
        let stated = vec![
            Segment::new(1),
            Segment::on(2, 3.0, -1.0).joined(&[1.0, 0.0]),
        ];
        let pieces = Pieces::new(stated);
        let ends: Vec<[f64; 2]> = pieces.all().iter().map(|p| [p.from, p.to]).collect();
        assert_eq!(ends, [[0.0, 1.0], [-3.0, -1.0], [-1.0, 0.0], [0.0, 1.0]]);
        assert_eq!((pieces.of(1), pieces.continuity()), (1..4, 4));
        assert_eq!(pieces.place(1, -2.0), (1, 2.0, -1.0));
        let (_, before, _) = pieces.place(1, -1.0);
        let (_, behind, _) = pieces.place(2, -1.0);
        assert!(before > 1.0 && behind < 1.0 && before - behind < 1e-15);
        let mesh = pieces.divide(vec![vec![0.0, 0.5, 1.0], vec![3.0, 2.0, 1.0, -0.5, -1.0]]);
        assert_eq!(
            mesh,
            [
                vec![0.0, 0.5, 1.0],
                vec![-3.0, -2.0, -1.0],
                vec![-1.0, 0.0],
                vec![0.0, 0.5, 1.0]
            ]
        );
    }
}
