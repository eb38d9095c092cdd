//! Simulations checked for missed tunnels.
//!
//! An [`Audit`] reads the records of a simulation and knows nothing else of it. In every step it asks the oracle about
//! every pair of segments whose swept boxes meet, of one wire too, and about every change of resolution, and compares with what
//! the simulation reported:
//!
//! - a contact in the motion that was made and that was not reported is *missed*: by the broad phase, which did not name
//!   the pair, by the exclusion of slow pairs, or by the narrow phase;
//! - a time of impact that was reported, also in a motion that was tried and not made, is right, early or late;
//! - a wire that does not start where the step before left it *jumped*: nobody has looked at how it got there. Nor may
//!   its radius, its arc lengths or what its nodes are fixed to be other ones, but for what the step recorded;
//! - a node that is not where the body has it that it is fixed to, and a pinned one that moves, are *astray*; they are
//!   taken for free ones then;
//! - steps follow each other in number and time, and numbers are finite;
//! - a midline that comes to touch the core of a body, in the motion or in a change of resolution, and that was not
//!   reported; a midline that is inside a core at the end, but for the end of a wire that is fixed to the body;
//! - two bodies whose cores come to touch, and that was not reported, unless neither is moved by forces; cores that
//!   overlap at the end;
//! - segments that come nearer than the share of their thickness that is guarded, or nearer than they were inside of it,
//!   in the motion that was made or in a change of resolution, are found;
//! - the ledger sums up signed passages of each pair of wires. What is not 0 at the end is a *standing tunnel*.
//!
//! Pairs that share a node or are fixed to one point are left out. Boxes are compared and not computed, and the ledger moves
//! wires aside by an infinitesimal, so nothing is rounded anywhere.

mod aside;
mod bodies;
mod carried;
mod core;
mod finding;
mod inside;
mod integers;
mod ledger;
mod overlap;
mod pairs;
mod passing;
mod penetration;
mod remesh;
mod segments;
mod separate;
mod sound;
#[cfg(test)]
mod tests;
mod thickness;

use std::collections::BTreeMap;

use rayon::prelude::*;
use serde::Serialize;
use tunnelproof::contact::ContactKind;
use tunnelproof::query::{EdgeEdge, Point, Query};
use tunnelproof::wire::recording::{BodySummary, Header};
use tunnelproof::wire::{
    Crossing, CrossingOutcome, PairAnswer, Pose, SegmentId, StepRecord, World,
};

use self::core::Core;
use aside::passages;
use carried::{astray, freed};
use ledger::Ledger;
use remesh::{Meeting, Wires};
use segments::{Segment, candidates, four, moving, query};
use sound::{Clock, hides_motion, out_of_order, unsound};
use thickness::Thickness;
use tunnelproof_reference::answer::ExactHit;
use tunnelproof_reference::certify::query::AnyQuery;
use tunnelproof_reference::oracle::decide_query;

pub use finding::{Culprit, Field, Finding, StepField, What};
pub use ledger::Ambiguous;
pub use penetration::Penetration;

/// How many findings are kept; the others are counted.
pub const MOST_FINDINGS: usize = 1000;

/// An audit under way.
pub struct Audit {
    cores: Vec<Core>,
    /// Whether forces move a body.
    dynamic: Vec<bool>,
    /// Of all wires.
    radii: Vec<f64>,
    ledger: Ledger,
    clock: Option<Clock>,
    left: Option<Wires>,
    /// The wires of contacts in the last step, and where the two segments end.
    last: Vec<([usize; 2], [Point; 4])>,
    /// Where bodies were left.
    poses: Option<Vec<Pose>>,
    report: Report,
}

/// What an audit came to.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Steps looked at.
    pub steps: u64,
    /// Pairs of segments whose swept boxes met: the questions to the oracle.
    pub pairs: u64,
    /// Changes of resolution.
    pub remeshes: u64,
    /// Contacts in the motions that were made.
    pub contacts: u64,
    /// Of these, crossings.
    pub crossings: u64,
    /// Crossings that were reported in motions that were tried and not made.
    pub prevented: u64,
    /// Contacts missed by the broad phase, the exclusion of slow pairs and the narrow phase.
    pub missed: [u64; 3],
    /// Of all contacts missed, crossings.
    pub missed_crossings: u64,
    /// Changes of resolution that passed through a segment.
    pub remeshes_through: u64,
    /// Segments that came near a core: the questions to the oracle about bodies.
    pub body_pairs: u64,
    /// Midlines that came to touch a core, in the motions that were made.
    pub body_contacts: u64,
    /// Touches of cores that were reported in motions that were tried and not made.
    pub body_prevented: u64,
    /// Touches of cores that were not reported.
    pub body_missed: u64,
    /// Changes of resolution that passed through a core.
    pub body_remeshes_through: u64,
    /// Pairs of bodies that came near each other, in steps in which one moved.
    pub core_pairs: u64,
    /// Cores of two bodies that came to touch, in the motions that were made.
    pub core_contacts: u64,
    /// Touches of two cores that were reported in motions that were tried and not made.
    pub core_prevented: u64,
    /// Touches of two cores that were not reported.
    pub core_missed: u64,
    /// The largest share of the thickness that was guarded.
    pub guarded_thickness: f64,
    /// Pairs of segments near enough to ask whether they keep it.
    pub thick_pairs: u64,
    /// Pairs that came within the guarded share of their thickness, and pairs that were within and came nearer.
    pub nearer: [u64; 2],
    /// The same of changes of resolution.
    pub remeshes_nearer: [u64; 2],
    /// How far wires stood inside each other, at the end of the step in which it was the most.
    pub deepest: Option<Penetration>,
    /// How far they stand inside each other at the end of the run.
    pub standing_penetration: Option<Penetration>,
    /// Wires and bodies that jumped, became other ones or had numbers that are no motion, and steps that
    /// do not follow each other.
    pub jumps: u64,
    /// Nodes that were not where what they are fixed to has them.
    pub astray: u64,
    /// Times of impact that were late, and the worst.
    pub late: (u64, f64),
    /// Times of impact that were early, and the worst.
    pub early: (u64, f64),
    /// Contacts reported that are none.
    pub false_hits: u64,
    /// Pairs of wires that have passed through each other at the end: wires and signed number.
    pub standing: Vec<([usize; 2], i64)>,
    /// Wires and bodies: the midline is inside the core at the end.
    pub body_standing: Vec<[usize; 2]>,
    /// Bodies whose cores overlap at the end.
    pub core_standing: Vec<[usize; 2]>,
    /// Pairs of wires of which that cannot be said.
    pub ambiguous: Vec<Ambiguous>,
    /// The first of all that is wrong, at most [`MOST_FINDINGS`].
    pub findings: Vec<Finding>,
}

impl Report {
    /// Whether nothing passed unnoticed and nothing stands, or may stand, on the wrong side.
    pub fn is_clean(&self) -> bool {
        let in_bodies = self.body_standing.is_empty() && self.core_standing.is_empty();
        let none_stands = self.standing.is_empty() && in_bodies;
        self.unnoticed() == 0 && none_stands && self.ambiguous.is_empty()
    }

    /// Whether every time of impact was right as well, to the last bit, and no contact made up.
    pub fn is_exact(&self) -> bool {
        self.is_clean() && self.inexact() == 0
    }

    /// How much passed unnoticed, and how often a wire or a body jumped.
    pub fn unnoticed(&self) -> u64 {
        let bodies = self.body_missed + self.core_missed + self.body_remeshes_through;
        let nearer = self.nearer.iter().chain(&self.remeshes_nearer);
        let missed = self.missed.iter().chain(nearer).sum::<u64>();
        missed + self.remeshes_through + bodies + self.jumps + self.astray
    }

    /// How often what was reported is not exact: late, early or no contact.
    pub fn inexact(&self) -> u64 {
        self.late.0 + self.early.0 + self.false_hits
    }

    fn add(&mut self, finding: Finding) {
        let worst = |worst: &mut (u64, f64), by: f64| *worst = (worst.0 + 1, worst.1.max(by));
        match finding.what {
            What::Missed { by, crossing } => {
                self.missed[by as usize] += 1;
                self.missed_crossings += u64::from(crossing);
            }
            What::Late { by } => worst(&mut self.late, by),
            What::Early { by } => worst(&mut self.early, by),
            What::False => self.false_hits += 1,
            What::Remesh => self.remeshes_through += 1,
            What::BodyMissed { .. } => self.body_missed += 1,
            What::CoreMissed { .. } => self.core_missed += 1,
            What::BodyRemesh { .. } => self.body_remeshes_through += 1,
            What::Nearer { were_near, .. } => self.nearer[usize::from(were_near)] += 1,
            What::RemeshNearer { were_near } => {
                self.remeshes_nearer[usize::from(were_near)] += 1;
            }
            What::Astray { .. } => self.astray += 1,
            What::Jump { .. }
            | What::Altered { .. }
            | What::Unsound { .. }
            | What::StepUnsound { .. }
            | What::BodyJump { .. }
            | What::BodyUnsound { .. } => self.jumps += 1,
        }
        if self.findings.len() < MOST_FINDINGS {
            self.findings.push(finding);
        }
    }
}

impl Audit {
    /// An audit of a world with these bodies, in the order in which they were added.
    pub fn new(bodies: &[BodySummary]) -> Self {
        Audit {
            cores: bodies.iter().map(|body| Core::of(&body.shape)).collect(),
            dynamic: bodies.iter().map(|body| body.dynamic).collect(),
            radii: Vec::new(),
            ledger: Ledger::default(),
            clock: None,
            left: None,
            last: Vec::new(),
            poses: None,
            report: Report::default(),
        }
    }

    /// An audit of a recording.
    pub fn of_recording(header: &Header) -> Self {
        let radii = header.wires.iter().map(|wire| wire.material.radius);
        Audit {
            radii: radii.collect(),
            ..Audit::new(&header.bodies)
        }
    }

    /// An audit of the steps of a world.
    pub fn of_world(world: &World) -> Self {
        Audit::of_recording(&Header::from(world))
    }

    /// Looks at the next step.
    pub fn step(&mut self, record: &StepRecord) {
        self.report.steps += 1;
        let clock = self.clock.replace((record.step, record.time));
        self.find_all(record, &out_of_order(record, clock));
        let unsound = unsound(record);
        self.find_all(record, &unsound);
        if let Some(left) = self.left.take() {
            for wire in left.jumped(record) {
                self.find(record, What::Jump { wire }, &[], None);
            }
            self.find_all(record, &left.altered(record));
        }
        if !unsound.iter().any(hides_motion) {
            self.same_wires(record);
            let astray = astray(record);
            self.find_all(record, &astray);
            let freed = freed(record, &astray);
            self.motion(&freed);
            self.prevented(record);
            self.beside_bodies(&freed);
            self.between_bodies(record);
            self.thickness(&freed);
            self.left = Some(self.remeshes(record));
        }
    }

    /// Whether all wires are there, and as thick as they were, or as the header says.
    fn same_wires(&mut self, record: &StepRecord) {
        for (wire, of) in record.wires.iter().enumerate() {
            match self.radii.get(wire) {
                None => self.radii.push(of.radius),
                Some(&radius) if radius != of.radius => {
                    let (field, at) = (Field::Radius, None);
                    self.find(record, What::Altered { wire, field, at }, &[], None);
                }
                Some(_) => {}
            }
        }
        for wire in record.wires.len()..self.radii.len() {
            let (field, at) = (Field::Before, None);
            self.find(record, What::Unsound { wire, field, at }, &[], None);
        }
    }

    /// What it came to.
    pub fn finish(mut self) -> Report {
        for (wires, end) in std::mem::take(&mut self.last) {
            let query = EdgeEdge::new(end, end, 0.0);
            if query.is_ok_and(|query| first_contact(query).is_some()) {
                self.ledger.cut(wires);
            }
        }
        self.report.core_standing = self.standing_in_each_other();
        self.report.body_standing = self.standing_in_bodies();
        self.report.standing = self.ledger.standing();
        self.report.ambiguous = self.ledger.ambiguous();
        self.report
    }

    fn find(
        &mut self,
        record: &StepRecord,
        what: What,
        segments: &[SegmentId],
        query: Option<AnyQuery>,
    ) {
        self.report.add(Finding {
            step: record.step,
            what,
            segments: segments.to_vec(),
            of_bodies: Vec::new(),
            query,
        });
    }

    fn find_all(&mut self, record: &StepRecord, all: &[What]) {
        for what in all {
            self.find(record, *what, &[], None);
        }
    }

    /// The motion that was made, pair by pair.
    fn motion(&mut self, record: &StepRecord) {
        let segments = moving(record);
        let pairs = candidates(&segments, 0.0);
        self.report.pairs += pairs.len() as u64;
        let mut said: BTreeMap<_, _> = (record.collisions.pairs.iter())
            .map(|said| (ordered(said.pair), said.answer))
            .collect();
        let asked = |pair: [usize; 2]| {
            let [a, b] = pair.map(|k| &segments[k]);
            let (query, hit) = exact(a, b)?;
            let passages = passages(&query, [a.held(), b.held()]);
            Some(([a.id, b.id], query, hit, passages))
        };
        self.last.clear();
        let met: Vec<_> = pairs.into_par_iter().filter_map(asked).collect();
        for (pair, query, hit, passages) in met {
            self.report.contacts += 1;
            let wires = pair.map(|id| id.wire.0);
            self.ledger.enter(wires, &passages);
            if self.report.steps == 1 && hit.is_initial() {
                self.ledger.cut(wires);
            }
            self.last.push((wires, *query.end()));
            let crossing = hit.kind == ContactKind::Crossing || hit.crosses;
            self.report.crossings += u64::from(crossing);
            let missed = |by| Some(What::Missed { by, crossing });
            let what = match said.remove(&pair) {
                Some(PairAnswer::Met { toi }) => timed(toi, &hit),
                Some(PairAnswer::Apart) => missed(Culprit::Narrow),
                Some(PairAnswer::Excluded) => missed(Culprit::Exclusion),
                None => missed(Culprit::Broad),
            };
            if let Some(what) = what {
                self.find(record, what, &pair, Some(asked_of(query)));
            }
        }
        // Those that meet are taken out.
        for (pair, answer) in said {
            if let PairAnswer::Met { .. } = answer {
                let of = |id: &SegmentId| segments.iter().find(|segment| segment.id == *id);
                let two = of(&pair[0]).zip(of(&pair[1]));
                let query = two.and_then(|(a, b)| query(a, b).ok());
                self.find(record, What::False, &pair, query.map(asked_of));
            }
        }
    }

    /// Pairs that do not keep the share of their thickness that is guarded; and how far wires stand
    /// inside each other.
    fn thickness(&mut self, record: &StepRecord) {
        let segments = moving(record);
        self.report.standing_penetration = penetration::of(record.step, &segments);
        let deepest = self.report.deepest.into_iter();
        let both = deepest.chain(self.report.standing_penetration);
        self.report.deepest = both.reduce(Penetration::deeper);
        let share = record.collisions.guarded_thickness;
        if share == 0.0 {
            return;
        }
        self.report.guarded_thickness = self.report.guarded_thickness.max(share);
        let said: BTreeMap<_, _> = (record.collisions.pairs.iter())
            .map(|said| (ordered(said.pair), said.answer))
            .collect();
        let asked = |pair: &[usize; 2]| {
            let [a, b] = pair.map(|k| &segments[k]);
            let thickness = Thickness {
                share,
                radii: [a.radius, b.radius],
                stretch: a.stretch(b),
            };
            let [start, end] = [four(a.start, b.start), four(a.end, b.end)];
            let step = thickness.beyond(&[start]);
            // Midlines that meet are asked about elsewhere.
            let broken = (step > 0).then(|| thickness.broken(start, end, step))??;
            Some(([a.id, b.id], broken, thickness.is_part(step)))
        };
        let pairs = candidates(&segments, share);
        self.report.thick_pairs += pairs.len() as u64;
        let broken: Vec<_> = pairs.par_iter().filter_map(asked).collect();
        for (pair, query, were_near) in broken {
            let by = match said.get(&pair) {
                None => Culprit::Broad,
                Some(PairAnswer::Excluded) => Culprit::Exclusion,
                Some(_) => Culprit::Narrow,
            };
            let what = What::Nearer { by, were_near };
            self.find(record, what, &pair, Some(asked_of(query)));
        }
    }

    /// Contacts in motions that were tried and not made.
    fn prevented(&mut self, record: &StepRecord) {
        let crossings = record.collisions.crossings.iter();
        for crossing in crossings.filter(|crossing| crossing.outcome == CrossingOutcome::Prevented)
        {
            self.report.prevented += 1;
            let query = EdgeEdge::new(crossing.start, crossing.end, crossing.radii).ok();
            let hit = query.and_then(first_contact);
            let what = match hit {
                Some(hit) => timed(crossing.toi, &hit),
                None => Some(What::False),
            };
            if let Some(what) = what {
                let segments = segments_of(record, crossing);
                self.find(record, what, &segments, query.map(asked_of));
            }
        }
    }

    /// The changes of resolution one by one; where they leave the wires.
    fn remeshes(&mut self, record: &StepRecord) -> Wires {
        let mut wires = Wires::after(record);
        for change in &record.remeshes {
            self.report.remeshes += 1;
            match wires.meetings(change) {
                None => self.find(
                    record,
                    What::Jump {
                        wire: change.wire.0,
                    },
                    &[],
                    None,
                ),
                Some(met) => {
                    let own: Vec<SegmentId> = wires.segment(change).into_iter().collect();
                    for (body, query) in self.swept_bodies(record, change) {
                        let arc = change.arcs[1];
                        let what = What::BodyRemesh { body, arc };
                        self.find(record, what, &own, query.map(AnyQuery::from));
                    }
                    let share = record.collisions.guarded_thickness;
                    let near = match share > 0.0 {
                        true => wires.nearings(change, share),
                        false => Vec::new(),
                    };
                    for (id, query, were_near) in near {
                        let what = What::RemeshNearer { were_near };
                        let pair = [&own[..], &[id]].concat();
                        self.find(record, what, &pair, Some(asked_of(query)));
                    }
                    for Meeting {
                        id,
                        query,
                        passages,
                    } in met
                    {
                        let pair = [&own[..], &[id]].concat();
                        self.find(record, What::Remesh, &pair, Some(asked_of(query)));
                        self.ledger.enter([change.wire.0, id.wire.0], &passages);
                    }
                    wires.make(change);
                }
            }
        }
        wires
    }
}

/// The segments of a motion that was tried, as far as they start where wires do.
fn segments_of(record: &StepRecord, crossing: &Crossing) -> Vec<SegmentId> {
    let [a, b, c, d] = crossing.start;
    let places = crossing.sites.iter().zip([[a, b], [c, d]]);
    let found = places.filter_map(|(site, ends)| {
        let mut segments = record.wires.get(site.wire.0)?.before.windows(2);
        let segment = segments.position(|two| two == ends)?;
        let wire = site.wire;
        Some(SegmentId { wire, segment })
    });
    found.collect()
}

fn asked_of(query: EdgeEdge) -> AnyQuery {
    Query::EdgeEdge(query).into()
}

fn ordered([a, b]: [SegmentId; 2]) -> [SegmentId; 2] {
    [a.min(b), a.max(b)]
}

/// The exact contact of two segments, if there is one.
fn exact(a: &Segment, b: &Segment) -> Option<(EdgeEdge, ExactHit)> {
    let query = query(a, b).ok()?;
    Some((query, first_contact(query)?))
}

/// The exact first contact.
fn first_contact(query: EdgeEdge) -> Option<ExactHit> {
    decide_query(&Query::EdgeEdge(query)).hit
}

/// What is wrong with a time of impact; right is the exact one rounded down.
fn timed(toi: f64, hit: &ExactHit) -> Option<What> {
    let by = (toi - hit.toi.below).abs();
    match toi.partial_cmp(&hit.toi.below) {
        Some(std::cmp::Ordering::Equal) => None,
        Some(std::cmp::Ordering::Less) => Some(What::Early { by }),
        _ => Some(What::Late { by }),
    }
}
