//! A report on a drive: one page in HTML with all that stands behind it, to read, to print and to hand in.
//!
//! The page holds its style and its figures and needs nothing from anywhere else.

mod case;

use crate::CheckedService;
use crate::input::FilledIn;
use crate::quantity::{self, UnitSystem, section};
use crate::report::tables;
use crate::uncertainty::Uncertainty;
use case::case;
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("style.css");

/// What a report was made from.
#[derive(Clone, Copy, Debug)]
pub struct Made<'a> {
    /// Name of the drive file.
    pub name: &'a str,
    /// The drive file as it was read.
    pub text: &'a str,
    /// The entries that were overridden, as `key=value`.
    pub overrides: &'a [String],
    /// What the file takes from a belt section, if it does.
    pub filled_in: Option<&'a FilledIn>,
    /// The command line that made it.
    pub command_line: &'a str,
}

/// The load cases of a drive with their verdicts, and how far their numbers may be from their values, as a page in HTML,
/// with numbers in the units of a system.
#[must_use]
pub fn report(
    checked: &CheckedService,
    spread: &Uncertainty,
    made: &Made<'_>,
    units: UnitSystem,
) -> String {
    let answer = quantity::check::answer(checked);
    let answer = quantity::uncertainty::told_in(answer, spread, &checked.service.cases);
    let answer = match made.filled_in {
        Some(filled_in) => section::told_in(answer, filled_in),
        None => answer,
    };
    // The title, what the drive is, and after an empty line the verdicts.
    let mut heading = answer.heading.iter();
    let title = heading.next().map_or("Belt drive", String::as_str);
    let about: Vec<_> = heading
        .by_ref()
        .take_while(|line| !line.is_empty())
        .collect();
    let verdicts: Vec<_> = heading.collect();
    let drawn = quantity::check::drawn(checked);
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="generator" content=(PROGRAM);
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { (title) }
                    @for line in about { p.about { (line) } }
                }
                section {
                    h2 { "Does it hold?" }
                    @for line in verdicts { (verdict(line)) }
                    @for remark in &answer.remarks { p.warning { (remark) } }
                    (tables(&answer, units))
                    @for note in &answer.notes { p.about { (note) } }
                }
                @for (number, answer) in &drawn {
                    @let index = number - 1;
                    (case(&checked.service.cases[index], &checked.cases[index], answer, units))
                }
                (inputs(made))
                (again(made))
                footer { "Made by " (PROGRAM) "." }
            }
        }
    };
    page.into_string()
}

/// The program with its version.
const PROGRAM: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// A line of the verdict.
fn verdict(line: &str) -> Markup {
    let fails = line.contains("FAILS");
    html! { p class={ "verdict " (if fails { "fails" } else { "holds" }) } { (line) } }
}

/// What was given.
fn inputs(made: &Made<'_>) -> Markup {
    html! {
        section {
            h2 { "What was given" }
            p { "The drive file " code { (made.name) } ", with the sources of its numbers as it states them:" }
            pre { (made.text) }
            @if !made.overrides.is_empty() {
                p { "For this report these entries were set:" }
                pre { (made.overrides.join("\n")) }
            }
        }
    }
}

/// How the report is made again.
fn again(made: &Made<'_>) -> Markup {
    html! {
        section {
            h2 { "How to make it again" }
            p { "With " (PROGRAM) " and the drive file above saved as " code { (made.name) } ":" }
            pre { (made.command_line) }
        }
    }
}
