//! Symbols, spellings and compound units.

use super::*;

#[track_caller]
fn check(text: &str, scale: f64, dimension: Dimension) {
    let unit = parse(text).unwrap_or_else(|_| panic!("{text} is a unit"));
    assert_eq!(unit.dimension, dimension, "{text}");
    assert!(
        (unit.scale / scale - 1.0).abs() < 1e-14,
        "{text}: {}",
        unit.scale
    );
}

#[test]
fn sensible_spellings_agree() {
    for text in [
        "N/m^2",
        "N/m²",
        "N/m2",
        "N m^-2",
        "N·m⁻²",
        "N * m-2",
        "Pa",
        "/m^2 N",
        "J/m³",
    ] {
        check(text, 1.0, Dimension::FORCE_PER_AREA);
    }
    for text in ["N/mm^2", "MPa", "MN/m2", "MJ/m^3"] {
        check(text, 1e6, Dimension::FORCE_PER_AREA);
    }
    check("kN/m2", 1e3, Dimension::FORCE_PER_AREA);
    check("g/cm", 0.1, Dimension::MASS_PER_LENGTH);
    check("kg m^-1", 1.0, Dimension::MASS_PER_LENGTH);
    check("lb/ft", 1.488_163_943_569_553_8, Dimension::MASS_PER_LENGTH);
    check("1/m", 1.0, Dimension::INVERSE_LENGTH);
    check("1 / mm", 1e3, Dimension::INVERSE_LENGTH);
    check("rev/min", TAU / 60.0, Dimension::ANGULAR_SPEED);
    check("kNm", 1e3, Dimension::TORQUE);
    check("lbf·ft", 1.355_817_948_331_400_4, Dimension::TORQUE);
    check("hp", 745.699_871_582_270_2, Dimension::POWER);
    check("psi", 6_894.757_293_168_361, Dimension::FORCE_PER_AREA);
    check("µm", 1e-6, Dimension::LENGTH);
    check("min", 60.0, Dimension::TIME);
}

#[test]
fn every_symbol_is_read_as_itself_with_and_without_prefix() {
    for named in &UNITS {
        for symbol in named.symbols {
            check(symbol, named.unit.scale, named.unit.dimension);
        }
        // What stands before a product is a factor of its own: a min-lb is a minute times a pound.
        let simple = !named.symbols[0].contains('-');
        for (prefix, _, factor) in PREFIXES.into_iter().filter(|_| simple) {
            let prefixed = format!("{prefix}{}", named.symbols[0]);
            let own = UNITS
                .iter()
                .any(|other| other.symbols.contains(&&*prefixed));
            if named.metric && !own {
                check(&prefixed, factor * named.unit.scale, named.unit.dimension);
            } else if !own {
                assert!(parse(&prefixed).is_err(), "{prefixed}");
            }
        }
    }
}

#[test]
fn spellings_of_engineers_are_read() {
    for text in [
        "1/min",
        "1 / min",
        "/min",
        "min-1",
        "min^-1",
        "min⁻¹",
        "r/min",
        "U/min",
        "rev/min",
        "RPM",
        "rev min^-1",
    ] {
        check(text, TAU / 60.0, Dimension::ANGULAR_SPEED);
    }
    for text in ["N.m", "N-m", "N·m", "N m", "Nm", "J", "daN.dm", "N.m^2/m"] {
        check(text, 1.0, Dimension::TORQUE);
    }
    for text in [
        "ft-lb", "ft·lb", "ft lb", "ft.lb", "lb-ft", "lb·ft", "ft-lbs", "ft-lbf", "lbf ft",
    ] {
        check(text, 1.355_817_948_331_400_4, Dimension::TORQUE);
    }
    check("in-lb", 0.112_984_829_027_616_7, Dimension::TORQUE);
    check("oz-in", 0.007_061_551_814_226_044, Dimension::TORQUE);
    check("%", 0.01, Dimension::NUMBER);
    check("daN", 10.0, Dimension::FORCE);
    check("daN/mm^2", 1e7, Dimension::FORCE_PER_AREA);
    check("fpm", 0.005_08, Dimension::VELOCITY);
    check("kg.m-1", 1.0, Dimension::MASS_PER_LENGTH);
    // Neither rad/s nor rev/s beyond doubt.
    check("1/s", 1.0, Dimension::NUMBER.times(Dimension::TIME, -1));
    check(
        "1/h",
        1.0 / 3600.0,
        Dimension::NUMBER.times(Dimension::TIME, -1),
    );
}

#[test]
fn what_is_no_unit_is_pointed_at() {
    assert_eq!(parse("kNn"), Err(0..3));
    assert_eq!(parse("N/parsec^2"), Err(2..10));
    assert_eq!(parse("N//m"), Err(2..3));
    assert_eq!(parse("N/"), Err(1..2));
    assert_eq!(parse("N-"), Err(0..2));
    assert_eq!(parse("N.-m"), Err(2..3));
    assert_eq!(parse("-m"), Err(0..2));
    for text in [
        "m^", "m^0", "m^99", "m^2^2", "m^2m", "2", "1", "^2", "kkg", "kin",
    ] {
        assert_eq!(parse(text), Err(0..text.len()), "{text}");
    }
}

#[test]
fn misspellings_have_a_nearest_unit() {
    let nearest = |text| nearest(text).unwrap_or_default();
    assert_eq!(nearest("kn"), "kN");
    assert_eq!(nearest("KN^2"), "kN^2");
    assert_eq!(nearest("degrees"), "deg");
    assert_eq!(nearest("kilonewtons"), "kN");
    assert_eq!(nearest("inches"), "in");
    assert_eq!(nearest("RPM"), "rpm");
    assert_eq!(nearest("parsec"), "");
}
