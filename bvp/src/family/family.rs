//! A boundary value problem with too few conditions, as a nonlinear system for a curve.

use super::layout::Layout;
use crate::accuracy::defect::defects;
use crate::discretisation::iterate::{Iterate, Residual};
use crate::newton::collocation::{Collocation, gather_ends};
use crate::newton::failure::Failure;
use crate::problem::equations::Equations;
use crate::problem::guess::Guess;
use crate::problem::held::Held;
use crate::problem::problem::Ends;
use crate::result::error::Error;
use crate::result::quality::Quality;
use crate::result::restored::{divided, from_units, restored, restored_error, to_units};
use crate::result::solution::Solution;
use crate::result::stats::Stats;
use crate::solver::failure::numerical;
use crate::solver::options::Options;
use crate::solver::solver::solve_held;
use crate::solver::statement::{check_guess_shape, check_statement, in_units};
use std::sync::Arc;

/// The solutions of a boundary value problem with one condition fewer than unknown constants: a
/// curve, discretised.
///
/// ```text
/// dy/ds = f(s, y, p)        on each segment, nᵢ states
/// g(all ends, p) = 0        Σ nᵢ + k − f conditions, k parameters, f ≥ 1 of them free
/// ```
///
/// A problem states its own number of conditions
/// ([`Problem::condition_count`](crate::Problem::condition_count)). One of the parameters is that of
/// the family, λ; f − 1 others are held at fixed values, and any may be exchanged for another in a
/// new family. On a mesh this is a system G(z) = 0 of n equations for n + 1 unknowns,
///
/// ```text
/// z = ( node states and stage slopes of every segment, parameters neither held nor λ, λ )
/// ```
///
/// in the units of the problem. Its solutions form a curve, to be followed by any method of continuation with
/// [`residual`](Self::residual), [`linearise`](Self::linearise), [`particular`](Self::particular)
/// and [`null_vector`](Self::null_vector); nothing of it fails or loses accuracy where λ turns back.
/// The mesh follows the solution by [`adapted`](Self::adapted). Between linearisations nothing is
/// allocated, but for a change of the mesh and a [`Solution`].
///
/// A segment with [joined points](crate::Segment::joined) is cut into pieces there, which stand in z one
/// after the other like segments: z has the states at a joined point twice, at the end of the piece before
/// and at the start of the piece behind. That they are equal is a condition, after those of the problem.
/// Each state of each piece is a [group](Self::groups). On a segment along which s descends the stage slopes
/// in z have the opposite sign, those with respect to −s. [`start`](Self::start), [`end`](Self::end),
/// [`mesh`](Self::mesh) and [`solution`](Self::solution) speak of the segments as they are stated.
///
/// E. J. Doedel, H. B. Keller & J. P. Kernévez, "Numerical analysis and control of bifurcation
/// problems (II)", Int. J. Bifurcation Chaos 1 (1991) 745-772: the discretised system and its mesh.
#[derive(Clone)]
pub struct Family<'a> {
    pub(super) collocation: Collocation<'a>,
    pub(super) layout: Layout,
    pub(super) options: Options,
    pub(super) stats: Stats,
    /// Calls of [`adapted`](Self::adapted) since the mesh has changed.
    pub(super) settled: usize,
    /// Whether there is a linearisation on this mesh.
    pub(super) linearised: bool,
    /// A point or a vector, in work.
    pub(super) x: Iterate,
    pub(super) residual: Residual,
}

impl<'a> Family<'a> {
    /// The family through a first solution, and that solution as a point z.
    ///
    /// `parameter` is the index in p of the parameter λ of the family, `held` are the indices of the
    /// f − 1 parameters that are held. With all of these at the values of the guess the problem is
    /// solved by [`solve`](crate::solve); the family starts on the mesh of that solution.
    ///
    /// # Errors
    /// [`Error::FamilyParameter`] if an index is out of range or named twice,
    /// [`Error::ConditionCount`] if the number of conditions is not Σ nᵢ + k − f, and those of
    /// [`solve`](crate::solve).
    pub fn new(
        equations: &'a dyn Equations,
        parameter: usize,
        held: &[usize],
        guess: &dyn Guess,
        options: &Options,
    ) -> Result<(Self, Vec<f64>), Error> {
        let problem = Held::none(equations);
        let k = problem.parameters();
        let fixed = [&[parameter], held].concat();
        check_indices(&problem, &fixed)?;
        check_guess_shape(&problem, guess, guess.mesh().as_ref())?;
        let mut p = vec![0.0; k];
        guess.parameters(&mut p);
        let first = solve_held(&Held::new(equations, &fixed, &p), guess, options)?;
        let held_equations = in_units(&Held::new(equations, held, &p), options)?;
        let x = divided(&held_equations, &first);
        let collocation = Collocation::new(
            held_equations,
            Arc::clone(&first.tableau),
            problem.pieces().divide(first.mesh),
        );
        let layout = Layout::new(k, parameter, held);
        let family = Self::on(collocation, layout, options.clone(), first.stats);
        let z = family.flat(x);
        Ok((family, z))
    }

    /// The family of a discretisation.
    pub(super) fn on(
        collocation: Collocation<'a>,
        layout: Layout,
        options: Options,
        stats: Stats,
    ) -> Self {
        let (x, residual) = (collocation.zeros(), collocation.residual_buffer());
        Self {
            collocation,
            layout,
            options,
            stats,
            settled: 0,
            linearised: false,
            x,
            residual,
        }
    }

    /// The number of unknowns n + 1, λ the last.
    pub fn unknowns(&self) -> usize {
        let segments = self.x.segments.iter();
        let values = segments.map(|segment| segment.nodes.len() + segment.stages.len());
        values.sum::<usize>() + self.layout.free.len()
    }

    /// Evaluates G at `z` (n + 1 numbers) into `g` (n numbers: for every segment yᵢ₊₁ − yᵢ − h Σ bⱼKⱼ
    /// of all intervals, then Kⱼ − f of all stages; then the conditions, those of the problem first). All
    /// but the conditions are divided by the numbers of [`Options::absolute`], rounded down to powers of
    /// two. All of `g` is NaN where a
    /// right-hand side or a condition is not finite.
    ///
    /// # Panics
    /// If `z` or `g` is too short.
    pub fn residual(&mut self, z: &[f64], g: &mut [f64]) {
        self.read_point(z);
        let Self {
            collocation,
            residual,
            stats,
            ..
        } = self;
        let Ok(()) = collocation.residual(&self.x, residual, stats) else {
            g.fill(f64::NAN);
            return;
        };
        let segments = collocation.equations.segments();
        self.layout.write_residual(residual, segments, g);
    }

    /// Factors the Jacobian J of G at `z`, n × (n + 1). It may have any rank; where it is less than
    /// n the factors are those of a matrix within rounding of it.
    ///
    /// # Errors
    /// [`Error::NonFiniteRhs`] or [`Error::NonFiniteCondition`] where a value or a derivative is not
    /// finite; [`Error::SingularNode`] or [`Error::SingularConditions`] where the elimination
    /// overflows or an interval is so long that its stages are not determined.
    ///
    /// # Panics
    /// If `z` is too short.
    pub fn linearise(&mut self, z: &[f64]) -> Result<(), Error> {
        self.read_point(z);
        let Self {
            collocation,
            residual,
            stats,
            ..
        } = self;
        let outcome = collocation.linearise(&self.x, residual, stats);
        self.linearised = outcome.is_ok();
        outcome.map_err(|failure| {
            let unknown = Quality::unknown(&self.collocation.mesh);
            let best = self.wrap(self.x.clone(), unknown);
            let error = numerical(Failure::from(failure), best, 0.0);
            restored_error(&self.collocation.equations, error)
        })
    }

    /// A vector `v` (n + 1 numbers) with J v = `r` (n numbers) for the last linearisation: of all
    /// of them one that is short at the ends of the segments. It counts as a Newton step.
    ///
    /// # Panics
    /// If `r` or `v` is too short.
    pub fn particular(&mut self, r: &[f64], v: &mut [f64]) {
        let segments = self.collocation.equations.segments();
        self.layout.read_negative(r, segments, &mut self.residual);
        self.collocation.correction(&self.residual, &mut self.x);
        self.stats.newton_steps += 1;
        self.write(v);
    }

    /// The vector `t` (n + 1 numbers, of any length) with J t = 0 for the last linearisation.
    ///
    /// Its direction is such that det \[J; tᵀ\] has the same sign for all linearisations on one mesh:
    /// along a curve t keeps its direction, but for a jump to its opposite at a point where two
    /// curves of solutions cross.
    ///
    /// # Panics
    /// If `t` is too short.
    pub fn null_vector(&mut self, t: &mut [f64]) {
        self.residual.clear();
        self.collocation.null_vector(&self.residual, &mut self.x);
        self.write(t);
    }

    /// Which unknowns but λ (n numbers each) sample one function: `group` is its number from zero, `share`
    /// the part of it that the unknown stands for. A state of a segment, or of a piece of it between joined
    /// points, is a group, its nodes have the shares of the trapezoidal rule and its stage slopes none; each
    /// free parameter is a group with share one. The shares of every group sum to one.
    ///
    /// # Panics
    /// If `group` or `share` is too short.
    pub fn groups(&self, group: &mut [usize], share: &mut [f64]) {
        let Collocation {
            equations,
            mesh,
            tableau,
            ..
        } = &self.collocation;
        let count = self.unknowns() - 1;
        let (group, share) = (&mut group[..count], &mut share[..count]);
        self.layout
            .groups(equations.segments(), mesh, tableau.stages, group, share);
    }

    /// The point `z` as a solution, with its defects and the residuals of its conditions (infinite
    /// where they are not finite) and without an estimate of its global error. Its [`Stats`] are those
    /// of the family so far, the time that of its first point.
    ///
    /// # Panics
    /// If `z` is too short.
    pub fn solution(&self, z: &[f64]) -> Solution {
        let Collocation {
            equations,
            tableau,
            mesh,
            ..
        } = &self.collocation;
        let x = self.iterate(z);
        let segments = equations.segments();
        let mut ends = vec![0.0; segments.iter().map(|segment| 2 * segment.states).sum()];
        gather_ends(segments, &x, &mut ends);
        let mut conditions = vec![f64::NAN; equations.condition_count()];
        equations.evaluate_conditions(Ends::new(segments, &ends), &x.p, &mut conditions);
        let unknown = Quality::unknown(mesh);
        let quality = Quality {
            defects: defects(
                equations,
                tableau,
                mesh,
                &x,
                &mut vec![],
                &mut self.stats.clone(),
            )
            .unwrap_or(unknown.defects),
            conditions: conditions
                .iter()
                .map(|r| if r.is_nan() { f64::INFINITY } else { r.abs() })
                .collect(),
            errors: None,
        };
        restored(equations, self.wrap(x, quality))
    }

    /// The states at the start of a segment of the point `z`, which is cheaper than a
    /// [`solution`](Self::solution).
    ///
    /// # Panics
    /// If there is no such segment or `z` is too short.
    pub fn start<'z>(&self, z: &'z [f64], segment: usize) -> &'z [f64] {
        let pieces = self.collocation.equations.pieces();
        let states = pieces.stated()[segment].states;
        &z[self.nodes_before(pieces.of(segment).start)..][..states]
    }

    /// The states at the end of a segment of the point `z`.
    ///
    /// # Panics
    /// If there is no such segment or `z` is too short.
    pub fn end<'z>(&self, z: &'z [f64], segment: usize) -> &'z [f64] {
        let pieces = self.collocation.equations.pieces();
        let (states, last) = (pieces.stated()[segment].states, pieces.of(segment).end - 1);
        let nodes = self.x.segments[last].nodes.len();
        &z[self.nodes_before(last) + nodes - states..][..states]
    }

    /// Where the nodes of a piece begin in a point.
    pub(super) fn nodes_before(&self, piece: usize) -> usize {
        let before = self.x.segments[..piece].iter();
        before.map(|s| s.nodes.len() + s.stages.len()).sum()
    }

    /// The tolerance that [`adapted`](Self::adapted) keeps, [`Options::tolerance`].
    pub fn tolerance(&self) -> f64 {
        self.options.tolerance
    }

    /// The indices in p of the parameters that are held, in the order in which they were named.
    pub fn held_parameters(&self) -> impl Iterator<Item = usize> {
        self.collocation.equations.indices()
    }

    /// The value of the held parameter with this index in p.
    ///
    /// # Panics
    /// If it is not held.
    pub fn held(&self, index: usize) -> f64 {
        let value = self.collocation.equations.value(index);
        value.expect("a parameter that is held")
    }

    /// Holds the parameter with this index in p, held before, at another value from now on.
    ///
    /// # Panics
    /// If it was not held.
    pub fn hold(&mut self, index: usize, value: f64) {
        let held = self.collocation.equations.hold(index, value);
        assert!(held, "a parameter that is held");
    }

    /// The same discretisation of other equations with the same segments, numbers of parameters and
    /// of conditions, for instance of those with a smaller regularisation.
    ///
    /// # Errors
    /// [`Error::ConditionCount`] if the number of conditions differs.
    ///
    /// # Panics
    /// If the segments differ.
    pub fn exchanged(&self, equations: &'a dyn Equations) -> Result<Self, Error> {
        let own = &self.collocation.equations;
        let problem = Held::none(equations);
        let stated = |held: &Held<'_>| held.pieces().stated().to_vec();
        assert_eq!(stated(own), stated(&problem), "the same segments");
        check_statement(&problem, own.held_count() + 1)?;
        let mut family = self.clone();
        family.collocation.equations = own.exchanged(equations);
        family.linearised = false;
        Ok(family)
    }

    /// Reads a point into the iterate in work.
    pub(super) fn read_point(&mut self, z: &[f64]) {
        self.layout.read(z, &mut self.x);
        to_units(&self.collocation.equations, &mut self.x);
        self.collocation.equations.fill(&mut self.x.p);
    }

    /// Writes the iterate in work as a vector.
    fn write(&mut self, vector: &mut [f64]) {
        from_units(&self.collocation.equations, &mut self.x);
        self.layout.write(&self.x, vector);
    }

    /// A vector as an iterate, with the values of the held parameters: those of a tangent mean
    /// nothing.
    pub(super) fn iterate(&self, vector: &[f64]) -> Iterate {
        let mut x = self.collocation.zeros();
        self.layout.read(vector, &mut x);
        to_units(&self.collocation.equations, &mut x);
        self.collocation.equations.fill(&mut x.p);
        x
    }

    /// An iterate as a vector.
    pub(super) fn flat(&self, mut x: Iterate) -> Vec<f64> {
        let mut z = vec![0.0; self.unknowns()];
        from_units(&self.collocation.equations, &mut x);
        self.layout.write(&x, &mut z);
        z
    }

    /// An iterate as a solution.
    pub(super) fn wrap(&self, x: Iterate, quality: Quality) -> Solution {
        Solution {
            segments: self.collocation.equations.segments().to_vec(),
            absolute: vec![],
            tableau: Arc::clone(&self.collocation.tableau),
            mesh: self.collocation.mesh.clone(),
            x,
            quality,
            stats: self.stats,
        }
    }
}

/// Checks that parameters named as fixed exist, are named once, and leave as many unknown constants as
/// there are conditions.
pub(super) fn check_indices(problem: &Held<'_>, fixed: &[usize]) -> Result<(), Error> {
    let parameters = problem.parameters();
    for (i, &parameter) in fixed.iter().enumerate() {
        if parameter >= parameters || fixed[..i].contains(&parameter) {
            return Err(Error::FamilyParameter {
                parameter,
                parameters,
            });
        }
    }
    check_statement(problem, fixed.len())
}
