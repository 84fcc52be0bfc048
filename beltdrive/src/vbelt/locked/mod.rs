//! A drive whose belt locks on both pulleys, without a guess of its state.
//!
//! A belt that slides into a groove at full friction comes to rest at one place only in the plane of its states, a saddle
//! (see `rest`): it nears that place exponentially, and leaves it in the same way before it is lifted out of the groove.
//! The arcs on both sides know of each other by what is left of the exponentials, so that every number of a drive follows
//! from one equation of its own:
//!
//! ```text
//! mass flow G         the belt enters the driver with the tension of the tight span
//! driven speed ω₁     it enters the driven pulley with that of the slack span
//! exits               it leaves a pulley with the tension of the span behind it
//! locked arcs         the wraps close the drive
//! ```
//!
//! Elastic friction may hold the belt on its way (see `held`): at a depth of its own, which follows from the displacement that
//! is zero at the entry. The belt sticks there and breaks loose with the displacement that it has at the end of that arc.
//!
//! The arcs are integrated from where errors decay (see `arc`), as accurately as the guess of the boundary value problem
//! needs to be. Where the belt slides far before it is lifted no such guess is made.

mod arc;
mod entry;
mod exit;
mod guess;
mod held;
mod pulley;
mod rest;
mod runge_kutta;

pub(super) use guess::Locked;
