//! `beltdrive sections`: belt sections with their numbers.

use super::failure::Failure;
use super::origin::Origin;
use super::output::{Texts, Units};
use beltdrive::quantity::section;
use beltdrive::sections;
use clap::Args;

const HELP: &str = "\
Example:
  beltdrive sections SPB

belt.section = \"SPB\" in a drive file takes what the file leaves out from there.";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Sections {
    /// The section to show in full, with sources
    name: Option<String>,
    #[command(flatten)]
    texts: Texts,
    /// Units of the table
    #[arg(long, value_name = "SYSTEM", default_value = "engineering")]
    units: Units,
}

impl Sections {
    pub(super) fn run(&self) -> Result<(), Failure> {
        self.texts.check()?;
        let unknown = |error| Failure::Usage(format!("error: {error}"));
        let answer = match &self.name {
            Some(name) => section::one(sections::find(name).map_err(unknown)?),
            None => section::list(&sections::SECTIONS),
        };
        self.texts.write(&answer, self.units, &Origin::new())
    }
}
