//! The stability of the axial motion as a table for a terminal.

use super::meaning::meaning;
use super::words::{form_description, form_label, frequency, growth, least_stable, pulleys, rate};
use crate::input::Key;
use crate::report::{self, lines, six_digits, value};
use crate::{
    AxialMode, Drive, FormStability, LinearisedForm, Onset, Pulley, PulleyStability, Stability,
};
use std::f64::consts::TAU;

/// The eigenvalues on both pulleys, in every form, on lines of at most 100 columns, and what they
/// mean.
pub fn table(stability: &Stability) -> String {
    let drive = &stability.drive;
    let mut title = report::title(drive, &[]);
    title.push("Stability of the axial motion: small displacements f(s) exp(λ t) of the belt about the steady state".to_owned());
    let key = Key::load(drive);
    let load = value::quantity(key, key.get(drive), None);
    let critical = format!(
        "{} {load}; critical belt speed √(EA/m) = {} m/s",
        key.name(),
        six_digits(stability.critical_speed)
    );
    let mut blocks = vec![title, vec![critical], legend()];
    for (pulley, on) in pulleys(stability) {
        blocks.push(modes(pulley, drive, on));
        blocks.push(summary(key, on));
    }
    blocks.push(lines::wrapped("", &meaning(stability)));
    lines::text(blocks)
}

/// What the forms are.
fn legend() -> Vec<String> {
    let form = |form| format!("{:<22}  {}", form_label(form), form_description(form));
    LinearisedForm::ALL.map(form).to_vec()
}

/// The modes on a pulley.
fn modes(pulley: Pulley, drive: &Drive, on: &PulleyStability) -> Vec<String> {
    let radius = match pulley {
        Pulley::Driver => drive.driver_radius,
        Pulley::Driven => drive.driven_radius,
    };
    let degrees = |length: f64| format!("{:.3}°", (length / radius).to_degrees());
    let slips = if on.transition < on.contact_length {
        format!("slip from {} on", degrees(on.transition))
    } else {
        "no slip".to_owned()
    };
    let heading = format!(
        "{}: belt speed {:.4} m/s, contact over {}, {slips}",
        pulley.name(),
        on.belt_speed,
        degrees(on.contact_length),
    );
    let labels: Vec<_> = on.forms.iter().map(|form| form_label(form.form)).collect();
    let mut lines = vec![
        heading,
        String::new(),
        line("", labels.iter().map(|label| format!("{label:>31}"))),
        line("mode", on.forms.iter().map(|_| three("Re λ", "Im λ", ""))),
        line("", on.forms.iter().map(|_| three("1/s", "rad/s", "Hz"))),
    ];
    let count = on.forms.iter().map(|form| form.modes.len()).min();
    lines.extend((0..count.unwrap_or(0)).map(|index| {
        let cells = on.forms.iter().map(|form| cell(&form.modes[index]));
        line(&(index + 1).to_string(), cells)
    }));
    lines
}

/// A line of the table of modes.
fn line(label: &str, cells: impl Iterator<Item = String>) -> String {
    std::iter::once(format!("{label:>4}"))
        .chain(cells)
        .collect()
}

fn cell(mode: &AxialMode) -> String {
    three(
        &growth(mode),
        &frequency(mode, 1.0),
        &frequency(mode, 1.0 / TAU),
    )
}

fn three(growth: &str, frequency: &str, hertz: &str) -> String {
    format!("{growth:>12}{frequency:>10}{hertz:>9}")
}

/// What the spectra on a pulley come to.
fn summary(key: Key, on: &PulleyStability) -> Vec<String> {
    let row = |label: &str, show: &dyn Fn(&FormStability) -> String| {
        let cells = on.forms.iter().map(|form| format!("{:>24}", show(form)));
        format!("{label:<28}{}", cells.collect::<String>())
    };
    vec![
        row("", &|form| form_label(form.form).to_owned()),
        row("largest Re λ in 1/s", &|form| {
            let (mode, number) = least_stable(form);
            match number {
                Some(number) => format!("{}, mode {number}", growth(mode)),
                None => format!("{}, all modes", growth(mode)),
            }
        }),
        row("limit of Re λ, high modes", &|form| {
            rate(form.high_mode_limit, 0.0)
        }),
        row("grows from", &|form| onset(key, form.onset)),
        row("counted up to |Im λ|, rad/s", &|form| {
            six_digits(form.within[1].round())
        }),
        row("eigenvalues there, all found", &|form| {
            form.counted.to_string()
        }),
        row("methods differ by at most", &|form| {
            let differences = form.modes.iter().map(|mode| mode.difference);
            lines::small(differences.fold(0.0, f64::max))
        }),
    ]
}

fn onset(key: Key, onset: Option<Onset>) -> String {
    match onset {
        Some(Onset::At { load, mode }) => {
            let load = value::quantity(key, load, None);
            match mode {
                Some(mode) => format!("{load}, mode {mode}"),
                None => format!("{load}, high modes"),
            }
        }
        Some(Onset::Never) => "none found".to_owned(),
        None => "never".to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;
    use crate::report::lines::WIDTH;

    #[test]
    fn shows_modes_summary_and_meaning() {
        let text = table(&sample::stability());
        for needle in [
            "critical belt speed √(EA/m) = 1291 m/s",
            "driver: belt speed 25.0500 m/s, contact over 171.887°, slip from 114.592° on",
            "   1    -40.0000   10000.0  1591.55      3.2500",
            "largest Re λ in 1/s                 -14.2188, mode 4",
            "480 N, mode 2     150.5 N, high modes                   never",
            "none found",
            "2.0e-12",
            "driver turns unstable at a tight tractive tension of 480 N",
        ] {
            assert!(text.contains(needle), "{needle} is not in\n{text}");
        }
        assert!(
            text.lines()
                .all(|line| line.chars().count() <= WIDTH && !line.contains('…'))
        );
    }

    #[test]
    fn what_is_rounding_is_zero() {
        let text = table(&sample::stability());
        let first = text.lines().find(|line| line.starts_with("   1 ")).unwrap();
        assert!(
            first.ends_with("           0   10000.0  1591.55"),
            "{first}"
        );
    }

    #[test]
    fn a_belt_need_not_slip() {
        let mut stability = sample::stability();
        stability.driven.transition = LENGTH;
        assert!(table(&stability).contains("contact over 114.592°, no slip"));
    }

    const LENGTH: f64 = 0.3;
}
