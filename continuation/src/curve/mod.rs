//! Steps along a curve: the metric, the predictor, the corrector.

pub(crate) mod corrector;
pub(crate) mod curve;
pub(crate) mod metric;
pub(crate) mod predictor;
pub(crate) mod root;
