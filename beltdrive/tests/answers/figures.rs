//! Which figures are written, and where they cannot be.

use super::{drive, state};
use beltdrive::plot::{Error, write_stability, write_state};
use beltdrive::quantity::two_pulleys;
use beltdrive::{Role, SteadyState, Warning, stability};
use std::fs;
use std::path::{Path, PathBuf};

/// A place of this test run where nothing is.
fn place(name: &str) -> PathBuf {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR"))
        .join("figures")
        .join(name);
    drop(fs::remove_dir_all(&path));
    path
}

fn names(files: &[PathBuf]) -> Vec<&str> {
    let names = files.iter().map(|file| file.file_name().unwrap());
    names.map(|name| name.to_str().unwrap()).collect()
}

fn written(state: &SteadyState, directory: &Path) -> Result<Vec<PathBuf>, Error> {
    write_state(&two_pulleys::drawn(state), "drive.svg", directory, None)
}

#[test]
fn every_figure_of_a_v_belt_is_written() {
    let mut overhanging = state("kim2009-bristle", &[]);
    for is_overhanging in [false, true] {
        if is_overhanging {
            overhanging.warnings.push(Warning::Overhang {
                pulley: Role::Driver,
                inclination: 1.7,
            });
        }
        let files = written(&overhanging, &place("v-belt")).unwrap();
        let expected = [
            "drive.svg",
            "tension.svg",
            "inclination.svg",
            "penetration.svg",
            "sliding_angle.svg",
            "normal_and_friction_force.svg",
        ];
        assert_eq!(names(&files), expected);
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            let warns = text.contains(">Warning: the belt overhangs itself on the driver");
            assert_eq!(warns, is_overhanging);
        }
    }
}

#[test]
fn a_flat_belt_has_its_own_figures() {
    for law in ["coulomb", "epp", "creep-rate"] {
        let state = state("kim2009-flat", &[&format!("friction.law={law}")]);
        let files = written(&state, &place(law)).unwrap();
        let expected = [
            "drive.svg",
            "tension.svg",
            "friction_force.svg",
            "normal_force.svg",
            "displacement.svg",
        ];
        assert_eq!(names(&files), expected);
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            assert!(text.contains("normal force n = (T − G V)/R"));
            for word in ["nclination", "enetration", "groove", "V-belt"] {
                assert!(!text.contains(word), "{word} in {}", file.display());
            }
        }
    }
}

#[test]
fn every_stability_has_figures() {
    let found = stability(&drive("kim2009-flat", &[]), 2, &mut |_, _| {}).unwrap();
    let files = write_stability(&found, &place("stability"), Some("a < b")).unwrap();
    assert_eq!(names(&files), ["modes.svg", "spectrum.svg"]);
    for file in files {
        let text = fs::read_to_string(file).unwrap();
        assert!(text.contains("\n<metadata>a &lt; b</metadata>"));
    }
}

#[test]
fn a_place_that_cannot_be_written_is_named() {
    let state = state("kim2009-flat", &[]);
    let blocked = place("blocked");
    fs::create_dir_all(blocked.parent().unwrap()).unwrap();
    fs::write(&blocked, "a file").unwrap();
    let error = written(&state, &blocked.join("figures")).unwrap_err();
    fs::remove_file(&blocked).unwrap();
    assert!(matches!(&error, Error::Directory { path, .. } if path.ends_with("figures")));
    assert!(error.to_string().contains("blocked"));
    let occupied = place("occupied");
    fs::create_dir_all(occupied.join("drive.svg")).unwrap();
    let error = written(&state, &occupied).unwrap_err();
    assert!(matches!(&error, Error::Figure { path, .. } if path.ends_with("drive.svg")));
}
