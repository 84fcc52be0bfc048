//! Designs: known optima, real drives against grids, conflicts, prices, and faults of `[design]`.

use beltdrive::input::DriveFile;
use beltdrive::{
    CaseState, DesignLimit, Designed, SlipMargin, SolveOptions, Unfit, check, design, examples,
};
use std::f64::consts::PI;
use std::process::Command;

/// A flat belt that hardly stretches round two pulleys.
const STIFF: &str = "
[belt]
type = \"flat\"
mass_per_length = 0.2
axial_stiffness = 1e10
[friction]
law = \"coulomb\"
coefficient = 0.4
[pulleys.driver]
radius = \"100 mm\"
speed = \"1500 rpm\"
[pulleys.driven]
radius = \"200 mm\"
[layout]
centre_distance = \"0.8 m\"
[load]
slack_tractive_tension = \"150 N\"
driven_torque = \"40 N*m\"
[requirements]
smallest_slip_margin = 1.5
";

fn designed(text: &str, overrides: &[&str]) -> Designed {
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let file = DriveFile::read("drive.toml", text, &overrides).unwrap();
    let question = file.design().unwrap_or_else(|error| panic!("{error}"));
    let found = design(&file, &question, &SolveOptions::default(), &mut |_, _| {});
    let found = found.unwrap_or_else(|error| panic!("{error}"));
    println!(
        "{:?} at {:?}, residual {:.1e}, {} drives\n{:#?}",
        found.objective, found.values, found.residual, found.drives, found.limits
    );
    if found.is_feasible {
        assert_eq!(found.checked.failing(), 0);
    }
    found
}

fn is_near(found: f64, expected: f64, relative: f64) {
    let off = (found / expected - 1.0).abs();
    assert!(off < relative, "{found} instead of {expected}: {off:.1e}");
}

/// The price of a limit.
fn price(found: &Designed, limit: DesignLimit) -> f64 {
    let mut limits = found.limits.iter();
    limits
        .find(|known| known.limit == limit)
        .expect("it decides")
        .price
}

/// Wrap on the smaller pulley.
fn wrap(radii: f64, distance: f64) -> f64 {
    PI - 2.0 * (radii / distance).asin()
}

#[test]
fn the_smallest_tension_for_a_margin_is_that_of_euler() {
    let text = STIFF.to_owned()
        + "[design]\nminimise = \"load.slack_tractive_tension\"\n[design.free]\nload.slack_tractive_tension = [\"20 N\", \"2 kN\"]";
    let found = designed(&text, &[]);
    let grip = (0.4 * wrap(0.1, 0.8)).exp() - 1.0;
    let tension = 1.5 * 40.0 / (0.2 * grip);
    is_near(found.values[0], tension, 2e-8);
    assert!(found.residual < 1e-6 && found.is_feasible);
    // The tension is in proportion to the margin.
    is_near(price(&found, DesignLimit::SlipMargin), tension / 1.5, 1e-6);
    assert_eq!(found.limits.len(), 1);
}

#[test]
fn a_larger_small_pulley_needs_less_tension_up_to_its_bound() {
    let text = STIFF.to_owned()
        + "[design]\nminimise = \"load.slack_tractive_tension\"\n[design.free]\n
           load.slack_tractive_tension = [\"20 N\", \"2 kN\"]\npulleys.driver.radius = [\"60 mm\", \"140 mm\"]";
    let found = designed(&text, &[]);
    let tension = |radius: f64| 1.5 * 40.0 / (0.2 * ((0.4 * wrap(0.2 - radius, 0.8)).exp() - 1.0));
    is_near(found.values[0], tension(0.14), 2e-8);
    is_near(found.values[1], 0.14, 1e-12);
    is_near(
        price(&found, DesignLimit::SlipMargin),
        tension(0.14) / 1.5,
        1e-6,
    );
    let slope = (tension(0.1401) - tension(0.1399)) / 2e-4;
    is_near(price(&found, DesignLimit::UpperBound(1)), slope, 1e-5);
}

#[test]
fn the_lightest_belt_has_the_shortest_centre_distance_that_wraps_enough() {
    let text = STIFF.to_owned()
        + "[design]\nminimise = \"belt_mass\"\n[design.free]\nlayout.centre_distance = [\"350 mm\", \"1.5 m\"]";
    let found = designed(&text, &["load.slack_tractive_tension=140 N"]);
    let asked = f64::ln(1.0 + 1.5 * 40.0 / (0.2 * 140.0)) / 0.4;
    let distance = 0.1 / (0.5 * asked).cos();
    is_near(found.values[0], distance, 1e-6);
    let span = (distance * distance - 0.01_f64).sqrt();
    let length = 2.0 * span + 0.1 * asked + 0.2 * (2.0 * PI - asked);
    is_near(found.objective.unwrap(), 0.2 * length, 1e-6);
}

#[test]
fn the_slack_tension_is_least_at_the_speed_of_the_centrifugal_optimum() {
    let text = STIFF.replace("driven_torque = \"40 N*m\"", "power = \"9 kW\"")
        .replace("slack_tractive_tension", "slack_tension")
        .replace("radius = \"200 mm\"", "radius = \"100 mm\"")
        + "[design]\nminimise = \"load.slack_tension\"\n[design.free]\n
           load.slack_tension = [\"50 N\", \"2 kN\"]\npulleys.driver.speed = [\"500 rpm\", \"9000 rpm\"]";
    let found = designed(&text, &[]);
    let grip = (0.4 * PI).exp() - 1.0;
    let speed = (1.5 * 9000.0 / (2.0 * 0.2 * grip)).cbrt();
    is_near(found.values[1], speed / 0.1, 1e-4);
    is_near(found.objective.unwrap(), 3.0 * 0.2 * speed * speed, 1e-6);
    is_near(
        price(&found, DesignLimit::SlipMargin),
        2.0 * 0.2 * speed * speed / 1.5,
        1e-5,
    );
}

#[test]
fn the_narrowest_catalogue_belt_that_creeps_little_enough_is_chosen() {
    // 900 N/mm per width: the creep of Coulomb friction is the difference of the tensions over EA.
    let text = STIFF
        .replace(
            "mass_per_length = 0.2\naxial_stiffness = 1e10",
            "width = \"50 mm\"\nsection = \"HABASIT\"",
        )
        .replace(
            "smallest_slip_margin = 1.5",
            "largest_speed_loss = \"0.3 %\"",
        )
        + "[design]\nminimise = \"width\"\n[design.choose]\nbelt.width = [\"20 mm\", \"30 mm\", \"40 mm\", \"50 mm\"]";
    let sections = beltdrive::sections::SECTIONS.iter();
    let flat = { sections }
        .find(|section| section.family == beltdrive::sections::Family::Flat)
        .unwrap();
    let text = text.replace("HABASIT", flat.name);
    let stiffness = flat.axial_stiffness.unwrap().value;
    let pull = 40.0 / 0.2;
    // Just enough for 27 mm.
    let creep = |width: f64| pull / (stiffness * width);
    let allowed = format!("requirements.largest_speed_loss={}", creep(0.027));
    let found = designed(&text, &[&allowed, "pulleys.driver.radius=200 mm"]);
    is_near(found.objective.unwrap(), 0.030, 1e-12);
    assert_eq!(found.chosen, [1]);
    let outcomes: Vec<_> = found
        .combinations
        .iter()
        .map(|tried| tried.outcome.is_ok())
        .collect();
    assert_eq!(outcomes, [false, true, true, true]);
    // As a free number it ends where the creep does.
    let free = text
        .replace("[design.choose]", "[design.free]")
        .replace(", \"30 mm\", \"40 mm\"", "");
    let found = designed(&free, &[&allowed, "pulleys.driver.radius=200 mm"]);
    is_near(found.values[0], 0.027, 1e-3);
    // One rim speed loss is 1 − (EA + T_1)/(EA + T_2): width and loss are all but in inverse proportion.
    is_near(
        price(&found, DesignLimit::SpeedLoss),
        -found.values[0] / creep(0.027),
        1e-2,
    );
}

#[test]
fn an_optimum_where_both_pulleys_slip_at_once_has_its_price() {
    // A larger driver has more wrap itself and leaves the driven pulley less: the tension is least where both slip.
    let text = "
[belt]
type = \"flat\"
mass_per_length = 0.2
axial_stiffness = 1e10
[friction]
law = \"coulomb\"
coefficient = 0.35
[[pulley]]
name = \"motor\"
centre = [0, 0]
radius = \"60 mm\"
speed = \"1500 rpm\"
friction_coefficient = 0.45
[[pulley]]
name = \"fan\"
centre = [0.5, 0]
radius = \"200 mm\"
torque = \"40 N*m\"
[load]
span = \"motor\"
span_tractive_tension = \"200 N\"
[requirements]
smallest_slip_margin = 1.5
[design]
minimise = \"load.span_tractive_tension\"
[design.free]
load.span_tractive_tension = [\"50 N\", \"1 kN\"]
pulley.motor.radius = [\"40 mm\", \"180 mm\"]
";
    let found = designed(text, &[]);
    // 0.45 (π − a) = 0.35 (π + a).
    let half = 0.5 * PI * 0.1 / 0.8;
    is_near(found.values[1], 0.2 - 0.5 * half.sin(), 1e-6);
    let grip = (0.35 * (PI + 2.0 * half)).exp() - 1.0;
    is_near(found.values[0], 1.5 * 40.0 / (0.2 * grip), 1e-7);
    is_near(
        price(&found, DesignLimit::SlipMargin),
        found.values[0] / 1.5,
        1e-4,
    );
    assert!(found.residual < 1e-4, "{}", found.residual);
}

#[test]
fn the_least_tension_of_a_v_belt_is_that_of_the_command_tension() {
    let text = example(
        "v-power",
        "[requirements]\nsmallest_slip_margin = 1.5\n[design]\nminimise = \"load.setup_tension\"\n[design.free]\n
         load.setup_tension = [\"100 N\", \"1 kN\"]",
    );
    let found = designed(&text, &["load.setup_tension=400 N"]);
    let service = found.file.service().unwrap();
    let question = beltdrive::SetupQuestion {
        slip_margin: 1.5,
        elongation: 0.005,
        moved: None,
    };
    let set = beltdrive::tension(&service, question, &SolveOptions::default(), &mut |_, _| {});
    is_near(found.values[0], set.unwrap().tension, 3e-4);
    assert!(found.is_feasible);
}

#[test]
fn questions_with_little_to_choose_have_answers() {
    let table = |rest: &str| {
        example(
            "back-side-idler",
            &format!(
                "[requirements]\nsmallest_slip_margin = 2\n[design]\nminimise = \"loss\"\n{rest}"
            ),
        )
    };
    // A list with one entry, and no number that is free.
    let found = designed(
        &table("[design.choose]\nload.setup_tension = [\"300 N\"]"),
        &[],
    );
    assert!(found.is_feasible && found.combinations.len() == 1 && found.limits.is_empty());
    let found = designed(
        &table("[design.choose]\nload.setup_tension = [\"150 N\", \"200 N\"]"),
        &[],
    );
    assert!(!found.is_feasible);
    assert_eq!(found.chosen, [1]);
    assert_eq!(found.limits[0].limit, DesignLimit::SlipMargin);
    // Quoted paths, a number that changes nothing, and bounds that are both too small.
    let found = designed(
        &table(
            "[design.free]\n\"load.setup_tension\" = [\"20 N\", \"40 N\"]\npulley.motor.speed = [\"100 rpm\", \"120 rpm\"]",
        ),
        &[],
    );
    assert!(!found.is_feasible && found.objective.is_none());
    // Nowhere a belt that could be laid round the pulleys.
    let text = table("[design.free]\npulley.fan.radius = [\"600 mm\", \"800 mm\"]");
    let file = DriveFile::read("drive.toml", &text, &[]).unwrap();
    let error = design(
        &file,
        &file.design().unwrap(),
        &SolveOptions::default(),
        &mut |_, _| {},
    )
    .unwrap_err();
    assert!(
        error
            .to_string()
            .contains("no drive that was tried has a steady state"),
        "{error}"
    );
    // Two numbers that say the same: the sum of both is what counts.
    let found = designed(
        &table("[design.free]\nload.setup_tension = [\"100 N\", \"1 kN\"]\npulley.fan.centre.y = [\"30 mm\", \"60 mm\"]\n
                pulley.idler.centre.y = [\"20 mm\", \"40 mm\"]"),
        &[],
    );
    assert!(
        found.is_feasible && found.residual < 1e-4,
        "{}",
        found.residual
    );
    // What nothing depends on is said.
    let coulomb = table("[design.free]\nload.setup_tension = [\"100 N\", \"1 kN\"]\nfriction.velocity = [\"1 mm/s\", \"1 m/s\"]")
        .replace("coefficient = 0.7", "coefficient = 0.7\nvelocity = 0.02");
    assert_eq!(designed(&coulomb, &[]).idle, [1]);
}

/// An example with a table `[design]`.
fn example(name: &str, design: &str) -> String {
    format!("{}\n{design}", examples::find(name).unwrap().text)
}

#[test]
fn prices_are_differences_of_optima_when_a_limit_moves() {
    let text = example(
        "back-side-idler",
        "[requirements]\nsmallest_slip_margin = 2\n[design]\nminimise = \"hub_load\"\n[design.free]\n
         load.setup_tension = [\"100 N\", \"1 kN\"]\npulley.idler.centre.y = [\"-10 mm\", \"70 mm\"]\n
         pulley.idler.radius = [\"25 mm\", \"40 mm\"]",
    );
    let found = designed(&text, &[]);
    assert!(found.is_feasible && found.residual < 1e-5);
    let optimum = |overrides: &[&str]| designed(&text, overrides).objective.unwrap();
    let slope = (optimum(&["requirements.smallest_slip_margin=2.002"])
        - optimum(&["requirements.smallest_slip_margin=1.998"]))
        / 0.004;
    is_near(price(&found, DesignLimit::SlipMargin), slope, 1e-4);
}

#[test]
fn designs_of_real_drives_are_better_than_grids() {
    let idler = (
        example(
            "back-side-idler",
            "[requirements]\nsmallest_slip_margin = 2\n[design]\nminimise = \"hub_load\"\n[design.free]\n
             load.setup_tension = [\"100 N\", \"1 kN\"]\npulley.idler.centre.y = [\"-10 mm\", \"70 mm\"]",
        ),
        60,
    );
    let serpentine = (
        example(
            "serpentine-cases",
            "[design]\nminimise = \"hub_load\"\n[design.free]\n
             tensioner.arm.free_angle = [\"0 deg\", \"60 deg\"]\nbelt.axial_stiffness = [\"80 kN\", \"300 kN\"]",
        ),
        40,
    );
    for (text, count) in [idler, serpentine] {
        let found = designed(&text, &[]);
        assert!(found.is_feasible);
        let file = DriveFile::read("drive.toml", &text, &[]).unwrap();
        let question = file.design().unwrap();
        let mut best = f64::INFINITY;
        let at = |free: usize, index: usize| {
            let [low, high] = question.free[free].bounds;
            low + (high - low) * index as f64 / f64::from(count - 1)
        };
        for (x, y) in (0..count as usize).flat_map(|x| (0..count as usize).map(move |y| (x, y))) {
            let changed = file
                .with(&question.free[0].key, at(0, x))
                .with(&question.free[1].key, at(1, y));
            let Ok(service) = changed.service() else {
                continue;
            };
            let checked = check(&service, &SolveOptions::default(), &mut |_, _| {}).unwrap();
            if checked.failing() == 0 {
                let hub = |state: &CaseState| state.hub_load.value.max(state.rest_hub_load.value);
                let states = checked
                    .cases
                    .iter()
                    .map(|case| case.outcome.as_ref().unwrap());
                best = states.map(|state| hub(state)).fold(0.0, f64::max).min(best);
            }
        }
        println!("grid {best}");
        assert!(best.is_finite() && found.objective.unwrap() < best * (1.0 + 1e-9));
    }
}

#[test]
fn limits_in_conflict_are_named_with_what_they_cost() {
    let text = example(
        "back-side-idler",
        "[requirements]\nsmallest_slip_margin = 2\nlargest_hub_load = \"380 N\"\n
         [design]\nminimise = \"loss\"\n[design.free]\n
         load.setup_tension = [\"100 N\", \"1 kN\"]",
    );
    let found = designed(&text, &[]);
    assert!(!found.is_feasible);
    let names: Vec<_> = found.limits.iter().map(|limit| limit.limit).collect();
    assert_eq!(names, [DesignLimit::SlipMargin, DesignLimit::HubLoad]);
    // Both are missed by the same share.
    let [slip, hub] = &found.limits[..] else {
        panic!()
    };
    is_near(
        hub.found / hub.allowed - 1.0,
        1.0 - slip.found / slip.allowed,
        1e-4,
    );
    // A tension that is too small: the bound is in conflict with the margin.
    let bounded = text
        .replace("\"1 kN\"]", "\"180 N\"]")
        .replace("380 N", "9 kN");
    let found = designed(&bounded, &[]);
    let names: Vec<_> = found.limits.iter().map(|limit| limit.limit).collect();
    assert_eq!(names, [DesignLimit::SlipMargin, DesignLimit::UpperBound(0)]);
    // Even without a state anywhere the margin is known.
    let found = designed(&bounded, &["pulley.fan.torque=60 N*m"]);
    let names: Vec<_> = found.limits.iter().map(|limit| limit.limit).collect();
    assert_eq!(names, [DesignLimit::SlipMargin, DesignLimit::UpperBound(0)]);
    assert!(found.objective.is_none());
    let Err(Unfit::Misses(share)) = found.combinations[0].outcome else {
        panic!()
    };
    assert!(share > 0.5 && share < 1.0, "{share}");
}

#[test]
fn a_largest_tension_holds_a_design_back_and_fails_a_check() {
    // More tension would do with less wrap: the tight span stands no more.
    let text = STIFF.replace("smallest_slip_margin = 1.5", "smallest_slip_margin = 1.5\nlargest_tension = \"400 N\"")
        + "[design]\nminimise = \"layout.centre_distance\"\n[design.free]\n
           load.slack_tractive_tension = [\"20 N\", \"2 kN\"]\nlayout.centre_distance = [\"310 mm\", \"2 m\"]";
    let found = designed(&text, &[]);
    // The belt takes up m v² and pulls 200 N more in the tight span.
    let taken_up = 0.2 * (0.1 * 1500.0 * PI / 30.0_f64).powi(2);
    let slack = 400.0 - taken_up - 200.0;
    is_near(found.values[0], slack, 1e-6);
    let asked = f64::ln(1.0 + 1.5 * 200.0 / slack) / 0.4;
    is_near(found.values[1], 0.1 / (0.5 * asked).cos(), 1e-5);
    let names: Vec<_> = found.limits.iter().map(|limit| limit.limit).collect();
    assert_eq!(names, [DesignLimit::SlipMargin, DesignLimit::Tension]);
    let text = text.replace("400 N", "340 N");
    let (code, out, errors) = run(&["check", "-"], &text);
    assert_eq!(code, Some(3), "{errors}");
    assert!(
        out.contains("the belt tension behind pulley `driven` is"),
        "{out}"
    );
}

#[test]
fn the_margin_of_the_designed_drive_is_the_asked_one() {
    let text = STIFF.to_owned()
        + "[design]\nminimise = \"load.slack_tractive_tension\"\n[design.free]\nload.slack_tractive_tension = [\"20 N\", \"2 kN\"]";
    let found = designed(&text, &[]);
    // As written to a file and read again.
    let written = found.file.rewritten().unwrap();
    let again = DriveFile::read("again.toml", &written, &[]).unwrap();
    let checked = check(
        &again.service().unwrap(),
        &SolveOptions::default(),
        &mut |_, _| {},
    )
    .unwrap();
    assert_eq!(checked.failing(), 0);
    let SlipMargin::Factor(margin) = checked.cases[0].outcome.as_ref().unwrap().slip_margin else {
        panic!()
    };
    is_near(margin.value, 1.5, 1e-7);
}

/// Runs the program on a text from standard input.
fn run(arguments: &[&str], text: &str) -> (Option<i32>, String, String) {
    use std::io::Write;
    let mut program = Command::new(env!("CARGO_BIN_EXE_beltdrive"))
        .args(arguments)
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = program.stdin.take().unwrap();
    input.write_all(text.as_bytes()).unwrap();
    drop(input);
    let output = program.wait_with_output().unwrap();
    let [out, errors] = [output.stdout, output.stderr].map(|text| String::from_utf8(text).unwrap());
    (output.status.code(), out, errors)
}

#[test]
fn faults_of_a_design_are_said_with_their_place() {
    let cases = [
        (
            "minimise = \"hub_load\"",
            "nothing says what the design may change",
        ),
        ("minimize = \"hub_load\"", "did you mean `minimise`"),
        (
            "minimise = \"hubload\"\n[design.free]\nload.setup_tension = [100, 200]",
            "did you mean `hub_load`",
        ),
        ("minimise = 3", "must be a text"),
        (
            "[design.free]\nload.setup_tension = [100, 200]",
            "missing key `minimise`",
        ),
        ("minimise = \"loss\"\nfree = 3", "must be a table"),
        (
            "minimise = \"loss\"\n[design.free]\nload.setup_tenson = [100, 200]",
            "did you mean `load.setup_tension`",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nload.power = [100, 200]",
            "gives no number `load.power`",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nrequirements.largest_hub_load = [1, 2]",
            "does not change the steady state",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nload.setup_tension = [\"200 N\", \"100 N\"]",
            "in reverse order",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nload.setup_tension = [\"200 N\", \"200 N\"]",
            "are the same",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nload.setup_tension = [\"200 N\"]",
            "must have two bounds, got 1",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nload.setup_tension = \"200 N\"",
            "must be an array of bounds",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nload.setup_tension = [\"200 N\", \"30 mm\"]",
            "wrong dimension: expected a force",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nload.setup_tension = [0, 30]",
            "must be positive",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nbelt.type = [\"flat\", \"v\"]",
            "gives no number `belt.type`",
        ),
        (
            "minimise = \"loss\"\n[design.choose]\nbelt.section = [\"SPA\"]",
            "gives no `belt.section`",
        ),
        (
            "minimise = \"loss\"\n[design.choose]\nfriction.law = [\"coulomb\", \"ep\"]",
            "did you mean `epp`",
        ),
        (
            "minimise = \"loss\"\n[design.choose]\nfriction.law = []",
            "no value to choose",
        ),
        (
            "minimise = \"loss\"\n[design.choose]\nfriction.coefficient = [0.5, 0.5]",
            "stands twice",
        ),
        (
            "minimise = \"loss\"\n[design.choose]\nfriction.coefficient = [0.5, [0.6]]",
            "must be a quantity",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nload.setup_tension = [100, 200]\n[design.choose]\nload.setup_tension = [100, 200]",
            "stands twice in [design]",
        ),
        (
            "minimise = \"width\"\n[design.free]\nload.setup_tension = [100, 200]",
            "nothing of the width",
        ),
        (
            "minimise = \"belt.axial_stiffness\"\n[design.free]\nload.setup_tension = [100, 200]",
            "a key of [design.free]",
        ),
        (
            "minimise = \"loss\"\n[design.free]\nload.setup_tension = [100, 200]\nload.setup_tension = [100, 300]",
            "duplicate key",
        ),
    ];
    for (table, word) in cases {
        let table = match table.starts_with('[') {
            true => table.replace("[design.free]", "[design]\n[design.free]"),
            false => format!("[design]\n{table}"),
        };
        let (code, _, errors) = run(&["design", "-"], &example("back-side-idler", &table));
        assert_eq!(code, Some(2), "{word}: {errors}");
        assert!(
            errors.contains(word) && errors.contains("-->"),
            "{word}: {errors}"
        );
        println!("{errors}");
    }
    let (code, _, errors) = run(
        &["design", "-"],
        examples::find("back-side-idler").unwrap().text,
    );
    assert!(
        code == Some(2) && errors.contains("missing table [design]"),
        "{errors}"
    );
    let many: Vec<_> = (1..=1001).map(|index| format!("0.{index:04}")).collect();
    let table = format!(
        "[design]\nminimise = \"loss\"\n[design.choose]\nfriction.coefficient = [{}]",
        many.join(", ")
    );
    let (code, _, errors) = run(&["design", "-"], &example("back-side-idler", &table));
    assert!(
        code == Some(2) && errors.contains("1001 combinations"),
        "{errors}"
    );
}

#[test]
fn the_program_tells_the_design_and_writes_it() {
    let text = example(
        "back-side-idler",
        "[requirements]\nsmallest_slip_margin = 2\n[design]\nminimise = \"hub_load\"\n[design.free]\n
         load.setup_tension = [\"100 N\", \"1 kN\"]\nbelt.mass_per_length = [\"0.1 kg/m\", \"0.2 kg/m\"]\n
         [design.choose]\npulley.idler.radius = [\"30 mm\", \"40 mm\"]",
    );
    let (code, out, errors) = run(&["design", "-"], &text);
    println!("{out}{errors}");
    assert_eq!(code, Some(0), "{errors}");
    let (code, out, _) = run(&["design", "-", "--out", "-", "--quiet"], &text);
    assert_eq!(code, Some(0));
    let (code, checked, errors) = run(&["check", "-"], &out);
    println!("{out}{checked}{errors}");
    assert_eq!(code, Some(0));
    let tight = text.replace(
        "smallest_slip_margin = 2",
        "smallest_slip_margin = 2\nlargest_hub_load = \"300 N\"",
    );
    let (code, out, errors) = run(&["design", "-"], &tight);
    println!("{out}{errors}");
    assert_eq!(code, Some(3));
    let (code, _, errors) = run(
        &["design", "-"],
        &text.replace("\"20 N*m\"", "\"20 N*m\"\ncolour = 3"),
    );
    assert!(code == Some(2) && errors.contains("colour"), "{errors}");
}

#[test]
#[ignore = "a survey of some minutes"]
fn a_v_belt_drive_is_better_than_a_grid() {
    let text = example(
        "v-power",
        "[requirements]\nsmallest_slip_margin = 1.5\nlargest_hub_load = \"1.2 kN\"\n[design]\nminimise = \"loss\"\n[design.free]\n
         load.setup_tension = [\"150 N\", \"1 kN\"]\nlayout.centre_distance = [\"400 mm\", \"700 mm\"]",
    );
    let closed = ["load.setup_tension=400 N".to_owned()];
    let found = designed(&text, &["load.setup_tension=400 N"]);
    assert!(found.is_feasible);
    let file = DriveFile::read("drive.toml", &text, &closed).unwrap();
    let question = file.design().unwrap();
    let at = |free: usize, index: usize| {
        let [low, high] = question.free[free].bounds;
        low + (high - low) * index as f64 / 11.0
    };
    let mut best = f64::INFINITY;
    for (x, y) in (0..12).flat_map(|x| (0..12).map(move |y| (x, y))) {
        let changed = file
            .with(&question.free[0].key, at(0, x))
            .with(&question.free[1].key, at(1, y));
        let service = changed.service().unwrap();
        let checked = check(&service, &SolveOptions::default(), &mut |_, _| {}).unwrap();
        if checked.failing() == 0 {
            best = checked.cases[0]
                .outcome
                .as_ref()
                .unwrap()
                .losses
                .total
                .min(best);
        }
    }
    println!("grid {best}");
    assert!(best.is_finite() && found.objective.unwrap() < best * (1.0 + 2e-4));
}
