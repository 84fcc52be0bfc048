//! A belt loop to scale: pulleys, belt, tensioner, hub loads and labels.

mod labels;
mod names;
pub(super) mod profiles;
mod view;

#[cfg(test)]
mod tests;

use super::header::{Header, Legend};
use super::plan::{BELT, FREE, scale_note};
use super::style::{self, Canvas, Drawn, Stroke, px};
use crate::ZoneKind;
use crate::belt_loop::{BeltLoop, Duty, LoopState};
use crate::report::six_digits;
use labels::Label;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use view::{LOAD, PIVOT, SCALES, View};

const CAPTION: &str = "Steady state of the loop";

/// Widths of the sheet, px: the first on which every label has a place of its own is taken.
const WIDTHS: [f64; 7] = [1000.0, 1250.0, 1500.0, 1800.0, 2200.0, 2700.0, 3300.0];

/// The length scale is at most this long, px.
const LONGEST: f64 = 160.0;

const HUB_LOAD: Stroke = Stroke::solid(style::VERMILION, 2.0);
const REST_HUB_LOAD: Stroke = Stroke::dashed(style::VERMILION, 1.0);
const TENSIONER: Stroke = Stroke::solid(style::GREY, 3.0);
const THIN: Stroke = Stroke::solid(style::GREY, 0.8);

/// The figure of a loop.
pub(super) fn figure(belt_loop: &BeltLoop, state: &LoopState) -> String {
    let header = Header::of_loop(belt_loop, CAPTION);
    let (view, labels) = placed(belt_loop, state, &header);
    style::render(view.size, |canvas| {
        header.draw(canvas, &legend(&view))?;
        view.draw(canvas)?;
        for label in &labels {
            label.draw(canvas)?;
        }
        view.scales(canvas)
    })
}

/// The loop and its labels on the smallest sheet that has room for them.
fn placed<'a>(
    belt_loop: &'a BeltLoop,
    state: &'a LoopState,
    header: &Header,
) -> (View<'a>, Vec<Label>) {
    let [first, larger @ ..] = WIDTHS.map(|width| {
        move || {
            let view = View::of(belt_loop, state, header, width);
            let (labels, is_free) = labels::labels(&view);
            (view, labels, is_free)
        }
    });
    let mut placed = first();
    for sheet in larger {
        if placed.2 {
            break;
        }
        placed = sheet();
    }
    (placed.0, placed.1)
}

/// The kinds of zones that occur in a loop.
pub(super) fn kinds(state: &LoopState) -> impl Iterator<Item = ZoneKind> {
    let occurs = |kind: &ZoneKind| {
        let mut pulleys = state.pulleys.iter();
        pulleys.any(|pulley| pulley.zones.iter().any(|zone| zone.kind == *kind))
    };
    ZoneKind::ALL.into_iter().filter(occurs)
}

fn legend(view: &View<'_>) -> Vec<Legend> {
    let zones = kinds(view.state).map(style::zone);
    let zones = zones.map(|(name, color)| Legend::Line(name, Stroke::solid(color, BELT)));
    let mut legend: Vec<_> = zones.collect();
    legend.push(Legend::Line("free belt", FREE));
    legend.push(Legend::Line("hub load", HUB_LOAD));
    legend.push(Legend::Line("hub load at rest", REST_HUB_LOAD));
    if view.tensioner.is_some() {
        legend.push(Legend::Line("tensioner", TENSIONER));
    }
    legend
}

impl View<'_> {
    fn draw(&self, canvas: &Canvas<'_>) -> Drawn {
        let plan = &self.plan;
        let pulleys = self.state.pulleys.iter().enumerate();
        for ((index, pulley), stated) in pulleys.clone().zip(&self.belt_loop.pulleys) {
            let circle = &self.circles[index];
            let outline = match stated.duty {
                Duty::Driver(_) => Stroke::solid(style::INK, 2.0),
                _ => THIN,
            };
            plan.disc(canvas, circle, outline)?;
            if self.shows_rotation(index) {
                let [x, y] = pulley.hub_load;
                plan.rotation(canvas, circle, (-y).atan2(-x))?;
            }
        }
        self.draw_tensioner(canvas)?;
        for (index, arrowhead) in self.arrowheads.iter().enumerate() {
            let [start, end] = self.span(index);
            FREE.draw(canvas, vec![plan.units(start), plan.units(end)])?;
            if let Some(at) = arrowhead {
                plan.arrowhead(canvas, *at, end - start, style::INK)?;
            }
        }
        for (index, pulley) in pulleys.clone() {
            plan.belt(canvas, &pulley.zones, self.contact(index).into_iter())?;
        }
        for (index, pulley) in pulleys {
            for (load, stroke) in [
                (pulley.rest_hub_load, REST_HUB_LOAD),
                (pulley.hub_load, HUB_LOAD),
            ] {
                plan.arrow(canvas, self.hub_load(index, load), stroke)?;
            }
        }
        Ok(())
    }

    /// The arm with its pivot or the guide of the slide, and the pulley at rest.
    fn draw_tensioner(&self, canvas: &Canvas<'_>) -> Drawn {
        let Some((tensioner, found)) = self.tensioner.as_ref().zip(self.state.tensioner.as_ref())
        else {
            return Ok(());
        };
        let plan = &self.plan;
        let radius = px(plan.scale * self.circles[found.pulley].radius);
        let rest = plan.units(tensioner.rest);
        canvas.draw(&Circle::new(rest, radius, THIN.shape()))?;
        if tensioner.is_arm {
            TENSIONER.draw(canvas, tensioner.line.map(|end| plan.units(end)).to_vec())?;
            let pivot = plan.units(tensioner.anchor);
            canvas.draw(&Circle::new(pivot, px(PIVOT), WHITE.filled()))?;
            canvas.draw(&Circle::new(
                pivot,
                px(PIVOT),
                Stroke::solid(style::INK, 1.5).shape(),
            ))
        } else {
            plan.arrow(canvas, tensioner.line, TENSIONER)
        }
    }

    /// The scales of lengths and forces below the loop.
    fn scales(&self, canvas: &Canvas<'_>) -> Drawn {
        let height = self.size[1] - 0.5 * SCALES;
        let length = round(LONGEST / self.plan.scale);
        let force = round(LOAD / self.length_of(1.0));
        let mut left = style::MARGIN;
        for (text, width, stroke) in [
            (metres(length), self.plan.scale * length, FREE),
            (newtons(force), self.length_of(force), HUB_LOAD),
        ] {
            let ends = [left, left + width].map(|x| (px(x), px(height)));
            stroke.draw(canvas, ends.to_vec())?;
            let face = style::face(style::SMALL, style::INK, HPos::Left);
            left += width + 8.0;
            style::write(canvas, &text, &face, [left, height])?;
            left += style::text_width(text.chars().count(), style::SMALL) + 28.0;
        }
        let note = format!(
            "{}; torques are positive where the belt drives the pulley",
            scale_note(self.exaggeration)
        );
        let face = style::face(style::SMALL, style::GREY, HPos::Left);
        style::write(canvas, &note, &face, [left, height])
    }
}

impl Label {
    fn draw(&self, canvas: &Canvas<'_>) -> Drawn {
        if let Some(leader) = self.place.leader {
            THIN.draw(canvas, leader.map(|end| end.map(px).into()).to_vec())?;
        }
        for (text, size, middle) in self.rows() {
            let face = style::face(size, style::INK, HPos::Center);
            style::write(canvas, text, &face, middle)?;
        }
        Ok(())
    }
}

fn metres(length: f64) -> String {
    match length < 1.0 {
        true => format!("{} mm", six_digits(1e3 * length)),
        false => format!("{} m", six_digits(length)),
    }
}

fn newtons(force: f64) -> String {
    match force < 1e4 {
        true => format!("{} N", six_digits(force)),
        false => format!("{} kN", six_digits(1e-3 * force)),
    }
}

/// The largest round number that is not above a positive one.
fn round(number: f64) -> f64 {
    let power = 10_f64.powf(number.log10().floor());
    let digits = [5.0, 2.0].into_iter();
    power * { digits }
        .find(|digit| digit * power <= number)
        .unwrap_or(1.0)
}
