//! A belt round any number of pulleys as its engineer describes it, in SI units.

use super::layout::{Layout, LayoutError, PlacedPulley, Sense, Side};
use super::{Belt, FrictionLaw};
use bvp::Real;

/// A belt loop round two or more pulleys: everything that decides its steady state.
#[derive(Clone, Debug, PartialEq)]
pub struct BeltLoop {
    /// A name for outputs and figures.
    pub title: Option<String>,
    /// The belt.
    pub belt: Belt,
    /// How friction depends on slip: [`FrictionLaw::Bristle`] on V-belts only, [`FrictionLaw::CreepRate`] on
    /// flat belts with a normal force other than [`crate::NormalForce::Thesis`] only.
    pub law: FrictionLaw,
    /// Sense in which the belt runs round the loop.
    pub sense: Sense,
    /// Turning number ν: 1 for a plain loop, 0 for a crossed belt round two pulleys.
    pub turning_number: u32,
    /// The pulleys in the order in which the belt meets them; one of them is the driver.
    pub pulleys: Vec<LoopPulley>,
    /// What fixes how tight the belt is.
    pub closure: Closure,
}

/// A pulley of a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct LoopPulley {
    /// The name in messages.
    pub name: String,
    /// What holds its axis.
    pub mount: Mount,
    /// Radius R of the centre line of the belt, m; positive. Of a V-belt: of the pitch line where the belt
    /// enters the groove, or where it lies on a flat pulley on its back.
    pub radius: f64,
    /// On which side of the belt it lies. A pulley outside touches the back of a V-belt and is flat.
    pub side: Side,
    /// Coefficient of friction μ > 0 between belt and pulley.
    pub friction_coefficient: f64,
    /// Half groove angle β of this pulley in rad, 0 < β < π/2, if it is not that of the belt; of V-belts
    /// and pulleys inside only.
    pub half_angle: Option<f64>,
    /// What it does.
    pub duty: Duty,
}

impl LoopPulley {
    /// A pulley with a fixed centre in m and a radius in m inside the loop, with the groove of the belt.
    #[must_use]
    pub fn new(
        name: &str,
        centre: [f64; 2],
        radius: f64,
        friction_coefficient: f64,
        duty: Duty,
    ) -> Self {
        Self {
            name: name.to_owned(),
            mount: Mount::Fixed(centre),
            radius,
            side: Side::Inside,
            friction_coefficient,
            half_angle: None,
            duty,
        }
    }
}

/// What holds the axis of a pulley.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mount {
    /// A fixed centre, m.
    Fixed([f64; 2]),
    /// A tensioner; for one idler of a loop.
    Tensioner(Tensioner),
}

/// What a pulley does in a loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Duty {
    /// It turns with the belt at this angular speed, rad/s; positive.
    Driver(f64),
    /// This torque in N·m acts between belt and shaft: positive where it takes power out of the belt, 0 on
    /// an idler, negative where it drives as well.
    Torque(f64),
    /// It takes this power in W out of the belt; negative where it puts power into it.
    Power(f64),
}

impl Duty {
    /// Torque in N·m of a pulley that turns at a speed in rad/s; 0 for the driver.
    pub(crate) fn torque_at(self, speed: f64) -> f64 {
        match self {
            Self::Driver(_) => 0.0,
            Self::Torque(torque) => torque,
            Self::Power(power) => power / speed,
        }
    }
}

/// An idler that tightens the belt. Its coordinate q is the angle of the arm in rad, counter-clockwise from x, or the
/// displacement along its guide in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tensioner {
    /// How it moves.
    pub guide: Guide,
    /// What pushes it against the belt.
    pub load: TensionerLoad,
    /// Coordinate from which the equilibrium is sought; of no effect with [`Closure::RestCoordinate`].
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

/// What fixes how tight the belt is. With a tensioner each of them stands beside its equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Closure {
    /// Length of the belt without tension, m.
    UnstretchedLength(f64),
    /// Uniform belt tension of the loop at rest without torques, N.
    SetupTension(f64),
    /// Belt tension of a span of the running loop.
    SpanTension {
        /// Index of the span: that of the pulley it leaves.
        span: usize,
        /// Belt tension T there, N.
        tension: f64,
    },
    /// Tractive tension of a span of the running loop.
    SpanTractiveTension {
        /// Index of the span: that of the pulley it leaves.
        span: usize,
        /// Tractive tension F = T − G V there, N.
        tension: f64,
    },
    /// Coordinate of the tensioner at rest, rad or m.
    RestCoordinate(f64),
}

impl BeltLoop {
    /// The belt round the pulleys with the tensioner, if there is one, at a coordinate.
    ///
    /// # Errors
    /// As [`Layout::new`].
    pub fn layout(&self, coordinate: f64) -> Result<Layout, LayoutError> {
        let placed = |pulley: &LoopPulley| PlacedPulley {
            name: pulley.name.clone(),
            centre: match &pulley.mount {
                Mount::Fixed(centre) => *centre,
                Mount::Tensioner(tensioner) => tensioner.guide.centre(coordinate)[0],
            },
            radius: pulley.radius,
            side: pulley.side,
        };
        let pulleys = self.pulleys.iter().map(placed).collect();
        Layout::new(self.sense, self.turning_number, pulleys)
    }

    /// The coordinate from which the equilibrium of the tensioner is sought, rad or m; without one it means
    /// nothing.
    pub(crate) fn start_coordinate(&self) -> f64 {
        match (self.closure, self.tensioner()) {
            (Closure::RestCoordinate(coordinate), _) => coordinate,
            (_, Some((_, tensioner))) => tensioner.start_coordinate,
            (_, None) => 0.0,
        }
    }

    /// The index of the driver.
    pub(crate) fn driver(&self) -> usize {
        let mut pulleys = self.pulleys.iter();
        let driver = pulleys.position(|pulley| matches!(pulley.duty, Duty::Driver(_)));
        driver.unwrap_or(0)
    }

    /// Circumferential speed R ω of the driver, m/s.
    pub(crate) fn rim_speed(&self) -> f64 {
        let rims = self.pulleys.iter().map(|pulley| match pulley.duty {
            Duty::Driver(speed) => speed * pulley.radius,
            Duty::Torque(_) | Duty::Power(_) => 0.0,
        });
        rims.sum()
    }

    /// The index of the pulley on the tensioner, and the tensioner.
    pub(crate) fn tensioner(&self) -> Option<(usize, &Tensioner)> {
        let mounts = self.pulleys.iter().map(|pulley| &pulley.mount);
        mounts.enumerate().find_map(|(index, mount)| match mount {
            Mount::Tensioner(tensioner) => Some((index, tensioner)),
            Mount::Fixed(_) => None,
        })
    }
}
