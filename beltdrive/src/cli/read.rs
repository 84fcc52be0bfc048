//! Drive files as the command line names them.

use super::failure::Failure;
use super::output::is_stream;
use beltdrive::examples;
use std::{
    fs,
    io::{self, ErrorKind, Read},
    path::Path,
};

/// The name and the text of a drive file or of standard input.
pub(super) fn read(file: &Path) -> Result<(String, String), Failure> {
    let (name, bytes) = if is_stream(file) {
        let mut bytes = Vec::new();
        let outcome = io::stdin().read_to_end(&mut bytes);
        ("standard input".to_owned(), outcome.map(|_| bytes))
    } else {
        (file.display().to_string(), fs::read(file))
    };
    let bytes = bytes.map_err(|error| match Failure::io(&format!("read {name}"), &error) {
        Failure::Usage(message) if error.kind() == ErrorKind::NotFound => {
            Failure::Usage(message + &example_help(file))
        }
        failure => failure,
    })?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let valid = error.utf8_error().valid_up_to();
        Failure::Usage(format!(
            "error: {name} is no text in UTF-8: byte {valid} is invalid"
        ))
    })?;
    Ok((name, text))
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
