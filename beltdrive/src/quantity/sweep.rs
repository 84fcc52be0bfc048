//! What there is to tell of many drives: the columns of their rows, the values of each, and a summary.

mod told;

use super::map::{SCALARS, place, without_state};
use super::{Answer, Group, Layout, Measure, Quantity, Subject, Value, belt_loop};
use crate::belt_loop::{LoopLimits, Refusal};
use crate::quantity::events::range_end_kind;
use crate::{
    CheckedService, Limits, MapState, Sweep, SweepQuestion, SweepRow, SweepSummary, Swept,
};
use told::{Told, number, of_drive, of_loop};

/// What is told of every drive of a sweep, in columns: its number among the rows from 0, the numbers that vary, the
/// numbers of its answer, and why it has none.
pub struct Columns<'s> {
    sweep: &'s Sweep,
    of_drive: Vec<Told<crate::StateSummary>>,
    of_loop: Vec<Told<crate::belt_loop::LoopState>>,
    /// Those of the answer, without values.
    answer: Vec<Quantity>,
}

/// Whether a row has an answer, its drive has none, or its input is at fault.
const STATUS: [&str; 3] = ["answered", "no answer", "at fault"];

impl<'s> Columns<'s> {
    /// Those of a sweep.
    #[must_use]
    pub fn new(sweep: &'s Sweep) -> Self {
        let drive = sweep.drive();
        let mut of_drive = Vec::new();
        let mut of_loop = Vec::new();
        let answer = match sweep.question() {
            SweepQuestion::Solve if sweep.is_of_two() => {
                of_drive = self::of_drive(drive);
                of_drive.iter().map(Told::column).collect()
            }
            SweepQuestion::Solve => {
                of_loop = self::of_loop(drive);
                of_loop.iter().map(Told::column).collect()
            }
            SweepQuestion::Check => match sweep.cases() {
                None => state(""),
                Some(cases) => {
                    let verdict = Quantity::word("verdict", "", None);
                    let failing = number("failing_cases", Measure::Number);
                    let of_cases = cases.flat_map(|case| {
                        let key = |key: &str| format!("cases.{case}.{key}");
                        let words = ["verdict", "reason"].map(|word| self::word(key(word)));
                        state(&key("")).into_iter().chain(words).collect::<Vec<_>>()
                    });
                    [verdict, failing].into_iter().chain(of_cases).collect()
                }
            },
            SweepQuestion::Limits => limits(sweep),
        };
        Self {
            sweep,
            of_drive,
            of_loop,
            answer,
        }
    }

    /// Their names and measures, without values.
    #[must_use]
    pub fn quantities(&self) -> Vec<Quantity> {
        let row = Quantity::data("row", Measure::Number, Value::Count(0));
        let varied = self.sweep.varied().iter();
        let varied = varied.map(|varied| place(varied, 0.0, String::new()));
        let answer = self.answer.iter().cloned();
        let why = ["status", "reason", "description"].map(|key| Quantity::word(key, "", None));
        [row]
            .into_iter()
            .chain(varied)
            .chain(answer)
            .chain(why)
            .collect()
    }

    /// Their values, SI, of the row of a number.
    #[must_use]
    pub fn values(
        &self,
        number: usize,
        row: &SweepRow,
        answer: &Result<Swept, Refusal>,
    ) -> Vec<Value> {
        let some = |value: f64| Value::Number((!value.is_nan()).then_some(value));
        let mut values = vec![Value::Count(number)];
        values.extend(row.values.iter().copied().map(some));
        match answer {
            Ok(answer) => self.answer_values(answer, &mut values),
            Err(_) => values.extend(self.answer.iter().map(|quantity| match quantity.value {
                Value::Word(_) => Value::Word(None),
                _ => Value::Number(None),
            })),
        }
        let refusal = answer.as_ref().err();
        let status = match refusal {
            None => STATUS[0],
            Some(Refusal::Loop(_)) => STATUS[1],
            Some(Refusal::Input(_)) => STATUS[2],
        };
        values.extend([
            Value::Word(Some(status.to_owned())),
            Value::Word(refusal.map(|refusal| refusal.kind().to_owned())),
            Value::Word(refusal.map(Refusal::to_string)),
        ]);
        values
    }

    fn answer_values(&self, answer: &Swept, values: &mut Vec<Value>) {
        match answer {
            Swept::Drive(state) => {
                values.extend(self.of_drive.iter().map(|told| told.value(state)));
            }
            Swept::Loop(state) => {
                values.extend(self.of_loop.iter().map(|told| told.value(state)));
            }
            Swept::State(state) => values.extend(state_values(self.sweep, Some(state))),
            Swept::Cases(checked) => values.extend(self.case_values(checked)),
            Swept::DriveLimits(limits) => values.extend(drive_limits(limits)),
            Swept::LoopLimits(limits) => values.extend(loop_limits(limits)),
        }
    }

    fn case_values(&self, checked: &CheckedService) -> Vec<Value> {
        let verdict = |holds| Value::Word(Some(if holds { "holds" } else { "fails" }.to_owned()));
        let failing = checked.failing();
        let mut values = vec![verdict(failing == 0), Value::Number(Some(failing as f64))];
        for case in &checked.cases {
            let state = case.outcome.as_ref().ok();
            let state = state.map(|found| MapState::of(found));
            values.extend(state_values(self.sweep, state.as_ref()));
            let refusal = case.outcome.as_ref().err();
            values.extend([
                verdict(case.holds()),
                Value::Word(refusal.map(|error| error.kind().to_owned())),
            ]);
        }
        values
    }
}

fn word(key: String) -> Quantity {
    Quantity {
        key: key.into(),
        ..Quantity::word("", "", None)
    }
}

/// The numbers of a state, and which pulley slips first.
fn state(prefix: &str) -> Vec<Quantity> {
    let numbers = SCALARS.iter().map(|scalar| {
        let key = format!("{prefix}{}", scalar.key);
        number(key, scalar.measure)
    });
    let slips = word(format!("{prefix}slips_first"));
    numbers.chain([slips]).collect()
}

fn state_values(sweep: &Sweep, state: Option<&MapState>) -> Vec<Value> {
    let numbers = SCALARS.iter();
    let numbers = numbers.map(|scalar| Value::Number(state.and_then(scalar.of)));
    let slips = state.and_then(|state| state.slips_first(sweep.drive()));
    numbers.chain([Value::Word(slips)]).collect()
}

/// Both ends of the range of a load.
fn limits(sweep: &Sweep) -> Vec<Quantity> {
    let (key, measure) = match sweep.is_of_two() {
        true => {
            let key = crate::input::Key::load(sweep.drive());
            (key.stem(), key.measure())
        }
        false => ("load_factor".to_owned(), Measure::Number),
    };
    let ends = ["smallest", "largest"].map(|end| {
        [
            number(format!("{end}_{key}"), measure),
            number(format!("{end}_{key}_error"), measure),
            word(format!("{end}_reason")),
        ]
    });
    ends.concat()
}

fn drive_limits(limits: &Limits) -> Vec<Value> {
    let ends = [&limits.smallest, &limits.largest].map(|limit| {
        [
            Value::Number(Some(limit.value)),
            Value::Number(limit.value_error),
            Value::Word(Some(range_end_kind(limit.reason).to_owned())),
        ]
    });
    ends.concat()
}

fn loop_limits(limits: &LoopLimits) -> Vec<Value> {
    let ends = [&limits.smallest, &limits.largest].map(|limit| {
        [
            Value::Number(Some(limit.point.value)),
            Value::Number(Some(limit.point.value_error)),
            Value::Word(Some(limit.end.kind().to_owned())),
        ]
    });
    ends.concat()
}

/// How many rows have an answer, and why others have none.
#[must_use]
pub fn answer(sweep: &Sweep, summary: &SweepSummary) -> Answer {
    let mut heading = belt_loop::heading(sweep.drive());
    let names: Vec<_> = { sweep.varied().iter() }
        .map(|varied| varied.name())
        .collect();
    let standing = match summary.standing {
        0 => String::new(),
        standing => format!("; {standing} rows stood before"),
    };
    heading.push(format!(
        "Sweep over {}: {} of {} rows answered{standing}",
        names.join(", "),
        summary.answered(),
        summary.rows
    ));
    let reasons = summary.refusals.by_reason().map(|(kind, count, first)| {
        let word = |key, word: &str| Quantity::word(key, "", word.to_owned());
        let count = Quantity::count("rows", "", count);
        Subject::new("", vec![word("reason", kind), count, word("first", first)])
    });
    Answer {
        heading,
        groups: vec![
            Group::single(
                "",
                vec![
                    Quantity::word("answer", "", sweep.question().name().to_owned()),
                    Quantity::count("rows", "", summary.rows),
                    Quantity::count("answered", "", summary.answered()),
                    Quantity::count("standing", "", summary.standing),
                ],
            ),
            Group::new("refusals", Layout::Columns, reasons.collect()),
        ],
        notes: without_state(&summary.refusals, ["row", "rows"]),
        ..Answer::default()
    }
}
