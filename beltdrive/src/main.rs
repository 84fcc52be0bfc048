//! Command line of `beltdrive`.

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
