//! How often wires have passed through each other, counted with signs.
//!
//! A passage at a node is seen by every segment there, and by none as a crossing inside of it. So the ledger counts in
//! general position: every node is a millionth of its wire's radius beside its place, by an offset that is a smooth
//! function of wire and arc length. The wires so moved are wires again, their motion has no gaps, and their passages are inside
//! of segments, each seen once.

use std::collections::BTreeMap;

use rayon::prelude::*;
use tunnelproof::query::{EdgeEdge, Point};
use tunnelproof::wire::{Remesh, RemeshKind, StepRecord};

use super::remesh::Wires;
use super::segments::{Segment, candidates, moving, query};
use tunnelproof_reference::oracle::net_passages;

/// Passages by pair of wires.
#[derive(Default)]
pub(super) struct Ledger {
    radii: Vec<f64>,
    sums: BTreeMap<[usize; 2], i64>,
}

impl Ledger {
    pub(super) fn new(radii: Vec<f64>) -> Self {
        let sums = BTreeMap::new();
        Ledger { radii, sums }
    }

    /// Pairs of wires that have passed through each other without coming back, and how often.
    pub(super) fn standing(&self) -> Vec<([usize; 2], i64)> {
        let sums = self.sums.iter().filter(|(_, sum)| **sum != 0);
        sums.map(|(wires, sum)| (*wires, *sum)).collect()
    }

    /// A node beside its place.
    fn beside(&self, wire: usize, arc: f64, at: Point) -> Point {
        let size = 1e-6 * self.radii.get(wire).copied().unwrap_or(0.0);
        // Frequencies without a common measure. Nothing depends on which.
        let phase = 1.7 * wire as f64;
        let offset = [(1.3, 0.4), (1.9, 1.1), (2.3, 2.9)]
            .map(|(k, shift)| size * (k * (arc + phase) + shift).sin());
        Point::new(at.x + offset[0], at.y + offset[1], at.z + offset[2])
    }

    fn enter(&mut self, wires: [usize; 2], passages: i64) {
        if passages != 0 {
            let wires = [wires[0].min(wires[1]), wires[0].max(wires[1])];
            *self.sums.entry(wires).or_default() += passages;
        }
    }

    /// The passages of a step.
    pub(super) fn step(&mut self, record: &StepRecord) {
        let segments = moving(record, |wire, arc, at| self.beside(wire, arc, at));
        let found: Vec<_> = candidates(&segments)
            .into_par_iter()
            .filter_map(|pair| {
                let [a, b] = pair.map(|k| &segments[k]);
                let query = query(a, b).ok()?;
                Some(([a, b].map(|s: &Segment| s.id.wire.0), net_passages(&query)))
            })
            .collect();
        for (wires, passages) in found {
            self.enter(wires, passages);
        }
    }

    /// The passages of a change of resolution: taking `b` out moves the start of `bc` to `a`.
    pub(super) fn remesh(&mut self, wires: &Wires, change: &Remesh) {
        let own = change.wire.0;
        let corner = |k: usize| self.beside(own, change.arcs[k], change.triangle[k]);
        let [a, b, c] = [0, 1, 2].map(corner);
        let (from, to) = match change.kind {
            RemeshKind::Merge => (b, a),
            RemeshKind::Split => (a, b),
        };
        let mut found = Vec::new();
        for (w, arcs, points) in wires.others(change) {
            let [p, q] = [0, 1].map(|k| self.beside(w, arcs[k], points[k]));
            if let Ok(query) = EdgeEdge::new([from, c, p, q], [to, c, p, q], 0.0) {
                found.push(([own, w], net_passages(&query)));
            }
        }
        for (wires, passages) in found {
            self.enter(wires, passages);
        }
    }
}
