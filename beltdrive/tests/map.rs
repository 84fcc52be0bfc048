//! Maps of states over two numbers: every point is what `solve` finds there.

use beltdrive::belt_loop::{LoopState, Varied, solve_to, solve_with_margins};
use beltdrive::input::{Argument, DriveFile};
use beltdrive::report::{NoTable, lookup_tables};
use beltdrive::{MapAxis, MapState, OperatingMap, SlipMargin, SolveOptions, examples, map};

const OPTIONS: SolveOptions = SolveOptions { tolerance: 1e-6 };

fn file(name: &str, overrides: &[&str]) -> DriveFile {
    let text = examples::find(name).unwrap().text;
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    DriveFile::read(name, text, &overrides).unwrap()
}

fn varied(file: &DriveFile, value: &str) -> Varied {
    let option = "--x";
    match value {
        "load_factor" => Varied::LoadFactor,
        value => Varied::Key(file.key(Argument { option, value }).unwrap()),
    }
}

/// A map over shares of two numbers that the file gives.
fn mapped(file: &DriveFile, axes: [(&str, [f64; 2], usize); 2]) -> OperatingMap {
    let [x, y] = axes.map(|(path, range, count)| {
        let varied = varied(file, path);
        let given = match &varied {
            Varied::Key(key) => file.value(key).unwrap(),
            Varied::LoadFactor => 1.0,
        };
        MapAxis::over(varied, range.map(|share| share * given), count)
    });
    map(file, x, y, &OPTIONS, &mut |_, _| {}).unwrap()
}

/// What `solve` finds at a point whose axes are numbers of the file.
fn solved(file: &DriveFile, map: &OperatingMap, values: [f64; 2]) -> Option<LoopState> {
    let mut file = file.clone();
    for (axis, value) in [&map.x, &map.y].into_iter().zip(values) {
        let Varied::Key(key) = &axis.varied else {
            panic!("a number of the file");
        };
        file = file.with(key, value);
    }
    solve_to(&file.drive().unwrap(), &OPTIONS).ok()
}

/// How far the numbers of a point are from those of a state, relative to what they are differences of.
fn deviation(point: &MapState, state: &LoopState) -> f64 {
    let largest = |value: fn(&beltdrive::belt_loop::PulleyState) -> f64| {
        state.pulleys.iter().map(value).fold(0.0, f64::max)
    };
    let hub = |[x, y]: [f64; 2]| x.hypot(y);
    let tension = state
        .spans
        .iter()
        .map(|span| span.tension)
        .fold(0.0, f64::max);
    let scaled = [
        (
            point.hub_load.value,
            state
                .pulleys
                .iter()
                .map(|p| hub(p.hub_load))
                .fold(0.0, f64::max),
            tension,
        ),
        (point.rest_tension, state.rest_tension, tension),
        (point.largest_tension, tension, tension),
        (point.power_in, state.power_in, state.power_in),
        (point.power_out, state.power_out, state.power_in),
        (point.efficiency.unwrap(), state.efficiency.unwrap(), 1.0),
        (
            point.speed_loss.value,
            largest(|pulley| pulley.speed_loss),
            1.0,
        ),
    ];
    let deviations = scaled.map(|(found, expected, scale)| ((found - expected) / scale).abs());
    deviations.into_iter().fold(0.0, f64::max)
}

/// Compares every so manieth point with `solve`; returns how many have a state and how many have none.
fn compared(file: &DriveFile, map: &OperatingMap, stride: usize, limit: f64) -> [usize; 2] {
    let mut counts = [0; 2];
    for (values, point) in map.rows().step_by(stride) {
        match (point, solved(file, map, values)) {
            (Ok(point), Some(state)) => {
                let deviation = deviation(point, &state);
                assert!(deviation < limit, "{values:?}: {deviation:e}");
                counts[0] += 1;
            }
            (Err(_), None) => counts[1] += 1,
            (Ok(_), None) => panic!("{values:?} has no state"),
            (Err(refusal), Some(_)) => panic!("{values:?} has a state: {refusal}"),
        }
    }
    counts
}

#[test]
fn points_of_flat_belts_are_those_of_solve() {
    for (name, load) in [
        ("kim2009-flat", "load.tight_tension"),
        ("conveyor", "load.torque"),
    ] {
        let file = file(name, &[]);
        if !file.keys().iter().any(|key| key.path() == load) {
            continue;
        }
        let speed = MapAxis::speed(&file).unwrap().varied.name();
        let map = mapped(&file, [(&speed, [0.5, 1.2], 5), (load, [0.3, 6.0], 7)]);
        let [states, _] = compared(&file, &map, 1, 1e-11);
        assert!(states > 10, "{name}: {states}");
    }
}

#[test]
fn points_with_bristles_are_those_of_solve_up_to_the_limit() {
    let file = file("v-power", &[]);
    let axes = [
        ("pulleys.driver.speed", [0.5, 1.2], 3),
        ("load.power", [0.2, 1.5], 8),
    ];
    let map = mapped(&file, axes);
    let [states, refused] = compared(&file, &map, 1, 1e-5);
    assert!(states > 12 && refused >= 2, "{states} {refused}");
    // The margin of a line is found once; that of each point is the same.
    for values in [[0, 0], [1, 4]] {
        let [x, y] = [map.x.values[values[0]], map.y.values[values[1]]];
        let (Varied::Key(speed), Varied::Key(power)) = (&map.x.varied, &map.y.varied) else {
            panic!("numbers of the file");
        };
        let drive = file.with(speed, x).with(power, y).drive().unwrap();
        let state = solve_with_margins(&drive, &OPTIONS).unwrap();
        let expected = state.load_limit.unwrap().factor;
        let Ok(MapState {
            slip_margin: SlipMargin::Factor(margin),
            ..
        }) = map.at(values[0], values[1])
        else {
            panic!("a state with a margin");
        };
        assert!(
            (margin.value / expected - 1.0).abs() < 1e-4,
            "{} {expected}",
            margin.value
        );
    }
}

#[test]
fn axes_may_change_places() {
    let file = file("v-power", &[]);
    let (speed, power) = (
        ("pulleys.driver.speed", [0.8, 1.2], 2),
        ("load.power", [0.3, 1.2], 3),
    );
    let [one, other] = [[speed, power], [power, speed]].map(|axes| mapped(&file, axes));
    for x in 0..2 {
        for y in 0..3 {
            let [Ok(one), Ok(other)] = [one.at(x, y), other.at(y, x)] else {
                panic!("a state at {x} {y}");
            };
            assert_eq!(one, other);
        }
    }
}

#[test]
fn tables_have_the_layout_of_the_modelica_standard_library() {
    let file = file("serpentine", &[]);
    let speed = MapAxis::speed(&file).unwrap().varied;
    let x = MapAxis::over(speed, [100.0, 120.0], 3);
    let y = MapAxis::over(Varied::LoadFactor, [0.5, 1.0], 2);
    let map = map(&file, x, y, &OPTIONS, &mut |_, _| {}).unwrap();
    let text = lookup_tables(&map).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("#1"));
    let mut names = Vec::new();
    while let Some(comment) = lines.next() {
        assert!(comment.starts_with("# "), "{comment}");
        let head = lines.next().unwrap();
        let name = head
            .strip_prefix("double ")
            .unwrap()
            .strip_suffix("(4,3)")
            .unwrap();
        names.push(name.to_owned());
        let numbers = |line: &str| -> Vec<f64> {
            line.split(' ')
                .map(|number| number.parse().unwrap())
                .collect()
        };
        assert_eq!(numbers(lines.next().unwrap()), [0.0, 0.5, 1.0]);
        for (column, at) in map.x.values.iter().enumerate() {
            let row = numbers(lines.next().unwrap());
            assert_eq!((row.len(), row[0]), (3, *at));
            for place in 0..2 {
                let state = map.at(column, place).as_ref().unwrap();
                match name {
                    "speed_loss" => assert_eq!(row[1 + place], state.speed_loss.value),
                    "hub_load_N" => assert_eq!(row[1 + place], state.hub_load.value),
                    _ => {}
                }
            }
        }
    }
    assert!(
        [
            "speed_loss",
            "efficiency",
            "slip_margin",
            "hub_load_N",
            "power_in_W"
        ]
        .iter()
        .all(|name| names.iter().any(|other| other == name)),
        "{names:?}"
    );
}

#[test]
fn a_table_has_no_place_for_missing_points_and_falling_axes() {
    let file = file("serpentine", &[]);
    let speed = MapAxis::speed(&file).unwrap().varied;
    let of = |speeds, loads| {
        let x = MapAxis::over(speed.clone(), speeds, 2);
        let y = MapAxis::over(Varied::LoadFactor, loads, 3);
        map(&file, x, y, &OPTIONS, &mut |_, _| {}).unwrap()
    };
    let missing = of([100.0, 120.0], [0.5, 1000.0]);
    assert_eq!(
        lookup_tables(&missing),
        Err(NoTable::Missing {
            missing: 4,
            points: 6,
            rows: Some(1)
        })
    );
    assert_eq!(missing.points.len(), 6);
    let falling = of([120.0, 100.0], [0.5, 1.0]);
    assert!(matches!(lookup_tables(&falling), Err(NoTable::Falling(_))));
}

#[test]
fn maps_go_between_threads() {
    fn is_shared<T: Send + Sync>() {}
    is_shared::<OperatingMap>();
}
