//! A verification as a page in Markdown.

use crate::quantity::verification::{figures, notes::Notes, words};
use crate::verify::{Section, Source, Verdict, Verification};

const INTRODUCTION: &str = "\
Every published number that the program stands on, computed anew. *Agrees to the printed digits*: the \
two differ by at most half a unit of the last digit that is printed. *Agrees within the stated band*: \
where digits are no measure, they differ by at most what is said at the source. *Differs, known why*: \
they differ for the reason in the footnote, and the computed number is the one for which the reason was \
given; should it change, the difference is unexplained again.";

const REPRODUCE: &str = "\
```sh
cargo run --release -p beltdrive -- verify --markdown verification.md
```

The exit status is 1 if a difference is unexplained.";

/// A page: what is compared and how, how to reproduce it, and a table for every section of a source,
/// with the reasons as footnotes.
pub fn markdown(verification: &Verification) -> String {
    let mut notes = Notes::default();
    let mut blocks = vec![
        "# Published results, recomputed".to_owned(),
        INTRODUCTION.to_owned(),
        counts(verification),
        "## How to reproduce".to_owned(),
        format!("With {}:", words::PROGRAM),
        REPRODUCE.to_owned(),
    ];
    for source in &verification.sources {
        blocks.extend(self::source(source, &mut notes));
    }
    let texts = notes.after(0);
    blocks.extend(texts.map(|(number, text)| format!("[^{number}]: {}", capital(text))));
    blocks.join("\n\n") + "\n"
}

/// How many numbers have which verdict.
fn counts(verification: &Verification) -> String {
    let name = |verdict: Verdict| match verdict {
        Verdict::Differs => "differs, unexplained",
        explained => explained.name(),
    };
    let rows = Verdict::ALL
        .map(|verdict| format!("| {} | {} |", name(verdict), verification.count(verdict)));
    format!("| verdict | numbers |\n| --- | ---: |\n{}", rows.join("\n"))
}

fn source(source: &Source, notes: &mut Notes) -> Vec<String> {
    let mut blocks = vec![
        format!("## {}", source.title),
        format!("{}.", source.citation),
        format!("Computed here: {}.", source.method),
    ];
    for section in &source.sections {
        blocks.push(format!("### {}", section.title));
        blocks.push(table(section, notes));
    }
    blocks
}

fn table(section: &Section, notes: &mut Notes) -> String {
    let mut lines = vec![
        "| quantity | unit | published | computed | deviation | relative | verdict |".to_owned(),
        "| --- | --- | ---: | ---: | ---: | ---: | --- |".to_owned(),
    ];
    for comparison in &section.comparisons {
        let note = notes.number(comparison);
        let note = note.map_or_else(String::new, |number| format!("[^{number}]"));
        let cells = [
            comparison.quantity,
            comparison.unit,
            comparison.published.text(),
            &figures::computed(comparison),
            &figures::deviation(comparison),
            &figures::relative(comparison),
            &(comparison.verdict().name().to_owned() + &note),
        ];
        // A bar would end a cell.
        let cells = cells.map(|cell| cell.replace('|', "\\|"));
        lines.push(format!("| {} |", cells.join(" | ")));
    }
    lines.join("\n")
}

/// A sentence from a note.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters
        .next()
        .map(|letter| letter.to_uppercase().to_string());
    format!("{}{}.", first.unwrap_or_default(), letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::verification::sample;

    #[test]
    fn the_page_has_tables_and_footnotes() {
        let text = markdown(&sample::mixed()).replace(words::PROGRAM, "PROGRAM");
        insta::assert_snapshot!(text, @r"
        # Published results, recomputed

        Every published number that the program stands on, computed anew. *Agrees to the printed digits*: the two differ by at most half a unit of the last digit that is printed. *Agrees within the stated band*: where digits are no measure, they differ by at most what is said at the source. *Differs, known why*: they differ for the reason in the footnote, and the computed number is the one for which the reason was given; should it change, the difference is unexplained again.

        | verdict | numbers |
        | --- | ---: |
        | agrees to the printed digits | 2 |
        | agrees within the stated band | 1 |
        | differs, known why | 1 |
        | differs, unexplained | 2 |

        ## How to reproduce

        With PROGRAM:

        ```sh
        cargo run --release -p beltdrive -- verify --markdown verification.md
        ```

        The exit status is 1 if a difference is unexplained.

        ## Author (2001)

        A. Author, A title, a publisher (2001).

        Computed here: closed form.

        ### Table 1, a

        | quantity | unit | published | computed | deviation | relative | verdict |
        | --- | --- | ---: | ---: | ---: | ---: | --- |
        | transition | rad | 2.34 | 2.3435 | +0.0035 | +0.150 % | agrees to the printed digits |
        | driven speed | rad/s | 11.34 | 11.308 | -0.032 | -0.282 % | agrees within the stated band |
        | load | N | 380 | 373.205 | -6.8 | -1.788 % | differs, known why[^1] |
        | wrap angle | ° | 180 | 180 | 0 | +0.000 % | agrees to the printed digits[^2] |

        ## Other (2002)

        O. Other, Another title, a journal (2002).

        Computed here: boundary value problem.

        ### Text

        | quantity | unit | published | computed | deviation | relative | verdict |
        | --- | --- | ---: | ---: | ---: | ---: | --- |
        | load | N | 380 | 373.3 | -6.7 | -1.763 % | differs[^3] |
        | mass flow | kg/s | 2.8 | – | – | – | differs[^4] |

        [^1]: Read off a plot.

        [^2]: Of the driver.

        [^3]: 373.205 ± 0.001 is expected here, and would differ for this reason: read off a plot.

        [^4]: Not computed: no steady state.
        ");
    }

    #[test]
    fn notes_become_sentences() {
        assert_eq!(capital("ω is read off"), "Ω is read off.");
        assert_eq!(capital(""), ".");
    }
}
