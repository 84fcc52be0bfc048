//! Rows from tables.

#[cfg(feature = "parquet")]
use super::program::faults_of_damaged;
use super::program::{answered, directory, refused, rows, run};
use beltdrive::SweepTable;
use beltdrive::examples;
use beltdrive::input::DriveFile;
use std::fs;

#[test]
fn a_table_gives_the_rows_and_one_at_fault_says_so() {
    let directory = directory("table", "kim2009-flat");
    let table = "# measured\nload.tight_tension [kN],pulleys.driver.speed [rpm]\n0.5,900\nnan,900\n0.5,\n\
                 -0.5,900\n0.5,900,1\n 0.7 , 800\nx,1\n90,900\n";
    fs::write(directory.join("in.csv"), table).unwrap();
    let output = run(&directory, &["--table", "in.csv", "--csv", "out.csv"]);
    answered(&output);
    let rows = rows(&directory.join("out.csv"));
    let expected = [
        ("answered", ""),
        ("at fault", "`nan` is not a finite number"),
        (
            "at fault",
            "missing number under `pulleys.driver.speed [rpm]`",
        ),
        ("at fault", "must be positive"),
        ("at fault", "3 fields under 2 headings"),
        ("answered", ""),
        (
            "at fault",
            "malformed number `x` under `load.tight_tension [kN]`",
        ),
        ("no answer", "exceeds the limit"),
    ];
    assert_eq!(rows.len(), expected.len());
    for (index, (row, (status, description))) in rows.iter().zip(expected).enumerate() {
        assert_eq!(row["row"], index.to_string());
        assert_eq!(row["status"], status, "{index}");
        assert!(
            row["description"].contains(description),
            "{}",
            row["description"]
        );
    }
    assert_eq!(rows[0]["load_tight_tension_N"], "500");
    let speed: f64 = rows[0]["pulleys_driver_speed_rad_per_s"].parse().unwrap();
    assert!((speed - 30.0 * std::f64::consts::PI).abs() < 1e-12);
    // What is known of a row at fault stays.
    assert_eq!(rows[1]["load_tight_tension_N"], "");
    assert_ne!(rows[1]["pulleys_driver_speed_rad_per_s"], "");

    // In parts, and the columns that were written are columns that are read.
    let parts = [
        "--table", "in.csv", "--out", "parts", "--chunk", "3", "--format", "csv",
    ];
    answered(&run(&directory, &parts));
    let texts = (0..3).map(|part| {
        let name = format!("parts/part-{part:06}.csv");
        let text = fs::read_to_string(directory.join(name)).unwrap();
        text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>()
    });
    let whole = fs::read_to_string(directory.join("out.csv")).unwrap();
    assert_eq!(
        texts.collect::<Vec<_>>().concat(),
        whole.lines().skip(1).collect::<Vec<_>>()
    );
    fs::write(directory.join("in.csv"), table.replace("800", "801")).unwrap();
    refused(&run(&directory, &parts), "`source` differs");
}

#[test]
fn headings_at_fault_are_one_error() {
    let directory = directory("headings", "kim2009-flat");
    for (heading, message) in [
        ("load.tight_tensoin", "did you mean `load.tight_tension`?"),
        ("load_tight_tension", "did you mean `load.tight_tension`?"),
        ("load.tight_tension [kg]", "wrong dimension"),
        ("load.tight_tension []", "got a pure number"),
        ("load.tight_tension [kNn]", "did you mean `kN`?"),
        ("load.tight_tension [N", "has no end"),
        ("friction.law", "unknown column `friction.law`"),
        ("load.tight_tension,load_tight_tension_N", "a second column"),
    ] {
        fs::write(directory.join("in.csv"), format!("{heading}\n1\n")).unwrap();
        refused(&run(&directory, &["--table", "in.csv"]), message);
    }
    refused(
        &run(&directory, &["--table", "nowhere.csv"]),
        "cannot read nowhere.csv",
    );
    fs::write(directory.join("in.csv"), "").unwrap();
    refused(&run(&directory, &["--table", "in.csv"]), "no columns");
    let both = ["--table", "in.csv", "--over", "load.tight_tension=3,4"];
    refused(&run(&directory, &both), "cannot be used with");
    fs::write(directory.join("in.csv"), "load_tight_tension_N\n1\n").unwrap();
    let over = ["--table", "in.csv", "--csv", "in.csv"];
    refused(&run(&directory, &over), "would overwrite the table");
}

#[cfg(feature = "parquet")]
#[test]
fn a_table_in_parquet_is_as_one_in_csv() {
    use beltdrive::report::{Column, Field, FieldKind, ParquetWriter};
    let directory = directory("parquet", "kim2009-flat");
    let column = |name: &str, kind| Column {
        name: name.to_owned(),
        kind,
    };
    let write = |columns: Vec<Column>, rows: &[Vec<Option<Field>>]| {
        let mut writer = ParquetWriter::new(Vec::new(), columns, &[]).unwrap();
        for rows in rows.chunks(2) {
            writer.write(rows).unwrap();
        }
        fs::write(directory.join("in.parquet"), writer.finish().unwrap()).unwrap();
    };
    let number = |value| Some(Field::Number(value));
    let columns = vec![
        column("load.tight_tension [kN]", FieldKind::Number),
        column("pulleys_driver_speed_rad_per_s", FieldKind::Number),
    ];
    let rows_in = [
        vec![number(0.5), number(100.0)],
        vec![number(f64::NAN), number(100.0)],
        vec![None, number(100.0)],
        vec![number(0.7), number(90.0)],
        vec![number(90.0), number(90.0)],
    ];
    write(columns, &rows_in);
    let table = "load.tight_tension [kN],pulleys_driver_speed_rad_per_s\n0.5,100\nNaN,100\n,100\n0.7,90\n90,90\n";
    fs::write(directory.join("in.csv"), table).unwrap();
    answered(&run(
        &directory,
        &["--table", "in.parquet", "--csv", "one.csv"],
    ));
    answered(&run(
        &directory,
        &["--table", "in.csv", "--csv", "other.csv"],
    ));
    let read = |name: &str| fs::read_to_string(directory.join(name)).unwrap();
    assert_eq!(
        read("one.csv").replace("in.parquet", "in.csv"),
        read("other.csv")
    );
    let parts = [
        "--table",
        "in.parquet",
        "--out",
        "parts",
        "--chunk",
        "2",
        "--shard",
        "2/2",
    ];
    answered(&run(&directory, &parts));
    assert!(directory.join("parts/part-000001.parquet").is_file());

    let words = vec![column("load.tight_tension", FieldKind::Word)];
    write(words, &[vec![Some(Field::Word("much".to_owned()))]]);
    let output = run(&directory, &["--table", "in.parquet"]);
    refused(
        &output,
        "the column `load.tight_tension` of in.parquet holds no numbers",
    );
    let path = directory.join("in.parquet");
    write_column(
        &path,
        "required float load_tight_tension_N;",
        parquet::basic::Compression::SNAPPY,
    );
    assert!(faults_of_damaged(&path) > 20);
    fs::write(directory.join("in.parquet"), "PAR1 and then nothing").unwrap();
    refused(
        &run(&directory, &["--table", "in.parquet"]),
        "cannot read in.parquet",
    );
}

/// Writes a Parquet file of one column, a field of the message of a schema, that holds 500 and 600.
#[cfg(feature = "parquet")]
fn write_column(path: &std::path::Path, field: &str, compression: parquet::basic::Compression) {
    use parquet::column::writer::ColumnWriter;
    use parquet::file::{properties::WriterProperties, writer::SerializedFileWriter};
    let schema = parquet::schema::parser::parse_message_type(&format!("message m {{ {field} }}"));
    let properties = WriterProperties::builder().set_compression(compression);
    let file = fs::File::create(path).unwrap();
    let schema = std::sync::Arc::new(schema.unwrap());
    let properties = std::sync::Arc::new(properties.build());
    let mut writer = SerializedFileWriter::new(file, schema, properties).unwrap();
    let mut group = writer.next_row_group().unwrap();
    let mut column = group.next_column().unwrap().unwrap();
    match column.untyped() {
        ColumnWriter::Int32ColumnWriter(column) => column.write_batch(&[500, 600], None, None),
        ColumnWriter::Int64ColumnWriter(column) => column.write_batch(&[500, 600], None, None),
        ColumnWriter::FloatColumnWriter(column) => column.write_batch(&[500.0, 600.0], None, None),
        ColumnWriter::BoolColumnWriter(column) => column.write_batch(&[true, false], None, None),
        _ => panic!("no other type is written"),
    }
    .unwrap();
    column.close().unwrap();
    group.close().unwrap();
    writer.close().unwrap();
}

#[cfg(feature = "parquet")]
#[test]
fn numbers_of_all_kinds_are_read_from_parquet_and_nothing_else() {
    use parquet::basic::Compression;
    let directory = directory("kinds", "kim2009-flat");
    let path = directory.join("in.parquet");
    let table = ["--table", "in.parquet", "--csv", "out.csv"];
    for (kind, annotation) in [
        ("int32", ""),
        ("int32", "(UINT_8)"),
        ("int32", "(INT_16)"),
        ("int32", "(UINT_32)"),
        ("int64", "(INT_64)"),
        ("int64", "(UINT_64)"),
        ("float", ""),
    ] {
        for compression in [Compression::UNCOMPRESSED, Compression::SNAPPY] {
            let field = format!("required {kind} load_tight_tension_N {annotation};");
            write_column(&path, &field, compression);
            answered(&run(&directory, &table));
            let rows = rows(&directory.join("out.csv"));
            let tensions = rows.iter().map(|row| &*row["load_tight_tension_N"]);
            let tensions: Vec<_> = tensions.collect();
            // Of UINT_8 the lower eight bits are what the file says.
            let expected = match annotation {
                "(UINT_8)" => ["244", "88"],
                _ => ["500", "600"],
            };
            assert_eq!(tensions, expected, "{field}");
        }
    }
    for (kind, annotation) in [
        ("int32", "(DATE)"),
        ("int32", "(DECIMAL(5,2))"),
        ("int32", "(TIME_MILLIS)"),
        ("int64", "(TIMESTAMP_MILLIS)"),
        ("int64", "(TIMESTAMP(NANOS,true))"),
        ("boolean", ""),
    ] {
        let field = format!("required {kind} load_tight_tension_N {annotation};");
        write_column(&path, &field, Compression::UNCOMPRESSED);
        refused(&run(&directory, &table), "of in.parquet holds no numbers");
    }
}

#[test]
fn what_is_no_table_is_one_error() {
    let directory = directory("no-table", "kim2009-flat");
    let stream = b"\xff\xff\xff\xff\x60\0\0\0\x10\0\0\0";
    let utf_16 = b"\xff\xfel\0o\0a\0d\0\n\0";
    for content in [&stream[..], utf_16, b"\x1f\x8b\x08\0\0", b"load\0\n1\n"] {
        fs::write(directory.join("in"), content).unwrap();
        let output = run(&directory, &["--table", "in"]);
        refused(
            &output,
            "error: --table: in is no table; expected CSV in UTF-8",
        );
    }
    // A byte order mark, line ends of other systems, quotes and blank lines are none.
    let table =
        "\u{feff}\"load.tight_tension [N]\",friction.coefficient\r\n500,\"1.1\"\r\n\r\n600,1\r\n";
    fs::write(directory.join("in"), table).unwrap();
    answered(&run(&directory, &["--table", "in", "--csv", "out.csv"]));
    let rows = rows(&directory.join("out.csv"));
    assert_eq!(rows.len(), 2);
    assert_eq!(rows[0]["friction_coefficient"], "1.1");
    // Without rows there is nothing to answer, and the file has its heading.
    fs::write(directory.join("in"), "load.tight_tension\n").unwrap();
    let output = run(&directory, &["--table", "in", "--csv", "out.csv"]);
    answered(&output);
    assert!(String::from_utf8_lossy(&output.stdout).contains("0 of 0 rows answered"));
    let text = fs::read_to_string(directory.join("out.csv")).unwrap();
    assert!(text.starts_with("row,load_tight_tension_N,") && text.lines().count() == 1);
}

#[test]
fn a_table_that_is_read_in_parts_is_the_same() {
    let directory = directory("skipped", "kim2009-flat");
    let lines: Vec<_> = (0..50).map(|index| (300 + index).to_string()).collect();
    let path = directory.join("in.csv");
    fs::write(&path, format!("load.tight_tension\n{}\n", lines.join("\n"))).unwrap();
    let text = examples::find("kim2009-flat").unwrap().text;
    let file = DriveFile::read("drive.toml", text, &[]).unwrap();
    let table = SweepTable::open(&path, &file).unwrap();
    assert_eq!(table.count(), 50);
    let mut rows = table.rows().unwrap();
    rows.skip_to(7).unwrap();
    assert_eq!(rows.next().unwrap().unwrap().values, [307.0]);
    rows.skip_to(40).unwrap();
    let rest: Vec<_> = rows.map(|row| row.unwrap().values[0]).collect();
    assert_eq!(rest, (340..350).map(f64::from).collect::<Vec<_>>());
}
