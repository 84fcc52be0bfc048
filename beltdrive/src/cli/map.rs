//! `beltdrive map`: the steady states of a drive over two of its numbers.

use super::{common::Common, failure::Failure, origin::Origin, output::write_text};
use beltdrive::belt_loop::Varied;
use beltdrive::input::{Argument, DriveFile};
use beltdrive::{MapAxis, map, plot, quantity, report};
use clap::Args;
use std::path::{Path, PathBuf};

const HELP: &str = "\
Examples:
  beltdrive map v-power.toml
  beltdrive map v-power.toml --x 'pulleys.driver.speed=725 rpm:1450 rpm:20' \\
    --y 'load.power=1 kW:5 kW:20' --csv map.csv --table map.txt --plot figures

Without --x the speed of the driver varies from a quarter to five quarters of that in the file; without
--y the load: the torque, the power or the tight tension that the file gives, or else a factor on all
torques (load_factor), from a tenth to one and a half of that in the file. --csv writes one row per
point; a point without a steady state keeps its row, with the reason.";

/// The name of the factor on all torques and powers.
const LOAD_FACTOR: &str = "load_factor";

/// The least and the most values of an axis: with more than the latter a map would have a million points.
const COUNTS: [usize; 2] = [2, 1000];

#[derive(Args)]
#[command(after_help = HELP)]
pub(super) struct Map {
    #[command(flatten)]
    common: Common,
    /// The number along the horizontal axis by its dotted path, its ends with their units, and how many
    /// values it takes
    #[arg(long, value_name = "KEY=A:B:N")]
    x: Option<String>,
    /// The number along the vertical axis, as --x
    #[arg(long, value_name = "KEY=A:B:N")]
    y: Option<String>,
    /// Write lookup tables, one for each number, as a text file for the tables of Modelica
    #[arg(long, value_name = "FILE")]
    table: Option<PathBuf>,
}

impl Map {
    pub(super) fn run(&self) -> Result<(), Failure> {
        let table = ("--table", self.table.as_deref());
        let (file, origin) = self.common.file_beside(&[table])?;
        self.of(&file, &origin).map_err(|failure| failure.of(&file))
    }

    fn of(&self, file: &DriveFile, origin: &Origin) -> Result<(), Failure> {
        let axis = |option, given: &Option<String>, usual: fn(&DriveFile) -> Option<MapAxis>| {
            match given {
                Some(given) => axis(file, option, given),
                None => {
                    // A drive file that is at fault says so itself.
                    file.drive().map_err(Failure::usage)?;
                    usual(file).ok_or_else(|| {
                        Failure::Usage(format!(
                            "error: the drive file gives no number for {option}; name one"
                        ))
                    })
                }
            }
        };
        let x = axis("--x", &self.x, MapAxis::speed)?;
        let y = axis("--y", &self.y, MapAxis::load)?;
        if x.varied == y.varied {
            return Err(Failure::usage("error: --x and --y are the same number"));
        }
        let options = self.common.options();
        let map = self
            .common
            .with_progress(|progress| map(file, x, y, &options, progress))
            .map_err(Failure::usage)?;
        let table = match &self.table {
            Some(path) => {
                let text = report::lookup_tables(&map).map_err(|error| {
                    Failure::Usage(format!("error: --table {}: {error}", path.display()))
                })?;
                Some((path, text))
            }
            None => None,
        };
        let answer = &quantity::map::answer(&map);
        let draw =
            |directory: &Path, metadata: &str| plot::write_map(&map, directory, Some(metadata));
        self.common.output.write(answer, &draw, origin)?;
        if let Some((path, text)) = table {
            let written = write_text(path, &text)?;
            self.common.output.name(written.as_slice());
        }
        match map.points.iter().find_map(|point| point.as_ref().err()) {
            Some(refusal) if map.points.iter().all(Result::is_err) => {
                Err(Failure::from(refusal.clone()))
            }
            _ => Ok(()),
        }
    }
}

/// The axis that an option states.
fn axis(file: &DriveFile, option: &str, text: &str) -> Result<MapAxis, Failure> {
    let shape = |problem: &str| {
        Failure::Usage(format!(
            "error: {option} {text}: {problem}; expected KEY=A:B:N, such as 'load.power=1 kW:5 kW:20'"
        ))
    };
    let (path, range) = text
        .split_once('=')
        .ok_or_else(|| shape("there is no `=`"))?;
    let parts: Vec<_> = range.split(':').map(str::trim).collect();
    let [from, to, count] = parts[..] else {
        return Err(shape("there are not three parts behind `=`"));
    };
    let count: usize = count
        .parse()
        .ok()
        .filter(|count| (COUNTS[0]..=COUNTS[1]).contains(count))
        .ok_or_else(|| {
            shape(&format!(
                "N is not a whole number from {} to {}",
                COUNTS[0], COUNTS[1]
            ))
        })?;
    let (varied, range) = match path.trim() {
        LOAD_FACTOR => {
            let factor = |text: &str| {
                let factor = text.parse::<f64>().ok().filter(|factor| *factor >= 0.0);
                factor.ok_or_else(|| shape("a load factor is a number that is not negative"))
            };
            (Varied::LoadFactor, [factor(from)?, factor(to)?])
        }
        value => {
            let key = file
                .key(Argument { option, value })
                .map_err(Failure::usage)?;
            let number = |value| {
                Argument { option, value }
                    .number(&key)
                    .map_err(Failure::usage)
            };
            let range = [number(from)?, number(to)?];
            (Varied::Key(key), range)
        }
    };
    if range[0] == range[1] {
        return Err(shape("A and B are the same value"));
    }
    Ok(MapAxis::over(varied, range, count))
}
