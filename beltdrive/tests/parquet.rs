//! Parquet files hold what CSV holds, bit for bit.

use parquet::basic::{LogicalType, Type as Physical};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use std::collections::HashMap;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A fresh directory with an example, of a name that no other use of it has: tests run at once.
fn directory(name: &str, example: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("parquet")
        .join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(&path).unwrap();
    let text = beltdrive::examples::find(example).unwrap().text;
    fs::write(path.join("drive.toml"), text).unwrap();
    path
}

fn run(directory: &Path, args: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_beltdrive"));
    command.args(args).current_dir(directory).output().unwrap()
}

/// Compares the rows of a CSV and of a Parquet file; returns how many rows and how many nulls there are.
fn compared(directory: &Path) -> [usize; 2] {
    let mut csv = csv::Reader::from_path(directory.join("rows.csv")).unwrap();
    let header = csv.headers().unwrap().clone();
    let reader = File::open(directory.join("rows.parquet")).unwrap();
    let reader = SerializedFileReader::new(reader).unwrap();
    let columns = reader.metadata().file_metadata().schema_descr().columns();
    let names: Vec<_> = columns.iter().map(|column| column.name()).collect();
    assert_eq!(names, header.iter().collect::<Vec<_>>());
    for column in columns {
        match column.physical_type() {
            Physical::DOUBLE | Physical::INT64 => assert_eq!(column.logical_type_ref(), None),
            Physical::BYTE_ARRAY => {
                assert_eq!(column.logical_type_ref(), Some(&LogicalType::String));
            }
            other => panic!("{} is {other}", column.name()),
        }
    }
    let (mut count, mut nulls) = (0, 0);
    let mut rows = reader.get_row_iter(None).unwrap();
    for record in csv.records() {
        let record = record.unwrap();
        let row = rows.next().expect("as many rows as lines").unwrap();
        for ((name, field), text) in row.get_column_iter().zip(&record) {
            match field {
                Field::Double(value) => {
                    let expected: f64 = text.parse().unwrap();
                    assert_eq!(
                        value.to_bits(),
                        expected.to_bits(),
                        "{name}: {value} {text}"
                    );
                }
                Field::Long(value) => assert_eq!(value.to_string(), text, "{name}"),
                Field::Str(value) => assert_eq!(value, text, "{name}"),
                Field::Null => {
                    assert_eq!(text, "", "{name}");
                    nulls += 1;
                }
                other => panic!("{name} is {other}"),
            }
        }
        count += 1;
    }
    assert!(rows.next().is_none());
    [count, nulls]
}

#[test]
fn a_map_is_as_in_csv_with_nulls_where_there_is_no_state() {
    let directory = directory("map", "kim2009-flat");
    let speed = "pulleys.driver.speed=30 rad/s:150 rad/s:7";
    let load = "load.tight_tension=260 N:9 kN:5";
    let files = ["--csv", "rows.csv", "--parquet", "rows.parquet"];
    let args = [
        &["map", "drive.toml", "--x", speed, "--y", load][..],
        &files,
    ]
    .concat();
    let output = run(&directory, &args);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{errors}");
    assert!(errors.contains("wrote rows.parquet"), "{errors}");
    let [rows, nulls] = compared(&directory);
    assert_eq!(rows, 35);
    // A row without a state has no number but those of the axes, one with a state no reason and no description.
    assert!(nulls > 70, "{nulls}");

    // The origin stands in the metadata.
    let reader = File::open(directory.join("rows.parquet")).unwrap();
    let reader = SerializedFileReader::new(reader).unwrap();
    let metadata = reader.metadata().file_metadata().key_value_metadata();
    let metadata: HashMap<_, _> = { metadata.unwrap().iter() }
        .map(|entry| (&*entry.key, entry.value.clone().unwrap()))
        .collect();
    assert_eq!(metadata["program"], "beltdrive");
    assert_eq!(metadata["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(metadata["drive_file.name"], "drive.toml");
    let text = fs::read_to_string(directory.join("drive.toml")).unwrap();
    assert_eq!(metadata["drive_file.text"], text);
    let command = &metadata["command_line"];
    assert!(command.starts_with("beltdrive map drive.toml --x 'pulleys.driver.speed="));
}

#[test]
fn every_command_with_csv_writes_the_same_rows() {
    for (example, command) in [
        ("kim2009-flat", &["solve"][..]),
        ("kim2009-flat", &["limits"]),
        ("serpentine-cases", &["check"]),
        ("serpentine", &["solve"]),
    ] {
        let directory = directory(&format!("{}-{example}", command[0]), example);
        let files = [
            "drive.toml",
            "--csv",
            "rows.csv",
            "--parquet",
            "rows.parquet",
        ];
        let output = run(&directory, &[command, &files].concat());
        let is_answered = matches!(output.status.code(), Some(0 | 3));
        assert!(is_answered, "{}", String::from_utf8_lossy(&output.stderr));
        let [rows, _] = compared(&directory);
        assert!(rows > 1, "{example} {command:?}");
    }
}

#[test]
fn bytes_go_to_standard_output_in_place_of_the_table() {
    let directory = directory("standard-output", "kim2009-flat");
    let output = run(&directory, &["limits", "drive.toml", "--parquet", "-"]);
    assert!(output.status.success());
    assert!(output.stdout.starts_with(b"PAR1") && output.stdout.ends_with(b"PAR1"));
    let refused = run(
        &directory,
        &["limits", "drive.toml", "--parquet", "-", "--csv", "-"],
    );
    assert_eq!(refused.status.code(), Some(2));
    let same = run(
        &directory,
        &["solve", "drive.toml", "--parquet", "drive.toml"],
    );
    assert_eq!(same.status.code(), Some(2));
}
