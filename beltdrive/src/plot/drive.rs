//! The drive to scale, with the belt seated in the grooves.

use super::geometry::{Circle as Pitch, Geometry, Point, polar};
use super::style::{self, Canvas, Drawn, Header, Legend, Stroke, px};
use crate::report::{Precision, rpm, torque_scale};
use crate::{PulleyState, SteadyState};
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_3, FRAC_PI_6};

const CAPTION: &str = "Steady state of the drive";

/// Width of the figure, px.
const WIDTH: f64 = 1000.0;

/// Space at both sides of the drive, above it for a label, and below it for a label and the data
/// of the pulleys, px.
const SIDE: f64 = 90.0;
const ABOVE: f64 = 50.0;
const BELOW: f64 = 170.0;

/// The largest height of the drive, px.
const TALLEST: f64 = 440.0;

/// A penetration is invisible below so many px, or below this part of the radius.
const VISIBLE: f64 = 4.0;
const VISIBLE_PART: f64 = 0.1;

/// Distance of the labels of the spans from the drive, px.
const LABEL: f64 = 24.0;

/// Width of the belt, px.
const BELT: f64 = 4.0;
const FREE: Stroke = Stroke::solid(style::INK, BELT);

/// The figure of the drive.
pub(super) fn figure(state: &SteadyState) -> String {
    let view = View::of(state);
    style::render([WIDTH, (view.bottom + BELOW).ceil()], |canvas| {
        let zones = style::kinds(state)
            .map(style::zone)
            .map(|(name, color)| Legend::Line(name, Stroke::solid(color, BELT)));
        let legend: Vec<_> = zones.chain([Legend::Line("free belt", FREE)]).collect();
        style::header(canvas, &Header::of(state, CAPTION), &legend)?;
        view.draw(canvas, state)
    })
}

/// The drive on the sheet.
struct View {
    geometry: Geometry,
    /// Scale, px per metre.
    scale: f64,
    /// Where the centre of the driver is, px.
    origin: [f64; 2],
    /// Between which heights the larger pulley lies, px.
    top: f64,
    bottom: f64,
    /// By how much penetrations are exaggerated.
    exaggeration: f64,
    precision: Precision,
    /// What the error of a torque is relative to, N·m.
    torque_scale: f64,
}

impl View {
    /// The view in which the drive fills the sheet.
    fn of(state: &SteadyState) -> Self {
        let geometry = Geometry::of(state);
        let Geometry { driver, driven } = geometry;
        let larger = driver.radius.max(driven.radius);
        let length = driver.radius + driven.centre.x + driven.radius;
        let scale = ((WIDTH - 2.0 * SIDE) / length).min(TALLEST / (2.0 * larger));
        let top = Header::of(state, CAPTION).height(WIDTH) + ABOVE;
        let penetration = state
            .driver
            .max_penetration
            .max(state.driven.max_penetration);
        let visible = (VISIBLE / scale).min(VISIBLE_PART * driver.radius.min(driven.radius));
        Self {
            geometry,
            scale,
            origin: [
                0.5 * (WIDTH - scale * length) + scale * driver.radius,
                top + scale * larger,
            ],
            top,
            bottom: top + 2.0 * scale * larger,
            exaggeration: exaggeration(penetration, visible),
            precision: Precision::of(&state.convergence, 4),
            torque_scale: torque_scale(&state.drive, state.tight_tension),
        }
    }

    fn draw(&self, canvas: &Canvas<'_>, state: &SteadyState) -> Drawn {
        let pulleys = [
            ("driver", &state.driver, &self.geometry.driver),
            ("driven pulley", &state.driven, &self.geometry.driven),
        ];
        for (name, pulley, pitch) in pulleys {
            self.pulley(canvas, pulley, pitch)?;
            self.data(canvas, name, pulley, pitch)?;
        }
        let tight = [state.tight_tension, state.tight_tractive_tension];
        let slack = [state.slack_tension, state.slack_tractive_tension];
        let scale = state.tight_tension;
        for (name, span, tensions, height) in [
            ("tight", self.geometry.tight_span(), tight, self.top - LABEL),
            (
                "slack",
                self.geometry.slack_span(),
                slack,
                self.bottom + LABEL,
            ),
        ] {
            FREE.draw(canvas, span.map(|end| self.units(end)).to_vec())?;
            let middle = 0.5 * (span[0] + span[1]);
            if state.driver.angular_speed > 0.0 {
                self.arrowhead(canvas, middle, span[1] - span[0], style::INK)?;
            }
            let [tension, tractive] =
                tensions.map(|value| self.precision.show_against(value, scale));
            let label = format!("{name} span: T = {tension} N, F = {tractive} N");
            let style = style::face(style::BODY, style::INK, HPos::Center);
            style::write(canvas, &label, &style, [self.position(middle)[0], height])?;
        }
        for (_, pulley, pitch) in pulleys {
            self.belt(canvas, pulley, pitch)?;
        }
        let note = if self.exaggeration > 1.0 {
            format!(
                "drawn to scale, penetration exaggerated {} times",
                self.exaggeration
            )
        } else {
            "drawn to scale".to_owned()
        };
        let style = style::face(style::SMALL, style::GREY, HPos::Left);
        style::write(
            canvas,
            &note,
            &style,
            [style::MARGIN, self.bottom + BELOW - 20.0],
        )
    }

    /// The disc of a pulley with its centre and, where it turns, the sense of its rotation.
    fn pulley(&self, canvas: &Canvas<'_>, pulley: &PulleyState, pitch: &Pitch) -> Drawn {
        let radius = px(self.scale * pitch.radius);
        let centre = self.units(pitch.centre);
        let outline = Stroke::solid(style::GREY, 0.8);
        canvas.draw(&Circle::new(centre, radius, style::GREY.mix(0.10).filled()))?;
        canvas.draw(&Circle::new(centre, radius, outline.shape()))?;
        canvas.draw(&Circle::new(centre, px(2.5), style::INK.filled()))?;
        if pulley.angular_speed > 0.0 {
            let at = |angle| pitch.centre + polar(angle, 0.5 * pitch.radius);
            let end = FRAC_PI_2 + FRAC_PI_3;
            let arc = (0..=40).map(|step| FRAC_PI_6 + (end - FRAC_PI_6) * f64::from(step) / 40.0);
            let arc = arc.map(|angle| self.units(at(angle))).collect();
            Stroke::solid(style::GREY, 2.0).draw(canvas, arc)?;
            self.arrowhead(canvas, at(end), polar(end + FRAC_PI_2, 1.0), style::GREY)?;
        }
        Ok(())
    }

    /// The belt on a pulley in the colours of its zones.
    fn belt(&self, canvas: &Canvas<'_>, pulley: &PulleyState, pitch: &Pitch) -> Drawn {
        let profile = &pulley.profile;
        let points: Vec<_> = profile.angle.iter().zip(&profile.penetration).collect();
        let steps: Vec<_> = points.windows(2).collect();
        let kind = |step: &[(&f64, &f64)]| {
            let middle = 0.5 * (step[0].0 + step[1].0);
            pulley
                .zones
                .iter()
                .find(|zone| (zone.from..=zone.to).contains(&middle))
                .map(|zone| zone.kind)
        };
        for run in steps.chunk_by(|one, next| kind(one) == kind(next)) {
            let stroke = kind(run[0]).map_or(FREE, |kind| Stroke::solid(style::zone(kind).1, BELT));
            let ends = run.iter().flat_map(|step| step.iter());
            let line = ends.map(|(angle, penetration)| {
                self.units(pitch.point(**angle, self.exaggeration * **penetration))
            });
            stroke.draw(canvas, line.collect())?;
        }
        Ok(())
    }

    /// Name, speed, torque and wrap angle below a pulley.
    fn data(&self, canvas: &Canvas<'_>, name: &str, pulley: &PulleyState, pitch: &Pitch) -> Drawn {
        let show = |value| self.precision.show(value);
        let torque = self
            .precision
            .show_against(pulley.torque, self.torque_scale);
        let lines = [
            format!(
                "{} rad/s = {} rpm",
                show(pulley.angular_speed),
                show(rpm(pulley.angular_speed))
            ),
            format!("torque {torque} N·m"),
            format!("wrap angle {}°", show(pulley.wrap_angle.to_degrees())),
        ];
        let across = self.position(pitch.centre)[0];
        let mut down = self.bottom + 56.0;
        style::write(
            canvas,
            name,
            &style::face(16.0, style::INK, HPos::Center),
            [across, down],
        )?;
        for line in lines {
            down += 20.0;
            let style = style::face(style::BODY, style::INK, HPos::Center);
            style::write(canvas, &line, &style, [across, down])?;
        }
        Ok(())
    }

    /// An arrowhead with its tip ahead of a point.
    fn arrowhead(
        &self,
        canvas: &Canvas<'_>,
        at: Point,
        direction: Point,
        color: RGBColor,
    ) -> Drawn {
        let along = direction.normalize() / self.scale;
        let across = Point::new(-along.y, along.x);
        let corners = [
            at + 9.0 * along,
            at - 5.0 * along + 6.0 * across,
            at - 5.0 * along - 6.0 * across,
        ];
        canvas.draw(&Polygon::new(
            corners.map(|corner| self.units(corner)).to_vec(),
            color.filled(),
        ))
    }

    /// Position on the sheet, px.
    fn position(&self, point: Point) -> [f64; 2] {
        [
            self.origin[0] + self.scale * point.x,
            self.origin[1] - self.scale * point.y,
        ]
    }

    /// Position on the sheet in units of the backend.
    fn units(&self, point: Point) -> (i32, i32) {
        self.position(point).map(px).into()
    }
}

/// The smallest round factor that makes a penetration visible, or 1 where there is none.
fn exaggeration(penetration: f64, visible: f64) -> f64 {
    let round = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0];
    round
        .into_iter()
        .find(|factor| factor * penetration >= visible)
        .unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_invisible_penetrations_are_exaggerated() {
        assert_eq!(exaggeration(0.02, 0.01), 1.0);
        assert_eq!(exaggeration(0.0004, 0.01), 50.0);
        assert_eq!(exaggeration(0.0, 0.01), 1.0);
    }
}
