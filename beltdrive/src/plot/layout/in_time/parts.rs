//! The parts of a loop and the cells of the belt on them.

use crate::transient::{BeltAlongLoop, History};
use std::ops::Range;

/// Pieces of the belt, each of one colour: a piece of a loop that fills the sheet is then some 20 px long, and an animation of
/// 200 frames takes 200 kB for their colours.
const PIECES: f64 = 100.0;

/// A part of the loop, with the cells of the belt on it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Part {
    /// The pulley of an arc, or that which a span leaves.
    pub(super) pulley: usize,
    pub(super) is_span: bool,
    pub(super) cells: Range<usize>,
    /// Share of the length of the loop.
    share: f64,
}

/// The parts of a loop in belt order, an arc and the span behind it in turn, with the cells of the belt on them.
pub(super) fn parts(history: &History) -> Vec<Part> {
    let layout = &history.layout;
    let count = history.belts.iter().chain(&history.frames).next();
    let count = count.map_or(0, |belt| belt.position.len());
    let next = { history.arcs.iter().skip(1) }.map(|arc| arc.start);
    let ends = next.chain([count]);
    let arcs = history.arcs.iter().zip(ends).enumerate();
    let parts = arcs.flat_map(|(pulley, (arc, end))| {
        let on_pulley = layout.pulleys()[pulley].radius * layout.wraps()[pulley];
        let part = |is_span, cells, length: f64| Part {
            pulley,
            is_span,
            cells,
            share: length / layout.length(),
        };
        [
            part(false, arc.clone(), on_pulley),
            part(true, arc.end..end, layout.spans()[pulley].length),
        ]
    });
    parts.collect()
}

impl Part {
    /// Its cells in pieces of about one length on the whole loop.
    pub(super) fn pieces(&self) -> impl Iterator<Item = Range<usize>> {
        let cells = self.cells.len();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share of the number of pieces"
        )]
        let wanted = (PIECES * self.share).round() as usize;
        let count = wanted.clamp(1, cells.max(1));
        let first = self.cells.start;
        (0..count)
            .map(move |piece| first + piece * cells / count..first + (piece + 1) * cells / count)
    }

    /// How far along the part the beginning of a cell is, 0 to 1.
    pub(super) fn along(&self, cell: usize) -> f64 {
        (cell - self.cells.start) as f64 / self.cells.len().max(1) as f64
    }
}

/// Mean tension of some cells of a belt, N.
pub(super) fn mean_tension(belt: &BeltAlongLoop, cells: &Range<usize>) -> f64 {
    let tensions = &belt.tension[cells.clone()];
    tensions.iter().sum::<f64>() / tensions.len().max(1) as f64
}
