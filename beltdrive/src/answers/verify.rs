//! Published results recomputed: what the program stands on, number by number.
//!
//! [`verify`] computes every number of its sources anew, with the public functions of this crate, and
//! compares it with what is printed there. A [`Comparison`] agrees to the printed digits, or within a
//! stated band where digits are no measure, or differs for a known reason; anything else is unexplained.
//! A known reason holds for one computed value only: should that change, the difference is unexplained
//! again ([`Criterion::Known`]).
//!
//! ```
//! use beltdrive::verify::{Comparison, Criterion, Published, Verdict};
//!
//! let published = Published::new("2.34");
//! let row = Comparison::new("transition", "rad", published, Criterion::Digits, Ok(2.3435));
//! assert_eq!(row.verdict(), Verdict::Agrees);
//! ```

mod comparison;
mod drives;
mod finite_elements;
mod kim_figures;
mod kim_flat_text;
mod kim_table_2;
mod kim_v_limits;
mod kim_v_tables;
mod published;

pub use comparison::{Comparison, Criterion, Verdict};
pub use published::Published;

use comparison::computed;

/// Everything that was compared.
#[derive(Clone, Debug, PartialEq)]
pub struct Verification {
    /// By source.
    pub sources: Vec<Source>,
}

/// A publication with the numbers taken from it.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Author, year and subject.
    pub title: &'static str,
    /// Where it is published.
    pub citation: &'static str,
    /// How the numbers are computed here.
    pub method: &'static str,
    /// The numbers, as the source groups them.
    pub sections: Vec<Section>,
}

/// Numbers that belong together in their source, such as a column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Where in the source, and for what data.
    pub title: &'static str,
    /// The numbers.
    pub comparisons: Vec<Comparison>,
}

impl Verification {
    /// Every comparison, in order.
    pub fn comparisons(&self) -> impl Iterator<Item = &Comparison> {
        let sections = self.sources.iter().flat_map(|source| &source.sections);
        sections.flat_map(|section| &section.comparisons)
    }

    /// How many comparisons have a verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        let verdicts = self.comparisons().map(Comparison::verdict);
        verdicts.filter(|found| *found == verdict).count()
    }
}

/// Computes every published number anew. `progress` is told the share done, 0 to 1, and what is done.
///
/// A number that cannot be computed is a row without one, and unexplained.
///
/// ```no_run
/// use beltdrive::verify::{Verdict, verify};
///
/// let verification = verify(&mut |_, _| {});
/// assert_eq!(verification.count(Verdict::Differs), 0);
/// ```
pub fn verify(progress: &mut dyn FnMut(f64, &str)) -> Verification {
    progress(0.0, "Kim (2009), flat belt");
    let mut flat = kim_table_2::sections();
    flat.push(kim_flat_text::section());
    progress(0.01, "Kim (2009), flat belt in time");
    let in_time = kim_figures::sections();
    progress(0.1, "Kim (2009), V-belt");
    let mut v_belt = kim_v_tables::sections();
    v_belt.push(kim_v_limits::section(&mut |share, what| {
        progress(0.1 + 0.88 * share, what);
    }));
    progress(0.98, "Ntarladima, Pieber and Gerstmayr (2023)");
    let finite_elements = finite_elements::sections();
    progress(1.0, "");
    let kim = "D. Kim, Dynamic Modeling of Belt Drives Using the Elastic/Perfectly-Plastic Friction Law, \
               MS thesis, Georgia Institute of Technology (2009)";
    Verification {
        sources: vec![
            Source {
                title: "Kim (2009), flat belt",
                citation: kim,
                method: "closed form of the two zones, elastic and slipping, in the convention of the \
                         thesis (normal force T/R), at the tensions that it prints",
                sections: flat,
            },
            Source {
                title: "Kim (2009), flat belt in time",
                citation: kim,
                method: "a run from rest to the steady state (`simulate`, 240 cells) in the place of the \
                         finite-element model of figures 24 to 26, whose curves have no numbers; the \
                         numbers are those of table 2, which the figures show",
                sections: in_time,
            },
            Source {
                title: "Kim (2009), V-belt",
                citation: kim,
                method: "boundary value problem in the arc length, closed by the plane geometry of the \
                         drive, by adaptive collocation to a relative tolerance of 1e-6; the tensions \
                         printed as T_L and T_H are read as tractive tensions, 100 N in the slack span",
                sections: v_belt,
            },
            Source {
                title: "Ntarladima, Pieber and Gerstmayr (2023), finite elements",
                citation: "K. Ntarladima, M. Pieber, J. Gerstmayr, A model for contact and friction \
                           between beams under large deformation and sheaves, Nonlinear Dynamics (2023), \
                           doi:10.1007/s11071-023-08973-y, and the result files at \
                           https://github.com/THREAD-2-3/beltDriveSimulation",
                method: "closed form with finite strains; the slack tension is the one at which the \
                         belt has its reference length, the driven torque 25 N·m + 2 N·m·s ω₁. Their \
                         numbers carry the error of their mesh, so that digits are no measure; the bands \
                         are 0.3 % for speed, torque and efficiency, 1 % of the difference of the \
                         tensions for the tensions, and 3 % for the slip arcs",
                sections: finite_elements,
            },
        ],
    }
}
