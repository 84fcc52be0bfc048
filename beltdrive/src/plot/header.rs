//! What stands above a figure: the drive, what is shown, what to beware of, and the legend.

use super::style::{self, BODY, Canvas, DOT, Drawn, GREY, INK, MARGIN, Stroke, TITLE, VERMILION};
use super::style::{face, px, text_width, write};
use crate::belt_loop::BeltLoop;
use crate::input::Key;
use crate::quantity::{Answer, belt_loop as loop_words};
use crate::report::{convention, folded, heading, law, warning};
use crate::{Drive, SteadyState};
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use std::{io, iter};

/// Height of a further line of the header, px.
const LINE: f64 = 20.0;

/// An entry of the legend.
pub(super) enum Legend {
    /// A shaded background.
    Shade(&'static str, ShapeStyle),
    /// A line.
    Line(&'static str, Stroke),
    /// A dot.
    Dot(&'static str, RGBColor),
}

/// What stands above a figure.
pub(super) struct Header {
    /// What is drawn.
    title: String,
    /// What the figure shows, and the friction law or the kind of loop: on one line if they fit.
    captions: Vec<String>,
    /// The convention of the normal force, if there is a choice.
    convention: Option<&'static str>,
    /// What to beware of.
    warnings: Vec<String>,
}

impl Header {
    /// The header of a figure of a drive, some keys of which vary in it.
    pub(super) fn new(drive: &Drive, varied: &[Key], caption: &str) -> Self {
        Self {
            title: heading(drive),
            captions: vec![caption.to_owned(), law(drive, varied)],
            convention: convention(drive),
            warnings: vec![],
        }
    }

    /// The header of a figure of one state.
    pub(super) fn of(state: &SteadyState, caption: &str) -> Self {
        Self {
            warnings: state.warnings.iter().map(warning).collect(),
            ..Self::new(&state.drive, &[], caption)
        }
    }

    /// The header of a figure of a belt loop.
    pub(super) fn of_loop(belt_loop: &BeltLoop, caption: &str) -> Self {
        let mut lines = loop_words::heading(belt_loop).into_iter();
        Self {
            title: lines.next().unwrap_or_default(),
            captions: iter::once(caption.to_owned()).chain(lines).collect(),
            convention: None,
            warnings: vec![],
        }
    }

    /// The header of a figure of an answer.
    pub(super) fn of_answer(answer: &Answer) -> Self {
        let mut lines = answer.heading.iter().cloned();
        Self {
            title: lines.next().unwrap_or_default(),
            captions: lines.collect(),
            convention: None,
            warnings: answer.remarks.clone(),
        }
    }

    /// Its height with the legend on a sheet of a width, px.
    pub(super) fn height(&self, width: f64) -> f64 {
        let lines = self.lines(width);
        46.0 + lines.iter().map(|line| line.advance).sum::<f64>()
    }

    /// Its lines of text on a sheet of a width, px.
    fn lines(&self, width: f64) -> Vec<HeaderLine> {
        let room = width - 2.0 * MARGIN;
        let line = |size, color, advance| {
            move |text| HeaderLine {
                text,
                size,
                color,
                advance,
            }
        };
        let title = broken(&self.title, TITLE, room);
        let together = self.captions.join(" — ");
        let captions = if text_width(together.chars().count(), BODY) <= room {
            vec![together]
        } else {
            let captions = self.captions.iter();
            captions.flat_map(|text| broken(text, BODY, room)).collect()
        };
        let convention = self.convention.map(|text| broken(text, BODY, room));
        let warnings = self.warnings.iter();
        let warnings = warnings.flat_map(|text| broken(&format!("Warning: {text}"), BODY, room));
        let mut lines: Vec<_> = title.into_iter().map(line(TITLE, INK, 26.0)).collect();
        let first = lines.len();
        lines.extend(captions.into_iter().map(line(BODY, GREY, LINE)));
        lines[first].advance = 26.0;
        lines.extend(convention.into_iter().flatten().map(line(BODY, GREY, LINE)));
        lines.extend(warnings.map(line(BODY, VERMILION, LINE)));
        lines
    }

    /// Writes the header with the legend.
    pub(super) fn draw(&self, canvas: &Canvas<'_>, legend: &[Legend]) -> Drawn {
        let [width, _] = style::size(canvas);
        let mut bottom = 0.0;
        for line in self.lines(width) {
            bottom += line.advance;
            let face = face(line.size, line.color, HPos::Left);
            write(canvas, &line.text, &face, [MARGIN, bottom])?;
        }
        bottom += 26.0;
        let mut left = MARGIN;
        for item in legend {
            left = entry(canvas, item, [left, bottom])?;
        }
        Ok(())
    }
}

/// A line of a header: text, its size, its colour, and how far below the last one it stands, px.
struct HeaderLine {
    text: String,
    size: f64,
    color: RGBColor,
    advance: f64,
}

/// Draws an entry of the legend and returns where the next one begins, px.
fn entry(
    canvas: &Canvas<'_>,
    legend: &Legend,
    [left, middle]: [f64; 2],
) -> Result<f64, DrawingAreaErrorKind<io::Error>> {
    let right = left + 30.0;
    let label = match legend {
        Legend::Shade(label, style) => {
            let corners = [[left, middle - 7.0], [right, middle + 7.0]];
            canvas.draw(&Rectangle::new(
                corners.map(|corner| corner.map(px).into()),
                *style,
            ))?;
            label
        }
        Legend::Line(label, stroke) => {
            stroke.draw(
                canvas,
                vec![(px(left), px(middle)), (px(right), px(middle))],
            )?;
            label
        }
        Legend::Dot(label, color) => {
            let centre = [0.5 * (left + right), middle].map(px);
            canvas.draw(&Circle::new(centre.into(), px(DOT), color.filled()))?;
            label
        }
    };
    write(
        canvas,
        label,
        &face(BODY, INK, HPos::Left),
        [right + 8.0, middle],
    )?;
    Ok(right + 32.0 + text_width(label.chars().count(), BODY))
}

/// The text on lines that are no wider than the room, px.
fn broken(text: &str, size: f64, room: f64) -> Vec<String> {
    let fits = (1..=text.chars().count()).take_while(|&count| text_width(count, size) <= room);
    folded(text, fits.last().unwrap_or(1), 0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Warning;
    use crate::report::sample_flat;

    #[test]
    fn long_titles_are_broken() {
        assert_eq!(broken("drive", 10.0, 100.0), ["drive"]);
        let text = "a drive with a very long title";
        let lines = ["a drive", "with a", "very long", "title"];
        assert_eq!(broken(text, 10.0, 55.0), lines);
        assert_eq!(broken("", 10.0, 55.0), [""]);
    }

    #[test]
    fn no_line_of_a_header_is_lost() {
        let mut state = sample_flat::epp();
        let caption = "Limit of the tight tractive tension over the friction stiffness";
        let header = Header::of(&state, caption);
        let [wide, narrow] = [1100.0, 900.0].map(|width| header.lines(width));
        let texts: Vec<_> = narrow.iter().map(|line| line.text.as_str()).collect();
        assert_eq!(texts[1], caption);
        assert_eq!(texts[2], law(&state.drive, &[]));
        assert_eq!((wide.len(), narrow.len()), (3, 4));
        assert_eq!(header.height(900.0), header.height(1100.0) + LINE);
        state.warnings = vec![Warning::LargeStrain { strain: 0.1 }];
        let lines = Header::of(&state, caption).lines(700.0);
        assert!(lines.last().unwrap().text.ends_with("\"exact\""));
    }
}
