//! An answer as JSON: complete, at full precision, every key with its unit.

use super::tree::tree;
use crate::quantity::Answer;

/// An answer as pretty-printed JSON. Angles are in degrees (`_deg`), everything else is in SI units; a
/// number that is not known is `null`.
pub fn json(answer: &Answer) -> String {
    serde_json::to_string_pretty(&tree(answer)).expect("strings and numbers")
}
