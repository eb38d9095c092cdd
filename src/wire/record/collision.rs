//! What is observed of the collisions in a step.

use crate::contact::{Case, Flags};
use crate::narrow::Report;
use crate::query::Point;
use crate::wire::model::{BodyId, WireId};
use crate::wire::site::{SegmentId, WireSite};

/// The collisions in one step. Counts are sums over all the times that the step was tested.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CollisionRecord {
    /// Pairs of segments that the broad phase named, joined ones apart.
    pub broad_pairs: usize,
    /// Of these, excluded because they move too little to meet.
    pub excluded: usize,
    /// Of these, tested by the narrow phase.
    pub tested: usize,
    /// Pairs of a segment or a body with a body that were tested.
    pub tested_bodies: usize,
    /// Segments whose boxes met that of a core, and that were tested against it continuously.
    pub tested_cores: usize,
    /// Tests by [`Case`], in the order of [`Case::ALL`], as far as the narrow phase knows it.
    pub cases: [usize; Case::ALL.len()],
    /// Contacts at which the segments are parallel for an instant.
    pub temporarily_parallel: usize,
    /// Contacts at which a segment is a point for an instant.
    pub temporarily_point: usize,
    /// How often the step was solved again.
    pub rounds: usize,
    /// How often no solution was found with the contacts that were added. The motion before was
    /// shortened then.
    pub unsolved_rounds: usize,
    /// Midlines that met during the motion: in guard mode every pair of segments in every motion
    /// that was tried, and also what came nearer than it may.
    pub crossings: Vec<Crossing>,
    /// Midlines that touched the core of a body: in guard mode each segment in every motion that was
    /// tried. A segment that touches the core or is inside it as the step starts is left out.
    pub body_crossings: Vec<BodyCrossing>,
    /// Pairs of bodies whose cores came near each other, and that were tested continuously.
    pub tested_core_pairs: usize,
    /// Cores that touched each other: in guard mode each pair of bodies in every motion that was
    /// tried. Bodies that touch or overlap with their cores as the step starts are left out, and so
    /// are two that no force moves.
    pub core_crossings: Vec<CoreCrossing>,
    /// Every pair that the broad phase named in the motion that was made, with segments numbered as
    /// before it.
    pub pairs: Vec<PairRecord>,
    /// Islands whose motion was scaled down.
    pub scaled_islands: Vec<ScaledIsland>,
    /// Changes of resolution that were refused.
    pub refused_remeshes: usize,
    /// The share of the thickness that was guarded; 0 if midlines alone were kept apart.
    pub guarded_thickness: f64,
}

/// Midlines that meet during the motion, or come as near as guard mode does not let them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Crossing {
    /// Where.
    pub sites: [WireSite; 2],
    /// When, from 0 to 1 in the step.
    pub toi: f64,
    /// The case, if the narrow phase knows it.
    pub case: Option<Case>,
    /// The configuration at `toi`.
    pub flags: Flags,
    /// What became of it.
    pub outcome: CrossingOutcome,
    /// Where the motion that was tried starts: both ends of the first segment, then of the second.
    pub start: [Point; 4],
    /// Where it ends.
    pub end: [Point; 4],
    /// The two numbers whose exact sum is how near they came at `toi`, in m; zeros if they meet.
    pub radii: [f64; 2],
}

/// A midline that touches the core of a body during the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodyCrossing {
    /// The body.
    pub body: BodyId,
    /// The segment, numbered as before the motion.
    pub segment: SegmentId,
    /// Where on the wire: arc length in m.
    pub arc: f64,
    /// When, from 0 to 1 in the step.
    pub toi: f64,
    /// What became of it.
    pub outcome: BodyCrossingOutcome,
}

/// Two bodies whose cores touch during the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CoreCrossing {
    /// The bodies, in the order in which they were added.
    pub bodies: [BodyId; 2],
    /// When, from 0 to 1 in the step.
    pub toi: f64,
    /// Where in space, rounded.
    pub at: Point,
    /// What became of it.
    pub outcome: BodyCrossingOutcome,
}

/// What became of a midline or a core that touched a core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum BodyCrossingOutcome {
    /// Guard mode: that motion was not made.
    Prevented,
    /// Thesis mode: it was made.
    Passed,
}

/// A pair of segments that the broad phase named.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PairRecord {
    /// The segments.
    pub pair: [SegmentId; 2],
    /// What was said of them.
    pub answer: PairAnswer,
}

/// What was said of a pair of segments.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum PairAnswer {
    /// They move too little to meet.
    Excluded,
    /// The narrow phase says that they do not meet.
    Apart,
    /// The narrow phase says that they meet.
    Met {
        /// When, from 0 to 1 in the step.
        toi: f64,
    },
}

/// What became of midlines that met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum CrossingOutcome {
    /// Guard mode: that motion was not made.
    Prevented,
    /// Thesis mode: the wires have passed through each other, +1 in the ledger.
    Tunnelled,
    /// Thesis mode: they are back on their sides, -1 in the ledger.
    Returned,
    /// Thesis mode: they touched and parted on the same sides.
    Grazed,
}

/// Things that made only a part of their motion, because a crossing was left: all that is tied to
/// each other, or where thickness is guarded the nodes of the segments alone.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ScaledIsland {
    /// The factor on their motion, from 0 to 1, and on the velocities that were solved for.
    pub motion_scale: f64,
    /// The wires, or those that have such nodes.
    pub wires: Vec<WireId>,
    /// The bodies that can move.
    pub bodies: Vec<BodyId>,
    /// Those of them whose velocity is prescribed: they would have forced a crossing, and are
    /// behind their script from now on.
    pub behind: Vec<BodyId>,
}

impl CollisionRecord {
    /// Counts a test and its answer.
    pub(in crate::wire) fn count(&mut self, report: &Report) {
        self.tested += 1;
        let case = |&of: &Case| Some(of) == report.case;
        if let Some(at) = Case::ALL.iter().position(case) {
            self.cases[at] += 1;
        }
        self.temporarily_parallel += usize::from(report.flags.temporarily_parallel);
        self.temporarily_point += usize::from(report.flags.temporarily_point);
    }
}
