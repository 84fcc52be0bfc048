//! The bifurcation diagram of a branch: scalars of its states over the parameter.

use super::axis::{Axis, Scale};
use super::diagrams::{self, Curve, DRIVEN, DRIVER, Diagram};
use super::header::{Header, Legend};
use super::labels::{self, Label};
use super::occupied::Frame;
use super::panel::{Chart, Panel};
use super::style::{self, Canvas, Drawn, Stroke, px};
use crate::input::Key;
use crate::report::{value, words};
use crate::{Branch, TracePoint};
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use std::iter;

/// Width of the figure and height of its panels together, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 680.0;

/// Height of a line of the list of events and the space below it, px.
const LINE: f64 = 20.0;
const BELOW: f64 = 16.0;

/// The figure of a branch.
pub(super) fn figure(branch: &Branch) -> String {
    let key = branch.key;
    let caption = format!("Branch over the {}", key.name());
    let header = Header::new(&branch.drive, &[key], &caption);
    let top = header.height(WIDTH);
    let height = top + PANELS + LINE * branch.events.len() as f64 + BELOW;
    let view = View::of(branch);
    style::render([WIDTH, height], |canvas| {
        header.draw(canvas, &view.legend())?;
        let (_, below) = canvas.split_vertically(px(top));
        let (panels, list) = below.split_vertically(px(PANELS));
        for (panel, diagram) in panels
            .split_evenly((2, 2))
            .iter()
            .zip(diagrams::of(&branch.drive))
        {
            view.draw(panel, diagram)?;
        }
        view.list(&list)
    })
}

/// A branch as it is drawn.
struct View<'a> {
    branch: &'a Branch,
    /// The points before and behind the first limit point, which is in both.
    sides: [Vec<&'a TracePoint>; 2],
}

impl<'a> View<'a> {
    fn of(branch: &'a Branch) -> Self {
        let fold = branch.first_limit_point().unwrap_or(f64::INFINITY);
        let points: Vec<_> = branch.rows().into_iter().map(|(point, _)| point).collect();
        let side = |is_on: &dyn Fn(f64) -> bool| {
            let points = points.iter().copied();
            points.filter(|point| is_on(point.arclength)).collect()
        };
        Self {
            branch,
            sides: [side(&|at| at <= fold), side(&|at| at >= fold)],
        }
    }

    fn key(&self) -> Key {
        self.branch.key
    }

    fn legend(&self) -> Vec<Legend> {
        let line = |label, color| Legend::Line(label, Stroke::solid(color, 2.0));
        let folded = self.sides[1].len() > 1;
        let behind = Legend::Line("behind the limit point", Stroke::dashed(style::GREY, 2.0));
        [line("driver", DRIVER), line("driven pulley", DRIVEN)]
            .into_iter()
            .chain(folded.then_some(behind))
            .chain([Legend::Dot("event", style::INK)])
            .collect()
    }

    fn draw(&self, canvas: &Canvas<'_>, diagram: &Diagram) -> Drawn {
        let points = || self.sides.iter().flatten();
        let across = points().map(|point| self.across(point));
        let up = points().flat_map(|point| {
            let curves = diagram.curves.iter();
            curves.map(|curve| (curve.quantity)(&point.state))
        });
        let parameter = value::name(self.key());
        let panel = Panel {
            title: diagram.title,
            axes: &[
                Axis::spanning(across, self.scale()).padded(),
                Axis::spanning(up, diagram.scale).padded(),
            ],
            descriptions: [&parameter, diagram.axis],
        };
        let chart = panel.draw(canvas, iter::empty())?;
        for (curve, labels) in diagram.curves.iter().zip(self.labels(&chart, diagram)) {
            self.curve(&chart, curve, &labels)?;
        }
        Ok(())
    }

    /// The scale of the parameter: decimal where it turns back, which has to be seen.
    fn scale(&self) -> Scale {
        match self.branch.first_limit_point() {
            Some(_) => Scale::Decimal,
            None => Scale::Parameter,
        }
    }

    /// The labels of the events on every curve of a panel.
    fn labels(&self, chart: &Chart<'_, '_>, diagram: &Diagram) -> Vec<Vec<Option<Label>>> {
        let area = chart.plotting_area();
        let dots = diagram.curves.iter().map(|curve| {
            let events = self.branch.events.iter();
            let at = events.map(|event| self.at(curve, &event.point));
            at.map(|at| style::in_px(area.map_coordinate(&at)))
                .collect()
        });
        let (across, down) = area.get_pixel_range();
        let frame = Frame {
            from: style::in_px((across.start, down.start)),
            to: style::in_px((across.end, down.end)),
        };
        labels::place(&dots.collect::<Vec<_>>(), frame)
    }

    /// Where a point is on a curve.
    fn at(&self, curve: &Curve, point: &TracePoint) -> (f64, f64) {
        (self.across(point), (curve.quantity)(&point.state))
    }

    /// A curve with the events on it.
    fn curve(&self, chart: &Chart<'_, '_>, curve: &Curve, labels: &[Option<Label>]) -> Drawn {
        let area = chart.plotting_area();
        let at = |point| self.at(curve, point);
        let [before, behind] = &self.sides;
        for (side, stroke) in [
            (before, Stroke::solid(curve.color, curve.width)),
            (behind, Stroke::dashed(curve.color, curve.width)),
        ] {
            if side.len() > 1 {
                stroke.draw(area, side.iter().map(|point| at(point)).collect())?;
            }
        }
        let face = style::face(style::SMALL, curve.color, HPos::Center);
        for (event, label) in self.branch.events.iter().zip(labels) {
            let dot = EmptyElement::at(at(&event.point))
                + Circle::new((0, 0), px(style::DOT), curve.color.filled());
            area.draw(&dot)?;
            if let Some(Label { text, offset }) = label {
                let text = Text::new(text.clone(), offset.map(px).into(), face.clone());
                area.draw(&(EmptyElement::at(at(&event.point)) + text))?;
            }
        }
        Ok(())
    }

    /// The numbered events in words.
    fn list(&self, canvas: &Canvas<'_>) -> Drawn {
        let face = style::face(style::BODY, style::INK, HPos::Left);
        for (number, event) in (1..).zip(&self.branch.events) {
            let place = value::quantity(self.key(), event.point.value, event.value_error);
            let text = format!(
                "{number}   {place}: {}",
                words::event(event.kind, self.key(), &self.branch.drive)
            );
            let height = LINE * (f64::from(number) - 0.5);
            style::write(canvas, &text, &face, [style::MARGIN, height])?;
        }
        Ok(())
    }

    fn across(&self, point: &TracePoint) -> f64 {
        self.key().reported(point.value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample_branch;

    #[test]
    fn the_branch_is_parted_at_its_limit_point() {
        let mut branch = sample_branch::folded();
        let [before, behind] = View::of(&branch).sides;
        assert_eq!(before.last(), behind.first());
        assert_eq!(before.last().unwrap().value, branch.events[2].point.value);
        branch.events.remove(2);
        assert_eq!(View::of(&branch).sides[1], [] as [&TracePoint; 0]);
        assert_eq!(View::of(&branch).legend().len(), 3);
    }

    #[test]
    fn a_parameter_over_decades_has_powers_of_ten_unless_it_turns_back() {
        let mut branch = sample_branch::folded();
        for point in &mut branch.points {
            point.value = 1e5 * 10_f64.powf(5.0 * point.arclength);
        }
        let stiffness = |branch: &Branch| figure(branch).contains("\n1e5\n");
        assert!(!stiffness(&branch));
        branch.events.clear();
        assert!(stiffness(&branch));
    }

    #[test]
    fn events_at_one_place_have_one_label() {
        let mut branch = sample_branch::folded();
        branch.events[1].point = branch.events[0].point.clone();
        assert!(figure(&branch).contains("\n1, 2\n"));
    }

    #[test]
    fn a_branch_of_one_state_has_a_figure() {
        let mut branch = sample_branch::folded();
        branch.points.truncate(1);
        branch.events.clear();
        assert!(figure(&branch).contains("Efficiency"));
    }
}
