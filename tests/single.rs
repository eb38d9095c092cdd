//! Steps of positions in `f32`: the bits of the same numbers in `f64` that are stored as `f32`.

use proptest::prelude::*;
use tunnelproof::mesh::Mesh;
use tunnelproof::{
    Advance, Blocked, Clearance, EdgeEdge, Kind, Pairs, PairsStep, Point, Precision, Query,
    QueryKind, VertexFace, advance_in, advance_pairs,
};
use tunnelproof_reference::oracle::decide_query;

type Points = [[f32; 3]; 4];

/// Small integers, numbers of a size, and such beside far larger ones.
fn coordinate() -> impl Strategy<Value = f32> {
    let far = (-1f32..1.0).prop_map(|x| 1024.0 + x);
    prop_oneof![
        (-3i8..=3).prop_map(f32::from),
        -1f32..1.0,
        far,
        any::<f32>().prop_filter("finite", |x| x.is_finite()),
    ]
}

/// The four points at an end of a step, all coordinates of one sort or each of its own.
fn points() -> impl Strategy<Value = Points> {
    let same = prop::array::uniform4(prop::array::uniform3(-1f32..1.0));
    prop_oneof![
        3 => same,
        1 => prop::array::uniform4(prop::array::uniform3(coordinate())),
    ]
}

fn clearance() -> impl Strategy<Value = Clearance> {
    prop_oneof![
        Just(Clearance::None),
        (0.0..0.5).prop_map(Clearance::Distance),
        (0.0..1.0).prop_map(Clearance::Share),
    ]
}

fn radius() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), 0.0..0.5]
}

fn in_f64(points: &[[f32; 3]]) -> [Point; 4] {
    [0, 1, 2, 3].map(|i| Point::from(points[i].map(f64::from)))
}

fn bits(points: &[Point; 4]) -> [[u64; 3]; 4] {
    points.map(|point| <[f64; 3]>::from(point).map(f64::to_bits))
}

/// That a step of two sides is the advance of their query, and the motion to what is stored is free.
fn compare(
    query: &Query,
    expected: &Advance,
    step: (f64, &[[f32; 3]], Option<Blocked>),
) -> Result<(), TestCaseError> {
    let (step, positions, blocked) = step;
    let stored = in_f64(positions);
    prop_assert_eq!(step.to_bits(), expected.step.to_bits());
    prop_assert_eq!(bits(&stored), bits(&expected.points));
    prop_assert_eq!(blocked, expected.blocked);
    if let Some(kept) = expected.kept {
        let motion = Query::new(query.kind(), *query.start(), stored, kept);
        let motion = motion.expect("what is stored is finite");
        prop_assert!(decide_query(&motion).hit.is_none());
    }
    Ok(())
}

/// A pair by itself, in a list, and as a mesh.
fn check(
    kind: QueryKind,
    start: &Points,
    end: &Points,
    radius: f64,
    clearance: Clearance,
) -> Result<(), TestCaseError> {
    const ALL: [[u32; 4]; 1] = [[0, 1, 2, 3]];
    let query = Query::new(kind, in_f64(start), in_f64(end), radius).expect("finite");
    let advance = match &query {
        Query::EdgeEdge(query) => advance_in(query, clearance, Precision::F32),
        Query::VertexFace(query) => advance_in(query, clearance, Precision::F32),
    };
    let expected = advance.expect("the clearance is one");
    let (edges, faces) = match kind {
        QueryKind::EdgeEdge => (&ALL[..], &[][..]),
        QueryKind::VertexFace => (&[][..], &ALL[..]),
    };
    let of_edges = list::<EdgeEdge>(start, end, edges, radius);
    let of_faces = list::<VertexFace>(start, end, faces, radius);
    let moved = advance_pairs(&of_edges, &of_faces, clearance).expect("the same positions");
    let PairsStep {
        step,
        positions,
        limits,
        near,
        ..
    } = &moved;
    let blocked = limits.first().map(|limit| limit.blocked);
    compare(&query, &expected, (*step, positions, blocked))?;
    prop_assert!(
        near.iter()
            .all(|(_, kept)| Some(*kept) == expected.kept || *step == 0.0)
    );
    // A vertex meets the edges of a face, too: then there are more pairs.
    if kind == QueryKind::VertexFace {
        return Ok(());
    }
    let mesh = Mesh::new(4, &[[0, 1], [2, 3]], &[]).expect("indices of vertices");
    let moved = mesh.step_with_clearance(start, end, radius, clearance);
    let moved = moved.expect("finite");
    let blocked = moved.limits.first().map(|limit| limit.blocked);
    compare(&query, &expected, (moved.step, &moved.positions, blocked))
}

fn list<'a, K: Kind>(
    start: &'a Points,
    end: &'a Points,
    indices: &'a [[u32; 4]],
    radius: f64,
) -> Pairs<'a, K, f32> {
    Pairs::new(start, end, indices, radius).expect("finite")
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if cfg!(debug_assertions) { 200 } else { 3000 }))]

    #[test]
    fn steps_in_f32_are_those_of_the_same_numbers_in_f64(
        start in points(),
        end in points(),
        radius in radius(),
        clearance in clearance(),
    ) {
        for kind in [QueryKind::EdgeEdge, QueryKind::VertexFace] {
            check(kind, &start, &end, radius, clearance)?;
        }
    }
}
