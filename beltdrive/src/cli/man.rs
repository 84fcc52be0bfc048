//! `beltdrive man`: manual pages.

use super::{Cli, failure::Failure, output::print_bytes};
use clap::{Args, CommandFactory};
use clap_mangen::Man;

const HELP: &str = "\
Example:
  beltdrive man > beltdrive.1
  beltdrive man solve | man -l -";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Manual {
    /// The command to describe, in place of the whole program
    command: Option<String>,
}

impl Manual {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let mut program = Cli::command();
        program.build();
        let page = match &self.command {
            None => program,
            Some(name) => match program.find_subcommand(name) {
                Some(command) => command.clone(),
                None => {
                    let commands = program.get_subcommands();
                    let names: Vec<_> = commands.map(|command| command.get_name()).collect();
                    let names = names.join("`, `");
                    return Err(Failure::usage(format!(
                        "error: there is no command `{name}`\nexpected: one of `{names}`"
                    )));
                }
            },
        };
        let mut text = Vec::new();
        let source = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));
        let rendered = Man::new(page).source(source).render(&mut text);
        rendered.map_err(|error| Failure::io("write the manual page", &error))?;
        print_bytes(&text)
    }
}
