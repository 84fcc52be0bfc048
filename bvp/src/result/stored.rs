//! A solution as it is written and read: its numbers, without the tableau of its scheme.

use crate::discretisation::iterate::{Iterate, SegmentIterate};
use crate::discretisation::scheme::Scheme;
use crate::discretisation::tableau::Tableau;
use crate::problem::problem::Segment;
use crate::result::error::{Error, check_sizes};
use crate::result::quality::{Defects, GlobalErrors, Quality};
use crate::result::solution::Solution;
use crate::result::stats::Stats;

/// The numbers of a solution. What is not known or not finite of its accuracy is left out, since some
/// formats have no infinite numbers.
#[derive(Clone, serde::Serialize, serde::Deserialize)]
pub(crate) struct Stored {
    segments: Vec<Segment>,
    /// The units of the states of all segments and of the parameters.
    #[serde(default)]
    absolute: Vec<f64>,
    scheme: Scheme,
    parameters: Vec<f64>,
    /// For every segment its nodes, the states there and the slopes at the stages.
    nodes: Vec<Vec<f64>>,
    states: Vec<Vec<f64>>,
    slopes: Vec<Vec<f64>>,
    /// The residuals of the conditions.
    conditions: Vec<f64>,
    /// The relative and the local defects.
    defects: Option<[Vec<Vec<f64>>; 2]>,
    /// The estimated errors of the states and of the parameters.
    errors: Option<(Vec<Vec<f64>>, Vec<f64>)>,
    stats: Stats,
}

fn are_finite(values: &[Vec<f64>]) -> bool {
    values.iter().flatten().all(|value| value.is_finite())
}

impl From<Solution> for Stored {
    fn from(solution: Solution) -> Self {
        let Defects { relative, local } = solution.quality.defects;
        let defects = [relative, local];
        let conditions = solution.quality.conditions;
        let errors = solution.quality.errors.map(|e| (e.states, e.parameters));
        let (states, slopes) = solution
            .x
            .segments
            .into_iter()
            .map(|x| (x.nodes, x.stages))
            .unzip();
        Self {
            segments: solution.segments,
            absolute: solution.absolute,
            scheme: solution.tableau.scheme,
            parameters: solution.x.p,
            nodes: solution.mesh,
            states,
            slopes,
            conditions: match conditions.iter().all(|r| r.is_finite()) {
                true => conditions,
                false => vec![],
            },
            defects: Some(defects).filter(|all| all.iter().all(|values| are_finite(values))),
            errors: errors.filter(|(states, parameters)| {
                are_finite(states) && parameters.iter().all(|error| error.is_finite())
            }),
            stats: solution.stats,
        }
    }
}

impl TryFrom<Stored> for Solution {
    type Error = Error;

    /// Refuses numbers that are not those of a solution.
    fn try_from(stored: Stored) -> Result<Self, Error> {
        stored.check()?;
        let mesh = stored.nodes;
        let defects = match stored.defects {
            Some([relative, local]) => Defects { relative, local },
            None => Defects::unknown(&mesh),
        };
        let unknowns = stored.states.into_iter().zip(stored.slopes);
        Ok(Self {
            segments: stored.segments,
            absolute: stored.absolute,
            tableau: Tableau::of(stored.scheme),
            x: Iterate {
                segments: unknowns
                    .map(|(nodes, stages)| SegmentIterate { nodes, stages })
                    .collect(),
                p: stored.parameters,
            },
            quality: Quality {
                defects,
                conditions: stored.conditions,
                errors: stored
                    .errors
                    .map(|(states, parameters)| GlobalErrors { states, parameters }),
            },
            mesh,
            stats: stored.stats,
        })
    }
}

impl serde::Serialize for Solution {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Stored::from(self.clone()).serialize(serializer)
    }
}

impl<'de> serde::Deserialize<'de> for Solution {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let stored = Stored::deserialize(deserializer)?;
        Self::try_from(stored).map_err(serde::de::Error::custom)
    }
}

impl Stored {
    /// Checks that every segment has its nodes and a number for every unknown.
    fn check(&self) -> Result<(), Error> {
        let scheme = self.scheme;
        if !scheme.is_valid() {
            return Err(Error::Stages { scheme });
        }
        if self.segments.is_empty() {
            return Err(Error::NoSegments);
        }
        for (index, segment) in self.segments.iter().enumerate() {
            let (n, nodes) = (segment.states, self.nodes.get(index));
            if n == 0 {
                return Err(Error::NoStates { segment: index });
            }
            let Some(nodes) = nodes.filter(|nodes| segment.has_mesh(nodes)) else {
                return Err(Error::GuessMesh {
                    segment: index,
                    from: segment.from,
                    to: segment.to,
                });
            };
            let intervals = nodes.len() - 1;
            let stages = scheme.stages();
            let sizes = [
                (self.states.get(index), (intervals + 1) * n),
                (self.slopes.get(index), intervals * stages * n),
            ];
            let known = self.defects.iter().flatten();
            let known = known.map(|defects| (defects.get(index), intervals));
            let errors = self.errors.iter().map(|(states, _)| (states.get(index), n));
            for (values, needed) in sizes.into_iter().chain(known).chain(errors) {
                let found = values.map_or(0, Vec::len);
                if found != needed {
                    return Err(Error::GuessStates {
                        segment: index,
                        found,
                        needed,
                    });
                }
            }
        }
        self.check_absolute()?;
        let needed = self.parameters.len();
        match self.errors.as_ref().map(|(_, errors)| errors.len()) {
            Some(found) if found != needed => Err(Error::GuessParameters { found, needed }),
            _ => Ok(()),
        }
    }

    /// Checks that there is no unit or one for every state and parameter.
    fn check_absolute(&self) -> Result<(), Error> {
        let (found, parameters) = (self.absolute.len(), self.parameters.len());
        let states = self.segments.iter().map(|segment| segment.states).sum();
        if ![0, states + parameters].contains(&found) {
            return Err(Error::AbsoluteCount {
                found,
                states,
                parameters,
            });
        }
        check_sizes(&self.absolute)
    }
}
