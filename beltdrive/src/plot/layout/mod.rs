//! The layout to scale: pulleys, the belt with its zones, tensioner, hub loads and labels.

pub(super) mod in_time;
mod labels;
mod model;
#[cfg(test)]
mod tests;
mod view;

use super::header::{Header, Mark};
use super::sheet::{
    Anchor, Color, GREY, INK, MARGIN, SMALL, Sheet, Spot, Stroke, VERMILION, WHITE,
};
use super::sheet::{spot, text_width};
use super::zones;
use crate::quantity::Answer;
use crate::quantity::precision::six_digits;
use labels::Label;
use model::{Loop, polar};
use std::f64::consts::FRAC_PI_3;
use view::{ARROWHEAD, BELT, LOAD, PIVOT, SCALES, View};

/// Widths of the sheet, px: the first on which every label has a place of its own is taken.
const WIDTHS: [f64; 7] = [1000.0, 1250.0, 1500.0, 1800.0, 2200.0, 2700.0, 3300.0];

/// The length scale is at most this long, px.
const LONGEST: f64 = 160.0;

const FREE: Stroke = Stroke::solid(INK, BELT);
const HUB_LOADS: [Stroke; 2] = [
    Stroke::solid(VERMILION, 2.0),
    Stroke::dashed(VERMILION, 1.0),
];
const TENSIONER: Stroke = Stroke::solid(GREY, 3.0);
const THIN: Stroke = Stroke::solid(GREY, 0.8);

/// Size of the arrowheads of thin lines, over that of the belt.
const SLIM: f64 = 0.7;

/// Below this radius of a pulley the arrowhead of its rotation is smaller, px.
const ROOMY: f64 = 48.0;

/// Points of a line are no closer, px: joints of a wide line through closer ones would be seen.
const CLOSEST: f64 = 1.0;

/// The figure of the layout of an answer.
pub(super) fn figure(answer: &Answer) -> String {
    let drawn = Loop::of(answer);
    let (header, view, labels) = placed(&drawn, |width| {
        Header::new(answer, "Steady state", legend(answer, &drawn), width)
    });
    let mut sheet = Sheet::new(view.size);
    header.draw(&mut sheet);
    view.draw(&mut sheet);
    for label in &labels {
        label.draw(&mut sheet);
    }
    view.scales(&mut sheet);
    sheet.finish()
}

/// A loop and its labels below a header, which depends on the width, on the smallest sheet that has room for them.
fn placed(drawn: &Loop, header: impl Fn(f64) -> Header) -> (Header, View<'_>, Vec<Label>) {
    let mut sheets = WIDTHS.iter().map(|width| {
        let header = header(*width);
        let view = View::of(drawn, header.height, *width);
        let (labels, is_free) = labels::labels(&view);
        ((header, view, labels), is_free)
    });
    let mut last = None;
    sheets
        .find_map(|(sheet, is_free)| match is_free {
            true => Some(sheet),
            false => {
                last = Some(sheet);
                None
            }
        })
        .or(last)
        .expect("a sheet of every width")
}

fn legend(answer: &Answer, drawn: &Loop) -> Vec<(String, Mark)> {
    let mut legend = zones::legend(answer, |color| Mark::Line(Stroke::solid(color, BELT)));
    let mut line = |label: &str, stroke| legend.push((label.to_owned(), Mark::Line(stroke)));
    line("free belt", FREE);
    for (index, label) in ["hub load", "hub load at rest"].into_iter().enumerate() {
        if { drawn.pulleys.iter() }.any(|pulley| pulley.hub_loads[index].is_some()) {
            line(label, HUB_LOADS[index]);
        }
    }
    if drawn.tensioner.is_some() {
        line("tensioner", TENSIONER);
    }
    legend
}

impl View<'_> {
    fn draw(&self, sheet: &mut Sheet) {
        self.pulleys(sheet);
        for index in 0..self.drawn.pulleys.len() {
            if self.shows_rotation(index) {
                self.rotation(sheet, index);
            }
        }
        self.tensioner(sheet);
        for (index, arrowhead) in self.arrowheads.iter().enumerate() {
            let [start, end] = self.span(index);
            sheet.line(&[start, end], FREE);
            if let Some(at) = arrowhead {
                self::arrowhead(sheet, *at, (end - start).normalize(), INK);
            }
        }
        for pulley in &self.drawn.pulleys {
            // The belt passes from one zone to the next.
            let steps: Vec<_> = pulley.belt.windows(2).collect();
            for run in steps.chunk_by(|one, next| one[1].2 == next[1].2) {
                let ends = run.iter().map(|step| &step[1]);
                let places = [&run[0][0]].into_iter().chain(ends);
                let places = places.map(|(angle, penetration, _)| {
                    self.at(pulley.point(*angle, self.exaggeration * penetration))
                });
                let stroke = match run[0][1].2.as_str() {
                    "" => FREE,
                    kind => Stroke::solid(zones::color(kind), BELT),
                };
                sheet.line(&thinned(places), stroke);
            }
        }
        for pulley in &self.drawn.pulleys {
            for (load, stroke) in pulley.hub_loads.iter().zip(HUB_LOADS).rev() {
                if let Some(load) = load {
                    arrow(sheet, self.hub_load(pulley, *load), stroke);
                }
            }
        }
    }

    fn pulleys(&self, sheet: &mut Sheet) {
        for pulley in &self.drawn.pulleys {
            let (centre, radius) = (self.at(pulley.centre), self.scale * pulley.radius);
            let outline = if pulley.is_driver {
                Stroke::solid(INK, 2.0)
            } else {
                THIN
            };
            sheet.disc(centre, radius, "#F1F1F1");
            sheet.rim(centre, radius, outline);
            sheet.disc(centre, 2.5, INK);
        }
    }

    /// The sense in which a pulley turns: an arrow round its centre, off its hub load.
    fn rotation(&self, sheet: &mut Sheet, index: usize) {
        let pulley = &self.drawn.pulleys[index];
        let load = pulley.hub_loads[0].unwrap_or_default();
        let middle = (-load.y).atan2(-load.x);
        let at = |part: f64| {
            let angle = middle + pulley.sense * part * FRAC_PI_3;
            self.at(pulley.centre + polar(angle, 0.5 * pulley.radius))
        };
        let arc: Vec<_> = (-20..=20).map(|step| at(f64::from(step) / 20.0)).collect();
        sheet.line(&arc, Stroke::solid(GREY, 2.0));
        let size = (self.scale * pulley.radius / ROOMY).min(1.0);
        let onward = (at(1.0) - at(0.99)).normalize();
        arrowhead(sheet, at(1.0), size * onward, GREY);
    }

    /// The arm with its pivot or the guide of the slide, and the pulley at rest.
    fn tensioner(&self, sheet: &mut Sheet) {
        let Some(tensioner) = &self.drawn.tensioner else {
            return;
        };
        let radius = self.scale * self.drawn.pulleys[tensioner.pulley].radius;
        sheet.rim(self.at(tensioner.rest), radius, THIN);
        let line = self.guide(tensioner);
        if tensioner.pivot.is_some() {
            sheet.line(&line, TENSIONER);
            sheet.disc(line[0], PIVOT, WHITE);
            sheet.rim(line[0], PIVOT, Stroke::solid(INK, 1.5));
        } else {
            arrow(sheet, line, TENSIONER);
        }
    }

    /// The scale of lengths in the left lower corner; where something else may stand behind it.
    fn length_scale(&self, sheet: &mut Sheet) -> Spot {
        let length = round(LONGEST / self.scale);
        let at = spot(MARGIN, self.size.y - 0.5 * SCALES);
        scale(sheet, at, (&metres(length), self.scale * length, FREE))
    }

    /// The scales of lengths and forces below the loop.
    fn scales(&self, sheet: &mut Sheet) {
        let mut at = self.length_scale(sheet);
        if self.force > 0.0 {
            let force = round(LOAD / self.force);
            let width = self.force * force;
            at = scale(sheet, at, (&newtons(force), width, HUB_LOADS[0]));
        }
        let deeper = match self.exaggeration > 1.0 {
            true => format!(", penetration {} times deeper", self.exaggeration),
            false => String::new(),
        };
        let note =
            format!("to scale{deeper}; torques are positive where the belt drives the pulley");
        sheet.text(&note, SMALL, GREY, Anchor::Start, at);
    }
}

/// A scale from a place on: its text, its width in px and its line; where the next one may stand.
fn scale(sheet: &mut Sheet, at: Spot, (text, width, stroke): (&str, f64, Stroke)) -> Spot {
    let end = at + spot(width, 0.0);
    sheet.line(&[at, end], stroke);
    let beside = end + spot(8.0, 0.0);
    sheet.text(text, SMALL, INK, Anchor::Start, beside);
    beside + spot(text_width(text, SMALL) + 28.0, 0.0)
}

impl Label {
    fn draw(&self, sheet: &mut Sheet) {
        if let Some(leader) = self.place.leader {
            sheet.line(&leader, THIN);
        }
        for (text, size, middle) in self.rows() {
            sheet.text(text, size, INK, Anchor::Middle, middle);
        }
    }
}

/// An arrowhead whose size is the length of its direction times that of [`ARROWHEAD`].
fn arrowhead(sheet: &mut Sheet, at: Spot, along: Spot, color: Color) {
    let across = spot(-along.y, along.x);
    let [ahead, behind, beside] = ARROWHEAD;
    let foot = at - behind * along;
    let corners = [
        at + ahead * along,
        foot + beside * across,
        foot - beside * across,
    ];
    sheet.polygon(&corners, color);
}

/// An arrow from a place to its tip: its line alone where it is shorter than an arrowhead.
fn arrow(sheet: &mut Sheet, [start, end]: [Spot; 2], stroke: Stroke) {
    let (length, [ahead, behind, _]) = ((end - start).norm(), ARROWHEAD);
    if length < SLIM * (ahead + behind) {
        sheet.line(&[start, end], stroke);
    } else {
        let along = SLIM * (end - start) / length;
        let head = end - ahead * along;
        sheet.line(&[start, head], stroke);
        arrowhead(sheet, head, along, stroke.color);
    }
}

/// The places of a line that are far enough from each other to be seen, with both ends.
fn thinned(places: impl Iterator<Item = Spot>) -> Vec<Spot> {
    let mut kept: Vec<Spot> = Vec::new();
    let mut left_out = None;
    for place in places {
        let is_close = { kept.last() }.is_some_and(|last| (place - last).norm() < CLOSEST);
        left_out = is_close.then_some(place);
        if !is_close {
            kept.push(place);
        }
    }
    if let Some(end) = left_out {
        if kept.len() > 1 {
            kept.pop();
        }
        kept.push(end);
    }
    kept
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
