//! Where a command writes, checked before it computes: no output overwrites another or a file that is read.

use super::failure::Failure;
use super::output::is_stream;
use std::ffi::OsStr;
use std::fs;
use std::path::{self, Path, PathBuf};

/// The files of a command.
pub(super) struct Destinations<'a> {
    /// The options that write a text and their files, where given.
    pub(super) texts: &'a [(&'static str, Option<&'a Path>)],
    /// The directory of the figures.
    pub(super) figures: Option<&'a Path>,
    /// What messages call the file that is read, and where it is.
    pub(super) read: Option<(&'static str, &'a Path)>,
}

impl Destinations<'_> {
    /// Refuses what would destroy a file of this run.
    pub(super) fn check(&self) -> Result<(), Failure> {
        let given = self.texts.iter();
        let given = given.filter_map(|&(option, path)| Some((option, path?)));
        let given: Vec<_> = given.collect();
        let streams = given.iter().filter(|(_, path)| is_stream(path));
        let options: Vec<_> = streams.map(|(option, _)| *option).collect();
        if options.len() > 1 {
            let (last, others) = options.split_last().expect("two options were given");
            let others = others.join(", ");
            return Err(Failure::usage(format!(
                "error: only one of {others} and {last} can go to standard output"
            )));
        }
        let (what, read) = self.read.unzip();
        let what = what.unwrap_or_default();
        let read = read.and_then(place);
        let figures = self.figures.and_then(place);
        let mut files: Vec<(&str, PathBuf)> = Vec::new();
        for (option, path) in given {
            let Some(place) = place(path) else {
                continue;
            };
            let shown = path.display();
            if read.as_ref() == Some(&place) {
                return Err(Failure::usage(format!(
                    "error: {option} {shown} would overwrite {what}"
                )));
            }
            if let Some((other, _)) = files.iter().find(|(_, file)| *file == place) {
                return Err(Failure::usage(format!(
                    "error: {other} and {option} name the same file, {shown}"
                )));
            }
            if figures
                .as_ref()
                .is_some_and(|figures| takes(figures, &place))
            {
                return Err(Failure::usage(format!(
                    "error: {option} {shown} is where --plot puts its figures"
                )));
            }
            files.push((option, place));
        }
        match read {
            Some(file) if figures.is_some_and(|figures| takes(&figures, &file)) => {
                Err(Failure::usage(format!(
                    "error: --plot may overwrite {what}: choose another directory for the figures"
                )))
            }
            _ => Ok(()),
        }
    }
}

/// Whether a directory of figures is at a place itself or may put a figure there.
fn takes(figures: &Path, place: &Path) -> bool {
    let is_inside = place.parent() == Some(figures);
    figures == place || is_inside && place.extension() == Some(OsStr::new("svg"))
}

/// The absolute path of a file or directory without links, whether it exists or not; `None` for what
/// overwriting does not destroy: a stream, a device, a pipe.
fn place(path: &Path) -> Option<PathBuf> {
    if is_stream(path) {
        return None;
    }
    if let Ok(metadata) = fs::metadata(path)
        && !metadata.is_file()
        && !metadata.is_dir()
    {
        return None;
    }
    // Directories that do not exist may be made for the figures.
    let path = path::absolute(path).ok()?;
    let known = path
        .ancestors()
        .find_map(|known| Some((known, fs::canonicalize(known).ok()?)));
    let (known, place) = known?;
    match path.strip_prefix(known) {
        Ok(rest) if !rest.as_os_str().is_empty() => Some(place.join(rest)),
        _ => Some(place),
    }
}
