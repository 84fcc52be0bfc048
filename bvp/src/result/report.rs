//! A solution in a few lines.

use crate::discretisation::scheme::Scheme;
use crate::result::solution::Solution;
use std::fmt;

/// What [`Solution::report`] prints.
#[derive(Clone, Copy, Debug)]
struct Report<'a>(&'a Solution);

impl Solution {
    /// The accuracy of a solution and its cost, for printing: a few lines of at most 80 columns. For
    /// an iterate that did not converge it says so.
    ///
    /// ```text
    /// Gauss, 7 stages: 3 intervals in 1 segment, meshes tried: 1
    /// error       1.8e-10, estimated, relative: component 1 of segment 0
    /// defect      6.6e-10, relative: segment 0, s = 0.666667 to 1.0
    /// conditions  0.0e0, the largest residual: condition 1
    /// cost        222 right-hand sides, 42 Jacobians,
    ///             2 factorisations, 5 Newton steps, 1.4e-4 s
    /// ```
    pub fn report(&self) -> impl fmt::Display + '_ {
        Report(self)
    }
}

impl fmt::Display for Report<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (solution, stats) = (self.0, self.0.stats());
        let (name, stages) = match solution.scheme() {
            Scheme::Gauss { stages } => ("Gauss", stages),
            Scheme::LobattoIIIA { stages } => ("Lobatto IIIA", stages),
        };
        let segments = solution.segments().len();
        let intervals: usize = (0..segments).map(|i| solution.mesh(i).len() - 1).sum();
        writeln!(
            f,
            "{name}, {}: {} in {}, meshes tried: {}",
            counted(stages, "stage"),
            counted(intervals, "interval"),
            counted(segments, "segment"),
            stats.meshes,
        )?;
        if let Some((error, place)) = self.largest_error() {
            writeln!(f, "error       {error:.1e}, estimated, relative: {place}")?;
        } else {
            writeln!(f, "error       not known, no estimate")?;
        }
        if solution.defect().is_finite() {
            let (segment, s, length) = solution.worst_interval();
            let [from, to] = [s, s + length].map(short);
            let defect = solution.defect();
            writeln!(
                f,
                "defect      {defect:.1e}, relative: segment {segment}, s = {from} to {to}"
            )?;
        } else {
            writeln!(f, "defect      not known: this iterate did not converge")?;
        }
        let conditions = solution.quality.conditions.iter().enumerate();
        if let Some((index, r)) = conditions.max_by(|a, b| a.1.total_cmp(b.1)) {
            writeln!(
                f,
                "conditions  {r:.1e}, the largest residual: condition {index}"
            )?;
        } else {
            writeln!(f, "conditions  not known")?;
        }
        writeln!(
            f,
            "cost        {}, {},",
            counted(stats.rhs_evaluations, "right-hand side"),
            counted(stats.jacobian_evaluations, "Jacobian"),
        )?;
        let factorisations = counted(stats.factorisations, "factorisation");
        let steps = counted(stats.newton_steps, "Newton step");
        let seconds = stats.seconds;
        write!(f, "            {factorisations}, {steps}, {seconds:.1e} s")
    }
}

impl Report<'_> {
    /// The largest estimated error and the unknown that has it.
    fn largest_error(&self) -> Option<(f64, String)> {
        let solution = self.0;
        let mut all = vec![];
        for segment in 0..solution.segments().len() {
            for (component, error) in solution.state_errors(segment)?.iter().enumerate() {
                all.push((
                    *error,
                    format!("component {component} of segment {segment}"),
                ));
            }
        }
        for (parameter, error) in solution.parameter_errors()?.iter().enumerate() {
            all.push((*error, format!("parameter {parameter}")));
        }
        all.into_iter().max_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// A number of things.
fn counted(count: usize, thing: &str) -> String {
    format!("{count} {thing}{}", if count == 1 { "" } else { "s" })
}

/// A number with six digits, as short as they allow.
fn short(x: f64) -> String {
    let rounded = format!("{x:.5e}").parse::<f64>().unwrap_or(x);
    format!("{rounded:?}")
}
