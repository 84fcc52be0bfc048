//! A family that is saved as its mesh, and had again.

use super::family::{Family, check_indices};
use super::layout::Layout;
use crate::discretisation::tableau::Tableau;
use crate::newton::collocation::Collocation;
use crate::problem::equations::Equations;
use crate::problem::held::Held;
use crate::result::error::Error;
use crate::result::restored::joined_nodes;
use crate::result::stats::Stats;
use crate::solver::options::Options;
use crate::solver::statement::{check_nodes, in_units};

impl<'a> Family<'a> {
    /// The nodes of every segment, from its beginning to its end. With a point and the values of the
    /// parameters that are held this is all that [`on_mesh`](Self::on_mesh) needs.
    pub fn mesh(&self) -> Vec<Vec<f64>> {
        let Collocation {
            equations, mesh, ..
        } = &self.collocation;
        let pieces = equations.pieces();
        let segments = 0..pieces.stated().len();
        let nodes = |segment| joined_nodes(pieces, segment, mesh);
        segments.map(nodes).collect()
    }

    /// The family on the mesh of another one, for its points: a branch of solutions is resumed by it.
    /// Nothing is solved. `parameter` is the index in p of the parameter λ of the family, `held` are the
    /// indices and values of those that are held. The scheme must be the one for which the points are
    /// laid out, as it is with the same settings.
    ///
    /// ```
    /// use bvp::{Constant, Ends, Family, Options, Problem, Real, Segment};
    ///
    /// /// y' = p y, y(0) = 1: one condition for a state and a parameter.
    /// struct Growth;
    ///
    /// impl Problem for Growth {
    ///     fn segments(&self) -> Vec<Segment> {
    ///         vec![Segment::on(1, 0.0, 1.0)]
    ///     }
    ///     fn parameters(&self) -> usize {
    ///         1
    ///     }
    ///     fn condition_count(&self) -> usize {
    ///         1
    ///     }
    ///     fn rhs<T: Real>(&self, _: usize, _: T, y: &[T], p: &[T], dy: &mut [T]) {
    ///         dy[0] = p[0] * y[0];
    ///     }
    ///     fn conditions<T: Real>(&self, at: Ends<'_, T>, _: &[T], r: &mut [T]) {
    ///         r[0] = at.start(0)[0] - 1.0;
    ///     }
    /// }
    ///
    /// let options = Options::default();
    /// let guess = Constant { states: vec![vec![1.0]], parameters: vec![2.0] };
    /// let (family, z) = Family::new(&Growth, 0, &[], &guess, &options)?;
    /// let mesh = family.mesh();
    ///
    /// let again = Family::on_mesh(&Growth, 0, &[], mesh, &options)?;
    /// assert!((again.end(&z, 0)[0] - 2f64.exp()).abs() < 1e-5);
    /// # Ok::<(), bvp::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::FamilyParameter`] if an index is out of range or named twice,
    /// [`Error::ConditionCount`] if the number of conditions does not fit, [`Error::GuessMesh`] if the
    /// mesh does not divide the segments, and those of [`Options::validate`].
    pub fn on_mesh(
        equations: &'a dyn Equations,
        parameter: usize,
        held: &[(usize, f64)],
        mesh: Vec<Vec<f64>>,
        options: &Options,
    ) -> Result<Self, Error> {
        let problem = Held::none(equations);
        let (indices, values): (Vec<usize>, Vec<f64>) = held.iter().copied().unzip();
        check_indices(&problem, &[&[parameter], &indices[..]].concat())?;
        options.validate()?;
        check_nodes(problem.pieces().stated(), &mesh)?;
        let mesh = problem.pieces().divide(mesh);
        let mut p = vec![0.0; problem.parameters()];
        for (&index, value) in indices.iter().zip(values) {
            p[index] = value;
        }
        let layout = Layout::new(p.len(), parameter, &indices);
        let held = in_units(&Held::new(equations, &indices, &p), options)?;
        let collocation = Collocation::new(held, Tableau::of(options.scheme()), mesh);
        let (options, stats) = (options.clone(), Stats::default());
        Ok(Self::on(collocation, layout, options, stats))
    }
}
