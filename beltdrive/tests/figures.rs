//! Every figure in `docs` is what the program draws.
//!
//! Places in a figure may differ by some tenths of a pixel, words may not.
//! `UPDATE_DOCS=1 cargo test -p beltdrive --test figures` writes the figures again; the slow ones with
//! `-- --ignored`.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// Name of a figure in `docs`, and the file and the command that draw it.
type Figure = (&'static str, &'static str, &'static str);

/// The figures that take no time.
const FIGURES: [Figure; 12] = [
    ("serpentine-loop", "loop", "solve serpentine"),
    ("kim2009-drive", "drive", "solve kim2009"),
    ("kim2009-tension", "tension", "solve kim2009"),
    ("kim2009-flat-drive", "drive", "solve kim2009-flat"),
    (
        "kim2009-flat-friction",
        "friction_force",
        "solve kim2009-flat",
    ),
    (
        "kim2009-flat-soft",
        "friction_force",
        "solve kim2009-flat --set model.normal_force=exact --set friction.stiffness=1e6 --set load.tight_tension=4000",
    ),
    (
        "kim2009-stiffness",
        "branch",
        "trace kim2009-epp --set friction.epp.kind=vector --parameter friction.stiffness --from 1e6 --to 1e9",
    ),
    (
        "kim2009-flat-branch",
        "branch",
        "trace kim2009-flat --parameter load.tight_tension --from 210 --to 9000",
    ),
    (
        "flat-bench-residuals",
        "residuals",
        "calibrate flat-bench --data beltdrive/examples/flat-bench.csv",
    ),
    (
        "kim2009-modes",
        "modes",
        "stability kim2009-flat --set model.normal_force=thesis --set load.tight_tension=2kN",
    ),
    (
        "kim2009-spectrum",
        "spectrum",
        "stability kim2009-flat --set model.normal_force=thesis --set load.tight_tension=2kN",
    ),
    (
        "slip-pulse-loop",
        "loop-1",
        "simulate slip-pulse --until 0.05 --at 0.04",
    ),
];

/// The figures that take many seconds or minutes.
const SLOW: [Figure; 4] = [
    ("v-power-map", "map", "map v-power"),
    (
        "kim2009-branch",
        "branch",
        "trace kim2009 --parameter load.tight_tractive_tension --from 102 --to 9000",
    ),
    (
        "kim2009-limit-friction",
        "limit_curve",
        "trace kim2009 --parameter load.tight_tractive_tension --curve friction.coefficient --from 0.2 --to 0.6",
    ),
    (
        "kim2009-limit-slack",
        "limit_curve",
        "trace kim2009 --parameter load.tight_tractive_tension --curve load.slack_tractive_tension --from 50 --to 400",
    ),
];

/// By how much the numbers of a figure may differ, px.
const NEAR: f64 = 0.5;

fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap().to_owned()
}

/// The figure that a command draws, without the text that it carries unseen.
fn drawn(name: &str, file: &str, command: &str) -> String {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("figures")
        .join(name);
    let mut arguments = command.split_whitespace();
    let subcommand = arguments.next().unwrap();
    let example = format!("beltdrive/examples/{}.toml", arguments.next().unwrap());
    let output = Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args([subcommand, &example, "--plot"])
        .arg(&directory)
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command}: {errors}");
    let text = fs::read_to_string(directory.join(file).with_extension("svg")).unwrap();
    let (before, after) = text.split_once("\n<metadata>").unwrap();
    before.to_owned() + after.split_once("</metadata>").unwrap().1
}

/// What a figure says and how it is drawn, and the numbers that say where.
fn parts(figure: &str) -> (Vec<&str>, Vec<f64>) {
    let (mut words, mut numbers) = (vec![], vec![]);
    for element in figure.split('<') {
        let (tag, text) = element.split_once('>').unwrap_or_default();
        words.push(text);
        for part in tag.split([' ', ',', '"']) {
            match part.parse() {
                Ok(number) => numbers.push(number),
                Err(_) => words.push(part),
            }
        }
    }
    (words, numbers)
}

fn check(figures: &[Figure]) {
    let update = env::var_os("UPDATE_DOCS").is_some();
    for &(name, file, command) in figures {
        let path = root().join("docs").join(name).with_extension("svg");
        let drawn = drawn(name, file, command);
        if update {
            fs::write(path, drawn).unwrap();
            continue;
        }
        let committed = fs::read_to_string(&path).unwrap();
        let [(words, numbers), (drawn_words, drawn_numbers)] =
            [&committed, &drawn].map(|figure| parts(figure));
        assert!(
            words == drawn_words,
            "{command} draws something else than {name}"
        );
        assert_eq!(numbers.len(), drawn_numbers.len(), "{name}");
        for (known, drawn) in numbers.iter().zip(drawn_numbers) {
            assert!((known - drawn).abs() <= NEAR, "{name}: {known}, {drawn}");
        }
    }
}

#[test]
fn figures_are_what_the_program_draws() {
    check(&FIGURES);
}

#[test]
#[ignore = "takes minutes"]
fn slow_figures_are_what_the_program_draws() {
    check(&SLOW);
}

#[test]
fn every_figure_has_its_command() {
    let files = fs::read_dir(root().join("docs")).unwrap();
    let files = files.map(|file| file.unwrap().path());
    let figures = files.filter(|path| path.extension().is_some_and(|end| end == "svg"));
    let mut names: Vec<_> = figures
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    let known = FIGURES.iter().chain(&SLOW);
    let mut known: Vec<_> = known.map(|(name, _, _)| *name).collect();
    known.sort_unstable();
    assert_eq!(names, known);
}
