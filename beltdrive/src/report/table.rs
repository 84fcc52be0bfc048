//! The steady state as a table for a terminal.

use super::answer;
use super::lines::{self, row, single, small};
use super::{Precision, rpm, slip_arc, title, torque_scale, warning};
use crate::quantity::{Answer, Group, UnitSystem, words};
use crate::{BeltKind, Convergence, Drive, Entry, PulleySummary, StateSummary, SteadyState, Zone};

/// Most significant digits shown; fewer where the error estimate does not support them.
const DIGITS: u8 = 6;

/// Most significant digits of a strain.
const STRAIN_DIGITS: u8 = 3;

/// The steady state on lines of at most 100 columns: what an engineer reads at a glance.
///
/// Numbers have at most six significant digits, and never more than their estimated error
/// supports.
pub fn table(state: &SteadyState, groups: &[Group]) -> String {
    let precision = Precision::of(&state.convergence, DIGITS);
    let summary = StateSummary::from(state);
    let remarks = state.warnings.iter();
    let warnings = remarks.map(|remark| lines::wrapped("WARNING: ", &warning(remark)));
    let blocks = [
        pulleys(state, &summary, precision),
        spans(state, precision),
        whole(&state.drive, &summary, precision),
        as_loop(groups),
        match state.drive.belt.kind {
            BeltKind::V(_) => accuracy(&state.convergence),
            BeltKind::Flat { .. } => closed_form(&state.convergence),
        },
        state.checks.iter().map(words::check).collect(),
    ];
    let title = title(&state.drive, &[]);
    lines::text(std::iter::once(title).chain(warnings).chain(blocks))
}

/// Driver and driven pulley side by side.
fn pulleys(state: &SteadyState, summary: &StateSummary, precision: Precision) -> Vec<String> {
    let pulleys = [&summary.driver, &summary.driven];
    let number = |label, quantity: fn(&PulleySummary) -> f64, unit| {
        row(
            label,
            pulleys.map(|pulley| precision.show(quantity(pulley))),
            unit,
        )
    };
    // Torque is a difference of tensions and carries their error; angles that of a radian.
    let torque = torque_scale(&state.drive, state.tight_tension);
    let angle = |value| degrees(precision, value);
    let mut lines = vec![
        row("", ["driver", "driven"].map(str::to_owned), ""),
        number("speed", |pulley| pulley.angular_speed, "rad/s"),
        number("", |pulley| rpm(pulley.angular_speed), "rpm"),
        row(
            "torque",
            pulleys.map(|pulley| precision.show_against(pulley.torque, torque)),
            "N·m",
        ),
        row(
            "power",
            pulleys.map(|pulley| {
                let scale = torque * pulley.angular_speed;
                precision.show_against(pulley.power() * 1e-3, scale * 1e-3)
            }),
            "kW",
        ),
        row(
            "wrap angle",
            pulleys.map(|pulley| angle(pulley.wrap_angle)),
            "°",
        ),
    ];
    lines.extend(match state.drive.belt.kind {
        BeltKind::V(_) => groove(pulleys, precision),
        BeltKind::Flat { .. } => rim(state, pulleys, precision),
    });
    let zone = |zone: &Zone| {
        let kind = zone.kind.name();
        format!("{kind} {} – {}", angle(zone.from), angle(zone.to))
    };
    let longest = summary.driver.zones.len().max(summary.driven.zones.len());
    lines.extend((0..longest).map(|place| {
        let label = if place == 0 { "zones" } else { "" };
        row(
            label,
            pulleys.map(|pulley| pulley.zones.get(place).map_or_else(String::new, zone)),
            "°",
        )
    }));
    lines
}

/// What only a V-belt does: it sinks into the groove and leaves the pitch circle.
fn groove(pulleys: [&PulleySummary; 2], precision: Precision) -> Vec<String> {
    let inclination =
        |end: usize| pulleys.map(|pulley| degrees(precision, pulley.inclination[end]));
    let penetration = pulleys.map(|pulley| precision.show(pulley.max_penetration * 1e3));
    let geometric = pulleys.map(|pulley| degrees(precision, pulley.geometric_wrap_angle));
    vec![
        row("of the pitch circles", geometric, "°"),
        row("largest penetration", penetration, "mm"),
        row("inclination at entry", inclination(0), "°"),
        row("inclination at exit", inclination(1), "°"),
    ]
}

/// What only a flat belt does: it creeps along the rim.
fn rim(state: &SteadyState, pulleys: [&PulleySummary; 2], precision: Precision) -> Vec<String> {
    let slip = pulleys.map(|pulley| degrees(precision, slip_arc(&pulley.zones)));
    let mut lines = vec![row("slip arc", slip, "°")];
    let mut line = |label, unit, of: fn(Entry) -> Option<f64>, show: &dyn Fn(f64) -> String| {
        let values = pulleys.map(|pulley| pulley.entry.and_then(of));
        if values.iter().any(Option::is_some) {
            let cells = values.map(|value| value.map_or_else(|| "–".to_owned(), show));
            lines.push(row(label, cells, unit));
        }
    };
    let tension = state.tight_tension;
    line(
        "reference tension T_o",
        "N",
        |entry| Some(entry.reference_tension),
        &|value| precision.show_against(value, tension),
    );
    // It decays along the elastic zone, so that its error is relative to itself however small it is.
    line("entry strain", "", |entry| Some(entry.strain), &|value| {
        precision.show_power(value, value, STRAIN_DIGITS)
    });
    line(
        "smallest k_f with slip",
        "N/m²",
        |entry| entry.smallest_stiffness,
        &|value| precision.show_power(value, value, DIGITS),
    );
    lines
}

/// An angle, rad, in degrees; its error is relative to a radian.
fn degrees(precision: Precision, angle: f64) -> String {
    precision.show_against(angle.to_degrees(), 1_f64.to_degrees())
}

/// Slack and tight span side by side.
fn spans(state: &SteadyState, precision: Precision) -> Vec<String> {
    let tension = |value| precision.show_against(value, state.tight_tension);
    vec![
        row("", ["slack span", "tight span"].map(str::to_owned), ""),
        row(
            "belt tension T",
            [state.slack_tension, state.tight_tension].map(tension),
            "N",
        ),
        row(
            "tractive tension F",
            [state.slack_tractive_tension, state.tight_tractive_tension].map(tension),
            "N",
        ),
        row(
            "length",
            [state.slack_span, state.tight_span].map(|span| precision.show(span)),
            "m",
        ),
    ]
}

/// What of the drive as a loop the other blocks do not show.
fn as_loop(groups: &[Group]) -> Vec<String> {
    let shown = [
        "angular_speed",
        "torque",
        "power",
        "wrap_angle",
        "slip_arc",
        "to_pulley",
        "tension",
        "tractive_tension",
        "length",
        "belt_length_unstretched",
        "mass_flow",
        "power_in",
        "power_out",
        "power_loss",
        "efficiency",
        "speed_loss",
        "friction_coefficient",
        "max_penetration",
        "entry_inclination",
        "exit_inclination",
    ];
    let answer = Answer::without(groups, &shown);
    let text = answer::table(&answer, UnitSystem::Si);
    text.lines().map(str::to_owned).collect()
}

/// The quantities of the drive as a whole.
fn whole(drive: &Drive, state: &StateSummary, precision: Precision) -> Vec<String> {
    // Losses are differences: of two speeds, of two powers.
    let input = state.driver.power();
    let mut lines = vec![
        single(
            "belt length, unstretched",
            precision.show(state.belt_length),
            "m",
        ),
        single("mass flow", precision.show(state.mass_flow), "kg/s"),
        single(
            "speed loss",
            precision.show_against(100.0 * state.speed_loss, 100.0),
            "%",
        ),
        single(
            "efficiency",
            precision.show_against(100.0 * state.efficiency, 100.0),
            "%",
        ),
        single(
            "friction loss",
            precision.show_against(state.friction_loss, input),
            "W",
        ),
    ];
    if let BeltKind::V(_) = drive.belt.kind {
        let compression = precision.show_against(state.compression_power, input);
        lines.push(single("compression of the belt", compression, "W"));
    }
    lines
}

/// How far the numbers can be trusted, and what they cost.
fn accuracy(convergence: &Convergence) -> Vec<String> {
    let mut lines = vec![
        single("relative tolerance", small(convergence.tolerance), ""),
        single("estimated error", small(convergence.error_estimate), ""),
        single("largest defect", small(convergence.defect), ""),
    ];
    if convergence.slip_normalisation > 0.0 {
        let label = format!("effect of ε = {}", small(convergence.slip_normalisation));
        lines.push(single(
            &label,
            small(convergence.slip_normalisation_effect),
            "",
        ));
    }
    let [driver, driven] = convergence.mesh_intervals;
    lines.extend([
        row(
            "mesh",
            [format!("driver {driver}"), format!("driven {driven}")],
            "intervals",
        ),
        single(
            "Newton steps",
            convergence.newton_iterations.to_string(),
            "",
        ),
        single("time", format!("{:.1}", convergence.seconds * 1e3), "ms"),
    ]);
    lines
}

/// How far the numbers of a closed form can be trusted, and what they cost.
fn closed_form(convergence: &Convergence) -> Vec<String> {
    vec![
        single("method", "closed form".to_owned(), ""),
        single("estimated error", small(convergence.error_estimate), ""),
        single("time", format!("{:.3}", convergence.seconds * 1e3), "ms"),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{lines::WIDTH, sample, sample_flat};
    use crate::{Check, NormalForce, Warning};

    #[test]
    fn is_no_wider_than_a_terminal() {
        let mut state = sample::overhanging();
        let flat = table(&sample_flat::epp(), &[]);
        state.drive.title = Some("very long ".repeat(20));
        state.checks.push(Check {
            name: "a name ".repeat(9).leak(),
            deviation: 1.0,
            limit: 0.5,
        });
        state.driver.angular_speed = -1.234_567_89e-7;
        state.driven.angular_speed = 9.876_543_21e12;
        for line in table(&state, &[]).lines().chain(flat.lines()) {
            assert!(line.chars().count() <= WIDTH, "{line}");
        }
    }

    #[test]
    fn states_the_numbers_an_engineer_looks_for() {
        let text = table(&sample::loaded(), &[]);
        for needle in [
            "104.720",
            "102.625",
            "1000.00",
            "150.000",
            "700.000",
            "171.000",
            "3.4e-9",
            "96.2380",
            "2.0000  %",
            "590.93  W",
            "elastic 0 – 97.4028",
            "holds",
        ] {
            assert!(text.contains(needle), "{needle} is not in\n{text}");
        }
        assert!(!text.contains("WARNING"));
    }

    #[test]
    fn warnings_and_violations_stand_out() {
        let mut state = sample::overhanging();
        state.checks[0].deviation = f64::NAN;
        let text = table(&state, &[]);
        assert!(
            text.lines()
                .nth(3)
                .unwrap()
                .starts_with("WARNING: the belt overhangs")
        );
        assert!(text.contains("VIOLATED"));
    }

    #[test]
    fn the_advice_of_a_warning_is_not_lost() {
        let mut state = sample_flat::epp();
        // So large that the line does not hold it.
        state.warnings = vec![Warning::LargeStrain { strain: 1e4 }];
        let text = table(&state, &[]);
        let mut lines = text.lines().skip_while(|line| !line.starts_with("WARNING"));
        let [first, second] = [lines.next(), lines.next()].map(Option::unwrap);
        assert!(first.ends_with("for small strains: choose"), "{text}");
        assert_eq!(second, "         normal_force=\"exact\"");
    }

    #[test]
    fn a_flat_belt_creeps_along_the_rim() {
        let mut state = sample_flat::epp();
        let entry = state.driver.entry.as_mut().unwrap();
        entry.strain = -3.77e-26;
        let text = table(&state, &[]);
        for needle in [
            "N/m², normal force n = (T − G V)/R\n",
            "slip arc",
            "2.50e-7",
            "reference tension T_o",
            "smallest k_f with slip                       7.65432e5",
            "elastic 0 – 36.2218",
            "closed form\n",
            "-3.77e-26",
            "1.2e-14",
            "holds",
        ] {
            assert!(text.contains(needle), "{needle} is not in\n{text}");
        }
        let mut short = state;
        short.driver.entry = None;
        assert!(
            table(&short, &[]).contains("  –  "),
            "one pulley has an entry"
        );
        short.driven.entry = None;
        assert!(!table(&short, &[]).contains("T_o"));
    }

    #[test]
    fn a_flat_belt_has_nothing_of_a_groove() {
        for mut state in [
            sample_flat::epp(),
            sample_flat::coulomb(),
            sample_flat::creep(),
        ] {
            for normal_force in NormalForce::ALL {
                state.drive.belt.kind = BeltKind::Flat { normal_force };
                let text = table(&state, &[]);
                for word in [
                    "penetration",
                    "inclination",
                    "groove",
                    "mesh",
                    "NaN",
                    "V-belt",
                ] {
                    assert!(!text.contains(word), "{word} is in\n{text}");
                }
                assert!(!text.contains('…'), "{text}");
            }
        }
        assert!(!table(&sample_flat::coulomb(), &[]).contains("k_f"));
    }

    #[test]
    fn a_standing_drive_has_a_table() {
        let text = table(&sample::idle(), &[]);
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        let mut empty = sample::idle();
        empty.checks.clear();
        assert!(!table(&empty, &[]).contains("zones"));
    }
}
