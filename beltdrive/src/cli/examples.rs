//! `beltdrive examples`: the drive files that come with the program.

use super::{failure::Failure, output::print};
use beltdrive::examples;
use clap::Args;

const HELP: &str = "\
Example:
  beltdrive examples kim2009 > kim2009.toml";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Examples {
    /// The drive file to print
    name: Option<String>,
}

impl Examples {
    pub(super) fn run(&self) -> Result<(), Failure> {
        if self.name.as_deref() == Some("flat-bench.csv") {
            return print(examples::FLAT_BENCH);
        }
        if let Some(name) = &self.name {
            let unknown = |error| Failure::Usage(format!("error: {error}"));
            return print(examples::find(name).map_err(unknown)?.text);
        }
        let rows = examples::EXAMPLES.map(|example| {
            let (title, summary) = (example.title(), example.summary());
            format!("{:16} {title}\n{:16} {summary}\n", example.name, "")
        });
        print(&rows.concat())
    }
}
