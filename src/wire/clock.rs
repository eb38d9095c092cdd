//! Wall-clock time of the phases of a step.

use std::time::Instant;

/// Bare WebAssembly has no clock: every phase takes 0 seconds there.
const HAS_CLOCK: bool = cfg!(not(all(target_family = "wasm", target_os = "unknown")));

/// Measures phases.
pub(in crate::wire) struct Clock(Option<Instant>);

impl Clock {
    pub(in crate::wire) fn start() -> Self {
        Clock(HAS_CLOCK.then(Instant::now))
    }

    /// Seconds since the start or the last lap.
    pub(in crate::wire) fn lap(&mut self) -> f64 {
        let Some(last) = &mut self.0 else { return 0.0 };
        let now = Instant::now();
        let seconds = now.duration_since(*last).as_secs_f64();
        *last = now;
        seconds
    }
}
