//! The piece of a branch between two accepted points.

use crate::curve::corrector::{Accuracy, Condition, SHORT};
use crate::curve::curve::{Curve, ahead, reverse};
use crate::curve::root::root;
use crate::difficulty::Difficulty;
use crate::special_points::node::{Located, Node};
use crate::system::system::System;

/// The cosine of the largest angle between the tangents of a located point and of the nodes: those of
/// the nodes turn by 1.05 rad at most.
const OBLIQUE: f64 = 0.35;
/// Zeros are located to this share of a step.
pub(crate) const RESOLVED: f64 = 1e-13;
/// The most corrections of a located point.
const CORRECTIONS: usize = 30;

/// A function along the branch whose zero is sought: of the system, linearised at a point, that point
/// and its unit tangent.
pub(crate) type Test<'t, S> = dyn FnMut(&mut S, &[f64], &[f64]) -> f64 + 't;

/// The piece of a curve between two nodes.
pub(crate) struct Span<'s, 'a, S> {
    pub(crate) curve: &'s mut Curve<'a, S>,
    pub(crate) from: &'s Node,
    pub(crate) to: &'s Node,
}

impl<S: System> Span<'_, '_, S> {
    /// From node to node.
    pub(crate) fn secant(&self) -> Vec<f64> {
        let ends = self.to.z.iter().zip(&self.from.z);
        ends.map(|(b, a)| b - a).collect()
    }

    /// The place u of a point on the secant.
    pub(crate) fn place(&self, z: &[f64]) -> f64 {
        let secant = self.secant();
        let from: Vec<f64> = z.iter().zip(&self.from.z).map(|(z, a)| z - a).collect();
        self.curve.metric.dot(&secant, &from) / self.curve.metric.dot(&secant, &secant)
    }

    /// The point of the branch on `condition`, near a known one from which `shift` leads there.
    fn correct(
        &mut self,
        near: &Located,
        shift: f64,
        condition: &Condition,
        accuracy: Accuracy,
    ) -> Result<Located, Difficulty> {
        let mut z = ahead(&near.z, &near.tangent, shift);
        self.curve
            .correct(&mut z, condition, accuracy, CORRECTIONS)?;
        self.complete(z)
    }

    /// The point of the branch in the plane across `normal` through `through`, from `near`.
    pub(crate) fn across(
        &mut self,
        near: &[f64],
        normal: &[f64],
        through: &[f64],
    ) -> Result<Vec<f64>, Difficulty> {
        let mut z = near.to_vec();
        let plane = Condition::plane(&self.curve.metric, normal, through);
        let accuracy = Accuracy::Rounding;
        self.curve.correct(&mut z, &plane, accuracy, CORRECTIONS)?;
        Ok(z)
    }

    /// The point at u of the cubic through both nodes with their tangents.
    pub(crate) fn cubic(&self, u: f64) -> Vec<f64> {
        let chord = self.curve.metric.norm(&self.secant());
        let (v, ends) = (1.0 - u, self.from.z.iter().zip(&self.to.z));
        let tangents = self.from.tangent.iter().zip(&self.to.tangent);
        ends.zip(tangents)
            .map(|((a, b), (p, q))| {
                let line = v * v * (1.0 + 2.0 * u) * a + u * u * (1.0 + 2.0 * v) * b;
                line + chord * u * v * (v * p - u * q)
            })
            .collect()
    }

    /// The tangent and the place of a point of the branch; leaves the system linearised there.
    pub(crate) fn complete(&mut self, z: Vec<f64>) -> Result<Located, Difficulty> {
        let mut tangent = self.curve.tangent(&z)?;
        let along = self.curve.metric.dot(&tangent, &self.secant()) >= 0.0;
        if !along {
            reverse(&mut tangent);
        }
        let u = self.place(&z);
        let found = Located {
            u,
            z,
            tangent,
            along,
        };
        self.is_on_branch(&found).map(|()| found)
    }

    /// Refuses a point of another branch: where both nodes have the same orientation, those between
    /// have it too.
    fn is_on_branch(&self, found: &Located) -> Result<(), Difficulty> {
        let same = self.from.along != self.to.along || found.along == self.from.along;
        if same {
            Ok(())
        } else {
            let secant = self.secant();
            let near = self.from.z.iter().zip(&secant);
            let near: Vec<f64> = near.map(|(a, d)| a + found.u * d).collect();
            let gap = self.curve.metric.distance(&near, &found.z);
            Err(Difficulty::Imperfect { gap })
        }
    }

    pub(crate) fn ends(&self) -> [Located; 2] {
        [(0.0, self.from), (1.0, self.to)].map(|(u, node)| Located {
            u,
            z: node.z.clone(),
            tangent: node.tangent.clone(),
            along: node.along,
        })
    }

    /// The point where `test` is zero, between ends with values of different sign.
    pub(crate) fn zero(
        &mut self,
        test: &mut Test<'_, S>,
        values: [f64; 2],
        tolerance: f64,
    ) -> Result<Located, Difficulty> {
        let mut known: Vec<Located> = self.ends().into();
        let (location, length) = (self.curve.location, self.curve.metric.norm(&self.secant()));
        let search = |u: f64| -> Result<f64, Difficulty> {
            let found = self.at(u, &known)?;
            let value = test(self.curve.system, &found.z, &found.tangent);
            known.push(found);
            Ok(value)
        };
        let tolerance = tolerance.max(location / length);
        let u = root(search, (0.0, values[0]), (1.0, values[1]), tolerance)?;
        Ok(nearest(&known, u).clone())
    }

    /// The point at u, in the plane across the secant, from the nearest of both ends and points completed since.
    pub(crate) fn at(&mut self, u: f64, known: &[Located]) -> Result<Located, Difficulty> {
        let secant = self.secant();
        let target = ahead(&self.from.z, &secant, u);
        let plane = Condition::plane(&self.curve.metric, &secant, &target);
        let near = nearest(known, u);
        let unit = self.curve.metric.dot(&secant, &secant);
        let shift = (u - near.u) * unit / self.curve.metric.dot(&secant, &near.tangent);
        // The system is linearised at the last of them.
        let is_linearised = known[2..].last().is_some_and(|last| last.u == near.u);
        let found = if is_linearised && shift.abs() < SHORT {
            let mut z = ahead(&near.z, &near.tangent, shift);
            self.curve.locate_nearby(&mut z, &plane, CORRECTIONS)?;
            self.complete(z)?
        } else {
            self.correct(near, shift, &plane, self.curve.located())?
        };
        Ok(Located { u, ..found })
    }

    /// The point with a prescribed λ, which must be passed between the nodes.
    pub(crate) fn at_lambda(&mut self, lambda: f64) -> Result<Located, Difficulty> {
        let n = self.from.z.len() - 1;
        let (low, high) = (self.from.z[n], self.to.z[n]);
        let share = (lambda - low) / (high - low);
        let [from, to] = self.ends();
        let near = if share < 0.5 { from } else { to };
        // To the same λ along the tangent where that is sensible, else along the secant.
        let rate = near.tangent[n];
        let along = (lambda - near.z[n]) / rate;
        let length = self.curve.metric.norm(&self.secant());
        let condition = Condition::lambda(n + 1, lambda);
        let accuracy = Accuracy::Rounding;
        let attempt = if along.abs() <= length {
            self.correct(&near, along, &condition, accuracy)
        } else {
            Err(Difficulty::Singular)
        };
        let mut found = match attempt {
            Ok(found) if (-0.1..=1.1).contains(&found.u) => found,
            _ => {
                let mut distance = |_: &mut S, z: &[f64], _: &[f64]| z[n] - lambda;
                let near = self.zero(&mut distance, [low - lambda, high - lambda], RESOLVED)?;
                // At a limit point λ does not determine the point, and is met to rounding.
                self.correct(&near, 0.0, &condition, accuracy)
                    .unwrap_or(near)
            }
        };
        found.z[n] = lambda;
        Ok(found)
    }

    /// Whether a tangent between the nodes belongs to the branch that leads from one to the other: it
    /// turns by less than a right angle to either.
    pub(crate) fn leads_through(&self, tangent: &[f64]) -> bool {
        let ends = [self.from, self.to].into_iter();
        let mut cosines = ends.map(|node| self.curve.metric.dot(&node.tangent, tangent));
        cosines.all(|cosine| cosine > OBLIQUE)
    }

    /// The tangent of the two that leads from node to node.
    pub(crate) fn along_secant(&self, pair: &[Vec<f64>; 2]) -> Vec<f64> {
        let secant = self.secant();
        let [first, second] = [0, 1].map(|i| self.curve.metric.dot(&pair[i], &secant));
        let (mut tangent, product) = if first.abs() > second.abs() {
            (pair[0].clone(), first)
        } else {
            (pair[1].clone(), second)
        };
        if product < 0.0 {
            reverse(&mut tangent);
        }
        tangent
    }
}

/// The known point that is nearest to u.
pub(crate) fn nearest(known: &[Located], u: f64) -> &Located {
    let gap = |point: &Located| (point.u - u).abs();
    let nearest = known.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)));
    nearest.unwrap_or(&known[0])
}
