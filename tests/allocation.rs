//! The certified path does not allocate for coordinates of ordinary magnitude, its exact stage
//! included.

use allocation_counter::measure;
use tunnelproof::certified::{decide, decide_exactly};
use tunnelproof::query::{EdgeEdge, Point, Query};
use tunnelproof_reference::generate::FAMILIES;

/// A query with its coordinates multiplied by `factor` and moved by `offset`, so that they have all
/// their bits.
fn moved(query: &EdgeEdge, factor: f64, offset: f64) -> EdgeEdge {
    let moved = |p: &Point| Point::from(p.coords.map(|x| x * factor + offset));
    let (start, end) = (query.start().each_ref(), query.end().each_ref());
    EdgeEdge::new(start.map(moved), end.map(moved), 0.0).expect("finite coordinates")
}

#[test]
fn certified_does_not_allocate_for_ordinary_coordinates() {
    for family in FAMILIES {
        for (factor, offset) in [(1.0, 0.0), (0.1, 1.0 / 3.0), (1e-6, 0.0), (1e5, 1e5 / 7.0)] {
            for index in 0..2000 {
                let Query::EdgeEdge(query) = family.query(4, index) else {
                    continue;
                };
                let query = moved(&query, factor, offset);
                let allocations = measure(|| {
                    assert!(decide(&query).is_ok() && decide_exactly(&query).is_ok());
                });
                let id = || format!("{}:4:{index} times {factor} plus {offset}", family.name());
                assert_eq!(allocations.count_total, 0, "{}", id());
            }
        }
    }
}
