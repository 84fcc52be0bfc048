//! Rows from tables and samples.

use super::program::{answered, directory, refused, rows, run};
use beltdrive::examples;
use beltdrive::input::DriveFile;
use beltdrive::{LatinHypercube, SweepTable};
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
    fs::write(directory.join("in.parquet"), "PAR1 and then nothing").unwrap();
    refused(
        &run(&directory, &["--table", "in.parquet"]),
        "cannot read in.parquet",
    );
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

#[test]
fn a_sample_lies_in_its_ranges_and_is_the_same_again() {
    let directory = directory("sample", "kim2009-flat");
    let over = [
        "--over",
        "load.tight_tension=300 N:900 N",
        "--over",
        "friction.coefficient=0.8:1.2",
    ];
    let sample = |extra: &[&str], csv: &str| {
        let args = [&over[..], &["--sample", "lhs:40", "--csv", csv], extra].concat();
        answered(&run(&directory, &args));
        fs::read_to_string(directory.join(csv)).unwrap()
    };
    let one = sample(&[], "one.csv");
    assert_eq!(one, sample(&["--seed", "1"], "again.csv"));
    assert_ne!(one, sample(&["--seed", "2"], "other.csv"));
    let expected = LatinHypercube::new(vec![[300.0, 900.0], [0.8, 1.2]], 40, 1);
    for (row, expected) in rows(&directory.join("one.csv"))
        .iter()
        .zip(expected.rows(0))
    {
        let found = ["load_tight_tension_N", "friction_coefficient"];
        let found = found.map(|name| row[name].parse::<f64>().unwrap());
        assert_eq!(found[..], expected.values);
        assert_eq!(row["status"], "answered");
    }
    for (args, message) in [
        (&["--sample", "sobol:8"][..], "there is no sample `sobol`"),
        (&["--sample", "lhs"], "there is no `:`"),
        (&["--sample", "lhs:0"], "N is not a whole number"),
        (&["--sample", "lhs:ten"], "N is not a whole number"),
    ] {
        refused(&run(&directory, &[&over[..], args].concat()), message);
    }
    let steps = [
        "--over",
        "load.tight_tension=300:400:5",
        "--sample",
        "lhs:5",
    ];
    refused(
        &run(&directory, &steps),
        "--sample says how many rows there are",
    );
    let list = ["--over", "load.tight_tension=300,400", "--sample", "lhs:5"];
    refused(&run(&directory, &list), "a sample is one of a range");
}
