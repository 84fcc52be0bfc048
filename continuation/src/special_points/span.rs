//! The piece of a branch between two accepted points, and what lies on it.

use crate::curve::corrector::{Accuracy, Condition, Corrector};
use crate::curve::metric::Metric;
use crate::curve::root::root;
use crate::difficulty::Difficulty;
use crate::point::{Kind, Point};
use crate::special_points::branch_point::{Crossing, branch_point};
use crate::special_points::null_space::{self, NullSpace};
use crate::system::system::System;

/// Branch points are bracketed this closely before Newton's method takes over.
const BRACKET: f64 = 1e-3;
/// A located branch point may lie beside the step by this share of it: by Newton's method it is the
/// nearest one, bracketed to a thousandth.
const BESIDE: f64 = 0.05;
/// A second vector that turns by more than this, rad, without its component η, has turned over. With
/// η alone 10 of 100 pairs of branch points close to a bound were missed.
const OVER: f64 = 2.1;
/// The cosine of the largest angle between the tangents of a located point and of the nodes: those of
/// the nodes turn by 1.05 rad at most.
const OBLIQUE: f64 = 0.35;
/// Zeros are located to this share of a step.
pub(crate) const RESOLVED: f64 = 1e-13;
/// The most corrections of a located point.
const CORRECTIONS: usize = 30;

/// An accepted point with everything that is followed along the branch.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) z: Vec<f64>,
    /// Unit tangent in the direction of travel.
    pub(crate) tangent: Vec<f64>,
    /// Whether the system orients its null vector in the direction of travel: changes at branch
    /// points.
    pub(crate) along: bool,
    pub(crate) arclength: f64,
    /// Values of the event functions.
    pub(crate) events: Vec<f64>,
    /// Value of the cusp function of the system.
    pub(crate) cusp: Option<f64>,
    /// The second vector of the null space of \[J b\].
    pub(crate) second: Vec<f64>,
}

impl Node {
    pub(crate) fn new(z: Vec<f64>, tangent: Vec<f64>) -> Self {
        Self {
            z,
            tangent,
            along: true,
            arclength: 0.0,
            events: Vec::new(),
            cusp: None,
            second: Vec::new(),
        }
    }

    /// The point, of this kind, that a caller sees.
    pub(crate) fn point(&self, kind: Kind) -> Point {
        Point {
            z: self.z.clone(),
            tangent: self.tangent.clone(),
            arclength: self.arclength,
            kind,
            other: None,
            approximate: false,
            error: None,
        }
    }

    /// Length of the cubic from this node to another one with their tangents, by the Gauss rule with
    /// three points.
    pub(crate) fn length_to(&self, to: &Self, metric: &Metric) -> f64 {
        let ends = to.z.iter().zip(&self.z);
        let secant: Vec<f64> = ends.map(|(b, a)| b - a).collect();
        let chord = metric.norm(&secant);
        let rule = [
            (0.5 - 0.15f64.sqrt(), 5.0),
            (0.5, 8.0),
            (0.5 + 0.15f64.sqrt(), 5.0),
        ];
        let speed = |u: f64| {
            // Derivatives of the Hermite basis.
            let (d, a, b) = (
                6.0 * u * (1.0 - u),
                (1.0 - u) * (1.0 - 3.0 * u),
                u * (3.0 * u - 2.0),
            );
            let tangents = self.tangent.iter().zip(&to.tangent);
            let rate: Vec<f64> = secant
                .iter()
                .zip(tangents)
                .map(|(s, (p, q))| d * s + chord * (a * p + b * q))
                .collect();
            metric.norm(&rate)
        };
        rule.iter()
            .map(|&(u, weight)| weight * speed(u))
            .sum::<f64>()
            / 18.0
    }

    /// The second vector, continued smoothly along the branch, also through branch points.
    fn continued_second(&self) -> impl Iterator<Item = f64> + '_ {
        let sign = if self.along { 1.0 } else { -1.0 };
        self.second.iter().map(move |v| sign * v)
    }

    /// The angle between the second vectors of two nodes, each continued smoothly along the branch. It
    /// is beyond a right angle where one turned over that should not have: two branch points have been
    /// passed, or there is another branch in between.
    pub(crate) fn second_angle(&self, to: &Self, metric: &Metric) -> f64 {
        let [a, b]: [Vec<f64>; 2] = [self, to].map(|node| node.continued_second().collect());
        let angle = |dot: &dyn Fn(&[f64], &[f64]) -> f64| {
            let cosine = dot(&a, &b) / (dot(&a, &a) * dot(&b, &b)).sqrt();
            cosine.clamp(-1.0, 1.0).acos()
        };
        // η has the same sign behind two branch points, and outweighs the rest where b is small.
        let without_eta = angle(&|a, b| metric.dot(&a[..a.len() - 1], &b[..b.len() - 1]));
        if without_eta > OVER {
            without_eta
        } else {
            angle(&|a, b| null_space::dot(metric, a, b))
        }
    }

    /// The height of the null space of \[J b\] above J, with a sign that changes at branch points.
    pub(crate) fn height(&self) -> f64 {
        let height = self.second.last().map_or(0.0, |eta| eta.abs());
        if self.along { height } else { -height }
    }
}

/// A function along the branch whose zero is sought: of the system, linearised at a point, that point
/// and its unit tangent.
pub(crate) type Test<'t, S> = dyn FnMut(&mut S, &[f64], &[f64]) -> f64 + 't;

/// A point between two nodes, at 0 ≤ u ≤ 1 of the secant.
#[derive(Clone, Debug)]
pub(crate) struct Located {
    pub(crate) u: f64,
    pub(crate) z: Vec<f64>,
    pub(crate) tangent: Vec<f64>,
    /// Whether the system orients its null vector in the direction of travel.
    pub(crate) along: bool,
}

/// Everything a search between two nodes works with.
pub(crate) struct Span<'a, S> {
    pub(crate) system: &'a mut S,
    pub(crate) corrector: &'a mut Corrector,
    pub(crate) metric: &'a Metric,
    /// The column b of the test function for branch points.
    pub(crate) column: &'a [f64],
    pub(crate) from: &'a Node,
    pub(crate) to: &'a Node,
}

impl<S: System> Span<'_, S> {
    /// From node to node.
    pub(crate) fn secant(&self) -> Vec<f64> {
        let ends = self.to.z.iter().zip(&self.from.z);
        ends.map(|(b, a)| b - a).collect()
    }

    /// The place u of a point on the secant.
    pub(crate) fn place(&self, z: &[f64]) -> f64 {
        let secant = self.secant();
        let from: Vec<f64> = z.iter().zip(&self.from.z).map(|(z, a)| z - a).collect();
        self.metric.dot(&secant, &from) / self.metric.dot(&secant, &secant)
    }

    /// The point of the branch on `condition`, near a known one from which `shift` leads there.
    fn correct(
        &mut self,
        near: &Located,
        shift: f64,
        condition: &Condition,
    ) -> Result<Located, Difficulty> {
        let pairs = near.z.iter().zip(&near.tangent);
        let mut z: Vec<f64> = pairs.map(|(z, t)| z + shift * t).collect();
        let accuracy = Accuracy::Rounding;
        self.corrector.correct(
            self.system,
            self.metric,
            &mut z,
            condition,
            accuracy,
            CORRECTIONS,
        )?;
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
        let plane = Condition::plane(self.metric, normal, through);
        let accuracy = Accuracy::Rounding;
        self.corrector.correct(
            self.system,
            self.metric,
            &mut z,
            &plane,
            accuracy,
            CORRECTIONS,
        )?;
        Ok(z)
    }

    /// The point at u of the cubic through both nodes with their tangents.
    pub(crate) fn cubic(&self, u: f64) -> Vec<f64> {
        let chord = self.metric.norm(&self.secant());
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
        let mut tangent = self.corrector.tangent(self.system, self.metric, &z)?;
        let along = self.metric.dot(&tangent, &self.secant()) >= 0.0;
        if !along {
            tangent.iter_mut().for_each(|t| *t = -*t);
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
            let gap = self.metric.distance(&near, &found.z);
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
        let search = |u: f64| -> Result<f64, Difficulty> {
            let found = self.at(u, nearest(&known, u))?;
            let value = test(self.system, &found.z, &found.tangent);
            known.push(found);
            Ok(value)
        };
        let u = root(search, (0.0, values[0]), (1.0, values[1]), tolerance)?;
        Ok(nearest(&known, u).clone())
    }

    /// The point at u, in the plane across the secant, from a known one.
    pub(crate) fn at(&mut self, u: f64, near: &Located) -> Result<Located, Difficulty> {
        let secant = self.secant();
        let base = self.from.z.iter().zip(&secant);
        let target: Vec<f64> = base.map(|(a, d)| a + u * d).collect();
        let plane = Condition::plane(self.metric, &secant, &target);
        let unit = self.metric.dot(&secant, &secant);
        let shift = (u - near.u) * unit / self.metric.dot(&secant, &near.tangent);
        let found = self.correct(near, shift, &plane)?;
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
        let length = self.metric.norm(&self.secant());
        let condition = Condition::lambda(n + 1, lambda);
        let attempt = if along.abs() <= length {
            self.correct(&near, along, &condition)
        } else {
            Err(Difficulty::Singular)
        };
        let mut found = match attempt {
            Ok(found) if (-0.1..=1.1).contains(&found.u) => found,
            _ => {
                let mut distance = |_: &mut S, z: &[f64], _: &[f64]| z[n] - lambda;
                let near = self.zero(&mut distance, [low - lambda, high - lambda], RESOLVED)?;
                // At a limit point λ does not determine the point, and is met to rounding.
                self.correct(&near, 0.0, &condition).unwrap_or(near)
            }
        };
        found.z[n] = lambda;
        Ok(found)
    }

    /// The branch point that changes the orientation between the nodes.
    pub(crate) fn crossing(&mut self) -> Result<(Located, Crossing), Difficulty> {
        // The height of the null space above J changes its sign with the orientation.
        let eta = [self.from, self.to].map(Node::height);
        let (along, metric, column) = (self.from.along, self.metric, self.column);
        let start = eta[0].signum();
        let mut height = |system: &mut S, _: &[f64], tangent: &[f64]| {
            let mut null = tangent.to_vec();
            system.null_vector(&mut null);
            let same = (metric.dot(&null, tangent) > 0.0) == along;
            let second = NullSpace::second(system, metric, tangent, column);
            let height = second.map_or(0.0, |second| second[second.len() - 1].abs());
            if same {
                start * height
            } else {
                -start * height
            }
        };
        let near = match self.zero(&mut height, eta, BRACKET) {
            Ok(near) => near.z,
            // Too close to the branch point to stay on the curve: start from the better end.
            Err(_) if eta[0].abs() < eta[1].abs() => self.from.z.clone(),
            Err(_) => self.to.z.clone(),
        };
        let crossing = branch_point(self.system, self.corrector, self.metric, &near, self.column)?;
        let place = self.place(&crossing.z);
        // What is found must lie between the nodes.
        let off: Vec<f64> = self
            .secant()
            .iter()
            .zip(&self.from.z)
            .zip(&crossing.z)
            .map(|((d, a), z)| z - a - place * d)
            .collect();
        let length = self.metric.norm(&self.secant());
        let gap = self.metric.norm(&off);
        let tangent = match &crossing.tangents {
            Some(pair) => self.along_secant(pair),
            None => self.to.tangent.clone(),
        };
        let between = (-BESIDE..=1.0 + BESIDE).contains(&place) && gap <= length;
        if !between || !self.leads_through(&tangent) {
            return Err(Difficulty::Imperfect { gap });
        }
        let z = crossing.z.clone();
        let u = place.clamp(0.0, 1.0);
        let along = self.to.along;
        let at = Located {
            u,
            z,
            tangent,
            along,
        };
        Ok((at, crossing))
    }

    /// Whether a tangent between the nodes belongs to the branch that leads from one to the other: it
    /// turns by less than a right angle to either.
    pub(crate) fn leads_through(&self, tangent: &[f64]) -> bool {
        let ends = [self.from, self.to].into_iter();
        let mut cosines = ends.map(|node| self.metric.dot(&node.tangent, tangent));
        cosines.all(|cosine| cosine > OBLIQUE)
    }

    /// The tangent of the two that leads from node to node.
    fn along_secant(&self, pair: &[Vec<f64>; 2]) -> Vec<f64> {
        let secant = self.secant();
        let [first, second] = [0, 1].map(|i| self.metric.dot(&pair[i], &secant));
        let (mut tangent, product) = if first.abs() > second.abs() {
            (pair[0].clone(), first)
        } else {
            (pair[1].clone(), second)
        };
        if product < 0.0 {
            tangent.iter_mut().for_each(|t| *t = -*t);
        }
        tangent
    }
}

/// The known point that is nearest to u.
fn nearest(known: &[Located], u: f64) -> &Located {
    let gap = |point: &Located| (point.u - u).abs();
    let nearest = known.iter().min_by(|a, b| gap(a).total_cmp(&gap(b)));
    nearest.unwrap_or(&known[0])
}
