//! What the solver promises, one property per file.

mod classes;
mod complex;
mod conditioning;
mod control;
mod derivative_states;
mod diagnostics;
mod embedding;
mod end_to_end;
mod exact;
mod failures;
mod family;
mod guesses;
mod homotopy;
mod honesty;
mod jacobians;
mod joined;
mod manufactured;
mod null_vectors;
mod order;
mod remesh;
mod reports;
mod reversed;
mod scalars;
mod statements;
mod work;
mod wright;
