//! Friction between belt and pulley: one file a law.
//!
//! A law is a variant of [`FrictionLaw`] and a [`Row`] in its file that says all there is to know of it: drive
//! files, reports and the mechanics of flat belts read it there.

mod bristle;
pub(crate) mod coulomb;
pub(crate) mod creep_rate;
pub(crate) mod epp;
pub(crate) mod rim;
mod row;

pub(crate) use row::{Parameter, Row};

use crate::mechanics::implicit::Implicit;
use rim::contact::{Arc, Contact};

/// How the friction force depends on slip. The coefficient μ is common to all laws.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FrictionLaw {
    /// Full friction μ p against the slip velocity.
    Coulomb,
    /// Elastic/perfectly-plastic: `f = min(k_f |u|, μ p)` along the slip velocity.
    Epp {
        /// Stiffness `k_f` per length, N/m².
        stiffness: f64,
    },
    /// Elastic/perfectly-plastic friction as a vector in the groove face: the traction grows with the slip that is
    /// not yet plastic, `k_f` per length, up to μ p; V-belts only.
    VectorEpp {
        /// Stiffness `k_f` per length, N/m².
        stiffness: f64,
    },
    /// Vector bristles in the groove face with stiffness proportional to the pressure; V-belts only.
    Bristle {
        /// Bristle stiffness κ, 1/m; the micro-slip length is μ/κ.
        stiffness: f64,
    },
    /// Friction grows with the slip velocity v up to its Coulomb value, `μ n min(|v|/v_s, 1)`; flat belts
    /// only (Leamy and Wasfy, 2002).
    CreepRate {
        /// Slip velocity `v_s` at which friction is fully developed, m/s.
        velocity: f64,
    },
}

/// The rows of all laws, in the order in which messages list them, but for other kinds of them.
pub(crate) const ROWS: &[&Row] = &[&coulomb::ROW, &epp::ROW, &bristle::ROW, &creep_rate::ROW];

impl FrictionLaw {
    /// The name of the law in drive files and outputs.
    pub fn name(&self) -> &'static str {
        self.row().name
    }

    /// The word that tells it from another law of the same name, if that is the one which drive files mean
    /// without it.
    pub(crate) fn kind(&self) -> Option<&'static str> {
        let others = ROWS.iter().filter_map(|row| row.other.as_ref());
        let mut own = others.filter(|other| other.row.title == self.row().title);
        own.next().map(|other| other.words[1])
    }

    /// The row of the law.
    pub(crate) fn row(&self) -> &'static Row {
        { *self }.parts().0
    }

    /// The value of its parameter beside the coefficient, SI, if it has one.
    pub(crate) fn parameter(&self) -> Option<f64> {
        { *self }.parts().1.copied()
    }

    /// The row of the law and the value of its parameter.
    pub(crate) fn parts(&mut self) -> (&'static Row, Option<&mut f64>) {
        match self {
            Self::Coulomb => (&coulomb::ROW, None),
            Self::Epp { stiffness } => (&epp::ROW, Some(stiffness)),
            Self::VectorEpp { stiffness } => (&epp::VECTOR, Some(stiffness)),
            Self::Bristle { stiffness } => (&bristle::ROW, Some(stiffness)),
            Self::CreepRate { velocity } => (&creep_rate::ROW, Some(velocity)),
        }
    }

    /// The contact of a flat belt on an arc, for a belt whose unstretched parts move at `speed` in m/s and a value of the
    /// parameter of the law; `None` if the load is not below the capacity of the arc.
    ///
    /// # Panics
    /// If it is no law for flat belts.
    pub(crate) fn contact<S: Implicit>(
        self,
        arc: Arc<S>,
        speed: S,
        parameter: S,
    ) -> Option<Contact<S>> {
        match self {
            Self::Coulomb => coulomb::solve(arc),
            Self::Epp { .. } => epp::solve(arc, parameter),
            Self::CreepRate { .. } => creep_rate::solve(arc, speed, parameter),
            Self::VectorEpp { .. } | Self::Bristle { .. } => panic!("a law for flat belts"),
        }
    }
}
