//! How fast the rows of a sweep are answered.

use std::sync::Mutex;
use std::time::{Duration, Instant};

/// The shortest time between two messages: a terminal shows no more, and rows may take some microseconds.
const PAUSE: Duration = Duration::from_millis(100);

/// Tells the share of the rows that are done, how many are done in a second, and how much time is left.
pub(super) struct Rate<'p> {
    total: usize,
    state: Mutex<State<'p>>,
}

struct State<'p> {
    progress: &'p mut (dyn FnMut(f64, &str) + Send),
    began: Instant,
    told: Instant,
    /// Rows answered in this run, and those that stood before.
    answered: usize,
    standing: usize,
}

impl<'p> Rate<'p> {
    pub(super) fn new(total: usize, progress: &'p mut (dyn FnMut(f64, &str) + Send)) -> Self {
        let now = Instant::now();
        let state = State {
            progress,
            began: now,
            told: now,
            answered: 0,
            standing: 0,
        };
        Self {
            total,
            state: Mutex::new(state),
        }
    }

    /// Counts rows that stood before.
    pub(super) fn stood(&self, rows: usize) {
        if let Ok(mut state) = self.state.lock() {
            state.standing += rows;
        }
    }

    /// Counts a row.
    pub(super) fn answered(&self) {
        let Ok(mut state) = self.state.lock() else {
            return;
        };
        state.answered += 1;
        if state.told.elapsed() < PAUSE {
            return;
        }
        state.told = Instant::now();
        let done = state.answered + state.standing;
        let rate = state.answered as f64 / state.began.elapsed().as_secs_f64();
        let left = self.total.saturating_sub(done) as f64 / rate;
        let share = done as f64 / self.total.max(1) as f64;
        let message = format!("{rate:.0} rows/s, {} left", time(left));
        (state.progress)(share, &message);
    }
}

/// A time in hours, minutes and seconds.
fn time(seconds: f64) -> String {
    let whole = |part: f64| part.floor();
    let (hours, minutes) = (whole(seconds / 3600.0), whole(seconds / 60.0) % 60.0);
    let seconds = whole(seconds) % 60.0;
    match (hours, minutes) {
        (0.0, 0.0) => format!("{seconds} s"),
        (0.0, _) => format!("{minutes} min {seconds} s"),
        _ => format!("{hours} h {minutes} min"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_in_their_units() {
        assert_eq!(time(59.9), "59 s");
        assert_eq!(time(61.0), "1 min 1 s");
        assert_eq!(time(7260.0), "2 h 1 min");
    }
}
