//! The loop on the sheet: where everything is but the labels.

use super::super::geometry::{Circle, Point, circles};
use super::super::header::Header;
use super::super::occupied::{Frame, Occupied, Place, Shape, Spot};
use super::super::plan::{ARROWHEAD, BELT, Plan};
use super::super::style;
use super::profiles::interpolated;
use crate::belt_loop::{BeltLoop, Guide, LoopState};
use crate::{Profile, Zone};

/// Room for labels round the loop, as parts of the width of the sheet, and for the scales below it, px.
const SIDE: f64 = 0.17;
const ABOVE: f64 = 0.11;
pub(super) const SCALES: f64 = 64.0;

/// The largest height of the loop over the width of the sheet.
const TALLEST: f64 = 0.55;

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

/// A loop on the sheet.
pub(super) struct View<'a> {
    pub(super) belt_loop: &'a BeltLoop,
    pub(super) state: &'a LoopState,
    pub(super) profiles: Vec<Profile>,
    pub(super) plan: Plan,
    /// Width and height of the sheet, px.
    pub(super) size: [f64; 2],
    /// Where the loop with its labels may be.
    pub(super) frame: Frame,
    /// By how much penetrations are exaggerated.
    pub(super) exaggeration: f64,
    pub(super) circles: Vec<Circle>,
    /// The middles of the arrowheads on spans that are long enough.
    pub(super) arrowheads: Vec<Option<Point>>,
    pub(super) tensioner: Option<TensionerView>,
    /// Length of a unit of force, px/N.
    force: f64,
}

/// A tensioner on the sheet.
pub(super) struct TensionerView {
    /// From the pivot of the arm to the axis, or along the guide in the positive direction.
    pub(super) line: [Point; 2],
    /// The axis at rest.
    pub(super) rest: Point,
    /// Whether it is an arm.
    pub(super) is_arm: bool,
    /// What its label belongs to.
    pub(super) anchor: Point,
}

impl<'a> View<'a> {
    /// The view of a loop on a sheet of a width in px.
    pub(super) fn of(
        belt_loop: &'a BeltLoop,
        state: &'a LoopState,
        header: &Header,
        width: f64,
    ) -> Self {
        let circles = circles(belt_loop, state);
        let pivot = belt_loop
            .tensioner()
            .and_then(|(_, tensioner)| match tensioner.guide {
                Guide::Rotary { pivot, .. } => Some(Point::from(pivot)),
                Guide::Translating { .. } => None,
            });
        let [mut low, mut high] =
            [f64::INFINITY, f64::NEG_INFINITY].map(|end| Point::new(end, end));
        let discs = circles.iter().map(|circle| (circle.centre, circle.radius));
        for (centre, radius) in discs.chain(pivot.map(|pivot| (pivot, 0.0))) {
            low = low.inf(&centre.add_scalar(-radius));
            high = high.sup(&centre.add_scalar(radius));
        }
        let extent = high - low;
        let room = width * (1.0 - 2.0 * SIDE);
        let scale = (room / extent.x).min(TALLEST * width / extent.y);
        let top = header.height(width) + ABOVE * width;
        let bottom = top + scale * extent.y + ABOVE * width;
        let plan = Plan {
            scale,
            origin: [
                0.5 * width - 0.5 * scale * (low.x + high.x),
                top + scale * high.y,
            ],
        };
        let profiles = (0..circles.len())
            .map(|index| state.profile(index))
            .collect();
        let grooves = state
            .pulleys
            .iter()
            .filter_map(|pulley| pulley.groove.as_ref());
        let penetration = grooves
            .map(|groove| groove.max_penetration)
            .fold(0.0, f64::max);
        let smallest = circles
            .iter()
            .map(|circle| circle.radius)
            .fold(f64::INFINITY, f64::min);
        let loads = state.pulleys.iter();
        let loads = loads.flat_map(|pulley| [pulley.hub_load, pulley.rest_hub_load]);
        let largest = loads.map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
        let mut view = Self {
            belt_loop,
            state,
            profiles,
            plan,
            size: [width, (bottom + SCALES).ceil()],
            frame: Frame {
                from: [style::MARGIN, header.height(width)],
                to: [width - style::MARGIN, bottom],
            },
            exaggeration: plan.exaggeration(penetration, smallest),
            arrowheads: vec![],
            tensioner: None,
            force: if largest > 0.0 { LOAD / largest } else { 0.0 },
            circles,
        };
        view.tensioner = view.tensioner_view();
        view.arrowheads = view.place_arrowheads();
        view
    }

    fn tensioner_view(&self) -> Option<TensionerView> {
        let ((index, tensioner), found) = self
            .belt_loop
            .tensioner()
            .zip(self.state.tensioner.as_ref())?;
        let [axis, along, _] = tensioner.guide.centre(found.coordinate).map(Point::from);
        let rest = Point::from(tensioner.guide.centre(found.rest_coordinate)[0]);
        let (is_arm, line, anchor) = match tensioner.guide {
            Guide::Rotary { pivot, .. } => (true, [pivot.into(), axis], pivot.into()),
            Guide::Translating { .. } => {
                let reach = (self.circles[index].radius + BEYOND / self.plan.scale) * along;
                (false, [axis - reach, axis + reach], axis + reach)
            }
        };
        Some(TensionerView {
            line,
            rest,
            is_arm,
            anchor,
        })
    }

    /// A span from its beginning to its end.
    pub(super) fn span(&self, index: usize) -> [Point; 2] {
        let next = (index + 1) % self.circles.len();
        [self.circles[index].exit(), self.circles[next].entry()]
    }

    /// The belt on a pulley as swept angles, rad, and points.
    pub(super) fn contact(&self, index: usize) -> Vec<(f64, Point)> {
        let (profile, circle) = (&self.profiles[index], &self.circles[index]);
        let zones = self.state.pulleys[index].zones.iter();
        let angles = zones.flat_map(|zone: &Zone| {
            let (from, to) = (zone.from, zone.to);
            (0..=60).map(move |step| from + (to - from) * f64::from(step) / 60.0)
        });
        let point = |angle| {
            let penetration = interpolated(&profile.angle, &profile.penetration, angle);
            circle.point(angle, self.exaggeration * penetration)
        };
        angles.map(|angle| (angle, point(angle))).collect()
    }

    /// The hub load of a pulley, running or at rest, from the centre to the tip of its arrow.
    pub(super) fn hub_load(&self, index: usize, load: [f64; 2]) -> [Point; 2] {
        let centre = self.circles[index].centre;
        [
            centre,
            centre + self.force / self.plan.scale * Point::from(load),
        ]
    }

    /// Length of a force on the sheet, px.
    pub(super) fn length_of(&self, force: f64) -> f64 {
        self.force * force
    }

    fn place_arrowheads(&self) -> Vec<Option<Point>> {
        let [ahead, behind, beside] = ARROWHEAD;
        let half = ahead.max(beside) + ROOM;
        let mut occupied = Occupied {
            sheet: self.frame,
            shapes: self.discs().collect(),
        };
        let spans = 0..self.circles.len();
        spans
            .clone()
            .map(|index| {
                let [start, end] = self.span(index);
                if self.plan.scale * (end - start).norm() < 2.0 * (ahead + behind) {
                    return None;
                }
                let others = spans.clone().filter(|other| *other != index);
                let mut around = occupied.clone();
                around
                    .shapes
                    .extend(others.map(|other| self.span_line(other)));
                let places = [0.5, 0.4, 0.6, 0.3, 0.7, 0.2, 0.8].map(|part: f64| Place {
                    frame: Frame::around(
                        self.plan.position(start + part * (end - start)),
                        [half; 2],
                    ),
                    leader: None,
                    cost: (part - 0.5).abs(),
                });
                let usual = start + USUAL * (end - start);
                let place = around.place(places.into_iter());
                occupied
                    .shapes
                    .extend(place.map(|place| Shape::Box(place.frame)));
                let at = place.map(|place| self.plan.point(place.frame.middle()));
                Some(at.unwrap_or(usual))
            })
            .collect()
    }

    fn discs(&self) -> impl Iterator<Item = Shape> {
        self.circles.iter().map(|circle| {
            let radius = self.plan.scale * circle.radius + 0.5 * BELT + ROOM;
            Shape::Disc(self.plan.position(circle.centre), radius)
        })
    }

    fn span_line(&self, index: usize) -> Shape {
        self.line(self.span(index), 0.5 * BELT)
    }

    fn line(&self, ends: [Point; 2], half: f64) -> Shape {
        Shape::Line(ends.map(|end| self.plan.position(end)), half + ROOM)
    }

    /// Everything that labels may not cover.
    pub(super) fn shapes(&self) -> Vec<Shape> {
        let [ahead, _, beside] = ARROWHEAD;
        let arrowheads = self.arrowheads.iter().flatten();
        let arrowheads =
            arrowheads.map(|at| Shape::Disc(self.plan.position(*at), ahead.max(beside) + ROOM));
        let spans = (0..self.circles.len()).map(|index| self.span_line(index));
        let loads = self
            .state
            .pulleys
            .iter()
            .enumerate()
            .flat_map(|(index, pulley)| {
                [(pulley.hub_load, beside), (pulley.rest_hub_load, 1.0)]
                    .map(|(load, half)| self.line(self.hub_load(index, load), half))
            });
        let tensioner = self.tensioner.iter().flat_map(|tensioner| {
            let index = self
                .state
                .tensioner
                .as_ref()
                .map_or(0, |found| found.pulley);
            let radius = self.plan.scale * self.circles[index].radius + 1.0;
            [
                self.line(tensioner.line, 2.0),
                Shape::Disc(self.plan.position(tensioner.anchor), PIVOT + ROOM),
                Shape::Disc(self.plan.position(tensioner.rest), radius),
            ]
        });
        let shapes = self.discs().chain(spans).chain(arrowheads);
        shapes.chain(loads).chain(tensioner).collect()
    }

    /// Whether there is room for an arrow in the sense of rotation of a pulley.
    pub(super) fn shows_rotation(&self, index: usize) -> bool {
        self.plan.scale * self.circles[index].radius >= ROOMY
    }

    /// The direction from a span to the outside of the loop, on the sheet.
    pub(super) fn outward(&self, index: usize) -> Spot {
        let [start, end] = self.span(index);
        let along = (end - start).normalize();
        let out = self.belt_loop.sense.sign() * Point::new(along.y, -along.x);
        [out.x, -out.y]
    }
}
