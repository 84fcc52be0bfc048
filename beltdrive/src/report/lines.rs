//! Lines of a table for a terminal.

/// No line of a table is wider.
pub(crate) const WIDTH: usize = 100;

/// The indentation of what is folded, where nothing else is said.
const INDENT: usize = 4;

/// Blocks of lines as a text, parted by empty lines; blocks without lines are left out.
pub(super) fn text(blocks: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = String::new();
    for block in blocks {
        if !text.is_empty() && !block.is_empty() {
            text.push('\n');
        }
        let lines = block.iter().flat_map(|line| folded(line, WIDTH, INDENT));
        text.extend(lines.map(|line| line + "\n"));
    }
    text
}

/// A text on lines that fit; the first has a label, and the others are indented by its width.
pub(super) fn wrapped(label: &str, text: &str) -> Vec<String> {
    let words: Vec<_> = text.split_whitespace().collect();
    let line = label.to_owned() + &words.join(" ");
    folded(&line, WIDTH, label.chars().count())
}

/// The line without blanks at its end, folded between words where it is wider than so many characters;
/// what is folded is indented. Only a word that is too wide by itself is broken.
pub(crate) fn folded(line: &str, width: usize, indent: usize) -> Vec<String> {
    let indent = indent.min(width / 2);
    let mut lines = Vec::new();
    let mut rest: Vec<char> = line.trim_end().chars().collect();
    while rest.len() > width {
        let text = rest.iter().take_while(|letter| **letter == ' ').count();
        let mut places = (indent.max(text) + 1..=width).rev();
        let place = places.find(|place| rest[*place] == ' ').unwrap_or(width);
        let line: String = rest[..place].iter().collect();
        lines.push(line.trim_end().to_owned());
        let folded = rest[place..].iter().skip_while(|letter| **letter == ' ');
        rest = std::iter::repeat_n(&' ', indent)
            .chain(folded)
            .copied()
            .collect();
    }
    lines.push(rest.into_iter().collect());
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_parted_and_lines_folded() {
        let long = "a".repeat(101);
        let text = text([vec!["title  ".to_owned()], vec![], vec![long]]);
        assert_eq!(text, format!("title\n\n{}\n    a\n", "a".repeat(100)));
    }

    #[test]
    fn long_texts_are_wrapped() {
        let lines = wrapped("[1]  ", &"word\n ".repeat(40));
        assert!(lines.len() == 3 && lines.iter().all(|line| line.chars().count() <= WIDTH));
        assert!(lines[0].starts_with("[1]  word word") && lines[1].starts_with("     word"));
        let words = lines.iter().flat_map(|line| line.split_whitespace());
        assert_eq!(words.count(), 41);
    }

    #[test]
    fn lines_are_folded_between_words() {
        assert_eq!(folded("µ is  small ", 11, 2), ["µ is  small"]);
        assert_eq!(
            folded("  one  two  three", 9, 3),
            ["  one", "   two", "   three"]
        );
        assert_eq!(
            folded("unbreakable", 4, 9),
            ["unbr", "  ea", "  ka", "  bl", "  e"]
        );
        assert_eq!(folded("", 4, 0), [""]);
    }
}
