//! An interrupt from the keyboard.

use super::failure::Failure;
use signal_hook::{consts::SIGINT, flag};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Exit status of a command that an interrupt ended: what shells tell of a program that the signal 2 ended.
pub(super) const STATUS: u8 = 130;

/// Whether an interrupt has come.
pub(super) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Catches interrupts from now on; a second one ends the program at once.
    pub(super) fn catch() -> Result<Self, Failure> {
        let came = Arc::new(AtomicBool::new(false));
        // The first interrupt finds the flag not yet set, which the second handler sets.
        flag::register_conditional_shutdown(SIGINT, i32::from(STATUS), Arc::clone(&came))
            .and_then(|_| flag::register(SIGINT, Arc::clone(&came)))
            .map_err(|error| Failure::io("catch interrupts", &error))?;
        Ok(Self(came))
    }

    /// Whether one has come.
    pub(super) fn came(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}
