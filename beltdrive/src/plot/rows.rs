//! The numbers in the rows of an answer as curves over the first of them: branches and limits.

use super::axis::{Axis, Scale};
use super::curve::smooth;
use super::header::{Header, Mark, Sign};
use super::numbers::labels;
use super::occupied::{Frame, Occupied, Shape};
use super::panel::{Panel, grid};
use super::sheet::{Anchor, BODY, Color, DOT, GREY, INK, MARGIN, PALETTE, SMALL, Sheet, Stroke};
use super::sheet::{Spot, cut, spot};
use crate::quantity::{Answer, Layout, Measure, Quantity, Subject, UnitSystem, Value};
use std::ops::RangeInclusive;

/// Width of the figure, and height of its panels together, of one alone, and of a line of the list of events, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 680.0;
const PANEL: f64 = 560.0;
const LINE: f64 = 20.0;

/// Most panels in the figure.
const COUNT: usize = 4;

/// Numbers of pulleys that have a panel if they vary and rows have not enough of their own.
const OF_PULLEYS: [&str; 5] = [
    "wrap_angle",
    "exit_inclination",
    "torque",
    "slip_arc",
    "speed_loss",
];

/// Widths of a curve, of one that a later one covers, and of one beyond the colours, px.
const CURVE: f64 = 2.0;
const COVERED: f64 = 4.5;
const FURTHER: f64 = 1.0;

/// Radius of a dot at a state of a curve of limits, px.
const STATE: f64 = 2.5;

/// Digits of a place in the list of events.
const DIGITS: f64 = 10.0;

/// A panel: numbers of one unit.
struct Diagram {
    title: String,
    axis: String,
    scale: Scale,
    /// The values of every row, one curve or one for each pulley.
    curves: Vec<Vec<f64>>,
}

/// Rows of one kind, in which a curve does not jump.
#[derive(Debug, PartialEq)]
struct Piece {
    rows: RangeInclusive<usize>,
    /// Place of their reason among all reasons, if the rows are limits.
    reason: Option<usize>,
    /// Whether they are behind a limit point.
    behind: bool,
}

/// The figure: a panel for each of the first four numbers that vary.
pub(super) fn figure(answer: &Answer) -> String {
    let mut groups = answer.groups.iter();
    let rows = groups.find(|group| group.layout == Layout::Rows);
    let rows = rows.map_or(&[][..], |group| &group.subjects);
    let diagrams = diagrams(rows);
    let events: Vec<_> = (0..rows.len())
        .filter(|row| rows[*row].word("event").is_some())
        .collect();
    let reasons = reasons(rows);
    let header = Header::new(answer, "", legend(rows, &diagrams, &reasons), WIDTH);
    let panels = if diagrams.len() > 1 { PANELS } else { PANEL };
    let top = spot(0.0, header.height);
    let size = top + spot(WIDTH, panels);
    let mut sheet = Sheet::new(size + spot(0.0, LINE * events.len() as f64));
    header.draw(&mut sheet);
    let Some(across) = rows.first().and_then(|row| numbers(row).next()) else {
        return sheet.finish();
    };
    let places = values(rows, across.measure, |row| numbers(row).next());
    let turns = rows.iter().any(|row| row.word("event") == Some("fold"));
    let parameter = Diagram {
        title: String::new(),
        axis: described(&across.label, across.measure),
        // A wide range is logarithmic, unless the parameter turns back, which has to be seen.
        scale: if turns {
            Scale::Decimal
        } else {
            Scale::Parameter
        },
        curves: vec![places],
    };
    let below = Frame {
        from: top,
        to: size,
    };
    let columns = diagrams.len().min(2);
    for (diagram, part) in diagrams.iter().zip(grid(below, columns, diagrams.len())) {
        diagram.draw(
            &mut sheet,
            part,
            &parameter,
            &pieces(rows, &reasons),
            &events,
        );
    }
    for (number, row) in events.iter().enumerate() {
        let place = numbers(&rows[*row])
            .next()
            .and_then(|place| place.shown(DIGITS));
        let what = rows[*row].word("description").unwrap_or_default();
        let text = format!("{}   {}: {what}", number + 1, place.unwrap_or_default());
        let at = spot(MARGIN, size.y + LINE * (number as f64 + 0.3));
        let text = cut(&text, BODY, WIDTH - 2.0 * MARGIN);
        sheet.text(&text, BODY, INK, Anchor::Start, at);
    }
    sheet.finish()
}

/// The shown numbers of a row.
fn numbers(row: &Subject) -> impl Iterator<Item = &Quantity> {
    let is_shown = |quantity: &&Quantity| {
        !quantity.label.is_empty() && matches!(quantity.value, Value::Number(_))
    };
    row.quantities.iter().filter(is_shown)
}

/// A number of every row in the unit in which it is shown; not a number where there is none.
fn values<'a>(
    rows: &'a [Subject],
    measure: Measure,
    of: impl Fn(&'a Subject) -> Option<&'a Quantity>,
) -> Vec<f64> {
    let factor = measure.shown(UnitSystem::Engineering).factor;
    let value = |row| match of(row).map(|quantity| &quantity.value) {
        Some(Value::Number(Some(value))) => factor * value,
        _ => f64::NAN,
    };
    rows.iter().map(value).collect()
}

/// What an axis measures.
fn described(label: &str, measure: Measure) -> String {
    match measure.shown(UnitSystem::Engineering).symbol {
        "" => label.to_owned(),
        "°" => format!("{label} in degrees"),
        symbol => format!("{label} in {symbol}"),
    }
}

/// The panels of rows.
fn diagrams(rows: &[Subject]) -> Vec<Diagram> {
    let Some(first) = rows.first() else {
        return Vec::new();
    };
    let own = numbers(first).skip(1).map(|quantity| {
        let values = values(rows, quantity.measure, |row| row.quantity(&quantity.key));
        Diagram::of(quantity, vec![values])
    });
    let of_pulleys = OF_PULLEYS.iter().filter_map(|key| {
        let pulleys = first.list("pulleys");
        let quantity = pulleys.first()?.quantity(key)?;
        let of = |index: usize| {
            values(rows, quantity.measure, move |row| {
                row.list("pulleys").get(index)?.quantity(key)
            })
        };
        Some(Diagram::of(quantity, (0..pulleys.len()).map(of).collect()))
    });
    let varying = own.chain(of_pulleys).filter(Diagram::varies);
    varying.take(COUNT).collect()
}

/// The reasons of limits that occur, in order.
fn reasons(rows: &[Subject]) -> Vec<&str> {
    let mut reasons = Vec::new();
    for reason in rows.iter().filter_map(|row| row.word("reason")) {
        if !reasons.contains(&reason) {
            reasons.push(reason);
        }
    }
    reasons
}

/// The pieces of rows. Those before and behind a limit point share it; where the reason of limits changes, the
/// limit may jump.
fn pieces(rows: &[Subject], reasons: &[&str]) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        let reason = row.word("reason");
        let reason = reasons.iter().position(|known| Some(*known) == reason);
        match pieces.last_mut() {
            Some(last) if last.reason == reason => {
                last.rows = *last.rows.start()..=index;
            }
            _ => pieces.push(Piece {
                rows: index..=index,
                reason,
                behind: false,
            }),
        }
        if row.word("event") == Some("fold") && index + 1 < rows.len() {
            pieces.push(Piece {
                rows: index..=index,
                reason,
                behind: true,
            });
        }
    }
    // Where limits have reasons, a row without one is no limit.
    pieces.retain(|piece| reasons.is_empty() || piece.reason.is_some());
    pieces
}

fn legend(rows: &[Subject], diagrams: &[Diagram], reasons: &[&str]) -> Vec<(String, Mark)> {
    let line = |label: &str, stroke| (label.to_owned(), Mark::Line(stroke));
    let limits = reasons.iter().enumerate();
    let limits = limits.map(|(index, reason)| line(reason, stroke(index)));
    let shows_pulleys = diagrams.iter().any(|diagram| diagram.curves.len() > 1);
    let pulleys = rows.first().map_or(&[][..], |row| row.list("pulleys"));
    let pulleys = pulleys.iter().enumerate().filter(|_| shows_pulleys);
    let pulleys = pulleys.map(|(index, pulley)| line(&pulley.head, stroke(index)));
    let has = |kind: fn(&str) -> bool| rows.iter().any(|row| row.word("event").is_some_and(kind));
    let behind = has(|event| event == "fold");
    let behind = behind.then(|| line("behind the limit point", Stroke::dashed(GREY, CURVE)));
    let event = has(|_| true).then(|| ("event".to_owned(), Mark::Sign(Sign::Dot, INK)));
    limits.chain(pulleys).chain(behind).chain(event).collect()
}

/// How one of several things is drawn.
fn stroke(index: usize) -> Stroke {
    let width = if index < PALETTE.len() {
        CURVE
    } else {
        FURTHER
    };
    Stroke::solid(PALETTE[index % PALETTE.len()], width)
}

impl Diagram {
    fn of(quantity: &Quantity, curves: Vec<Vec<f64>>) -> Self {
        let label = quantity.label.trim();
        let mut letters = label.chars();
        let first = letters.next().into_iter().flat_map(char::to_uppercase);
        Self {
            title: first.chain(letters).collect(),
            axis: described(label, quantity.measure),
            scale: match quantity.measure {
                Measure::Angle => Scale::Degrees,
                _ => Scale::Decimal,
            },
            curves,
        }
    }

    /// Whether there is anything to see.
    fn varies(&self) -> bool {
        self.curves.iter().any(|values| {
            let finite = || values.iter().filter(|value| value.is_finite());
            let ends = [f64::INFINITY, f64::NEG_INFINITY];
            let [low, high] = finite().fold(ends, |[low, high], value| {
                [low.min(*value), high.max(*value)]
            });
            high - low > 1e-9 * high.abs().max(low.abs())
        })
    }

    fn axis(&self) -> Axis {
        Axis::spanning(self.curves.iter().flatten().copied(), self.scale).padded()
    }

    /// How the curves are drawn: wide where a later one covers most of them.
    fn strokes(&self) -> Vec<Stroke> {
        let axis = self.axis();
        let is_near = |one: f64, other: f64| (axis.part(one) - axis.part(other)).abs() < 0.004;
        let covers = |one: &[f64], other: &[f64]| {
            let near = one
                .iter()
                .zip(other)
                .filter(|(one, other)| is_near(**one, **other));
            2 * near.count() > one.len()
        };
        let curves = self.curves.iter().enumerate();
        let strokes = curves.map(|(index, curve)| match self.curves.len() {
            1 => Stroke::solid(INK, CURVE),
            _ if self.curves[index + 1..]
                .iter()
                .any(|later| covers(later, curve)) =>
            {
                Stroke {
                    width: COVERED,
                    ..stroke(index)
                }
            }
            _ => stroke(index),
        });
        strokes.collect()
    }

    fn draw(
        &self,
        sheet: &mut Sheet,
        part: Frame,
        parameter: &Self,
        pieces: &[Piece],
        events: &[usize],
    ) {
        let panel = Panel {
            title: self.title.clone(),
            axes: [parameter.axis(), self.axis()],
            descriptions: [parameter.axis.clone(), self.axis.clone()],
        };
        let chart = panel.draw(sheet, part, []);
        let curves = self.curves.iter().map(|values| {
            let points = parameter.curves[0].iter().zip(values);
            points
                .map(|(across, up)| chart.at(*across, *up))
                .collect::<Vec<_>>()
        });
        let curves: Vec<_> = curves.collect();
        let mut shapes = Vec::new();
        let is_known = |place: &Spot| place.iter().all(|part| part.is_finite());
        for (places, stroke) in curves.iter().zip(self.strokes()) {
            for piece in pieces {
                let reason = piece.reason.filter(|_| curves.len() == 1);
                let color: Color = reason.map_or(stroke.color, |at| self::stroke(at).color);
                let dashed = piece.behind;
                let known = places[piece.rows.clone()].iter().copied().filter(is_known);
                let known: Vec<_> = known.collect();
                if known.len() > 1 {
                    sheet.path(
                        &smooth(&known),
                        Stroke {
                            color,
                            dashed,
                            ..stroke
                        },
                    );
                }
                if piece.reason.is_some() {
                    known.iter().for_each(|at| sheet.disc(*at, STATE, color));
                }
                let lines = known.windows(2).map(|ends| [ends[0], ends[1]]);
                shapes.extend(lines.map(|ends| Shape::Line(ends, 0.5 * stroke.width + 1.5)));
            }
        }
        let dots = curves
            .iter()
            .map(|places| events.iter().map(|row| places[*row]).collect());
        let dots: Vec<Vec<_>> = dots.collect();
        shapes.extend(
            dots.iter()
                .flatten()
                .map(|dot| Shape::Disc(*dot, DOT + 1.0)),
        );
        let colors: Vec<_> = self.strokes().iter().map(|stroke| stroke.color).collect();
        for (dots, color) in dots.iter().zip(&colors) {
            let known = dots.iter().filter(|dot| is_known(dot));
            known.for_each(|dot| sheet.disc(*dot, DOT, color));
        }
        let mut occupied = Occupied {
            sheet: chart.frame,
            shapes,
        };
        for label in labels(&dots, &mut occupied) {
            if let Some(leader) = label.place.leader {
                sheet.line(&leader, Stroke::solid(GREY, 0.8));
            }
            let middle = label.place.frame.middle();
            sheet.text(
                &label.text,
                SMALL,
                colors[label.curve],
                Anchor::Middle,
                middle,
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::check;
    use super::*;
    use crate::quantity::two_pulley_rows::{branch, limit_curve};
    use crate::report::sample_branch;
    use crate::{Branch, LimitCurve};

    fn rows(answer: &Answer) -> &[Subject] {
        answer.subjects("points")
    }

    fn drawn(branch: &Branch) -> String {
        let figure = figure(&self::branch(branch));
        check(&figure);
        figure
    }

    #[test]
    fn the_branch_is_parted_at_its_limit_point() {
        let mut folded = sample_branch::folded();
        let answer = branch(&folded);
        let found = pieces(rows(&answer), &[]);
        let [before, behind] = &found[..] else {
            panic!("{found:?}");
        };
        assert_eq!(before.rows.end(), behind.rows.start());
        let fold = &rows(&answer)[*behind.rows.start()];
        assert_eq!(
            fold.number(folded.key.path()),
            Some(folded.events[2].point.value)
        );
        assert_eq!((before.behind, behind.behind), (false, true));
        let figure = drawn(&folded);
        assert!(figure.contains(">behind the limit point<") && figure.contains("dasharray"));
        for title in [
            "Speed of the driven pulley",
            "Efficiency",
            "Wrap angle",
            "Inclination at exit",
        ] {
            assert!(figure.contains(&format!(">{title}<")), "{title}");
        }
        folded.events.remove(2);
        assert_eq!(pieces(rows(&branch(&folded)), &[]).len(), 1);
    }

    #[test]
    fn a_parameter_over_decades_has_powers_of_ten_unless_it_turns_back() {
        let mut branch = sample_branch::folded();
        for point in &mut branch.points {
            point.value = 1e5 * 10_f64.powf(5.0 * point.arclength);
        }
        assert!(!drawn(&branch).contains(">1e5<"));
        branch.events.clear();
        assert!(drawn(&branch).contains(">1e5<"));
    }

    #[test]
    fn events_are_numbered_and_told() {
        let mut branch = sample_branch::folded();
        branch.events[1].point = branch.events[0].point.clone();
        let figure = drawn(&branch);
        assert!(figure.contains(">1, 2<"));
        assert!(
            figure.contains("3   8221.01 N: limit point: the tight tractive tension turns back")
        );
    }

    #[test]
    fn a_branch_of_one_state_has_a_figure() {
        let mut branch = sample_branch::folded();
        branch.points.truncate(1);
        branch.events.clear();
        drawn(&branch);
    }

    fn chart(curve: &LimitCurve) -> String {
        let figure = figure(&limit_curve(curve));
        check(&figure);
        figure
    }

    #[test]
    fn a_curve_of_limits_is_parted_where_the_reason_changes() {
        let mut curve = sample_branch::curve();
        let answer = limit_curve(&curve);
        let reasons = reasons(rows(&answer));
        assert_eq!(reasons, ["fold: driver slips", "fold: driver overhangs"]);
        let pieces = pieces(rows(&answer), &reasons);
        let lengths: Vec<_> = pieces
            .iter()
            .map(|piece| piece.rows.clone().count())
            .collect();
        assert_eq!(lengths.iter().sum::<usize>(), curve.points.len());
        assert_eq!(lengths.len(), 2);
        let figure = chart(&curve);
        assert!(figure.contains(">0.2<") && figure.contains(">40000<") && !figure.contains("cusp"));
        curve.cusps = vec![curve.points[3].clone()];
        assert!(chart(&curve).contains("cusp: two limit points meet and vanish"));
        curve.cusps.clear();
        for (power, point) in (0..).zip(&mut curve.points) {
            point.second = 1e4 * 10_f64.powf(0.2 * f64::from(power));
        }
        let figure = chart(&curve);
        for tick in ["1e4", "1e5", "1e6", "1e7", "1e8"] {
            assert!(figure.contains(&format!(">{tick}<")), "{tick}");
        }
    }

    #[test]
    fn a_pulley_behind_another_curve_is_seen() {
        let same = Diagram {
            title: String::new(),
            axis: String::new(),
            scale: Scale::Decimal,
            curves: vec![
                vec![1.0, 2.0, 3.0],
                vec![1.0, 2.0, 3.0],
                vec![1.0, 5.0, 9.0],
            ],
        };
        let widths: Vec<_> = same.strokes().iter().map(|stroke| stroke.width).collect();
        assert_eq!(widths, [COVERED, CURVE, CURVE]);
    }
}
