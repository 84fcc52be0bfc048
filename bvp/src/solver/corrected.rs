//! A solution with its estimated error added: defect correction, once.

use crate::accuracy::defect::defects;
use crate::newton::failure::Failure;
use crate::problem::equations::Equations;
use crate::result::error::Error;
use crate::result::quality::Quality;
use crate::result::restored::restored;
use crate::result::solution::Solution;
use crate::solver::at_solution::{AtSolution, at_solution, failed};
use std::sync::Arc;

impl Solution {
    /// The solution with its estimated error added at the nodes and to the parameters: one defect correction, with one
    /// linearisation on the same mesh. The error at the nodes and of the parameters then falls by two orders faster, as
    /// h²ᵐ⁺² with m Gauss stages and as h²ᵐ with m Lobatto stages; in between the order stays m + 1.
    ///
    /// The error of any number J that is computed from a solution is then estimated by the difference of J of the
    /// corrected solution and J of this one, whatever cancels in it. [`error_estimate`](Self::error_estimate) of the
    /// corrected solution is that of this one, also where this one has none, after
    /// [`Control::Defect`](crate::Control::Defect). Rounding is in neither. Its [`stats`](Self::stats) are those of the
    /// correction alone.
    ///
    /// The equations may be others near by, such as those with another value of a coefficient: the difference then is the
    /// effect of that as well, to first order.
    ///
    /// H. J. Stetter, "The defect correction principle and discretization methods", Numer. Math. 29 (1978) 425-443.
    ///
    /// # Errors
    /// As [`conditioning`](Self::conditioning), and [`Error::NonFiniteRhs`] where the right-hand side is not finite between
    /// the collocation points.
    pub fn corrected(&self, equations: &dyn Equations) -> Result<Self, Error> {
        let AtSolution {
            mut collocation,
            mut x,
            mut residual,
            mut stats,
        } = at_solution(equations, self)?;
        let mut samples = vec![];
        let tableau = &collocation.tableau;
        let (held, mesh) = (&collocation.equations, &collocation.mesh);
        let found = defects(held, tableau, mesh, &x, &mut samples, &mut stats);
        let defects = match found {
            Ok(defects) => defects,
            Err(what) => return Err(failed(&collocation, &x, self, Failure::NonFinite(what))),
        };
        let mut w = collocation.zeros();
        let known = (&samples, &defects.local[..]);
        let errors = collocation.global_errors(&x, known, &mut residual, &mut w);
        let to_stage = &Arc::clone(&collocation.tableau).defect_to_weighted;
        match collocation.correct_defects(&x, &samples, to_stage, &mut residual, &mut w) {
            Ok(()) => x.add(1.0, &w),
            Err(what) => return Err(failed(&collocation, &x, self, Failure::NonFinite(what))),
        }
        let of_pieces = Self {
            segments: collocation.equations.segments().to_vec(),
            mesh: collocation.mesh.clone(),
            x,
            quality: Quality {
                defects,
                conditions: vec![],
                errors,
            },
            stats,
            ..self.clone()
        };
        let corrected = restored(&collocation.equations, of_pieces);
        Ok(Self {
            quality: Quality {
                conditions: self.quality.conditions.clone(),
                ..corrected.quality
            },
            ..corrected
        })
    }
}
