//! What the answers for drives with two pulleys say, as tables, JSON and CSV.

use beltdrive::input::Key;
use beltdrive::quantity::{Answer, UnitSystem, branch, limit_curve, limits, two_pulleys};
use beltdrive::report::{csv, json, table};
use beltdrive::{
    Branch, BranchEnd, Check, Drive, LimitCurve, SolveOptions, SteadyState, Warning, examples,
    input, solve,
};
use serde_json::Value;

fn drive(example: &str, overrides: &[&str]) -> Drive {
    let example = examples::find(example).unwrap();
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    input::parse(example.name, example.text, &overrides).unwrap()
}

fn state(example: &str, overrides: &[&str]) -> SteadyState {
    solve(&drive(example, overrides), &SolveOptions::default()).unwrap()
}

fn of_state(state: &SteadyState) -> Answer {
    two_pulleys::answer(state, two_pulleys::groups(state))
}

fn of_limits(drive: &Drive) -> Answer {
    let options = SolveOptions::default();
    let found = beltdrive::limits(drive, &Key::load(drive), &options, &mut |_, _| {});
    limits::answer(&found.unwrap())
}

fn key(drive: &Drive, path: &str) -> Key {
    Key::all(drive).find(|key| key.path() == path).unwrap()
}

fn traced(drive: &Drive, path: &str, range: [f64; 2]) -> Branch {
    let (key, options) = (key(drive, path), SolveOptions::default());
    beltdrive::trace(drive, &key, range, &options, &mut |_, _| {}).unwrap()
}

fn curve(drive: &Drive, range: [f64; 2]) -> LimitCurve {
    let (load, options) = (Key::load(drive), SolveOptions::default());
    let second = key(drive, "friction.coefficient");
    beltdrive::limit_curve(drive, &load, &second, range, &options, &mut |_, _| {}).unwrap()
}

/// What depends on the mesh, on rounding or on the clock.
const VAGUE: [&str; 9] = [
    "check: ",
    "time ",
    "relative tolerance",
    "estimated error",
    "largest defect",
    "effect of ε",
    "mesh intervals",
    "  driven  ",
    "Newton steps",
];

/// The table in engineering units, without what is vague.
fn shown(answer: &Answer) -> String {
    let text = table(answer, UnitSystem::Engineering);
    let is_vague = |line: &str| VAGUE.iter().any(|start| line.starts_with(start));
    let lines = text.lines().filter(|line| !is_vague(line));
    let lines: Vec<_> = lines.collect();
    lines.join("\n").trim_end().to_owned()
}

fn parsed(answer: &Answer) -> Value {
    serde_json::from_str(&json(answer)).unwrap()
}

/// The columns of a CSV text and its rows.
fn columns(text: &str) -> (Vec<String>, Vec<csv::StringRecord>) {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader
        .headers()
        .unwrap()
        .iter()
        .map(str::to_owned)
        .collect();
    (header, reader.records().map(Result::unwrap).collect())
}

/// The value of a row in a column.
fn field<'a>(table: &'a (Vec<String>, Vec<csv::StringRecord>), row: usize, name: &str) -> &'a str {
    let place = table.0.iter().position(|column| column == name);
    &table.1[row][place.unwrap_or_else(|| panic!("{name} among {:?}", table.0))]
}

/// Reading a number may change its last digit.
#[track_caller]
fn close(found: &Value, expected: f64) {
    let found = found.as_f64().unwrap();
    assert!(
        (found - expected).abs() <= 4e-16 * expected.abs(),
        "{found} for {expected}"
    );
}

#[track_caller]
fn has(report: &Value, keys: &[&str]) {
    for key in keys {
        assert!(report.pointer(key).is_some(), "{key} is missing");
    }
}

#[track_caller]
fn fits(answer: &Answer) {
    for units in [UnitSystem::Si, UnitSystem::Engineering, UnitSystem::Us] {
        let text = table(answer, units);
        let longest = text.lines().map(|line| line.chars().count()).max();
        assert!(longest <= Some(100), "{longest:?}\n{text}");
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
    }
}

#[test]
fn the_state_of_a_v_belt_as_a_table() {
    insta::assert_snapshot!(shown(&of_state(&state("kim2009-bristle", &[]))), @r"
    Kim 2009, table 3, bristle friction
    bristle friction, μ = 0.4, κ = 1620 1/m

                                                    driver                      driven
    speed                                          1000.00                     979.779  rpm
    torque                                         149.084                     146.436  N·m
    power                                          15.6120                     15.0247  kW
    wrap angle                                     197.441                     194.542  °
    of the pitch circles                           180.000                     180.000  °
    largest penetration                            3.78330                     5.07968  mm
    inclination at entry                          −7.06106                    −2.88493  °
    inclination at exit                            10.4022                     11.6344  °
    slip arc                                       44.1561                     138.196  °
    zones                              elastic 0 – 2.23165         elastic 0 – 48.9806  °
      then                          slip 2.23165 – 41.8858      slip 48.9806 – 180.836  °
      then                       elastic 41.8858 – 192.939   elastic 180.836 – 188.201  °
      then                          slip 192.939 – 197.441      slip 188.201 – 194.542  °

                                                    driver                      driven
    hub load                                       800.000                     800.000  N
      direction from x                           −0.136083                     179.864  °

                                                slack span                  tight span
    span from there to                              driven                      driver
    belt tension T                                 171.027                     771.382  N
    tractive tension F                             100.000                     700.000  N
    length                                         1335.60                     1312.18  mm
    first frequency                                8.71681                     29.3171  Hz

    belt length, unstretched                       4322.35  mm
    mass flow                                      2.76768  kg/s
    speed loss                                     2.02214  %
    efficiency                                     96.2380  %
    friction loss                                  587.288  W
    compression of the belt                          0.041  W

    power in                                       15.6120  kW
    power out                                      15.0247  kW
    ");
}

#[test]
fn the_state_of_a_flat_belt_as_a_table() {
    insta::assert_snapshot!(shown(&of_state(&state("flat-unequal", &[]))), @r"
    Flat-belt drive, ratio 2
    elastic/perfectly-plastic friction, μ = 0.5, k_f = 1e7 N/m², normal force n = (T − G V)/R

                                                    driver                      driven
    speed                                          1450.00                     722.587  rpm
    torque                                         30.0000                     60.0000  N·m
    power                                          4.55531                     4.54015  kW
    wrap angle                                     165.638                     194.362  °
    slip arc                                       73.8356                     72.5898  °
    reference tension T_o                          648.616                     247.043  N
    entry strain                              −0.000820611                  2.46430e−5
    smallest k_f with slip                               –                     1.33071  N/mm²
    zones                              elastic 0 – 91.8028         elastic 0 – 121.772  °
      then                          slip 91.8028 – 165.638      slip 121.772 – 194.362  °

                                                    driver                      driven
    friction utilisation                           64.9109                     55.3183  %
    torque capacity                                62.5601                     171.751  N·m
    torque margin                                  2.08534                     2.86251
    speed loss                                           0                    0.332845  %
    friction loss                                  9.38426                     5.77787  W
    hub load                                       681.371                     681.371  N
      direction from x                             3.15493                    −176.845  °
    hub load at rest                               760.111                     760.111  N
      direction from x                                   0                     180.000  °

                                                slack span                  tight span
    span from there to                              driven                      driver
    belt tension T                                 250.000                     550.143  N
    tractive tension F                             192.858                     492.858  N
    length                                         793.725                     793.725  mm
    first frequency                                15.3833                     26.5343  Hz
      at rest                                      24.6976                     24.6976  Hz
    deflection at rest                             12.4020                     12.4020  mm
      under a force of                             25.2244                     25.2244  N

    belt length, unstretched                       2546.86  mm
    mass flow                                      3.77568  kg/s
    speed loss                                    0.332845  %
    efficiency                                     99.6672  %
    friction loss                                  15.1621  W

    belt length, running                           2554.99  mm
    speed of unstretched belt                      15.1027  m/s
    belt tension at rest                           383.060  N
    power in                                       4.55531  kW
    power out                                      4.54015  kW
    load factor limit                              2.08534
      where slips first                             driver

    method                                     closed form
    ");
}

#[test]
fn the_limits_of_a_flat_belt_as_a_table() {
    insta::assert_snapshot!(shown(&of_limits(&drive("kim2009-flat", &[]))), @r"
    Kim 2009, tables 1 and 2, flat belt
    elastic/perfectly-plastic friction, μ = 1.2, k_f = 8.1e7 N/m², normal force n = (T − G V)/R
    Limits of load.tight_tension
    smallest: both spans have the same tension: the drive transmits no torque
    largest: the belt slips grossly on the driver

                                                       smallest                     largest
    tight tension                                       200.000                 8332.837395  N
    reason                                              no load                driver slips
    belt length, unstretched                            908.240                     877.924  mm
    slack span                                          200.000                     200.000  mm
    tight span                                          200.000                     200.000  mm
    mass flow                                           1.00758                    0.625222  kg/s
    speed loss                                                0                     38.7106  %
    efficiency                                          100.000                     61.2894  %
    friction loss                                             0                     30694.2  W
    driver: speed                                       1145.92                     1145.92  rpm
    driver: torque                                            0                     660.762  N·m
    driver: power                                             0                     79.2914  kW
    driver: wrap angle                                  180.000                     180.000  °
    driver: slip arc                                          0                     177.953  °
    driver: reference tension T_o                       200.000                     49288.8  N
    driver: entry strain                                      0                   −0.511515
    driver: smallest k_f with slip                    not known                           –  N/mm²
    driven: speed                                       1145.92                     702.325  rpm
    driven: torque                                            0                     660.762  N·m
    driven: power                                             0                     48.5972  kW
    driven: wrap angle                                  180.000                     180.000  °
    driven: slip arc                                          0                     177.909  °
    driven: reference tension T_o                       200.000                    −786.010  N
    driven: entry strain                                      0                   0.0123147
    driven: smallest k_f with slip                    not known                           –  N/mm²
    slack belt tension T                                200.000                     200.000  N
    tight belt tension T                                200.000                     8332.84  N
    slack tractive tension F                            190.176                     196.217  N
    tight tractive tension F                            190.176                     8328.67  N

    method                                     closed form
    states                                              63
    ");
}

#[test]
fn units_are_those_asked_for() {
    let answer = of_state(&state("flat-unequal", &[]));
    let line = |units, label: &str| {
        let text = table(&answer, units);
        let line = text.lines().find(|line| line.starts_with(label));
        line.unwrap()
            .split_whitespace()
            .collect::<Vec<_>>()
            .join(" ")
    };
    let speed = "speed ";
    assert_eq!(line(UnitSystem::Si, speed), "speed 151.844 75.6691 rad/s");
    assert_eq!(
        line(UnitSystem::Engineering, speed),
        "speed 1450.00 722.587 rpm"
    );
    assert_eq!(
        line(UnitSystem::Us, "torque "),
        "torque 22.1269 44.2537 lbf·ft"
    );
    assert_eq!(
        line(UnitSystem::Us, "belt tension T"),
        "belt tension T 56.2022 123.677 lbf"
    );
}

#[test]
fn tables_fit_a_terminal() {
    let mut long = state("kim2009", &["load.tight_tractive_tension=8000 N"]);
    long.drive.title = Some("very long ".repeat(20));
    let name = "a name ".repeat(9).leak();
    long.checks.push(Check {
        name,
        deviation: 1.0,
        limit: 0.5,
    });
    long.driver.angular_speed = -1.234_567_89e-7;
    long.driven.angular_speed = 9.876_543_21e12;
    fits(&of_state(&long));
    for law in ["coulomb", "epp", "creep-rate"] {
        for normal_force in ["inertia", "exact"] {
            let force = format!("model.normal_force={normal_force}");
            let drive = drive("kim2009-flat", &[&format!("friction.law={law}"), &force]);
            let state = solve(&drive, &SolveOptions::default()).unwrap();
            let answer = of_state(&state);
            fits(&answer);
            fits(&of_limits(&drive));
            let text = shown(&answer);
            for word in [
                "penetration",
                "inclination",
                "groove",
                "mesh",
                "V-belt",
                "…",
            ] {
                assert!(!text.contains(word), "{word} is in\n{text}");
            }
            assert_eq!(text.contains("k_f with slip"), law == "epp", "{text}");
        }
    }
}

#[test]
fn warnings_and_violations_stand_out() {
    let mut state = state("kim2009", &["load.tight_tractive_tension=8000 N"]);
    state.checks[0].deviation = f64::NAN;
    state.warnings.push(Warning::LargeStrain { strain: 1e4 });
    let answer = of_state(&state);
    let text = shown(&answer);
    assert!(
        text.lines()
            .nth(3)
            .unwrap()
            .starts_with("WARNING: the belt overhangs"),
        "{text}"
    );
    let mut lines = text
        .lines()
        .skip_while(|line| !line.ends_with("small strains: choose"));
    assert_eq!(
        lines.nth(1),
        Some("         normal_force=\"exact\""),
        "{text}"
    );
    let full = table(&answer, UnitSystem::Engineering);
    assert!(
        full.contains("VIOLATED") && full.contains(" holds "),
        "{full}"
    );
    for label in &VAGUE[1..] {
        assert!(full.lines().any(|line| line.starts_with(label)), "{label}");
    }
    let warnings = &parsed(&answer)["warnings"];
    assert_eq!(
        [&warnings[0]["kind"], &warnings[0]["pulley"]],
        ["overhang", "driver"]
    );
    assert!(warnings[0]["inclination_deg"].as_f64().unwrap() > 90.0);
    let last = warnings.as_array().unwrap().last().unwrap();
    assert_eq!(last["strain"], 1e4);
    assert!(
        last["message"].as_str().unwrap().contains("stretched") && last.get("pulley").is_none()
    );
}

#[test]
fn what_is_not_known_is_left_out_or_null() {
    let mut flat = state("flat-unequal", &[]);
    flat.driver.entry = None;
    let text = shown(&of_state(&flat));
    let line = text.lines().find(|line| line.contains("T_o")).unwrap();
    assert!(line.contains(" – "), "{text}");
    flat.driven.entry = None;
    assert!(!shown(&of_state(&flat)).contains("T_o"));
    let mut standing = state("kim2009-bristle", &[]);
    for pulley in [&mut standing.driver, &mut standing.driven] {
        pulley.angular_speed = 0.0;
        pulley.zones.clear();
    }
    standing.drive.title = None;
    let answer = of_state(&standing);
    fits(&answer);
    let text = shown(&answer);
    assert!(
        text.starts_with("Two-pulley V-belt drive\n") && !text.contains("zones"),
        "{text}"
    );
    standing.efficiency = f64::NAN;
    let report = parsed(&of_state(&standing));
    assert!(report["efficiency"].is_null() && report["title"].is_null());
    assert_eq!(report["speed_loss"], 0.0);
}

/// The keys of a state that programs rely on.
const STATE: [&str; 15] = [
    "/mass_flow_kg_per_s",
    "/belt_length_m",
    "/slack_span_m",
    "/tight_span_m",
    "/efficiency",
    "/friction_loss_W",
    "/compression_power_W",
    "/speed_loss",
    "/tension_N/slack",
    "/tension_N/tight",
    "/tractive_tension_N/slack",
    "/tractive_tension_N/tight",
    "/driver/inclination_deg/1",
    "/driver/zones/0/kind",
    "/driven/zones/0/to_deg",
];

#[test]
fn json_of_a_state_has_its_keys() {
    let state = state("kim2009-epp", &[]);
    let answer = of_state(&state);
    let report = parsed(&answer);
    has(&report, &STATE);
    has(
        &report,
        &[
            "/title",
            "/friction_law",
            "/checks/0/deviation",
            "/warnings",
        ],
    );
    assert_eq!(report["belt_type"], "v");
    assert!(report.get("normal_force").is_none());
    for (name, pulley) in [("driver", &state.driver), ("driven", &state.driven)] {
        let found = &report[name];
        close(&found["angular_speed_rad_per_s"], pulley.angular_speed);
        close(&found["torque_N_m"], pulley.torque);
        close(&found["wrap_angle_deg"], pulley.wrap_angle.to_degrees());
        close(&found["max_penetration_m"], pulley.max_penetration);
        // No digit is lost where it is written.
        let torque = format!("\"torque_N_m\": {:?},", pulley.torque);
        assert!(json(&answer).contains(&torque), "{torque}");
        has(
            found,
            &["/power_W", "/geometric_wrap_angle_deg", "/slip_arc_deg"],
        );
        assert!(found.get("entry_strain").is_none());
        let (profile, known) = (&report["profiles"][name], &pulley.profile);
        for (key, values) in [
            ("tension_N", &known.tension),
            ("tractive_tension_N", &known.tractive_tension),
            ("arc_length_m", &known.arc_length),
            ("penetration_m", &known.penetration),
            ("displacement_m", &known.displacement),
            ("normal_force_N_per_m", &known.normal_force),
            ("friction_force_N_per_m", &known.friction_force),
        ] {
            let found = profile[key].as_array().unwrap();
            assert_eq!(found.len(), values.len(), "{key}");
            for (found, value) in found.iter().zip(values) {
                close(found, *value);
            }
        }
        for key in ["angle_deg", "inclination_deg", "sliding_angle_deg"] {
            assert_eq!(
                profile[key].as_array().unwrap().len(),
                known.angle.len(),
                "{key}"
            );
        }
    }
    let convergence = &report["convergence"];
    for key in [
        "mesh_intervals/1",
        "newton_iterations",
        "rhs_evaluations",
        "factorisations",
    ] {
        assert!(
            convergence.pointer(&format!("/{key}")).unwrap().is_u64(),
            "{key}"
        );
    }
    for key in ["tolerance", "defect", "error_estimate", "seconds"] {
        assert!(convergence[key].is_f64(), "{key}");
    }
}

#[test]
fn a_flat_belt_has_the_keys_of_a_v_belt_and_more() {
    let epp = state("kim2009-flat", &[]);
    let report = parsed(&of_state(&epp));
    has(&report, &STATE);
    assert_eq!(
        [&report["belt_type"], &report["normal_force"]],
        ["flat", "inertia"]
    );
    let entry = epp.driven.entry.unwrap();
    close(&report["driven"]["entry_strain"], entry.strain);
    close(
        &report["driven"]["reference_tension_N"],
        entry.reference_tension,
    );
    let stiffness = "smallest_friction_stiffness_N_per_m2";
    close(
        &report["driven"][stiffness],
        entry.smallest_stiffness.unwrap(),
    );
    let coulomb = parsed(&of_state(&state("kim2009-flat", &["friction.law=coulomb"])));
    assert!(coulomb["driven"][stiffness].is_null());
    assert_eq!(coulomb["driven"]["zones"][0]["kind"], "adhesion");
}

#[test]
fn csv_of_a_state_has_a_row_for_each_point() {
    let state = state("flat-unequal", &[]);
    let answer = of_state(&state);
    let table = columns(&csv(&answer));
    let profile = &state.driver.profile;
    let count = profile.angle.len();
    assert_eq!(table.1.len(), count + state.driven.profile.angle.len());
    assert_eq!(table.0[..3], ["pulley", "angle_deg", "arc_length_m"]);
    assert_eq!(table.0.last().unwrap(), "normal_force");
    assert_eq!(
        [field(&table, 5, "pulley"), field(&table, count, "pulley")],
        ["driver", "driven"]
    );
    assert_eq!(
        field(&table, 5, "tension_N").parse(),
        Ok(profile.tension[5])
    );
    assert_eq!(
        field(&table, 5, "angle_deg").parse(),
        Ok(profile.angle[5].to_degrees())
    );
    assert_eq!(field(&table, 7, "normal_force"), "inertia");
    let mut blank = state;
    for pulley in [&mut blank.driver, &mut blank.driven] {
        pulley.profile = beltdrive::Profile::default();
    }
    assert_eq!(csv(&of_state(&blank)).lines().count(), 1);
}

#[test]
fn each_limit_has_value_reason_and_state() {
    let drive = drive("kim2009-flat", &[]);
    let answer = of_limits(&drive);
    let report = parsed(&answer);
    assert_eq!(
        [&report["parameter"], &report["unit"]],
        ["load.tight_tension", "N"]
    );
    for end in ["smallest", "largest"] {
        has(&report[end], &STATE);
        assert_eq!(report[end]["value"], report[end]["tight_tension_N"]);
        has(
            &report[end],
            &[
                "/value_error",
                "/description",
                "/warnings",
                "/error_estimate",
            ],
        );
    }
    let (smallest, largest) = (&report["smallest"], &report["largest"]);
    assert_eq!(
        [&smallest["reason"], &largest["reason"]],
        ["no load", "gross slip"]
    );
    assert!(smallest["pulley"].is_null() && largest["pulley"] == "driver");
    assert!(largest["errors"]["driven"]["torque_N_m"].as_f64().unwrap() > 0.0);
    has(&report, &["/convergence/continuation_steps"]);
    let table = columns(&csv(&answer));
    let first = [
        "limit",
        "tight_tension_N",
        "value_error",
        "reason",
        "pulley",
    ];
    assert_eq!(table.0[..5], first);
    assert_eq!(table.1.len(), 2);
    assert_eq!(field(&table, 1, "reason"), "gross slip");
    assert_eq!(field(&table, 1, "normal_force"), "inertia");
    let torque = largest["driven"]["torque_N_m"].as_f64().unwrap();
    assert_eq!(field(&table, 1, "driven_torque_N_m").parse(), Ok(torque));
    let repeated = table.0.iter().filter(|name| *name == "tight_tension_N");
    assert_eq!(repeated.count(), 1);
}

#[test]
fn a_branch_as_a_table() {
    let found = traced(
        &drive("kim2009-flat", &[]),
        "load.tight_tension",
        [300.0, 3000.0],
    );
    insta::assert_snapshot!(shown(&branch::answer(&found)), @r"
    Kim 2009, tables 1 and 2, flat belt
    elastic/perfectly-plastic friction, μ = 1.2, k_f = 8.1e7 N/m², normal force n = (T − G V)/R
    Branch over load.tight_tension: 52 states

      tight   driven     speed     wrap     wrap     slip     slip   driven
    tension    speed      loss   driver   driven   driver   driven   torque  efficiency  event
          N      rpm         %        °        °        °        °      N·m           %
    300.000  1144.49  0.124576  180.000  180.000  1.97030        0  8.12401     99.8754  start
    364.714  1143.57  0.205048  180.000  180.000  11.5848        0  13.3814     99.7950  +slip, driven
    412.500  1142.89  0.264408  180.000  180.000  17.6185  6.03663  17.2635     99.7356
    581.250  1140.49  0.473693  180.000  180.000  34.3428  22.7750  30.9728     99.5263
    750.000  1138.09  0.682550  180.000  180.000  46.7192  35.1711  44.6821     99.3175
    918.750  1135.70  0.891113  180.000  180.000  56.5566  45.0341  58.3914     99.1089
    1087.50  1133.32   1.09952  180.000  180.000  64.7289  53.2386  72.1007     98.9005
    1256.25  1130.93   1.30793  180.000  180.000  71.7263  60.2746  85.8101     98.6921
    1425.00  1128.54   1.51648  180.000  180.000  77.8509  66.4448  99.5194     98.4835
    1593.75  1126.14   1.72534  180.000  180.000  83.3026  71.9492  113.229     98.2747
    1762.50  1123.75   1.93467  180.000  180.000  88.2204  76.9272  126.938     98.0653
    1931.25  1121.34   2.14466  180.000  180.000  92.7049  81.4798  140.648     97.8553
    2100.00  1118.92   2.35548  180.000  180.000  96.8315  85.6827  154.357     97.6445
    2268.75  1116.50   2.56735  180.000  180.000  100.658  89.5939  168.066     97.4327
    2437.50  1114.05   2.78047  180.000  180.000  104.230  93.2594  181.776     97.2195
    2606.25  1111.59   2.99509  180.000  180.000  107.583  96.7158  195.485     97.0049
    2775.00  1109.12   3.21144  180.000  180.000  110.747  99.9933  209.195     96.7886
    2943.75  1106.61   3.42982  180.000  180.000  113.746  103.117  222.904     96.5702
    3000.00  1105.77   3.50311  180.000  180.000  114.713  104.127  227.474     96.4969  end

          tight  estimated
        tension      error  event
              N          N
        300.000          0  the branch starts
    364.7144712    8.1e−14  a zone of slip friction appears on the driven pulley
        3000.00          0  the branch ends

    method                                     closed form
    states                                              55

    end of the branch: the parameter reached the value asked for
    ");
}

#[test]
fn a_branch_has_points_events_and_an_end() {
    let drive = drive("kim2009", &[]);
    let found = traced(&drive, "load.tight_tractive_tension", [6000.0, 9000.0]);
    let answer = branch::answer(&found);
    fits(&answer);
    let text = shown(&answer);
    for needle in [
        "  fold\n",
        "  90°, driver\n",
        "limit point: the tight tractive tension turns back\n",
    ] {
        assert!(text.contains(needle), "{needle} is not in\n{text}");
    }
    assert!(text.lines().count() < 60, "{text}");
    let report = parsed(&answer);
    assert_eq!(
        [&report["parameter"], &report["unit"]],
        ["load.tight_tractive_tension", "N"]
    );
    let points = report["points"].as_array().unwrap();
    assert_eq!(points.len(), found.points.len());
    for (report, point) in points.iter().zip(&found.points) {
        has(report, &STATE);
        close(&report["tight_tractive_tension_N"], point.value);
        close(&report["value"], point.value);
        close(&report["driven"]["torque_N_m"], point.state.driven.torque);
        has(report, &["/arclength", "/error_estimate"]);
    }
    let events = report["events"].as_array().unwrap();
    let kinds: Vec<_> = events.iter().map(|event| &event["kind"]).collect();
    assert_eq!(kinds, ["start", "overhang", "fold", "end"]);
    let fold = &events[2];
    has(fold, &STATE);
    assert!(fold["pulley"].is_null() && fold["zone"].is_null());
    close(&fold["value_error"], found.events[2].value_error.unwrap());
    let errors = found.events[2].errors.unwrap();
    close(
        &fold["errors"]["driven"]["torque_N_m"],
        errors.driven.torque,
    );
    assert_eq!(events[1]["pulley"], "driver");
    assert_eq!(report["end"]["reason"], "returned");
    assert!(report["convergence"]["continuation_steps"].is_u64());
    // The states of events are rows among the others.
    let table = columns(&csv(&answer));
    assert_eq!(
        table.0[..4],
        ["tight_tractive_tension_N", "arclength", "event", "pulley"]
    );
    let repeated = table
        .0
        .iter()
        .filter(|name| *name == "tight_tractive_tension_N");
    assert_eq!(repeated.count(), 1);
    let rows = 0..table.1.len();
    assert!(rows.len() >= points.len());
    let marked = rows
        .clone()
        .filter(|row| !field(&table, *row, "event").is_empty());
    assert_eq!(marked.count(), events.len());
    let fold = rows
        .clone()
        .find(|row| field(&table, *row, "event") == "fold")
        .unwrap();
    let event = &found.events[2].point;
    assert_eq!(
        field(&table, fold, "tight_tractive_tension_N").parse(),
        Ok(event.value)
    );
    let speed = "driven_angular_speed_rad_per_s";
    assert_eq!(
        field(&table, fold, speed).parse(),
        Ok(event.state.driven.angular_speed)
    );
    let exit = event.state.driver.inclination[1].to_degrees();
    assert_eq!(
        field(&table, fold, "driver_exit_inclination_deg").parse(),
        Ok(exit)
    );
    let along: Vec<_> = rows
        .map(|row| field(&table, row, "arclength").parse::<f64>().unwrap())
        .collect();
    assert!(along.is_sorted());
}

#[test]
fn a_branch_over_an_angle_is_in_degrees_and_says_why_it_failed() {
    let drive = drive("kim2009-bristle", &[]);
    let angle = 18_f64.to_radians();
    let mut found = traced(&drive, "groove.half_angle", [angle, 0.3]);
    let report = parsed(&branch::answer(&found));
    assert_eq!(report["unit"], "°");
    close(&report["points"][0]["half_angle_deg"], angle.to_degrees());
    found.end = BranchEnd::NotConverged {
        cause: "a cause ".repeat(20),
    };
    found.points[0].value = -1.234_567e-9;
    found.points[0].state.driven.torque = -1.234_567_8e6;
    let answer = branch::answer(&found);
    fits(&answer);
    assert_eq!(parsed(&answer)["end"]["reason"], "not converged");
}

#[test]
fn a_limit_curve_as_a_table() {
    let mut found = curve(&drive("kim2009-flat", &[]), [0.4, 0.6]);
    found.cusps = vec![found.points[3].clone()];
    insta::assert_snapshot!(shown(&limit_curve::answer(&found)), @r"
    Kim 2009, tables 1 and 2, flat belt
    elastic/perfectly-plastic friction, μ varied, k_f = 8.1e7 N/m², normal force n = (T − G V)/R
    Limit of load.tight_tension over friction.coefficient: 41 limits

    coefficient        tight   driven   driven                 slip     slip
    of friction      tension    speed   torque  efficiency   driver   driven  reason
                           N      rpm      N·m           %        °        °
       0.400000  678.3733957  1085.44  38.8635     94.7224  179.253  179.251  driver slips
       0.410000  699.7277797  1083.67  40.5983     94.5678  179.238  179.236  driver slips
       0.420000  721.7648739  1081.86  42.3887     94.4097  179.223  179.220  driver slips
       0.430000  744.5065426  1080.00  44.2362     94.2481  179.207  179.205  driver slips
       0.440000  767.9753527  1078.11  46.1429     94.0829  179.191  179.189  driver slips
       0.450000  792.1945964  1076.17  48.1105     93.9139  179.176  179.173  driver slips
       0.460000  817.1883148  1074.19  50.1410     93.7411  179.160  179.157  driver slips
       0.470000  842.9813217  1072.17  52.2365     93.5643  179.144  179.141  driver slips
       0.480000  869.5992291  1070.10  54.3990     93.3834  179.128  179.125  driver slips
       0.490000  897.0684729  1067.97  56.6307     93.1984  179.112  179.109  driver slips
       0.500000  925.4163393  1065.80  58.9337     93.0090  179.096  179.093  driver slips
       0.510000  954.6709928  1063.58  61.3104     92.8153  179.080  179.076  driver slips
       0.520000  984.8615045  1061.31  63.7631     92.6170  179.064  179.060  driver slips
       0.530000  1016.017881  1058.99  66.2944     92.4141  179.047  179.043  driver slips
       0.540000  1048.171096  1056.61  68.9066     92.2065  179.031  179.026  driver slips
       0.550000  1081.353121  1054.17  71.6024     91.9940  179.014  179.009  driver slips
       0.560000  1115.596957  1051.68  74.3844     91.7765  178.997  178.992  driver slips
       0.570000  1150.936667  1049.13  77.2555     91.5539  178.981  178.975  driver slips
       0.580000  1187.407417  1046.52  80.2185     91.3261  178.964  178.958  driver slips
       0.590000  1225.045501  1043.85  83.2763     91.0930  178.947  178.941  driver slips
       0.600000  1263.888388  1041.11  86.4320     90.8544  178.930  178.924  driver slips

    coefficient        tight
    of friction      tension  cusp
                           N
       0.415000  710.6596377  two limit points meet and vanish

    method                                     closed form
    states                                              41

    end of the curve: the parameter reached the value asked for
    ");
}

#[test]
fn each_limit_of_a_curve_has_both_parameters() {
    let mut found = curve(&drive("kim2009-flat", &[]), [0.4, 0.6]);
    found.cusps = vec![found.points[3].clone()];
    let answer = limit_curve::answer(&found);
    fits(&answer);
    let report = parsed(&answer);
    assert_eq!(report["parameter"], "load.tight_tension");
    assert_eq!(
        [&report["second_parameter"], &report["second_unit"]],
        ["friction.coefficient", ""]
    );
    let (limit, point) = (&report["points"][3], &found.points[3]);
    has(limit, &STATE);
    close(&limit["coefficient"], point.second);
    close(&limit["second_value"], point.second);
    close(&limit["tight_tension_N"], point.value);
    close(&limit["value"], point.value);
    assert_eq!(
        [&limit["reason"], &limit["pulley"]],
        ["gross slip", "driver"]
    );
    assert_eq!(&report["cusps"][0], limit);
    assert_eq!(report["end"]["reason"], "target");
    let table = columns(&csv(&answer));
    let first = [
        "coefficient",
        "tight_tension_N",
        "value_error",
        "reason",
        "pulley",
    ];
    assert_eq!(table.0[..5], first);
    assert_eq!(table.1.len(), found.points.len());
    assert_eq!(field(&table, 0, "coefficient"), "0.4");
}
