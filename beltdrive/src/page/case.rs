//! A load case: the drive to scale, its numbers, the belt along the pulleys, and how accurate that is.

use crate::belt_loop::LoopState;
use crate::plot::state_figures;
use crate::quantity::{Answer, UnitSystem};
use crate::report::tables;
use crate::{CheckedCase, LoadCase};
use maud::{Markup, PreEscaped, html};

/// A load case that has a state, which an answer describes.
pub(super) fn case(
    stated: &LoadCase,
    found: &CheckedCase,
    answer: &Answer,
    units: UnitSystem,
) -> Markup {
    let figures = state_figures(answer);
    let mut figures = figures
        .iter()
        .map(|(_, svg)| html! { figure { (PreEscaped(svg)) } });
    html! {
        section {
            h2 { "Load case: " (stated.name) }
            @if let Some(layout) = figures.next() { (layout) }
            (tables(answer, units))
            @for profiles in figures { (profiles) }
            @if let Ok(found) = &found.outcome { (accuracy(&found.state)) }
        }
    }
}

/// The checks that the state has passed.
fn accuracy(state: &LoopState) -> Markup {
    html! {
        h3 { "Checks of this state" }
        table {
            thead { tr { th {} th { "deviation" } th { "allowed" } th { "holds" } } }
            tbody {
                @for check in &state.checks {
                    tr {
                        th scope="row" { (check.name) }
                        td { (format!("{:.1e}", check.deviation)) }
                        td { (format!("{:.1e}", check.limit)) }
                        td { (if check.holds() { "yes" } else { "no" }) }
                    }
                }
            }
        }
    }
}
