//! One clear error: what is wrong, where, what was expected, and the nearest right spelling.

use super::source::{Excerpt, Source};
use std::{error::Error, fmt, ops::Range};

/// What is wrong with an input, before its place is looked up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Finding {
    message: String,
    range: Range<usize>,
    expected: Option<String>,
    help: Option<String>,
}

impl Finding {
    /// A finding about a byte range of the source.
    pub(super) fn new(range: Range<usize>, message: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            range,
            expected: None,
            help: None,
        }
    }

    /// States what was expected instead.
    pub(super) fn expected(mut self, expected: impl Into<String>) -> Self {
        self.expected = Some(expected.into());
        self
    }

    /// Gives advice.
    pub(super) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Proposes what was probably meant, if anything is near.
    pub(super) fn did_you_mean(self, spelling: Option<impl fmt::Display>) -> Self {
        match spelling {
            Some(spelling) => self.help(format!("did you mean `{spelling}`?")),
            None => self,
        }
    }
}

/// An error in a drive file or an override, with its place.
///
/// Its text has the lines
///
/// ```text
/// error: unknown unit `kNn`
///   --> drive.toml:4:24
///   |
/// 4 | axial_stiffness = "120 kNn"
///   |                        ^^^
/// expected: a force, e.g. "120 kN"
/// help: did you mean `kN`?
/// ```
///
/// the last two where they apply.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    message: String,
    excerpt: Box<Excerpt>,
    expected: Option<String>,
    help: Option<String>,
}

impl Diagnostic {
    pub(super) fn new(finding: Finding, source: &Source) -> Self {
        Self {
            message: finding.message,
            excerpt: Box::new(source.excerpt(finding.range)),
            expected: finding.expected,
            help: finding.help,
        }
    }
}

impl Diagnostic {
    /// What is wrong, without its place.
    pub fn message(&self) -> &str {
        &self.message
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Excerpt {
            name,
            line,
            column,
            text,
            width,
        } = &*self.excerpt;
        let number = line.to_string();
        let gutter = " ".repeat(number.len());
        // Tabs stay, so that the caret stands under its text whatever their width.
        let indent: String = text
            .chars()
            .chain(std::iter::repeat(' '))
            .take(column - 1)
            .map(|c| if c == '\t' { c } else { ' ' })
            .collect();
        writeln!(f, "error: {}", printable(&self.message))?;
        writeln!(f, "{gutter} --> {name}:{line}:{column}")?;
        writeln!(f, "{gutter} |")?;
        writeln!(f, "{number} | {}", printable(text))?;
        write!(f, "{gutter} | {indent}{}", "^".repeat(*width))?;
        if let Some(expected) = &self.expected {
            write!(f, "\nexpected: {}", printable(expected))?;
        }
        if let Some(help) = &self.help {
            write!(f, "\nhelp: {}", printable(help))?;
        }
        Ok(())
    }
}

impl Error for Diagnostic {}

/// The text with control characters, which may not reach a terminal, replaced one for one.
fn printable(text: &str) -> String {
    let replace = |c: char| {
        if c.is_control() && c != '\t' {
            '\u{fffd}'
        } else {
            c
        }
    };
    text.chars().map(replace).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn carets_stand_below_the_text_and_control_characters_are_hidden() {
        let source = Source::new("f.toml", "\n\n\ta = \"\u{1b}x\"", &[]);
        let finding = Finding::new(7..11, "unknown `\u{1b}x`").did_you_mean(Some("y"));
        assert_eq!(
            Diagnostic::new(finding, &source).to_string(),
            "error: unknown `\u{fffd}x`\n  --> f.toml:3:6\n  |\n3 | \ta = \"\u{fffd}x\"\n  \
             | \t    ^^^^\nhelp: did you mean `y`?"
        );
    }
}
