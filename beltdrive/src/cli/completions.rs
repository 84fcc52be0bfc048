//! `beltdrive completions`: what a shell needs to complete commands and options.

use super::{Cli, failure::Failure, output::print_bytes};
use clap::{Args, CommandFactory};
use clap_complete::Shell;

const HELP: &str = "\
Example:
  beltdrive completions bash > ~/.local/share/bash-completion/completions/beltdrive";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Completions {
    /// The shell
    shell: Shell,
}

impl Completions {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let mut command = Cli::command();
        let mut script = Vec::new();
        let name = command.get_name().to_owned();
        clap_complete::generate(self.shell, &mut command, name, &mut script);
        print_bytes(&script)
    }
}
