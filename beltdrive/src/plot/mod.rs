//! Results as figures in SVG.

mod axis;
mod campbell;
mod clock;
mod contours;
mod curve;
mod header;
mod history;
mod layout;
mod mode_shapes;
mod numbers;
mod occupied;
mod ordered;
mod panel;
mod profiles;
mod rating;
mod residuals;
mod rows;
mod sheet;
mod stability;
#[cfg(test)]
mod tests;
mod zones;

use crate::quantity::Answer;
use crate::report::write_file;
use crate::transient::History;
use crate::{Calibration, Drive, Modes, OperatingMap, Rating, Stability};
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
    /// A run kept no frames for an animation.
    #[error("the run kept no frames for an animation: `Simulation::frames` says how many")]
    NoFrames,
}

/// Most frames of an animation, as [`Simulation::frames`](crate::transient::Simulation::frames): at their pace, up to
/// 40 s, some five a second, with straight changes between them, and a file of less than a megabyte.
pub const FRAMES: usize = 200;

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
    let drawn = state_figures(answer).into_iter();
    let named = drawn
        .enumerate()
        .map(|(index, (name, figure))| match index {
            0 => (layout, figure),
            _ => (name, figure),
        });
    write(named, directory, metadata)
}

/// The figures of a steady state in SVG under their names, as [`write_state`] writes them: first `layout.svg`, the layout
/// to scale.
#[must_use]
pub fn state_figures(answer: &Answer) -> Vec<(&'static str, String)> {
    let drawn = std::iter::once(("layout.svg", layout::figure(answer)));
    drawn.chain(profiles::figures(answer)).collect()
}

/// Writes the layouts of several answers to scale, as `case-1.svg` and so on by their numbers, into a directory, as
/// [`write_state`] does.
///
/// # Errors
/// As [`write_state`].
pub fn write_layouts(
    answers: &[(usize, Answer)],
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let figure =
        |(number, answer): &(usize, Answer)| (format!("case-{number}.svg"), layout::figure(answer));
    write(answers.iter().map(figure), directory, metadata)
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

/// Writes `residuals.svg`, the readings of a calibration against its model, into a directory, as [`write_state`]
/// does.
///
/// # Errors
/// As [`write_state`].
pub fn write_calibration(
    heading: &str,
    calibration: &Calibration,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let figure = residuals::figure(heading, calibration);
    write(
        std::iter::once(("residuals.svg", figure)),
        directory,
        metadata,
    )
}

/// Writes `map.svg`, contours of speed loss, efficiency, slip margin and hub load over the axes of a map, into a directory,
/// as [`write_state`] does.
///
/// # Errors
/// As [`write_state`].
pub fn write_map(
    map: &OperatingMap,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let figure = contours::figure(map);
    write(std::iter::once(("map.svg", figure)), directory, metadata)
}

/// Writes `rating.svg`, the largest torque and power of a drive against speed with the reasons of the limit, into a
/// directory, as [`write_state`] does.
///
/// # Errors
/// As [`write_state`].
pub fn write_rating(
    rating: &Rating,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let figure = rating::figure(rating);
    write(std::iter::once(("rating.svg", figure)), directory, metadata)
}

/// Writes `history.svg`, speeds, tensions, torques and slip arcs of a drive over time with its events, and, if the run
/// kept the belt at instants, `belt.svg`, its tension and friction along the loop, and `loop-1.svg` and so on in the order of
/// time, the loop with the tension of the belt as colour and its zones of friction, into a directory, as [`write_state`]
/// does.
///
/// # Errors
/// As [`write_state`].
pub fn write_history(
    drive: &Drive,
    history: &History,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let named = |name: &str, figure| (name.to_owned(), figure);
    let over_time = named("history.svg", history::figure(drive, history));
    let along = history::along_loop(drive, history).map(|figure| named("belt.svg", figure));
    let stills = layout::in_time::stills(drive, history).into_iter();
    let stills = stills
        .zip(1..)
        .map(|(figure, number)| named(&format!("loop-{number}.svg"), figure));
    let figures = [over_time].into_iter().chain(along).chain(stills);
    write(figures, directory, metadata)
}

/// Writes an animation of a run in SVG, which plays again and again without a script: the loop with the tension of the belt as
/// colour, its zones of friction, pulleys that turn and the time. Its frames are [`History::frames`]; what lies between two of
/// them changes straight from one to the other. It is shown slower or faster than it is, by a round number that it tells.
///
/// An existing file is replaced once the new one is complete. `metadata` is as in [`write_state`].
///
/// # Errors
/// [`Error::NoFrames`] if there are none, and [`Error::Figure`] if the file cannot be written.
pub fn write_animation(
    drive: &Drive,
    history: &History,
    path: &Path,
    metadata: Option<&str>,
) -> Result<(), Error> {
    let figure = layout::in_time::animation(drive, history).ok_or(Error::NoFrames)?;
    write_figure(path, figure, metadata)
}

/// Writes `mode_shapes.svg`, the first vibrations of a drive along its belt, and, if the modes were sought over a range of
/// speeds, `campbell.svg`, their frequencies beside those of the excitation, into a directory, as [`write_state`] does.
///
/// # Errors
/// As [`write_state`].
pub fn write_modes(
    modes: &Modes,
    directory: &Path,
    metadata: Option<&str>,
) -> Result<Vec<PathBuf>, Error> {
    let shapes = ("mode_shapes.svg", mode_shapes::figure(modes));
    let over_speed = campbell::figure(modes).map(|figure| ("campbell.svg", figure));
    write([shapes].into_iter().chain(over_speed), directory, metadata)
}

fn write<N: AsRef<Path>>(
    figures: impl Iterator<Item = (N, String)>,
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
            write_figure(&path, figure, metadata).map(|()| path)
        })
        .collect()
}

fn write_figure(path: &Path, figure: String, metadata: Option<&str>) -> Result<(), Error> {
    write_file(path, described(figure, metadata)).map_err(|source| Error::Figure {
        path: path.to_owned(),
        source,
    })
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
