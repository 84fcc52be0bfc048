//! Sweeps: every row is what the command finds for one drive, and none is lost.

#[cfg(feature = "arrow")]
mod arrow;
mod faults;
mod parts;
mod program;
mod samples;
mod tables;

use beltdrive::belt_loop::{self, Refusal, Varied};
use beltdrive::input::{Argument, DriveFile};
use beltdrive::quantity::{self, sweep::Columns};
use beltdrive::report::{Field, Head, Rows};
use beltdrive::{
    Grid, SolveOptions, StateSummary, Sweep, SweepQuestion, SweepRow, Swept, examples, limits,
    solve, trace,
};

const OPTIONS: SolveOptions = SolveOptions { tolerance: 1e-6 };

fn file(name: &str, overrides: &[&str]) -> DriveFile {
    let text = examples::find(name).unwrap().text;
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    DriveFile::read(name, text, &overrides).unwrap()
}

fn varied(file: &DriveFile, paths: &[&str]) -> Vec<Varied> {
    let option = "--over";
    let varied = paths.iter().map(|value| match *value {
        "load_factor" => Varied::LoadFactor,
        value => Varied::Key(file.key(Argument { option, value }).unwrap()),
    });
    varied.collect()
}

/// The answers of a grid of shares of numbers of a file, with its rows.
fn swept(
    file: &DriveFile,
    axes: &[(&str, &[f64])],
    question: SweepQuestion,
) -> Vec<(SweepRow, Result<Swept, Refusal>)> {
    let paths: Vec<_> = axes.iter().map(|(path, _)| *path).collect();
    let varied = varied(file, &paths);
    let values = axes.iter().zip(&varied).map(|((_, shares), varied)| {
        let given = match varied {
            Varied::Key(key) => file.value(key).unwrap(),
            Varied::LoadFactor => 1.0,
        };
        shares.iter().map(|share| share * given).collect()
    });
    let grid = Grid::new(values.collect());
    let sweep = Sweep::new(file, varied, question, OPTIONS).unwrap();
    let rows: Vec<_> = grid.rows(0).collect();
    let answers = sweep.answer(&rows, |index, _, answer| (index, answer.clone()));
    assert!(
        answers
            .iter()
            .enumerate()
            .all(|(place, (index, _))| place == *index)
    );
    let answers = answers.into_iter().map(|(_, answer)| answer);
    rows.into_iter().zip(answers).collect()
}

/// The drive file of a row.
fn with(file: &DriveFile, paths: &[&str], row: &SweepRow) -> DriveFile {
    let varied = varied(file, paths);
    let pairs = varied.iter().zip(&row.values);
    pairs.fold(file.clone(), |file, (varied, &value)| match varied {
        Varied::Key(key) => file.with(key, value),
        Varied::LoadFactor => file,
    })
}

#[test]
fn rows_of_two_pulleys_are_those_of_solve() {
    for (name, paths, limit) in [
        (
            "kim2009-flat",
            ["pulleys.driver.speed", "load.tight_tension"],
            0.0,
        ),
        (
            "kim2009-bristle",
            ["friction.coefficient", "load.tight_tractive_tension"],
            1e-5,
        ),
    ] {
        let file = file(name, &[]);
        let axes = [
            (paths[0], &[0.8, 1.1][..]),
            (paths[1], &[0.8, 1.0, 1.3, 60.0]),
        ];
        let mut counts = [0; 2];
        for (row, answer) in swept(&file, &axes, SweepQuestion::Solve) {
            let drive = with(&file, &paths, &row).drive().unwrap();
            match (answer, solve(&drive, &OPTIONS)) {
                (Ok(Swept::Drive(found)), Ok(expected)) => {
                    let expected = StateSummary::from(&expected);
                    let deviation = (found.driven.angular_speed / expected.driven.angular_speed
                        - 1.0)
                        .abs()
                        .max((found.speed_loss - expected.speed_loss).abs());
                    assert!(deviation <= limit, "{name} {:?}: {deviation:e}", row.values);
                    if limit == 0.0 {
                        assert_eq!(*found, expected);
                    }
                    counts[0] += 1;
                }
                (Err(found), Err(expected)) => {
                    assert_eq!(found.kind(), expected.kind());
                    counts[1] += 1;
                }
                (found, expected) => panic!("{name} {:?}: {found:?} {expected:?}", row.values),
            }
        }
        assert_eq!(counts, [6, 2], "{name}");
    }
}

#[test]
fn rows_of_loops_and_their_limits_are_those_of_single_drives() {
    let file = file("serpentine", &[]);
    let path = "friction.coefficient";
    for (row, answer) in swept(&file, &[(path, &[0.8, 1.2])], SweepQuestion::Solve) {
        let drive = with(&file, &[path], &row).drive().unwrap();
        let Ok(Swept::Loop(found)) = answer else {
            panic!("a state");
        };
        assert_eq!(*found, belt_loop::solve_to(&drive, &OPTIONS).unwrap());
    }
    for (row, answer) in swept(&file, &[(path, &[0.8, 1.2])], SweepQuestion::Limits) {
        let file = with(&file, &[path], &row);
        let Ok(Swept::LoopLimits(found)) = answer else {
            panic!("limits");
        };
        let expected = belt_loop::limits(&file, &Varied::LoadFactor, &OPTIONS, &mut |_, _| {});
        assert_eq!(
            found.largest.point.value,
            expected.unwrap().largest.point.value
        );
    }
    let flat = self::file("kim2009-flat", &[]);
    for (row, answer) in swept(&flat, &[(path, &[0.8, 1.2])], SweepQuestion::Limits) {
        let drive = with(&flat, &[path], &row).drive().unwrap();
        let Ok(Swept::DriveLimits(found)) = answer else {
            panic!("limits");
        };
        let key = beltdrive::input::Key::load(&drive);
        let expected = limits(&drive, &key, &OPTIONS, &mut |_, _| {}).unwrap();
        assert_eq!(found.largest, expected.largest);
    }
}

#[test]
fn a_check_is_that_of_the_map_or_of_every_load_case() {
    let file = file("v-power", &[]);
    let axes = [
        ("pulleys.driver.speed", &[0.8][..]),
        ("load.power", &[0.5, 0.7]),
    ];
    let axis = |(path, shares): (&str, &[f64])| {
        let varied = varied(&file, &[path]).remove(0);
        let Varied::Key(key) = &varied else {
            panic!("a number");
        };
        let given = file.value(key).unwrap();
        let values = shares.iter().map(|share| share * given).collect();
        beltdrive::MapAxis { varied, values }
    };
    let [x, y] = axes.map(axis);
    let map = beltdrive::map(&file, x, y, &OPTIONS, &mut |_, _| {}).unwrap();
    let rows = swept(&file, &axes, SweepQuestion::Check);
    for ((_, answer), point) in rows.iter().zip(&map.points) {
        let (Ok(Swept::State(found)), Ok(expected)) = (answer, point) else {
            panic!("states");
        };
        let off = (found.speed_loss.value / expected.speed_loss.value - 1.0).abs();
        assert!(off < 1e-5, "{off:e}");
    }

    let file = self::file("serpentine-cases", &[]);
    let rows = swept(
        &file,
        &[("friction.coefficient", &[0.5, 1.0])],
        SweepQuestion::Check,
    );
    for (row, answer) in rows {
        let service = with(&file, &["friction.coefficient"], &row)
            .service()
            .unwrap();
        let expected = beltdrive::check(&service, &OPTIONS, &mut |_, _| {}).unwrap();
        let Ok(Swept::Cases(found)) = answer else {
            panic!("cases");
        };
        assert_eq!(found.failing(), expected.failing());
    }
}

/// A value of a column of rows.
fn field<'r>(rows: &'r Rows, row: usize, column: &str) -> Option<&'r Field> {
    let place = rows.columns.iter().position(|known| known.name == column);
    let place = place.unwrap_or_else(|| panic!("no column {column}"));
    rows.rows[row][place].as_ref()
}

#[test]
fn columns_are_those_of_a_branch() {
    for (name, path, range) in [
        ("kim2009-flat", "load.tight_tension", [700.0, 800.0]),
        (
            "kim2009-bristle",
            "load.tight_tractive_tension",
            [700.0, 800.0],
        ),
    ] {
        let file = file(name, &[]);
        let drive = file.drive().unwrap();
        let option = "--parameter";
        let key = Argument {
            option,
            value: path,
        }
        .key(&drive)
        .unwrap();
        let branch = trace(&drive, &key, range, &OPTIONS, &mut |_, _| {}).unwrap();
        compared(
            &file,
            path,
            range[0],
            &Rows::of(&quantity::branch::answer(&branch)),
        );
    }
    let file = file("serpentine", &[]);
    let path = "friction.coefficient";
    let varied = varied(&file, &[path]).remove(0);
    let branch = belt_loop::trace(&file, &varied, [0.5, 0.6], &OPTIONS, &mut |_, _| {}).unwrap();
    compared(
        &file,
        path,
        0.5,
        &Rows::of(&quantity::loop_range::branch(&branch)),
    );
}

/// Compares the first state of a branch with that of a sweep: the same names, units and numbers.
fn compared(file: &DriveFile, path: &str, value: f64, branch: &Rows) {
    let varied = varied(file, &[path]);
    let sweep = Sweep::new(file, varied, SweepQuestion::Solve, OPTIONS).unwrap();
    let columns = Columns::new(&sweep);
    let head = Head::of(&columns.quantities());
    let rows = [SweepRow::new(vec![value])];
    let rows = sweep.answer(&rows, |index, row, answer| {
        head.row(columns.values(index, row, answer))
    });
    let own = ["row", "status", "reason", "description", "error_estimate"];
    // A loop has these as a whole, where a branch has them behind the name of its group.
    let whole = |name: &str| format!("loop.0.{name}");
    for (place, column) in head.columns().iter().enumerate().skip(2) {
        if own.contains(&&*column.name) {
            continue;
        }
        let known = branch.columns.iter().map(|known| &known.name);
        let names = [column.name.clone(), whole(&column.name)];
        let name = names
            .iter()
            .find(|name| known.clone().any(|known| known == *name));
        let name = name.unwrap_or_else(|| panic!("a branch has no {}", column.name));
        let (Some(Field::Number(found)), Some(Field::Number(expected))) =
            (&rows[0][place], field(branch, 0, name))
        else {
            panic!("{name} is a number");
        };
        let off = (found - expected).abs() / expected.abs().max(1e-3);
        assert!(off < 1e-4, "{name}: {found} {expected}");
    }
}
