//! The layout on the sheet: where everything is but the labels.

use super::super::occupied::{Frame, Occupied, Place, Shape};
use super::super::sheet::{MARGIN, Spot, spot};
use super::model::{Loop, Point, Pulley, Tensioner};

/// Room for labels round the loop, as parts of the width of the sheet, and for the scales below it, px.
const SIDE: f64 = 0.17;
const ABOVE: f64 = 0.11;
pub(super) const SCALES: f64 = 64.0;

/// The largest height of the loop over the width of the sheet.
const TALLEST: f64 = 0.55;

/// Width of the belt, px.
pub(super) const BELT: f64 = 4.0;

/// How far an arrowhead reaches ahead of its place, behind it, and to each side, px.
pub(super) const ARROWHEAD: [f64; 3] = [9.0, 5.0, 6.0];

/// Length of the largest hub load, px.
pub(super) const LOAD: f64 = 80.0;

/// Labels keep this distance from discs and lines, px.
const ROOM: f64 = 3.0;

/// Where the arrowhead of a span is if it has no place of its own, as a part of the span: off the middle, where
/// that of another span beside it would be.
const USUAL: f64 = 0.4;

/// The sense of rotation is drawn on pulleys from this radius on, px.
const ROOMY: f64 = 18.0;

/// Radius of the pivot of an arm, and how far the guide of a slide reaches beyond its pulley, px.
pub(super) const PIVOT: f64 = 5.0;
const BEYOND: f64 = 34.0;

/// A penetration is invisible below these px, or below this part of the radius.
const VISIBLE: f64 = 4.0;
const VISIBLE_PART: f64 = 0.1;

/// The largest displacement of a span across is shown by so many px, or by a round factor up to 2.5 times as many: half a wave
/// of it is then seen beside the width of the belt.
const SWING: f64 = 8.0;

/// A loop on the sheet.
pub(super) struct View<'a> {
    pub(super) drawn: &'a Loop,
    /// Scale, px/m.
    pub(super) scale: f64,
    /// Where the origin of the plane is.
    origin: Spot,
    /// Width and height of the sheet, px.
    pub(super) size: Spot,
    /// Where the loop with its labels may be.
    pub(super) frame: Frame,
    /// By how much displacements of the spans across are exaggerated.
    pub(super) sway: f64,
    /// By how much penetrations are exaggerated.
    pub(super) exaggeration: f64,
    /// The middles of the arrowheads on spans that are long enough.
    pub(super) arrowheads: Vec<Option<Spot>>,
    /// Length of a unit of force, px/N.
    pub(super) force: f64,
}

impl<'a> View<'a> {
    /// The view of a loop on a sheet of a width, below a header of a height, px.
    pub(super) fn of(drawn: &'a Loop, header: f64, width: f64) -> Self {
        let pivot = drawn.tensioner.iter().filter_map(|found| found.pivot);
        let discs = drawn
            .pulleys
            .iter()
            .map(|pulley| (pulley.centre, pulley.radius));
        let ends = [f64::INFINITY, f64::NEG_INFINITY].map(|end| Point::new(end, end));
        let [low, high] = { discs.chain(pivot.map(|pivot| (pivot, 0.0))) }.fold(
            ends,
            |[low, high], (centre, radius)| {
                [
                    low.inf(&centre.add_scalar(-radius)),
                    high.sup(&centre.add_scalar(radius)),
                ]
            },
        );
        let extent = high - low;
        let room = width * (1.0 - 2.0 * SIDE);
        let scale = (room / extent.x).min(TALLEST * width / extent.y);
        let top = header + ABOVE * width;
        let bottom = top + scale * extent.y + ABOVE * width;
        let most = |of: &dyn Fn(&Pulley) -> f64| drawn.pulleys.iter().map(of).fold(0.0, f64::max);
        let penetration = most(&|pulley| pulley.penetration);
        let largest = most(&|pulley| {
            let loads = pulley.hub_loads.iter().flatten();
            loads.map(|load| load.norm()).fold(0.0, f64::max)
        });
        let radii = drawn.pulleys.iter().map(|pulley| pulley.radius);
        let smallest = radii.fold(f64::INFINITY, f64::min);
        let mut view = Self {
            drawn,
            scale,
            origin: spot(
                0.5 * width - 0.5 * scale * (low.x + high.x),
                top + scale * high.y,
            ),
            size: spot(width, (bottom + SCALES).ceil()),
            frame: Frame {
                from: spot(MARGIN, header),
                to: spot(width - MARGIN, bottom),
            },
            sway: exaggeration(drawn.displacement, SWING / scale),
            exaggeration: exaggeration(penetration, (VISIBLE / scale).min(VISIBLE_PART * smallest)),
            arrowheads: vec![],
            force: if largest > 0.0 { LOAD / largest } else { 0.0 },
        };
        view.arrowheads = view.place_arrowheads();
        view
    }

    /// The place of a point.
    pub(super) fn at(&self, point: Point) -> Spot {
        self.origin + self.scale * spot(point.x, -point.y)
    }

    /// A span from its beginning to its end.
    pub(super) fn span(&self, index: usize) -> [Spot; 2] {
        self.drawn.span(index).map(|end| self.at(end))
    }

    /// A force on the hub of a pulley, from the centre to the tip of its arrow.
    pub(super) fn hub_load(&self, pulley: &Pulley, load: Point) -> [Spot; 2] {
        let centre = self.at(pulley.centre);
        [centre, centre + self.force * spot(load.x, -load.y)]
    }

    /// From the pivot of an arm to the axis, or along the guide of a slide in the positive direction.
    pub(super) fn guide(&self, tensioner: &Tensioner) -> [Spot; 2] {
        let pulley = &self.drawn.pulleys[tensioner.pulley];
        let axis = self.at(pulley.centre);
        let along = spot(tensioner.direction.x, -tensioner.direction.y);
        let reach = (self.scale * pulley.radius + BEYOND) * along;
        match tensioner.pivot {
            Some(pivot) => [self.at(pivot), axis],
            None => [axis - reach, axis + reach],
        }
    }

    /// What the label of a tensioner belongs to.
    pub(super) fn anchor(&self, tensioner: &Tensioner) -> Spot {
        self.guide(tensioner)[usize::from(tensioner.pivot.is_none())]
    }

    fn place_arrowheads(&self) -> Vec<Option<Spot>> {
        let [ahead, behind, beside] = ARROWHEAD;
        let half = ahead.max(beside) + ROOM;
        let mut occupied = Occupied {
            sheet: self.frame,
            shapes: self.discs().collect(),
        };
        let spans = 0..self.drawn.pulleys.len();
        let arrowheads = spans.clone().map(|index| {
            let [start, end] = self.span(index);
            if (end - start).norm() < 2.0 * (ahead + behind) {
                return None;
            }
            let others = spans.clone().filter(|other| *other != index);
            let mut around = occupied.clone();
            let lines = others.map(|other| self.span_line(other));
            around.shapes.extend(lines);
            let places = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8].map(|part: f64| Place {
                frame: Frame::around(start + part * (end - start), spot(half, half)),
                leader: None,
                cost: (part - 0.5).abs(),
            });
            let place = around.place(places.into_iter());
            let covered = place.map(|place| Shape::Box(place.frame));
            occupied.shapes.extend(covered);
            let usual = start + USUAL * (end - start);
            Some(place.map_or(usual, |place| place.frame.middle()))
        });
        arrowheads.collect()
    }

    fn discs(&self) -> impl Iterator<Item = Shape> {
        self.drawn.pulleys.iter().map(|pulley| {
            let radius = self.scale * pulley.radius + 0.5 * BELT + ROOM;
            Shape::Disc(self.at(pulley.centre), radius)
        })
    }

    fn span_line(&self, index: usize) -> Shape {
        let swing = self.scale * self.sway * self.drawn.displacement;
        Shape::Line(self.span(index), 0.5 * BELT + ROOM + swing)
    }

    /// Everything that labels may not cover.
    pub(super) fn shapes(&self) -> Vec<Shape> {
        let [ahead, _, beside] = ARROWHEAD;
        let arrowheads = self.arrowheads.iter().flatten();
        let arrowheads = arrowheads.map(|at| Shape::Disc(*at, ahead.max(beside) + ROOM));
        let spans = (0..self.drawn.pulleys.len()).map(|index| self.span_line(index));
        let loads = self.drawn.pulleys.iter().flat_map(|pulley| {
            let halves = [beside, 1.0].into_iter().zip(pulley.hub_loads);
            let loads = halves.filter_map(|(half, load)| Some((half, load?)));
            loads.map(|(half, load)| Shape::Line(self.hub_load(pulley, load), half + ROOM))
        });
        let tensioner = self.drawn.tensioner.iter().flat_map(|tensioner| {
            let radius = self.scale * self.drawn.pulleys[tensioner.pulley].radius + 1.0;
            [
                Shape::Line(self.guide(tensioner), 2.0 + ROOM),
                Shape::Disc(self.anchor(tensioner), PIVOT + ROOM),
                Shape::Disc(self.at(tensioner.rest), radius),
            ]
        });
        let shapes = self.discs().chain(spans).chain(arrowheads);
        shapes.chain(loads).chain(tensioner).collect()
    }

    /// Whether there is room for an arrow in the sense of rotation of a pulley.
    pub(super) fn shows_rotation(&self, index: usize) -> bool {
        self.scale * self.drawn.pulleys[index].radius >= ROOMY
    }

    /// The direction from a span to the outside of the loop, on the sheet.
    pub(super) fn outward(&self, index: usize) -> Spot {
        let [start, end] = self.span(index);
        let along = (end - start).normalize();
        self.drawn.sense * spot(-along.y, along.x)
    }
}

/// By how much a penetration or a displacement is exaggerated: by the smallest round factor that makes it visible, or 1 where there
/// is none.
pub(super) fn exaggeration(penetration: f64, visible: f64) -> f64 {
    let round = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0];
    let mut enough = round.into_iter().filter(|x| x * penetration >= visible);
    enough.next().unwrap_or(1.0)
}
