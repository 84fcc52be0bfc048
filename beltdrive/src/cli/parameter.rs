//! What is traced, as the command line names it.

use super::failure::Failure;
use beltdrive::{
    Drive,
    input::{Argument, Key},
};

/// The entry of the drive file that an option names.
pub(super) fn key(option: &str, value: &str, drive: &Drive) -> Result<Key, Failure> {
    let argument = Argument { option, value };
    argument.key(drive).map_err(Failure::usage)
}

/// The values of an entry that two options name, where another entry may be free.
pub(super) fn range(
    options: [(&str, &str); 2],
    key: Key,
    free: Option<Key>,
    drive: &Drive,
) -> Result<[f64; 2], Failure> {
    let [from, to] = options.map(|(option, value)| {
        let argument = Argument { option, value };
        argument.value(key, drive, free).map_err(Failure::usage)
    });
    distinct(options.map(|(option, _)| option), [from?, to?])
}

/// The range that two options name, if its ends differ.
pub(super) fn distinct([from, to]: [&str; 2], range: [f64; 2]) -> Result<[f64; 2], Failure> {
    match range[0] == range[1] {
        false => Ok(range),
        true => Err(Failure::usage(format!(
            "error: {from} and {to} are the same value"
        ))),
    }
}
