//! The commands: what they read, what they write, and their exit status.

mod arrow;
mod calibrate;
mod check;
mod common;
mod completions;
mod design;
mod destinations;
mod examples;
mod failure;
mod interrupt;
mod limits;
mod man;
mod map;
mod modes;
mod origin;
mod output;
mod parameter;
mod parquet;
mod progress;
mod rating;
mod read;
mod report;
mod samples;
mod sections;
mod simulate;
mod solve;
mod stability;
mod stated;
mod sweep;
mod tension;
mod trace;
mod verify;

use clap::{Parser, Subcommand};
use failure::Failure;
use std::process::ExitCode;

const HELP: &str = "\
Example:
  beltdrive examples kim2009 > kim2009.toml
  beltdrive solve kim2009.toml --set 'load.tight_tractive_tension=1200 N'

Exit status:
  0  success
  1  the drive has no steady state, or none was found
  2  an input, an output or the command line is at fault
  3  a requirement of the drive file is not met";

#[derive(Parser)]
#[command(version, about, after_help = HELP)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Find the steady state of a drive and print it as a table
    Solve(solve::Solve),
    /// Judge each load case of a drive by the requirements of its file
    Check(check::Check),
    /// Write a page in HTML on a drive and its load cases, to hand in
    Report(report::Report),
    /// Find the smallest setup tension at which a drive holds in all load cases
    Tension(tension::Tension),
    /// Find the largest torque and power against speed, with the reason of every limit
    Rating(rating::Rating),
    /// Trace the branch of steady states over one entry of the drive file
    Trace(trace::Trace),
    /// Find the smallest and the largest load that a drive carries, and why the range ends there
    Limits(limits::Limits),
    /// Find the steady states over two numbers of the drive file, such as load and speed
    Map(map::Map),
    /// Answer a question for many drives, which differ in some numbers of the drive file
    Sweep(sweep::Command),
    /// Find out whether small axial motions of a flat belt grow, and from which load on
    Stability(stability::Command),
    /// Follow a drive in time: start-up, load steps, slip and its end
    Simulate(simulate::Simulate),
    /// Find the vibrations of a running drive with a flat belt, also over its speed
    Modes(modes::Command),
    /// Find the numbers and choices that make a drive best within its limits
    Design(design::Design),
    /// Find numbers of the drive file, such as friction and stiffness, from measured rows
    Calibrate(calibrate::Calibrate),
    /// Recompute the published results that the program stands on
    Verify(verify::Verify),
    /// List belt sections, or show one with the sources of its numbers
    Sections(sections::Sections),
    /// List the drive files that come with the program, or print one
    Examples(examples::Examples),
    /// Print what a shell needs to complete commands and options
    Completions(completions::Completions),
    /// Print the manual page of the program or of a command
    Man(man::Manual),
}

/// Runs the command that the command line asks for.
pub(crate) fn run() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Solve(command) => command.run(),
        Command::Check(command) => command.run(),
        Command::Report(command) => command.run(),
        Command::Tension(command) => command.run(),
        Command::Rating(command) => command.run(),
        Command::Trace(command) => command.run(),
        Command::Limits(command) => command.run(),
        Command::Map(command) => command.run(),
        Command::Sweep(command) => command.run(),
        Command::Stability(command) => command.run(),
        Command::Simulate(command) => command.run(),
        Command::Modes(command) => command.run(),
        Command::Design(command) => command.run(),
        Command::Calibrate(command) => command.run(),
        Command::Verify(command) => command.run(),
        Command::Sections(command) => command.run(),
        Command::Examples(command) => command.run(),
        Command::Completions(command) => command.run(),
        Command::Man(command) => command.run(),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Unsolved(message)) => {
            output::note(&message);
            ExitCode::from(1)
        }
        Err(Failure::Usage(message)) => {
            output::note(&message);
            ExitCode::from(2)
        }
        Err(Failure::Unmet(message)) => {
            output::note(&message);
            ExitCode::from(3)
        }
        Err(Failure::Interrupted(message)) => {
            output::note(&message);
            ExitCode::from(interrupt::STATUS)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_command_line_is_consistent() {
        Cli::command().debug_assert();
    }
}
