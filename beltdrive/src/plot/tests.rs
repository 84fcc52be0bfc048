use super::*;
use crate::quantity::branch;
use crate::results::samples;

/// The attribute of a tag.
fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = tag.split_once(&format!(" {name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}

/// Every element that begins ends, every number is one, and every text is on the sheet, its numbers with
/// minus signs.
pub(super) fn check(figure: &str) {
    assert!(figure.starts_with("<svg") && figure.ends_with("</svg>\n"));
    assert!(!figure.contains("NaN") && !figure.contains("inf\""));
    let number = |tag, name| attribute(tag, name).and_then(|text| text.parse::<f64>().ok());
    let mut open: Vec<&str> = Vec::new();
    let sheet = figure.split_once('>').unwrap().0;
    let [width, height] = ["width", "height"].map(|name| number(sheet, name).unwrap());
    for element in figure.split('<').skip(1) {
        let (tag, text) = element.split_once('>').expect("a tag ends");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !tag.ends_with('/') {
            assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
            open.extend(tag.split_whitespace().next());
        }
        if tag.starts_with("text") {
            let [x, y, size] = ["x", "y", "font-size"].map(|name| number(tag, name).unwrap());
            let length = sheet::text_width(text, size);
            let start = match attribute(tag, "text-anchor") {
                Some("start") => x,
                Some("middle") => x - 0.5 * length,
                _ => x - length,
            };
            let is_turned = tag.contains("rotate(-90)");
            let ends = if is_turned {
                [-start - length, -start]
            } else {
                [start, start + length]
            };
            let [along, across] = if is_turned {
                [height, width]
            } else {
                [width, height]
            };
            assert!(
                ends[0] >= 0.0 && ends[1] <= along,
                "{text} from {ends:?} on {along}"
            );
            assert!(
                y - size >= 0.0 && y + 0.3 * size <= across,
                "{text} at {y} on {across}"
            );
            let letters: Vec<_> = text.chars().collect();
            let is_minus = |trio: &[char]| {
                !trio[0].is_alphanumeric() && trio[1] == '-' && trio[2].is_ascii_digit()
            };
            assert!(
                !letters.windows(3).any(is_minus) && !text.starts_with('-'),
                "{text}"
            );
        }
    }
    assert_eq!(open, [""; 0]);
}

#[test]
fn an_empty_answer_has_figures() {
    let mut branch = samples::branch::folded();
    branch.points.clear();
    branch.events.clear();
    check(&rows::figure(&branch::answer(&branch)));
    profiles::figures(&Answer::default()).for_each(|(_, figure)| check(&figure));
}
