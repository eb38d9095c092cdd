//! Wire that is let out and hauled in at the last end of a wire, as by a winch.

use super::check::finite;
use super::wire::{Clamp, LEAST, MOST_SEGMENTS, Wire};
use super::{ModelError, NodeKind};

/// From a time on, wire is let out at its last end.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ReelPhase {
    /// Start in s. The phase takes effect with the step that starts nearest to it.
    pub from: f64,
    /// How much unstretched wire is let out, in m/s, at most 1000; below 0 it is hauled in, in a step
    /// at most half of the last segment. Whatever force that takes: a reel has no limit.
    pub speed: f64,
}

/// Whether there may be such a reel at the last end of a wire.
pub(super) fn check(wire: &Wire) -> Result<(), ModelError> {
    for phase in &wire.reel {
        finite("from", phase.from)?;
        finite("speed", phase.speed)?;
        if phase.speed.abs() > FASTEST {
            let accepted = "at most 1000 m/s either way";
            return Err(ModelError::value("speed", phase.speed, accepted));
        }
    }
    if let Some(before) = (wire.reel.windows(2)).position(|two| two[1].from <= two[0].from) {
        return Err(ModelError::ReelOrder { phase: before + 1 });
    }
    match wire.nodes.as_slice() {
        _ if wire.reel.is_empty() => Ok(()),
        [.., last] if last.kind == NodeKind::Free => Err(ModelError::ReelAtFreeEnd),
        [.., before, last] if Clamp::of([before, last]).is_some() => Err(ModelError::ReelAtClamp),
        _ => Ok(()),
    }
}

/// The fastest reel in m/s: faster ones are slips.
const FASTEST: f64 = 1000.0;

impl Wire {
    /// What is let out of a wire and hauled in, in order of time. Before the first phase it is nothing.
    pub fn reel(&self) -> &[ReelPhase] {
        &self.reel
    }

    /// How much is let out in the step that starts at a time, in m/s: no more than a wire may have.
    /// What is hauled in leaves some of the last segment: it waits until the node before can be taken
    /// out.
    pub(in crate::wire) fn reel_speed(&self, time: f64, step: f64) -> f64 {
        let started = |phase: &&ReelPhase| phase.from <= time + 0.5 * step;
        let Some(phase) = self.reel.iter().rev().find(started) else {
            return 0.0;
        };
        let rest = self.rest_length(self.segments.len() - 1);
        let most_in = (rest / 2.0).min(rest - LEAST * self.resolution.length);
        let most_out = MOST_SEGMENTS * self.resolution.length - self.length();
        let [most_in, most_out] = [most_in, most_out].map(|most| most.max(0.0) / step);
        phase.speed.clamp(-most_in, most_out)
    }
}
