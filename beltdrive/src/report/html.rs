//! An answer as a piece of a page in HTML.

use super::cells::{NONE, cell, shown, unit};
use crate::quantity::{Answer, Group, Layout, Quantity, Subject, UnitSystem, Value};
use maud::{Markup, html};

/// Columns beside each other that fit a page of paper with labels and units.
const COLUMNS: usize = 4;

/// An answer as a piece of a page in HTML, in the units of a system: its first line as a heading, remarks, tables and
/// notes, without a style.
#[must_use]
pub fn html(answer: &Answer, units: UnitSystem) -> String {
    let mut heading = answer.heading.iter();
    let piece = html! {
        div.beltdrive {
            @if let Some(title) = heading.next() { p { strong { (title) } } }
            @for line in heading.filter(|line| !line.is_empty()) { p { (line) } }
            @for remark in &answer.remarks { p.warning { "WARNING: " (remark) } }
            (tables(answer, units))
            @for note in &answer.notes { p { (note) } }
        }
    };
    piece.into_string()
}

/// The groups of an answer as tables, in the units of a system: what a table for a terminal shows, without heading,
/// remarks and notes.
pub(crate) fn tables(answer: &Answer, units: UnitSystem) -> Markup {
    html! {
        @for group in &answer.groups {
            @for subjects in beside(group) {
                (table(group.layout, subjects, units))
            }
        }
    }
}

/// The subjects of a group that share a table.
fn beside(group: &Group) -> impl Iterator<Item = &[Subject]> {
    let together = match group.layout {
        Layout::Columns | Layout::Beside | Layout::Named => COLUMNS,
        Layout::Single | Layout::Rows => usize::MAX,
    };
    group.subjects.chunks(together)
}

/// Subjects as the columns or the rows of a table; nothing if there is nothing to read.
fn table(layout: Layout, subjects: &[Subject], units: UnitSystem) -> Markup {
    let subjects: Vec<_> = subjects.iter().map(shown).collect();
    match layout {
        Layout::Rows => rows(&subjects, units),
        _ => columns(&subjects, units),
    }
}

/// Subjects beside each other. What none of them has is left out.
fn columns(subjects: &[(&str, Vec<Quantity>)], units: UnitSystem) -> Markup {
    let first = subjects.first().into_iter().flat_map(|(_, first)| first);
    let lines = first.enumerate().filter_map(|(place, quantity)| {
        let of_all = subjects.iter().map(|(_, quantities)| &quantities[place]);
        let cells: Vec<_> = of_all.map(|quantity| cell(quantity, units)).collect();
        let is_known = cells.iter().any(|cell| cell != NONE);
        is_known.then_some((quantity, cells))
    });
    let lines: Vec<_> = lines.collect();
    if lines.is_empty() {
        return html! {};
    }
    html! {
        table {
            @if subjects.iter().any(|(head, _)| !head.is_empty()) {
                thead { tr {
                    th {}
                    @for (head, _) in subjects { th scope="col" { (head) } }
                    th {}
                } }
            }
            tbody {
                @for (quantity, cells) in &lines {
                    tr {
                        th scope="row" class=[is_part(quantity).then_some("part")] { (quantity.label.trim()) }
                        @for cell in cells { td { (cell) } }
                        td.unit { (unit(quantity, units)) }
                    }
                }
            }
        }
    }
}

/// Subjects below each other, under the labels and units of their quantities.
fn rows(subjects: &[(&str, Vec<Quantity>)], units: UnitSystem) -> Markup {
    let Some((_, first)) = subjects.first().filter(|(_, first)| !first.is_empty()) else {
        return html! {};
    };
    html! {
        table.rows {
            thead {
                tr {
                    @for quantity in first {
                        th scope="col" class=[is_word(quantity).then_some("word")] { (quantity.label.trim()) }
                    }
                }
                tr { @for quantity in first { th.unit { (unit(quantity, units)) } } }
            }
            tbody {
                @for (_, quantities) in subjects {
                    tr {
                        @for quantity in quantities {
                            td class=[is_word(quantity).then_some("word")] { (cell(quantity, units)) }
                        }
                    }
                }
            }
        }
    }
}

/// Whether the values of a quantity are words.
fn is_word(quantity: &Quantity) -> bool {
    matches!(quantity.value, Value::Word(_))
}

/// Whether a label goes on with what stands above it.
fn is_part(quantity: &Quantity) -> bool {
    quantity.label.starts_with(' ')
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::Measure;

    #[test]
    fn quantities_are_lines_with_units_and_texts_are_escaped() {
        let torque = |value| Quantity::number("torque", "torque", Measure::Torque, value, 0.01);
        let name = |name: &str| Quantity::word("name", "  at", name.to_owned());
        let secret = Quantity::data("only_programs", Measure::Number, Value::Count(1));
        let subject = |head: &str, value| {
            Subject::new(head, vec![torque(value), name("<fan>"), secret.clone()])
        };
        let group = Group::new(
            "pulleys",
            Layout::Columns,
            vec![subject("a", 1.5), subject("b", -2.0)],
        );
        let answer = Answer {
            groups: vec![group],
            ..Answer::default()
        };
        let text = tables(&answer, UnitSystem::Engineering).into_string();
        let lines = [
            "<th></th><th scope=\"col\">a</th><th scope=\"col\">b</th><th></th>",
            "<th scope=\"row\">torque</th><td>1.50</td><td>−2.00</td><td class=\"unit\">N·m</td>",
            "<th scope=\"row\" class=\"part\">at</th><td>&lt;fan&gt;</td>",
        ];
        for line in lines {
            assert!(text.contains(line), "{text}");
        }
        assert!(!text.contains("only_programs"));
    }
}
