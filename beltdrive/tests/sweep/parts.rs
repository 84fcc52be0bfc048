//! Sweeps in parts: interrupted, resumed, shared among processes.

#[path = "../support/random.rs"]
mod random;

use super::program::{answered, command, directory, refused, run};
use random::Random;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

/// A sweep of 6000 rows in 60 chunks.
const SWEEP: [&str; 10] = [
    "--over",
    "pulleys.driver.speed=60 rad/s:110 rad/s:100",
    "--over",
    "load.tight_tension=300 N:10 kN:60",
    "--out",
    "rows",
    "--chunk",
    "100",
    "--format",
    "csv",
];
const CHUNKS: usize = 60;

/// The files of a directory with their content.
fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    // A run may be killed before it makes the directory.
    let entries = fs::read_dir(directory.join("rows")).into_iter().flatten();
    entries
        .map(|entry| {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            (name, fs::read(path).unwrap())
        })
        .collect()
}

/// The files of the sweep that nothing interrupts.
fn uninterrupted(name: &str) -> BTreeMap<String, Vec<u8>> {
    let directory = directory(name, "kim2009-flat");
    answered(&run(&directory, &SWEEP));
    files(&directory)
}

/// Checks that every row is there once, in its place.
fn check_rows(files: &BTreeMap<String, Vec<u8>>) {
    let mut next = 0;
    for (name, content) in files.iter().filter(|(name, _)| name.starts_with("part-")) {
        let mut reader = csv::Reader::from_reader(&content[..]);
        for record in reader.records() {
            assert_eq!(record.unwrap()[0], next.to_string(), "{name}");
            next += 1;
        }
    }
    assert_eq!(next, 6000);
}

/// Runs the sweep and ends it at random instants, again and again; returns how often a run was ended and how often
/// the sweep was finished, each time as if nothing had happened.
fn killed(name: &str, kills: usize, seed: u64) -> [usize; 2] {
    let whole = uninterrupted(&format!("{name}-whole"));
    assert_eq!(whole.len(), CHUNKS + 1);
    check_rows(&whole);
    let directory = directory(name, "kim2009-flat");
    let mut random = Random(seed);
    let mut counts = [0; 2];
    while counts[0] < kills || counts[1] == 0 {
        let mut run = command(&directory, &SWEEP)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        if counts[0] < kills {
            sleep(Duration::from_secs_f64(random.between(0.001, 0.25)));
            run.kill().unwrap();
        }
        if run.wait().unwrap().success() {
            let found = files(&directory);
            assert!(found.keys().eq(whole.keys()), "{:?}", found.keys());
            for (name, content) in found.iter().filter(|(name, _)| name.starts_with("part-")) {
                assert!(*content == whole[name], "{name}");
            }
            fs::remove_dir_all(directory.join("rows")).unwrap();
            counts[1] += 1;
        } else {
            counts[0] += 1;
            // What stands is whole.
            let parts = files(&directory)
                .into_iter()
                .filter(|(name, _)| name.starts_with("part-"));
            for (name, content) in parts {
                assert!(content == whole[&name], "{name}");
            }
        }
    }
    counts
}

#[test]
fn no_row_is_lost_or_doubled_where_runs_are_killed() {
    let [kills, finished] = killed("killed", 5, 11);
    assert!(kills == 5 && finished > 0);
}

#[test]
#[ignore = "takes half a minute"]
fn no_row_is_lost_or_doubled_in_fifty_kills() {
    let [kills, finished] = killed("killed-often", 50, 7);
    assert_eq!(kills, 50);
    println!("{kills} runs killed, {finished} sweeps finished");
}

#[test]
fn shards_that_run_together_make_the_whole() {
    let whole = uninterrupted("shards-whole");
    let directory = directory("shards", "kim2009-flat");
    let shards = ["1/3", "2/3", "3/3"].map(|shard| {
        let args = [&SWEEP[..], &["--shard", shard, "--quiet"]].concat();
        command(&directory, &args).spawn().unwrap()
    });
    for mut shard in shards {
        assert!(shard.wait().unwrap().success());
    }
    let found = files(&directory);
    check_rows(&found);
    assert!(found.keys().eq(whole.keys()));
    for (name, content) in found.iter().filter(|(name, _)| name.starts_with("part-")) {
        // The rows are the same; CSV holds nothing else.
        assert!(*content == whole[name], "{name}");
    }
    let again = run(&directory, &SWEEP);
    answered(&again);
    let told = String::from_utf8(again.stdout).unwrap();
    assert!(told.contains("6000 rows stood before"), "{told}");
}

#[test]
fn another_sweep_and_other_files_are_left_alone() {
    let directory = directory("others", "kim2009-flat");
    let small = [
        "--over",
        "load.tight_tension=300 N,400 N",
        "--out",
        "rows",
        "--format",
        "csv",
    ];
    answered(&run(&directory, &small));
    let other = [
        "--over",
        "load.tight_tension=300 N,500 N",
        "--out",
        "rows",
        "--format",
        "csv",
    ];
    refused(
        &run(&directory, &other),
        "rows holds another sweep: `source` differs",
    );
    let set = [&small[..], &["--set", "friction.coefficient=0.5"]].concat();
    refused(&run(&directory, &set), "`set` differs");
    let limits = [&small[..], &["--answer", "limits"]].concat();
    refused(&run(&directory, &limits), "`answer` differs");
    answered(&run(&directory, &small));

    fs::create_dir(directory.join("mine")).unwrap();
    fs::write(directory.join("mine/thesis.txt"), "years").unwrap();
    let into = [
        "--over",
        "load.tight_tension=300 N,400 N",
        "--out",
        "mine",
        "--format",
        "csv",
    ];
    refused(&run(&directory, &into), "mine holds other files");
    let into = [
        "--over",
        "load.tight_tension=300 N,400 N",
        "--out",
        "drive.toml/rows",
    ];
    refused(&run(&directory, &into), "cannot make drive.toml/rows");
}

/// A file size limit stands for a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_is_one_error_and_finished_chunks_stay() {
    let directory = directory("full", "kim2009-flat");
    answered(&run(
        &directory,
        &[&SWEEP[..], &["--shard", "1/30", "--quiet"]].concat(),
    ));
    let before = files(&directory);
    assert_eq!(before.len(), 1 + CHUNKS / 30);
    let script = "ulimit -c 0; ulimit -f 1; trap '' XFSZ; exec \"$0\" \"$@\"";
    let output = std::process::Command::new("sh")
        .args([
            "-c",
            script,
            env!("CARGO_BIN_EXE_beltdrive"),
            "sweep",
            "drive.toml",
        ])
        .args(SWEEP)
        .current_dir(&directory)
        .output()
        .unwrap();
    refused(&output, "error: cannot write rows/part-000001.csv");
    assert_eq!(String::from_utf8(output.stderr).unwrap().lines().count(), 1);
    assert!(files(&directory) == before);
    answered(&run(&directory, &SWEEP));
    check_rows(&files(&directory));
}
