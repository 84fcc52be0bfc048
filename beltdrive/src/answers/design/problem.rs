//! A drive with its free numbers as functions of them: what is to be small, and the limits.

use super::search::Values;
use crate::answers::check::{CaseState, SlipMargin, judged};
use crate::answers::members::Refusal;
use crate::input::{DesignObjective, DesignQuestion, DriveFile};
use crate::{Requirements, Service, Side, SolveError, SolveOptions};
use std::sync::{Arc, Mutex};

/// A limit of a design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DesignLimit {
    /// The smallest value of a free number, by its index.
    LowerBound(usize),
    /// The largest value of a free number, by its index.
    UpperBound(usize),
    /// The slip margin: at least the required one, or 1, below which there is no steady state.
    SlipMargin,
    /// The largest speed loss that is required.
    SpeedLoss,
    /// The largest hub load that is required.
    HubLoad,
    /// The largest belt tension that is required.
    Tension,
    /// The smallest pulley that the belt section allows.
    SmallestDiameter,
}

/// Where a limit of a design is met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LimitPlace {
    /// The index of the load case, if it is of one.
    pub case: Option<usize>,
    /// The index of the pulley; of a tension that of the one behind which the span is, and none at rest.
    pub pulley: Option<usize>,
}

/// What was found against a limit.
#[derive(Clone, Copy, Debug)]
pub(super) struct Limited {
    pub(super) limit: DesignLimit,
    pub(super) place: LimitPlace,
    pub(super) found: f64,
    pub(super) allowed: f64,
}

impl Limited {
    /// Which of several smooth functions decides: a slip margin is that of the pulley that slips first.
    fn kind(&self) -> usize {
        match (self.limit, self.place.pulley) {
            (DesignLimit::SlipMargin, Some(pulley)) => pulley,
            _ => SMOOTH,
        }
    }

    /// By how much the missed share grows with the allowed value.
    pub(super) fn missed_with_allowed(&self) -> f64 {
        let slope = self.found / self.allowed.powi(2);
        if self.limit.is_smallest() {
            slope
        } else {
            -slope
        }
    }

    /// By which share of the limit it is missed; negative where there is room.
    pub(super) fn missed(&self) -> f64 {
        let share = self.found / self.allowed - 1.0;
        match self.limit.is_smallest() {
            true => -share,
            false => share,
        }
    }
}

impl DesignLimit {
    /// Whether it is the smallest value that is allowed, not the largest.
    pub(crate) fn is_smallest(self) -> bool {
        matches!(
            self,
            Self::LowerBound(_) | Self::SlipMargin | Self::SmallestDiameter
        )
    }
}

/// A drive at a place.
pub(super) struct Evaluated {
    /// What is to be small and all limits, if every load case has a state.
    pub(super) whole: Option<(Vec<f64>, Vec<Limited>)>,
    /// The slip margins alone, if every load case has a state or is beyond a known limit of its load.
    pub(super) margins: Option<Vec<Limited>>,
    /// Why a load case has no state.
    pub(super) refusal: Option<Refusal>,
}

/// A drive with free numbers.
pub(super) struct Problem<'q> {
    /// With the sense of the loop and the chosen values.
    pub(super) file: DriveFile,
    pub(super) question: &'q DesignQuestion,
    pub(super) options: &'q SolveOptions,
    /// What the objective is divided by.
    pub(super) unit: f64,
    /// By which share each limit is kept clear of, so that it holds in spite of errors.
    pub(super) clearance: f64,
    /// The drives that were judged, by their places.
    pub(super) known: Mutex<Vec<(Vec<f64>, Arc<Evaluated>)>>,
}

impl Problem<'_> {
    /// The free numbers at a place between 0 and 1 each, SI.
    pub(super) fn values(&self, place: &[f64]) -> Vec<f64> {
        let free = self.question.free.iter().zip(place);
        free.map(|(free, at)| match (free.bounds, *at) {
            ([low, _], 0.0) => low,
            ([_, high], 1.0) => high,
            ([low, high], at) => low + at * (high - low),
        })
        .collect()
    }

    /// What is to be small and the limits, as shares of their units, if every load case has a state.
    pub(super) fn functions(&self, place: &[f64]) -> Option<Values> {
        let found = self.evaluate(place);
        let (pieces, limits) = found.whole.as_ref()?;
        let share = |limited: &Limited| self.share(limited);
        Some(Values {
            pieces: pieces.iter().map(|piece| piece / self.unit).collect(),
            limits: limits.iter().map(share).collect(),
            kinds: { pieces.iter().map(|_| SMOOTH) }
                .chain(limits.iter().map(Limited::kind))
                .collect(),
        })
    }

    /// All limits as what is to be small.
    pub(super) fn limits(&self, place: &[f64]) -> Option<Values> {
        let found = self.evaluate(place);
        let (_, limits) = found.whole.as_ref()?;
        Some(self.as_pieces(limits))
    }

    /// The slip margins as what is to be small.
    pub(super) fn margins(&self, place: &[f64]) -> Option<Values> {
        let found = self.evaluate(place);
        Some(self.as_pieces(found.margins.as_ref()?))
    }

    /// Limits as what is to be small.
    fn as_pieces(&self, limits: &[Limited]) -> Values {
        Values {
            pieces: limits.iter().map(|limited| self.share(limited)).collect(),
            limits: Vec::new(),
            kinds: limits.iter().map(Limited::kind).collect(),
        }
    }

    /// By which share of it a limit is missed, with the share by which it is kept clear of. What is no result of a state
    /// has no error but rounding.
    fn share(&self, limited: &Limited) -> f64 {
        match limited.limit {
            DesignLimit::SmallestDiameter => limited.missed() - ROUNDING,
            _ => limited.missed() + self.clearance,
        }
    }

    /// By which share the limits are missed, if they are.
    pub(super) fn missed(&self, limits: &[Limited]) -> Option<f64> {
        let missed = limits.iter().filter(|limited| {
            let rounding = match limited.limit {
                DesignLimit::SmallestDiameter => ROUNDING,
                _ => 0.0,
            };
            limited.missed() > rounding
        });
        missed.map(Limited::missed).reduce(f64::max)
    }

    /// How many drives were judged.
    pub(super) fn judged(&self) -> usize {
        self.known.lock().map_or(0, |known| known.len())
    }

    /// The drive at a place; each is judged once.
    pub(super) fn evaluate(&self, place: &[f64]) -> Arc<Evaluated> {
        let known = || self.known.lock().ok();
        if let Some(found) = known().and_then(|known| {
            let mut known = known.iter();
            let found = known.find(|(other, _)| other == place)?;
            Some(Arc::clone(&found.1))
        }) {
            return found;
        }
        let found = Arc::new(self.judge(place));
        if let Some(mut known) = known() {
            known.push((place.to_vec(), Arc::clone(&found)));
        }
        found
    }

    fn judge(&self, place: &[f64]) -> Evaluated {
        let values = self.values(place);
        let file = self.file.designed(&self.question.free, &values);
        let service = match file.service() {
            Ok(service) => service,
            Err(error) => {
                return Evaluated {
                    whole: None,
                    margins: None,
                    refusal: Some(Refusal::Input(Box::new(error))),
                };
            }
        };
        let required = service.requirements;
        let least = required.smallest_slip_margin.unwrap_or(1.0);
        let (mut states, mut margins, mut refusal) = (Vec::new(), Some(Vec::new()), None);
        for (case, stated) in service.cases.iter().enumerate() {
            let found = judged(stated, &service.given_losses, self.options);
            let margin = match &found {
                Ok(state) => match state.slip_margin {
                    SlipMargin::Factor(margin) => Some((margin.value, Some(margin.pulley))),
                    SlipMargin::NoLoad => Some((f64::INFINITY, None)),
                    // Nobody asks for it.
                    SlipMargin::NotFound if required.smallest_slip_margin.is_none() => {
                        Some((f64::INFINITY, None))
                    }
                    SlipMargin::NotFound => None,
                },
                Err(
                    SolveError::GrossSlip {
                        load_factor,
                        pulley,
                        ..
                    }
                    | SolveError::Overloaded {
                        load_factor,
                        pulley,
                        ..
                    },
                ) => {
                    let mut pulleys = stated.drive.pulleys.iter();
                    let pulley = pulleys.position(|known| known.name == *pulley);
                    Some((*load_factor, pulley))
                }
                Err(_) => None,
            };
            let limited = margin.map(|(found, pulley)| Limited {
                limit: DesignLimit::SlipMargin,
                place: LimitPlace {
                    case: Some(case),
                    pulley,
                },
                // What cannot slip has room enough.
                found: found.min(NEVER * least),
                allowed: least,
            });
            margins = margins.zip(limited).map(|(mut margins, limited)| {
                margins.push(limited);
                margins
            });
            match found {
                Ok(state) => states.push(state),
                Err(error) => {
                    refusal.get_or_insert(Refusal::from(error));
                }
            }
        }
        let has_all = states.len() == service.cases.len();
        let whole = margins.clone().filter(|_| has_all).map(|margins| {
            let mut limits = margins;
            for (case, state) in states.iter().enumerate() {
                limits.extend(of_state(case, state, &service, &required));
            }
            limits.extend(diameters(&file, &service));
            (self.pieces(&file, &service, &states, &values), limits)
        });
        Evaluated {
            whole,
            margins,
            refusal,
        }
    }

    /// The functions of which the largest is to be small, SI.
    fn pieces(
        &self,
        file: &DriveFile,
        service: &Service,
        states: &[CaseState],
        values: &[f64],
    ) -> Vec<f64> {
        let all = |of: fn(&Service, usize, &CaseState) -> Vec<f64>| {
            let states = states.iter().enumerate();
            states
                .flat_map(|(case, state)| of(service, case, state))
                .collect()
        };
        match &self.question.objective {
            DesignObjective::HubLoad => all(|_, _, state| hub_loads(state).collect()),
            DesignObjective::SpeedLoss => all(|service, case, state| {
                speed_losses(service, case, state)
                    .map(|(_, loss)| loss)
                    .collect()
            }),
            DesignObjective::Loss => {
                let even = 1.0 / states.len() as f64;
                let loss = service.cases.iter().zip(states).map(|(case, state)| {
                    let given = state.losses.given().unwrap_or(0.0);
                    case.share.unwrap_or(even) * (state.losses.total + given)
                });
                vec![loss.sum()]
            }
            DesignObjective::BeltMass => {
                let mass = service.cases[0].drive.belt.mass_per_length;
                vec![mass * states[0].state.unstretched_length]
            }
            DesignObjective::Width => vec![file.belt_width().unwrap_or(f64::NAN)],
            DesignObjective::Key(key) => {
                let index = self.question.free.iter().position(|free| free.key == *key);
                vec![index.map_or(f64::NAN, |index| values[index])]
            }
        }
    }
}

/// The kind of a function that is smooth itself.
const SMOOTH: usize = 0;

/// Diameters may be off by rounding.
const ROUNDING: f64 = 1e-9;

/// A slip margin this many times the required one is as good as any larger one: it can decide nothing.
const NEVER: f64 = 1e3;

/// The hub loads of a state, N: of each pulley running, then at rest.
fn hub_loads(state: &CaseState) -> impl Iterator<Item = f64> + '_ {
    let loads = state.state.pulleys.iter();
    loads.flat_map(|pulley| [pulley.hub_load, pulley.rest_hub_load].map(|[x, y]| x.hypot(y)))
}

/// The speed losses that count in a state, as for [`CaseState::speed_loss`], with their pulleys.
fn speed_losses<'s>(
    service: &'s Service,
    case: usize,
    state: &'s CaseState,
) -> impl Iterator<Item = (usize, f64)> + 's {
    let pulleys = &state.state.pulleys;
    let drive = &service.cases[case].drive;
    let no_load = pulleys.iter().all(|pulley| pulley.torque == 0.0);
    let counts =
        move |index: usize| no_load || index != drive.driver() && pulleys[index].torque != 0.0;
    let losses = pulleys.iter().enumerate();
    losses
        .filter(move |(index, _)| counts(*index))
        .map(|(index, pulley)| (index, pulley.speed_loss))
}

/// The limits of the state of a load case, but for the slip margin.
fn of_state(
    case: usize,
    state: &CaseState,
    service: &Service,
    required: &Requirements,
) -> Vec<Limited> {
    let limited = |limit, pulley, found, allowed| Limited {
        limit,
        place: LimitPlace {
            case: Some(case),
            pulley,
        },
        found,
        allowed,
    };
    let speed = required.largest_speed_loss.into_iter().flat_map(|allowed| {
        speed_losses(service, case, state)
            .map(move |(pulley, loss)| limited(DesignLimit::SpeedLoss, Some(pulley), loss, allowed))
    });
    let hub = required.largest_hub_load.into_iter().flat_map(|allowed| {
        let loads = hub_loads(state).enumerate();
        loads
            .map(move |(index, load)| limited(DesignLimit::HubLoad, Some(index / 2), load, allowed))
    });
    let tension = required.largest_tension.into_iter().flat_map(|allowed| {
        let spans = state
            .state
            .spans
            .iter()
            .map(|span| span.tension)
            .enumerate();
        let spans = spans.map(|(span, tension)| (Some(span), tension));
        let all = spans.chain([(None, state.state.rest_tension)]);
        all.map(move |(span, tension)| limited(DesignLimit::Tension, span, tension, allowed))
    });
    speed.chain(hub).chain(tension).collect()
}

/// The diameters of the pulleys in grooves against the smallest that the section of the belt allows.
fn diameters(file: &DriveFile, service: &Service) -> Vec<Limited> {
    let Some(filled) = file.filled_in() else {
        return Vec::new();
    };
    let Some(smallest) = filled.section.smallest_diameter else {
        return Vec::new();
    };
    let drive = &service.cases[0].drive;
    let pulleys = drive.pulleys.iter().enumerate();
    let inside = pulleys.filter(|(_, pulley)| pulley.side == Side::Inside);
    inside
        .map(|(index, pulley)| Limited {
            limit: DesignLimit::SmallestDiameter,
            place: LimitPlace {
                case: None,
                pulley: Some(index),
            },
            found: 2.0 * pulley.radius,
            allowed: smallest.value,
        })
        .collect()
}
