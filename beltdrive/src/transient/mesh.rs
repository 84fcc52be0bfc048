//! The mesh of the loop: uniform cells along every arc and every span, with faces on the tangent points.

use std::ops::Range;

/// A pulley and the span behind it, in the order in which the belt passes them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stretch {
    /// Length R φ of the arc, m; positive.
    pub(crate) arc: f64,
    /// Cells of the arc, at least [`LEAST_ARC_CELLS`].
    pub(crate) arc_cells: usize,
    /// Length of the span that leaves the pulley, m; positive.
    pub(crate) span: f64,
    /// Cells of the span, at least [`LEAST_SPAN_CELLS`].
    pub(crate) span_cells: usize,
}

/// Fewest cells of an arc: the one-sided difference at its end takes four.
pub(crate) const LEAST_ARC_CELLS: usize = 4;

/// Fewest cells of a span: its tension in the middle is that of the face between two.
pub(crate) const LEAST_SPAN_CELLS: usize = 2;

/// The cells of a loop; face i lies between the cells i − 1 and i, the last cell meets the first.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mesh {
    /// Length of each cell, m.
    pub(crate) lengths: Vec<f64>,
    /// Cells of the arcs, by pulley.
    pub(crate) arcs: Vec<Range<usize>>,
    /// Places of the same cells among those of all arcs.
    pub(crate) bristles: Vec<Range<usize>>,
    /// Cells of the spans; span i leaves pulley i.
    pub(crate) spans: Vec<Range<usize>>,
}

impl Mesh {
    /// The mesh of a loop.
    pub(crate) fn new(stretches: &[Stretch]) -> Self {
        let mut mesh = Self {
            lengths: vec![],
            arcs: vec![],
            bristles: vec![],
            spans: vec![],
        };
        let mut bristles = 0;
        for stretch in stretches {
            let arc = mesh.append(stretch.arc, stretch.arc_cells);
            mesh.arcs.push(arc);
            mesh.bristles.push(bristles..bristles + stretch.arc_cells);
            bristles += stretch.arc_cells;
            let span = mesh.append(stretch.span, stretch.span_cells);
            mesh.spans.push(span);
        }
        mesh
    }

    fn append(&mut self, length: f64, cells: usize) -> Range<usize> {
        let first = self.lengths.len();
        let cell = length / cells as f64;
        self.lengths.extend((0..cells).map(|_| cell));
        first..self.lengths.len()
    }

    /// The same loop with so many cells in place of each.
    pub(crate) fn refined(&self, by: usize) -> Self {
        let part = |cells: &Range<usize>| cells.len() as f64 * self.lengths[cells.start];
        let pulleys = self.arcs.iter().zip(&self.spans);
        let stretches = pulleys.map(|(arc, span)| Stretch {
            arc: part(arc),
            arc_cells: by * arc.len(),
            span: part(span),
            span_cells: by * span.len(),
        });
        Self::new(&stretches.collect::<Vec<_>>())
    }

    /// Shares of the cells behind and before each face in what is interpolated to it from their middles.
    pub(crate) fn shares(&self) -> Vec<[f64; 2]> {
        let cells = self.cells();
        let share = |face: usize| {
            let [behind, before] =
                [(face + cells - 1) % cells, face].map(|cell| self.lengths[cell]);
            [before, behind].map(|other| other / (behind + before))
        };
        (0..cells).map(share).collect()
    }

    /// Number of cells.
    pub(crate) fn cells(&self) -> usize {
        self.lengths.len()
    }

    /// Number of cells of all arcs.
    pub(crate) fn bristle_cells(&self) -> usize {
        self.bristles.last().map_or(0, |last| last.end)
    }

    /// Length of the loop, m.
    pub(crate) fn length(&self) -> f64 {
        self.lengths.iter().sum()
    }

    /// Length of the shortest cell, m.
    pub(crate) fn shortest(&self) -> f64 {
        self.lengths.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Coordinate of the middle of each cell, from where the belt meets the first pulley, m.
    pub(crate) fn middles(&self) -> impl Iterator<Item = f64> {
        self.lengths.iter().scan(0.0, |passed, &length| {
            let middle = *passed + 0.5 * length;
            *passed += length;
            Some(middle)
        })
    }
}

/// The stretches of a loop with about `cells` cells in all, as even as whole numbers and the fewest cells of a part
/// allow; `parts` are the lengths of arc and span of each pulley, m.
pub(crate) fn even(parts: &[[f64; 2]], cells: usize) -> Vec<Stretch> {
    let length: f64 = parts.iter().flatten().sum();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a share of the number of cells"
    )]
    let count = |part: f64, least: usize| {
        let share = (part / length * cells as f64).round() as usize;
        share.max(least)
    };
    let stretches = parts.iter().map(|&[arc, span]| Stretch {
        arc,
        arc_cells: count(arc, LEAST_ARC_CELLS),
        span,
        span_cells: count(span, LEAST_SPAN_CELLS),
    });
    stretches.collect()
}
