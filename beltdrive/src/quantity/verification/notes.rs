//! Numbered notes: what is said of several comparisons is said once.

use crate::verify::Comparison;

/// Notes in the order of their numbers.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    texts: Vec<String>,
}

impl Notes {
    /// The number of the note of a comparison, from 1, if it has one.
    pub(crate) fn number(&mut self, comparison: &Comparison) -> Option<usize> {
        let note = comparison.note()?;
        let known = self.texts.iter().position(|text| *text == note);
        Some(
            1 + known.unwrap_or_else(|| {
                self.texts.push(note);
                self.texts.len() - 1
            }),
        )
    }

    /// Notes with numbers above a given one.
    pub(crate) fn after(&self, number: usize) -> impl Iterator<Item = (usize, &str)> {
        let numbered = self.texts.iter().enumerate();
        numbered
            .skip(number)
            .map(|(index, text)| (index + 1, text.as_str()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::{Criterion, Published};

    #[test]
    fn equal_notes_have_one_number() {
        let row = |reason| {
            let criterion = Criterion::known(reason, 1.0, 0.1);
            Comparison::new("", "", Published::new("2"), criterion, Ok(1.0))
        };
        let mut notes = Notes::default();
        let numbers = ["a", "b", "a"].map(|reason| notes.number(&row(reason)));
        assert_eq!(numbers, [Some(1), Some(2), Some(1)]);
        let after: Vec<_> = notes.after(1).collect();
        assert_eq!(after, [(2, "b")]);
        let plain = Comparison::new("", "", Published::new("2"), Criterion::Digits, Ok(2.0));
        assert_eq!(notes.number(&plain), None);
    }
}
