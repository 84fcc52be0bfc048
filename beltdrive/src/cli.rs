//! The commands: what they read, what they write, and their exit status.

use beltdrive::{SolveOptions, SteadyState, examples, input, plot, report};
use clap::{Args, Parser, Subcommand};
use std::{
    error::Error,
    fs,
    io::{self, ErrorKind, Read, Write},
    path::{Path, PathBuf},
    process::ExitCode,
};

const HELP: &str = "\
Example:
  beltdrive examples kim2009 > kim2009.toml
  beltdrive solve kim2009.toml --set 'load.tight_tractive_tension=1200 N'

Exit status:
  0  success
  1  the drive has no steady state, or none was found
  2  an input, an output or the command line is at fault";

const SOLVE_HELP: &str = "\
Example:
  beltdrive solve kim2009.toml --set friction.law=epp --json kim2009.json --plot figures";

const EXAMPLES_HELP: &str = "\
Example:
  beltdrive examples kim2009 > kim2009.toml";

#[derive(Parser)]
#[command(version, about, after_help = HELP)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Find the steady state of a drive and print it as a table
    #[command(after_help = SOLVE_HELP)]
    Solve(SolveArgs),
    /// List the drive files that come with the program, or print one
    #[command(after_help = EXAMPLES_HELP)]
    Examples {
        /// The drive file to print
        name: Option<String>,
    },
}

#[derive(Args)]
struct SolveArgs {
    /// Drive file in TOML; - for standard input
    file: PathBuf,
    /// Write the steady state as JSON; - for standard output, in place of the table
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the profiles along the pulleys as CSV; - for standard output, in place of the table
    #[arg(long, value_name = "FILE")]
    csv: Option<PathBuf>,
    /// Draw figures into a directory
    #[arg(long, value_name = "DIR")]
    plot: Option<PathBuf>,
    /// Override one entry of the drive file by its dotted path; repeatable
    #[arg(long = "set", value_name = "KEY=VALUE")]
    overrides: Vec<String>,
    /// Print neither the table nor the names of written files
    #[arg(long)]
    quiet: bool,
    /// Relative tolerance of the steady state, 1e-12 to 1e-2
    #[arg(long, value_name = "X", default_value = "1e-6", value_parser = tolerance)]
    tolerance: f64,
}

/// Why a command fails: a message for standard error, by exit status.
enum Failure {
    /// The drive has no steady state or none was found.
    Unsolved(String),
    /// An input, an output or the command line is at fault.
    Usage(String),
}

impl Failure {
    fn usage(message: impl ToString) -> Self {
        Self::Usage(message.to_string())
    }

    /// The failure to do something with a file or stream.
    fn io(action: &str, error: &dyn Error) -> Self {
        Self::Usage(format!("error: cannot {action}: {error}"))
    }
}

/// Runs the command that the command line asks for.
pub(crate) fn run() -> ExitCode {
    let outcome = match Cli::parse().command {
        Command::Solve(args) => solve(&args),
        Command::Examples { name } => show_examples(name.as_deref()),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure::Unsolved(message)) => {
            note(&message);
            ExitCode::from(1)
        }
        Err(Failure::Usage(message)) => {
            note(&message);
            ExitCode::from(2)
        }
    }
}

fn solve(args: &SolveArgs) -> Result<(), Failure> {
    let is_stdout = |output: &Option<PathBuf>| output.as_deref().is_some_and(is_stream);
    if is_stdout(&args.json) && is_stdout(&args.csv) {
        let message = "error: only one of --json and --csv can go to standard output";
        return Err(Failure::usage(message));
    }
    let (name, text) = read(&args.file)?;
    let drive = input::parse(&name, &text, &args.overrides).map_err(Failure::usage)?;
    let options = SolveOptions {
        tolerance: args.tolerance,
    };
    let state = beltdrive::solve(&drive, &options)
        .map_err(|error| Failure::Unsolved(format!("error: {error}")))?;

    if !args.quiet && !is_stdout(&args.json) && !is_stdout(&args.csv) {
        print(&report::table(&state))?;
    }
    let written = write_outputs(args, &state)?;
    if !args.quiet {
        for path in written {
            note(&format!("wrote {}", path.display()));
        }
    }
    Ok(())
}

/// A report as text.
type Render = fn(&SteadyState) -> String;

/// Writes the outputs asked for and lists the files among them.
fn write_outputs(args: &SolveArgs, state: &SteadyState) -> Result<Vec<PathBuf>, Failure> {
    let mut written = Vec::new();
    let reports: [(_, Render); 2] = [(&args.json, report::json), (&args.csv, report::csv)];
    for (output, render) in reports {
        match output {
            Some(path) if is_stream(path) => print(&render(state))?,
            Some(path) => {
                fs::write(path, render(state))
                    .map_err(|error| Failure::io(&format!("write {}", path.display()), &error))?;
                written.push(path.clone());
            }
            None => {}
        }
    }
    if let Some(directory) = &args.plot {
        let figures = plot::write_all(state, directory).map_err(|error| {
            Failure::io(
                &format!("draw figures into {}", directory.display()),
                &error,
            )
        })?;
        written.extend(figures);
    }
    Ok(written)
}

fn show_examples(name: Option<&str>) -> Result<(), Failure> {
    if let Some(name) = name {
        let unknown = |error| Failure::Usage(format!("error: {error}"));
        return print(examples::find(name).map_err(unknown)?.text);
    }
    let rows = examples::EXAMPLES.map(|example| {
        let (title, summary) = (example.title(), example.summary());
        format!("{:16} {title}\n{:16} {summary}\n", example.name, "")
    });
    print(&rows.concat())
}

/// The name and the text of a drive file or of standard input.
fn read(file: &Path) -> Result<(String, String), Failure> {
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

/// Whether a path stands for a standard stream.
fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Writes to standard output. Whoever closes it has read enough: that is no failure.
fn print(text: &str) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    match output
        .write_all(text.as_bytes())
        .and_then(|()| output.flush())
    {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::io("write to standard output", &error))
        }
        _ => Ok(()),
    }
}

/// Writes a line to standard error, which is the last place to complain: a failure is ignored.
fn note(message: &str) {
    let _ = writeln!(io::stderr(), "{message}");
}

fn tolerance(text: &str) -> Result<f64, String> {
    let value: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    match (1e-12..=1e-2).contains(&value) {
        true => Ok(value),
        false => Err("must be within 1e-12 and 1e-2".to_owned()),
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
