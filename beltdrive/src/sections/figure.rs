//! A number of a section with its source.

use super::Source;

/// A number of a section.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// The number, SI.
    pub value: f64,
    /// Smallest and largest number found, or to be expected of an estimate, SI.
    pub range: Option<[f64; 2]>,
    /// How the number is known.
    pub kind: Kind,
    /// Where it is from; the first source is that of the value.
    pub sources: &'static [Source],
}

/// How a number is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// It stands in the source.
    Printed,
    /// It follows from numbers of the source by geometry.
    Derived,
    /// It is estimated from belts like this one.
    Estimate,
}

impl Kind {
    /// The word for it in outputs.
    pub fn name(self) -> &'static str {
        match self {
            Self::Printed => "printed",
            Self::Derived => "derived",
            Self::Estimate => "estimate",
        }
    }
}

impl Figure {
    /// A number that stands in its sources.
    pub(super) const fn printed(value: f64, sources: &'static [Source]) -> Self {
        Self {
            value,
            range: None,
            kind: Kind::Printed,
            sources,
        }
    }

    /// The same, with the range of numbers in its sources.
    pub(super) const fn within(self, low: f64, high: f64) -> Self {
        Self {
            range: Some([low, high]),
            ..self
        }
    }

    /// The number and its range times a positive factor, as for several equal belts.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        Self {
            value: self.value * factor,
            range: self.range.map(|range| range.map(|end| end * factor)),
            ..self
        }
    }
}

/// A length in mm that stands in its sources.
pub(super) const fn mm(value: f64, sources: &'static [Source]) -> Option<Figure> {
    Some(Figure::printed(value / 1e3, sources))
}

/// An angle in degrees that stands in its sources.
pub(super) const fn degrees(value: f64, sources: &'static [Source]) -> Option<Figure> {
    Some(Figure::printed(value.to_radians(), sources))
}
