//! What there is to tell of a drive in time.

use super::{Answer, Group, Layout, Measure, Quantity, Subject, belt_loop};
use crate::transient::{Ending, History, Sample, TransientEventKind};
use crate::{BeltKind, Drive};

/// Decimals to which a sample is computed are not known: so many digits are shown, and all of them are in files.
const SHOWN: f64 = 0.0;

/// The history of a drive: its samples, what happened, and where the energy went.
pub fn answer(drive: &Drive, history: &History) -> Answer {
    let mut heading = belt_loop::heading(drive);
    heading.push(heading_of(history));
    let samples = history.samples.iter().map(|sample| row(history, sample));
    let events = history.events.iter().map(|event| {
        let (kind, pulley) = event_words(history, event.kind);
        Subject::new(
            // With a head no row is left out.
            "event",
            vec![
                Quantity::number("time", "time", Measure::Time, event.time, SHOWN),
                Quantity::word("kind", "event", kind.to_owned()),
                Quantity::word("pulley", "pulley", pulley.map(str::to_owned)),
            ],
        )
    });
    Answer {
        heading,
        remarks: remarks(history),
        groups: vec![
            Group::single("", belt_loop::statement(drive)),
            Group::single("run", run(history)),
            Group::new("samples", Layout::Rows, samples.collect()),
            Group::new("events", Layout::Rows, events.collect()),
            Group::new("slack_spans", Layout::Rows, slack_spans(history)),
            Group::single("energy", energy(drive, history)),
        ],
        ..Answer::default()
    }
}

fn heading_of(history: &History) -> String {
    let end = history.samples.last().map_or(0.0, |sample| sample.time);
    // An event is located to a step, of some microseconds.
    let end = (1e6 * end).round() / 1e6;
    let how = match history.ending {
        Ending::Time => "in time",
        Ending::Steady => "to the steady state",
        Ending::Event => "to the event asked for",
        Ending::NotSteady => "not steady in the end",
        Ending::Interrupted => "interrupted",
        Ending::Failed => "with an error in the end",
    };
    format!("Simulation from 0 to {end} s, {how}")
}

/// What has to be said of a run.
fn remarks(history: &History) -> Vec<String> {
    let mut remarks = Vec::new();
    let events = history.events.iter();
    let slack = { events }.find(|event| event.kind == TransientEventKind::Slack);
    if let Some(slack) = slack {
        remarks.push(format!(
            "the belt is slack from {:.6} s on, where it has a thousandth of its stiffness in compression{}",
            slack.time,
            match history.samples[0].amplitudes.is_empty() {
                true => " and stays straight",
                false => "",
            }
        ));
    }
    let coarse = history
        .coarse
        .iter()
        .map(|&pulley| history.pulleys[pulley].as_str());
    let coarse: Vec<_> = coarse.collect();
    if !coarse.is_empty() {
        remarks.push(format!(
            "the belt sinks into the grooves of {} within less than a cell: tensions are off by per cents, take more \
             cells",
            coarse.join(", ")
        ));
    }
    if history.ending == Ending::NotSteady {
        remarks.push("the drive was not steady at the latest time".to_owned());
    }
    remarks
}

/// The word for an event, and its pulley.
pub(crate) fn event_words(
    history: &History,
    kind: TransientEventKind,
) -> (&'static str, Option<&str>) {
    let name = |pulley: usize| Some(history.pulleys[pulley].as_str());
    match kind {
        TransientEventKind::GrossSlip(pulley) => ("gross slip", name(pulley)),
        TransientEventKind::GrossSlipEnds(pulley) => ("gross slip ends", name(pulley)),
        TransientEventKind::Slack => ("slack belt", None),
        TransientEventKind::SlackEnds => ("slack belt ends", None),
    }
}

/// A name as part of a key.
pub(crate) fn stem(name: &str) -> String {
    name.replace(['.', ' ', '-', '/'], "_")
}

/// The names of the spans: each from a pulley to the next one.
pub(crate) fn spans(history: &History) -> Vec<[&str; 2]> {
    let count = history.pulleys.len();
    let name = |pulley: usize| history.pulleys[pulley % count].as_str();
    (0..count)
        .map(|span| [name(span), name(span + 1)])
        .collect()
}

/// A sample: speeds, tensions and torques for people, and beside them all else for programs.
fn row(history: &History, sample: &Sample) -> Subject {
    let number = |key: String, label: String, measure, value: f64| {
        Quantity::number(key, label, measure, value, SHOWN)
    };
    let mut quantities = vec![Quantity::number(
        "time",
        "time",
        Measure::Time,
        sample.time,
        SHOWN,
    )];
    let pulleys = || history.pulleys.iter().zip(&sample.pulleys);
    quantities.extend(pulleys().map(|(name, pulley)| {
        let key = format!("{}_angular_speed", stem(name));
        number(
            key,
            format!("ω {name}"),
            Measure::AngularSpeed,
            pulley.angular_speed,
        )
    }));
    quantities.extend(
        spans(history)
            .iter()
            .zip(&sample.tensions)
            .map(|([from, to], &tension)| {
                let key = format!("{}_to_{}_tension", stem(from), stem(to));
                number(key, format!("T {from} to {to}"), Measure::Force, tension)
            }),
    );
    quantities.extend(pulleys().map(|(name, pulley)| {
        let key = format!("{}_torque", stem(name));
        number(key, format!("M {name}"), Measure::Torque, pulley.torque)
    }));
    for (name, pulley) in pulleys() {
        let data = |what: &str, measure, value: f64| {
            number(
                format!("{}_{what}", stem(name)),
                String::new(),
                measure,
                value,
            )
        };
        let [x, y] = pulley.hub_load;
        quantities.extend([
            data("axle_torque", Measure::Torque, pulley.axle_torque),
            data("power", Measure::Power, pulley.power),
            data("slip_arc", Measure::Angle, pulley.slip_arc),
            data("speed_loss", Measure::Share, pulley.speed_loss),
            data("hub_load_x", Measure::Force, x),
            data("hub_load_y", Measure::Force, y),
        ]);
    }
    let data =
        |key: &'static str, measure, value: f64| Quantity::number(key, "", measure, value, SHOWN);
    let amplitudes = spans(history).into_iter().zip(&sample.amplitudes);
    quantities.extend(amplitudes.map(|([from, to], &amplitude)| {
        let key = format!("{}_to_{}_amplitude", stem(from), stem(to));
        let label = format!("w {from} to {to}");
        number(key, label, Measure::Length, amplitude)
    }));
    let ledger = sample.ledger;
    if !sample.amplitudes.is_empty() {
        quantities.extend([
            data("gravity_work", Measure::Energy, ledger.gravity),
            data("run_out_work", Measure::Energy, ledger.run_out),
            data(
                "damped_across_energy",
                Measure::Energy,
                ledger.damped_across,
            ),
        ]);
    }
    quantities.extend([
        data("smallest_tension", Measure::Force, sample.smallest_tension),
        data("work", Measure::Energy, ledger.work),
        data("stored_energy", Measure::Energy, ledger.stored),
        data("damped_energy", Measure::Energy, ledger.damped),
        data("contact_energy", Measure::Energy, ledger.contact),
        data("compression_energy", Measure::Energy, ledger.compression),
        data("energy_residual", Measure::Energy, ledger.residual()),
    ]);
    Subject::new("", quantities)
}

/// The spans that were slack.
fn slack_spans(history: &History) -> Vec<Subject> {
    let names = spans(history);
    let slack = names.iter().zip(&history.slack_spans);
    let slack = slack.filter(|(_, span)| span.largest_tension >= 0.0);
    let rows = slack.map(|([from, to], span)| {
        let number =
            |key, label, measure, value| Quantity::number(key, label, measure, value, SHOWN);
        Subject::new(
            // With a head no row is left out.
            "slack span",
            vec![
                Quantity::word("span", "span", format!("{from} to {to}")),
                number("time", "slack for", Measure::Time, span.time),
                number(
                    "largest_tension",
                    "largest T after",
                    Measure::Force,
                    span.largest_tension,
                ),
            ],
        )
    });
    rows.collect()
}

/// How the run was computed and how it ended.
fn run(history: &History) -> Vec<Quantity> {
    let effort = history.effort;
    let least = history.samples.iter().map(|sample| sample.smallest_tension);
    let ending = match history.ending {
        Ending::Time => "time",
        Ending::Steady => "steady",
        Ending::Event => "event",
        Ending::NotSteady => "not steady",
        Ending::Interrupted => "interrupted",
        Ending::Failed => "failed",
    };
    let [shortest, longest] = effort.step;
    let implicit = effort.implicit;
    vec![
        Quantity::word("ending", "", ending.to_owned()),
        Quantity::number(
            "smallest_tension",
            "smallest tension",
            Measure::Force,
            least.fold(f64::INFINITY, f64::min),
            SHOWN,
        ),
        Quantity::count("cells", "cells", effort.cells),
        Quantity::count("steps", "time steps", effort.steps),
        Quantity::count(
            "implicit_steps",
            if implicit.steps > 0 { "  implicit" } else { "" },
            implicit.steps,
        ),
        Quantity::count("newton_iterations", "", implicit.iterations),
        Quantity::count("factorisations", "", implicit.factorisations),
        Quantity::number("shortest_step", "", Measure::Time, shortest, SHOWN),
        Quantity::number(
            "longest_step",
            "longest time step",
            Measure::Time,
            longest,
            SHOWN,
        ),
        Quantity::number("seconds", "", Measure::Number, effort.seconds, SHOWN),
    ]
}

/// Where the energy went.
fn energy(drive: &Drive, history: &History) -> Vec<Quantity> {
    let Some(ledger) = history.samples.last().map(|sample| sample.ledger) else {
        return vec![];
    };
    let number = |key, label, value| Quantity::number(key, label, Measure::Energy, value, SHOWN);
    let mut quantities = vec![number("work", "work of the axles", ledger.work)];
    let moves_across = (history.samples.first()).is_some_and(|first| !first.amplitudes.is_empty());
    if moves_across {
        quantities.extend([
            number("gravity", "work of gravity on the spans", ledger.gravity),
            number("run_out", "work of run-out on the spans", ledger.run_out),
        ]);
    }
    quantities.extend([
        number("stored", "  stored", ledger.stored),
        number("damped", "  lost in axial damping", ledger.damped),
    ]);
    if moves_across {
        quantities.push(number(
            "damped_across",
            "  lost in damping across",
            ledger.damped_across,
        ));
    }
    quantities.extend([
        number("contact", "  lost in the contact", ledger.contact),
        number(
            "compression",
            match drive.belt.kind {
                BeltKind::Flat { .. } => "",
                BeltKind::V(_) => "  compression of the belt",
            },
            ledger.compression,
        ),
        Quantity::error(
            "residual",
            "  not accounted for",
            Measure::Energy,
            ledger.residual().abs(),
        ),
        number("turnover", "", ledger.turnover),
    ]);
    quantities
}
