//! The eigenvalues of all forms in the complex plane.

use super::super::axis::{Axis, Scale};
use super::super::header::Header;
use super::super::panel::Panel;
use super::super::style::{self, Canvas, Drawn, MARGIN, Stroke, px};
use crate::quantity::stability::form_label;
use crate::{FormStability, LinearisedForm, PulleyStability, Stability};
use plotters::coord::CoordTranslate;
use plotters::coord::cartesian::Cartesian2d;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;

/// Width of the figure and height of its panels, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 540.0;

/// Height of the legend above the bottom of the header, px.
const LEGEND: f64 = 20.0;

/// Numbers of modes are no closer than this share of the vertical axis.
const CLOSE: f64 = 0.03;

/// Half the size of a marker, px.
const SIZE: f64 = 5.0;

/// The figure: the driver on the left, the driven pulley on the right.
pub(super) fn figure(stability: &Stability) -> String {
    let header = Header::new(&stability.drive, &[], "Eigenvalues λ of the axial motion");
    let top = header.height(WIDTH);
    style::render([WIDTH, top + PANELS], |canvas| {
        header.draw(canvas, &[])?;
        legend(canvas, top - LEGEND)?;
        let (_, below) = canvas.split_vertically(px(top));
        let panels = below.split_evenly((1, 2));
        panel(&panels[0], "driver", &stability.driver)?;
        panel(&panels[1], "driven pulley", &stability.driven)
    })
}

/// What is drawn into.
type Area<'b> = DrawingArea<SVGBackend<'b>, Cartesian2d<Axis, Axis>>;

fn color(form: LinearisedForm) -> RGBColor {
    match form {
        LinearisedForm::Thesis => style::VERMILION,
        LinearisedForm::NaturalOutlet => style::BLUE,
        LinearisedForm::Conservative => style::INK,
    }
}

/// A circle, a cross or a square, as the form is.
fn marker<C: CoordTranslate>(
    area: &DrawingArea<SVGBackend<'_>, C>,
    form: LinearisedForm,
    at: C::From,
) -> Drawn
where
    C::From: Clone,
{
    let (size, color) = (px(SIZE), color(form));
    let line = Stroke::solid(color, 1.5).shape();
    match form {
        LinearisedForm::Thesis => {
            area.draw(&(EmptyElement::at(at) + Circle::new((0, 0), size, color.filled())))
        }
        LinearisedForm::NaturalOutlet => area.draw(
            &(EmptyElement::at(at)
                + PathElement::new([(-size, -size), (size, size)], line)
                + PathElement::new([(-size, size), (size, -size)], line)),
        ),
        LinearisedForm::Conservative => {
            let around = [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)];
            let around = around.map(|(x, y)| (x * size, y * size));
            area.draw(&(EmptyElement::at(at) + PathElement::new(around, line)))
        }
    }
}

fn legend(canvas: &Canvas<'_>, middle: f64) -> Drawn {
    let face = style::face(style::BODY, style::INK, HPos::Left);
    let mut left = MARGIN + SIZE;
    for form in LinearisedForm::ALL {
        marker(canvas, form, (px(left), px(middle)))?;
        style::write(canvas, form_label(form), &face, [left + 14.0, middle])?;
        left += 50.0 + 0.55 * style::BODY * form_label(form).chars().count() as f64;
    }
    let [from, to] = [left, left + 30.0];
    LIMIT.draw(canvas, vec![(px(from), px(middle)), (px(to), px(middle))])?;
    style::write(canvas, "limits of high modes", &face, [to + 8.0, middle])
}

const LIMIT: Stroke = Stroke::dashed(style::GREY, 1.0);

fn panel(canvas: &Canvas<'_>, name: &str, on: &PulleyStability) -> Drawn {
    let modes = || on.forms.iter().flat_map(|form| &form.modes);
    let limits = on.forms.iter().map(|form| form.high_mode_limit);
    let across: Vec<_> = modes().map(|mode| mode.growth).chain(limits).collect();
    let widest = across.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    // The line at Re λ = 0 has room on both sides.
    let room = [-0.1 * widest, 0.1 * widest].into_iter();
    let axes = [
        Axis::spanning(across.iter().copied().chain(room), Scale::Decimal).padded(),
        Axis::spanning(
            modes().map(|mode| mode.frequency).chain([0.0]),
            Scale::Decimal,
        )
        .padded(),
    ];
    let title = format!("{name}: {}", verdicts(&on.forms));
    let panel = Panel {
        title: &title,
        axes: &axes,
        descriptions: [
            "rate of growth Re λ in 1/s",
            "angular frequency Im λ in rad/s",
        ],
    };
    let chart = panel.draw(canvas, std::iter::empty())?;
    let area = chart.plotting_area();
    let upright = |at: f64| vec![(at, axes[1].from), (at, axes[1].to)];
    Stroke::solid(style::INK, 1.5).draw(area, upright(0.0))?;
    // The conservative form, which lies on the line, is below the others.
    for form in on.forms.iter().rev() {
        if form.high_mode_limit != 0.0 {
            let stroke = Stroke::dashed(color(form.form), LIMIT.width);
            stroke.draw(area, upright(form.high_mode_limit))?;
        }
        for mode in &form.modes {
            marker(area, form.form, (mode.growth, mode.frequency))?;
        }
    }
    numbers(area, &axes, &on.forms[0])
}

/// The numbers of the modes at the right border.
fn numbers(area: &Area<'_>, [across, up]: &[Axis; 2], form: &FormStability) -> Drawn {
    let face = style::face(style::SMALL, style::GREY, HPos::Center);
    let text = |text: String, height: f64, offset: [f64; 2]| {
        let text = Text::new(text, offset.map(px).into(), face.clone());
        area.draw(&(EmptyElement::at((across.to, height)) + text))
    };
    text("mode".to_owned(), up.to, [4.0, -9.0])?;
    let mut last = f64::NEG_INFINITY;
    for (index, mode) in form.modes.iter().enumerate() {
        if mode.frequency - last > CLOSE * (up.to - up.from) {
            last = mode.frequency;
            text((index + 1).to_string(), last, [11.0, 0.0])?;
        }
    }
    Ok(())
}

/// Which forms grow.
fn verdicts(forms: &[FormStability; 3]) -> String {
    let growing: Vec<_> = forms
        .iter()
        .filter(|form| form.is_unstable())
        .map(|form| form_label(form.form))
        .collect();
    match growing.as_slice() {
        [] => "no growth".to_owned(),
        some => format!("growth with {}", some.join(" and ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::quantity::stability::sample;

    #[test]
    fn every_form_and_pulley_is_there() {
        let text = figure(&sample::stability());
        assert!(text.contains("driver: growth with natural outlet"));
        assert!(text.contains("driven pulley: no growth"));
        for form in LinearisedForm::ALL {
            let label = form_label(form).replace('\'', "&apos;");
            assert!(
                text.contains(&label) || text.contains(form_label(form)),
                "{label}"
            );
        }
        // Those of the modes and that of the legend.
        assert_eq!(text.matches("<circle").count(), 2 * sample::MODES + 1);
    }

    #[test]
    fn eigenvalues_on_the_axis_have_a_figure() {
        let mut stability = sample::stability();
        for form in &mut stability.driver.forms {
            form.high_mode_limit = 0.0;
            form.modes.iter_mut().for_each(|mode| mode.growth = 0.0);
        }
        assert!(!figure(&stability).contains("NaN"));
    }
}
