//! The drive files that come with the program.

use crate::input::{DriveFile, spelling};

/// A shipped drive file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Example {
    /// The name it is asked for by; the file is `NAME.toml`.
    pub name: &'static str,
    /// The whole file.
    pub text: &'static str,
}

/// Every shipped drive file.
pub const EXAMPLES: [Example; 21] = [
    Example {
        name: "kim2009",
        text: include_str!("../examples/kim2009.toml"),
    },
    Example {
        name: "kim2009-epp",
        text: include_str!("../examples/kim2009-epp.toml"),
    },
    Example {
        name: "kim2009-bristle",
        text: include_str!("../examples/kim2009-bristle.toml"),
    },
    Example {
        name: "cvt-variator",
        text: include_str!("../examples/cvt-variator.toml"),
    },
    Example {
        name: "kim2009-flat",
        text: include_str!("../examples/kim2009-flat.toml"),
    },
    Example {
        name: "flat-unequal",
        text: include_str!("../examples/flat-unequal.toml"),
    },
    Example {
        name: "serpentine",
        text: include_str!("../examples/serpentine.toml"),
    },
    Example {
        name: "serpentine-cases",
        text: include_str!("../examples/serpentine-cases.toml"),
    },
    Example {
        name: "crossed",
        text: include_str!("../examples/crossed.toml"),
    },
    Example {
        name: "poly-v",
        text: include_str!("../examples/poly-v.toml"),
    },
    Example {
        name: "back-side-idler",
        text: include_str!("../examples/back-side-idler.toml"),
    },
    Example {
        name: "v-power",
        text: include_str!("../examples/v-power.toml"),
    },
    Example {
        name: "spb-fan",
        text: include_str!("../examples/spb-fan.toml"),
    },
    Example {
        name: "fan-design",
        text: include_str!("../examples/fan-design.toml"),
    },
    Example {
        name: "flat-bench",
        text: include_str!("../examples/flat-bench.toml"),
    },
    Example {
        name: "conveyor",
        text: include_str!("../examples/conveyor.toml"),
    },
    Example {
        name: "slip-pulse",
        text: include_str!("../examples/slip-pulse.toml"),
    },
    Example {
        name: "v-load-step",
        text: include_str!("../examples/v-load-step.toml"),
    },
    Example {
        name: "soft-start",
        text: include_str!("../examples/soft-start.toml"),
    },
    Example {
        name: "pump-resonance",
        text: include_str!("../examples/pump-resonance.toml"),
    },
    Example {
        name: "parametric-resonance",
        text: include_str!("../examples/parametric-resonance.toml"),
    },
];

/// The measured rows that belong to the example `flat-bench`, printed as `flat-bench.csv`.
pub const FLAT_BENCH: &str = include_str!("../examples/flat-bench.csv");

impl Example {
    /// The title the file states; its name if it states none.
    pub fn title(&self) -> String {
        let file = DriveFile::read(self.name, self.text, &[]);
        let drive = file.and_then(|file| file.drive());
        let title = drive.ok().and_then(|drive| drive.title);
        title.unwrap_or_else(|| self.name.to_owned())
    }

    /// What the file shows, in one line: its first comment.
    pub fn summary(&self) -> &'static str {
        let first = self.text.lines().next().unwrap_or_default();
        first.trim_start_matches(['#', ' '])
    }
}

/// A name that no shipped drive file has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no example `{name}`\nexpected: one of {}{}", names(), spelling::hint(*.nearest))]
pub struct UnknownExample {
    name: String,
    nearest: Option<&'static str>,
}

/// The shipped drive file called `name`.
///
/// # Errors
///
/// There is none of this name; the error shows the nearest.
pub fn find(name: &str) -> Result<Example, UnknownExample> {
    let found = EXAMPLES.into_iter().find(|example| example.name == name);
    found.ok_or_else(|| UnknownExample {
        name: name.to_owned(),
        nearest: spelling::nearest(name, EXAMPLES.map(|example| (example.name, example.name))),
    })
}

fn names() -> String {
    EXAMPLES
        .map(|example| format!("`{}`", example.name))
        .join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input;
    use crate::{BeltKind, NormalForce};

    #[test]
    fn every_example_is_a_drive_with_title_and_summary() {
        for example in EXAMPLES {
            let file = DriveFile::read(example.name, example.text, &[]);
            let drive = file.and_then(|file| file.drive());
            let drive = drive.unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(Some(example.title()), drive.title);
            assert!(example.text.starts_with("# ") && example.summary().ends_with('.'));
        }
    }

    #[test]
    fn every_law_and_model_of_the_belt_can_be_selected() {
        let name = |example: &str, entry: &str, word: &str| {
            let text = find(example).unwrap().text;
            let drive = input::parse(example, text, &[format!("{entry}={word}")]).unwrap();
            match drive.belt.kind {
                BeltKind::Flat { normal_force } if entry == "model.normal_force" => {
                    normal_force.name()
                }
                _ => drive.law.name(),
            }
        };
        for law in ["coulomb", "epp", "bristle"] {
            assert_eq!(name("kim2009", "friction.law", law), law);
            assert_eq!(name("cvt-variator", "friction.law", law), law);
        }
        for example in ["kim2009-flat", "flat-unequal"] {
            for law in ["coulomb", "epp", "creep-rate"] {
                assert_eq!(name(example, "friction.law", law), law);
            }
            for model in NormalForce::ALL.map(NormalForce::name) {
                assert_eq!(name(example, "model.normal_force", model), model);
            }
        }
    }

    #[test]
    fn the_drive_of_a_v_belt_can_be_given_a_flat_belt() {
        for example in EXAMPLES {
            let stated = input::parse(example.name, example.text, &[]).unwrap();
            if stated.two_pulleys().is_none() {
                continue;
            }
            let overrides = ["belt.type=flat", "friction.law=epp"].map(str::to_owned);
            let drive = input::parse(example.name, example.text, &overrides);
            let kind = drive.unwrap_or_else(|error| panic!("{error}")).belt.kind;
            let normal_force = NormalForce::default();
            assert_eq!(kind, BeltKind::Flat { normal_force });
        }
    }

    #[test]
    fn unknown_names_show_the_nearest() {
        let error = find("kim2008").unwrap_err().to_string();
        assert!(error.ends_with("help: did you mean `kim2009`?"), "{error}");
    }
}
