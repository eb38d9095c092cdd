//! What does not depend on names, handedness or units: the answers of oracle, shadow and certified
//! path to a query and to the same query seen otherwise.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use proptest::prelude::*;
use tunnelproof::contact::{Case, ContactKind};
use tunnelproof::query::{EdgeEdge, Point, Query};
use tunnelproof_reference::generate::FAMILIES;
use tunnelproof_reference::oracle::Oracle;
use tunnelproof_reference::shadow::Shadow;
use tunnelproof_reference::subject::{Answer, Certified, Subject};

static SUBJECTS: [&dyn Subject; 3] = [&Oracle, &Shadow::REPAIRED, &Certified];

/// What an answer says, as far as a symmetry keeps it.
#[derive(Clone, Debug, PartialEq)]
struct Seen {
    toi: [f64; 2],
    kind: ContactKind,
    /// Whether the step crosses, of the subjects that say so.
    crosses: Option<bool>,
    side: i8,
    /// `None` where it depends on the names of the ends.
    case: Option<Case>,
    /// Places on both edges in no order; of the exact subjects only, whose numbers have no error.
    places: Vec<[[u64; 2]; 2]>,
}

fn seen(subject: &dyn Subject, query: EdgeEdge) -> Option<Seen> {
    match subject.answer(&Query::EdgeEdge(query)).unwrap() {
        Answer::Exact(answer) => answer.hit.map(|hit| {
            let places = [Some(hit.first), hit.second].into_iter().flatten();
            let bits = |x: tunnelproof_reference::answer::Enclosure| {
                // -0 and 0 are the same place.
                [x.below + 0.0, x.above + 0.0].map(f64::to_bits)
            };
            Seen {
                toi: [hit.toi.below, hit.toi.above],
                kind: hit.kind,
                crosses: Some(hit.crosses),
                side: hit.side,
                case: Some(answer.case),
                places: places.map(|place| [bits(place.u), bits(place.v)]).collect(),
            }
        }),
        Answer::Certified(None) => None,
        Answer::Certified(Some(hit)) => Some(Seen {
            toi: [hit.toi, hit.toi_above],
            kind: hit.kind,
            crosses: None,
            side: hit.side,
            case: Some(hit.case),
            places: Vec::new(),
        }),
        answer => panic!("not of an exact subject: {answer:?}"),
    }
}

fn query() -> impl Strategy<Value = EdgeEdge> {
    (0..FAMILIES.len(), any::<u64>(), 0..1_000_000u64)
        .prop_filter_map("edge-edge", |(family, seed, index)| {
            FAMILIES[family].query(seed, index).as_edge_edge().copied()
        })
}

fn of_points(query: &EdgeEdge, change: impl Fn(&[Point; 4]) -> [Point; 4]) -> EdgeEdge {
    EdgeEdge::new(change(query.start()), change(query.end()), 0.0).unwrap()
}

fn of_coordinates(query: &EdgeEdge, change: impl Fn([f64; 3]) -> [f64; 3]) -> EdgeEdge {
    of_points(query, |points| {
        points.map(|p| Point::from(change([p.x, p.y, p.z])))
    })
}

fn mirrored(seen: Seen) -> Seen {
    Seen {
        side: -seen.side,
        ..seen
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn symmetry_edges_exchanged(query in query()) {
        let exchanged = of_points(&query, |&[a, b, c, d]| [c, d, a, b]);
        for subject in SUBJECTS {
            let sorted = |mut seen: Seen| {
                seen.places.sort();
                seen
            };
            let swapped = |seen: Seen| Seen {
                places: seen.places.iter().map(|&[u, v]| [v, u]).collect(),
                ..seen
            };
            let expected = seen(subject, query).map(sorted);
            let found = seen(subject, exchanged).map(swapped).map(sorted);
            prop_assert_eq!(found, expected, "{}", subject.name());
        }
    }

    #[test]
    fn symmetry_edge_reversed(query in query(), which in any::<bool>()) {
        let reversed = of_points(&query, |&[a, b, c, d]| {
            if which { [b, a, c, d] } else { [a, b, d, c] }
        });
        for subject in SUBJECTS {
            let rest = |seen: Seen| Seen { case: None, places: Vec::new(), ..seen };
            let expected = seen(subject, query).map(rest).map(mirrored);
            let found = seen(subject, reversed).map(rest);
            prop_assert_eq!(found, expected, "{}", subject.name());
        }
    }

    #[test]
    fn symmetry_mirrored(query in query(), axis in 0..3usize) {
        let reflected = of_coordinates(&query, |mut p| {
            p[axis] = -p[axis];
            p
        });
        for subject in SUBJECTS {
            let expected = seen(subject, query).map(mirrored);
            prop_assert_eq!(seen(subject, reflected), expected, "{}", subject.name());
        }
    }

    #[test]
    fn symmetry_axes_permuted(query in query()) {
        let turned = of_coordinates(&query, |[x, y, z]| [y, z, x]);
        let exchanged = of_coordinates(&query, |[x, y, z]| [y, x, z]);
        for subject in SUBJECTS {
            let expected = seen(subject, query);
            prop_assert_eq!(&seen(subject, turned), &expected, "{}", subject.name());
            prop_assert_eq!(seen(subject, exchanged), expected.map(mirrored), "{}", subject.name());
        }
    }

    #[test]
    fn symmetry_time_reversed_hits_or_misses(query in query()) {
        let reversed = EdgeEdge::new(*query.end(), *query.start(), 0.0).unwrap();
        for subject in SUBJECTS {
            let (is_hit, was_hit) = (seen(subject, reversed).is_some(), seen(subject, query).is_some());
            prop_assert_eq!(is_hit, was_hit, "{}", subject.name());
        }
    }

    #[test]
    fn symmetry_scaled_by_a_power_of_two(query in query(), exponent in -40..40) {
        let factor = f64::from(exponent).exp2();
        // Without what over- or underflows.
        let coordinates = query.start().iter().chain(query.end()).flat_map(|p| p.iter().copied());
        let is_exact = |x: f64| (x * factor).is_finite() && x * factor / factor == x;
        prop_assume!(coordinates.into_iter().all(is_exact));
        let scaled = of_coordinates(&query, |p| p.map(|x| x * factor));
        for subject in SUBJECTS {
            prop_assert_eq!(seen(subject, scaled), seen(subject, query), "{}", subject.name());
        }
    }
}
