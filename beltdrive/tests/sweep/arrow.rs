//! Rows as Arrow IPC files, written and read.

use super::program::{answered, directory, faults_of_damaged, refused, run};
use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{
    Array, ArrayRef, Float32Array, Float64Array, Int32Array, NullArray, RecordBatch, StringArray,
    TimestampMillisecondArray, UInt64Array,
};
use arrow_ipc::reader::FileReader;
use arrow_ipc::writer::{FileWriter, IpcWriteOptions};
use arrow_ipc::{CompressionType, MetadataVersion};
use arrow_schema::{DataType, Schema};
use std::fs::{self, File};
use std::path::Path;
use std::sync::Arc;

/// A sweep some of whose rows have no answer.
const SWEEP: [&str; 4] = [
    "--over",
    "pulleys.driver.speed=60 rad/s,100 rad/s",
    "--over",
    "load.tight_tension=300 N:10 kN:30",
];

fn batches(path: &Path) -> (Arc<Schema>, Vec<RecordBatch>) {
    let reader = FileReader::try_new(File::open(path).unwrap(), None).unwrap();
    let schema = reader.schema();
    (schema, reader.map(Result::unwrap).collect())
}

/// What a place of an array is in CSV; nothing for null.
fn text(array: &ArrayRef, row: usize) -> String {
    match array.data_type() {
        _ if array.is_null(row) => String::new(),
        DataType::Utf8 => array.as_string::<i32>().value(row).to_owned(),
        DataType::Int64 => array.as_primitive::<Int64Type>().value(row).to_string(),
        DataType::Float64 => {
            let value = array.as_primitive::<Float64Type>().value(row);
            format!("{:016x}", value.to_bits())
        }
        other => panic!("no column is {other}"),
    }
}

#[test]
fn the_rows_are_those_of_csv() {
    let directory = directory("arrow", "kim2009-flat");
    let files = ["--csv", "rows.csv", "--arrow", "rows.arrow"];
    let output = run(&directory, &[&SWEEP[..], &files].concat());
    answered(&output);
    assert!(String::from_utf8_lossy(&output.stderr).contains("wrote rows.arrow"));
    let (schema, batches) = batches(&directory.join("rows.arrow"));
    let mut csv = csv::Reader::from_path(directory.join("rows.csv")).unwrap();
    let header = csv.headers().unwrap().clone();
    let names: Vec<_> = schema.fields().iter().map(|field| field.name()).collect();
    assert_eq!(names, header.iter().collect::<Vec<_>>());
    assert!(names.contains(&&"load_tight_tension_N".to_owned()));
    let rows = batches.iter().flat_map(|batch| {
        let row = |row| {
            batch
                .columns()
                .iter()
                .map(move |array| (array.data_type(), text(array, row)))
        };
        (0..batch.num_rows()).map(move |index| row(index).collect::<Vec<_>>())
    });
    let rows: Vec<_> = rows.collect();
    let records: Vec<_> = csv.records().map(Result::unwrap).collect();
    assert_eq!([rows.len(), records.len()], [60, 60]);
    let mut nulls = 0;
    for (row, record) in rows.iter().zip(&records) {
        for ((kind, found), expected) in row.iter().zip(record) {
            match **kind {
                _ if expected.is_empty() => {
                    assert_eq!(found, "");
                    nulls += 1;
                }
                DataType::Float64 => {
                    let bits = expected.parse::<f64>().unwrap().to_bits();
                    assert_eq!(*found, format!("{bits:016x}"));
                }
                _ => assert_eq!(found, expected),
            }
        }
    }
    assert!(nulls > 60, "{nulls}");

    let metadata = schema.metadata();
    assert_eq!(metadata["version"], env!("CARGO_PKG_VERSION"));
    let drive = fs::read_to_string(directory.join("drive.toml")).unwrap();
    assert_eq!(metadata["drive_file.text"], drive);
    assert!(metadata["command_line"].contains("--arrow rows.arrow"));
}

#[test]
fn parts_are_shared_and_resumed() {
    let directory = directory("arrow-parts", "kim2009-flat");
    let one = [&SWEEP[..], &["--arrow", "rows.arrow"]].concat();
    answered(&run(&directory, &one));
    let out = ["--out", "rows", "--format", "arrow", "--chunk", "25"];
    let parts = [&SWEEP[..], &out].concat();
    answered(&run(
        &directory,
        &[&parts[..], &["--shard", "2/2"]].concat(),
    ));
    let second = fs::read(directory.join("rows/part-000001.arrow")).unwrap();
    assert!(!directory.join("rows/part-000000.arrow").exists());
    answered(&run(&directory, &parts));
    assert!(fs::read(directory.join("rows/part-000001.arrow")).unwrap() == second);
    let columns = |batches: &[RecordBatch]| -> Vec<Vec<String>> {
        let rows = batches.iter().flat_map(|batch| {
            let row = |row| {
                batch
                    .columns()
                    .iter()
                    .map(|array| text(array, row))
                    .collect()
            };
            (0..batch.num_rows()).map(row).collect::<Vec<_>>()
        });
        rows.collect()
    };
    let paths = (0..3).map(|part| directory.join(format!("rows/part-{part:06}.arrow")));
    let found: Vec<_> = paths.flat_map(|path| columns(&batches(&path).1)).collect();
    assert_eq!(found, columns(&batches(&directory.join("rows.arrow")).1));
    let other = [
        &SWEEP[..],
        &["--out", "rows", "--format", "csv", "--chunk", "25"],
    ]
    .concat();
    refused(&run(&directory, &other), "`format` differs");
}

#[test]
fn bytes_go_to_standard_output_and_no_file_is_overwritten() {
    let directory = directory("arrow-output", "kim2009-flat");
    let output = run(&directory, &[&SWEEP[..], &["--arrow", "-"]].concat());
    answered(&output);
    assert!(output.stdout.starts_with(b"ARROW1") && output.stdout.ends_with(b"ARROW1"));
    for (args, message) in [
        (&["--arrow", "-", "--csv", "-"][..], "standard output"),
        (&["--arrow", "drive.toml"], "would overwrite the drive file"),
        (&["--arrow", "a", "--parquet", "a"], "name the same file"),
        (&["--arrow", "a", "--out", "rows"], "cannot be used with"),
        (&["--arrow", "nowhere/a"], "cannot write nowhere/a"),
    ] {
        refused(&run(&directory, &[&SWEEP[..], args].concat()), message);
    }
}

/// Writes columns as an Arrow IPC file, in batches of two rows.
fn write(path: &Path, columns: Vec<(&str, ArrayRef)>, compression: Option<CompressionType>) {
    let batch = RecordBatch::try_from_iter_with_nullable(
        columns.into_iter().map(|(name, array)| (name, array, true)),
    );
    let batch = batch.unwrap();
    let options = IpcWriteOptions::try_new(8, false, MetadataVersion::V5).unwrap();
    let options = options.try_with_compression(compression).unwrap();
    let file = File::create(path).unwrap();
    let mut writer = FileWriter::try_new_with_options(file, &batch.schema(), options).unwrap();
    for from in (0..batch.num_rows()).step_by(2) {
        let count = 2.min(batch.num_rows() - from);
        writer.write(&batch.slice(from, count)).unwrap();
    }
    writer.finish().unwrap();
}

#[test]
fn a_table_in_arrow_is_as_one_in_csv() {
    let directory = directory("arrow-table", "kim2009-flat");
    let path = directory.join("in.arrow");
    let table = "load.tight_tension [kN],pulleys_driver_speed_rad_per_s\n0.5,100\nNaN,100\n,100\n0.75,90\ninf,90\n";
    fs::write(directory.join("in.csv"), table).unwrap();
    answered(&run(
        &directory,
        &["--table", "in.csv", "--csv", "expected.csv"],
    ));
    let read = |name: &str| fs::read_to_string(directory.join(name)).unwrap();
    let expected = read("expected.csv").replace("in.csv", "in.arrow");
    let tension = [
        Some(0.5),
        Some(f32::NAN),
        None,
        Some(0.75),
        Some(f32::INFINITY),
    ];
    let speed = [100, 100, 100, 90, 90];
    let tensions: [ArrayRef; 2] = [
        Arc::new(Float32Array::from(tension.to_vec())),
        Arc::new(Float64Array::from_iter(
            tension.map(|value| value.map(f64::from)),
        )),
    ];
    let speeds: [ArrayRef; 2] = [
        Arc::new(Int32Array::from(speed.to_vec())),
        Arc::new(UInt64Array::from_iter(
            speed.map(i32::unsigned_abs).map(u64::from),
        )),
    ];
    for compression in [None, Some(CompressionType::LZ4_FRAME)] {
        for (tension, speed) in tensions.iter().zip(&speeds) {
            let columns = vec![
                ("load.tight_tension [kN]", tension.clone()),
                ("pulleys_driver_speed_rad_per_s", speed.clone()),
            ];
            write(&path, columns, compression);
            answered(&run(
                &directory,
                &["--table", "in.arrow", "--csv", "found.csv"],
            ));
            assert_eq!(read("found.csv"), expected);
        }
    }
    // From the middle of a batch on.
    let parts = [
        "--table", "in.arrow", "--out", "parts", "--chunk", "3", "--format", "csv", "--shard",
        "2/2",
    ];
    answered(&run(&directory, &parts));
    let lines: Vec<_> = expected.lines().skip(4).map(str::to_owned).collect();
    let part = read("parts/part-000001.csv");
    assert_eq!(part.lines().skip(1).collect::<Vec<_>>(), lines);
}

#[test]
fn other_columns_and_broken_files_are_one_error() {
    let directory = directory("arrow-faults", "kim2009-flat");
    let path = directory.join("in.arrow");
    let table = ["--table", "in.arrow"];
    let others: [ArrayRef; 2] = [
        Arc::new(StringArray::from(vec!["500"])),
        Arc::new(TimestampMillisecondArray::from(vec![500])),
    ];
    for other in others {
        write(&path, vec![("load.tight_tension", other)], None);
        let message = "the column `load.tight_tension` of in.arrow holds no numbers";
        refused(&run(&directory, &table), message);
    }
    write(
        &path,
        vec![("load.tight_tension", Arc::new(NullArray::new(3)))],
        None,
    );
    let output = run(&directory, &table);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("missing number"));

    let numbers = Arc::new(Float64Array::from(vec![500.0; 100]));
    write(&path, vec![("load.tight_tension", numbers)], None);
    let whole = fs::read(&path).unwrap();
    for length in [6, 8, 20, whole.len() / 2, whole.len() - 1] {
        fs::write(&path, &whole[..length]).unwrap();
        refused(&run(&directory, &table), "cannot read in.arrow");
    }
    fs::write(&path, &whole).unwrap();
    assert!(faults_of_damaged(&path) > 20);
}
