//! Results as figures in SVG.

mod axis;
mod curve;
mod header;
mod layout;
mod numbers;
mod occupied;
mod panel;
mod profiles;
mod rows;
mod sheet;
mod stability;
mod zones;

use crate::Stability;
use crate::quantity::Answer;
use crate::report::write_file;
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

/// Writes all figures of a steady state into a directory, which is created where it does not exist, and
/// returns the files written: the layout to scale under the given name, and the profiles along all pulleys.
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
pub fn write_state(
    answer: &Answer,
    layout: &'static str,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let drawn = std::iter::once((layout, layout::figure(answer)));
    write(drawn.chain(profiles::figures(answer)), directory, metadata)
}

/// Writes a figure of a name with the numbers in the rows of an answer, such as a branch or a curve of limits,
/// into a directory, as [`write_state`] does.
///
/// # Errors
/// As [`write_state`].
pub fn write_rows(
    answer: &Answer,
    name: &'static str,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let figure = (name, rows::figure(answer));
    write(std::iter::once(figure), directory, metadata)
}

/// Writes `modes.svg`, the first axial modes of a flat belt on both pulleys, and `spectrum.svg`, their
/// eigenvalues in every form of the linearised problem, into a directory, as [`write_state`] does.
///
/// # Errors
/// As [`write_state`].
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
            let text = sheet::escaped(metadata);
            format!("{start}>\n<metadata>{text}</metadata>{rest}")
        }
        _ => figure,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::{two_pulley_rows, two_pulleys};
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

    /// The attribute of a tag.
    fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
        let (_, rest) = tag.split_once(&format!(" {name}=\""))?;
        rest.split_once('"').map(|(value, _)| value)
    }

    /// Every element that begins ends, every number is one, and every text is on the sheet, its numbers with
    /// minus signs.
    pub(super) fn check(figure: &str) {
        assert!(figure.starts_with("<svg") && figure.ends_with("</svg>\n"));
        assert!(!figure.contains("NaN") && !figure.contains("inf\""));
        let number = |tag, name| attribute(tag, name).and_then(|text| text.parse::<f64>().ok());
        let mut open: Vec<&str> = Vec::new();
        let sheet = figure.split_once('>').unwrap().0;
        let [width, height] = ["width", "height"].map(|name| number(sheet, name).unwrap());
        for element in figure.split('<').skip(1) {
            let (tag, text) = element.split_once('>').expect("a tag ends");
            if let Some(name) = tag.strip_prefix('/') {
                assert_eq!(open.pop(), Some(name));
            } else if !tag.ends_with('/') {
                assert_eq!(tag.matches('"').count() % 2, 0, "{tag}");
                open.extend(tag.split_whitespace().next());
            }
            if tag.starts_with("text") {
                let [x, y, size] = ["x", "y", "font-size"].map(|name| number(tag, name).unwrap());
                let length = sheet::text_width(text, size);
                let start = match attribute(tag, "text-anchor") {
                    Some("start") => x,
                    Some("middle") => x - 0.5 * length,
                    _ => x - length,
                };
                let is_turned = tag.contains("rotate(-90)");
                let ends = if is_turned {
                    [-start - length, -start]
                } else {
                    [start, start + length]
                };
                let [along, across] = if is_turned {
                    [height, width]
                } else {
                    [width, height]
                };
                assert!(
                    ends[0] >= 0.0 && ends[1] <= along,
                    "{text} from {ends:?} on {along}"
                );
                assert!(
                    y - size >= 0.0 && y + 0.3 * size <= across,
                    "{text} at {y} on {across}"
                );
                let letters: Vec<_> = text.chars().collect();
                let is_minus = |trio: &[char]| {
                    !trio[0].is_alphanumeric() && trio[1] == '-' && trio[2].is_ascii_digit()
                };
                assert!(
                    !letters.windows(3).any(is_minus) && !text.starts_with('-'),
                    "{text}"
                );
            }
        }
        assert_eq!(open, [""; 0]);
    }

    fn names(files: &[PathBuf]) -> Vec<&str> {
        let names = files.iter().map(|file| file.file_name().unwrap());
        names.map(|name| name.to_str().unwrap()).collect()
    }

    fn state(state: &crate::SteadyState, directory: &Path) -> Result<Vec<PathBuf>, Error> {
        write_state(&two_pulleys::drawn(state), "drive.svg", directory, None)
    }

    #[test]
    fn every_figure_is_written_and_well_formed() {
        let scratch = Scratch::new("figures");
        for (name, drawn) in [
            ("loaded", sample::loaded()),
            ("idle", sample::idle()),
            ("overhanging", sample::overhanging()),
            ("blank", sample::blank()),
        ] {
            let files = state(&drawn, &scratch.0.join(name)).unwrap();
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
                check(&text);
                let warns = text.contains(">Warning: the belt overhangs itself on the driver");
                assert_eq!(warns, name == "overhanging");
            }
        }
    }

    #[test]
    fn a_flat_belt_has_its_own_figures() {
        let scratch = Scratch::new("flat");
        for drawn in [
            sample_flat::epp(),
            sample_flat::coulomb(),
            sample_flat::creep(),
        ] {
            let mut files = state(&drawn, &scratch.0).unwrap();
            let expected = [
                "drive.svg",
                "tension.svg",
                "friction_force.svg",
                "normal_force.svg",
                "displacement.svg",
            ];
            assert_eq!(names(&files), expected);
            let branch = two_pulley_rows::branch(&sample_flat::branch());
            files.extend(write_rows(&branch, "branch.svg", &scratch.0, None).unwrap());
            let curve = two_pulley_rows::limit_curve(&sample_flat::curve());
            files.extend(write_rows(&curve, "limit_curve.svg", &scratch.0, None).unwrap());
            for file in files {
                let text = fs::read_to_string(&file).unwrap();
                check(&text);
                assert!(text.contains("normal force n = (T − G V)/R"));
                for word in ["nclination", "enetration", "groove", "V-belt"] {
                    assert!(!text.contains(word), "{word} in {}", file.display());
                }
            }
            let branch = fs::read_to_string(scratch.0.join("branch.svg")).unwrap();
            assert!(branch.contains(">Slip arc<"));
        }
    }

    #[test]
    fn every_stability_has_figures() {
        let scratch = Scratch::new("stability");
        let stability = crate::quantity::stability::sample::stability();
        let files = write_stability(&stability, &scratch.0, Some("a < b")).unwrap();
        assert_eq!(names(&files), ["modes.svg", "spectrum.svg"]);
        for file in files {
            let text = fs::read_to_string(file).unwrap();
            check(&text);
            assert!(text.contains("\n<metadata>a &lt; b</metadata>"));
        }
    }

    #[test]
    fn a_directory_that_cannot_be_created_is_named() {
        let scratch = Scratch::new("blocked");
        fs::write(&scratch.0, "a file").unwrap();
        let error = state(&sample::loaded(), &scratch.0.join("figures")).unwrap_err();
        fs::remove_file(&scratch.0).unwrap();
        assert!(matches!(&error, Error::Directory { path, .. } if path.ends_with("figures")));
        assert!(error.to_string().contains("blocked"));
    }

    #[test]
    fn a_figure_that_cannot_be_written_is_named() {
        let scratch = Scratch::new("occupied");
        fs::create_dir_all(scratch.0.join("drive.svg")).unwrap();
        let error = state(&sample::loaded(), &scratch.0).unwrap_err();
        assert!(matches!(&error, Error::Figure { path, .. } if path.ends_with("drive.svg")));
    }

    #[test]
    fn an_empty_answer_has_figures() {
        let mut branch = sample_branch::folded();
        branch.points.clear();
        branch.events.clear();
        check(&rows::figure(&two_pulley_rows::branch(&branch)));
        profiles::figures(&Answer::default()).for_each(|(_, figure)| check(&figure));
    }
}
