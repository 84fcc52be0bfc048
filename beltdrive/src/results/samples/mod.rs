//! Made-up but plausible results with exact plane geometry, for the tests of what reads results.

pub(crate) mod branch;
pub(crate) mod flat;
pub(crate) mod v_belt;
