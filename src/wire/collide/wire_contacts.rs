//! Contacts between wires, from step to step.
//!
//! A contact is known by its places on the material, never by segment numbers, which change. Each
//! step it goes to the closest points of its two segments; at an end it hands over to the neighbour
//! if that is closer and has no contact of its own. Two within a diameter of each other are one.
//! Segments that lie along each other have contacts at the nodes beside them, too.
//! Its normal is the direction between the closest points where the step starts, reversed while the
//! wires are on each other's wrong side. That side is counted by crossings, never read from
//! positions: it is how thesis mode brings wires back.

use std::collections::{BTreeMap, BTreeSet};

use super::segment::{Closest, direction, joined, pair_at, reach};
use super::thickness::{Thickness, is_held};
use crate::wire::Vector;
use crate::wire::contact::ContactConstraint;
use crate::wire::record::ContactRecord;
use crate::wire::site::{SegmentId, WireSite};
use crate::wire::vector::unit;
use crate::wire::world::World;

/// Where the keys of contacts between wires start.
pub(in crate::wire) const KEYS: u64 = 1 << 63;

/// One contact.
#[derive(Clone, Debug)]
pub(in crate::wire) struct WireContact {
    pub(in crate::wire) key: u64,
    pub(in crate::wire) sites: [WireSite; 2],
    /// The wires are on each other's wrong side.
    pub(in crate::wire) wrong: bool,
    /// The last normal, from B to A.
    pub(in crate::wire) normal: Vector,
    /// Distance of the surfaces along the normal where the step started, in m.
    pub(in crate::wire) gap: f64,
    /// It pushed in the last step.
    pub(in crate::wire) pushing: bool,
    /// Of segments that lie along each other: which of the places is a node, and stays there.
    pub(in crate::wire) at_node: Option<Side>,
}

/// One of the two wires of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(in crate::wire) enum Side {
    A,
    B,
}

/// All contacts: those at nodes and then the others, each oldest first.
#[derive(Clone, Debug, Default)]
pub(in crate::wire) struct WireContacts {
    pub(in crate::wire) list: Vec<WireContact>,
    /// Keys given so far.
    pub(in crate::wire) made: u64,
}

/// Contacts become one when they are nearer than this part of the spacing from which on there are two. So
/// none comes and goes from step to step: it would come without an impulse, and go with one.
const MERGED: f64 = 0.5;

/// The sine of the angle below which segments lie along each other, so that their closest points may be anywhere.
const ALONG: f64 = 0.1;

type PairSet = BTreeSet<[SegmentId; 2]>;

/// Where in a list the contacts of two wires are, ascending: no others can be at one place.
#[derive(Default)]
struct ByWires(BTreeMap<[usize; 2], Vec<usize>>);

impl ByWires {
    fn new(list: &[WireContact]) -> Self {
        let mut all = ByWires::default();
        for (at, touch) in list.iter().enumerate() {
            all.add(touch, at);
        }
        all
    }

    fn add(&mut self, touch: &WireContact, at: usize) {
        let wires = touch.sites.map(|site| site.wire.0);
        self.0.entry(wires).or_default().push(at);
    }

    fn of(&self, sites: &[WireSite; 2]) -> &[usize] {
        let wires = sites.map(|site| site.wire.0);
        self.0.get(&wires).map_or(&[], Vec::as_slice)
    }
}

impl WireContacts {
    /// A new contact, not yet among the others.
    pub(super) fn make(&mut self, sites: [WireSite; 2], normal: Vector) -> WireContact {
        self.made += 1;
        WireContact {
            key: KEYS + self.made,
            sites,
            wrong: false,
            normal,
            gap: 0.0,
            pushing: false,
            at_node: None,
        }
    }

    /// Moves every contact to where the wires are now closest; contacts that come to one place
    /// become one.
    pub(super) fn refresh(&mut self, world: &World, thickness: Thickness) {
        let mut taken = self.taken(world);
        // One that goes to the closest points goes to others where segments lie along each other: it takes the place of
        // none that stays at a node.
        let all = std::mem::take(&mut self.list).into_iter();
        let (at_nodes, closest): (Vec<_>, Vec<_>) = all.partition(|touch| touch.at_node.is_some());
        let mut by_wires = ByWires::default();
        for mut touch in at_nodes.into_iter().chain(closest) {
            let Some(pair) = touch.pair(world) else {
                continue;
            };
            let stays = match touch.at_node {
                None => {
                    touch.slide(world, pair, thickness, &mut taken);
                    true
                }
                Some(side) => touch.follow(world, side, pair, thickness),
            };
            // Its places may have come so close along one wire that they are no contact.
            let is_bend = || {
                let pair = touch.pair(world);
                pair.is_some_and(|pair| thickness.is_bend(world, pair, &touch.sites))
            };
            // At two places of one body nothing can push.
            let is_held = || {
                let pair = touch.pair(world);
                pair.is_some_and(|pair| is_held(world, pair, &touch.sites, 0.0))
            };
            if !stays || is_held() || !touch.wrong && is_bend() {
                continue;
            }
            let is_one =
                |&&at: &&usize| self.list[at].is_within(MERGED, world, &touch.sites, thickness);
            match by_wires.of(&touch.sites).iter().find(is_one) {
                Some(&older) => self.list[older].wrong |= touch.wrong,
                None => {
                    by_wires.add(&touch, self.list.len());
                    self.list.push(touch);
                }
            }
        }
    }

    /// Whether a contact keeps these places apart in this direction already.
    pub(super) fn keep_apart(
        &self,
        world: &World,
        thickness: Thickness,
        sites: &[WireSite; 2],
        normal: &Vector,
    ) -> bool {
        let mut all = self.list.iter();
        all.any(|touch| touch.keeps_apart(world, thickness, sites, normal))
    }

    /// What the solver is given.
    pub(super) fn contacts(&self, friction: f64) -> impl Iterator<Item = ContactConstraint> {
        self.list.iter().map(move |t| t.contact(friction))
    }

    /// The pairs that have a contact at their closest points.
    fn taken(&self, world: &World) -> PairSet {
        let closest = self.list.iter().filter(|touch| touch.at_node.is_none());
        closest.filter_map(|touch| touch.pair(world)).collect()
    }

    /// Adds contacts of nodes with segments that lie along theirs: where both segments of a contact are so near each
    /// other at an end of one, beside the other, that they touch or may fall onto each other in a step. With its
    /// closest points alone such a pair would be held at one place.
    pub(super) fn add_along(&mut self, world: &World, thickness: Thickness) {
        let fall = world.settings.gravity.norm() * world.settings.step * world.settings.step;
        let pairs = self.list.iter().filter_map(|touch| touch.pair(world));
        let pairs: PairSet = pairs.collect();
        let mut by_wires = ByWires::new(&self.list);
        for pair in pairs {
            let directions = pair.map(|segment| {
                let [start, end] = segment.ends(world);
                unit(&(end - start)).0
            });
            let is_along = directions[0].cross(&directions[1]).norm() < ALONG;
            let ends = [Side::A, Side::B].map(|side| [(side, 0.0), (side, 1.0)]);
            for (side, end) in ends.into_iter().flatten() {
                let beside = Closest::beside(world, pair, side as usize, end);
                let inside = is_inside(beside.parameters[1 - side as usize]);
                let sites = beside.sites(world, pair);
                let touches = beside.distance() <= thickness.touching(world, pair, &sites) + fall;
                let known = || {
                    let mut all = by_wires.of(&sites).iter().map(|&at| &self.list[at]);
                    all.any(|older| {
                        let stays = older.at_node.is_some() || !is_along;
                        stays && older.is_at(world, &sites, thickness)
                    })
                };
                if !(inside && touches) || thickness.is_bend(world, pair, &sites) || known() {
                    continue;
                }
                if let Some(normal) = direction(&beside.separation) {
                    let touch = WireContact {
                        at_node: Some(side),
                        ..self.make(sites, normal)
                    };
                    by_wires.add(&touch, self.list.len());
                    self.list.push(touch);
                }
            }
        }
    }

    /// Adds contacts, at most one for each pair of segments and each place.
    pub(super) fn add(
        &mut self,
        world: &World,
        thickness: Thickness,
        new: impl IntoIterator<Item = WireContact>,
    ) {
        let mut taken = self.taken(world);
        let mut by_wires = ByWires::new(&self.list);
        for touch in new {
            let free = touch.pair(world).is_some_and(|pair| taken.insert(pair));
            let is_one = |&at: &usize| self.list[at].is_at(world, &touch.sites, thickness);
            if free && !by_wires.of(&touch.sites).iter().any(is_one) {
                by_wires.add(&touch, self.list.len());
                self.list.push(touch);
            }
        }
    }

    /// The contact nearest to two places along the wires, not farther than their segments are long.
    pub(super) fn nearest(
        &mut self,
        world: &World,
        sites: &[WireSite; 2],
    ) -> Option<&mut WireContact> {
        let length = |site: &WireSite| {
            let segment = SegmentId::at(world, site)?;
            Some(segment.of(world).rest_length(segment.segment))
        };
        let most = length(&sites[0])? + length(&sites[1])?;
        let distance = |touch: &WireContact| {
            let along = |k: usize| (touch.sites[k].arc - sites[k].arc).abs();
            let same = (0..2).all(|k| touch.sites[k].wire == sites[k].wire);
            same.then(|| along(0) + along(1))
                .filter(|distance| *distance <= most)
        };
        let near = self.list.iter_mut().filter_map(|t| Some((distance(t)?, t)));
        near.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, t)| t)
    }

    /// Notes which contacts pushed, and forgets those that do not, far apart on the right side.
    pub(super) fn release(&mut self, world: &World, records: &[ContactRecord]) {
        let pushing = records.iter().filter(|record| record.normal_force() > 0.0);
        let pushing: BTreeSet<u64> = pushing.map(|record| record.contact.key).collect();
        for touch in &mut self.list {
            touch.pushing = pushing.contains(&touch.key);
        }
        self.list.retain(|touch| {
            let far = touch
                .pair(world)
                .is_none_or(|pair| touch.gap > 2.0 * reach(world, pair));
            touch.pushing || touch.wrong || !far
        });
    }

    /// Whether a contact pushes on a wire strictly between two arc lengths.
    pub(super) fn pushes_between(&self, wire: usize, from: f64, to: f64) -> bool {
        let inside = |site: &WireSite| site.wire.0 == wire && site.arc > from && site.arc < to;
        let mut pushing = self.list.iter().filter(|touch| touch.pushing);
        pushing.any(|touch| touch.sites.iter().any(inside))
    }
}

impl WireContact {
    /// Its segments. A place at a node is on two: if those after the nodes are joined, the closest of the
    /// other pairs that are not.
    fn pair(&self, world: &World) -> Option<[SegmentId; 2]> {
        let after = pair_at(world, &self.sites)?;
        if !joined(world, after) {
            return Some(after);
        }
        let before = |k: usize| {
            let SegmentId { wire, segment } = after[k];
            let is_at_node = after[k].nodes(world)[0].arc == self.sites[k].arc;
            let segment = segment.checked_sub(1).filter(|_| is_at_node)?;
            Some(SegmentId { wire, segment })
        };
        let (a, b) = (before(0), before(1));
        let others = [(a, Some(after[1])), (Some(after[0]), b), (a, b)];
        let others = others.into_iter().filter_map(|(a, b)| Some([a?, b?]));
        let apart = others.filter(|pair| !joined(world, *pair));
        let distance = |pair: &[SegmentId; 2]| Closest::of(world, *pair).distance();
        apart.min_by(|x, y| distance(x).total_cmp(&distance(y)))
    }

    /// Whether it keeps these places apart in this direction already.
    pub(super) fn keeps_apart(
        &self,
        world: &World,
        thickness: Thickness,
        sites: &[WireSite; 2],
        normal: &Vector,
    ) -> bool {
        const ALIKE: f64 = 0.99;
        self.is_at(world, sites, thickness) && self.normal.dot(normal) > ALIKE
    }

    /// Whether it is one contact with these places.
    fn is_at(&self, world: &World, sites: &[WireSite; 2], thickness: Thickness) -> bool {
        self.is_within(1.0, world, sites, thickness)
    }

    /// Whether these places are not farther along either wire than a part of the spacing.
    fn is_within(
        &self,
        part: f64,
        world: &World,
        sites: &[WireSite; 2],
        thickness: Thickness,
    ) -> bool {
        if (0..2).any(|k| self.sites[k].wire != sites[k].wire) {
            return false;
        }
        let along = [0, 1].map(|k| (self.sites[k].arc - sites[k].arc).abs());
        let farther = along[0].max(along[1]);
        // Mostly the first is enough, and the spacing has to be looked for.
        farther <= part * thickness.most_spacing(world, sites)
            && farther <= part * thickness.spacing(world, sites)
    }

    /// The last direction between the places, from B to A.
    pub(super) fn side(&self) -> Vector {
        if self.wrong {
            -self.normal
        } else {
            self.normal
        }
    }

    fn contact(&self, friction: f64) -> ContactConstraint {
        self.row(self.normal, self.gap, friction)
    }

    /// The contact with a normal and a gap.
    pub(super) fn row(&self, normal: Vector, gap: f64, friction: f64) -> ContactConstraint {
        ContactConstraint {
            key: self.key,
            a: self.sites[0].into(),
            b: self.sites[1].into(),
            normal,
            gap,
            friction,
        }
    }

    /// Goes to the closest points, over ends of segments to neighbours that are closer.
    fn slide(
        &mut self,
        world: &World,
        mut pair: [SegmentId; 2],
        thickness: Thickness,
        taken: &mut PairSet,
    ) {
        let mut closest = Closest::of(world, pair);
        let from = pair;
        // Ends: each pair is closer than the one before.
        while let Some((next, closer)) = hand_over(world, pair, &closest, thickness, taken) {
            (pair, closest) = (next, closer);
        }
        if pair != from {
            taken.remove(&from);
            taken.insert(pair);
        }
        self.go(world, pair, &closest, thickness);
    }

    /// Goes on with its node to where that is beside the other wire. Returns whether it is beside it still.
    fn follow(
        &mut self,
        world: &World,
        side: Side,
        mut pair: [SegmentId; 2],
        thickness: Thickness,
    ) -> bool {
        let node = side as usize;
        let [start, end] = pair[node].nodes(world).map(|node| node.arc);
        let at = match self.sites[node].arc {
            arc if arc == start => 0.0,
            arc if arc == end => 1.0,
            // The node was taken out.
            _ => return false,
        };
        let other = 1 - node;
        let mut beside = Closest::beside(world, pair, node, at);
        while !is_inside(beside.parameters[other]) {
            let Some(beyond) = pair[other].beyond(world, beside.parameters[other]) else {
                return false;
            };
            let mut next = pair;
            next[other] = beyond;
            if joined(world, next) {
                return false;
            }
            let closer = Closest::beside(world, next, node, at);
            if closer.distance() >= beside.distance() {
                // At a node of the other wire.
                break;
            }
            (pair, beside) = (next, closer);
        }
        self.go(world, pair, &beside, thickness);
        true
    }

    fn go(&mut self, world: &World, pair: [SegmentId; 2], to: &Closest, thickness: Thickness) {
        self.sites = to.sites(world, pair);
        if let Some(direction) = direction(&to.separation) {
            self.normal = if self.wrong { -direction } else { direction };
        }
        self.gap = self.normal.dot(&to.separation) - thickness.touching(world, pair, &self.sites);
    }
}

fn is_inside(parameter: f64) -> bool {
    parameter > 0.0 && parameter < 1.0
}

/// A neighbouring pair that is closer to touching, if the closest points are at an end.
fn hand_over(
    world: &World,
    pair: [SegmentId; 2],
    closest: &Closest,
    thickness: Thickness,
    taken: &PairSet,
) -> Option<([SegmentId; 2], Closest)> {
    let step = |which: usize| {
        let mut next = pair;
        next[which] = pair[which].beyond(world, closest.parameters[which])?;
        Some(next)
    };
    let next = [step(0), step(1)].into_iter().flatten();
    let free = next.filter(|next| !taken.contains(next) && !joined(world, *next));
    let mut closer = free.map(|next| (next, Closest::of(world, next)));
    // Above the distance at which they touch, which is less near each other along one wire.
    let height = |pair: [SegmentId; 2], at: &Closest| {
        let sites = at.sites(world, pair);
        at.distance() + thickness.allowance(world, pair, &sites)
    };
    let least = height(pair, closest);
    closer.find(|(next, other)| height(*next, other) < least)
}

#[cfg(test)]
mod tests;
