//! A sheet of SVG: lines, shapes and text. Places are in px from its left upper corner, y downwards.

use nalgebra::Vector2;
use std::f64::consts::TAU;
use std::fmt::Write;

/// A place or a direction on a sheet, px.
pub(super) type Spot = Vector2<f64>;

/// A colour in SVG.
pub(super) type Color = &'static str;

/// Text and axes.
pub(super) const INK: Color = "#222222";
/// Secondary text and outlines.
pub(super) const GREY: Color = "#777777";
/// Warnings and limits.
pub(super) const VERMILION: Color = "#D55E00";
/// The background.
pub(super) const WHITE: Color = "#FFFFFF";
/// Colours of curves that stand for different things, the most different ones first (Okabe and Ito).
pub(super) const PALETTE: [Color; 7] = [
    VERMILION, "#0072B2", "#009E73", "#882255", "#E69F00", "#56B4E9", "#CC79A7",
];

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

/// A place from its distances to the left and upper edges.
pub(super) fn spot(across: f64, down: f64) -> Spot {
    Spot::new(across, down)
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    /// Colour.
    pub(super) color: Color,
    /// Width, px.
    pub(super) width: f64,
    /// Dashed rather than continuous.
    pub(super) dashed: bool,
}

impl Stroke {
    /// A continuous line.
    pub(super) const fn solid(color: Color, width: f64) -> Self {
        Self {
            color,
            width,
            dashed: false,
        }
    }

    /// A dashed line.
    pub(super) const fn dashed(color: Color, width: f64) -> Self {
        Self {
            dashed: true,
            ..Self::solid(color, width)
        }
    }

    fn attributes(self) -> String {
        let dashes = if self.dashed {
            " stroke-dasharray=\"8 5\""
        } else {
            ""
        };
        let width = length(self.width);
        format!("stroke=\"{}\" stroke-width=\"{width}\"{dashes}", self.color)
    }
}

/// Which side of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Anchor {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
    /// Its middle, with the text running upwards.
    Upward,
}

/// A sheet that is being drawn on.
#[derive(Debug)]
pub(super) struct Sheet {
    /// Width and height, px.
    size: Spot,
    body: String,
}

impl Sheet {
    /// A white sheet of a width and height in px.
    pub(super) fn new(size: Spot) -> Self {
        let mut sheet = Self {
            size: size.map(f64::ceil),
            body: String::new(),
        };
        sheet.rectangle([Spot::zeros(), sheet.size], WHITE, 1.0);
        sheet
    }

    /// The sheet as SVG.
    pub(super) fn finish(self) -> String {
        let [width, height]: [f64; 2] = self.size.into();
        format!(
            "<svg width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
             xmlns=\"http://www.w3.org/2000/svg\" font-family=\"sans-serif\">\n{}</svg>\n",
            self.body
        )
    }

    fn element(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// A line through places; nothing through less than two.
    pub(super) fn line(&mut self, places: &[Spot], stroke: Stroke) {
        let mut path = String::new();
        for (index, place) in places.iter().enumerate() {
            let command = if index == 0 { "M " } else { " L " };
            path += &(command.to_owned() + &pair(*place));
        }
        if places.len() > 1 {
            self.path(&path, stroke);
        }
    }

    /// A line along a path in the language of SVG.
    pub(super) fn path(&mut self, path: &str, stroke: Stroke) {
        let attributes = stroke.attributes();
        self.element(&format!("<path d=\"{path}\" fill=\"none\" {attributes}/>"));
    }

    /// As [`Self::path`], with elements that say how it changes.
    pub(super) fn changing_path(&mut self, path: &str, stroke: Stroke, changes: &str) {
        let attributes = stroke.attributes();
        self.element(&format!(
            "<path d=\"{path}\" fill=\"none\" {attributes}>{changes}</path>"
        ));
    }

    /// What is drawn as a group with an attribute, and elements that say how it changes.
    pub(super) fn group(&mut self, attribute: &str, changes: &str, draw: impl FnOnce(&mut Self)) {
        self.element(&format!("<g {attribute}>"));
        draw(self);
        self.element(&format!("{changes}</g>"));
    }

    /// A rectangle between two corners, of an opacity.
    pub(super) fn rectangle(&mut self, [from, to]: [Spot; 2], color: Color, opacity: f64) {
        let [x, y, width, height] = [from.x, from.y, to.x - from.x, to.y - from.y].map(length);
        self.element(&format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" fill=\"{color}\" \
             fill-opacity=\"{opacity}\"/>"
        ));
    }

    /// A filled circle.
    pub(super) fn disc(&mut self, centre: Spot, radius: f64, color: Color) {
        self.round(centre, radius, &format!("fill=\"{color}\""));
    }

    /// The rim of a circle.
    pub(super) fn rim(&mut self, centre: Spot, radius: f64, stroke: Stroke) {
        let attributes = stroke.attributes();
        self.round(centre, radius, &format!("fill=\"none\" {attributes}"));
    }

    fn round(&mut self, centre: Spot, radius: f64, attributes: &str) {
        let [x, y, radius] = [centre.x, centre.y, radius].map(length);
        self.element(&format!(
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\" {attributes}/>"
        ));
    }

    /// A filled polygon.
    pub(super) fn polygon(&mut self, corners: &[Spot], color: Color) {
        let corners: Vec<_> = corners.iter().map(|corner| pair(*corner)).collect();
        let corners = corners.join(" ");
        self.element(&format!("<polygon points=\"{corners}\" fill=\"{color}\"/>"));
    }

    /// A line of text of a size in px, whose middle is at the height of its place.
    pub(super) fn text(&mut self, text: &str, size: f64, color: Color, anchor: Anchor, at: Spot) {
        // Half the height of digits and capitals in common fonts.
        let half = 0.36 * size;
        let (anchor, turn, baseline) = match anchor {
            Anchor::Start => ("start", "", at + spot(0.0, half)),
            Anchor::Middle => ("middle", "", at + spot(0.0, half)),
            Anchor::End => ("end", "", at + spot(0.0, half)),
            Anchor::Upward => ("middle", "rotate(-90)", spot(-at.y, at.x + half)),
        };
        let [x, y] = [baseline.x, baseline.y].map(length);
        let turn = match turn {
            "" => String::new(),
            turn => format!(" transform=\"{turn}\""),
        };
        self.element(&format!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{color}\" \
             text-anchor=\"{anchor}\"{turn}>{}</text>",
            escaped(&with_minus(text))
        ));
    }
}

/// A length to a tenth of a pixel, without a trailing zero.
fn length(length: f64) -> String {
    format!("{}", (10.0 * length).round() / 10.0 + 0.0)
}

/// A place as two numbers.
pub(super) fn pair(place: Spot) -> String {
    let [x, y] = [place.x, place.y].map(length);
    format!("{x} {y}")
}

/// A text in SVG.
pub(super) fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;");
    text.replace('<', "&lt;").replace('>', "&gt;")
}

/// A text with a minus sign before every negative number, where it has a hyphen. A hyphen within a word stays.
fn with_minus(text: &str) -> String {
    let letters: Vec<_> = text.chars().collect();
    let is = |index: Option<usize>, kind: fn(&char) -> bool| {
        index.and_then(|index| letters.get(index)).is_some_and(kind)
    };
    let mut shown = String::with_capacity(text.len());
    for (index, letter) in letters.iter().enumerate() {
        let [one, two] = [1, 2].map(|back| index.checked_sub(back));
        let in_word = is(one, |letter| letter.is_alphanumeric());
        let exponent = is(one, |letter| *letter == 'e') && is(two, char::is_ascii_digit);
        let negates = is(Some(index + 1), char::is_ascii_digit) && (!in_word || exponent);
        let letter = if *letter == '-' && negates {
            '−'
        } else {
            *letter
        };
        let _ = write!(shown, "{letter}");
    }
    shown
}

/// About the width of a text in the widest of the common sans-serif fonts, `DejaVu` Sans, px.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let width = |letter: char| match letter {
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' | '!' | ' ' => 0.33,
        'f' | 'r' | 't' | '(' | ')' | '[' | ']' | '/' | '-' | '"' | 'J' => 0.41,
        'm' | 'w' | 'M' | 'W' | '—' | '…' | '%' => 1.0,
        letter if letter.is_uppercase() => 0.75,
        letter if letter.is_ascii() => 0.64,
        // Greek, Cyrillic and signs; wide scripts begin further on.
        letter if u32::from(letter) < 0x2E80 => 0.84,
        _ => 1.0,
    };
    size * text.chars().map(width).sum::<f64>()
}

/// As much of a text as fits into a room in px, with an ellipsis where it is cut.
pub(super) fn cut(text: &str, size: f64, room: f64) -> String {
    let mut shown = text.to_owned();
    while text_width(&shown, size) > room && shown.chars().count() > 1 {
        let kept = shown.chars().count().saturating_sub(2);
        shown = shown.chars().take(kept).chain(['…']).collect();
    }
    shown
}

/// The unit vector at an angle on the sheet, rad, clockwise from the right.
pub(super) fn unit(angle: f64) -> Spot {
    let (sin, cos) = (angle % TAU).sin_cos();
    spot(cos, sin)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sheet_has_its_size_and_escapes_text() {
        let mut sheet = Sheet::new(spot(300.0, 199.5));
        sheet.text("a < b & -1", SMALL, INK, Anchor::Start, spot(10.04, 20.0));
        let svg = sheet.finish();
        assert!(svg.starts_with("<svg width=\"300\" height=\"200\" viewBox=\"0 0 300 200\""));
        assert!(svg.contains("x=\"10\"") && svg.contains(">a &lt; b &amp; −1</text>"));
    }

    #[test]
    fn negative_numbers_have_a_minus_sign() {
        let shown = ["-5 N", "1e-7", "T = -3", "V-belt", "SPA-1250", "pump e-7"].map(with_minus);
        assert_eq!(
            shown,
            ["−5 N", "1e−7", "T = −3", "V-belt", "SPA-1250", "pump e-7"]
        );
    }

    #[test]
    fn long_texts_are_cut() {
        assert_eq!(cut("driver", SMALL, 100.0), "driver");
        let shown = cut(&"name ".repeat(20), SMALL, 100.0);
        assert!(shown.ends_with('…') && text_width(&shown, SMALL) <= 100.0);
        assert_eq!(cut("driver", SMALL, 0.0), "…");
    }
}
