//! Rows from samples.

use super::program::{answered, command, directory, refused, rows, run};
use beltdrive::{LatinHypercube, Sobol};
use std::fs;

/// Two numbers that vary.
const OVER: [&str; 4] = [
    "--over",
    "load.tight_tension=300 N:900 N",
    "--over",
    "friction.coefficient=0.8:1.2",
];

#[test]
fn samples_lie_in_their_ranges_and_are_the_same_again() {
    let directory = directory("sample", "kim2009-flat");
    let ranges = || vec![[300.0, 900.0], [0.8, 1.2]];
    let hypercube: Vec<_> = LatinHypercube::new(ranges(), 40, 1).rows(0).collect();
    let sobol: Vec<_> = Sobol::new(ranges(), 40, 1).rows(0).collect();
    for (method, expected) in [("lhs:40", hypercube), ("sobol:40", sobol)] {
        let sample = |extra: &[&str], csv: &str| {
            let args = [&OVER[..], &["--sample", method, "--csv", csv], extra].concat();
            answered(&run(&directory, &args));
            fs::read_to_string(directory.join(csv)).unwrap()
        };
        let one = sample(&[], "one.csv");
        assert_eq!(one, sample(&["--seed", "1"], "again.csv"));
        assert_ne!(one, sample(&["--seed", "2"], "other.csv"));
        let rows = rows(&directory.join("one.csv"));
        assert_eq!(rows.len(), expected.len());
        for (row, expected) in rows.iter().zip(expected) {
            let found = ["load_tight_tension_N", "friction_coefficient"];
            let found = found.map(|name| row[name].parse::<f64>().unwrap());
            assert_eq!(found[..], expected.values);
            assert_eq!(row["status"], "answered");
        }
    }
    for (args, message) in [
        (&["--sample", "halton:8"][..], "there is no sample `halton`"),
        (&["--sample", "lhs"], "there is no `:`"),
        (&["--sample", "lhs:0"], "N is not a whole number"),
        (&["--sample", "lhs:ten"], "N is not a whole number"),
        (&["--sample", "sobol:-1"], "N is not a whole number"),
        (&["--sample", "sobol:1.5"], "N is not a whole number"),
        (
            &["--sample", "sobol:2000000000000"],
            "from 1 to 1000000000000",
        ),
        (&["--sample", "sobol:"], "N is not a whole number"),
        (
            &["--sample", "sobol:8", "--table", "in.csv"],
            "cannot be used with",
        ),
    ] {
        refused(&run(&directory, &[&OVER[..], args].concat()), message);
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

/// Rows by `args` in one file.
fn whole(directory: &std::path::Path, args: &[&str]) -> String {
    answered(&run(directory, &[args, &["--csv", "whole.csv"]].concat()));
    fs::read_to_string(directory.join("whole.csv")).unwrap()
}

#[test]
fn a_sample_is_the_same_in_parts_in_shards_and_in_any_number_of_threads() {
    let directory = directory("sample-parts", "kim2009-flat");
    for method in ["lhs:90", "sobol:90"] {
        let sample = [&OVER[..], &["--sample", method, "--seed", "4"]].concat();
        let whole = whole(&directory, &sample);
        let out = ["--out", method, "--format", "csv", "--chunk", "20"];
        let parts = [&sample[..], &out].concat();
        // The second shard, a run that is ended by its other half not being there, and the rest on one thread.
        for shard in ["2/3", "1/2"] {
            answered(&run(
                &directory,
                &[&parts[..], &["--shard", shard]].concat(),
            ));
        }
        assert!(!directory.join(method).join("part-000003.csv").exists());
        let rest = command(&directory, &parts)
            .env("RAYON_NUM_THREADS", "1")
            .output();
        answered(&rest.unwrap());
        let texts = (0..5).map(|part| {
            let path = directory.join(format!("{method}/part-{part:06}.csv"));
            let text = fs::read_to_string(path).unwrap();
            text.lines().skip(1).map(str::to_owned).collect::<Vec<_>>()
        });
        let lines: Vec<_> = whole.lines().skip(1).collect();
        assert_eq!(texts.collect::<Vec<_>>().concat(), lines, "{method}");
        // Another seed, and more rows, are another sweep.
        let more = [&OVER[..], &["--sample", "sobol:91", "--seed", "4"], &out].concat();
        refused(&run(&directory, &more), "differs");
    }
    // A larger sample of the sequence begins with the rows of a smaller one.
    let rows = |method| {
        let args = [&OVER[..], &["--sample", method]].concat();
        let text = whole(&directory, &args);
        text.lines().map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(rows("sobol:20"), rows("sobol:30")[..21]);
}
