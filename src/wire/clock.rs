//! Wall-clock time of the phases of a step.

use std::time::Instant;

/// Measures phases.
pub(in crate::wire) struct Clock(Instant);

impl Clock {
    pub(in crate::wire) fn start() -> Self {
        Clock(Instant::now())
    }

    /// Seconds since the start or the last lap.
    pub(in crate::wire) fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let seconds = now.duration_since(self.0).as_secs_f64();
        self.0 = now;
        seconds
    }
}
