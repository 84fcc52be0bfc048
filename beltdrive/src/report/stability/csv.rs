//! The eigenvalues of the axial motion as comma-separated values.

use super::words::{form_word, pulleys};
use crate::report::{rows, words::pulley_word};
use crate::{BeltKind, Stability};
use std::f64::consts::TAU;

const COLUMNS: [&str; 9] = [
    "pulley",
    "form",
    "mode",
    "growth_per_s",
    "angular_frequency_rad_per_s",
    "frequency_Hz",
    "method_difference",
    "grows",
    "normal_force",
];

/// One row per pulley, form of the linearised problem and mode, with the names of the JSON report.
pub fn csv(stability: &Stability) -> String {
    let convention = match stability.drive.belt.kind {
        BeltKind::V(_) => "",
        BeltKind::Flat { normal_force } => normal_force.name(),
    };
    let mut lines = Vec::new();
    for (pulley, on) in pulleys(stability) {
        for form in &on.forms {
            for (number, mode) in (1..).zip(&form.modes) {
                let number: u32 = number;
                lines.push(vec![
                    pulley_word(pulley).to_owned(),
                    form_word(form.form).to_owned(),
                    number.to_string(),
                    mode.growth.to_string(),
                    mode.frequency.to_string(),
                    (mode.frequency / TAU).to_string(),
                    mode.difference.to_string(),
                    mode.grows().to_string(),
                    convention.to_owned(),
                ]);
            }
        }
    }
    rows::csv(COLUMNS.map(str::to_owned).to_vec(), lines)
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    #[test]
    fn has_a_row_per_pulley_form_and_mode() {
        let text = csv(&sample::stability());
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines.len(), 1 + 2 * 3 * sample::MODES);
        assert_eq!(lines[0], COLUMNS.join(","));
        assert!(
            lines[1].starts_with("driver,thesis,1,-40,10000,1591.54"),
            "{text}"
        );
        assert!(lines[1].ends_with(",false,inertia"));
        let last = lines[lines.len() - 1];
        assert!(last.starts_with("driven,conservative,4,"), "{text}");
    }
}
