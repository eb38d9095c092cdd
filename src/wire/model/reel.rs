//! Wire that is let out and hauled in at the last end of a wire, as by a winch.

use super::check::finite;
use super::phases::{out_of_order, phase_at};
use super::wire::{Clamp, LEAST, MOST_SEGMENTS, Wire};
use super::{ModelError, Node, NodeKind};

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

/// Whether there may be such a reel at the last of these nodes.
pub(in crate::wire) fn check(nodes: &[Node], reel: &[ReelPhase]) -> Result<(), ModelError> {
    for phase in reel {
        finite("from", phase.from)?;
        finite("speed", phase.speed)?;
        if phase.speed.abs() > FASTEST {
            let accepted = "at most 1000 m/s either way";
            return Err(ModelError::value("speed", phase.speed, accepted));
        }
    }
    if let Some((phase, from)) = out_of_order(reel, |phase| phase.from) {
        return Err(ModelError::ReelOrder { phase, from });
    }
    match nodes {
        _ if reel.is_empty() => Ok(()),
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
        let Some(phase) = phase_at(&self.reel, |phase| phase.from, time, step) else {
            return 0.0;
        };
        let rest = self.rest_length(self.segments.len() - 1);
        let most_in = (rest / 2.0).min(rest - LEAST * self.resolution.length);
        let most_out = MOST_SEGMENTS * self.resolution.length - self.length();
        let [most_in, most_out] = [most_in, most_out].map(|most| most.max(0.0) / step);
        phase.speed.clamp(-most_in, most_out)
    }
}
