//! The inner product in which the arclength is measured.

use crate::options::Options;
use crate::system::system::System;

/// Groups smaller than this fraction of the largest have no size of their own yet.
const NEGLIGIBLE: f64 = 1e-8;

/// Sizes below this are none: their squares are not numbers of full precision.
const TINY: f64 = 1e-150;
/// Sizes below this share of what the first tangent reaches over the range of λ are rounding of zero: a start
/// at x = 1e-23 instead of 0 ended its branch at once. Corrected starts at limit points, where the tangent
/// reaches far, have shares of 1e-8.
const ROUNDED: f64 = 1e-10;
/// Tangents that reach further than this many times the largest size, or one, are vertical: as far as
/// unknowns of that size would be rounding. With 1e12 a tangent at a pitchfork, vertical but for 1e-12 by
/// differences, made sizes of 1e12 of unknowns of 4, and the branch was not found.
pub(crate) const FARTHEST: f64 = 1.0 / ROUNDED;
/// The same for the other branch at a branch point, whose rate of λ is known no better than its place: with
/// 1e10, of a pitchfork in units of 10 to 1000 rates of 1e-9 made sizes of 1e9, beside which no correction showed,
/// and points that are no solutions were accepted. A unit that is larger costs some steps.
pub(crate) const FARTHEST_ACROSS: f64 = 1e4;

/// The weighted inner product ⟨a, b⟩ = Σ wᵢ aᵢ bᵢ.
///
/// By default, with the size of a group the largest |xᵢ| met in it so far,
///
/// ```text
/// wᵢ = shareᵢ / (number of groups · size²)       w_λ = 1 / range of λ²
/// ```
///
/// so that neither units nor the number of samples of a function nor copies of equations change the
/// length. A group that is still zero takes the size that the first tangent reaches over the range
/// of λ, else that of the largest group, else one.
#[derive(Clone, Debug)]
pub(crate) struct Metric {
    group: Vec<usize>,
    share: Vec<f64>,
    size: Vec<f64>,
    /// Whether the size of a group was never met: it is what a tangent reaches, that of another group, or one.
    is_borrowed: Vec<bool>,
    range: f64,
    weights: Vec<f64>,
    /// Weights given by the caller are never changed.
    given: bool,
}

impl Metric {
    /// The inner product for a system at its first point `z`.
    pub(crate) fn new(system: &impl System, options: &Options, z: &[f64]) -> Self {
        let [low, high] = options.bounds;
        let range = high - low;
        let mut metric = Self {
            group: Vec::new(),
            share: Vec::new(),
            size: Vec::new(),
            is_borrowed: Vec::new(),
            range: if range.is_finite() {
                range
            } else {
                z[z.len() - 1].abs().max(1.0)
            },
            weights: options.weights.clone().unwrap_or_default(),
            given: options.weights.is_some(),
        };
        metric.regroup(system);
        metric.observe(z);
        metric
    }

    /// Takes over the groups of a system that has changed.
    pub(crate) fn regroup(&mut self, system: &impl System) {
        if self.given {
            return;
        }
        let n = system.unknowns() - 1;
        self.group.resize(n, 0);
        self.share.resize(n, 0.0);
        system.groups(&mut self.group, &mut self.share);
        let groups = self.group.iter().max().map_or(0, |last| last + 1);
        self.size.resize(groups, 0.0);
        self.weigh();
    }

    /// Takes note of the size of a point.
    pub(crate) fn observe(&mut self, z: &[f64]) {
        if self.given {
            return;
        }
        for ((&group, &share), x) in self.group.iter().zip(&self.share).zip(z) {
            if share > 0.0 {
                self.size[group] = self.size[group].max(x.abs());
            }
        }
        self.weigh();
    }

    /// Gives groups that are zero the size that the tangent `t` reaches over the range of λ, else, and where it
    /// reaches `farthest` times the largest size or more, that of the largest group, else one.
    pub(crate) fn reach(&mut self, t: &[f64], farthest: f64) {
        let rate = t[t.len() - 1].abs();
        if self.given {
            return;
        }
        let negligible = NEGLIGIBLE * self.largest();
        let farthest = farthest * self.largest().max(1.0);
        let mut reached = vec![0.0f64; self.size.len()];
        for ((&group, &share), t) in self.group.iter().zip(&self.share).zip(t) {
            if share > 0.0 {
                reached[group] = reached[group].max((t / rate).abs() * self.range);
            }
        }
        // Of a vertical tangent the rate of λ is rounding, and so are the sizes that it reaches.
        let vertical = reached
            .iter()
            .any(|&reached| reached.is_nan() || reached > farthest);
        for (size, reached) in self.size.iter_mut().zip(reached) {
            let empty = *size <= negligible.max(ROUNDED * reached);
            if empty && !vertical {
                *size = size.max(reached);
            }
        }
        let sizes: Vec<f64> = (0..self.size.len())
            .map(|group| self.size_of(group))
            .collect();
        let pairs = sizes.iter().zip(&self.size);
        self.is_borrowed = pairs.map(|(new, own)| new != own).collect();
        self.size = sizes;
        self.weigh();
    }

    /// Makes sizes that are not a group's own less by this factor; false where there are none.
    pub(crate) fn shrink(&mut self, factor: f64) -> bool {
        let pairs = self.size.iter_mut().zip(&self.is_borrowed);
        let borrowed = pairs.filter(|(_, is_borrowed)| **is_borrowed);
        let count = borrowed.map(|(size, _)| *size *= factor).count();
        self.weigh();
        count > 0
    }

    fn largest(&self) -> f64 {
        self.size.iter().copied().fold(0.0, f64::max)
    }

    /// The size of a group, or its substitute.
    fn size_of(&self, group: usize) -> f64 {
        let largest = self.largest();
        let size = self.size[group];
        if size > TINY.max(NEGLIGIBLE * largest) {
            size
        } else if largest > TINY {
            largest
        } else {
            1.0
        }
    }

    /// The change of unknown i that counts as one; zero if it does not count.
    pub(crate) fn scale(&self, i: usize) -> f64 {
        let n = self.weights.len() - 1;
        if self.given {
            let weight = self.weights[i];
            return if weight > 0.0 {
                weight.sqrt().recip()
            } else {
                0.0
            };
        }
        if i == n {
            self.range
        } else if self.share[i] > 0.0 {
            self.size_of(self.group[i])
        } else {
            0.0
        }
    }

    fn weigh(&mut self) {
        let groups = self.size.len() as f64;
        let each: Vec<f64> = (0..self.size.len())
            .map(|group| 1.0 / (groups * self.size_of(group).powi(2)))
            .collect();
        self.weights.clear();
        let members = self.group.iter().zip(&self.share);
        self.weights
            .extend(members.map(|(&group, share)| share * each[group]));
        self.weights.push(1.0 / self.range.powi(2));
    }

    /// The range of λ that counts as one.
    pub(crate) fn range(&self) -> f64 {
        self.range
    }

    /// ⟨a, b⟩.
    pub(crate) fn dot(&self, a: &[f64], b: &[f64]) -> f64 {
        let terms = self.weights.iter().zip(a).zip(b);
        terms.map(|((w, a), b)| w * a * b).sum()
    }

    /// ‖a‖.
    pub(crate) fn norm(&self, a: &[f64]) -> f64 {
        self.dot(a, a).sqrt()
    }

    /// ‖a − b‖.
    pub(crate) fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        let terms = self.weights.iter().zip(a).zip(b);
        let square: f64 = terms.map(|((w, a), b)| w * (a - b) * (a - b)).sum();
        square.sqrt()
    }

    /// The functional ⟨a, ·⟩ as a row.
    pub(crate) fn row(&self, a: &[f64]) -> Vec<f64> {
        self.weights.iter().zip(a).map(|(w, a)| w * a).collect()
    }

    /// The largest value of a functional, given as a row, on vectors of length one. Unknowns that do not
    /// count in the length are left out.
    pub(crate) fn norm_of_row(&self, row: &[f64]) -> f64 {
        let counted = self.weights.iter().zip(row).filter(|(w, _)| **w > 0.0);
        counted.map(|(w, r)| r * r / w).sum::<f64>().sqrt()
    }

    /// Scales `t` to length one; false where it has none.
    pub(crate) fn normalise(&self, t: &mut [f64]) -> bool {
        let norm = self.norm(t);
        let usable = norm > 0.0 && norm.is_finite();
        if usable {
            t.iter_mut().for_each(|t| *t /= norm);
        }
        usable
    }

    /// The largest |a − b| over the unknowns x, relative to the size of their groups. With given
    /// weights relative to 1 + |b|.
    pub(crate) fn largest_difference(&self, a: &[f64], b: &[f64]) -> f64 {
        let n = a.len() - 1;
        let relative = |i: usize| {
            let difference = (a[i] - b[i]).abs();
            if self.given {
                difference / (1.0 + b[i].abs())
            } else if self.share[i] > 0.0 {
                difference / self.size_of(self.group[i])
            } else {
                0.0
            }
        };
        (0..n).map(relative).fold(0.0, f64::max)
    }
}
