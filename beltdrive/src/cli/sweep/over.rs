//! What varies in a sweep, as the command line states it.

use crate::cli::failure::Failure;
use beltdrive::MapAxis;
use beltdrive::belt_loop::Varied;
use beltdrive::input::{Argument, DriveFile};

/// The name of the factor on all torques and powers.
const LOAD_FACTOR: &str = "load_factor";

/// The least and the most values of a range.
const COUNTS: [usize; 2] = [2, 1_000_000_000];

/// What the option is called in messages.
const OPTION: &str = "--over";

/// A number that varies.
pub(super) struct Over {
    pub(super) varied: Varied,
    pub(super) values: Values,
    /// As it was stated.
    text: String,
}

/// The values that a number takes, SI.
pub(super) enum Values {
    /// At equal steps from one end of a range to the other.
    Steps([f64; 2], usize),
    /// Anywhere in a range.
    Range([f64; 2]),
    /// Those of a list.
    List(Vec<f64>),
}

impl Over {
    /// Those that options state; no number varies twice.
    pub(super) fn all(file: &DriveFile, options: &[String]) -> Result<Vec<Self>, Failure> {
        let mut all: Vec<Self> = Vec::new();
        for text in options {
            let over = Self::new(file, text)?;
            if all.iter().any(|other| other.varied == over.varied) {
                let name = over.varied.name();
                return Err(over.shape(&format!("`{name}` varies twice")));
            }
            all.push(over);
        }
        Ok(all)
    }

    fn new(file: &DriveFile, text: &str) -> Result<Self, Failure> {
        let shape = |problem: &str| shape(text, problem);
        let (path, values) = text
            .split_once('=')
            .ok_or_else(|| shape("there is no `=`"))?;
        let path = path.trim();
        let varied = match path {
            LOAD_FACTOR => Varied::LoadFactor,
            value => {
                let option = OPTION;
                Varied::Key(
                    file.key(Argument { option, value })
                        .map_err(Failure::usage)?,
                )
            }
        };
        let number = |value: &str| match &varied {
            Varied::LoadFactor => {
                let factor = value.parse::<f64>().ok();
                let factor = factor.filter(|factor| *factor >= 0.0 && factor.is_finite());
                factor.ok_or_else(|| shape("a load factor is a number that is not negative"))
            }
            Varied::Key(key) => {
                let option = OPTION;
                Argument { option, value }
                    .number(key)
                    .map_err(Failure::usage)
            }
        };
        let range = |from: &str, to: &str| {
            let range = [number(from)?, number(to)?];
            match range[0].total_cmp(&range[1]) {
                std::cmp::Ordering::Less => Ok(range),
                std::cmp::Ordering::Equal => Err(shape("A and B are the same value")),
                std::cmp::Ordering::Greater => Err(shape("A is above B")),
            }
        };
        let parts: Vec<_> = values.split(':').map(str::trim).collect();
        let values = match parts[..] {
            [list] => {
                let values = list.split(',').map(|value| number(value.trim()));
                Values::List(values.collect::<Result<_, _>>()?)
            }
            [from, to] => Values::Range(range(from, to)?),
            [from, to, count] => {
                let count = count.parse().ok();
                let count = count.filter(|count| (COUNTS[0]..=COUNTS[1]).contains(count));
                let [least, most] = COUNTS;
                let problem = format!("N is not a whole number from {least} to {most}");
                Values::Steps(range(from, to)?, count.ok_or_else(|| shape(&problem))?)
            }
            _ => return Err(shape("there are more than three parts behind `=`")),
        };
        Ok(Self {
            varied,
            values,
            text: text.to_owned(),
        })
    }

    /// Its values one by one.
    pub(super) fn listed(&self) -> Result<Vec<f64>, Failure> {
        match &self.values {
            Values::Steps(range, count) => {
                Ok(MapAxis::over(self.varied.clone(), *range, *count).values)
            }
            Values::List(values) => Ok(values.clone()),
            Values::Range(_) => Err(self.shape("how many values there are is not said")),
        }
    }

    /// Its range, to be sampled.
    pub(super) fn range(&self) -> Result<[f64; 2], Failure> {
        match self.values {
            Values::Range(range) => Ok(range),
            Values::Steps(..) => Err(self.problem("--sample says how many rows there are")),
            Values::List(_) => Err(self.problem("a sample is one of a range")),
        }
    }

    fn shape(&self, problem: &str) -> Failure {
        shape(&self.text, problem)
    }

    fn problem(&self, problem: &str) -> Failure {
        let text = &self.text;
        Failure::Usage(format!(
            "error: {OPTION} {text}: {problem}; expected KEY=A:B"
        ))
    }
}

fn shape(text: &str, problem: &str) -> Failure {
    Failure::Usage(format!(
        "error: {OPTION} {text}: {problem}; expected KEY=A:B:N or KEY=V1,V2,…, such as \
         'load.power=1 kW:5 kW:20'"
    ))
}
