//! The steady state of a drive as figures in SVG.

mod axis;
mod drive;
mod geometry;
mod profiles;
mod style;

use crate::SteadyState;
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
/// returns the files written: `drive.svg`, the drive to scale, and the profiles along both
/// pulleys, `tension.svg`, `inclination.svg`, `penetration.svg`, `sliding_angle.svg` and
/// `normal_and_friction_force.svg`. Existing files of these names are replaced.
///
/// # Errors
/// [`Error`] names the directory or file that cannot be written.
pub fn write_all(state: &SteadyState, directory: &Path) -> Result<Vec<PathBuf>, Error> {
    fs::create_dir_all(directory).map_err(|source| Error::Directory {
        path: directory.to_owned(),
        source,
    })?;
    let drive = std::iter::once(("drive.svg", drive::figure(state)));
    drive
        .chain(profiles::figures(state))
        .map(|(name, figure)| {
            let path = directory.join(name);
            match fs::write(&path, figure) {
                Ok(()) => Ok(path),
                Err(source) => Err(Error::Figure { path, source }),
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample;

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
            let files = write_all(&state, &scratch.0.join(name)).unwrap();
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
    fn a_directory_that_cannot_be_created_is_named() {
        let scratch = Scratch::new("blocked");
        fs::write(&scratch.0, "a file").unwrap();
        let error = write_all(&sample::loaded(), &scratch.0.join("figures")).unwrap_err();
        fs::remove_file(&scratch.0).unwrap();
        assert!(matches!(&error, Error::Directory { path, .. } if path.ends_with("figures")));
        assert!(error.to_string().contains("blocked"));
    }

    #[test]
    fn a_figure_that_cannot_be_written_is_named() {
        let scratch = Scratch::new("occupied");
        fs::create_dir_all(scratch.0.join("drive.svg")).unwrap();
        let error = write_all(&sample::loaded(), &scratch.0).unwrap_err();
        assert!(matches!(&error, Error::Figure { path, .. } if path.ends_with("drive.svg")));
    }
}
