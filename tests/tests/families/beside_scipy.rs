//! The same problems solved by `SciPy`, which asks this program for every right-hand side.

use crate::trial::Trial;
use bvp::{Ends, Equations, Guess, Segment};
use std::io::{BufRead, BufReader, Read, Result, Write};
use std::path::PathBuf;
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// Nodes of the mesh that `SciPy` begins with: the ten intervals of `bvp::Options`.
const NODES: usize = 11;

/// A process with `SciPy`; see benches/scipy/served.py.
pub(crate) struct SciPy {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

/// A solution of `SciPy`: cubic between the nodes.
struct Cubic {
    nodes: Vec<f64>,
    /// States and slopes, a row of nodes for every state.
    states: Vec<f64>,
    slopes: Vec<f64>,
    parameters: Vec<f64>,
}

impl Guess for Cubic {
    fn state(&self, _segment: usize, s: f64, y: &mut [f64]) {
        let count = self.nodes.len();
        let i = self
            .nodes
            .partition_point(|&node| node <= s)
            .clamp(1, count - 1)
            - 1;
        let h = self.nodes[i + 1] - self.nodes[i];
        let t = (s - self.nodes[i]) / h;
        for (k, y) in y.iter_mut().enumerate() {
            let (left, right) = (self.states[k * count + i], self.states[k * count + i + 1]);
            let (from, to) = (
                h * self.slopes[k * count + i],
                h * self.slopes[k * count + i + 1],
            );
            let rise = right - left;
            *y = left
                + t * (from + t * (3.0 * rise - 2.0 * from - to + t * (from + to - 2.0 * rise)));
        }
    }

    fn parameters(&self, p: &mut [f64]) {
        p.copy_from_slice(&self.parameters);
    }
}

impl SciPy {
    /// Starts Python: `$SCIPY_ENV/bin/python`, or that of target/scipy, which benches/scipy/run.sh makes.
    pub(crate) fn start() -> Result<Self> {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("..");
        let environment = std::env::var_os("SCIPY_ENV").map(PathBuf::from);
        let environment = environment.unwrap_or_else(|| root.join("target/scipy"));
        let mut child = Command::new(environment.join("bin/python"))
            .arg(root.join("benches/scipy/served.py"))
            .envs([("OMP_NUM_THREADS", "1"), ("OPENBLAS_NUM_THREADS", "1")])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        let (input, output) = (child.stdin.take(), child.stdout.take());
        let (input, output) = (
            input.expect("a pipe"),
            BufReader::new(output.expect("a pipe")),
        );
        Ok(Self {
            child,
            input,
            output,
        })
    }

    /// Solves a problem of one segment; `None` where `SciPy` reports a failure.
    pub(crate) fn solve(
        &mut self,
        trial: &Trial,
        tolerance: f64,
    ) -> Result<Option<impl Guess + use<>>> {
        let shape = trial.equations.shape();
        let (segment, k) = (&shape.segments[0], shape.parameters);
        let n = segment.states;
        let nodes: Vec<f64> = uniform(segment);
        let mut states = vec![0.0; n * NODES];
        let mut y = vec![0.0; n];
        for (j, &x) in nodes.iter().enumerate() {
            trial.guess.state(0, x, &mut y);
            y.iter()
                .enumerate()
                .for_each(|(i, y)| states[i * NODES + j] = *y);
        }
        let mut p = vec![0.0; k];
        trial.guess.parameters(&mut p);
        writeln!(self.input, "problem {n} {k} {NODES} {tolerance:e}")?;
        self.write(&[&nodes[..], &states, &p].concat())?;
        loop {
            let mut line = String::new();
            self.output.read_line(&mut line)?;
            let mut words = line.split_whitespace();
            let what = words.next().unwrap_or_default().to_owned();
            let count = words
                .next()
                .map_or(0, |word| word.parse().expect("a number of nodes"));
            match what.as_str() {
                "rhs" | "jacobian" => {
                    let (x, y, p) = (self.read(count)?, self.read(n * count)?, self.read(k)?);
                    let answer =
                        right_hand_sides(&*trial.equations, n, &x, &y, &p, what == "jacobian");
                    self.write(&answer)?;
                }
                "ends" | "end-jacobian" => {
                    let (ends, p) = (self.read(2 * n)?, self.read(k)?);
                    let answer = conditions(
                        &*trial.equations,
                        &shape.segments,
                        &ends,
                        &p,
                        what != "ends",
                    );
                    self.write(&answer)?;
                }
                "solved" | "refused" => {
                    let found = Cubic {
                        nodes: self.read(count)?,
                        states: self.read(n * count)?,
                        slopes: self.read(n * count)?,
                        parameters: self.read(k)?,
                    };
                    return Ok((what == "solved").then_some(found));
                }
                _ => panic!("SciPy says {line:?}"),
            }
        }
    }

    fn read(&mut self, count: usize) -> Result<Vec<f64>> {
        let mut bytes = vec![0; 8 * count];
        self.output.read_exact(&mut bytes)?;
        let numbers = bytes
            .chunks_exact(8)
            .map(|b| f64::from_le_bytes(b.try_into().expect("8 bytes")));
        Ok(numbers.collect())
    }

    fn write(&mut self, numbers: &[f64]) -> Result<()> {
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        self.input.write_all(&bytes)?;
        self.input.flush()
    }
}

impl Drop for SciPy {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Equal intervals.
fn uniform(segment: &Segment) -> Vec<f64> {
    let step = (segment.to - segment.from) / (NODES - 1) as f64;
    let mut nodes: Vec<f64> = (0..NODES).map(|i| segment.from + step * i as f64).collect();
    nodes[NODES - 1] = segment.to;
    nodes
}

/// f, or its derivatives by states and then by parameters, the place the last index.
fn right_hand_sides(
    equations: &dyn Equations,
    n: usize,
    x: &[f64],
    y: &[f64],
    p: &[f64],
    jacobian: bool,
) -> Vec<f64> {
    let (m, k) = (x.len(), p.len());
    let mut all = vec![0.0; if jacobian { n * (n + k) * m } else { n * m }];
    let (mut dy, mut derivatives) = (vec![0.0; n], vec![0.0; n * (n + k)]);
    for (j, &x) in x.iter().enumerate() {
        let at: Vec<f64> = (0..n).map(|i| y[i * m + j]).collect();
        if !jacobian {
            equations.evaluate_rhs(0, x, &at, p, &mut dy);
            dy.iter()
                .enumerate()
                .for_each(|(i, dy)| all[i * m + j] = *dy);
            continue;
        }
        equations.rhs_jacobian(0, x, &at, p, &mut dy, &mut derivatives);
        for (row, values) in derivatives.chunks_exact(n + k).enumerate() {
            for (column, value) in values.iter().enumerate() {
                let block = if column < n {
                    row * n + column
                } else {
                    n * n + row * k + column - n
                };
                all[block * m + j] = *value;
            }
        }
    }
    all
}

/// g, or its derivatives by the left end, the right end and the parameters.
fn conditions(
    equations: &dyn Equations,
    segments: &[Segment],
    ends: &[f64],
    p: &[f64],
    jacobian: bool,
) -> Vec<f64> {
    let (n, k) = (ends.len() / 2, p.len());
    let mut r = vec![0.0; n + k];
    if !jacobian {
        equations.evaluate_conditions(Ends::new(segments, ends), p, &mut r);
        return r;
    }
    let mut derivatives = vec![0.0; (n + k) * (2 * n + k)];
    equations.conditions_jacobian(Ends::new(segments, ends), p, &mut r, &mut derivatives);
    let block = |from: usize, to: usize| {
        let rows = derivatives.chunks_exact(2 * n + k);
        rows.flat_map(|row| row[from..to].to_vec())
            .collect::<Vec<f64>>()
    };
    [block(0, n), block(n, 2 * n), block(2 * n, 2 * n + k)].concat()
}
