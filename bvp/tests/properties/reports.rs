//! What a person is told of a solution.

use crate::failures::growth;
use bvp::{Constant, Control, Ends, Function, Options, Problem, Real, Segment, Solution, solve};
use std::{env, fs, path::Path};

/// The lines of a report, without the time at their end.
pub(crate) fn report(solution: &Solution) -> Vec<String> {
    let report = solution.report().to_string();
    assert!(
        report.lines().all(|line| line.chars().count() <= 80),
        "{report}"
    );
    let seconds = format!(", {:.1e} s", solution.stats().seconds);
    let report = report.strip_suffix(&seconds).expect("the time");
    report.lines().map(str::to_owned).collect()
}

/// Segment 0: y' = 1. Segment 1, from 2 to 3: y₁' = 0 and the layer y₂' = −200 y₂, p = y₁.
fn layer(skip: bool) -> Solution {
    let mut problem = growth();
    problem.segments = vec![Segment::new(1), Segment::on(2, 2.0, 3.0)];
    problem.parameters = 1;
    problem.condition_count = 4;
    problem.rhs = |segment, _, y, _, dy| {
        if segment == 0 {
            dy[0] = 1.0;
        } else {
            dy[0] = 0.0;
            dy[1] = -200.0 * y[1];
        }
    };
    problem.conditions = |at, p, r| {
        r[0] = at.start(0)[0];
        r[1] = at.start(1)[0] - at.end(0)[0];
        r[2] = at.start(1)[1] - 1.0;
        r[3] = p[0] - at.end(1)[0];
    };
    let guess = Function {
        state: |segment: usize, _: f64| vec![1.0; segment + 1],
        parameters: vec![1.0],
    };
    let options = Options {
        control: if skip {
            Control::Defect
        } else {
            Control::Error
        },
        ..Options::default()
    };
    solve(&problem, &guess, &options).expect("a linear problem")
}

#[test]
fn a_report_says_what_is_known_and_where() {
    let solution = layer(false);
    let lines = report(&solution);
    let stats = solution.stats();
    let intervals = solution.mesh(0).len() + solution.mesh(1).len() - 2;
    assert_eq!(
        lines[0],
        format!(
            "Gauss, 7 stages: {intervals} intervals in 2 segments, meshes tried: {}",
            stats.meshes
        )
    );
    let estimate = solution.error_estimate().unwrap();
    assert_eq!(
        lines[1],
        format!("error       {estimate:.1e}, estimated, relative: component 1 of segment 1")
    );
    let defects = solution.defects(1);
    let worst = (0..defects.len())
        .max_by(|&i, &j| defects[i].total_cmp(&defects[j]))
        .unwrap();
    let defect = format!(
        "defect      {:.1e}, relative: segment 1, s = ",
        defects[worst]
    );
    let place = lines[2].strip_prefix(&defect).expect(&lines[2]);
    let ends: Vec<f64> = place.split(" to ").map(|s| s.parse().unwrap()).collect();
    for (shown, exact) in ends.iter().zip(&solution.mesh(1)[worst..]) {
        assert!((shown - exact).abs() <= 5e-6 * exact, "{place}");
    }
    let residual = solution.condition_residual();
    let condition = lines[3].strip_prefix(&format!(
        "conditions  {residual:.1e}, the largest residual: condition "
    ));
    assert!(
        condition.is_some_and(|index| index.parse().is_ok_and(|i: usize| i < 4)),
        "{}",
        lines[3]
    );
    let (rhs, jacobians) = (stats.rhs_evaluations, stats.jacobian_evaluations);
    assert_eq!(
        lines[4],
        format!("cost        {rhs} right-hand sides, {jacobians} Jacobians,")
    );
    let (factorisations, steps) = (stats.factorisations, stats.newton_steps);
    assert_eq!(
        lines[5],
        format!("            {factorisations} factorisations, {steps} Newton steps")
    );
    assert_eq!(lines.len(), 6);
}

#[test]
fn an_error_that_was_not_estimated_is_not_known() {
    assert_eq!(
        report(&layer(true))[1],
        "error       not known, no estimate"
    );
}

/// Bratu's problem, the first one of the guide.
struct Bratu;

impl Problem for Bratu {
    fn segments(&self) -> Vec<Segment> {
        vec![Segment::on(2, 0.0, 1.0)]
    }

    fn rhs<T: Real>(&self, _segment: usize, _s: T, y: &[T], _p: &[T], dy: &mut [T]) {
        dy[0] = y[1];
        dy[1] = -y[0].exp();
    }

    fn conditions<T: Real>(&self, at: Ends<'_, T>, _p: &[T], r: &mut [T]) {
        r[0] = at.start(0)[0];
        r[1] = at.end(0)[0];
    }
}

/// The report in the documentation is that of the first solution of the guide, but for its time. With
/// `UPDATE_DOCS=1` it is written again.
#[test]
fn the_documented_report_is_what_is_printed() {
    let guess = Constant {
        states: vec![vec![0.0; 2]],
        parameters: vec![],
    };
    let solution = solve(&Bratu, &guess, &Options::to(1e-6)).expect("Bratu's problem");
    let printed = report(&solution);
    for (file, comment) in [
        ("guide/other_solvers.rs", "//! "),
        ("result/report.rs", "    /// "),
    ] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("src").join(file);
        let text = fs::read_to_string(&path).unwrap();
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let first = lines
            .iter()
            .position(|line| line.starts_with(&format!("{comment}Gauss, ")))
            .expect("the first line of a report");
        let shown = &mut lines[first..first + printed.len()];
        for (line, printed) in shown.iter_mut().zip(&printed) {
            let time = line.rfind(", ").filter(|_| line.ends_with(" s"));
            let time = time.map_or(String::new(), |at| line[at..].to_owned());
            let anew = format!("{comment}{printed}{time}");
            if env::var_os("UPDATE_DOCS").is_none() {
                assert_eq!(*line, anew, "{file}: UPDATE_DOCS=1 writes it again");
            }
            *line = anew;
        }
        if env::var_os("UPDATE_DOCS").is_some() {
            fs::write(&path, lines.join("\n") + "\n").unwrap();
        }
    }
}
