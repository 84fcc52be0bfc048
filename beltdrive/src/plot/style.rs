//! What all figures have in common: canvas, colours and text.

use crate::{SteadyState, ZoneKind};
use plotters::coord::{CoordTranslate, Shift};
use plotters::drawing::DrawingAreaErrorKind;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::io;

/// The sheet or a rectangular part of it.
pub(super) type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Whether drawing succeeded.
pub(super) type Drawn = Result<(), DrawingAreaErrorKind<io::Error>>;

/// Text and axes.
pub(super) const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
/// Secondary text and outlines.
pub(super) const GREY: RGBColor = RGBColor(0x77, 0x77, 0x77);
/// The second curve of a figure.
pub(super) const WINE: RGBColor = RGBColor(0x88, 0x22, 0x55);
/// Warnings and limits.
pub(super) const VERMILION: RGBColor = RGBColor(0xD5, 0x5E, 0x00);
/// A third curve.
pub(super) const BLUE: RGBColor = RGBColor(0x00, 0x72, 0xB2);
const GREEN: RGBColor = RGBColor(0x00, 0x9E, 0x73);
const ORANGE: RGBColor = RGBColor(0xE6, 0x9F, 0x00);

/// Sizes of text, px.
pub(super) const TITLE: f64 = 20.0;
/// Size of the text that accompanies a figure, px.
pub(super) const BODY: f64 = 14.0;
/// Size of the text at ticks, px.
pub(super) const SMALL: f64 = 12.0;

/// Empty space at the left and right edges of a figure, px.
pub(super) const MARGIN: f64 = 24.0;

/// Radius of a dot that marks a point of a curve, px.
pub(super) const DOT: f64 = 4.5;

/// The backend knows whole units only; a pixel has this many of them, so that curves are smooth.
const UNITS: f64 = 10.0;

/// A length in units of the backend from one in pixels.
#[expect(
    clippy::cast_possible_truncation,
    reason = "a sheet has far fewer units than i32 holds"
)]
pub(super) fn px(length: f64) -> i32 {
    (length * UNITS).round() as i32
}

/// A place in px from one in units of the backend.
pub(super) fn in_px((across, down): (i32, i32)) -> [f64; 2] {
    [across, down].map(|length| f64::from(length) / UNITS)
}

/// Width and height of a sheet or a part of it, px.
pub(super) fn size(canvas: &Canvas<'_>) -> [f64; 2] {
    let (width, height) = canvas.dim_in_pixel();
    [width, height].map(|length| f64::from(length) / UNITS)
}

/// A sheet of a width and height in px with what `draw` puts on it, as SVG.
///
/// # Panics
/// Never: drawing into memory does not fail, and the layouts leave room for every label.
pub(super) fn render([width, height]: [f64; 2], draw: impl FnOnce(&Canvas<'_>) -> Drawn) -> String {
    let mut svg = String::new();
    let units = [width, height].map(|length| px(length).unsigned_abs());
    {
        let canvas = SVGBackend::with_string(&mut svg, units.into()).into_drawing_area();
        canvas
            .fill(&WHITE)
            .and_then(|()| draw(&canvas))
            .and_then(|()| canvas.present())
            .expect("a drawing in memory, with room for its labels");
    }
    let size = |[width, height]: [String; 2]| format!("width=\"{width}\" height=\"{height}\"");
    let shown = size([width, height].map(|length| length.to_string()));
    svg.replacen(&size(units.map(|length| length.to_string())), &shown, 1)
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stroke {
    /// Colour.
    pub(super) color: RGBColor,
    /// Width, px.
    pub(super) width: f64,
    /// Dashed rather than continuous.
    pub(super) dashed: bool,
}

impl Stroke {
    /// A continuous line.
    pub(super) const fn solid(color: RGBColor, width: f64) -> Self {
        Self {
            color,
            width,
            dashed: false,
        }
    }

    /// A dashed line.
    pub(super) const fn dashed(color: RGBColor, width: f64) -> Self {
        Self {
            color,
            width,
            dashed: true,
        }
    }

    /// The style of the line in the backend.
    pub(super) fn shape(self) -> ShapeStyle {
        self.color.stroke_width(px(self.width).unsigned_abs())
    }

    /// Draws the line through points.
    pub(super) fn draw<C: CoordTranslate>(
        self,
        area: &DrawingArea<SVGBackend<'_>, C>,
        points: Vec<C::From>,
    ) -> Drawn
    where
        C::From: Clone,
    {
        if self.dashed {
            let [dash, gap] = [8.0, 5.0].map(px);
            area.draw(&DashedPathElement::new(points, dash, gap, self.shape()))
        } else {
            area.draw(&PathElement::new(points, self.shape()))
        }
    }
}

/// Name and colour of a kind of zone.
pub(super) fn zone(kind: ZoneKind) -> (&'static str, RGBColor) {
    match kind {
        ZoneKind::Elastic => ("elastic zone", BLUE),
        ZoneKind::Slip => ("slip zone", ORANGE),
        ZoneKind::Adhesion => ("adhesion zone", GREEN),
        ZoneKind::Creep => ("creep zone", WINE),
    }
}

/// The kinds of zones that occur in a state.
pub(super) fn kinds(state: &SteadyState) -> impl Iterator<Item = ZoneKind> {
    let occurs = |kind: &ZoneKind| {
        [&state.driver, &state.driven]
            .iter()
            .any(|pulley| pulley.zones.iter().any(|zone| zone.kind == *kind))
    };
    ZoneKind::ALL.into_iter().filter(occurs)
}

/// The background colour of a zone.
pub(super) fn tint(kind: ZoneKind) -> ShapeStyle {
    zone(kind).1.mix(0.18).filled()
}

/// A text style: size in px, colour, anchor.
pub(super) fn face(size: f64, color: RGBColor, anchor: HPos) -> TextStyle<'static> {
    // The backend divides sizes by this factor.
    let font = FontDesc::new(
        FontFamily::SansSerif,
        size * UNITS * 1.24,
        FontStyle::Normal,
    );
    font.color(&color).pos(Pos::new(anchor, VPos::Center))
}

/// Writes a line of text at a position in px, vertically centred on it.
pub(super) fn write(canvas: &Canvas<'_>, text: &str, style: &TextStyle<'_>, at: [f64; 2]) -> Drawn {
    canvas.draw_text(text, style, at.map(px).into())
}

/// A number as it is written in figures: with a minus sign, not a hyphen.
pub(super) fn number(text: &str) -> String {
    text.replace('-', "−")
}

/// About the width that a text takes in common sans-serif fonts, px.
pub(super) fn text_width(characters: usize, size: f64) -> f64 {
    0.55 * size * characters as f64
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{sample, sample_flat};

    #[test]
    fn the_sheet_has_its_size_in_pixels() {
        let svg = render([300.0, 200.0], |_| Ok(()));
        assert!(svg.starts_with("<svg width=\"300\" height=\"200\" viewBox=\"0 0 3000 2000\""));
    }

    #[test]
    fn kinds_of_zones_are_those_present() {
        assert_eq!(kinds(&sample::loaded()).count(), 2);
        assert_eq!(kinds(&sample::idle()).count(), 0);
        let adhesion: Vec<_> = kinds(&sample_flat::coulomb()).collect();
        assert_eq!(adhesion, [ZoneKind::Adhesion, ZoneKind::Slip]);
        let names = ZoneKind::ALL.map(|kind| zone(kind).0);
        assert_eq!(
            names,
            ["elastic zone", "adhesion zone", "creep zone", "slip zone"]
        );
    }
}
