//! What the solver promises, one property per file.

mod control;
mod end_to_end;
mod exact;
mod failures;
mod family;
mod guesses;
mod honesty;
mod jacobians;
mod null_vectors;
mod order;
mod remesh;
mod scalars;
mod statements;
mod work;
mod wright;
