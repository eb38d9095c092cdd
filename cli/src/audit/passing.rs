//! Wires that pass into bodies, and bodies into each other, step by step.

use std::cmp::Ordering;
use std::collections::BTreeMap;

use rayon::prelude::*;
use tunnelproof::rigid::RigidQuery;
use tunnelproof::wire::{
    BodyCrossingOutcome, BodyRecord, NodeKind, Remesh, RemeshKind, SegmentId, StepRecord,
};

use super::Audit;
use super::aside::Node;
use super::bodies::{BodyWay, SegmentWay, Touch, fixed_to, is_in, pose, swept};
use super::carried::is_unit;
use super::finding::{Finding, What};
use super::overlap::overlap;
use super::pairs;
use super::segments::{Segment, moving};
use tunnelproof_reference::certify::query::AnyQuery;

/// What was found of one body in a motion.
struct Found {
    asked: u64,
    touches: Vec<(SegmentId, Touch)>,
}

impl Audit {
    /// The motion that was made, body by body.
    pub(super) fn beside_bodies(&mut self, record: &StepRecord) {
        self.body_jumps(record);
        let segments = moving(record);
        let mut said: BTreeMap<(usize, SegmentId), f64> = BTreeMap::new();
        for crossing in &record.collisions.body_crossings {
            match crossing.outcome {
                BodyCrossingOutcome::Prevented => self.report.body_prevented += 1,
                BodyCrossingOutcome::Passed => {
                    said.insert((crossing.body.0, crossing.segment), crossing.toi);
                }
            }
        }
        for body in 0..record.bodies.len().max(self.cores.len()) {
            let Some(found) = self.beside_body(record, &segments, body) else {
                self.find(record, What::BodyUnsound { body }, &[], None);
                continue;
            };
            self.report.body_pairs += found.asked;
            for (id, touch) in found.touches {
                self.report.body_contacts += 1;
                let Touch {
                    toi,
                    crossing,
                    query,
                } = touch;
                let missed = What::BodyMissed {
                    body,
                    toi,
                    crossing,
                };
                match said.remove(&(body, id)) {
                    Some(reported) => {
                        let what = timed(reported, toi);
                        self.find_reported(record, what, &[id], &[body], Some(query));
                    }
                    None => self.find(record, missed, &[id], Some(query.into())),
                }
            }
        }
        for (body, id) in said.into_keys() {
            self.find_reported(record, Some(What::False), &[id], &[body], None);
        }
    }

    /// `None` if the numbers are no motion, or the shape is not known.
    fn beside_body(&self, record: &StepRecord, segments: &[Segment], body: usize) -> Option<Found> {
        let core = self.cores.get(body)?;
        let record = record.bodies.get(body)?;
        let mut poses = record.between.iter().chain([&record.before, &record.after]);
        if !poses.all(is_unit) {
            return None;
        }
        let way = BodyWay::new(record).ok()?;
        let asked = |segment: &Segment| {
            let of = SegmentWay {
                start: segment.start,
                end: segment.end,
                fixed: segment.kinds.each_ref().map(|kind| fixed_to(kind, body)),
            };
            way.touch(&of, core)
                .map(|(touch, asked)| (segment.id, touch, asked))
        };
        let all: Result<Vec<_>, _> = segments.par_iter().map(asked).collect();
        let all = all.ok()?;
        let asked = all.iter().map(|(_, _, asked)| asked).sum();
        let touches = all
            .into_iter()
            .filter_map(|(id, touch, _)| Some((id, touch?)));
        let touches = touches.collect();
        Some(Found { asked, touches })
    }

    /// The motion that was made, by two bodies of which forces move one.
    pub(super) fn between_bodies(&mut self, record: &StepRecord) {
        let mut said: BTreeMap<[usize; 2], f64> = BTreeMap::new();
        for crossing in &record.collisions.core_crossings {
            match crossing.outcome {
                BodyCrossingOutcome::Prevented => self.report.core_prevented += 1,
                BodyCrossingOutcome::Passed => {
                    said.insert(crossing.bodies.map(|body| body.0), crossing.toi);
                }
            }
        }
        // What is no motion was found before.
        let way = |body: &BodyRecord| BodyWay::new(body).ok();
        let ways: Vec<Option<BodyWay>> = record.bodies.iter().map(way).collect();
        let asked = |&[a, b]: &[usize; 2]| {
            let ways = [ways.get(a)?.as_ref()?, ways.get(b)?.as_ref()?];
            let cores = [self.cores.get(a)?, self.cores.get(b)?];
            Some(([a, b], pairs::first_touch(cores, ways).ok().flatten()))
        };
        let all: Vec<_> = self.body_pairs().par_iter().filter_map(asked).collect();
        for (bodies, found) in all {
            let Some(found) = found else {
                let body = bodies[1];
                self.find(record, What::BodyUnsound { body }, &[], None);
                continue;
            };
            self.report.core_pairs += u64::from(found.near);
            let Some(touch) = found.touch else {
                continue;
            };
            let Touch {
                toi,
                crossing,
                query,
            } = touch;
            self.report.core_contacts += 1;
            let missed = What::CoreMissed {
                bodies,
                toi,
                crossing,
            };
            match said.remove(&bodies) {
                Some(reported) => {
                    let what = timed(reported, toi);
                    self.find_reported(record, what, &[], &bodies, Some(query));
                }
                None => self.find(record, missed, &[], Some(query.into())),
            }
        }
        for bodies in said.into_keys() {
            self.find_reported(record, Some(What::False), &[], &bodies, None);
        }
    }

    /// What is wrong with a contact of bodies that was reported, if anything is.
    fn find_reported(
        &mut self,
        record: &StepRecord,
        what: Option<What>,
        segments: &[SegmentId],
        bodies: &[usize],
        query: Option<RigidQuery>,
    ) {
        if let Some(what) = what {
            self.report.add(Finding {
                step: record.step,
                what,
                segments: segments.to_vec(),
                of_bodies: bodies.to_vec(),
                query: query.map(AnyQuery::from),
            });
        }
    }

    /// Two bodies of which forces move one.
    fn body_pairs(&self) -> Vec<[usize; 2]> {
        let count = self.cores.len();
        let pairs = (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b]));
        let moved = |pair: &[usize; 2]| pair.iter().any(|body| self.dynamic[*body]);
        pairs.filter(moved).collect()
    }

    /// Two bodies of which forces move one, and whose cores overlap where the run ends.
    pub(super) fn standing_in_each_other(&self) -> Vec<[usize; 2]> {
        let Some(poses) = &self.poses else {
            return Vec::new();
        };
        let overlapping = |&[a, b]: &[usize; 2]| {
            let Some((at, other)) = poses.get(a).zip(poses.get(b)) else {
                return false;
            };
            overlap([&self.cores[a], &self.cores[b]], [&pose(at), &pose(other)])
        };
        self.body_pairs().into_iter().filter(overlapping).collect()
    }

    fn body_jumps(&mut self, record: &StepRecord) {
        let before = record.bodies.iter().map(|body| body.before);
        if let Some(left) = self.poses.take() {
            let jumped = left.iter().zip(before).enumerate();
            let jumped = jumped.filter(|(_, (left, before))| left != &before);
            for body in jumped.map(|(body, _)| body).collect::<Vec<_>>() {
                self.find(record, What::BodyJump { body }, &[], None);
            }
        }
        self.poses = Some(record.bodies.iter().map(|body| body.after).collect());
    }

    /// The bodies into whose cores a change of resolution goes, and what touches there, unless the body
    /// is no body.
    pub(super) fn swept_bodies(
        &self,
        record: &StepRecord,
        change: &Remesh,
    ) -> Vec<(usize, Option<RigidQuery>)> {
        let [a, b, c] = change.triangle;
        let own = match change.kind {
            RemeshKind::Merge => vec![[a, b], [b, c]],
            RemeshKind::Split => vec![[a, c]],
        };
        let through = |body: usize| {
            let core = &self.cores[body];
            let way = record
                .bodies
                .get(body)
                .map(|body| BodyWay::resting(&body.after));
            let Some(Ok(way)) = way else {
                return Some((body, None));
            };
            let was_in = |ends| is_in(core, way.pose(), ends).unwrap_or(false);
            let touched = match swept(core, way.first(), &change.triangle) {
                Ok(touched) => Some(touched?),
                Err(_) => None,
            };
            (!own.iter().any(was_in)).then_some((body, touched))
        };
        (0..self.cores.len()).filter_map(through).collect()
    }

    /// Wires and bodies: a segment touches the core or is inside it where the run ends, and it does
    /// not belong to an end that is fixed to the body.
    pub(super) fn standing_in_bodies(&self) -> Vec<[usize; 2]> {
        let (Some(wires), Some(poses)) = (&self.left, &self.poses) else {
            return Vec::new();
        };
        let mut standing = Vec::new();
        for wire in 0..wires.count() {
            for (body, (core, pose)) in self.cores.iter().zip(poses).enumerate() {
                let Ok(way) = BodyWay::resting(pose) else {
                    continue;
                };
                let segments: Vec<[Node; 2]> = wires.segments(wire).collect();
                let inside = |two: &[Node; 2]| {
                    is_in(core, way.pose(), &two.each_ref().map(|node| node.at)).unwrap_or(true)
                };
                let inside: Vec<bool> = segments.iter().map(inside).collect();
                let tied = |two: &[Node; 2]| two.iter().any(|node| is_eye(node, body));
                let tied: Vec<bool> = segments.iter().map(tied).collect();
                let stretches = inside.chunk_by(|a, b| a == b);
                let mut at = 0;
                for stretch in stretches {
                    let own = at..at + stretch.len();
                    at += stretch.len();
                    if stretch[0] && !tied[own].contains(&true) {
                        standing.push([wire, body]);
                    }
                }
            }
        }
        standing.dedup();
        standing
    }
}

/// What is wrong with a time of impact.
fn timed(reported: f64, toi: f64) -> Option<What> {
    match reported.partial_cmp(&toi) {
        Some(Ordering::Equal) => None,
        Some(Ordering::Less) => Some(What::Early { by: toi - reported }),
        _ => Some(What::Late { by: reported - toi }),
    }
}

fn is_eye(node: &Node, body: usize) -> bool {
    matches!(node.kind, NodeKind::Eye { body: on, .. } if on.0 == body)
}
