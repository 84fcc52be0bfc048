//! A tensioner, its guide and its load.

use bvp::Real;

/// An idler that tightens the belt. Its coordinate q is the angle of the arm in rad, counter-clockwise from x, or the
/// displacement along its guide in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tensioner {
    /// How it moves.
    pub guide: Guide,
    /// What pushes it against the belt.
    pub load: TensionerLoad,
    /// Coordinate from which the equilibrium is sought; of no effect with [`Closure::RestCoordinate`](crate::Closure::RestCoordinate).
    pub start_coordinate: f64,
    /// The stops, smallest and largest coordinate, if there are any.
    pub travel: Option<[f64; 2]>,
}

/// What pushes a tensioner along its coordinate q.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TensionerLoad {
    /// A spring: −k (q − q₀).
    Spring {
        /// Stiffness k, N·m/rad or N/m; positive.
        stiffness: f64,
        /// Coordinate q₀ at which the spring is free, rad or m.
        free_coordinate: f64,
    },
    /// A dead weight W in N, positive. On an arm it hangs at the axis of the idler and pulls downwards, along
    /// −y: −W a cos q. On a straight guide it pulls with W along the guide.
    Weight(f64),
}

impl Tensioner {
    /// Load along the coordinate q in N·m or N, and its derivative with q.
    pub(crate) fn load_at<T: Real>(&self, coordinate: T) -> [T; 2] {
        match (self.load, self.guide) {
            (
                TensionerLoad::Spring {
                    stiffness,
                    free_coordinate,
                },
                _,
            ) => [
                (coordinate - free_coordinate) * -stiffness,
                T::from_f64(-stiffness),
            ],
            (TensionerLoad::Weight(weight), Guide::Rotary { arm_length, .. }) => {
                [-coordinate.cos(), coordinate.sin()].map(|part| part * (weight * arm_length))
            }
            (TensionerLoad::Weight(weight), Guide::Translating { .. }) => {
                [weight, 0.0].map(T::from_f64)
            }
        }
    }
}

/// How a tensioner guides its idler.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guide {
    /// On an arm: centre P + a (cos q, sin q).
    Rotary {
        /// Pivot P, m.
        pivot: [f64; 2],
        /// Length a of the arm, m; positive.
        arm_length: f64,
    },
    /// Along a line: centre O + q d.
    Translating {
        /// Centre O of the idler at q = 0, m.
        origin: [f64; 2],
        /// Direction d of positive q; of length 1.
        direction: [f64; 2],
    },
}

impl Guide {
    /// Centre C of the idler at a coordinate, m, and its derivatives C′ and C″ with the coordinate.
    pub(crate) fn centre<T: Real>(&self, coordinate: T) -> [[T; 2]; 3] {
        match *self {
            Self::Rotary {
                pivot: [x, y],
                arm_length,
            } => {
                let [along, across] = [coordinate.cos(), coordinate.sin()].map(|c| c * arm_length);
                [[along + x, across + y], [-across, along], [-along, -across]]
            }
            Self::Translating {
                origin: [x, y],
                direction: [right, up],
            } => {
                let centre = [coordinate * right + x, coordinate * up + y];
                [centre, [right, up].map(T::from_f64), [T::ZERO; 2]]
            }
        }
    }
}
