//! A panel of a figure: axes with a grid under a title.

use super::axis::Axis;
use super::style::{self, Canvas, Stroke, px};
use plotters::coord::cartesian::Cartesian2d;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::*;
use plotters::style::text_anchor::HPos;
use std::io;

/// Where the vertical axis stands and where its description may begin, px.
pub(super) const LEFT: f64 = 92.0;
const EDGE: f64 = 16.0;

/// How far the frame of the axes is below the top of the panel, px.
pub(super) const TOP: f64 = 24.0;

/// What a panel shows besides its curves.
pub(super) struct Panel<'a> {
    /// Written above the panel.
    pub(super) title: &'a str,
    /// The horizontal and the vertical axis.
    pub(super) axes: &'a [Axis; 2],
    /// What the axes measure.
    pub(super) descriptions: [&'a str; 2],
}

/// A panel that curves can be drawn into.
pub(super) type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;

impl Panel<'_> {
    /// Draws the panel with shaded rectangles below its grid.
    pub(super) fn draw<'a, 'b>(
        &self,
        canvas: &'a Canvas<'b>,
        shades: impl Iterator<Item = Rectangle<(f64, f64)>>,
    ) -> Result<Chart<'a, 'b>, DrawingAreaErrorKind<io::Error>> {
        let title = style::face(style::BODY, style::INK, HPos::Left);
        style::write(canvas, self.title, &title, [LEFT, 12.0])?;
        let [across, up] = self.axes;
        let mut chart = ChartBuilder::on(canvas)
            .margin_top(px(TOP))
            .margin_left(px(EDGE))
            .margin_right(px(style::MARGIN))
            .margin_bottom(px(10.0))
            .set_label_area_size(LabelAreaPosition::Left, px(LEFT - EDGE))
            .set_label_area_size(LabelAreaPosition::Bottom, px(46.0))
            .build_cartesian_2d(across.clone(), up.clone())?;
        chart.draw_series(shades)?;
        let [x_description, y_description] = self.descriptions;
        chart
            .configure_mesh()
            .bold_line_style(style::INK.mix(0.15).stroke_width(px(0.6).unsigned_abs()))
            .axis_style(Stroke::solid(style::INK, 1.0).shape())
            .set_all_tick_mark_size(px(5.0))
            .label_style(style::face(style::SMALL, style::INK, HPos::Center))
            .axis_desc_style(style::face(style::BODY, style::INK, HPos::Center))
            .x_desc(x_description)
            .y_desc(y_description)
            .draw()?;
        Ok(chart)
    }
}
