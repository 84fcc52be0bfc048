//! The texts an input consists of, and places in them.

use std::ops::Range;

/// What the command line is called as a source.
const COMMAND_LINE: &str = "command line";

/// A drive file and the overrides of its command line, laid end to end, so that a byte range tells
/// where anything stands.
#[derive(Clone, Debug)]
pub(super) struct Source {
    name: String,
    /// The file, a line feed, and a line `--set KEY=VALUE` for every override.
    text: String,
    /// Length of the file.
    file_length: usize,
    override_starts: Vec<usize>,
}

/// A place in a source, ready to be shown.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Excerpt {
    /// Name of the file, or `command line`.
    pub(super) name: String,
    /// Number of the line, from 1.
    pub(super) line: usize,
    /// Number of the first character in its line, from 1.
    pub(super) column: usize,
    /// The whole line.
    pub(super) text: String,
    /// Number of characters, at least 1.
    pub(super) width: usize,
}

impl Source {
    pub(super) fn new(name: &str, file: &str, overrides: &[String]) -> Self {
        const OPTION: &str = "--set ";
        let mut text = format!("{file}\n");
        let mut override_starts = Vec::with_capacity(overrides.len());
        for entry in overrides {
            override_starts.push(text.len() + OPTION.len());
            text.extend([OPTION, entry, "\n"]);
        }
        Self {
            name: name.to_owned(),
            text,
            file_length: file.len(),
            override_starts,
        }
    }

    /// One option of a command line, with its value after a blank.
    pub(super) fn argument(option: &str, value: &str) -> Self {
        Self::new(COMMAND_LINE, &format!("{option} {value}"), &[])
    }

    /// Where the text of each override starts.
    pub(super) fn override_starts(&self) -> impl Iterator<Item = usize> {
        self.override_starts.iter().copied()
    }

    /// The text of the file, without overrides.
    pub(super) fn file(&self) -> &str {
        &self.text[..self.file_length]
    }

    /// The text of a range; empty for a range that is none of this source.
    pub(super) fn text(&self, range: Range<usize>) -> &str {
        self.text.get(range).unwrap_or_default()
    }

    /// Finds the line and column of a range.
    pub(super) fn excerpt(&self, range: Range<usize>) -> Excerpt {
        let (name, base) = if range.start <= self.file_length {
            (self.name.as_str(), 0)
        } else {
            (COMMAND_LINE, self.file_length + 1)
        };
        let start = range.start.min(self.text.len());
        let before = self.text(base..start);
        let line_start = before.rfind('\n').map_or(base, |feed| base + feed + 1);
        let text = self.text(line_start..self.text.len());
        let text = text.lines().next().unwrap_or_default();
        let end = range.end.min(line_start + text.len());
        Excerpt {
            name: name.to_owned(),
            line: before.matches('\n').count() + 1,
            column: self.text(line_start..start).chars().count() + 1,
            text: text.to_owned(),
            width: self.text(start..end).chars().count().max(1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_found_in_file_and_overrides() {
        let overrides = ["a=1".to_owned(), "ß=2".to_owned()];
        let source = Source::new("f.toml", "[x]\nµ = 3\n", &overrides);
        let excerpt = source.excerpt(9..10);
        assert_eq!((excerpt.line, excerpt.column, excerpt.width), (2, 5, 1));
        assert_eq!(
            (excerpt.name.as_str(), excerpt.text.as_str()),
            ("f.toml", "µ = 3")
        );
        let starts: Vec<_> = source.override_starts().collect();
        let excerpt = source.excerpt(starts[1]..starts[1] + 2);
        assert_eq!((excerpt.line, excerpt.column, excerpt.width), (2, 7, 1));
        assert_eq!(
            (excerpt.name.as_str(), excerpt.text.as_str()),
            ("command line", "--set ß=2")
        );
    }

    #[test]
    fn the_end_of_the_file_and_what_lies_beyond_are_places() {
        let source = Source::new("f.toml", "[x]", &[]);
        let excerpt = source.excerpt(3..3);
        assert_eq!((excerpt.line, excerpt.column, excerpt.width), (1, 4, 1));
        assert_eq!(Source::new("f.toml", "", &[]).excerpt(0..9).width, 1);
        source.excerpt(70..80);
    }
}
