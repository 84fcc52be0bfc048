//! Files that the program reads and writes: none is destroyed, none is read without end.

#[expect(dead_code, reason = "the drives of the other tests")]
mod support;

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

const PROGRAM: &str = env!("CARGO_BIN_EXE_beltdrive");

/// A fresh directory of this test run with a right drive file, `drive.toml`.
fn directory(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
        .join("files")
        .join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    fs::write(path.join("drive.toml"), support::DRIVE).unwrap();
    path
}

fn run(directory: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(PROGRAM);
    command.args(args).current_dir(directory).output().unwrap()
}

#[track_caller]
fn refused(output: &Output, message: &str) {
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{text}");
    assert!(text.contains(message), "{text}");
    assert!(output.stdout.is_empty());
}

fn names(directory: &Path) -> Vec<String> {
    let names = fs::read_dir(directory).unwrap();
    let mut names: Vec<_> = names
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// A file size limit of 512 or 1024 bytes stands for a full disk where its signal is ignored, and for a run
/// that is ended while it writes where it is not.
#[cfg(unix)]
/// The status of `solve` with these options where no file may exceed one block, after a shell command.
fn solve_on_a_full_disk(directory: &Path, before: &str, options: &str) -> Option<i32> {
    let command = format!(
        "ulimit -c 0; ulimit -f 1; {before} exec \"$0\" solve drive.toml {options} --quiet"
    );
    let output = Command::new("sh")
        .args(["-c", &command, PROGRAM])
        .current_dir(directory)
        .output()
        .unwrap();
    output.status.code()
}

#[test]
fn a_full_disk_and_an_interrupted_run_leave_the_old_file() {
    for (name, signal, status) in [("full", "trap '' XFSZ;", Some(2)), ("ended", "", None)] {
        let directory = directory(name);
        for option in ["--json", "--csv"] {
            let file = directory.join("out");
            fs::write(&file, "good").unwrap();
            let found = solve_on_a_full_disk(&directory, signal, &format!("{option} out"));
            assert_eq!(found, status);
            assert_eq!(
                fs::read_to_string(&file).unwrap(),
                "good",
                "{name} {option}"
            );
        }
        if status.is_some() {
            assert_eq!(names(&directory), ["drive.toml", "out"]);
        }
        let figures = directory.join("figures");
        fs::create_dir(&figures).unwrap();
        fs::write(figures.join("drive.svg"), "good").unwrap();
        let found = solve_on_a_full_disk(&directory, signal, "--plot figures");
        assert_eq!(found, status);
        assert_eq!(
            fs::read_to_string(figures.join("drive.svg")).unwrap(),
            "good"
        );
    }
}

#[test]
fn the_drive_file_is_not_overwritten() {
    let directory = directory("same");
    for command in ["solve", "limits", "stability"] {
        let output = run(
            &directory,
            &[command, "drive.toml", "--json", "./drive.toml"],
        );
        refused(
            &output,
            "--json ./drive.toml would overwrite the drive file",
        );
    }
    assert_eq!(
        fs::read_to_string(directory.join("drive.toml")).unwrap(),
        support::DRIVE
    );
}

#[test]
fn two_outputs_are_not_one_file() {
    let directory = directory("two");
    let output = run(
        &directory,
        &["solve", "drive.toml", "--json", "a", "--csv", "./a"],
    );
    refused(&output, "--json and --csv name the same file, ./a");
    let output = run(&directory, &["verify", "--markdown", "a", "--csv", "a"]);
    refused(&output, "--markdown and --csv name the same file, a");
    let figure = [
        "solve",
        "drive.toml",
        "--plot",
        "figures",
        "--csv",
        "figures/drive.svg",
    ];
    refused(
        &run(&directory, &figure),
        "--csv figures/drive.svg is where --plot puts its figures",
    );
    let figure = ["solve", "drive.toml", "--plot", "a", "--csv", "a"];
    refused(
        &run(&directory, &figure),
        "--csv a is where --plot puts its figures",
    );
    assert_eq!(names(&directory), ["drive.toml"]);
}

#[cfg(unix)]
#[test]
fn devices_take_any_number_of_outputs() {
    let directory = directory("devices");
    let null = [
        "solve",
        "drive.toml",
        "--json",
        "/dev/null",
        "--csv",
        "/dev/null",
        "--quiet",
    ];
    let output = run(&directory, &null);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[cfg(unix)]
#[test]
fn what_is_no_drive_file_is_not_read_without_end() {
    let directory = directory("endless");
    refused(
        &run(&directory, &["solve", "/dev/zero"]),
        "/dev/zero is a device, not a drive file",
    );
    refused(
        &run(&directory, &["solve", "."]),
        ". is a directory, not a drive file",
    );
    let zeros = fs::File::open("/dev/zero").unwrap();
    let mut command = Command::new(PROGRAM);
    let output = command.args(["solve", "-"]).stdin(zeros).output().unwrap();
    refused(&output, "standard input is larger than 1 MiB");
}

#[test]
fn the_size_of_a_drive_file_is_bounded() {
    let directory = directory("large");
    let mut text = support::DRIVE.to_owned();
    text.push_str(&"#".repeat((1 << 20) - text.len()));
    let file = directory.join("drive.toml");
    fs::write(&file, &text).unwrap();
    let output = run(&directory, &["solve", "drive.toml", "--quiet"]);
    assert_eq!(output.status.code(), Some(0));
    fs::write(&file, text + "#").unwrap();
    refused(
        &run(&directory, &["solve", "drive.toml"]),
        "drive.toml is larger than 1 MiB",
    );
}

#[cfg(unix)]
#[test]
fn a_pipe_with_a_name_is_read() {
    let directory = directory("pipe");
    let command = "mkfifo p && { cat drive.toml > p & exec \"$0\" solve p --quiet; }";
    let output = Command::new("sh")
        .args(["-c", command, PROGRAM])
        .current_dir(&directory)
        .output()
        .unwrap();
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
}

#[test]
fn every_file_says_where_it_comes_from() {
    let directory = directory("origin");
    let coefficient = "friction.coefficient=0.39";
    let outputs = [
        "--json", "a.json", "--csv", "a.csv", "--plot", "figures", "--quiet",
    ];
    let args = [&["solve", "drive.toml", "--set", coefficient][..], &outputs].concat();
    assert_eq!(run(&directory, &args).status.code(), Some(0));
    let text = |name: &str| fs::read_to_string(directory.join(name)).unwrap();

    let json: serde_json::Value = serde_json::from_str(&text("a.json")).unwrap();
    let origin = &json["origin"];
    assert_eq!(origin["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(origin["command_line"][0], "beltdrive");
    assert_eq!(origin["command_line"][4], coefficient);
    assert_eq!(origin["drive_file"]["name"], "drive.toml");
    assert_eq!(origin["drive_file"]["text"], support::DRIVE);
    assert!(json["efficiency"].is_number());

    let beside: serde_json::Value = serde_json::from_str(&text("a.csv.origin.json")).unwrap();
    assert_eq!(&beside, origin);
    assert!(text("a.csv").starts_with("pulley,"));

    let figure = text("figures/drive.svg");
    let (_, metadata) = figure.split_once("<metadata>").unwrap();
    let (metadata, _) = metadata.split_once("</metadata>").unwrap();
    let metadata = metadata
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&amp;", "&");
    let metadata: serde_json::Value = serde_json::from_str(&metadata).unwrap();
    assert_eq!(&metadata, origin);
    let same = [
        "solve",
        "drive.toml",
        "--csv",
        "b",
        "--json",
        "b.origin.json",
    ];
    refused(&run(&directory, &same), "name the same file");
}
