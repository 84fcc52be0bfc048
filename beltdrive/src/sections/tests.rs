use super::*;

#[test]
fn every_section_is_found_by_all_its_names() {
    for section in &SECTIONS {
        assert_eq!(find(section.name), Ok(section));
        for other in section.also.split(", ").filter(|other| !other.is_empty()) {
            assert_eq!(find(other), Ok(section), "{other}");
        }
    }
    let unknown = find("spb").unwrap_err().to_string();
    assert!(unknown.starts_with("there is no section `spb`\nexpected: one of `Z`, `A`, "));
    assert!(
        unknown.ends_with("\nhelp: did you mean `SPB`?"),
        "{unknown}"
    );
    assert!(!find("steel rope").unwrap_err().to_string().contains("help"));
}

#[test]
fn figures_lie_in_their_ranges_and_have_sources() {
    for section in &SECTIONS {
        let figures = [
            section.top_width,
            section.height,
            section.datum_width,
            section.pitch_line_depth,
            section.pitch_line_height,
            section.wedge_angle,
            section.smallest_diameter,
            section.mass,
            section.axial_stiffness,
            section.transverse_modulus,
        ];
        for figure in figures.into_iter().flatten() {
            let name = section.name;
            assert!(figure.value > 0.0 && !figure.sources.is_empty(), "{name}");
            let [low, high] = figure.range.unwrap_or([figure.value; 2]);
            assert!((low..=high).contains(&figure.value), "{name}: {figure:?}");
            assert!(
                figure.kind != Kind::Estimate || low < high,
                "{name}: an estimate has a scatter"
            );
        }
        assert!(section.mass.is_some() && section.axial_stiffness.is_some());
    }
}

#[test]
fn sections_grow_and_weigh_what_rubber_weighs() {
    let of = |family| {
        SECTIONS
            .iter()
            .filter(move |section| section.family == family)
    };
    for family in [
        Family::Classical,
        Family::NarrowIso,
        Family::NarrowRma,
        Family::PolyV,
    ] {
        let masses: Vec<_> = of(family)
            .map(|section| section.mass.unwrap().value)
            .collect();
        assert!(masses.is_sorted(), "{masses:?}");
    }
    // Of a trapezium with faces at 20°; cords and fabric make it heavier than the 1.2 of rubber.
    for section in SECTIONS.iter().filter(|section| section.family.is_v()) {
        let [top, height] = [section.top_width, section.height].map(|figure| figure.unwrap().value);
        let area = height * (top - height * 20_f64.to_radians().tan());
        let density = section.mass.unwrap().value / area;
        assert!(
            (1100.0..1500.0).contains(&density),
            "{}: {density}",
            section.name
        );
    }
}

#[test]
fn tangents_are_those_of_the_wedge_angles() {
    use estimates::{Wedge, pitch_line_depth};
    for wedge in [Wedge::Degrees38, Wedge::Degrees40] {
        // A depth of 1 mm at a width that is 2 mm tan(α/2) smaller.
        let narrower = 2.0 * (0.5 * wedge.degrees()).to_radians().tan();
        let depth = pitch_line_depth(10.0, 10.0 - narrower, wedge, &[Source::Megadyne]);
        assert!((depth.unwrap().value - 1e-3).abs() < 1e-15);
    }
}

#[test]
fn grooves_widen_with_the_pulley_at_the_limit_of_the_rule() {
    let section = find("A").unwrap();
    let angle = |rule: usize, diameter: f64| {
        section.grooves[rule]
            .groove(diameter)
            .angle
            .to_degrees()
            .round()
    };
    assert_eq!(
        [0.118, 0.119, 1.0].map(|diameter| angle(0, diameter)),
        [34.0, 38.0, 38.0]
    );
    assert_eq!(
        [0.09, 0.125, 0.4, 0.45].map(|diameter| angle(1, diameter)),
        [34.0, 36.0, 38.0, 40.0]
    );
    for section in SECTIONS.iter() {
        for rule in section.grooves {
            let steps = rule.steps;
            let limits: Vec<_> = steps.iter().filter_map(|step| step.up_to).collect();
            assert_eq!(limits.len() + 1, steps.len());
            assert!(limits.is_sorted() && steps.is_sorted_by_key(|step| step.angle));
            assert!(steps.last().unwrap().up_to.is_none());
        }
    }
    assert_eq!(find("PK").unwrap().groove(0.1), None);
}

#[test]
fn radial_stiffness_is_that_of_a_belt_squeezed_between_faces() {
    // Width 14 mm, height 13 mm: 1 mm of penetration at 45° takes 2 mm of the width.
    let k = find("SPB")
        .unwrap()
        .radial_stiffness(45_f64.to_radians())
        .unwrap();
    let strain = 2.0 / 14.0;
    let modulus = find("SPB").unwrap().transverse_modulus.unwrap().value;
    let line_load = 0.013 * modulus * strain;
    assert!((k.value / 1e3 / 2.0 - line_load).abs() < 1e-9 * line_load);
    assert_eq!(k.kind, Kind::Estimate);
    // The belt of Kim (2009), from which the smallest modulus is.
    let kim = find("A")
        .unwrap()
        .radial_stiffness(18_f64.to_radians())
        .unwrap();
    assert!(
        (kim.range.unwrap()[0] / 900e3 - 1.0).abs() < 0.06,
        "{kim:?}"
    );
    assert_eq!(find("PK").unwrap().radial_stiffness(0.3), None);
}
