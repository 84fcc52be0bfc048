//! The eigenvalues of all forms in the complex plane.

use super::super::axis::{Axis, Scale};
use super::super::header::{Header, Mark, Sign};
use super::super::occupied::Frame;
use super::super::panel::{Panel, grid};
use super::super::sheet::{
    Anchor, Color, GREY, INK, PALETTE, SMALL, Sheet, Stroke, VERMILION, spot,
};
use super::heading;
use crate::quantity::stability::form_label;
use crate::{FormStability, LinearisedForm, PulleyStability, Stability};

/// Width of the figure and height of its panels, px.
const WIDTH: f64 = 1100.0;
const PANELS: f64 = 540.0;

/// Numbers of modes are no closer, px.
const CLOSE: f64 = 14.0;

const LIMIT: Stroke = Stroke::dashed(GREY, 1.0);

/// The figure: the driver on the left, the driven pulley on the right.
pub(super) fn figure(stability: &Stability) -> String {
    let signs = LinearisedForm::ALL.map(|form| {
        let (sign, color) = marker(form);
        (form_label(form).to_owned(), Mark::Sign(sign, color))
    });
    let limit = ("limits of high modes".to_owned(), Mark::Line(LIMIT));
    let legend = signs.into_iter().chain([limit]);
    let caption = "Eigenvalues λ of the axial motion";
    let header = Header::new(&heading(stability), caption, legend, WIDTH);
    let size = spot(WIDTH, header.height + PANELS);
    let mut sheet = Sheet::new(size);
    header.draw(&mut sheet);
    let below = Frame {
        from: spot(0.0, header.height),
        to: size,
    };
    let pulleys = [
        ("driver", &stability.driver),
        ("driven pulley", &stability.driven),
    ];
    for ((name, on), part) in pulleys.into_iter().zip(grid(below, 2, 2)) {
        panel(&mut sheet, part, name, on);
    }
    sheet.finish()
}

/// How an eigenvalue of a form is drawn.
fn marker(form: LinearisedForm) -> (Sign, Color) {
    match form {
        LinearisedForm::Thesis => (Sign::Dot, VERMILION),
        LinearisedForm::NaturalOutlet => (Sign::Cross, PALETTE[1]),
        LinearisedForm::Conservative => (Sign::Square, INK),
    }
}

fn panel(sheet: &mut Sheet, part: Frame, name: &str, on: &PulleyStability) {
    let modes = || on.forms.iter().flat_map(|form| &form.modes);
    let limits = on.forms.iter().map(|form| form.high_mode_limit);
    let across: Vec<_> = modes().map(|mode| mode.growth).chain(limits).collect();
    let widest = across.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    // The line at Re λ = 0 has room on both sides.
    let room = [-0.1 * widest, 0.1 * widest].into_iter();
    let up = modes().map(|mode| mode.frequency).chain([0.0]);
    let axes = [
        across.iter().copied().chain(room).collect::<Vec<_>>(),
        up.collect(),
    ];
    let panel = Panel {
        title: format!("{name}: {}", verdicts(&on.forms)),
        axes: axes.map(|values| Axis::spanning(values.into_iter(), Scale::Decimal).padded()),
        descriptions: [
            "rate of growth Re λ in 1/s",
            "angular frequency Im λ in rad/s",
        ]
        .map(str::to_owned),
    };
    let chart = panel.draw(sheet, part, []);
    let Frame { from, to } = chart.frame;
    let upright = |sheet: &mut Sheet, at: f64, stroke| {
        let at = chart.at(at, 0.0).x;
        sheet.line(&[spot(at, from.y), spot(at, to.y)], stroke);
    };
    upright(sheet, 0.0, Stroke::solid(INK, 1.5));
    // The conservative form, which lies on the line, is below the others.
    for form in on.forms.iter().rev() {
        let (sign, color) = marker(form.form);
        if form.high_mode_limit != 0.0 {
            upright(sheet, form.high_mode_limit, Stroke { color, ..LIMIT });
        }
        for mode in &form.modes {
            sign.draw(sheet, chart.at(mode.growth, mode.frequency), color);
        }
    }
    // The numbers of the modes stand beyond the right border.
    let mut number = |text: &str, down: f64| {
        sheet.text(text, SMALL, GREY, Anchor::Middle, spot(to.x + 11.0, down));
    };
    let mut last = f64::INFINITY;
    for (index, mode) in on.forms[0].modes.iter().enumerate() {
        let down = chart.at(0.0, mode.frequency).y;
        if last - down >= CLOSE {
            last = down;
            number(&(index + 1).to_string(), down);
        }
    }
    sheet.text(
        "mode",
        SMALL,
        GREY,
        Anchor::End,
        spot(to.x + 18.0, from.y - 10.0),
    );
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
        crate::plot::tests::check(&text);
        assert!(text.contains("driver: growth with natural outlet"));
        assert!(text.contains("driven pulley: no growth"));
        for form in LinearisedForm::ALL {
            assert!(text.contains(&format!(">{}<", form_label(form))));
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
