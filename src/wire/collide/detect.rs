//! From the motion of all wires to the pairs that meet: broad phase, exclusion, narrow phase.

use super::boxes::Boxes;
use super::segment::PairFilter;
use super::segment::{Closest, between, direction, joined};
use super::thickness::Thickness;
use crate::broad::{Aabb, Method, SlowPairs};
use crate::contact::{self, EdgePoint, Verdict};
use crate::narrow::{NarrowPhase, Report};
use crate::query::{EdgeEdge, Point};
use crate::wire::Vector;
use crate::wire::error::CollisionError;
use crate::wire::model::WireId;
use crate::wire::record::{CollisionRecord, Crossing, CrossingOutcome, PairAnswer, PairRecord};
use crate::wire::site::{SegmentId, WireSite};
use crate::wire::step::motion::ProposedMotion;
use crate::wire::world::World;

/// The boxes of all segments, and what is known of slow ones. Item `k` is segment `k`, counted
/// through all wires.
pub(super) struct Pipeline {
    boxes: Boxes,
    pub(super) slow: SlowPairs,
}

/// A segment on its way through a step.
struct Moving {
    id: SegmentId,
    start: [Point; 2],
    end: [Point; 2],
}

/// What was found in a motion.
#[derive(Default)]
pub(super) struct Detections {
    /// Pairs whose midlines meet, or come as near as they must not.
    pub(super) hits: Vec<MidlineHit>,
    /// Places of pairs that do not, and end closer than their radii, with the direction between
    /// them.
    pub(super) near: Vec<([WireSite; 2], Vector)>,
    /// All pairs that the broad phase named.
    pub(super) pairs: Vec<PairRecord>,
}

/// A pair whose midlines meet, or come as near as they must not.
pub(super) struct MidlineHit {
    pub(super) sites: [WireSite; 2],
    pair: [SegmentId; 2],
    query: EdgeEdge,
    pub(super) contact: contact::Contact,
    report: Report,
}

impl Pipeline {
    pub(super) fn new(method: Method) -> Self {
        Pipeline {
            boxes: Boxes::new(method),
            slow: SlowPairs::default(),
        }
    }

    /// Wall-clock time in s of its broad phase so far.
    pub(super) fn broad_seconds(&self) -> f64 {
        self.boxes.seconds
    }

    /// The pairs that meet while `world` makes a motion, and those that end close.
    pub(super) fn detect(
        &mut self,
        world: &World,
        motion: &ProposedMotion,
        narrow: &dyn NarrowPhase,
        filter: Option<PairFilter<'_>>,
        thickness: Thickness,
        record: &mut CollisionRecord,
    ) -> Result<Detections, CollisionError> {
        let segments = moving(world, motion);
        self.place(world, &segments)?;
        let keep = |pair: [usize; 2]| {
            let two = pair.map(|k| segments[k].id);
            !joined(world, two) && filter.is_none_or(|keep| keep(two[0], two[1]))
        };
        let pairs = self.boxes.pairs(keep);
        let remaining = self.slow.remaining(pairs);
        record.broad_pairs += pairs.len();
        record.excluded += pairs.len() - remaining.len();
        let mut found = Detections::default();
        let mut remaining = remaining.iter().peekable();
        for &pair in pairs {
            let two = [pair.first(), pair.second()].map(|item| &segments[item.index()]);
            let answer = match remaining.next_if(|other| **other == pair) {
                Some(_) => found.test_pair(world, two, narrow, thickness, record)?,
                None => PairAnswer::Excluded,
            };
            let pair = two.map(|segment| segment.id);
            found.pairs.push(PairRecord { pair, answer });
        }
        Ok(found)
    }

    /// Tells broad phase and exclusion where every segment goes.
    fn place(&mut self, world: &World, segments: &[Moving]) -> Result<(), CollisionError> {
        let radius = |segment: &Moving| segment.id.of(world).material.radius;
        let swept = |s: &Moving| Aabb::swept(&s.start, &s.end, radius(s));
        let items = self.boxes.place(segments.iter().map(swept))?;
        for (segment, &item) in segments.iter().zip(items) {
            let radius = radius(segment);
            // A motion tried before and taken back is a move to where it started.
            self.slow.place(item, segment.start, radius)?;
            self.slow.place(item, segment.end, radius)?;
        }
        Ok(())
    }
}

fn moving(world: &World, motion: &ProposedMotion) -> Vec<Moving> {
    let mut all = Vec::new();
    for (w, (wire, to)) in world.wires.iter().zip(&motion.wires).enumerate() {
        for segment in 0..wire.segments.len() {
            let wire = WireId(w);
            let id = SegmentId { wire, segment };
            all.push(Moving {
                id,
                start: id.ends(world),
                end: [to[segment].0, to[segment + 1].0],
            });
        }
    }
    all
}

impl Detections {
    /// Tests one pair.
    fn test_pair(
        &mut self,
        world: &World,
        [a, b]: [&Moving; 2],
        narrow: &dyn NarrowPhase,
        thickness: Thickness,
        record: &mut CollisionRecord,
    ) -> Result<PairAnswer, CollisionError> {
        let start = [a.start[0], a.start[1], b.start[0], b.start[1]];
        let end = [a.end[0], a.end[1], b.end[0], b.end[1]];
        let pair = [a.id, b.id];
        let query = thickness.query(world, pair, start, end)?;
        let report = narrow.edge_edge(&query)?;
        record.count(&report);
        let sites = |[u, v]: [f64; 2]| [a.id.site(world, u), b.id.site(world, v)];
        match report.verdict {
            Verdict::Hit(contact) => {
                let EdgePoint { u, v } = contact.first.on_edges();
                let sites = sites([u, v]);
                self.hits.push(MidlineHit {
                    sites,
                    pair,
                    query,
                    contact,
                    report,
                });
                let toi = contact.toi;
                Ok(PairAnswer::Met { toi })
            }
            Verdict::Miss => {
                let closest = Closest::new(&end);
                let sites = sites(closest.parameters);
                let near = closest.distance() < thickness.touching(world, pair, &sites);
                let normal = direction(&closest.separation);
                if let (true, Some(normal)) =
                    (near && !thickness.is_bend(world, pair, &sites), normal)
                {
                    self.near.push((sites, normal));
                }
                Ok(PairAnswer::Apart)
            }
        }
    }
}

impl MidlineHit {
    /// The two segments that meet.
    pub(super) fn segments(&self) -> [SegmentId; 2] {
        self.pair
    }

    /// Unit normal from B to A by which the two are kept apart, and how far apart their places are
    /// along it where the step starts. None if they touch there and do not move.
    ///
    /// Where they meet inside both, it is across both at that time, on the side from which they
    /// come. Else, or if they come along it by less than a tenth of their displacement, from the
    /// closest points where the step starts; if they touch there, against their motion.
    pub(super) fn normal(&self) -> Option<(Vector, f64)> {
        const TENTH: f64 = 0.1;
        let EdgePoint { u, v } = self.contact.first.on_edges();
        let parameters = [u, v];
        let apart = between(self.query.start(), parameters);
        if let Some(across) = self.across() {
            let along = across.dot(&apart);
            if along.abs() >= TENTH * apart.norm() {
                return Some((across * along.signum(), along.abs()));
            }
        }
        let before = Closest::new(self.query.start()).separation;
        let normal = direction(&before).or_else(|| {
            let after = between(self.query.end(), parameters);
            direction(&(apart - after))
        })?;
        Some((normal, normal.dot(&apart)))
    }

    /// The unit vector across both segments where they meet inside of both at an angle.
    fn across(&self) -> Option<Vector> {
        const ANGLE: f64 = 1e-6;
        let contact = &self.contact;
        let inside = |parameter: f64| parameter > 0.0 && parameter < 1.0;
        let EdgePoint { u, v } = contact.first.on_edges();
        if !(inside(u) && inside(v)) {
            return None;
        }
        let at = |k: usize| {
            let (start, end) = (self.query.start()[k].coords, self.query.end()[k].coords);
            start.lerp(&end, contact.toi)
        };
        let (along, other) = (direction(&(at(1) - at(0)))?, direction(&(at(3) - at(2)))?);
        let across = along.cross(&other);
        (across.norm() > ANGLE).then(|| across.normalize())
    }

    /// The vectors between the closest points at the start and at the end, from B to A. None where
    /// they touch.
    pub(super) fn separations(&self) -> [Option<Vector>; 2] {
        let toi = self.contact.toi;
        let of = |points: &[Point; 4], touches: bool| {
            let separation = Closest::new(points).separation;
            (!touches && separation != Vector::zeros()).then_some(separation)
        };
        [
            of(self.query.start(), toi == 0.0),
            of(self.query.end(), toi == 1.0),
        ]
    }

    pub(super) fn crossing(&self, outcome: CrossingOutcome) -> Crossing {
        Crossing {
            sites: self.sites,
            toi: self.contact.toi,
            case: self.report.case,
            flags: self.report.flags,
            outcome,
            radii: self.query.radius().parts(),
            start: *self.query.start(),
            end: *self.query.end(),
        }
    }
}
