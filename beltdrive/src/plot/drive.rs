//! The drive to scale, with the belt seated in the grooves.

use super::geometry::{Circle as Pitch, Geometry};
use super::header::{Header, Legend};
use super::plan::{BELT, FREE, Plan, scale_note};
use super::style::{self, Canvas, Drawn, Stroke};
use crate::report::{Precision, rpm, torque_scale};
use crate::{PulleyState, SteadyState};
use plotters::style::text_anchor::HPos;
use std::f64::consts::FRAC_PI_2;

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

/// Distance of the labels of the spans from the drive, px.
const LABEL: f64 = 24.0;

/// The figure of the drive.
pub(super) fn figure(state: &SteadyState) -> String {
    let view = View::of(state);
    style::render([WIDTH, (view.bottom + BELOW).ceil()], |canvas| {
        let zones = style::kinds(state)
            .map(style::zone)
            .map(|(name, color)| Legend::Line(name, Stroke::solid(color, BELT)));
        let legend: Vec<_> = zones.chain([Legend::Line("free belt", FREE)]).collect();
        Header::of(state, CAPTION).draw(canvas, &legend)?;
        view.draw(canvas, state)
    })
}

/// The drive on the sheet.
struct View {
    geometry: Geometry,
    /// Its origin is the centre of the driver.
    plan: Plan,
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
        let plan = Plan {
            scale,
            origin: [
                0.5 * (WIDTH - scale * length) + scale * driver.radius,
                top + scale * larger,
            ],
        };
        let pulleys = [&state.driver, &state.driven];
        let penetrations = pulleys.map(|pulley| pulley.max_penetration);
        let penetration = penetrations[0].max(penetrations[1]);
        Self {
            geometry,
            plan,
            top,
            bottom: top + 2.0 * scale * larger,
            exaggeration: plan.exaggeration(penetration, driver.radius.min(driven.radius)),
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
            FREE.draw(canvas, span.map(|end| self.plan.units(end)).to_vec())?;
            let middle = 0.5 * (span[0] + span[1]);
            if state.driver.angular_speed > 0.0 {
                self.plan
                    .arrowhead(canvas, middle, span[1] - span[0], style::INK)?;
            }
            let [tension, tractive] =
                tensions.map(|value| self.precision.show_against(value, scale));
            let label = format!("{name} span: T = {tension} N, F = {tractive} N");
            let style = style::face(style::BODY, style::INK, HPos::Center);
            style::write(
                canvas,
                &label,
                &style,
                [self.plan.position(middle)[0], height],
            )?;
        }
        for (_, pulley, pitch) in pulleys {
            self.belt(canvas, pulley, pitch)?;
        }
        let style = style::face(style::SMALL, style::GREY, HPos::Left);
        style::write(
            canvas,
            &scale_note(self.exaggeration),
            &style,
            [style::MARGIN, self.bottom + BELOW - 20.0],
        )
    }

    /// The disc of a pulley with its centre and, where it turns, the sense of its rotation.
    fn pulley(&self, canvas: &Canvas<'_>, pulley: &PulleyState, pitch: &Pitch) -> Drawn {
        self.plan
            .disc(canvas, pitch, Stroke::solid(style::GREY, 0.8))?;
        if pulley.angular_speed > 0.0 {
            self.plan.rotation(canvas, pitch, FRAC_PI_2)?;
        }
        Ok(())
    }

    /// The belt on a pulley in the colours of its zones.
    fn belt(&self, canvas: &Canvas<'_>, pulley: &PulleyState, pitch: &Pitch) -> Drawn {
        let profile = &pulley.profile;
        let points = profile.angle.iter().zip(&profile.penetration);
        let points = points.map(|(&angle, penetration)| {
            (angle, pitch.point(angle, self.exaggeration * penetration))
        });
        self.plan.belt(canvas, &pulley.zones, points)
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
        let across = self.plan.position(pitch.centre)[0];
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
}
