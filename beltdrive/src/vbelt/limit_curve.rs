//! The limit of one entry over a second one: a design chart.

use super::chart::Chart;
use crate::input::Key;
use crate::{Drive, LimitCurve, SolveError, SolveOptions};
use web_time::Instant;

/// The limit of one entry of a V-belt drive over a second one.
pub(crate) fn limit_curve(
    drive: &Drive,
    key: &Key,
    second: &Key,
    range: [f64; 2],
    options: &SolveOptions,
    progress: &mut dyn FnMut(f64, &str),
) -> Result<LimitCurve, SolveError> {
    let start = Instant::now();
    let mut chart = Chart::new(drive, [*key, *second], range, options)?;
    let end = chart.trace(progress)?;
    chart.convergence.seconds = start.elapsed().as_secs_f64();
    Ok(LimitCurve {
        key: *key,
        second: *second,
        drive: drive.clone(),
        points: chart.points,
        cusps: chart.cusps,
        end,
        convergence: chart.convergence,
    })
}
