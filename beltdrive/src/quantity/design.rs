//! What there is to tell of a design.

use super::precision::known;
use super::{Answer, Group, Layout, Measure, Quantity, Subject, UnitSystem, Value};
use super::{belt_loop, warning};
use crate::input::{Choice, ChoiceValue, DesignObjective, Diagnostic};
use crate::{Combination, DecidingLimit, DesignLimit, Designed, LimitPlace, Unfit};
use std::borrow::Cow;

/// A residual of the first-order conditions above this is said: one of a smooth optimum is below 1e-4 with flat belts
/// and below 2e-2 with V-belts, whose slopes are known to a hundredth.
const UNSETTLED: f64 = 0.05;

/// A design.
///
/// # Errors
/// The drive file has no place for a value that an override gives.
pub fn answer(found: &Designed) -> Result<Answer, Diagnostic> {
    let service = &found.checked.service;
    let mut heading = belt_loop::heading(&service.cases[0].drive);
    heading.push(format!("to be small: {}", objective(found).0));
    heading.push(String::new());
    heading.extend(verdict(found));
    let mut groups = vec![
        Group::single("", best(found)),
        Group::new("", Layout::Columns, values(found)),
    ];
    groups.push(Group::single("values", found_values(found)));
    if !found.limits.is_empty() {
        let key = if found.is_feasible {
            "active_limits"
        } else {
            "conflicts"
        };
        let rows = found.limits.iter().map(|limit| deciding(found, limit));
        groups.push(Group::new(key, Layout::Rows, rows.collect()));
    }
    if found.combinations.len() > 1 {
        let rows = found
            .combinations
            .iter()
            .map(|tried| combination(found, tried));
        groups.push(Group::new("combinations", Layout::Rows, rows.collect()));
    }
    groups.push(Group::single("", accuracy(found)));
    let text = Value::Word(Some(found.file.rewritten()?));
    groups.push(Group::single(
        "",
        vec![Quantity::data("designed_file", Measure::Number, text)],
    ));
    Ok(Answer {
        heading,
        remarks: remarks(found),
        groups,
        notes: Vec::new(),
    })
}

/// What is to be small: its name, and what it measures.
fn objective(found: &Designed) -> (Cow<'_, str>, Measure) {
    match &found.question.objective {
        DesignObjective::HubLoad => ("largest hub load".into(), Measure::Force),
        DesignObjective::Loss => ("power lost".into(), Measure::Loss),
        DesignObjective::SpeedLoss => ("largest speed loss".into(), Measure::Share),
        DesignObjective::BeltMass => ("mass of the belt".into(), Measure::Mass),
        DesignObjective::Width => ("width of the belt".into(), Measure::Length),
        DesignObjective::Key(key) => (key.path().into(), key.measure()),
    }
}

/// Whether there is such a drive, in lines.
fn verdict(found: &Designed) -> Vec<String> {
    if found.is_feasible {
        return match &found.limits[..] {
            [] => vec!["no limit holds the best drive back".to_owned()],
            [_] => vec!["one limit holds the best drive back".to_owned()],
            limits => vec![format!("{} limits hold the best drive back", limits.len())],
        };
    }
    let names = found.limits.iter().map(|limit| {
        let (what, _) = words(found, limit);
        match at(found, &limit.places) {
            places if places.is_empty() => what,
            places => format!("{what} ({places})"),
        }
    });
    let names: Vec<_> = names.collect();
    let first = "NO DRIVE MEETS ALL LIMITS: below is the one that misses them least";
    let in_conflict = match names.len() {
        0 => return vec![first.to_owned()],
        1 => format!("cannot be met: {}", names[0]),
        _ => format!("in conflict: {}", names.join("; ")),
    };
    vec![first.to_owned(), in_conflict]
}

/// What was made small.
fn best(found: &Designed) -> Vec<Quantity> {
    let (name, measure) = objective(found);
    let error = found.accuracy * found.objective.unwrap_or(0.0).abs();
    vec![
        Quantity::word("objective", "", name.clone().into_owned()),
        Quantity::number(
            "objective_value",
            name.into_owned(),
            measure,
            found.objective,
            error,
        ),
        Quantity::json("feasible", found.is_feasible),
    ]
}

/// A value of a choice.
fn chosen(choice: &Choice, index: usize) -> Quantity {
    match &choice.values[index] {
        ChoiceValue::Word(word) => Quantity::word("", "", word.clone()),
        ChoiceValue::Number(measure, value) => Quantity::number("", "", *measure, *value, 0.0),
    }
}

/// A value of a choice as a text.
fn chosen_text(choice: &Choice, index: usize) -> String {
    let quantity = chosen(choice, index);
    match &quantity.value {
        Value::Word(Some(word)) => word.clone(),
        _ => quantity.shown(6.0).unwrap_or_default(),
    }
}

/// The values found beside their bounds, for people.
fn values(found: &Designed) -> Vec<Subject> {
    let question = &found.question;
    let named = |quantity: Quantity, path: &str| Quantity {
        label: path.to_owned().into(),
        ..quantity
    };
    let column = |head: &str, of: &dyn Fn(usize) -> (f64, f64), has_choices: bool| {
        let free = question.free.iter().enumerate().map(|(index, free)| {
            let (value, error) = of(index);
            let path = free.key.path().to_owned();
            Quantity::number("", path, free.key.measure(), value, error)
        });
        let choices = question.choices.iter().zip(&found.chosen);
        let choices = choices.map(|(choice, &index)| {
            let quantity = match has_choices {
                true => chosen(choice, index),
                false => match chosen(choice, index) {
                    Quantity {
                        value: Value::Number(_),
                        measure,
                        ..
                    } => Quantity::number("", "", measure, None, 0.0),
                    _ => Quantity::word("", "", None),
                },
            };
            named(quantity, &choice.path)
        });
        Subject::new(head, choices.chain(free).collect())
    };
    let value = |index: usize| {
        let value = found.values[index];
        (value, found.accuracy * value.abs())
    };
    let bound = |end: usize| move |index: usize| (question.free[index].bounds[end], 0.0);
    let mut columns = vec![column("value", &value, true)];
    if !question.free.is_empty() {
        columns.push(column("at least", &bound(0), false));
        columns.push(column("at most", &bound(1), false));
    }
    columns
}

/// The values found, for programs.
fn found_values(found: &Designed) -> Vec<Quantity> {
    let question = &found.question;
    let key = |path: &str| -> Cow<'static, str> { path.replace(['.', ' ', '-', '/'], "_").into() };
    let free = question
        .free
        .iter()
        .zip(&found.values)
        .map(|(free, value)| {
            let error = found.accuracy * value.abs();
            Quantity::number(key(free.key.path()), "", free.key.measure(), *value, error)
        });
    let choices = question.choices.iter().zip(&found.chosen);
    let choices = choices.map(|(choice, &index)| Quantity {
        key: key(&choice.path),
        ..chosen(choice, index)
    });
    choices.chain(free).collect()
}

/// A limit in words, and what it measures.
fn words(found: &Designed, limit: &DecidingLimit) -> (String, Measure) {
    let path = |index: usize| found.question.free[index].key.path();
    let (name, measure) = match limit.limit {
        DesignLimit::LowerBound(index) | DesignLimit::UpperBound(index) => (
            path(index).to_owned(),
            found.question.free[index].key.measure(),
        ),
        DesignLimit::SlipMargin => ("slip margin".to_owned(), Measure::Number),
        DesignLimit::SpeedLoss => ("speed loss".to_owned(), Measure::Share),
        DesignLimit::HubLoad => ("hub load".to_owned(), Measure::Force),
        DesignLimit::Tension => ("belt tension".to_owned(), Measure::Force),
        DesignLimit::SmallestDiameter => {
            let section = found
                .file
                .filled_in()
                .map_or("", |filled| filled.section.name);
            (format!("diameter of section {section}"), Measure::Length)
        }
    };
    let word = if limit.limit.is_smallest() {
        "at least"
    } else {
        "at most"
    };
    let allowed = Quantity::number("", "", measure, limit.allowed, 0.0);
    (
        format!("{name} {word} {}", allowed.shown(6.0).unwrap_or_default()),
        measure,
    )
}

/// The key of the drive file that states a limit; of an end of a range that of the number, and of a slip margin that
/// is not required that of the one that could be.
fn key(found: &Designed, limit: DesignLimit) -> String {
    match limit {
        DesignLimit::LowerBound(index) | DesignLimit::UpperBound(index) => {
            return format!("design.free.{}", found.question.free[index].key.path());
        }
        DesignLimit::SlipMargin => "requirements.smallest_slip_margin",
        DesignLimit::SpeedLoss => "requirements.largest_speed_loss",
        DesignLimit::HubLoad => "requirements.largest_hub_load",
        DesignLimit::Tension => "requirements.largest_tension",
        DesignLimit::SmallestDiameter => "belt.section",
    }
    .to_owned()
}

/// Where a limit is met, in words.
fn at(found: &Designed, places: &[LimitPlace]) -> String {
    let cases = &found.checked.service.cases;
    let mut names: Vec<String> = Vec::new();
    for place in places {
        let pulley = place
            .pulley
            .map(|pulley| format!("`{}`", cases[0].drive.pulleys[pulley].name));
        let case = place
            .case
            .filter(|_| cases.len() > 1)
            .map(|case| &cases[case].name);
        let name = match (pulley, case) {
            (Some(pulley), Some(case)) => format!("{pulley} in {case}"),
            (Some(pulley), None) => pulley,
            (None, Some(case)) => case.clone(),
            (None, None) => continue,
        };
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names.join(", ")
}

/// A limit that decides, with its price.
fn deciding(found: &Designed, limit: &DecidingLimit) -> Subject {
    let (name, measure) = words(found, limit);
    let of_price = match found.is_feasible {
        true => objective(found).1,
        false => Measure::Share,
    };
    let [above, below] = [of_price, measure].map(|measure| measure.shown(UnitSystem::Engineering));
    let shown = known(
        limit.price * above.factor / below.factor,
        (limit.price * above.factor / below.factor).abs() * found.price_error,
        6.0,
    );
    let per = if below.symbol.is_empty() {
        "1"
    } else {
        below.symbol
    };
    let price = format!("{shown} {} per {per}", above.symbol)
        .replace("  ", " ")
        .replace('-', "−");
    let reached = Quantity::number(
        "",
        "",
        measure,
        limit.found,
        found.accuracy * limit.found.abs(),
    );
    let number = |key, value| Quantity::data(key, Measure::Number, Value::Number(Some(value)));
    let mut quantities = vec![
        Quantity::word("limit", "limit", name),
        Quantity::word("key", "", key(found, limit.limit)),
        Quantity::word("at", "at", at(found, &limit.places)),
    ];
    if !found.is_feasible {
        quantities.push(Quantity::word("", "found", reached.shown(6.0)));
    }
    let label = if found.is_feasible { "price" } else { "miss" };
    quantities.extend([
        Quantity::word("", label, price),
        number("allowed", limit.allowed),
        number("found", limit.found),
        number("price", limit.price),
    ]);
    Subject::new("", quantities)
}

/// A combination of choices.
fn combination(found: &Designed, tried: &Combination) -> Subject {
    let (name, measure) = objective(found);
    let mut quantities: Vec<_> = { found.question.choices.iter().zip(&tried.chosen) }
        .map(|(choice, &index)| Quantity {
            key: choice.path.replace(['.', ' ', '-', '/'], "_").into(),
            ..Quantity::word("", choice.path.clone(), chosen_text(choice, index))
        })
        .collect();
    let (value, missed, why) = match &tried.outcome {
        Ok(value) => (Some(*value), None, None),
        Err(Unfit::Misses(share)) => (None, Some(*share), None),
        Err(Unfit::NoState(refusal)) => (None, None, Some(refusal.kind().to_owned())),
    };
    let error = found.accuracy * value.unwrap_or(0.0).abs();
    quantities.extend([
        Quantity::number("objective", name.into_owned(), measure, value, error),
        Quantity {
            digits: 3,
            ..Quantity::number("missed", "misses limits by", Measure::Share, missed, 0.0)
        },
        Quantity::word("why", "why", why),
    ]);
    Subject::new("", quantities)
}

/// How well the optimum is known, and what it took.
fn accuracy(found: &Designed) -> Vec<Quantity> {
    vec![
        Quantity::error(
            "first_order_residual",
            "first-order conditions hold to",
            Measure::Number,
            found.residual,
        ),
        Quantity::count("drives", "drives judged", found.drives),
    ]
}

/// What else has to be said.
fn remarks(found: &Designed) -> Vec<String> {
    let service = &found.checked.service;
    let cases = service.cases.iter().zip(&found.checked.cases);
    let mut remarks: Vec<_> = cases
        .flat_map(|(stated, judged)| {
            let state = judged.outcome.as_deref();
            let warnings = state.map(|found| found.state.warnings(&stated.drive));
            let messages = warning::messages(&warnings.unwrap_or_default()).into_iter();
            messages.map(move |message| format!("{}: {message}", stated.name))
        })
        .collect();
    remarks.extend(found.idle.iter().map(|&index| {
        let path = found.question.free[index].key.path();
        format!("`{path}` changes neither what is to be small nor any limit here: its value means nothing")
    }));
    if found.residual > UNSETTLED {
        remarks.push(
            "the first-order conditions of an optimum do not hold: the search ended at a kink, where one pulley or groove \
             takes the place of another; a better drive may be near"
                .to_owned(),
        );
    }
    remarks
}
