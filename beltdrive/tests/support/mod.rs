//! A small drive file and the errors of its variations.

use beltdrive::{Drive, input};

/// A right drive file.
pub(crate) const DRIVE: &str = r#"title = "Test"

[belt]
type = "v"
mass_per_length = "0.108 kg/m"
axial_stiffness = "120 kN"
radial_stiffness = "900 kN/m^2"

[groove]
half_angle = "18 deg"

[friction]
law = "coulomb"
coefficient = 0.4
stiffness = "8.1e6 N/m^2"

[pulleys.driver]
radius = "0.25 m"
speed = "1000 rpm"

[pulleys.driven]
radius = "0.25 m"

[layout]
centre_distance = "1.4 m"

[load]
slack_tractive_tension = "100 N"
tight_tractive_tension = "700 N"
"#;

/// The right drive with overrides.
pub(crate) fn overridden(overrides: &[&str]) -> Result<Drive, String> {
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    input::parse("drive.toml", DRIVE, &overrides).map_err(|error| error.to_string())
}

/// The error of the drive file in which `to` replaces the first `from`.
#[track_caller]
pub(crate) fn error(from: &str, to: &str) -> String {
    assert!(DRIVE.contains(from), "{from} is in the drive file");
    let text = DRIVE.replacen(from, to, 1);
    input::parse("drive.toml", &text, &[])
        .unwrap_err()
        .to_string()
}

/// The error of the right drive file with overrides.
#[track_caller]
pub(crate) fn override_error(overrides: &[&str]) -> String {
    overridden(overrides).unwrap_err()
}
