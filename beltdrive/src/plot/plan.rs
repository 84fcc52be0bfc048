//! A drawing to scale of pulleys and their belt.

use super::geometry::{Circle as Pitch, Point, polar};
use super::style::{self, Canvas, Drawn, Stroke, px};
use crate::Zone;
use plotters::prelude::*;
use std::f64::consts::FRAC_PI_3;

/// A penetration is invisible below so many px, or below this part of the radius.
const VISIBLE: f64 = 4.0;
const VISIBLE_PART: f64 = 0.1;

/// Width of the belt, px.
pub(super) const BELT: f64 = 4.0;
/// The belt off the pulleys.
pub(super) const FREE: Stroke = Stroke::solid(style::INK, BELT);

/// How far an arrowhead reaches ahead of its place, behind it, and to each side, px.
pub(super) const ARROWHEAD: [f64; 3] = [9.0, 5.0, 6.0];

/// Size of the arrowheads of thin lines.
const SLIM: f64 = 0.7;

/// Below this radius of a pulley the arrowhead of its rotation is smaller, px.
const ROOMY: f64 = 48.0;

/// Points of a curve are no closer, px: places on the sheet are rounded to tenths of that, and the joints of
/// a wide line through closer points would be seen.
const CLOSEST: f64 = 1.0;

/// Where the plane of the drive is on the sheet: x to the right, y upwards.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    /// Scale, px per metre.
    pub(super) scale: f64,
    /// Where the origin of the plane is, px.
    pub(super) origin: [f64; 2],
}

impl Plan {
    /// Position on the sheet, px.
    pub(super) fn position(&self, point: Point) -> [f64; 2] {
        [
            self.origin[0] + self.scale * point.x,
            self.origin[1] - self.scale * point.y,
        ]
    }

    /// Position on the sheet in units of the backend.
    pub(super) fn units(&self, point: Point) -> (i32, i32) {
        self.position(point).map(px).into()
    }

    /// The point of the plane at a position on the sheet, px.
    pub(super) fn point(&self, [across, down]: [f64; 2]) -> Point {
        let place = [across - self.origin[0], self.origin[1] - down];
        Point::from(place) / self.scale
    }

    /// The disc of a pulley with its centre.
    pub(super) fn disc(&self, canvas: &Canvas<'_>, pitch: &Pitch, outline: Stroke) -> Drawn {
        let radius = px(self.scale * pitch.radius);
        let centre = self.units(pitch.centre);
        canvas.draw(&Circle::new(centre, radius, style::GREY.mix(0.10).filled()))?;
        canvas.draw(&Circle::new(centre, radius, outline.shape()))?;
        canvas.draw(&Circle::new(centre, px(2.5), style::INK.filled()))
    }

    /// The sense in which a pulley turns: an arrow round its centre, whose middle is at a polar angle.
    pub(super) fn rotation(&self, canvas: &Canvas<'_>, pitch: &Pitch, middle: f64) -> Drawn {
        let angle = |part: f64| middle + pitch.sense * part * FRAC_PI_3;
        let at = |part| pitch.centre + polar(angle(part), 0.5 * pitch.radius);
        let arc = (-20..=20).map(|step| self.units(at(f64::from(step) / 20.0)));
        Stroke::solid(style::GREY, 2.0).draw(canvas, arc.collect())?;
        let onward = pitch.sense * (at(1.0) - pitch.centre);
        let size = (self.scale * pitch.radius / ROOMY).min(1.0);
        let onward = size * Point::new(-onward.y, onward.x).normalize();
        self.small_arrowhead(canvas, at(1.0), onward, style::GREY)
    }

    /// An arrowhead of the size of [`ARROWHEAD`] with its tip ahead of a point.
    pub(super) fn arrowhead(
        &self,
        canvas: &Canvas<'_>,
        at: Point,
        direction: Point,
        color: RGBColor,
    ) -> Drawn {
        self.small_arrowhead(canvas, at, direction.normalize(), color)
    }

    /// An arrowhead whose size is the length of its direction times that of [`ARROWHEAD`].
    fn small_arrowhead(
        &self,
        canvas: &Canvas<'_>,
        at: Point,
        direction: Point,
        color: RGBColor,
    ) -> Drawn {
        let along = direction / self.scale;
        let across = Point::new(-along.y, along.x);
        let [ahead, behind, beside] = ARROWHEAD;
        let corners = [
            at + ahead * along,
            at - behind * along + beside * across,
            at - behind * along - beside * across,
        ];
        canvas.draw(&Polygon::new(
            corners.map(|corner| self.units(corner)).to_vec(),
            color.filled(),
        ))
    }

    /// An arrow from a point to its tip: its line alone where it is shorter than an arrowhead.
    pub(super) fn arrow(
        &self,
        canvas: &Canvas<'_>,
        [start, end]: [Point; 2],
        stroke: Stroke,
    ) -> Drawn {
        let (along, [ahead, behind, _]) = (end - start, ARROWHEAD);
        let length = self.scale * along.norm();
        if length < SLIM * (ahead + behind) {
            return stroke.draw(canvas, vec![self.units(start), self.units(end)]);
        }
        let head = end - SLIM * ahead / length * along;
        stroke.draw(canvas, vec![self.units(start), self.units(head)])?;
        self.small_arrowhead(canvas, head, SLIM * along.normalize(), stroke.color)
    }

    /// The belt on a pulley through points at swept angles in rad, in the colours of its zones.
    pub(super) fn belt(
        &self,
        canvas: &Canvas<'_>,
        zones: &[Zone],
        points: impl Iterator<Item = (f64, Point)>,
    ) -> Drawn {
        let points: Vec<_> = points.collect();
        let steps: Vec<_> = points.windows(2).collect();
        let kind = |step: &[(f64, Point)]| {
            let middle = 0.5 * (step[0].0 + step[1].0);
            let zone = zones
                .iter()
                .find(|zone| (zone.from..=zone.to).contains(&middle));
            zone.map(|zone| zone.kind)
        };
        for run in steps.chunk_by(|one, next| kind(one) == kind(next)) {
            let stroke = kind(run[0]).map_or(FREE, |kind| Stroke::solid(style::zone(kind).1, BELT));
            let first = run.iter().map(|step| step[0].1).take(1);
            let line = first.chain(run.iter().map(|step| step[1].1));
            let line = self.thinned(line.collect());
            stroke.draw(
                canvas,
                line.iter().map(|point| self.units(*point)).collect(),
            )?;
        }
        Ok(())
    }

    /// The points of a line that are far enough from each other to be seen, with both ends.
    fn thinned(&self, points: Vec<Point>) -> Vec<Point> {
        let mut kept: Vec<Point> = Vec::with_capacity(points.len());
        let is_close = |one: Point, other: Point| self.scale * (one - other).norm() < CLOSEST;
        for (index, point) in points.iter().enumerate() {
            if index + 1 == points.len() {
                while kept.len() > 1 && kept.last().is_some_and(|last| is_close(*last, *point)) {
                    kept.pop();
                }
            } else if kept.last().is_some_and(|last| is_close(*last, *point)) {
                continue;
            }
            kept.push(*point);
        }
        kept
    }

    /// By how much penetrations are exaggerated on pulleys, the smallest of this radius in m: the smallest
    /// round factor that makes the largest one visible, or 1 where there is none.
    pub(super) fn exaggeration(&self, penetration: f64, radius: f64) -> f64 {
        let visible = (VISIBLE / self.scale).min(VISIBLE_PART * radius);
        let round = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0];
        let mut enough = round.into_iter().filter(|x| x * penetration >= visible);
        enough.next().unwrap_or(1.0)
    }
}

/// What is said of the scale of a plan.
pub(super) fn scale_note(exaggeration: f64) -> String {
    if exaggeration > 1.0 {
        format!("drawn to scale, penetration exaggerated {exaggeration} times")
    } else {
        "drawn to scale".to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAN: Plan = Plan {
        scale: 400.0,
        origin: [0.0; 2],
    };

    #[test]
    fn only_invisible_penetrations_are_exaggerated() {
        assert_eq!(PLAN.exaggeration(0.02, 0.1), 1.0);
        assert_eq!(PLAN.exaggeration(0.0004, 0.1), 50.0);
        assert_eq!(PLAN.exaggeration(0.0, 0.1), 1.0);
    }

    #[test]
    fn close_points_of_a_line_are_left_out() {
        let line = |places: &[f64]| {
            let points = places.iter().map(|x| Point::new(x / PLAN.scale, 0.0));
            let kept = PLAN.thinned(points.collect()).into_iter();
            kept.map(|point| (PLAN.scale * point.x).round())
                .collect::<Vec<_>>()
        };
        assert_eq!(line(&[0.0, 0.2, 0.9, 5.0, 5.3, 9.0, 9.2]), [0.0, 5.0, 9.0]);
        assert_eq!(line(&[0.0, 0.2]), [0.0, 0.0]);
        assert_eq!(line(&[0.0, 10.0]), [0.0, 10.0]);
    }
}
