//! The tables of steady states.

use super::*;

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
    largest penetration                            3.78333                     5.07974  mm
    inclination at entry                          −7.06106                    −2.88493  °
    inclination at exit                            10.4022                     11.6344  °
    slip arc                                       44.8461                     136.288  °
    smallest slip, of V                            0.00030                      0.0038
    arc below 1e-7 of V                                  0                           0  °
    zones                              elastic 0 – 2.32917         elastic 0 – 51.1143  °
      then                          slip 2.32917 – 42.7735      slip 51.1143 – 181.070  °
      then                       elastic 42.7735 – 193.039   elastic 181.070 – 188.210  °
      then                          slip 193.039 – 197.441      slip 188.210 – 194.542  °

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
    speed loss, pitch circles                      2.02214  %
    efficiency                                     96.2380  %
    friction loss                                  587.288  W
    compression of the belt                       0.040819  W

    power in                                       15.6120  kW
    power out                                      15.0247  kW


    speed loss against the speeds of the pitch circles: a V-belt that sinks more deeply into one groove
        than into another has one without load
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
