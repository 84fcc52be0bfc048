//! What the solver promises, one property per file.

mod end_to_end;
mod exact;
mod failures;
mod guesses;
mod honesty;
mod jacobians;
mod order;
mod scalars;
mod statements;
mod work;
mod wright;
