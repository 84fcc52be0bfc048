//! The binary as its user meets it: what it prints where, and its exit status.

use std::{
    fs,
    io::Write,
    path::{Path, PathBuf},
    process::{Command, Output, Stdio},
};

fn beltdrive(args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_beltdrive"));
    command.args(args);
    command
}

fn run(args: &[&str]) -> Output {
    beltdrive(args).output().unwrap()
}

fn run_with_input(args: &[&str], input: &str) -> Output {
    let mut child = beltdrive(args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A process that fails early does not read its input.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

#[track_caller]
fn fails(output: &Output, status: i32, message: &str) {
    let text = stderr(output);
    assert_eq!(output.status.code(), Some(status), "{text}");
    assert!(text.contains(message), "{text}");
    assert!(!text.contains("panicked"), "{text}");
    assert_eq!(stdout(output), "");
}

#[track_caller]
fn succeeds(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
}

/// A fresh directory of this test run.
fn directory(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    path
}

fn example(name: &str) -> String {
    let output = run(&["examples", name]);
    succeeds(&output);
    stdout(&output)
}

#[test]
fn help_carries_examples() {
    for args in [
        &["--help"][..],
        &["solve", "--help"],
        &["trace", "--help"],
        &["limits", "--help"],
        &["stability", "--help"],
        &["verify", "--help"],
        &["examples", "--help"],
        &["sections", "--help"],
        &["completions", "--help"],
        &["calibrate", "--help"],
        &["man", "--help"],
    ] {
        let output = run(args);
        succeeds(&output);
        assert!(
            stdout(&output).contains("Example:\n  beltdrive "),
            "{}",
            stdout(&output)
        );
    }
}

#[test]
fn a_bad_command_line_is_status_2() {
    fails(&run(&[]), 2, "Usage:");
    fails(&run(&["sovle"]), 2, "unrecognized subcommand");
    fails(&run(&["solve"]), 2, "<FILE>");
    fails(&run(&["trace", "a.toml"]), 2, "--parameter <KEY>");
    fails(
        &run(&["solve", "a.toml", "--tolerance", "1"]),
        2,
        "must be within 1e-12 and 1e-2",
    );
    fails(
        &run(&["solve", "a.toml", "--tolerance", "x"]),
        2,
        "not a number",
    );
    let both = run(&["solve", "a.toml", "--json", "-", "--csv", "-"]);
    fails(&both, 2, "only one of --json and --csv");
}

#[test]
fn examples_are_listed_and_printed() {
    let output = run(&["examples"]);
    succeeds(&output);
    let list = stdout(&output);
    for example in beltdrive::examples::EXAMPLES {
        assert!(
            list.contains(example.name) && list.contains(&example.title()),
            "{list}"
        );
    }
    assert_eq!(
        example("kim2009"),
        beltdrive::examples::find("kim2009").unwrap().text
    );
    fails(&run(&["examples", "kim2008"]), 2, "did you mean `kim2009`?");
}

#[test]
fn a_missing_file_is_named() {
    fails(
        &run(&["solve", "no/such.toml"]),
        2,
        "cannot read no/such.toml",
    );
    let output = run(&["solve", "kim2009"]);
    fails(&output, 2, "`beltdrive examples kim2009 > kim2009.toml`");
}

#[test]
fn bad_input_is_shown_in_place() {
    let text = example("kim2009").replace("120 kN", "120 kNn");
    let output = run_with_input(&["solve", "-"], &text);
    fails(&output, 2, "unknown unit `kNn`");
    assert!(
        stderr(&output).contains("--> standard input:8:24"),
        "{}",
        stderr(&output)
    );

    let overrides = ["solve", "-", "--set", "friction.lwa=epp"];
    let output = run_with_input(&overrides, &example("kim2009"));
    fails(&output, 2, "--> command line:1:16");

    let file = directory("bytes").join("bytes.toml");
    fs::write(&file, b"title = \"\xff\"").unwrap();
    fails(
        &run(&["solve", file.to_str().unwrap()]),
        2,
        "no text in UTF-8: byte 9",
    );
}

#[test]
fn solving_prints_the_table_unless_asked_otherwise() {
    let text = example("kim2009");
    let output = run_with_input(&["solve", "-"], &text);
    succeeds(&output);
    assert_ne!(stdout(&output), "");

    let output = run_with_input(&["solve", "-", "--quiet"], &text);
    succeeds(&output);
    assert_eq!((stdout(&output), stderr(&output)), Default::default());

    let output = run_with_input(&["solve", "-", "--json", "-"], &text);
    succeeds(&output);
    let json: serde_json::Value = serde_json::from_str(&stdout(&output)).unwrap();
    assert!(json.is_object());
}

#[test]
fn what_cannot_be_traced_is_status_2() {
    let trace = |arguments: &[&str]| {
        let arguments = [&["trace", "-"], arguments].concat();
        run_with_input(&arguments, &example("kim2009"))
    };
    let tight = ["--parameter", "load.tight_tractive_tension"];
    let wrong_key = [
        "--parameter",
        "friction.coeficient",
        "--from",
        "1",
        "--to",
        "2",
    ];
    fails(
        &trace(&wrong_key),
        2,
        "did you mean `friction.coefficient`?",
    );
    let wrong_unit = [&tight[..], &["--from", "200 N", "--to", "2 kNn"]].concat();
    fails(&trace(&wrong_unit), 2, "1 | --to 2 kNn\n  |        ^^^");
    let empty = [&tight[..], &["--from", "1 kN", "--to", "1000 N"]].concat();
    fails(&trace(&empty), 2, "--from and --to are the same value");
    let range = ["--from", "0.2", "--to", "0.6"];
    let same = [&tight[..], &["--curve", tight[1]], &range].concat();
    fails(
        &trace(&same),
        2,
        "--parameter and --curve are the same entry",
    );
    let wrong_curve = [&tight[..], &["--curve", "friction.law"], &range].concat();
    fails(&trace(&wrong_curve), 2, "`friction.law` is no number");
    let arguments = ["limits", "-", "--parameter", "load.tight_tension"];
    let output = run_with_input(&arguments, &example("kim2009"));
    fails(&output, 2, "did you mean `load.tight_tractive_tension`?");
}

#[test]
fn a_branch_is_traced_into_every_form() {
    let directory = directory("trace");
    let path = |name: &str| directory.join(name).to_str().unwrap().to_owned();
    let (json, csv, figures) = (path("a.json"), path("a.csv"), path("figures"));
    let range = ["trace", "-", "--parameter", "load.tight_tractive_tension"];
    let range = [&range[..], &["--from", "500 N", "--to", "700 N"]].concat();
    let outputs = ["--json", &json, "--csv", &csv, "--plot", &figures];
    let output = run_with_input(&[&range[..], &outputs].concat(), &example("kim2009"));
    succeeds(&output);
    let table = stdout(&output);
    assert!(
        table.contains("Branch over load.tight_tractive_tension"),
        "{table}"
    );
    let notes = stderr(&output);
    assert!(
        notes.contains("branch.svg") && !notes.contains('%'),
        "{notes}"
    );

    let text = fs::read_to_string(json).unwrap();
    let branch: serde_json::Value = serde_json::from_str(&text).unwrap();
    let points = branch["points"].as_array().unwrap();
    let ends = [&points[0], points.last().unwrap()];
    assert_eq!(
        ends.map(|point| &point["tight_tractive_tension_N"]),
        [500.0, 700.0]
    );
    let speed = ends[1]["driven"]["angular_speed_rad_per_s"]
        .as_f64()
        .unwrap();
    assert!((speed - 102.6994).abs() < 1e-3, "{speed}");
    assert_eq!(branch["events"][0]["kind"], "start");
    assert_eq!(branch["end"]["reason"], "target");
    let rows = fs::read_to_string(csv).unwrap();
    assert!(rows.starts_with("tight_tractive_tension_N,arclength,event,pulley,"));

    let output = run_with_input(&[&range[..], &["--quiet"]].concat(), &example("kim2009"));
    succeeds(&output);
    assert_eq!((stdout(&output), stderr(&output)), Default::default());
}

#[test]
fn outputs_are_written_and_named() {
    let directory = directory("outputs");
    let path = |name: &str| directory.join(name).to_str().unwrap().to_owned();
    let (json, csv, figures) = (path("a.json"), path("a.csv"), path("figures"));
    let args = [
        "solve", "-", "--json", &json, "--csv", &csv, "--plot", &figures,
    ];
    let output = run_with_input(&args, &example("kim2009"));
    succeeds(&output);
    assert!(
        stderr(&output).contains(&format!("wrote {json}")),
        "{}",
        stderr(&output)
    );
    assert!(fs::metadata(csv).unwrap().len() > 0);
    assert!(fs::read_dir(figures).unwrap().count() > 0);
}

#[test]
fn an_unwritable_output_is_named() {
    let missing = directory("unwritable").join("missing");
    let file = missing.join("a.json").to_str().unwrap().to_owned();
    let text = example("kim2009");
    let output = run_with_input(&["solve", "-", "--quiet", "--json", &file], &text);
    fails(&output, 2, &format!("cannot write {file}"));
    fs::write(&missing, "a file, not a directory").unwrap();
    let figures = missing.to_str().unwrap();
    let output = run_with_input(&["solve", "-", "--quiet", "--plot", figures], &text);
    fails(&output, 2, &format!("cannot draw figures into {figures}"));
}

#[test]
fn a_closed_standard_output_is_no_failure() {
    let mut child = beltdrive(&["examples", "kim2009"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    succeeds(&output);
    assert_eq!(stderr(&output), "");
}

#[test]
fn sections_are_listed_and_shown() {
    let json = |arguments: &[&str]| -> serde_json::Value {
        let output = run(&[&["sections"], arguments, &["--json", "-"]].concat());
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let all = beltdrive::sections::SECTIONS.len();
    let list = json(&[]);
    assert_eq!(list["sections"].as_array().unwrap().len(), all);
    let one = json(&["5V"]);
    let section = &one["sections"][0];
    assert_eq!([&section["name"], &section["also"]], ["5V", "15N"]);
    assert_eq!(section["mass"]["value_kg_per_m"], 0.195);
    assert_eq!(section["axial_stiffness"]["kind"], "estimate");
    assert_eq!(section["grooves"][0]["steps"][1]["up_to_diameter_m"], 0.4);
    assert!(section["pitch_line_depth"].is_null());
    let csv = run(&["sections", "--csv", "-"]).stdout;
    let csv = String::from_utf8(csv).unwrap();
    assert_eq!(csv.lines().count(), all + 1);
    assert!(csv.starts_with("name,also,family,"), "{csv}");
    fails(&run(&["sections", "spb"]), 2, "did you mean `SPB`?");
}

#[test]
fn results_say_what_is_filled_in_from_a_section() {
    let file = format!("{}/examples/spb-fan.toml", env!("CARGO_MANIFEST_DIR"));
    let output = run(&["solve", &file, "--set", "belt.height=12 mm", "--json", "-"]);
    let state: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let section = &state["section"];
    assert_eq!(
        [&section["name"], &section["family"]],
        ["SPB", "narrow DIN/ISO"]
    );
    let entries = section["filled_in"].as_array().unwrap();
    assert_eq!(
        entries[0],
        serde_json::json!({ "key": "belt.type", "value": "v" })
    );
    let mass = &entries[1];
    assert_eq!(
        [&mass["key"], &mass["unit"]],
        ["belt.mass_per_length", "kg/m"]
    );
    assert_eq!([&mass["value"], &mass["high"]], [0.195, 0.2]);
    assert!(mass["sources"][0].as_str().unwrap().starts_with("Optibelt"));
    assert!(entries.iter().all(|entry| entry["key"] != "belt.height"));
    let table = String::from_utf8(run(&["solve", &file]).stdout).unwrap();
    assert!(table.contains("filled in from section"), "{table}");
    assert!(!table.contains("WARNING"), "{table}");
    let small = run(&["solve", &file, "--set", "pulleys.driver.diameter=130 mm"]);
    let warning =
        "WARNING: pulley `driver` has a diameter of 130 mm, the smallest for section SPB is 140 mm";
    assert!(stdout(&small).contains(warning), "{}", stdout(&small));
    assert!(
        table.lines().all(|line| line.chars().count() <= 100),
        "{table}"
    );
}

#[test]
fn shells_complete_every_command() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = run(&["completions", shell]);
        succeeds(&output);
        let script = stdout(&output);
        for word in ["limits", "sections", "--tolerance", "completions"] {
            let word = word.trim_start_matches("--");
            assert!(script.contains(word), "{shell} lacks {word}");
        }
    }
    fails(&run(&["completions", "dash"]), 2, "invalid value 'dash'");
}

#[test]
fn manual_pages_describe_the_program_and_each_command() {
    let page = |arguments: &[&str]| {
        let output = run(&[&["man"], arguments].concat());
        succeeds(&output);
        stdout(&output)
    };
    let program = page(&[]);
    assert!(program.contains(".TH beltdrive 1"), "{program}");
    assert!(
        program.contains("sections") && program.contains("Exit status"),
        "{program}"
    );
    let solve = page(&["solve"]);
    assert!(
        solve.contains(".TH beltdrive\\-solve 1") || solve.contains(".TH beltdrive-solve 1"),
        "{solve}"
    );
    assert!(solve.contains("tolerance"), "{solve}");
    fails(&run(&["man", "sovle"]), 2, "there is no command `sovle`");
}

#[test]
fn a_belt_is_calibrated_from_rows() {
    let directory = Path::new(env!("CARGO_TARGET_TMPDIR")).join("calibrate");
    fs::create_dir_all(&directory).unwrap();
    for name in ["flat-bench", "flat-bench.csv"] {
        let file = match name {
            "flat-bench" => "flat-bench.toml",
            name => name,
        };
        fs::write(directory.join(file), example(name)).unwrap();
    }
    let path = |name: &str| directory.join(name).display().to_string();
    let (file, data) = (path("flat-bench.toml"), path("flat-bench.csv"));
    let base = ["calibrate", &file, "--data", &data];
    let output = run(&[&base[..], &["--json", "-", "--plot", &path("figures")]].concat());
    succeeds(&output);
    let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let stiffness = &found["parameters"][0];
    assert_eq!(
        [&stiffness["key"], &stiffness["unit"]],
        ["belt.axial_stiffness", "N"]
    );
    let [low, high] = ["low", "high"].map(|key| stiffness[key].as_f64().unwrap());
    assert!(low < 90e3 && 90e3 < high, "{stiffness}");
    assert_eq!(found["residuals"].as_array().unwrap().len(), 24);
    assert_eq!(found["residuals"][0]["line"], 4);
    assert!(directory.join("figures/residuals.svg").is_file());
    let csv = stdout(&run(&[&base[..], &["--csv", "-"]].concat()));
    let head = "line,quantity,unit,reading,model,difference,standard_deviation\n";
    assert!(csv.starts_with(head) && csv.lines().count() == 25, "{csv}");
    let table = stdout(&run(&base));
    assert!(
        table.lines().all(|line| line.chars().count() <= 100),
        "{table}"
    );
    let torque = [&base[..], &["--free", "load.torque"]].concat();
    fails(&run(&torque), 2, "because a column sets it in every row");
    let weak = [&base[..], &["--set", "friction.coefficient=0.3"]].concat();
    fails(
        &run(&weak),
        1,
        "the row in line 7 has no answer at the values of the drive file",
    );
    let overwritten = [&base[..], &["--csv", &data]].concat();
    fails(&run(&overwritten), 2, "would overwrite the data");
}
