//! Bodies that turn: the certified path gives the oracle's answer on every family.

use tunnelproof::certified::{decide_rigid, decide_rigid_exactly};
use tunnelproof::contact::{Case, ContactKind, EdgePlace, Hit, Place};
use tunnelproof::nalgebra::Quaternion;
use tunnelproof::query::QueryKind;
use tunnelproof::rigid::{EdgeTurningEdge, Pose, RigidMotion, RigidQuery, Side};
use tunnelproof::{EdgeEdge, Point, VertexFace, classify, decide};
use tunnelproof_reference::answer::ExactAnswer;
use tunnelproof_reference::certify::verdict::{Verdict, judge};
use tunnelproof_reference::generate::{RigidFamily, all_rigid, rigid_by_name};
use tunnelproof_reference::oracle::decide_rigid_query;
use tunnelproof_reference::subject::Answer;

/// How many queries of each family are judged; `TUNNELPROOF_RIGID_COUNT` asks for more.
fn count() -> u64 {
    let asked = std::env::var("TUNNELPROOF_RIGID_COUNT").ok();
    let usual = if cfg!(debug_assertions) { 60 } else { 900 };
    asked.map_or(usual, |text| text.parse().expect("a number"))
}

const SEED: u64 = 2032;

/// The families to judge; `TUNNELPROOF_RIGID_FAMILIES` names those whose names contain it.
fn families() -> impl Iterator<Item = &'static RigidFamily> {
    let asked = std::env::var("TUNNELPROOF_RIGID_FAMILIES").unwrap_or_default();
    all_rigid().filter(move |family| family.name().contains(&asked))
}

/// The seed of the comparison; `TUNNELPROOF_RIGID_SEED` sets another one.
fn seed() -> u64 {
    let asked = std::env::var("TUNNELPROOF_RIGID_SEED").ok();
    asked.map_or(SEED, |text| text.parse().expect("a number"))
}

fn answer(query: &RigidQuery, in_integers: bool) -> Option<Hit<Place>> {
    match in_integers {
        true => decide_rigid_exactly(query),
        false => decide_rigid(query),
    }
}

/// Whether an answer is the oracle's, to the last bit of the time.
fn is_right(hit: Option<&Hit<Place>>, truth: &ExactAnswer) -> bool {
    let judgement = judge(truth, Some(&Answer::Certified(hit.copied())), || false);
    judgement.verdict == Verdict::Right && !judgement.differs
}

/// The first wrong answer of a part of a family, and the number of hits.
fn judge_part(family: &str, indices: impl Iterator<Item = u64>) -> (Option<u64>, u64) {
    let family = rigid_by_name(family).expect("a family");
    let (mut hits, seed) = (0, seed());
    for index in indices {
        let query = family.query(seed, index);
        let truth = decide_rigid_query(&query);
        hits += u64::from(truth.hit.is_some());
        let is_wrong = |in_integers| !is_right(answer(&query, in_integers).as_ref(), &truth);
        if is_wrong(false) || is_wrong(true) {
            return (Some(index), hits);
        }
    }
    (None, hits)
}

#[test]
fn rigid_certified_is_the_oracle_on_every_family() {
    let (count, threads) = (count(), 2);
    for family in families() {
        let name = family.name();
        let found: Vec<_> = std::thread::scope(|scope| {
            let part = |own: u64| move || judge_part(name, (own..count).step_by(threads as usize));
            let handles: Vec<_> = (0..threads).map(|own| scope.spawn(part(own))).collect();
            let join = |handle: std::thread::ScopedJoinHandle<_>| handle.join().expect("no panic");
            handles.into_iter().map(join).collect()
        });
        let hits: u64 = found.iter().map(|(_, hits)| hits).sum();
        println!("{name}: {count} queries, {hits} hits");
        if let Some(index) = found.iter().find_map(|(wrong, _)| *wrong) {
            let (query, seed) = (family.query(seed(), index), seed());
            panic!(
                "{name}:{seed}:{index}: {query:?}\n{:?}\n{:?}\n{:?}",
                answer(&query, false),
                answer(&query, true),
                decide_rigid_query(&query)
            );
        }
    }
}

/// The answer of the linear query of the same points, and its case.
fn linear(query: &RigidQuery) -> (Option<Hit<Place>>, Case) {
    let (start, end, radius) = (query.positions(0.0), query.positions(1.0), query.radius());
    match query.kind().linear() {
        QueryKind::EdgeEdge => {
            let query = EdgeEdge::new(start, end, radius).expect("finite");
            let hit = decide(&query).map(|hit| hit.map_place(Place::from));
            (hit, classify(&query))
        }
        QueryKind::VertexFace => {
            let query = VertexFace::new(start, end, radius).expect("finite");
            let hit = decide(&query).map(|hit| hit.map_place(Place::from));
            (hit, classify(&query))
        }
    }
}

#[test]
fn rigid_translation_is_the_linear_query_bit_for_bit() {
    for name in ["turning_translation", "turning_thick_still"] {
        let family = rigid_by_name(name).expect("a family");
        let mut hits = 0;
        for index in 0..3000 {
            let query = family.query(SEED, index);
            let own = answer(&query, false);
            let (linear, case) = linear(&query);
            assert_eq!(
                own.as_ref().map(bits),
                linear.as_ref().map(bits),
                "{query:?}"
            );
            assert_eq!(case, decide_rigid_query(&query).case);
            hits += usize::from(own.is_some());
        }
        assert!(hits > 60, "{name}: {hits}");
    }
}

/// What a hit says but for its place, bit for bit.
fn bits(hit: &Hit<Place>) -> impl PartialEq + std::fmt::Debug {
    let toi = [hit.toi.to_bits(), hit.toi_above.to_bits()];
    (toi, hit.kind, hit.side, hit.case, hit.flags)
}

/// A body that does not turn, in numbers that are exact, moves its points on lines.
#[test]
fn rigid_body_without_a_turn_is_as_points_that_move_on_lines() {
    for name in ["turning_bodies_still", "turning_bodies_thick_still"] {
        let family = rigid_by_name(name).expect("a family");
        let mut hits = 0;
        for index in 0..2000 {
            let query = family.query(SEED, index);
            let [first, second] = query.sides();
            let count = first.number_of_points();
            let [start, end] = [0.0, 1.0].map(|t| query.positions(t));
            let straight = Side::Straight {
                start: &start[..count],
                end: &end[..count],
            };
            let other = RigidQuery::new([straight, second], query.radius()).expect("finite");
            let (own, other) = (answer(&query, false), answer(&other, false));
            assert_eq!(
                own.as_ref().map(bits),
                other.as_ref().map(bits),
                "{query:?}"
            );
            hits += usize::from(own.is_some());
        }
        assert!(hits > 100, "{name}: {hits}");
    }
}

/// Two edges in the other order, and both bodies turned and moved alike: the same times.
#[test]
fn rigid_bodies_meet_at_the_same_time_in_either_order() {
    for name in ["turning_bodies_uniform", "turning_bodies_thick_uniform"] {
        let family = rigid_by_name(name).expect("a family");
        let mut hits = 0;
        for index in 0..1000 {
            let query = family.query(SEED, index);
            if query.kind().linear() == QueryKind::VertexFace {
                continue;
            }
            let [first, second] = query.sides();
            let other = RigidQuery::new([second, first], query.radius()).expect("finite");
            let (own, other) = (answer(&query, false), answer(&other, false));
            let times = |hit: &Hit<Place>| ([hit.toi, hit.toi_above], hit.kind);
            assert_eq!(own.as_ref().map(times), other.as_ref().map(times));
            hits += usize::from(own.is_some());
        }
        assert!(hits > 50, "{name}: {hits}");
    }
}

/// A wrong time, kind, side or place is seen.
#[test]
fn rigid_comparison_sees_planted_faults() {
    let family = rigid_by_name("turning_uniform").expect("a family");
    let mut seen = 0;
    for index in 0..200 {
        let query = family.query(SEED, index);
        let truth = decide_rigid_query(&query);
        let Some(hit) = answer(&query, false) else {
            continue;
        };
        assert!(is_right(Some(&hit), &truth));
        assert!(!is_right(None, &truth));
        let mut late = hit;
        late.toi = late.toi.next_up();
        assert!(!is_right(Some(&late), &truth));
        let mut other = hit;
        other.side = -other.side;
        assert!(!is_right(Some(&other), &truth));
        let mut aside = hit;
        match &mut aside.place {
            Place::Edges(place) => place.first.u += 1e-9,
            Place::Face(place) => place.weights[1] += 1e-9,
        }
        assert!(!is_right(Some(&aside), &truth));
        seen += 1;
    }
    assert!(seen > 50, "{seen}");
}

/// The point of a hit, seen from both sides.
#[test]
fn rigid_positions_meet_at_the_contact() {
    let family = rigid_by_name("turning_uniform").expect("a family");
    for index in 0..200 {
        let query = family.query(SEED, index);
        let Some(hit) = answer(&query, false) else {
            continue;
        };
        let points = query.positions(hit.toi).map(|p: Point| p.coords);
        let [a, b, c, d] = points;
        let way = match hit.place {
            Place::Edges(place) => {
                let [wa, wb, wc, wd] = place.first.weights();
                a * wa + b * wb - c * wc - d * wd
            }
            Place::Face(place) => {
                let [wb, wc, wd] = place.weights;
                a - b * wb - c * wc - d * wd
            }
        };
        assert!(way.norm() < 1e-12, "{way}");
    }
}

/// A rod that turns about its middle, and a wire across its plane: scaled by powers of two, down to
/// where squares underflow, they have the same answers.
#[test]
fn rigid_answers_are_the_same_at_every_scale() {
    let pose = |z: f64| Pose::new(Point::origin(), Quaternion::new(1.0, 0.0, 0.0, z));
    let motion = RigidMotion::new(pose(0.0), pose(0.875)).expect("82 degrees");
    let at_size = |x: f64, y: f64, size: f64| {
        let point = |x: f64, y: f64, z: f64| Point::new(x * size, y * size, z * size);
        let wire = [point(x, y, -1.0), point(x, y, 1.0)];
        let rod = [point(-1.0, 0.0, 0.0), point(1.0, 0.0, 0.0)];
        EdgeTurningEdge::new(wire, wire, rod, motion).expect("finite")
    };
    let mut hits = 0;
    for exponent in [-1000, -900, -600, -565, -520, -400, 0, 150, 400, 1000] {
        for (x, y) in (0..12).flat_map(|x| (0..12).map(move |y| (x, y))) {
            let [x, y] = [x, y].map(|x: i32| f64::from(x) / 8.0);
            let truth = decide_rigid_exactly(&at_size(x, y, 1.0));
            let query = at_size(x, y, 2f64.powi(exponent));
            assert_eq!(decide_rigid_exactly(&query), truth, "{exponent} {x} {y}");
            let hit = decide_rigid(&query);
            let rest = |hit: Hit<EdgePlace>| hit.map_place(|_| ());
            assert_eq!(hit.map(rest), truth.map(rest), "{exponent} {x} {y}");
            if let (Some(hit), Some(truth)) = (hit, truth) {
                let (place, other) = (hit.place, truth.place);
                let off = f64::max(
                    (place.first.u - other.first.u).abs(),
                    (place.first.v - other.first.v).abs(),
                );
                assert!(off <= place.error + other.error, "{exponent} {x} {y}");
                assert!(place.error <= 2f64.powi(-50));
                hits += 1;
            }
        }
    }
    assert!(hits > 300, "{hits}");
}

/// A rod that turns in the plane of a wire, with its end on the wire for an instant or through it: where the
/// end only touches, nothing changes sides.
#[test]
fn rigid_end_that_touches_a_wire_in_its_plane_does_not_cross_it() {
    let pose = |z: f64| Pose::new(Point::origin(), Quaternion::new(1.0, 0.0, 0.0, z));
    let motion = RigidMotion::new(pose(-0.375), pose(0.375)).expect("82 degrees");
    let rod = [Point::new(0.0, 0.5, 0.0), Point::new(0.0, 1.0, 0.0)];
    for (height, kind) in [(1.0, ContactKind::Graze), (0.9375, ContactKind::Crossing)] {
        let wire = [-1.0, 1.0].map(|x| Point::new(x, height, 0.0));
        let query = EdgeTurningEdge::new(wire, wire, rod, motion).expect("finite");
        let query = RigidQuery::from(query);
        let truth = decide_rigid_query(&query);
        for in_integers in [false, true] {
            let hit = answer(&query, in_integers).expect("a contact");
            assert!(is_right(Some(&hit), &truth), "{height} {in_integers}");
            assert_eq!(hit.kind, kind, "{height} {in_integers}");
            assert_eq!(hit.toi == 0.5, kind == ContactKind::Graze);
        }
    }
}
