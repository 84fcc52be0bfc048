//! The largest torque and power of a drive against speed.

use super::axis::{Axis, Scale};
use super::curve;
use super::header::{Header, Mark, Sign};
use super::occupied::Frame;
use super::panel::{Panel, grid};
use super::sheet::{Color, INK, PALETTE, Sheet, Spot, Stroke, spot};
use crate::quantity::{Answer, Measure, UnitSystem, rating::answer};
use crate::{LoadEnd, RatedLoad, Rating, RatingEnd};

/// Width of the figure and height of its panels, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 440.0;

/// Width of a curve, px.
const CURVE: f64 = 2.0;

/// The figure: torque and power beside each other, in the colours of the reasons of the limit, with the optimum and the
/// limit at the speed of the drive file.
pub(super) fn figure(rating: &Rating) -> String {
    let reasons = reasons(rating);
    let lines = reasons.iter().enumerate();
    let lines = lines.map(|(index, reason)| {
        let sentence = reason.sentence(&rating.drive).into_owned();
        (sentence, Mark::Line(Stroke::solid(color(index), CURVE)))
    });
    let best = match rating.optimum_at_end {
        true => "largest power of the range",
        false => "largest power",
    };
    let best = (best.to_owned(), Mark::Sign(Sign::Dot, INK));
    let stated = (
        "speed of the drive file".to_owned(),
        Mark::Sign(Sign::Square, INK),
    );
    let stated = shown_stated(rating).map(|_| stated);
    let legend = lines.chain([best]).chain(stated);
    let Answer { heading, .. } = answer(rating);
    let heading = Answer {
        heading,
        ..Answer::default()
    };
    let header = Header::new(&heading, "", legend, WIDTH);
    let size = spot(WIDTH, header.height + PANELS);
    let mut sheet = Sheet::new(size);
    header.draw(&mut sheet);
    let below = Frame {
        from: spot(0.0, header.height),
        to: size,
    };
    let shown: [Shown; 2] = [
        ("Largest torque", Measure::Torque, |load| load.torque),
        ("Largest power", Measure::Power, |load| load.power),
    ];
    for (shown, part) in shown.into_iter().zip(grid(below, 2, 2)) {
        panel(&mut sheet, part, rating, &reasons, shown);
    }
    sheet.finish()
}

/// The limit at the speed of the drive file, if it is in the range.
fn shown_stated(rating: &Rating) -> Option<&RatedLoad> {
    let stated = rating.stated.as_ref().ok()?;
    let [first, last] = [rating.points.first()?, rating.points.last()?];
    (first.speed <= stated.speed && stated.speed <= last.speed).then_some(stated)
}

/// The reasons of the limit, in the order of speeds.
fn reasons(rating: &Rating) -> Vec<&LoadEnd> {
    let mut reasons: Vec<&LoadEnd> = Vec::new();
    for stretch in &rating.stretches {
        if !reasons.iter().any(|known| known.is_like(&stretch.end)) {
            reasons.push(&stretch.end);
        }
    }
    reasons
}

fn color(index: usize) -> Color {
    // From the second on: the first is that of warnings.
    PALETTE[(index + 1) % PALETTE.len()]
}

type Shown = (&'static str, Measure, fn(&RatedLoad) -> f64);

fn panel(
    sheet: &mut Sheet,
    part: Frame,
    rating: &Rating,
    reasons: &[&LoadEnd],
    (title, measure, of): Shown,
) {
    let [across, up] =
        [Measure::AngularSpeed, measure].map(|measure| measure.shown(UnitSystem::Engineering));
    let place = |load: &RatedLoad| [load.speed * across.factor, of(load) * up.factor];
    let marked = std::iter::once(&rating.optimum).chain(shown_stated(rating));
    let shown: Vec<_> = rating.points.iter().chain(marked).map(place).collect();
    let speeds = shown.iter().map(|place| place[0]);
    let values = shown.iter().map(|place| place[1]).chain([0.0]);
    let panel = Panel {
        title: title.to_owned(),
        axes: [
            Axis::spanning(speeds.chain([0.0]), Scale::Decimal),
            Axis::spanning(values, Scale::Decimal).padded(),
        ],
        descriptions: [
            format!("speed of the driver in {}", across.symbol),
            format!("{} of the driver in {}", title.to_lowercase(), up.symbol),
        ],
    };
    let chart = panel.draw(sheet, part, []);
    let at = |load: &RatedLoad| -> Spot {
        let [speed, value] = place(load);
        chart.at(speed, value)
    };
    for stretch in &rating.stretches {
        let reason = reasons.iter().position(|known| known.is_like(&stretch.end));
        let [from, to] = stretch.range;
        let inside = rating.points.iter().filter(|point| {
            let is_lift_off =
                point.factor == 0.0 && matches!(rating.end, RatingEnd::LiftsOff { .. });
            from <= point.speed
                && point.speed <= to
                && (point.end.is_like(&stretch.end) || is_lift_off)
        });
        let places: Vec<_> = inside.map(at).collect();
        let stroke = Stroke::solid(color(reason.unwrap_or(0)), CURVE);
        curve::draw(sheet, &places, stroke);
    }
    if let Some(stated) = shown_stated(rating) {
        Sign::Square.draw(sheet, at(stated), INK);
    }
    Sign::Dot.draw(sheet, at(&rating.optimum), INK);
}
