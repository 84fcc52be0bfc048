//! A panel of a figure: axes with a grid under a title, and what is drawn into it.

use super::axis::Axis;
use super::header::TINT;
use super::occupied::Frame;
use super::sheet::{Anchor, BODY, Color, INK, MARGIN, SMALL, Sheet, Spot, Stroke, cut, spot};

/// Room round the axes: for the title above, for ticks and descriptions to the left and below, px.
const ABOVE: f64 = 30.0;
const LEFT: f64 = 92.0;
const BELOW: f64 = 56.0;

/// Length of a tick, px.
const TICK: f64 = 5.0;

const FRAME: Stroke = Stroke::solid(INK, 1.0);
const GRID: Stroke = Stroke::solid("#C4C4C4", 0.6);

/// What a panel shows besides its curves.
pub(super) struct Panel {
    /// Written above the panel.
    pub(super) title: String,
    /// The horizontal and the vertical axis.
    pub(super) axes: [Axis; 2],
    /// What the axes measure.
    pub(super) descriptions: [String; 2],
}

/// A shaded part of the horizontal axis.
pub(super) type Shade = ([f64; 2], Color);

/// A panel on a sheet.
pub(super) struct Chart {
    axes: [Axis; 2],
    /// The area between the axes.
    pub(super) frame: Frame,
}

impl Panel {
    /// Draws the panel into a part of a sheet.
    pub(super) fn draw(
        self,
        sheet: &mut Sheet,
        part: Frame,
        shades: impl IntoIterator<Item = Shade>,
    ) -> Chart {
        let frame = Frame {
            from: part.from + spot(LEFT, ABOVE),
            to: part.to - spot(MARGIN, BELOW),
        };
        let chart = Chart {
            axes: self.axes,
            frame,
        };
        let Frame { from, to } = frame;
        let title = cut(&self.title, BODY, to.x - from.x);
        sheet.text(&title, BODY, INK, Anchor::Start, from - spot(0.0, 14.0));
        for ([low, high], color) in shades {
            let [low, high] = [low, high].map(|at| chart.at(at, chart.axes[1].from).x);
            let [low, high] = [low, high].map(|at| at.clamp(from.x, to.x));
            sheet.rectangle([spot(low, from.y), spot(high, to.y)], color, TINT);
        }
        let [across, up] = &chart.axes;
        for tick in across.ticks() {
            let foot = spot(chart.at(tick, up.from).x, to.y);
            sheet.line(&[spot(foot.x, from.y), foot], GRID);
            sheet.line(&[foot, foot + spot(0.0, TICK)], FRAME);
            let below = foot + spot(0.0, 15.0);
            sheet.text(&across.label(tick), SMALL, INK, Anchor::Middle, below);
        }
        for tick in up.ticks() {
            let foot = spot(from.x, chart.at(across.from, tick).y);
            sheet.line(&[foot, spot(to.x, foot.y)], GRID);
            sheet.line(&[foot - spot(TICK, 0.0), foot], FRAME);
            let beside = foot - spot(9.0, 0.0);
            sheet.text(&up.label(tick), SMALL, INK, Anchor::End, beside);
        }
        sheet.line(&[from, spot(from.x, to.y), to], FRAME);
        let [horizontal, vertical] = self.descriptions;
        let size = frame.size();
        let horizontal = cut(&horizontal, BODY, size.x);
        let below = spot(frame.middle().x, to.y + 38.0);
        sheet.text(&horizontal, BODY, INK, Anchor::Middle, below);
        let vertical = cut(&vertical, BODY, size.y + ABOVE + BELOW);
        let beside = spot(from.x - 72.0, frame.middle().y);
        sheet.text(&vertical, BODY, INK, Anchor::Upward, beside);
        chart
    }
}

impl Chart {
    /// Where a point is on the sheet.
    pub(super) fn at(&self, across: f64, up: f64) -> Spot {
        let [x, y] = [self.axes[0].part(across), 1.0 - self.axes[1].part(up)];
        self.frame.from + spot(x, y).component_mul(&self.frame.size())
    }
}

/// Equal parts of a part of a sheet, in rows of so many columns.
pub(super) fn grid(part: Frame, columns: usize, count: usize) -> impl Iterator<Item = Frame> {
    let columns = columns.max(1);
    let rows = count.div_ceil(columns).max(1);
    let size = part
        .size()
        .component_div(&spot(columns as f64, rows as f64));
    (0..count).map(move |index| {
        let place = spot((index % columns) as f64, (index / columns) as f64);
        let from = part.from + place.component_mul(&size);
        Frame {
            from,
            to: from + size,
        }
    })
}
