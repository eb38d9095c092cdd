//! What the equations of a step are linear about.
//!
//! A row of stretch counts velocities along its segment, and what keeps a step stable beside [short
//! segments](super::transverse) follows from their tensions. Both are taken as they are where the step
//! starts. That is not enough where a slack wire is caught. Its tension is many times what it was, so that
//! the next step may not be stable; and its nodes go far sideways, which makes segments longer than the row
//! has it: by a hundredth of a segment, it may be, that a stiff wire pays back with more energy than there
//! was.
//!
//! So the solution is looked at. A segment that is too short for the tension that it got, if that is
//! [`GROWTH`] times what it was, has that from now on. One whose length is another one than its row says
//! has the *mean direction* of the step,
//!
//! ```text
//! t = (s + s+) / (|s| + |s+|),   t (s+ - s) = |s+| - |s|
//! ```
//!
//! with the vectors `s` and `s+` from end to end before and after the step, with which the row has the
//! length right. Then the step is solved again, at most [`ROUNDS`] times.
//!
//! Directions are followed where nothing touches. Contacts are linear about the start as well, and
//! what is between two of them would be asked to go two ways.

use super::rows::Row;
use super::transverse::is_short;
use crate::wire::model::Wire;
use crate::wire::vector::{Vector, unit};
use crate::wire::world::World;

/// How often a step is solved again.
pub(super) const ROUNDS: usize = 4;

/// How much larger than it was a tension may be. The theory allows `1 / s^2`, but that would damp whatever is pulled
/// in a jerk.
const GROWTH: f64 = 4.0;

/// How much longer or shorter than its row says a segment may be after the step, as a part of its length.
const OFF: f64 = 2e-2;

/// A chain that is shorter than this part of its length is slack, whatever its row says.
const SLACK: f64 = 0.99;

/// Of each segment, by wires.
pub(super) struct Linearisation(Vec<Vec<Linearised>>);

/// What the equations of a segment are linear about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Linearised {
    /// The tension in N.
    pub(super) tension: f64,
    /// The direction, by which its row counts velocities; zero if the segment has no length.
    pub(super) along: Vector,
}

impl Linearisation {
    /// About the start of the step: directions as they are there, and the largest tensions of the last
    /// steps.
    pub(super) fn at_start(world: &World) -> Self {
        let wires = world.wires.iter().map(|wire| {
            let segments = wire.segments.iter().enumerate();
            let of = segments.map(|(at, segment)| Linearised {
                tension: segment.largest_tension(),
                along: unit(&wire.span(at)).0,
            });
            of.collect()
        });
        Linearisation(wires.collect())
    }

    /// That of a segment of a wire.
    pub(super) fn of(&self, wire: usize, segment: usize) -> &Linearised {
        &self.0[wire][segment]
    }

    /// Follows a solution, given the rows of stretch in their order, and whether anything touches.
    /// Returns whether it was followed before: whether nothing is to be solved again.
    pub(super) fn follow(&mut self, world: &World, rows: &[Row], touches: bool, x: &[f64]) -> bool {
        let mut is_followed = true;
        let mut rows = rows.iter();
        for (at, (wire, own)) in world.wires.iter().zip(&mut self.0).enumerate() {
            for ((segment, own), row) in own.iter_mut().enumerate().zip(rows.by_ref()) {
                let tension = row.impulse(x) / world.settings.step;
                // Before the first step no tension is known.
                let is_more = world.steps > 0 && tension > GROWTH * own.tension;
                if is_more && is_short(world, at, segment, tension) {
                    own.tension = tension;
                    is_followed = false;
                }
                let way = row.way(x) * world.settings.step;
                if !touches && let Some(along) = own.turned(wire, segment, &way) {
                    own.along = along;
                    is_followed = false;
                }
            }
        }
        is_followed
    }
}

impl Linearised {
    /// The mean direction of a segment whose end goes this way from its start, if its row has another length.
    fn turned(&self, wire: &Wire, segment: usize, way: &Vector) -> Option<Vector> {
        let rest = wire.rest_length(segment);
        let start = wire.span(segment);
        let end = start + way;
        let [before, after] = [start, end].map(|span| span.norm());
        let is_slack = wire.material.is_chain() && after < SLACK * rest;
        let off = after - before - self.along.dot(way);
        let is_off = before > 0.0 && !is_slack && off.abs() > OFF * rest;
        is_off.then(|| (start + end) / (before + after))
    }
}

#[cfg(test)]
mod tests;
