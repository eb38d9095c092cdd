//! The certified path does not allocate for coordinates of ordinary magnitude, its exact stage
//! included.

use std::hint::black_box;

use allocation_counter::measure;
use tunnelproof::certified::{decide, decide_exactly};
use tunnelproof::query::{EdgeEdge, Point, Query, VertexFace};
use tunnelproof_reference::generate::FAMILIES;

/// A query with its coordinates multiplied by `factor` and moved by `offset`, so that they have all
/// their bits.
fn moved(query: &EdgeEdge, factor: f64, offset: f64) -> EdgeEdge {
    let moved = |p: &Point| Point::from(p.coords.map(|x| x * factor + offset));
    let (start, end) = (query.start().each_ref(), query.end().each_ref());
    EdgeEdge::new(start.map(moved), end.map(moved), 0.0).expect("finite coordinates")
}

/// Whether the nonzero coordinates are within a factor of 1e12, as those between 1e-6 and 1e6 are,
/// and a time of impact is not below 1e-12 unless it is 0.
fn is_ordinary(query: &EdgeEdge) -> bool {
    let points = query.start().iter().chain(query.end());
    let sizes = points.flat_map(|p| p.iter()).map(|x| x.abs());
    let sizes = sizes.filter(|size| *size > 0.0);
    let least = sizes.clone().fold(f64::MAX, f64::min);
    let is_late = decide(query).is_none_or(|hit| hit.toi == 0.0 || hit.toi > 1e-12);
    is_late && sizes.fold(0.0, f64::max) <= 1e12 * least
}

/// Whether the vertex touches the face soon after the start.
fn is_early(face: &VertexFace) -> bool {
    let hit = decide(face);
    hit.is_some_and(|hit| hit.toi > 0.0 && hit.toi <= 1e-12)
}

#[test]
fn certified_does_not_allocate_for_ordinary_coordinates() {
    for family in FAMILIES {
        let mut ordinary = 0;
        for (factor, offset) in [(1.0, 0.0), (0.1, 1.0 / 3.0), (1e-6, 0.0), (1e5, 1e5 / 7.0)] {
            for index in 0..2000 {
                let Query::EdgeEdge(query) = family.query(4, index) else {
                    continue;
                };
                let query = moved(&query, factor, offset);
                if !is_ordinary(&query) {
                    continue;
                }
                ordinary += 1;
                let face = VertexFace::new(*query.start(), *query.end(), 0.0).expect("finite");
                let allocations = measure(|| {
                    black_box((decide(&query), decide_exactly(&query)));
                    black_box(decide(&face));
                    if !is_early(&face) {
                        black_box(decide_exactly(&face));
                    }
                });
                let id = || format!("{}:4:{index} times {factor} plus {offset}", family.name());
                assert_eq!(allocations.count_total, 0, "{}", id());
            }
        }
        // Of 8000.
        assert!(ordinary > 2000, "{}: {ordinary}", family.name());
    }
}
