//! The steady state of a belt loop, as it is answered.

use super::warning::{Warning, beyond_model, large_strain, overhangs};
use crate::drive::layout::Layout;
use crate::friction::rim::contact::Contact;
use crate::friction::rim::profile::profile;
use crate::{Belt, Check, Drive, LeastSlip, Profile, Zone};
use std::fmt;
use std::sync::{Arc, OnceLock};

/// The steady state of a belt loop; lists are in belt order.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct LoopState {
    /// The running belt on its pulleys. A V-belt sinks into its grooves: the layout is that of its pitch
    /// line on the pitch circles, and its own spans and wraps are those of `spans` and `pulleys`.
    pub layout: Layout,
    /// The belt at rest on them: it differs next to a tensioner. Of a V-belt as `layout`.
    pub rest_layout: Layout,
    /// Speed c = G/m of the unstretched belt, m/s.
    pub unstretched_speed: f64,
    /// Mass flow G, kg/s.
    pub mass_flow: f64,
    /// Length L of the running belt, m.
    pub length: f64,
    /// Length `L_0` of the unstretched belt, m.
    pub unstretched_length: f64,
    /// Belt tension at rest, N; uniform, after the belt has been turned without torques.
    pub rest_tension: f64,
    /// Power that pulleys put into the belt, W.
    pub power_in: f64,
    /// Power that pulleys take out of the belt, W.
    pub power_out: f64,
    /// Power lost in friction between belt and pulleys, W: power in less power out. A V-belt also loses
    /// [`GrooveState::transverse_loss`].
    pub power_loss: f64,
    /// Power out over power in; `None` without torques.
    pub efficiency: Option<f64>,
    /// The free spans; span i leaves pulley i.
    pub spans: Vec<SpanState>,
    /// The pulleys.
    pub pulleys: Vec<PulleyState>,
    /// The tensioner, if there is one.
    pub tensioner: Option<TensionerState>,
    /// How far all torques can be raised with Coulomb friction; `None` without torques, or if the tensioner
    /// has no equilibrium up to there. Of a V-belt, with its
    /// own friction law, [`solve_with_margins`](crate::belt_loop::solve_with_margins) finds it; `None` if what it finds may not
    /// be the largest.
    pub load_limit: Option<LoadLimit>,
    /// The verified invariants, each with its relative deviation.
    pub checks: Vec<Check>,
    /// How the state of a V-belt was found and how accurate it is; flat belts are solved in closed form,
    /// to rounding.
    pub convergence: Option<LoopConvergence>,
    /// The belt on the pulleys.
    pub(crate) contacts: Contacts,
}

/// A belt loop at rest: turned without torques, so that its tension is uniform.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RestState {
    /// Belt tension, N.
    pub(crate) tension: f64,
    /// Length of the unstretched belt, m.
    pub(crate) unstretched_length: f64,
    /// Coordinate of the tensioner, rad or m; without one it means nothing.
    pub(crate) coordinate: f64,
}

/// What the profiles of a belt on its pulleys follow from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Contacts {
    /// The contacts of a flat belt in closed form.
    Flat { contacts: Vec<Contact>, belt: Belt },
    /// The profiles of a V-belt.
    V(Profiles),
}

/// The profiles of a belt on its pulleys, made when they are first asked for: in a map of states nobody does.
#[derive(Clone)]
pub(crate) struct Profiles {
    make: Arc<dyn Fn() -> Vec<Profile> + Send + Sync>,
    made: OnceLock<Vec<Profile>>,
}

impl Profiles {
    pub(crate) fn new(make: impl Fn() -> Vec<Profile> + Send + Sync + 'static) -> Self {
        Self {
            make: Arc::new(make),
            made: OnceLock::new(),
        }
    }

    fn get(&self) -> &[Profile] {
        self.made.get_or_init(|| (self.make)())
    }
}

impl fmt::Debug for Profiles {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Profiles").field(&self.made).finish()
    }
}

impl PartialEq for Profiles {
    fn eq(&self, other: &Self) -> bool {
        self.get() == other.get()
    }
}

/// How the steady state of a V-belt was found and how accurate it is.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct LoopConvergence {
    /// Relative tolerance asked for.
    pub tolerance: f64,
    /// Estimated largest relative error of all profiles and constants.
    pub error_estimate: f64,
    /// Largest relative defect of the profiles in the differential equations.
    pub defect: f64,
    /// Mesh intervals of all contacts in the final solution.
    pub mesh_intervals: usize,
    /// Newton steps in all, the state at rest included.
    pub newton_steps: usize,
    /// Boundary value problems solved or tried on the way, the state at rest included.
    pub problems: usize,
    /// Normalisation ε of the slip direction in the final state; 0 for the bristle law.
    pub slip_normalisation: f64,
    /// Estimated relative effect of ε on the constants of the loop.
    pub slip_normalisation_effect: f64,
}

/// Relative error of a loop that was solved in closed form: cases that were solved with 40 digits agree to
/// 1.6e-13.
const ROUNDING: f64 = 1e-12;

impl LoopState {
    /// Relative error of the state: the estimate of a V-belt, rounding of a flat belt.
    pub(crate) fn relative_error(&self) -> f64 {
        self.convergence.as_ref().map_or(ROUNDING, |convergence| {
            let estimate = convergence.error_estimate;
            estimate.max(convergence.slip_normalisation_effect)
        })
    }

    /// Remarks on the validity of this state of `drive`, which must be the one that was solved, with the names of
    /// its pulleys.
    pub fn warnings(&self, drive: &Drive) -> Vec<Warning<String>> {
        let belt = &drive.belt;
        let tensions = self.spans.iter().map(|span| span.tension);
        let largest = tensions.fold(0.0, f64::max);
        let name = |pulley: &PulleyState| pulley.name.clone();
        match &self.contacts {
            Contacts::Flat { contacts, .. } => {
                let against_rims = contacts.iter().map(|contact| contact.strain);
                Vec::from_iter(large_strain(belt, drive.law, largest, against_rims))
            }
            Contacts::V(profiles) => {
                let pulleys = self.pulleys.iter();
                let overhangs = overhangs(pulleys.clone().map(name).zip(profiles.get()));
                let sunk = pulleys.filter_map(|pulley| {
                    let groove = pulley.groove.as_ref()?;
                    Some((name(pulley), groove.max_penetration))
                });
                overhangs.chain(beyond_model(belt, largest, sunk)).collect()
            }
        }
    }

    /// The belt along the contact with a pulley, by its index in belt order; computed when it is asked for.
    ///
    /// # Panics
    /// If there is no such pulley.
    pub fn profile(&self, pulley: usize) -> Profile {
        match &self.contacts {
            Contacts::Flat { contacts, belt } => {
                let radius = self.layout.pulleys()[pulley].radius;
                profile(&contacts[pulley], *belt, radius, self.unstretched_speed)
            }
            Contacts::V(profiles) => profiles.get()[pulley].clone(),
        }
    }
}

/// A free span.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SpanState {
    /// Length of the running span, m.
    pub length: f64,
    /// Direction of its motion, rad, counter-clockwise from x, in [0, 2π).
    pub direction: f64,
    /// Belt tension T, N.
    pub tension: f64,
    /// Tractive tension F = T − G V, N.
    pub tractive_tension: f64,
    /// Belt speed V, m/s.
    pub speed: f64,
    /// First natural frequency of transverse motion, Hz, of the moving string.
    pub frequency: f64,
    /// Length at rest, m.
    pub rest_length: f64,
    /// First natural frequency of transverse motion at rest, Hz.
    pub rest_frequency: f64,
    /// Deflection δ of the midpoint at rest to which the force belongs, m: 1/64 of the span.
    pub deflection: f64,
    /// Force across the span that deflects its midpoint by δ towards the inside of the loop at rest, N,
    /// while pulleys and tensioner are held and the belt slides round the pulleys without friction. Exact:
    /// the points of contact move and the belt stretches. `None` if the belt then leaves a pulley.
    pub deflection_force: Option<f64>,
}

/// A pulley.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PulleyState {
    /// Its name.
    pub name: String,
    /// Centre in the running loop, m.
    pub centre: [f64; 2],
    /// Angular speed ω, rad/s; positive along the motion of the belt.
    pub angular_speed: f64,
    /// Torque M, N·m; positive where power leaves the belt.
    pub torque: f64,
    /// Power M ω, W; positive where it leaves the belt.
    pub power: f64,
    /// Wrap angle φ, rad; that which a V-belt sweeps in its groove.
    pub wrap: f64,
    /// Wrap angle at rest, rad.
    pub rest_wrap: f64,
    /// Arc on which friction is not at its limit, rad: of adhesion, of elastic friction or of creep, from
    /// the entry. With very soft elastic friction it includes a last zone in which the belt sticks again.
    pub no_slip_arc: f64,
    /// Arc on which the belt slips, rad.
    pub slip_arc: f64,
    /// The zones of friction, in the order in which the belt passes them.
    pub zones: Vec<Zone>,
    /// Strain u′(0) of the belt against the rim where it enters: positive where the tension grows, 0 with
    /// Coulomb friction. `None` for V-belts.
    pub entry_strain: Option<f64>,
    /// Belt tension `T_o` at which the belt would run as fast as the rim, N. `None` for V-belts.
    pub reference_tension: Option<f64>,
    /// Force of the belt on the hub, N.
    pub hub_load: [f64; 2],
    /// Force of the belt on the hub at rest, N.
    pub rest_hub_load: [f64; 2],
    /// Speed loss 1 − R ω/(R ω of the driver).
    pub speed_loss: f64,
    /// Power lost in friction on this pulley, W.
    pub friction_loss: f64,
    /// What that is lost in.
    pub friction_parts: FrictionParts,
    /// Share of the contact that slips with Coulomb friction, `|ln(P_out/P_in)|`/(a R φ) with the traction P
    /// and the slip rate a of the convention (a R = μ but with `thesis`); below 1. `None` for V-belts.
    pub friction_utilisation: Option<f64>,
    /// Largest torque that it takes or gives at the slacker of its tensions, N·m: R P (exp(a R φ) − 1) on flat
    /// belts; in a groove that of the contact at any speed of the pulley, found by
    /// [`solve_with_margins`](crate::belt_loop::solve_with_margins) unless it is an idler.
    pub torque_capacity: Option<f64>,
    /// Torque capacity over torque; `None` for an idler. It holds the slacker tension, where the load limit holds
    /// the closure.
    pub torque_margin: Option<f64>,
    /// Estimated error of torque capacity and margin, relative; 0 where they are exact to rounding, as of flat belts.
    pub torque_margin_error: f64,
    /// The belt in its groove; `None` for flat belts and for pulleys on the back of a V-belt.
    pub groove: Option<GrooveState>,
}

/// What the power that friction takes on a pulley is lost in, W; the parts add up to the friction loss.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct FrictionParts {
    /// Slip along the rim: in slip zones and, with creep-rate friction, in creep zones.
    pub sliding: f64,
    /// Slip along the faces of the groove towards the axis and outward, in slip zones: the belt wedges itself in
    /// and is pulled out. 0 on flat belts and on the back of V-belts.
    pub wedging: f64,
    /// Friction below its limit, in elastic zones: the work that bends the bristles, or displaces the belt with
    /// elastic/perfectly-plastic friction, and that is lost when the belt leaves the pulley (hysteresis).
    pub elastic: f64,
}

/// A V-belt in the groove of a pulley.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct GrooveState {
    /// Inclination θ of the belt to the local circle at entry and exit, rad; positive outward.
    pub inclination: [f64; 2],
    /// Largest penetration x of the belt into the groove, m.
    pub max_penetration: f64,
    /// Power that goes into the transverse compression of the belt between entry and exit, W: ∫ k x tan β V
    /// dx. It is small and of either sign, since the belt speed V changes along the contact.
    pub transverse_loss: f64,
    /// Where the belt hardly slips.
    pub least_slip: LeastSlip,
}

/// The tensioner; its coordinate is an angle in rad or a displacement in m.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct TensionerState {
    /// Index of its pulley.
    pub pulley: usize,
    /// Coordinate q of the running loop, rad or m.
    pub coordinate: f64,
    /// Coordinate at rest, rad or m.
    pub rest_coordinate: f64,
    /// Load of its spring or weight along the coordinate, N·m or N.
    pub load: f64,
    /// First and second derivative of the length of the loop with the coordinate.
    pub length_derivatives: [f64; 2],
    /// Stiffness k + `F_t` d²L/dq² + (EA/`L_0`) (dL/dq)² against a slow displacement, N·m/rad or N/m; with
    /// uniform tension; k is that of the spring, or less the derivative of the load of a weight.
    pub stiffness: f64,
    /// The same at rest.
    pub rest_stiffness: f64,
    /// Tensioner constant η: 0 where speed takes tractive tension off as with fixed centres, 1 where the
    /// tractive tension stays whatever the speed (Beikmann, Perkins and Ulsoy 1996).
    pub constant: f64,
    /// The same at rest.
    pub rest_constant: f64,
}

/// How far all torques can be raised at the same closure.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct LoadLimit {
    /// Factor on all torques at which the first pulley slips grossly; below 1 where one does already, which near lift-off
    /// V-belts go on with.
    pub factor: f64,
    /// The index of that pulley.
    pub pulley: usize,
    /// Estimated error of the factor, relative; 0 where it is exact to rounding, as of flat belts.
    pub error: f64,
}
