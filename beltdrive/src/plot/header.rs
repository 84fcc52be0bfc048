//! What stands above a figure: what is drawn, what is shown, what to beware of, and the legend.

use super::sheet::{
    Anchor, BODY, Color, GREY, INK, MARGIN, Sheet, Spot, Stroke, TITLE, VERMILION, cut, spot,
    text_width,
};
use crate::quantity::Answer;
use std::iter;

/// Height of a line of the header, of the title and its first caption, and the room round the legend, px.
const LINE: f64 = 20.0;
const FIRST: f64 = 26.0;
const ROOM: f64 = 20.0;

/// What an entry of the legend shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Mark {
    /// A shaded background.
    Shade(Color),
    /// A line.
    Line(Stroke),
    /// A sign at a place.
    Sign(Sign, Color),
}

/// A sign at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sign {
    /// A disc.
    Dot,
    /// Two lines that cross.
    Cross,
    /// A square.
    Square,
}

/// How a shaded background is drawn over white.
pub(super) const TINT: f64 = 0.18;

impl Sign {
    /// Draws the sign.
    pub(super) fn draw(self, sheet: &mut Sheet, at: Spot, color: Color) {
        const SIZE: f64 = 5.0;
        let stroke = Stroke::solid(color, 1.5);
        let corner = |x: f64, y: f64| at + SIZE * spot(x, y);
        match self {
            Self::Dot => sheet.disc(at, super::sheet::DOT, color),
            Self::Cross => {
                for side in [-1.0, 1.0] {
                    sheet.line(&[corner(-1.0, side), corner(1.0, -side)], stroke);
                }
            }
            Self::Square => {
                let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
                let round = corners.iter().chain(&corners[..2]);
                let round: Vec<_> = round.map(|(x, y)| corner(*x, *y)).collect();
                sheet.line(&round, stroke);
            }
        }
    }
}

/// What stands above a figure.
pub(super) struct Header {
    /// Lines of text with their sizes, colours and distances from the last one, px.
    lines: Vec<(String, f64, Color, f64)>,
    /// The entries of the legend with the places where they begin, from the bottom of the text.
    legend: Vec<(String, Mark, Spot)>,
    /// Height of all, px.
    pub(super) height: f64,
}

impl Header {
    /// The header of a figure of an answer on a sheet of a width in px, with what the figure shows, if the
    /// answer does not say it, and its legend.
    pub(super) fn new(
        answer: &Answer,
        caption: &str,
        legend: impl IntoIterator<Item = (String, Mark)>,
        width: f64,
    ) -> Self {
        let room = width - 2.0 * MARGIN;
        let mut heading = answer.heading.iter();
        let title = heading.next().map_or("", String::as_str);
        let captions = iter::once(caption).chain(heading.map(String::as_str));
        let captions = captions.filter(|caption| !caption.is_empty());
        // Captions stand beside each other where they fit.
        let mut lines: Vec<String> = Vec::new();
        for caption in captions {
            let longer = lines.last().map(|line| format!("{line} — {caption}"));
            match (lines.last_mut(), longer) {
                (Some(last), Some(longer)) if text_width(&longer, BODY) <= room => *last = longer,
                _ => lines.extend(broken(caption, BODY, room)),
            }
        }
        let remarks = answer.remarks.iter();
        let warnings = remarks.flat_map(|text| broken(&format!("Warning: {text}"), BODY, room));
        let titles = broken(title, TITLE, room).into_iter();
        let titles = titles.map(|text| (text, TITLE, INK, FIRST));
        let captions = lines.into_iter().enumerate();
        let captions = captions.map(|(index, text)| {
            let advance = if index == 0 { FIRST } else { LINE };
            (text, BODY, GREY, advance)
        });
        let warnings = warnings.map(|text| (text, BODY, VERMILION, LINE));
        let lines: Vec<_> = titles.chain(captions).chain(warnings).collect();
        let mut at = spot(MARGIN, FIRST);
        let mut placed = Vec::new();
        for (label, mark) in legend {
            let label = cut(&label, BODY, room - 38.0);
            let length = 38.0 + text_width(&label, BODY);
            if at.x > MARGIN && at.x + length > width - MARGIN {
                at = spot(MARGIN, at.y + LINE);
            }
            placed.push((label, mark, at));
            at.x += length + 24.0;
        }
        let bottom = if placed.is_empty() { 0.0 } else { at.y };
        let text: f64 = lines.iter().map(|line| line.3).sum();
        Self {
            lines,
            legend: placed,
            height: text + bottom + ROOM,
        }
    }

    /// Writes the header with the legend.
    pub(super) fn draw(&self, sheet: &mut Sheet) {
        let mut bottom = 0.0;
        for (text, size, color, advance) in &self.lines {
            bottom += advance;
            sheet.text(text, *size, color, Anchor::Start, spot(MARGIN, bottom));
        }
        for (label, mark, at) in &self.legend {
            let left = at + spot(0.0, bottom);
            let right = left + spot(30.0, 0.0);
            match *mark {
                Mark::Shade(color) => {
                    let half = spot(0.0, 7.0);
                    sheet.rectangle([left - half, right + half], color, TINT);
                }
                Mark::Line(stroke) => sheet.line(&[left, right], stroke),
                Mark::Sign(sign, color) => sign.draw(sheet, 0.5 * (left + right), color),
            }
            sheet.text(label, BODY, INK, Anchor::Start, right + spot(8.0, 0.0));
        }
    }
}

/// The text on lines that are no wider than the room, px. Words that are wider are cut.
pub(super) fn broken(text: &str, size: f64, room: f64) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.len() - 1;
        let longer = format!("{} {word}", lines[last]);
        let longer = longer.trim_start();
        if lines[last].is_empty() || text_width(longer, size) <= room {
            lines[last] = cut(longer, size, room);
        } else {
            lines.push(cut(word, size, room));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_texts_are_broken() {
        assert_eq!(broken("drive", 10.0, 100.0), ["drive"]);
        let text = "a drive with a very long title";
        let lines = ["a drive", "with a", "very long", "title"];
        assert_eq!(broken(text, 10.0, 55.0), lines);
        assert_eq!(broken("", 10.0, 55.0), [""]);
    }

    #[test]
    fn no_line_of_a_header_is_lost() {
        let answer = Answer {
            heading: vec!["Drive".to_owned(), "Coulomb friction, μ = 0.4".to_owned()],
            remarks: vec!["the belt overhangs itself on the driver".to_owned()],
            ..Answer::default()
        };
        let caption = "Limit of the tight tractive tension over the friction stiffness";
        let legend = || ["driver", "driven"].map(|name| (name.to_owned(), Mark::Shade(INK)));
        let [wide, narrow] =
            [900.0, 600.0].map(|width| Header::new(&answer, caption, legend(), width));
        let texts: Vec<_> = narrow.lines.iter().map(|line| line.0.as_str()).collect();
        assert_eq!(texts[1..3], [caption, &answer.heading[1]]);
        assert!(texts[3].starts_with("Warning: the belt overhangs"));
        assert_eq!((wide.lines.len(), narrow.lines.len()), (3, 4));
        assert_eq!(narrow.height, wide.height + LINE);
        // Entries of the legend that do not stand beside each other stand below each other.
        let thin = Header::new(&answer, "", legend(), 150.0);
        let [one, other] = [0, 1].map(|entry| thin.legend[entry].2);
        assert_eq!(other, one + spot(0.0, LINE));
    }
}
