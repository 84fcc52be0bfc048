//! A loop as its answer tells it: where the pulleys are, where the belt meets them, and what is said of them.

use super::super::zones;
use crate::quantity::{Answer, Measure, Quantity, Subject};
use crate::{Layout, PlacedPulley};
use nalgebra::{Rotation2, Vector2};
use std::f64::consts::FRAC_PI_2;

/// A point or direction in the plane of the loop, x to the right and y upwards, m or N.
pub(super) type Point = Vector2<f64>;

/// A loop.
pub(super) struct Loop {
    /// The pulleys in belt order.
    pub(super) pulleys: Vec<Pulley>,
    /// What is said of the spans; that of index i leaves pulley i.
    pub(super) spans: Vec<Vec<String>>,
    /// The tensioner, if there is one.
    pub(super) tensioner: Option<Tensioner>,
    /// Largest displacement of the spans across, m.
    pub(super) displacement: f64,
    /// Sense in which the belt runs: +1 counter-clockwise, −1 clockwise.
    pub(super) sense: f64,
}

/// A pulley with the belt on it.
pub(super) struct Pulley {
    /// Name, and what is said of it.
    pub(super) name: String,
    pub(super) lines: Vec<String>,
    pub(super) centre: Point,
    /// Pitch radius, m.
    pub(super) radius: f64,
    /// Sense in which it turns, as of the loop.
    pub(super) sense: f64,
    pub(super) is_driver: bool,
    /// Polar angle of the entry of the belt seen from the centre, and the angle swept up to the exit, rad.
    entry: f64,
    pub(super) wrap: f64,
    /// Largest penetration of the belt, m.
    pub(super) penetration: f64,
    /// The belt on the pulley: swept angle, rad, penetration, m, and kind of zone.
    pub(super) belt: Vec<(f64, f64, String)>,
    /// Forces of the belt on the hub, N: running and at rest.
    pub(super) hub_loads: [Option<Point>; 2],
}

/// The tensioner; lengths in m.
pub(super) struct Tensioner {
    /// Index of its pulley.
    pub(super) pulley: usize,
    /// The pivot of an arm; none of a slide.
    pub(super) pivot: Option<Point>,
    /// Centre of its pulley at rest.
    pub(super) rest: Point,
    /// Direction in which a slide moves.
    pub(super) direction: Point,
    /// What is said of it.
    pub(super) lines: Vec<String>,
}

/// Significant digits in figures.
const DIGITS: f64 = 4.0;

impl Loop {
    /// The loop of an answer.
    pub(super) fn of(answer: &Answer) -> Self {
        let statement = answer.subjects("").first();
        let sense = statement.and_then(|subject| subject.word("sense"));
        let sense = if sense == Some("clockwise") {
            -1.0
        } else {
            1.0
        };
        let (pulleys, spans) = (answer.subjects("pulleys"), answer.subjects("spans"));
        let arriving = spans.iter().cycle().skip(spans.len().saturating_sub(1));
        let pulleys: Vec<_> = { pulleys.iter().zip(arriving) }
            .map(|(pulley, span)| Pulley::of(pulley, span, sense))
            .collect();
        let tensioner = answer.subjects("tensioner").first();
        let tensioner = tensioner.and_then(|subject| Tensioner::of(subject, &pulleys));
        Self {
            spans: spans.iter().map(span_lines).collect(),
            pulleys,
            tensioner,
            displacement: 0.0,
            sense,
        }
    }

    /// A flat belt as it is laid, with what is said of each pulley and each span, if anything is; `is_driver` tells the
    /// pulleys that drive. `displacement` is the largest one of the spans across, m.
    pub(super) fn laid(
        layout: &Layout,
        is_driver: impl Fn(usize) -> bool,
        pulley_lines: impl Fn(usize) -> Vec<String>,
        spans: Vec<Vec<String>>,
        displacement: f64,
    ) -> Self {
        let pulley = |(index, placed): (usize, &PlacedPulley)| {
            let sense = placed.turns(layout.sense());
            let [arriving, _] = layout.spans_of(index);
            Pulley {
                name: placed.name.clone(),
                lines: pulley_lines(index),
                centre: placed.centre.into(),
                radius: placed.radius,
                sense,
                is_driver: is_driver(index),
                entry: arriving.direction - sense * FRAC_PI_2,
                wrap: layout.wraps()[index],
                penetration: 0.0,
                belt: vec![],
                hub_loads: [None; 2],
            }
        };
        Self {
            pulleys: layout.pulleys().iter().enumerate().map(pulley).collect(),
            spans,
            tensioner: None,
            displacement,
            sense: layout.sense().sign(),
        }
    }

    /// A span from its beginning to its end.
    pub(super) fn span(&self, index: usize) -> [Point; 2] {
        let next = (index + 1) % self.pulleys.len();
        [
            self.pulleys[index].exit(),
            self.pulleys[next].point(0.0, 0.0),
        ]
    }
}

/// What is said of a span.
fn span_lines(span: &Subject) -> Vec<String> {
    let tension = |symbol: &str, key| Some(format!("{symbol} = {}", shown(span, key)?));
    // Spans are named after the pulley they leave, unless they have names of their own.
    let name = (span.word("from_pulley") != Some(&span.head)).then(|| span.head.clone());
    let lines = [
        name,
        tension("T", "tension"),
        tension("F", "tractive_tension"),
    ];
    lines.into_iter().flatten().collect()
}

/// A number of a measure in SI units, with its unit.
pub(super) fn measured(measure: Measure, value: f64) -> String {
    // With an error below the last digit that is shown.
    let error = f64::EPSILON * value.abs();
    let quantity = Quantity::number("", "", measure, value, error);
    quantity.shown(DIGITS).unwrap_or_default()
}

/// A quantity with its unit.
fn shown(subject: &Subject, key: &str) -> Option<String> {
    subject
        .quantity(key)
        .and_then(|quantity| quantity.shown(DIGITS))
}

impl Pulley {
    /// The pulley that a span arrives at.
    ///
    /// Where the belt runs in the direction ϑ with the inclination θ on a pulley that turns in the sense σ, it
    /// is at the polar angle ϑ − σ (π/2 − θ).
    fn of(pulley: &Subject, arriving: &Subject, sense: f64) -> Self {
        let number = |key| pulley.number(key).unwrap_or(0.0);
        let pair = |key| pulley.pair(key).map(Point::from);
        let is_outside = pulley.word("side") == Some("outside");
        let sense = if is_outside { -sense } else { sense };
        let direction = arriving.number("direction").unwrap_or(0.0);
        let name = &pulley.head;
        let is_driver = pulley.word("duty") == Some("driver");
        let line = |words: &str, key| Some(format!("{words}{}", shown(pulley, key)?));
        let torque = match pulley.number("torque") {
            Some(0.0) => Some("no torque".to_owned()),
            _ => line("torque ", "torque"),
        };
        let lines = [
            line("", "angular_speed"),
            torque,
            line("wrap angle ", "wrap_angle"),
            line("hub load ", "hub_load_magnitude"),
            line("at rest ", "hub_load_rest_magnitude"),
        ];
        Self {
            name: match is_driver && name != "driver" {
                true => format!("{name} (driver)"),
                false => name.clone(),
            },
            lines: lines.into_iter().flatten().collect(),
            centre: pair("centre").unwrap_or_default(),
            radius: number("radius"),
            sense,
            is_driver,
            entry: direction - sense * (FRAC_PI_2 - number("entry_inclination")),
            wrap: number("wrap_angle"),
            penetration: number("max_penetration"),
            belt: belt(pulley),
            hub_loads: [pair("hub_load"), pair("hub_load_rest")],
        }
    }

    /// The point at an angle swept from the entry and a penetration into the groove.
    pub(super) fn point(&self, swept: f64, penetration: f64) -> Point {
        let angle = self.entry + self.sense * swept;
        self.centre + polar(angle, self.radius - penetration)
    }

    /// The point where the belt leaves.
    pub(super) fn exit(&self) -> Point {
        self.point(self.wrap, 0.0)
    }
}

/// The point at a polar angle and radius.
pub(super) fn polar(angle: f64, radius: f64) -> Point {
    Rotation2::new(angle) * Point::new(radius, 0.0)
}

/// Largest angle between neighbouring points of a belt, rad: on a disc as wide as the sheet, chords are 0.1 px
/// from the rim.
const STEP: f64 = 0.04;

/// The belt on a pulley. Where it overhangs, the angle turns back, and the zone is the last one reached.
fn belt(pulley: &Subject) -> Vec<(f64, f64, String)> {
    let zones: Vec<_> = { zones::along(pulley).into_iter() }
        .map(|(kind, [_, to])| (kind, to))
        .collect();
    let angles = pulley.series("angle");
    let points: Vec<_> = { angles.iter().zip(pulley.series("penetration")) }
        .map(|(angle, penetration)| Point::new(*angle, *penetration))
        .collect();
    let mut fine: Vec<_> = points.first().copied().into_iter().collect();
    for ends in points.windows(2) {
        let between = ends[1] - ends[0];
        let ends_of_zones = zones.iter().map(|(_, to)| (to - ends[0].x) / between.x);
        let count = (between.x.abs() / STEP).ceil().max(1.0);
        let steps = (1..).map(|step| f64::from(step) / count);
        let mut parts: Vec<_> = { steps.take_while(|part| *part < 1.0) }
            .chain(ends_of_zones.filter(|part| (0.0..1.0).contains(part)))
            .chain([1.0])
            .collect();
        parts.sort_by(f64::total_cmp);
        fine.extend(parts.iter().map(|part| ends[0] + *part * between));
    }
    let mut reached = 0.0_f64;
    let belt = fine.iter().map(|point| {
        reached = reached.max(point.x);
        let zone = zones.iter().find(|(_, to)| reached <= *to);
        let kind = zone.or(zones.last()).map_or("", |(kind, _)| kind);
        (point.x, point.y, kind.to_owned())
    });
    belt.collect()
}

impl Tensioner {
    fn of(subject: &Subject, pulleys: &[Pulley]) -> Option<Self> {
        let name = subject.word("pulley")?;
        let pulley = pulleys.iter().position(|pulley| {
            pulley.name == name || pulley.name.strip_suffix(" (driver)") == Some(name)
        })?;
        let pair = |key| subject.pair(key).map(Point::from);
        let words = [
            ("arm at", "angle"),
            ("slide at", "position"),
            ("at rest", "rest_angle"),
            ("at rest", "rest_position"),
        ];
        let lines = words.iter().filter_map(|(words, key)| {
            let quantity: &Quantity = subject.quantity(key)?;
            Some(format!("{words} {}", quantity.shown(DIGITS)?))
        });
        Some(Self {
            pulley,
            pivot: pair("pivot"),
            rest: pair("rest_centre")?,
            direction: pair("direction").unwrap_or_default(),
            lines: lines.collect(),
        })
    }
}
