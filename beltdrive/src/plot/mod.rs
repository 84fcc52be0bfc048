//! Results as figures in SVG.

mod axis;
mod belt_loop;
mod branch;
mod diagrams;
mod drive;
mod geometry;
mod header;
mod labels;
mod limit_curve;
mod occupied;
mod panel;
mod plan;
mod profile_figures;
mod profiles;
mod rows;
mod stability;
mod style;

use crate::belt_loop::{BeltLoop, LoopState};
use crate::quantity::Answer;
use crate::report::write_file;
use crate::{Branch, LimitCurve, Stability, SteadyState};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// Why a figure was not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The directory for the figures does not exist and cannot be created.
    #[error("cannot create directory {}: {source}", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// A figure cannot be written.
    #[error("cannot write figure {}: {source}", path.display())]
    Figure {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}

/// Writes all figures of a state into a directory, which is created where it does not exist, and
/// returns the files written: `drive.svg`, the drive to scale, and the profiles along both pulleys.
/// Existing files of these names are replaced, each once the new one is complete.
///
/// A V-belt has the profiles `tension.svg`, `inclination.svg`, `penetration.svg`,
/// `sliding_angle.svg` and `normal_and_friction_force.svg`; a flat belt has `tension.svg`,
/// `friction_force.svg`, `normal_force.svg` and `displacement.svg`.
///
/// `metadata` is a text that every figure carries, but does not show.
///
/// # Errors
/// [`Error`] names the directory or file that cannot be written.
pub fn write_all(
    state: &SteadyState,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let drive = std::iter::once(("drive.svg", drive::figure(state)));
    write(drive.chain(profiles::figures(state)), directory, metadata)
}

/// Writes all figures of the steady state of a belt loop into a directory, as [`write_all`] does: `loop.svg`,
/// the loop to scale, and the profiles that [`write_all`] names, along the whole belt.
///
/// # Errors
/// As [`write_all`].
pub fn write_loop(
    belt_loop: &BeltLoop,
    state: &LoopState,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let drawn = std::iter::once(("loop.svg", belt_loop::figure(belt_loop, state)));
    let profiles = belt_loop::profiles::figures(belt_loop, state);
    write(drawn.chain(profiles), directory, metadata)
}

/// Writes a figure of a name with the numbers in the rows of an answer, such as a branch of a loop or a curve of
/// its limits, into a directory, as [`write_all`] does.
///
/// # Errors
/// As [`write_all`].
pub fn write_rows(
    answer: &Answer,
    name: &'static str,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let figure = (name, rows::figure(answer));
    write(std::iter::once(figure), directory, metadata)
}

/// Writes `branch.svg`, the bifurcation diagram of a branch, into a directory, as [`write_all`]
/// does.
///
/// # Errors
/// As [`write_all`].
pub fn write_branch(
    branch: &Branch,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let figure = ("branch.svg", branch::figure(branch));
    write(std::iter::once(figure), directory, metadata)
}

/// Writes `limit_curve.svg`, the chart of a limit over a second parameter, into a directory, as
/// [`write_all`] does.
///
/// # Errors
/// As [`write_all`].
pub fn write_limit_curve(
    curve: &LimitCurve,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let figure = ("limit_curve.svg", limit_curve::figure(curve));
    write(std::iter::once(figure), directory, metadata)
}

/// Writes `modes.svg`, the first axial modes of a flat belt on both pulleys, and `spectrum.svg`, their
/// eigenvalues in every form of the linearised problem, into a directory, as [`write_all`] does.
///
/// # Errors
/// As [`write_all`].
pub fn write_stability(
    stability: &Stability,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    write(
        stability::figures(stability).into_iter(),
        directory,
        metadata,
    )
}

fn write(
    figures: impl Iterator<Item = (&'static str, String)>,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    fs::create_dir_all(directory).map_err(|source| Error::Directory {
        path: directory.to_owned(),
        source,
    })?;
    figures
        .map(|(name, figure)| {
            let path = directory.join(name);
            let figure = described(figure, metadata);
            match write_file(&path, &figure) {
                Ok(()) => Ok(path),
                Err(source) => Err(Error::Figure { path, source }),
            }
        })
        .collect()
}

/// A figure with a text in a `metadata` element, which is not drawn.
fn described(figure: String, metadata: Option<&str>) -> String {
    match (metadata, figure.split_once('>')) {
        (Some(metadata), Some((start, rest))) => {
            let text = metadata
                .replace('&', "&amp;")
                .replace('<', "&lt;")
                .replace('>', "&gt;");
            format!("{start}>\n<metadata>{text}</metadata>{rest}")
        }
        _ => figure,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::{sample, sample_branch, sample_flat};

    /// A directory of this process that is gone after the test.
    struct Scratch(PathBuf);

    impl Scratch {
        fn new(name: &str) -> Self {
            let name = format!("beltdrive-plot-{name}-{}", std::process::id());
            Self(std::env::temp_dir().join(name))
        }
    }

    impl Drop for Scratch {
        fn drop(&mut self) {
            drop(fs::remove_dir_all(&self.0));
        }
    }

    #[test]
    fn every_figure_is_written_and_well_formed() {
        let scratch = Scratch::new("figures");
        for (name, state) in [
            ("loaded", sample::loaded()),
            ("idle", sample::idle()),
            ("overhanging", sample::overhanging()),
            ("blank", sample::blank()),
        ] {
            let files = write_all(&state, &scratch.0.join(name), None).unwrap();
            assert_eq!(files.len(), 6);
            for file in files {
                let text = fs::read_to_string(&file).unwrap();
                assert!(text.starts_with("<svg") && text.trim_end().ends_with("</svg>"));
                assert!(
                    text.len() > 1000 && !text.contains("NaN"),
                    "{}",
                    file.display()
                );
                assert!(!text.contains("made up\""), "quotes are escaped");
            }
        }
    }

    #[test]
    fn a_flat_belt_has_its_own_figures() {
        let scratch = Scratch::new("flat");
        for state in [
            sample_flat::epp(),
            sample_flat::coulomb(),
            sample_flat::creep(),
        ] {
            let mut files = write_all(&state, &scratch.0, None).unwrap();
            let names: Vec<_> = files.iter().map(|file| file.file_name().unwrap()).collect();
            let expected = [
                "drive.svg",
                "tension.svg",
                "friction_force.svg",
                "normal_force.svg",
                "displacement.svg",
            ];
            assert_eq!(names, expected);
            files.extend(write_branch(&sample_flat::branch(), &scratch.0, None).unwrap());
            files.extend(write_limit_curve(&sample_flat::curve(), &scratch.0, None).unwrap());
            for file in files {
                let text = fs::read_to_string(&file).unwrap();
                assert!(text.contains("normal force n = (T − G V)/R"));
                for word in ["NaN", "nclination", "enetration", "groove", "V-belt"] {
                    assert!(!text.contains(word), "{word} in {}", file.display());
                }
            }
        }
        assert!(branch::figure(&sample_flat::branch()).contains("Slip arcs"));
    }

    #[test]
    fn branches_and_curves_have_a_figure() {
        let scratch = Scratch::new("branches");
        let mut files = write_branch(&sample_branch::folded(), &scratch.0, None).unwrap();
        files.extend(write_limit_curve(&sample_branch::curve(), &scratch.0, None).unwrap());
        let names: Vec<_> = files.iter().map(|file| file.file_name().unwrap()).collect();
        assert_eq!(names, ["branch.svg", "limit_curve.svg"]);
        for file in files {
            let text = fs::read_to_string(file).unwrap();
            assert!(text.starts_with("<svg") && !text.contains("NaN"));
            assert!(text.contains("tight tractive tension"));
        }
    }

    #[test]
    fn a_directory_that_cannot_be_created_is_named() {
        let scratch = Scratch::new("blocked");
        fs::write(&scratch.0, "a file").unwrap();
        let error = write_all(&sample::loaded(), &scratch.0.join("figures"), None).unwrap_err();
        fs::remove_file(&scratch.0).unwrap();
        assert!(matches!(&error, Error::Directory { path, .. } if path.ends_with("figures")));
        assert!(error.to_string().contains("blocked"));
    }

    #[test]
    fn a_figure_that_cannot_be_written_is_named() {
        let scratch = Scratch::new("occupied");
        fs::create_dir_all(scratch.0.join("drive.svg")).unwrap();
        let error = write_all(&sample::loaded(), &scratch.0, None).unwrap_err();
        assert!(matches!(&error, Error::Figure { path, .. } if path.ends_with("drive.svg")));
    }
}
