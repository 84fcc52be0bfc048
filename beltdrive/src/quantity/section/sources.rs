//! Figures of sections for people, with numbered sources.

use super::super::{Group, Layout, Measure, Quantity, Subject};
use super::OF_ESTIMATE;
use crate::sections::{Figure, Source};
use std::borrow::Cow;

/// Figures below each other, with their range and numbered sources.
pub(super) fn columns(
    figures: impl Iterator<Item = (Cow<'static, str>, Measure, Option<Figure>)>,
    notes: &mut Sources,
) -> Group {
    let heads = ["value", "lowest", "highest", "how known"];
    let mut subjects = heads.map(|head| Subject::new(head, Vec::new()));
    for (label, measure, figure) in figures {
        let Some(figure) = figure else {
            continue;
        };
        let part = |value: Option<f64>| {
            let number = Quantity::number("", label.clone(), measure, value, 0.0);
            Quantity {
                digits: OF_ESTIMATE + 1,
                ..number
            }
        };
        let known = format!("{}: {}", figure.kind.name(), notes.numbers(figure.sources));
        let [value, low, high, how] = &mut subjects;
        value.quantities.push(part(Some(figure.value)));
        low.quantities.push(part(figure.range.map(|[low, _]| low)));
        high.quantities
            .push(part(figure.range.map(|[_, high]| high)));
        how.quantities.push(Quantity::word("", label, known));
    }
    Group::new("", Layout::Columns, subjects.into())
}

/// Sources, numbered in the order in which they are met.
#[derive(Default)]
pub(super) struct Sources(Vec<Source>);

impl Sources {
    /// The numbers of sources.
    pub(super) fn numbers(&mut self, sources: &[Source]) -> String {
        let numbers = sources.iter().map(|source| {
            let known = self.0.iter().position(|other| other == source);
            let index = known.unwrap_or_else(|| {
                self.0.push(*source);
                self.0.len() - 1
            });
            (index + 1).to_string()
        });
        numbers.collect::<Vec<_>>().join(" ")
    }

    /// A line for each source.
    pub(super) fn lines(&self) -> Vec<String> {
        let sources = self.0.iter().enumerate();
        sources
            .map(|(index, source)| {
                format!("{:<4} {}", format!("[{}]", index + 1), source.citation())
            })
            .collect()
    }
}
