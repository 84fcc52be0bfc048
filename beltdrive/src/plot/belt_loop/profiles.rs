//! Quantities along the whole loop, one figure each.

use super::super::axis::{Axis, Scale};
use super::super::header::{Header, Legend};
use super::super::panel::{LEFT, Panel};
use super::super::profile_figures::{self, Curve, Figure, pieces};
use super::super::style::{self, px};
use super::{kinds, names};
use crate::belt_loop::{BeltLoop, LoopState};
use crate::{Profile, ZoneKind};
use plotters::prelude::*;

/// Width and height of the figures, px, without the header and the names.
const WIDTH: f64 = 1100.0;
const PANEL: f64 = 460.0;

/// The figures of all quantities along a loop, each with the name of its file.
pub(in super::super) fn figures(
    belt_loop: &BeltLoop,
    state: &LoopState,
) -> Vec<(&'static str, String)> {
    let along = Along::of(belt_loop, state);
    let figures = profile_figures::of(&belt_loop.belt).iter();
    let figures = figures.map(|figure| (figure.file, along.figure(figure)));
    figures.collect()
}

/// The contacts of a loop at their places along the belt, from the entry of the first one.
struct Along<'a> {
    belt_loop: &'a BeltLoop,
    state: &'a LoopState,
    contacts: Vec<Contact>,
    /// Length of the loop, m.
    length: f64,
}

/// A contact; lengths along the belt in m.
struct Contact {
    profile: Profile,
    /// Places of the points of the profile.
    places: Vec<f64>,
    zones: Vec<(ZoneKind, [f64; 2])>,
}

impl<'a> Along<'a> {
    fn of(belt_loop: &'a BeltLoop, state: &'a LoopState) -> Self {
        let mut length = 0.0;
        let contacts = state.pulleys.iter().zip(&state.spans).enumerate();
        let contacts = contacts.map(|(index, (pulley, span))| {
            let profile = state.profile(index);
            let start = profile.arc_length.first().copied().unwrap_or(0.0);
            let places = profile.arc_length.iter();
            let places: Vec<_> = places.map(|arc| length + arc - start).collect();
            let at = |angle| interpolated(&profile.angle, &places, angle);
            let zones = pulley.zones.iter();
            let zones = zones.map(|zone| (zone.kind, [zone.from, zone.to].map(at)));
            let zones = zones.collect();
            length = places.last().copied().unwrap_or(length) + span.length;
            Contact {
                profile,
                places,
                zones,
            }
        });
        let contacts = contacts.collect();
        Self {
            belt_loop,
            state,
            contacts,
            length,
        }
    }

    fn figure(&self, figure: &Figure) -> String {
        let curves: Vec<_> = figure
            .curves
            .iter()
            .map(|curve| self.curve(figure, curve))
            .collect();
        let values = curves.iter().flatten().flatten().map(|(_, value)| *value);
        let axes = [
            Axis::spanning([0.0, self.length].into_iter(), Scale::Decimal),
            Axis::spanning(values, figure.scale).padded(),
        ];
        let header = Header::of_loop(self.belt_loop, figure.title);
        let names = names::placed(&self.names(), WIDTH);
        let top = header.height(WIDTH) + names::height(&names);
        style::render([WIDTH, top + PANEL], |canvas| {
            header.draw(canvas, &self.legend(figure))?;
            let (_, below) = canvas.split_vertically(px(top));
            let panel = Panel {
                title: "",
                axes: &axes,
                descriptions: ["distance along the belt in m", figure.axis],
            };
            let [_, up] = &axes;
            let zones = self.contacts.iter().flat_map(|contact| &contact.zones);
            let zones = zones.map(|(kind, [from, to])| {
                Rectangle::new([(*from, up.from), (*to, up.to)], style::tint(*kind))
            });
            let chart = panel.draw(&below, zones)?;
            for (curve, points) in figure.curves.iter().zip(&curves) {
                for piece in points {
                    curve.stroke.draw(chart.plotting_area(), piece.clone())?;
                }
            }
            names.iter().try_for_each(|name| name.draw(canvas, top))
        })
    }

    /// The pieces of a curve, m and the unit of the figure. Between pulleys a quantity that spans have is
    /// that at the exit.
    fn curve(&self, figure: &Figure, curve: &Curve) -> Vec<Vec<(f64, f64)>> {
        let contacts = self.contacts.iter().zip(&self.belt_loop.pulleys);
        let contacts = contacts.map(|(contact, pulley)| {
            let values = (curve.values)(pulley.friction_coefficient, &contact.profile);
            contact
                .places
                .iter()
                .copied()
                .zip(values)
                .collect::<Vec<_>>()
        });
        if figure.on_spans {
            let mut points: Vec<_> = contacts.flatten().collect();
            let end = points.last().map(|(_, value)| (self.length, *value));
            points.extend(end);
            pieces(figure.scale, &points)
        } else {
            contacts
                .flat_map(|points| pieces(figure.scale, &points))
                .collect()
        }
    }

    fn legend(&self, figure: &Figure) -> Vec<Legend> {
        let curves = figure.curves.iter();
        let curves = curves.map(|curve| Legend::Line(curve.label, curve.stroke));
        let zones =
            kinds(self.state).map(|kind| Legend::Shade(style::zone(kind).0, style::tint(kind)));
        curves.chain(zones).collect()
    }

    /// The names of the pulleys with the places of their contacts on the sheet, px.
    fn names(&self) -> Vec<(&str, f64)> {
        let scale = (WIDTH - LEFT - style::MARGIN) / self.length;
        let pulleys = self.contacts.iter().zip(&self.state.pulleys);
        let names = pulleys.map(|(contact, pulley)| {
            let ends = [contact.places.first(), contact.places.last()];
            let middle: f64 = ends.into_iter().flatten().map(|end| 0.5 * end).sum();
            (pulley.name.as_str(), LEFT + scale * middle)
        });
        names.collect()
    }
}

/// The value at a place between points whose places grow; at the ends of the points beyond them.
pub(super) fn interpolated(places: &[f64], values: &[f64], place: f64) -> f64 {
    let next = places.partition_point(|other| *other < place);
    match (next.checked_sub(1), places.get(next)) {
        (Some(last), Some(to)) => {
            let from = places[last];
            let part = (place - from) / (to - from);
            values[last] + part * (values[next] - values[last])
        }
        (Some(last), None) => values[last],
        (None, _) => values.first().copied().unwrap_or(0.0),
    }
}
