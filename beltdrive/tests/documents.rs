//! Every printed block in the README and in `docs` is what the program prints.
//!
//! A code block marked `output` shows what the last command of this program before it prints. A line `…`
//! stands for lines left out; all others must stand in the output, in this order and without gaps. Only
//! times by the clock may differ.
//! `UPDATE_DOCS=1 cargo test -p beltdrive --test documents` writes the blocks again.

use std::{
    collections::HashMap,
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

/// Stands for lines left out.
const LEFT_OUT: &str = "…";
/// What a documented command begins with.
const PROGRAM: &str = "cargo run --release -p beltdrive -- ";

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .parent()
        .unwrap()
        .to_owned()
}

/// The README and all pages of `docs`.
fn documents() -> Vec<PathBuf> {
    let pages = fs::read_dir(root().join("docs")).unwrap();
    let mut documents: Vec<_> = pages.map(|page| page.unwrap().path()).collect();
    documents.retain(|page| page.extension().is_some_and(|extension| extension == "md"));
    documents.push(root().join("README.md"));
    documents.sort();
    documents
}

/// The arguments of a command line; single quotes hold one together.
fn arguments(command: &str) -> Vec<String> {
    let mut arguments = vec![];
    let mut argument: Option<String> = None;
    let mut quoted = false;
    for c in command.chars() {
        match c {
            '\'' => {
                quoted = !quoted;
                argument.get_or_insert_default();
            }
            c if c.is_whitespace() && !quoted => arguments.extend(argument.take()),
            c => argument.get_or_insert_default().push(c),
        }
    }
    assert!(!quoted, "a quote without its end in {command}");
    arguments.extend(argument);
    arguments
}

/// What a command of the program prints on standard output, run in a directory of its own that holds
/// the shipped examples.
fn printed(command: &str) -> Vec<String> {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("documents");
    let examples = directory.join("beltdrive/examples");
    fs::create_dir_all(&examples).unwrap();
    for example in fs::read_dir(root().join("beltdrive/examples")).unwrap() {
        let example = example.unwrap();
        fs::copy(example.path(), examples.join(example.file_name())).unwrap();
    }
    let output = Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args(arguments(command))
        .current_dir(directory)
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    // A requirement that is not met is an answer, too.
    let is_answered = output.status.success() || output.status.code() == Some(3);
    assert!(is_answered, "{command}: {errors}");
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines()
        .map(|line| line.trim_end().to_owned())
        .collect()
}

/// A printed block: its command and the lines of the document that it takes.
struct Block {
    command: String,
    first: usize,
    last: usize,
}

/// The printed blocks of a document.
fn blocks(document: &Path, lines: &[&str]) -> Vec<Block> {
    let mut blocks = vec![];
    let mut command: Option<String> = None;
    let mut open: Option<(&str, usize)> = None;
    for (number, line) in lines.iter().enumerate() {
        let Some(language) = line.strip_prefix("```") else {
            continue;
        };
        let Some((language, first)) = open.replace((language, number + 1)) else {
            continue;
        };
        open = None;
        let inside = &lines[first..number];
        match language {
            "sh" => {
                let commands = inside.join("\n").replace("\\\n", " ");
                let mut last = commands
                    .lines()
                    .filter_map(|line| line.strip_prefix(PROGRAM));
                command = last.next_back().map(str::to_owned);
            }
            "output" => blocks.push(Block {
                command: command.clone().unwrap_or_else(|| {
                    panic!("{}: no command before line {first}", document.display())
                }),
                first,
                last: number,
            }),
            _ => {}
        }
    }
    assert!(
        open.is_none(),
        "{}: a block without an end",
        document.display()
    );
    blocks
}

/// A line without the time that it may end with, by the clock: `time  1.2  ms` or `…, 3.4 s`.
fn timeless(line: &str) -> &str {
    if label(line) == "time" {
        return "time";
    }
    let seconds = line
        .strip_suffix(" s")
        .and_then(|line| line.rsplit_once(", "));
    match seconds {
        Some((before, seconds)) if seconds.parse::<f64>().is_ok() => before,
        _ => line,
    }
}

/// What a line is about: its text up to a wide space.
fn label(line: &str) -> &str {
    line.trim_start().split("  ").next().unwrap_or_default()
}

/// The lines of a block as printed now. Lines between those left out are found by `same`, in order.
fn anew(
    shown: &[&str],
    printed: &[String],
    same: impl Fn(&str, &str) -> bool,
) -> Result<Vec<String>, String> {
    let mut lines: Vec<String> = vec![];
    let mut from = 0;
    let left_out = |line: &&str| line.trim() == LEFT_OUT;
    for (index, run) in shown.split(left_out).enumerate() {
        if index > 0 {
            lines.push(
                shown
                    .iter()
                    .copied()
                    .find(left_out)
                    .unwrap_or(LEFT_OUT)
                    .to_owned(),
            );
        }
        if run.is_empty() {
            continue;
        }
        let is_at = |at: usize| {
            let there = &printed[at..];
            there.len() >= run.len() && run.iter().zip(there).all(|(a, b)| same(a, b))
        };
        let places = match index {
            0 => 0..1,
            _ => from..printed.len(),
        };
        let at = places
            .into_iter()
            .find(|&at| is_at(at))
            .ok_or_else(|| format!("not printed there:\n{}", run.join("\n")))?;
        lines.extend_from_slice(&printed[at..at + run.len()]);
        from = at + run.len();
    }
    if !shown.last().is_some_and(left_out) && from < printed.len() {
        return Err(format!("more is printed:\n{}", printed[from..].join("\n")));
    }
    Ok(lines)
}

#[test]
fn documents_show_what_is_printed() {
    let update = env::var_os("UPDATE_DOCS").is_some();
    let mut outputs: HashMap<String, Vec<String>> = HashMap::new();
    let mut wrong = String::new();
    let mut compared = 0;
    for document in documents() {
        let text = fs::read_to_string(&document).unwrap();
        let mut lines: Vec<&str> = text.lines().collect();
        let blocks = blocks(&document, &lines);
        let mut written = vec![];
        for block in &blocks {
            let command = &block.command;
            let printed = outputs
                .entry(command.clone())
                .or_insert_with(|| printed(command));
            let shown = &lines[block.first..block.last];
            let found = if update {
                anew(shown, printed, |a, b| label(a) == label(b))
            } else {
                anew(shown, printed, |a, b| timeless(a) == timeless(b))
            };
            compared += 1;
            match found {
                Ok(found) => written.push(found),
                Err(reason) => {
                    let (page, line) = (document.display(), block.first + 1);
                    wrong += &format!("{page}:{line}: {command}\n{reason}\n\n");
                    written.push(shown.iter().map(|&line| line.to_owned()).collect());
                }
            }
        }
        if update {
            for (block, new) in blocks.iter().zip(&written).rev() {
                lines.splice(block.first..block.last, new.iter().map(String::as_str));
            }
            fs::write(&document, lines.join("\n") + "\n").unwrap();
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert!(compared >= 5, "only {compared} printed blocks were found");
}

#[test]
fn left_out_lines_are_the_only_gaps() {
    let printed = ["a  1", "b  2", "c  3"].map(str::to_owned);
    let exact = |shown: &[&str]| anew(shown, &printed, |a, b| a == b);
    for shown in [
        &["a  1", "b  2", "c  3"][..],
        &["…", "c  3"],
        &["a  1", "  …"],
        &["a  1", "…", "c  3"],
    ] {
        assert!(exact(shown).is_ok(), "{shown:?}");
    }
    for shown in [
        &["a  1", "c  3"][..],
        &["b  2", "c  3"],
        &["a  1", "b  2"],
        &["…", "c  3", "…", "a  1", "…"],
        &["a  9", "…"],
    ] {
        assert!(exact(shown).is_err(), "{shown:?}");
    }
    let updated = anew(&["…", "b  9", "…"], &printed, |a, b| {
        label(a) == label(b)
    });
    assert_eq!(updated.unwrap(), ["…", "b  2", "…"]);
}

#[test]
fn only_times_by_the_clock_are_ignored() {
    assert_eq!(
        timeless("time        46.1  ms"),
        timeless("time         9.2  ms")
    );
    assert_eq!(timeless("3 steps, 6.6 s"), timeless("3 steps, 0.1 s"));
    for line in ["3 steps, 6.6 N", "a drive, 5 steps", "timely  1"] {
        assert_eq!(timeless(line), line);
    }
}

#[test]
fn quotes_hold_arguments_together() {
    assert_eq!(
        arguments("solve a.toml --set 'load.x=1 N'"),
        ["solve", "a.toml", "--set", "load.x=1 N"]
    );
}
