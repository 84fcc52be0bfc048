//! The loop frame by frame.

use super::super::super::axis::Axis;
use super::super::super::clock::{Clock, shown};
use super::super::super::header::{Header, Mark};
use super::super::super::occupied::Frame;
use super::super::super::sheet::{
    Anchor, BODY, Color, GREY, INK, MARGIN, SMALL, Sheet, Spot, Stroke, VERMILION, WHITE, pair,
    spot, text_width,
};
use super::super::super::{ordered, zones};
use super::super::arrowhead;
use super::super::labels::Label;
use super::super::model::Pulley;
use super::super::view::{BELT, SCALES, View};
use super::parts::{Part, mean_tension};
use crate::transient::BeltAlongLoop;
use std::f64::consts::PI;
use std::ops::Range;

/// Width of the belt with its outline, which sets the lightest colours off the sheet, px, and of the colour.
const OUTLINED: f64 = BELT + 4.0;
const COLORED: f64 = OUTLINED - 2.0;

/// Colour of a slack belt, which is none of those of tensions.
const SLACK: Color = VERMILION;

/// Pieces of the belt reach so far into the next one: no gap is seen between them, px.
const OVERLAP: f64 = 0.6;

/// Points of a span that is displaced across are no closer, px: a half wave of 100 px is still round, and no mesh makes
/// files larger than some megabytes.
const POINTS: f64 = 5.0;

/// Sizes of the arrowheads on the belt and their colours: dark with a white edge, to be seen on every colour.
const ARROWHEADS: [(f64, Color); 2] = [(1.9, WHITE), (1.4, INK)];

/// Width of the band inside a rim that tells the zones, and the distance of its middle from the rim, px; on small pulleys it
/// is this part of their radius.
const BAND: f64 = 4.0;
const INSIDE: f64 = 0.5 * OUTLINED + 1.0 + 0.5 * BAND;
const INSIDE_PART: f64 = 0.4;

/// Length of the spoke of a pulley over the radius inside the band.
const SPOKE: f64 = 0.75;

/// Height of the middle of a note below the scale of lengths over the lower edge, px.
const NOTE: f64 = 12.0;

/// Left end of the bar of colours and its room for the time at its right, as parts of the width, and its height, px.
const BAR: [f64; 2] = [0.42, 0.75];
const BAR_HEIGHT: f64 = 14.0;

/// The zones: the belt sticks in the first and slips in the second.
const ZONES: [&str; 2] = ["elastic", "slip"];

/// The legend: the zones and the slack belt that occur in frames of a loop with parts.
pub(super) fn legend(frames: &[BeltAlongLoop], parts: &[Part]) -> Vec<(String, Mark)> {
    let arcs = parts.iter().filter(|part| !part.is_span);
    let cells: Vec<_> = arcs.flat_map(|arc| arc.cells.clone()).collect();
    let occurs = |slips: bool| {
        let mut frames = frames.iter();
        frames.any(|belt| cells.iter().any(|&cell| belt.slips[cell] == slips))
    };
    let kinds = ZONES.into_iter().zip([false, true]);
    let kinds = kinds.filter(|(_, slips)| occurs(*slips));
    let band = |kind| Mark::Line(Stroke::solid(zones::color(kind), BAND));
    let zones = kinds.map(|(kind, _)| zones::entry(kind, band(kind)));
    let mut pieces = parts.iter().flat_map(Part::pieces);
    let is_slack = pieces.any(|cells| frames.iter().any(|belt| mean_tension(belt, &cells) < 0.0));
    let slack = Mark::Line(Stroke::solid(SLACK, COLORED));
    let slack = is_slack.then(|| ("slack belt".to_owned(), slack));
    zones.chain(slack).collect()
}

/// A loop on the sheet with its belt in frames.
pub(super) struct Film<'a> {
    view: View<'a>,
    frames: &'a [BeltAlongLoop],
    clock: Clock,
    tension: &'a Axis,
    parts: Vec<Part>,
}

impl<'a> Film<'a> {
    /// The film of frames on a view, whose tensions in N lie on an axis.
    pub(super) fn new(
        view: View<'a>,
        (frames, clock): (&'a [BeltAlongLoop], Clock),
        tension: &'a Axis,
        parts: Vec<Part>,
    ) -> Self {
        Self {
            view,
            frames,
            clock,
            tension,
            parts,
        }
    }

    /// The figure below a header, with labels, and the angles in rad by which the pulleys have turned in each frame.
    pub(super) fn figure(&self, header: &Header, labels: &[Label], turned: &[Vec<f64>]) -> String {
        let mut sheet = Sheet::new(self.view.size);
        header.draw(&mut sheet);
        self.view.pulleys(&mut sheet);
        for pulley in 0..self.view.drawn.pulleys.len() {
            let angles = turned.iter().map(|angles| angles[pulley]);
            self.spoke(&mut sheet, pulley, angles);
            self.zones(&mut sheet, pulley);
        }
        let outline = Stroke::solid(INK, OUTLINED);
        for part in &self.parts {
            self.piece(&mut sheet, part, (part.cells.clone(), 0.0), (outline, ""));
        }
        for part in &self.parts {
            for cells in part.pieces() {
                let colors = self.colors(&cells);
                let stroke = Stroke::solid(colors[0], COLORED);
                let colors: Vec<_> = colors.into_iter().map(str::to_owned).collect();
                let changes = self.clock.moves("stroke", &colors);
                self.piece(&mut sheet, part, (cells, OVERLAP), (stroke, &changes));
            }
        }
        for span in self.parts.iter().filter(|part| part.is_span) {
            self.arrowhead(&mut sheet, span);
        }
        for label in labels {
            label.draw(&mut sheet);
        }
        self.below(&mut sheet);
        sheet.finish()
    }

    /// The colours of cells in the frames, by their mean tension; slack below zero.
    fn colors(&self, cells: &Range<usize>) -> Vec<&'static str> {
        let colors = self.frames.iter().map(|belt| {
            let tension = mean_tension(belt, cells);
            match tension < 0.0 {
                true => SLACK,
                false => ordered::color(self.tension.part(tension)),
            }
        });
        colors.collect()
    }

    /// Draws cells of a part of the belt, which reach some px farther, with a stroke and its changes.
    fn piece(
        &self,
        sheet: &mut Sheet,
        part: &Part,
        (cells, farther): (Range<usize>, f64),
        (stroke, changes): (Stroke, &str),
    ) {
        let paths: Vec<_> = match (part.is_span, self.frames[0].displacement.is_empty()) {
            (false, _) => {
                let pulley = &self.view.drawn.pulleys[part.pulley];
                let [from, to] =
                    [cells.start, cells.end].map(|cell| pulley.wrap * part.along(cell));
                let beyond = farther / (self.view.scale * pulley.radius);
                vec![self.arc(pulley, [from, to + beyond], 0.0)]
            }
            (true, true) => {
                let ends = [cells.start, cells.end].map(|cell| self.on_span(part, cell));
                vec![path(&ends, farther)]
            }
            (true, false) => {
                let frames = self.frames.iter();
                frames
                    .map(|belt| path(&self.across(part, &cells, belt), farther))
                    .collect()
            }
        };
        let moves = self.clock.moves("d", &paths);
        sheet.changing_path(&paths[0], stroke, &(moves + changes));
    }

    /// The direction of motion on a span that is long enough; it goes with the belt.
    fn arrowhead(&self, sheet: &mut Sheet, span: &Part) {
        let Some(at) = self.view.arrowheads[span.pulley] else {
            return;
        };
        let [start, end] = self.view.span(span.pulley);
        let along = (end - start).normalize();
        let share = (at - start).norm() / (end - start).norm();
        let cell = span
            .cells
            .clone()
            .find(|&cell| span.along(cell + 1) > share);
        let offsets = self.frames.iter().map(|belt| {
            let displaced = cell.and_then(|cell| belt.displacement.get(cell));
            displaced.copied().unwrap_or_default() * self.outward(span)
        });
        let offsets: Vec<_> = offsets.map(pair).collect();
        let first = format!("transform=\"translate({})\"", offsets[0]);
        let changes = self.clock.transforms("translate", &offsets);
        sheet.group(&first, &changes, |sheet| {
            for (size, color) in ARROWHEADS {
                arrowhead(sheet, at, size * along, color);
            }
        });
    }

    /// A displacement of 1 m of a span away from the inside of the loop, on the sheet.
    fn outward(&self, span: &Part) -> Spot {
        self.view.scale * self.view.sway * self.view.outward(span.pulley)
    }

    /// The beginning of a cell on a straight span.
    fn on_span(&self, part: &Part, cell: usize) -> Spot {
        let [start, end] = self.view.span(part.pulley);
        start.lerp(&end, part.along(cell))
    }

    /// The ends of cells of a span that is displaced across.
    fn across(&self, part: &Part, cells: &Range<usize>, belt: &BeltAlongLoop) -> Vec<Spot> {
        let outward = self.outward(part);
        let own = &belt.displacement[part.cells.clone()];
        let [start, end] = self.view.span(part.pulley);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "cells in a few px"
        )]
        let step = (POINTS * own.len() as f64 / (end - start).norm()).ceil() as usize;
        let inner = (cells.start..cells.end).step_by(step.max(1));
        let places = inner.chain([cells.end]).map(|cell| {
            let face = cell - part.cells.start;
            // Between the middles of two cells, and beyond the last ones on their line.
            let displaced = match (face, own) {
                (0, [first, second, ..]) => 1.5 * first - 0.5 * second,
                (face, [.., second, last]) if face == own.len() => 1.5 * last - 0.5 * second,
                _ => 0.5 * (own[face.saturating_sub(1)] + own[face.min(own.len() - 1)]),
            };
            self.on_span(part, cell) + displaced * outward
        });
        places.collect()
    }

    /// The path along an arc between two swept angles, some px inside the rim.
    fn arc(&self, pulley: &Pulley, swept: [f64; 2], inside: f64) -> String {
        let depth = inside / self.view.scale;
        let ends = swept.map(|angle| pair(self.view.at(pulley.point(angle, depth))));
        let radius = shown(self.view.scale * (pulley.radius - depth));
        let is_large = u8::from(swept[1] - swept[0] > PI);
        let is_clockwise = u8::from(pulley.sense < 0.0);
        let [from, to] = ends;
        format!("M {from} A {radius} {radius} 0 {is_large} {is_clockwise} {to}")
    }

    /// The bands that tell the zones of a pulley.
    fn zones(&self, sheet: &mut Sheet, index: usize) {
        let pulley = &self.view.drawn.pulleys[index];
        let inside = self.inside(pulley);
        let [sticking, slipping] = ZONES.map(|kind| Stroke::solid(zones::color(kind), BAND));
        let all = self.arc(pulley, [0.0, pulley.wrap], inside);
        sheet.path(&all, sticking);
        let arc = self
            .parts
            .iter()
            .find(|part| !part.is_span && part.pulley == index);
        let Some(arc) = arc else { return };
        let zones = self.frames.iter().map(|belt| {
            let slips = &belt.slips;
            let mut runs: Vec<[usize; 2]> = Vec::new();
            for cell in arc.cells.clone().filter(|&cell| slips[cell]) {
                match runs.last_mut() {
                    Some([_, end]) if *end == cell => *end = cell + 1,
                    _ => runs.push([cell, cell + 1]),
                }
            }
            let paths = runs.into_iter().map(|ends| {
                let swept = ends.map(|cell| pulley.wrap * arc.along(cell));
                self.arc(pulley, swept, inside)
            });
            let paths: Vec<_> = paths.collect();
            match paths.is_empty() {
                // A path without a line.
                true => format!("M {}", pair(self.view.at(pulley.centre))),
                false => paths.join(" "),
            }
        });
        let zones: Vec<_> = zones.collect();
        if zones.iter().any(|path| path.contains('A')) {
            let changes = self.clock.jumps("d", &zones);
            sheet.changing_path(&zones[0], slipping, &changes);
        }
    }

    /// How far inside the rim the middle of the band is, px.
    fn inside(&self, pulley: &Pulley) -> f64 {
        INSIDE.min(INSIDE_PART * self.view.scale * pulley.radius)
    }

    /// A spoke that turns with its pulley, by angles in rad; at first to the right.
    fn spoke(&self, sheet: &mut Sheet, index: usize, angles: impl Iterator<Item = f64>) {
        let pulley = &self.view.drawn.pulleys[index];
        let centre = pair(self.view.at(pulley.centre));
        let reach = SPOKE * (self.view.scale * pulley.radius - self.inside(pulley));
        // Angles on the sheet are clockwise.
        let angles = angles.map(|angle| shown(-pulley.sense * angle.to_degrees()));
        let angles: Vec<_> = angles.collect();
        let turns = self.clock.transforms("rotate", &angles);
        let first = &angles[0];
        sheet.group(&format!("transform=\"translate({centre})\""), "", |sheet| {
            sheet.group(&format!("transform=\"rotate({first})\""), &turns, |sheet| {
                let ends = [Spot::zeros(), spot(reach, 0.0)];
                sheet.line(&ends, Stroke::solid(INK, 2.5));
            });
        });
    }

    /// The scale of lengths, the bar of the tensions and, if it changes, the time.
    fn below(&self, sheet: &mut Sheet) {
        self.view.length_scale(sheet);
        if self.view.sway > 1.0 {
            let note = format!("displacement across {} times larger", self.view.sway);
            let at = spot(MARGIN, self.view.size.y - NOTE);
            sheet.text(&note, SMALL, GREY, Anchor::Start, at);
        }
        let [width, height]: [f64; 2] = self.view.size.into();
        let middle = height - 0.5 * SCALES;
        let half = spot(0.0, 0.5 * BAR_HEIGHT);
        let [from, to] = BAR.map(|part| spot(part * width, middle));
        let frame = Frame {
            from: from - half,
            to: to + half,
        };
        ordered::bar(sheet, frame, self.tension, "belt tension in N");
        let times = match self.frames {
            [_] => vec![],
            frames => times(frames),
        };
        let widest = times
            .iter()
            .map(|text| text_width(text, BODY))
            .fold(0.0, f64::max);
        let at = spot(width - MARGIN - widest, middle);
        for (frame, text) in times.iter().enumerate() {
            let seen = (0..times.len()).map(|other| match other == frame {
                true => "visible".to_owned(),
                false => "hidden".to_owned(),
            });
            let seen: Vec<_> = seen.collect();
            let changes = self.clock.jumps("visibility", &seen);
            sheet.group(&format!("visibility=\"{}\"", seen[0]), &changes, |sheet| {
                sheet.text(text, BODY, INK, Anchor::Start, at);
            });
        }
    }
}

/// The times of frames, with the decimals of the time from one to the next, but no more than three digits of it.
fn times(frames: &[BeltAlongLoop]) -> Vec<String> {
    let step = match frames {
        [first, second, ..] => second.time - first.time,
        _ => 0.0,
    };
    let is_told = |decimals: &usize| {
        let units = step * 10_f64.powf(*decimals as f64);
        units >= 100.0 || (units > 0.5 && (units - units.round()).abs() < 1e-6 * units)
    };
    let decimals = (0..9).find(is_told).unwrap_or(9);
    let times = frames.iter();
    let times = times.map(|belt| format!("t = {:.decimals$} s", belt.time));
    times.collect()
}

/// The path through places, which reaches some px farther than its end.
fn path(places: &[Spot], farther: f64) -> String {
    let mut places = places.to_vec();
    if let [.., before, last] = &mut places[..] {
        let along = *last - *before;
        if along.norm() > 0.0 {
            *last += farther * along.normalize();
        }
    }
    let places: Vec<_> = places.into_iter().map(pair).collect();
    format!("M {}", places.join(" L "))
}
