//! Drive files and data as the command line names them.

use super::failure::Failure;
use super::output::is_stream;
use beltdrive::examples;
#[cfg(unix)]
use std::os::unix::fs::FileTypeExt;
use std::{
    fs::{self, File, FileType},
    io::{self, ErrorKind, Read},
    path::Path,
};

/// The largest drive file, in MiB: a thousand times the size of one with every key and a comment beside
/// each, which takes some 2 kB. Without a bound a device without an end would fill the memory.
const LARGEST: u64 = 1;

/// The name and the text of a drive file or of standard input.
pub(super) fn read(file: &Path) -> Result<(String, String), Failure> {
    text(file, "a drive file")
}

/// The name and the text of a file or of standard input; messages call it `what`.
pub(super) fn text(file: &Path, what: &str) -> Result<(String, String), Failure> {
    let (name, bytes) = if is_stream(file) {
        ("standard input".to_owned(), bounded(io::stdin().lock()))
    } else {
        let name = file.display().to_string();
        let metadata = fs::metadata(file);
        if let Some(kind) = metadata
            .ok()
            .and_then(|metadata| unreadable(metadata.file_type()))
        {
            return Err(Failure::Usage(format!(
                "error: {name} is {kind}, not {what}"
            )));
        }
        (name, File::open(file).and_then(bounded))
    };
    let bytes = bytes.map_err(|error| match Failure::io(&format!("read {name}"), &error) {
        Failure::Usage(message) if error.kind() == ErrorKind::NotFound => {
            Failure::Usage(message + &example_help(file))
        }
        failure => failure,
    })?;
    if bytes.len() as u64 > LARGEST << 20 {
        return Err(Failure::Usage(format!(
            "error: {name} is larger than {LARGEST} MiB, a thousand times what a drive file takes: \
             not {what}"
        )));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        Failure::Usage(format!(
            "error: {name} is no text in UTF-8: byte {valid} is invalid"
        ))
    })?;
    Ok((name, text))
}

/// The bytes of a source, but of one that is too large only one more than the bound.
fn bounded(source: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    source.take((LARGEST << 20) + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// What a path is that leads to neither a file nor a pipe.
fn unreadable(kind: FileType) -> Option<&'static str> {
    if kind.is_dir() {
        return Some("a directory");
    }
    #[cfg(unix)]
    if kind.is_char_device() || kind.is_block_device() {
        return Some("a device");
    }
    None
}

/// Help for a missing file that is called like a shipped example.
fn example_help(file: &Path) -> String {
    let stem = file.file_stem().and_then(|stem| stem.to_str());
    match stem.map(examples::find) {
        Some(Ok(example)) => format!(
            "\nhelp: {0} is an example that comes with the program; did you mean \
             `beltdrive examples {0} > {0}.toml`?",
            example.name
        ),
        _ => String::new(),
    }
}
