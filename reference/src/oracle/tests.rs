use num_bigint::BigInt;
use proptest::prelude::*;
use tunnelproof::contact::{Case, ContactKind};
use tunnelproof::query::{Point, Query, QueryKind};

use super::*;
use crate::answer::{Enclosure, Parameters};
use crate::generate;
use QueryKind::{EdgeEdge, VertexFace};

type Corners = [[f64; 3]; 8];

fn query(kind: QueryKind, points: Corners, radius: f64) -> Query {
    let p = points.map(|[x, y, z]| Point::new(x, y, z));
    let (start, end) = ([p[0], p[1], p[2], p[3]], [p[4], p[5], p[6], p[7]]);
    Query::new(kind, start, end, radius).unwrap()
}

fn answer(points: Corners) -> ExactAnswer {
    decide::<BigInt>(&query(EdgeEdge, points, 0.0)).written()
}

fn exactly(value: f64) -> Enclosure {
    Enclosure::exactly(value)
}

#[test]
fn oracle_finds_a_crossing_with_its_time_place_and_side() {
    // CD along y passes down through AB along x.
    let hit = answer([
        [-1., 0., 0.],
        [1., 0., 0.],
        [0.5, -1., 1.],
        [0.5, 1., 1.],
        [-1., 0., 0.],
        [1., 0., 0.],
        [0.5, -1., -3.],
        [0.5, 1., -3.],
    ])
    .hit
    .unwrap();
    assert_eq!(hit.toi, exactly(0.25));
    assert_eq!((hit.first.u, hit.first.v), (exactly(0.75), exactly(0.5)));
    assert_eq!(
        (hit.kind, hit.crosses, hit.second),
        (ContactKind::Crossing, true, None)
    );
    // f = (K x L) . M with K along x and L along y has the sign of C's height.
    assert_eq!(hit.side, 1);
}

#[test]
fn oracle_calls_contact_at_an_end_or_at_the_ends_of_the_step_a_graze() {
    let still = [[-1., 0., 0.], [1., 0., 0.]];
    let falling = |x: f64, from: f64, to: f64| {
        let edge = |z: f64| [[x, -1., z], [x, 1., z]];
        let ([c, d], [e, f]) = (edge(from), edge(to));
        answer([still[0], still[1], c, d, still[0], still[1], e, f])
            .hit
            .unwrap()
    };
    let at_end_of_edge = falling(1., 1., -1.);
    assert_eq!(
        (at_end_of_edge.toi, at_end_of_edge.kind),
        (exactly(0.5), ContactKind::Graze)
    );
    let at_start = falling(0., 0., -1.);
    assert_eq!(
        (at_start.toi, at_start.kind, at_start.side),
        (exactly(0.), ContactKind::Graze, 0)
    );
    let at_finish = falling(0., 1., 0.);
    assert_eq!(
        (at_finish.toi, at_finish.kind),
        (exactly(1.), ContactKind::Graze)
    );
    assert!(!at_finish.crosses);
}

#[test]
fn oracle_reports_a_later_crossing_behind_a_graze() {
    // C starts on AB; D sinks while C moves back below, and CD passes through AB at t = 1/2.
    let hit = answer([
        [0., 0., 0.],
        [2., 0., 0.],
        [1., 0., 0.],
        [1., 2., 2.],
        [0., 0., 0.],
        [2., 0., 0.],
        [1., -2., -1.],
        [1., 2., 0.],
    ])
    .hit
    .unwrap();
    assert_eq!(
        (hit.toi, hit.kind, hit.crosses),
        (exactly(0.), ContactKind::Graze, true)
    );
}

#[test]
fn oracle_calls_contact_of_momentarily_parallel_edges_a_graze_though_the_lines_swap_sides() {
    // f = -4 (2 t - 1)^3: it changes sign, but AB stays below CD before and after.
    let points = [
        [-2., 0., 1.],
        [0., 0., -1.],
        [-1., -1., 1.],
        [1., 1., -1.],
        [0., 0., -1.],
        [2., 0., 1.],
        [-1., 1., -1.],
        [1., -1., 1.],
    ];
    let hit = answer(points).hit.unwrap();
    assert_eq!(
        (hit.toi, hit.kind, hit.crosses),
        (exactly(0.5), ContactKind::Graze, false)
    );
    assert!(hit.flags.temporarily_parallel);
    // A disturbance that a crossing would survive.
    let mut lower = points;
    for corner in [0, 1, 4, 5] {
        lower[corner][2] -= 0.001;
    }
    assert_eq!(answer(lower).hit, None);
}

#[test]
fn oracle_gives_both_ends_of_an_overlap() {
    // Collinear: AB = [0, 2], CD = [5, 3] moving left by 2.
    let touching = answer([
        [0., 0., 0.],
        [2., 0., 0.],
        [5., 0., 0.],
        [3., 0., 0.],
        [0., 0., 0.],
        [2., 0., 0.],
        [3., 0., 0.],
        [1., 0., 0.],
    ]);
    assert_eq!(touching.case, Case::Collinear);
    let hit = touching.hit.unwrap();
    assert_eq!(
        (hit.toi, hit.second, hit.kind),
        (exactly(0.5), None, ContactKind::Crossing)
    );
    assert_eq!((hit.first.u, hit.first.v), (exactly(1.), exactly(1.)));
    // Parallel, falls onto it: overlap [1, 2] of AB = [0, 2] and CD = [3, 1].
    let parallel = answer([
        [0., 0., 0.],
        [2., 0., 0.],
        [3., 0., 1.],
        [1., 0., 1.],
        [0., 0., 0.],
        [2., 0., 0.],
        [3., 0., -1.],
        [1., 0., -1.],
    ]);
    assert_eq!(parallel.case, Case::Parallel);
    let hit = parallel.hit.unwrap();
    assert_eq!((hit.toi, hit.kind), (exactly(0.5), ContactKind::Crossing));
    assert_eq!((hit.first.u, hit.first.v), (exactly(0.5), exactly(1.)));
    let second = hit.second.unwrap();
    assert_eq!((second.u, second.v), (exactly(1.), exactly(0.5)));
}

/// Small integers, confined to a line or a plane as often as not, with points repeated: every
/// degeneracy there is.
fn lattice(kind: QueryKind) -> impl Strategy<Value = Query> {
    let coordinate = -2i8..=2;
    let point = prop::array::uniform3(coordinate);
    let points = prop::array::uniform8(point);
    (points, 0u8..6, 0usize..8, 0usize..8, any::<bool>()).prop_map(
        move |(mut p, confinement, from, to, repeat)| {
            if repeat {
                p[to] = p[from];
            }
            let q = p.map(|[x, y, z]| match confinement {
                0 => [x, y, 0],
                1 => [x, x, x],
                2 => [x, y, x],
                3 => [x, y, i8::from(z > 0)],
                _ => [x, y, z],
            });
            query(kind, q.map(|c| c.map(f64::from)), 0.0)
        },
    )
}

fn uniform(kind: QueryKind) -> impl Strategy<Value = Query> {
    let points = prop::array::uniform8(prop::array::uniform3(-1.0f64..1.0));
    (points, any::<bool>()).prop_map(move |(p, coarse)| {
        let points = if coarse {
            p.map(|c| c.map(|x| (x * 64.0).round()))
        } else {
            p
        };
        query(kind, points, 0.0)
    })
}

/// The same with a radius, a small number or the distance of some two lattice points.
fn thick(queries: impl Strategy<Value = Query>) -> impl Strategy<Value = Query> {
    (
        queries,
        prop::sample::select(vec![0.25, 0.5, 1.0, 1.5, 2.0, 5.0]),
    )
        .prop_map(|(query, radius)| {
            Query::new(query.kind(), *query.start(), *query.end(), radius).unwrap()
        })
}

fn check_against_the_definition(query: &Query) -> Result<(), TestCaseError> {
    let decision = decide::<BigInt>(query);
    let expected = literal::first_contact(query);
    match (decision.toi(), &expected) {
        (None, None) => {}
        (Some(toi), Some(expected)) => prop_assert!(toi.compare(expected).is_eq()),
        (toi, expected) => prop_assert!(false, "{toi:?} instead of {expected:?}"),
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(5000))]

    #[test]
    fn oracle_agrees_with_the_definition_on_lattice(query in lattice(EdgeEdge)) {
        check_against_the_definition(&query)?;
    }

    #[test]
    fn oracle_agrees_with_the_definition_on_lattice_faces(query in lattice(VertexFace)) {
        check_against_the_definition(&query)?;
    }

    #[test]
    fn oracle_agrees_with_the_definition_on_thick_lattice(query in thick(lattice(EdgeEdge))) {
        check_against_the_definition(&query)?;
    }

    #[test]
    fn oracle_agrees_with_the_definition_on_thick_lattice_faces(
        query in thick(lattice(VertexFace)),
    ) {
        check_against_the_definition(&query)?;
    }

    #[test]
    fn oracle_answer_is_symmetric(query in lattice(EdgeEdge)) {
        let answer = decide::<BigInt>(&query).written();
        let map = |order: [usize; 4]| {
            let pick = |p: &[Point; 4]| order.map(|i| p[i]);
            let (start, end) = (pick(query.start()), pick(query.end()));
            let query = Query::new(EdgeEdge, start, end, 0.0).unwrap();
            decide::<BigInt>(&query).written()
        };
        // The other edge first: the same contact, seen from the other side.
        let swapped = map([2, 3, 0, 1]);
        prop_assert_eq!(answer.case, swapped.case);
        prop_assert_eq!(answer.hit.is_some(), swapped.hit.is_some());
        if let (Some(a), Some(b)) = (answer.hit, swapped.hit) {
            prop_assert_eq!((a.toi, a.kind, a.crosses, a.flags), (b.toi, b.kind, b.crosses, b.flags));
            prop_assert_eq!(a.side, b.side);
            if a.second.is_none() {
                prop_assert_eq!((a.first.u, a.first.v), (b.first.v, b.first.u));
            }
        }
        // One edge reversed: u becomes 1 - u, the side changes its sign.
        let reversed = map([1, 0, 2, 3]);
        prop_assert_eq!(answer.hit.is_some(), reversed.hit.is_some());
        if let (Some(a), Some(b)) = (answer.hit, reversed.hit) {
            prop_assert_eq!((a.toi, a.kind, a.crosses, a.flags), (b.toi, b.kind, b.crosses, b.flags));
            prop_assert_eq!(a.side, -b.side);
            prop_assert_eq!(a.second.is_some(), b.second.is_some());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn oracle_agrees_with_the_definition_on_uniform(query in uniform(EdgeEdge)) {
        check_against_the_definition(&query)?;
    }

    #[test]
    fn oracle_agrees_with_the_definition_on_uniform_faces(query in uniform(VertexFace)) {
        check_against_the_definition(&query)?;
    }

    #[test]
    fn oracle_agrees_with_the_definition_on_thick_uniform(query in thick(uniform(EdgeEdge))) {
        check_against_the_definition(&query)?;
    }
}

#[test]
fn lines_meet_at_the_contact_or_beyond_what_does_not_touch() {
    let (mut touching, mut beyond) = (0, 0);
    for family in ["uniform", "lattice", "face_uniform", "face_lattice"] {
        let family = generate::by_name(family).unwrap();
        for index in 0..200 {
            let query = family.query(7, index);
            for step in decide::<BigInt>(&query).steps() {
                let Some([u, v]) = step.meeting else {
                    continue;
                };
                match step.contact {
                    Some((
                        Parameters {
                            u: first,
                            v: second,
                        },
                        None,
                    )) => {
                        let is_near = |at: Enclosure, value: f64| (value - at.below).abs() < 1e-12;
                        assert!(is_near(first, u) && is_near(second, v), "{query:?} {u} {v}");
                        touching += 1;
                    }
                    Some((_, Some(_))) => panic!("lines that meet in a point overlap: {query:?}"),
                    None => {
                        let most = match query {
                            Query::EdgeEdge(_) => u.max(v),
                            Query::VertexFace(_) => u + v,
                        };
                        assert!(u.min(v) < 0.0 || most > 1.0, "{query:?} {u} {v}");
                        beyond += 1;
                    }
                }
            }
        }
    }
    assert!(touching > 100 && beyond > 100, "{touching} {beyond}");
}

/// The times of the steps with their events, and whether the edges touch then.
fn steps(points: Corners, radius: f64) -> Vec<(Enclosure, Event, bool)> {
    let steps = decide::<BigInt>(&query(EdgeEdge, points, radius)).steps();
    let said = |step: Step<BigInt>| (step.time.enclosure(), step.event, step.contact.is_some());
    steps.into_iter().map(said).collect()
}

#[test]
fn steps_are_the_times_at_which_contact_could_begin() {
    let falling = |from: f64, to: f64| {
        let at = |z| [[-3., 0., 0.], [3., 0., 0.], [0., -3., z], [0., 3., z]];
        let ([a, b, c, d], [e, f, g, h]) = (at(from), at(to));
        [a, b, c, d, e, f, g, h]
    };
    let [start, quarter, half, most] = [0.0, 0.25, 0.5, 0.75].map(exactly);
    assert_eq!(
        steps(falling(1., -1.), 0.0),
        [(half, Event::Coplanar, true)]
    );
    let away = [
        (quarter, Event::AtRadius, true),
        (most, Event::AtRadius, true),
    ];
    assert_eq!(steps(falling(2., -2.), 1.0), away);
    let within = [(start, Event::Start, true), (half, Event::AtRadius, true)];
    assert_eq!(steps(falling(0., 2.), 1.0), within);
    // C goes down through AB in their plane, and D stays above.
    let planar = [
        [0., 0., 0.],
        [4., 0., 0.],
        [1., 1., 0.],
        [1., 3., 0.],
        [0., 0., 0.],
        [4., 0., 0.],
        [1., -1., 0.],
        [1., 1., 0.],
    ];
    let planar_steps = [
        (start, Event::Start, false),
        (half, Event::EndOnLine(2), true),
    ];
    assert_eq!(steps(planar, 0.0), planar_steps);
    let vanishing = |points| {
        let vanishing = decide::<BigInt>(&query(EdgeEdge, points, 0.0)).vanishing();
        let named = vanishing.into_iter().filter(|(_, is_zero)| *is_zero);
        named.map(|(name, _)| name).collect::<Vec<_>>()
    };
    assert_eq!(vanishing(planar), ["f"]);
    assert!(vanishing(falling(1., -1.)).is_empty());
}
