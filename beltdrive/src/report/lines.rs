//! Lines of a table for a terminal.

/// No line of a table is wider.
pub(super) const WIDTH: usize = 100;

/// Two values side by side.
pub(super) fn row(label: &str, [left, right]: [String; 2], unit: &str) -> String {
    format!("{label:<26}{left:>28}{right:>28}  {unit}")
}

/// One value.
pub(super) fn single(label: &str, value: String, unit: &str) -> String {
    format!("{label:<26}{value:>28}  {unit}")
}

/// Blocks of lines as a text, parted by empty lines; blocks without lines are left out.
pub(super) fn text(blocks: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = String::new();
    for block in blocks {
        if !text.is_empty() && !block.is_empty() {
            text.push('\n');
        }
        text.extend(block.iter().map(|line| fitted(line) + "\n"));
    }
    text
}

/// The line without blanks at its end, and cut where it is too wide.
fn fitted(line: &str) -> String {
    let line = line.trim_end();
    if line.chars().count() <= WIDTH {
        line.to_owned()
    } else {
        line.chars().take(WIDTH - 1).chain(['…']).collect()
    }
}

/// A small number such as an error, with two digits.
pub(super) fn small(value: f64) -> String {
    format!("{value:.1e}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_parted_and_lines_cut() {
        let long = "a".repeat(101);
        let text = text([vec!["title  ".to_owned()], vec![], vec![long]]);
        assert_eq!(text, format!("title\n\n{}…\n", "a".repeat(99)));
    }
}
