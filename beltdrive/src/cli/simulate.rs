//! `beltdrive simulate`: a drive in time.

use super::{common::Common, failure::Failure, interrupt::Interrupt, origin::Origin};
use beltdrive::input::{Argument, DriveFile};
use beltdrive::transient::{Ending, History, Simulation, TransientError, Until};
use beltdrive::{Drive, plot, quantity, simulate};
use clap::Args;
use std::path::{Path, PathBuf};

const HELP: &str = "\
Examples:
  beltdrive examples slip-pulse > slip-pulse.toml
  beltdrive simulate slip-pulse.toml --until '0.1 s' --csv history.csv
  beltdrive simulate slip-pulse.toml --until steady --plot figures --at '40 ms'
  beltdrive simulate slip-pulse.toml --animate slip-pulse.svg

The table [transient] of the drive file says what the pulleys and their axles do. --csv and --parquet
write one row per sample.

Exit status:
  0  success
  1  there is no state to start from, no steady state was reached, or the run failed on the way, as where its energy
     ledger does not close: everything is written up to there
  2  an input, an output or the command line is at fault
  130  an interrupt (Ctrl-C) ended the run: everything is written up to there";

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Simulate {
    #[command(flatten)]
    common: Common,
    /// When the run ends: a time, `steady`, `slip` or `slack`, which are the first of their kind [default: transient.end
    /// of the drive file]
    #[arg(long, value_name = "TIME")]
    until: Option<String>,
    /// With --plot, draw the belt at this time, along the loop and on its pulleys; repeatable
    #[arg(long = "at", value_name = "TIME")]
    instants: Vec<String>,
    /// Write the run as an animated SVG: tension as colour, zones of slip, pulleys that turn
    #[arg(long, value_name = "FILE.svg", value_parser = svg)]
    animate: Option<PathBuf>,
}

impl Simulate {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let animate = ("--animate", self.animate.as_deref());
        let (file, origin) = self.common.file_beside(&[animate])?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let until = self.until.as_deref().map(|value| Argument {
            option: "--until",
            value,
        });
        let mut simulation = file.simulation(until).map_err(Failure::usage)?;
        for value in &self.instants {
            let argument = Argument {
                option: "--at",
                value,
            };
            let instant = argument.time().map_err(Failure::usage)?;
            simulation.instants.push(instant);
        }
        if self.animate.is_some() {
            simulation.frames = plot::FRAMES;
        }
        let interrupt = Interrupt::catch()?;
        let history = self.common.with_progress(|progress| {
            simulate(&simulation, &mut |time, share| {
                progress(share, &format!("{time:.3} s"));
                !interrupt.came()
            })
        });
        let told = history.as_ref().map_or_else(TransientError::history, Some);
        if let Some(told) = told {
            self.write(&simulation.drive, told, origin)?;
        }
        let history = history.map_err(|error| Failure::of_simulation(file, &simulation, error))?;
        match (history.ending, simulation.until) {
            (Ending::NotSteady, Until::Steady { latest }) => Err(Failure::Unsolved(format!(
                "error: the drive is not steady at {latest} s\nhelp: transient.end is the latest time of the search; \
                 axial damping or a load that rises with the speed ends vibrations"
            ))),
            (Ending::Interrupted, _) => {
                let reached = history.samples.last().map_or(0.0, |sample| sample.time);
                Err(Failure::Interrupted(format!(
                    "error: interrupted at {reached} s, with everything written up to there"
                )))
            }
            _ => Ok(()),
        }
    }

    /// Writes all that was asked for.
    fn write(&self, drive: &Drive, history: &History, origin: &Origin) -> Result<(), Failure> {
        let answer = &quantity::transient::answer(drive, history);
        let draw = |directory: &Path, metadata: &str| {
            plot::write_history(drive, history, directory, Some(metadata))
        };
        self.common.output.write(answer, &draw, origin)?;
        let Some(path) = &self.animate else {
            return Ok(());
        };
        let metadata = origin.json();
        plot::write_animation(drive, history, path, Some(&metadata))
            .map_err(|error| Failure::usage(format!("error: {error}")))?;
        self.common.output.name(std::slice::from_ref(path));
        Ok(())
    }
}

/// The name of a file for an animation.
fn svg(text: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let is_svg = path
        .extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("svg"));
    match is_svg {
        true => Ok(path),
        false => {
            Err("an animation is written as SVG, into a file whose name ends in .svg".to_owned())
        }
    }
}

impl Failure {
    /// Why a simulation of a file failed, at the key that is at fault if there is one.
    pub(super) fn of_simulation(
        file: &DriveFile,
        simulation: &Simulation,
        error: TransientError,
    ) -> Self {
        match file.of_simulation(simulation, &error) {
            Some(placed) => Self::usage(placed),
            None => error.into(),
        }
    }
}

impl From<TransientError> for Failure {
    fn from(error: TransientError) -> Self {
        let text = format!("error: {error}");
        match error.is_of_statement() {
            true => Self::Usage(text),
            false => Self::Unsolved(text),
        }
    }
}
