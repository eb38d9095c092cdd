//! What is said of a contact: parameters, kind, side and flags.

use num_bigint::BigInt;
use tunnelproof::contact::{Case, ContactKind, Flags};
use tunnelproof::narrow::Unsupported;
use tunnelproof::query::{EdgeEdge, Query, QueryKind};
use tunnelproof::thesis::Repairs;

use super::{Points, query};
use crate::answer::{Enclosure, ExactHit, Parameters};
use crate::shadow::{Shadow, edge_edge};
use crate::subject::{Answer, Subject};

fn hit(points: &Points) -> ExactHit {
    edge_edge::<BigInt>(&query(points), Repairs::ALL)
        .hit
        .unwrap()
}

/// AB from (-1, 0, 0) to (1, 0, 0), still, and CD.
fn against_still_edge(start: [[i64; 3]; 2], end: [[i64; 3]; 2]) -> Points {
    let ([c, d], [e, f]) = (start, end);
    [[-1, 0, 0], [1, 0, 0], c, d, [-1, 0, 0], [1, 0, 0], e, f]
}

fn exactly(u: f64, v: f64) -> Parameters {
    let [u, v] = [u, v].map(Enclosure::exactly);
    Parameters { u, v }
}

#[test]
fn kind_general_motion_through_both_interiors_is_a_crossing() {
    let points = against_still_edge([[0, -1, 1], [0, 1, 1]], [[0, -1, -3], [1, 1, -3]]);
    let hit = hit(&points);
    assert_eq!(hit.toi, Enclosure::exactly(0.25));
    assert_eq!(hit.kind, ContactKind::Crossing);
    assert!(hit.crosses);
    assert_eq!(hit.first.v, Enclosure::exactly(0.5));
    assert_eq!(hit.first.u, Enclosure::exactly(0.5625));
    assert_eq!(hit.second, None);
    assert_eq!(hit.flags, Flags::default());
}

#[test]
fn side_is_the_sign_before_contact_and_turns_with_an_edge() {
    let points = against_still_edge([[0, -1, 1], [0, 1, 1]], [[0, -1, -3], [1, 1, -3]]);
    let [a, b, c, d, e, f, g, h] = points;
    let turned = [a, b, d, c, e, f, h, g];
    // K x L = (2, 0, 0) x (0, 2, 0) and M = (1, -1, 1) at t = 0.
    assert_eq!((hit(&points).side, hit(&turned).side), (1, -1));
    let reversed = [e, f, g, h, a, b, c, d];
    assert_eq!(hit(&reversed).side, -1);
}

#[test]
fn kind_general_motion_past_an_end_or_back_is_a_graze() {
    // The end C of CD passes through AB: f changes sign, v = 0.
    let past_end = against_still_edge([[0, 0, 1], [0, 2, 1]], [[0, 0, -1], [1, 2, -1]]);
    let past_end = hit(&past_end);
    assert_eq!(past_end.first, exactly(0.5, 0.0));
    assert_eq!(
        (past_end.kind, past_end.crosses),
        (ContactKind::Graze, false)
    );
    // f = -3 (1 - 2t)^2: CD lies down on AB and turns over.
    let turning = [[0, 0, 0], [3, 0, 0], [1, 1, 0], [2, 0, 1]];
    let turning_end = [[0, 0, 0], [3, 0, 0], [1, -1, 0], [2, 0, -1]];
    let ([a, b, c, d], [e, f, g, h]) = (turning, turning_end);
    let turning = hit(&[a, b, c, d, e, f, g, h]);
    assert_eq!(turning.kind, ContactKind::Graze);
    assert!(!turning.crosses && turning.side == -1);
    assert!(turning.flags.temporarily_parallel && !turning.flags.temporarily_point);
    let second = turning.second.unwrap();
    assert_eq!(
        (turning.first.v, second.v),
        (Enclosure::exactly(0.0), Enclosure::exactly(1.0))
    );
    let third = |n: f64| Enclosure {
        below: n / 3.0,
        above: (n / 3.0).next_up(),
    };
    assert_eq!((turning.first.u, second.u), (third(1.0), third(2.0)));
}

#[test]
fn kind_contact_at_an_end_of_the_step_is_a_graze() {
    let at_end = against_still_edge([[0, -1, 1], [0, 1, 1]], [[0, -1, 0], [0, 1, 0]]);
    let at_end_hit = hit(&at_end);
    assert_eq!(at_end_hit.toi, Enclosure::exactly(1.0));
    assert_eq!(
        (at_end_hit.kind, at_end_hit.crosses),
        (ContactKind::Graze, false)
    );
    assert_ne!(at_end_hit.side, 0);
    let [a, b, c, d, e, f, g, h] = at_end;
    let at_start = hit(&[e, f, g, h, a, b, c, d]);
    assert_eq!(at_start.toi, Enclosure::exactly(0.0));
    assert_eq!((at_start.kind, at_start.side), (ContactKind::Graze, 0));
}

#[test]
fn kind_coplanar_end_through_the_interior_is_a_crossing() {
    let through = against_still_edge([[0, 1, 0], [0, 3, 0]], [[0, -1, 0], [0, 2, 0]]);
    let through = hit(&through);
    assert_eq!(
        (through.kind, through.crosses),
        (ContactKind::Crossing, true)
    );
    assert_eq!(through.first, exactly(0.5, 0.0));
    assert_eq!(through.side, 0);
    // C passes B, the end of AB.
    let past_end = against_still_edge([[1, 1, 0], [1, 3, 0]], [[1, -1, 0], [2, 2, 0]]);
    let past_end = hit(&past_end);
    assert_eq!(past_end.first, exactly(1.0, 0.0));
    assert_eq!(
        (past_end.kind, past_end.crosses),
        (ContactKind::Graze, false)
    );
}

#[test]
fn kind_parallel_edges_that_pass_with_overlap_cross_and_with_a_common_end_graze() {
    let falling = |c: i64, d: i64| {
        hit(&against_still_edge(
            [[c, 1, 0], [d, 1, 0]],
            [[c, -1, 0], [d, -1, 0]],
        ))
    };
    let overlap = falling(3, 0);
    assert_eq!(
        (overlap.kind, overlap.crosses),
        (ContactKind::Crossing, true)
    );
    assert_eq!(overlap.first, exactly(0.5, 1.0));
    let second = overlap.second.unwrap();
    assert_eq!(second.u, Enclosure::exactly(1.0));
    // v of B, 2/3, which as an f64 is below 2/3.
    assert_eq!(
        (second.v.below, second.v.above),
        (2.0 / 3.0, (2.0_f64 / 3.0).next_up())
    );
    // Parallel for the whole step is not temporarily parallel.
    assert_eq!(overlap.flags, Flags::default());
    let common_end = falling(1, 3);
    assert_eq!(
        (common_end.kind, common_end.second),
        (ContactKind::Graze, None)
    );
    assert_eq!(common_end.first, exactly(1.0, 0.0));
}

#[test]
fn kind_collinear_motion_crosses_where_contact_begins() {
    let along = |start: [i64; 2], end: [i64; 2]| {
        hit(&against_still_edge(
            start.map(|x| [x, 0, 0]),
            end.map(|x| [x, 0, 0]),
        ))
    };
    let approach = along([2, 3], [0, 1]);
    assert_eq!(approach.toi, Enclosure::exactly(0.5));
    assert_eq!(
        (approach.kind, approach.crosses),
        (ContactKind::Crossing, true)
    );
    assert_eq!((approach.first, approach.second), (exactly(1.0, 0.0), None));
    let departure = along([0, 2], [3, 5]);
    assert_eq!(
        (departure.kind, departure.crosses),
        (ContactKind::Graze, false)
    );
    assert_eq!(
        (departure.first, departure.second),
        (exactly(0.5, 0.0), Some(exactly(1.0, 0.5)))
    );
    // C departs from B at once, D comes in later.
    let again = along([1, 3], [5, -1]);
    assert_eq!(again.toi, Enclosure::exactly(0.0));
    assert_eq!((again.kind, again.crosses), (ContactKind::Graze, true));
    // Comes to touch at the very end.
    let at_end = along([3, 4], [1, 2]);
    assert_eq!((at_end.kind, at_end.crosses), (ContactKind::Graze, false));
}

#[test]
fn flags_temporarily_point_asks_for_length_at_another_time() {
    // CD shrinks to a point on AB at t = 1/2 and grows again.
    let shrinking = against_still_edge([[0, -1, 1], [0, 1, 1]], [[0, 1, -1], [0, -1, -1]]);
    let shrinking = hit(&shrinking);
    assert_eq!(shrinking.toi, Enclosure::exactly(0.5));
    assert!(shrinking.flags.temporarily_point && !shrinking.flags.temporarily_parallel);
    assert_eq!(shrinking.first, exactly(0.5, 0.0));
    let point = against_still_edge([[0, 1, 0], [0, 1, 0]], [[0, -1, 0], [0, -1, 0]]);
    let answer = edge_edge::<BigInt>(&query(&point), Repairs::ALL);
    assert_eq!(answer.case, Case::Degenerate);
    let hit = answer.hit.unwrap();
    assert_eq!(
        (hit.flags, hit.first),
        (Flags::default(), exactly(0.5, 0.0))
    );
    assert_eq!(hit.kind, ContactKind::Crossing);
}

#[test]
fn subject_refuses_what_it_does_not_take() {
    let points = against_still_edge([[0, 1, 0], [0, 3, 0]], [[0, -1, 0], [0, 2, 0]]);
    let edges = query(&points);
    let (start, end) = (*edges.start(), *edges.end());
    let face = Query::new(QueryKind::VertexFace, start, end, 0.0).unwrap();
    let shadow = Shadow::REPAIRED;
    assert_eq!(
        shadow.answer(&face),
        Err(Unsupported::Kind(QueryKind::VertexFace).into())
    );
    let wide = EdgeEdge::new(start, end, 0.5).unwrap();
    assert_eq!(
        shadow.answer(&Query::EdgeEdge(wide)),
        Err(Unsupported::Radius(0.5.into()).into())
    );
    let answer = shadow.answer(&Query::EdgeEdge(edges));
    let expected = edge_edge::<BigInt>(&edges, Repairs::ALL);
    assert_eq!(answer, Ok(Answer::Exact(expected)));
    assert_eq!(
        (shadow.name(), Shadow::PUBLISHED.name()),
        ("shadow", "shadow-published")
    );
}
