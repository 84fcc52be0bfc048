//! The shares and factors by which more than one decision of the solver is made. Each has one meaning.

/// What a mesh is made for, and what one of the parts of an error may be, as a share of what is allowed: the
/// power law that predicts an error holds up to a factor of about three.
pub(crate) const AIM: f64 = 0.3;

/// A part of this share or less does not show in the whole: a tenth of the tolerance beside an error within
/// it.
pub(crate) const UNNOTICED: f64 = 0.1;

/// What does not show in that for which a mesh is made. Newton's corrections end at this share of the
/// tolerance: with 0.1 half of the 40 solved ones among 600 random problems that are hardly isolated were
/// lost.
pub(crate) const INVISIBLE: f64 = AIM * UNNOTICED;

/// What fewer than two digits show. With less than these a solution is as good as unknown, as where its rounding is
/// more, and with these it is a guess; beside what is larger by more, a state is small, the defect of an interval is
/// not one of the largest, and a correction does not show.
pub(crate) const TWO_DIGITS: f64 = 1e-2;

/// A part of this share or less is as good as none: three digits of what it is compared with do not show it.
pub(crate) const NEGLIGIBLE: f64 = 1e-3;

/// Numbers whose ratio is at most this may be added and eliminated: ten of the sixteen digits are left.
pub(crate) const MODERATE: f64 = 1e6;

/// Into how many parts an interval is cut that does not show what is in it: a defect at a further place. With 2,
/// problems with singular ends took 12 % more factorisations, and 8 of 503 were lost.
pub(crate) const PARTS: usize = 4;

/// How many parts of a segment are told apart: by a look at so many places at least, which costs as much as four to
/// five intervals, and by forcings of so many groups of intervals at most.
pub(crate) const PLACES: usize = 64;

/// A size known from one sample, as from one direction or one place, may be larger by this factor.
pub(crate) const ONE_SAMPLE: f64 = 10.0;

/// The shortest distance at which places are told apart, in spacings of floating-point numbers: a place or a
/// state is a sum of at most eight rounded products, each of which is off by half a spacing.
pub(crate) const SPACINGS: f64 = 16.0;
