//! Pairs of segments as the broad phase of a moving-wire scene delivers them.

use tunnelproof::query::{EdgeEdge, Point};

use super::boxes::{Bounds, bounds, overlap};

const WIRES: usize = 16;
const SEGMENTS: usize = 30;
/// Steps that are looked at, and the time between two of them in seconds.
const STEPS: usize = 40;
const APART: f64 = 0.15;
/// The length of a step in seconds.
const STEP: f64 = 1.0 / 60.0;

/// Wires of 3 m in segments of a decimetre, hung across each other in a box of 4 m, swinging and
/// waving at up to about 5 m/s: every pair of segments that are not neighbours and whose swept
/// boxes overlap.
pub(crate) fn pairs() -> Vec<EdgeEdge> {
    let starts = (0..STEPS).map(|step| step as f64 * APART);
    starts.flat_map(pairs_of_step).collect()
}

fn pairs_of_step(start: f64) -> Vec<EdgeEdge> {
    let swept: Vec<_> = (0..WIRES * SEGMENTS)
        .map(|index| {
            let (wire, segment) = (index / SEGMENTS, index % SEGMENTS);
            let at = |time| [0, 1].map(|end| node(wire, segment + end, time));
            (wire, segment, [at(start), at(start + STEP)])
        })
        .collect();
    let mut pairs = Vec::new();
    for (i, (wire, segment, ends)) in swept.iter().enumerate() {
        for (other_wire, other, other_ends) in &swept[i + 1..] {
            let are_neighbours = wire == other_wire && *other <= segment + 1;
            if !are_neighbours && overlap(&box_of(ends), &box_of(other_ends)) {
                let at = |end: usize| {
                    let ([a, b], [c, d]) = (ends[end], other_ends[end]);
                    [a, b, c, d]
                };
                pairs.push(EdgeEdge::new(at(0), at(1), 0.0).expect("finite coordinates"));
            }
        }
    }
    pairs
}

/// A node of a wire, in metres: along x or y by turns, sagging, swinging and waving.
fn node(wire: usize, index: usize, time: f64) -> Point {
    let (own, along) = (wire as f64, index as f64 / SEGMENTS as f64);
    let phase = 2.4 * own;
    let swing = 0.5 * (3.0 * time + phase).sin();
    let wave = 0.1 * (12.0 * along + 20.0 * time + phase).sin();
    let sag = 4.0 * along * (1.0 - along);
    let across = 0.25 * own - 1.5 + sag * swing + wave;
    let down = -0.6 * sag + 0.1 * (9.0 * along - 15.0 * time + 1.7 * own).sin();
    match wire % 2 {
        0 => Point::new(3.0 * along - 1.5, across, down),
        _ => Point::new(across, 3.0 * along - 1.5, down),
    }
}

/// Whether the boxes of the swept edges have a point in common.
pub(crate) fn overlaps(query: &EdgeEdge) -> bool {
    let ([a, b, c, d], [e, f, g, h]) = (*query.start(), *query.end());
    overlap(&box_of(&[[a, b], [e, f]]), &box_of(&[[c, d], [g, h]]))
}

/// The box of an edge at the start and at the end.
fn box_of(edge: &[[Point; 2]; 2]) -> Bounds {
    bounds(edge.as_flattened().iter().copied(), 0.0)
}
