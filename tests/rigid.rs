//! Bodies that turn: the certified path gives the oracle's answer on every family.

use tunnelproof::certified::{RigidKind, decide_rigid, decide_rigid_exactly};
use tunnelproof::contact::{Hit, Place};
use tunnelproof::rigid::RigidQuery;
use tunnelproof::{EdgeEdge, Point, VertexFace, classify, decide};
use tunnelproof_reference::answer::{Enclosure, ExactAnswer, Parameters};
use tunnelproof_reference::generate::{RIGID_FAMILIES, rigid_by_name};
use tunnelproof_reference::oracle::decide_rigid_query;

/// How many queries of each family are judged; `TUNNELPROOF_RIGID_COUNT` asks for more.
fn count() -> u64 {
    let asked = std::env::var("TUNNELPROOF_RIGID_COUNT").ok();
    let usual = if cfg!(debug_assertions) { 500 } else { 10_000 };
    asked.map_or(usual, |text| text.parse().expect("a number"))
}

const SEED: u64 = 2032;

fn answered<K: RigidKind>(query: &K, in_integers: bool) -> Option<Hit<Place>> {
    let hit = match in_integers {
        true => decide_rigid_exactly(query),
        false => decide_rigid(query),
    };
    hit.map(|hit| hit.map_place(Into::into))
}

fn answer(query: &RigidQuery, in_integers: bool) -> Option<Hit<Place>> {
    match query {
        RigidQuery::EdgeTurningEdge(query) => answered(query, in_integers),
        RigidQuery::VertexTurningFace(query) => answered(query, in_integers),
    }
}

fn is_near(value: f64, exact: Enclosure, error: f64) -> bool {
    exact.below - error <= value && value <= exact.above + error
}

/// What is wrong with a place.
fn is_place(place: &Place, first: &Parameters, second: Option<&Parameters>) -> bool {
    match place {
        Place::Edges(place) => {
            let is = |own: tunnelproof::EdgePoint, exact: &Parameters| {
                is_near(own.u, exact.u, place.error) && is_near(own.v, exact.v, place.error)
            };
            let has_second = match (place.second, second) {
                (Some(own), Some(exact)) => is(own, exact),
                (own, exact) => own.is_none() && exact.is_none(),
            };
            is(place.first, first) && has_second
        }
        Place::Face(place) => {
            let [b, c, d] = place.weights;
            let rest = Enclosure {
                below: 1.0 - first.u.above - first.v.above,
                above: 1.0 - first.u.below - first.v.below,
            };
            is_near(c, first.u, place.error)
                && is_near(d, first.v, place.error)
                && is_near(b, rest, place.error + f64::EPSILON)
        }
    }
}

/// Whether an answer is the oracle's, to the last bit of the time.
fn is_right(hit: Option<&Hit<Place>>, truth: &ExactAnswer) -> bool {
    match (hit, &truth.hit) {
        (None, None) => true,
        (Some(hit), Some(exact)) => {
            let toi = Enclosure {
                below: hit.toi,
                above: hit.toi_above,
            };
            toi == exact.toi
                && hit.kind == exact.kind
                && hit.side == exact.side
                && hit.case == truth.case
                && hit.flags == exact.flags
                && is_place(&hit.place, &exact.first, exact.second.as_ref())
        }
        _ => false,
    }
}

/// The first wrong answer of a part of a family, and the number of hits.
fn judge(family: &str, indices: impl Iterator<Item = u64>) -> (Option<u64>, u64) {
    let family = rigid_by_name(family).expect("a family");
    let mut hits = 0;
    for index in indices {
        let query = family.query(SEED, index);
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
    for family in RIGID_FAMILIES {
        let name = family.name();
        let found: Vec<_> = std::thread::scope(|scope| {
            let part = |own: u64| move || judge(name, (own..count).step_by(threads as usize));
            let handles: Vec<_> = (0..threads).map(|own| scope.spawn(part(own))).collect();
            let join = |handle: std::thread::ScopedJoinHandle<_>| handle.join().expect("no panic");
            handles.into_iter().map(join).collect()
        });
        let hits: u64 = found.iter().map(|(_, hits)| hits).sum();
        println!("{name}: {count} queries, {hits} hits");
        if let Some(index) = found.iter().find_map(|(wrong, _)| *wrong) {
            let query = family.query(SEED, index);
            panic!(
                "{name}:{SEED}:{index}: {query:?}\n{:?}\n{:?}\n{:?}",
                answer(&query, false),
                answer(&query, true),
                decide_rigid_query(&query)
            );
        }
    }
}

#[test]
fn rigid_translation_is_the_linear_query_bit_for_bit() {
    let family = rigid_by_name("turning_translation").expect("a family");
    let mut hits = 0;
    for index in 0..2000 {
        let query = family.query(SEED, index);
        let (start, end) = (query.positions(0.0), query.positions(1.0));
        let own = answer(&query, false);
        let (linear, case) = match query {
            RigidQuery::EdgeTurningEdge(_) => {
                let query = EdgeEdge::new(start, end, 0.0).expect("finite");
                let hit = decide(&query).map(|hit| hit.map_place(Place::from));
                (hit, classify(&query))
            }
            RigidQuery::VertexTurningFace(_) => {
                let query = VertexFace::new(start, end, 0.0).expect("finite");
                let hit = decide(&query).map(|hit| hit.map_place(Place::from));
                (hit, classify(&query))
            }
        };
        let bits = |hit: &Hit<Place>| {
            let toi = [hit.toi.to_bits(), hit.toi_above.to_bits()];
            (toi, hit.kind, hit.side, hit.case, hit.flags)
        };
        let lengths = query.motion().quaternions().map(|q| q.map(f64::abs));
        if lengths[0] == lengths[1] {
            assert_eq!(
                own.as_ref().map(bits),
                linear.as_ref().map(bits),
                "{query:?}"
            );
            assert_eq!(case, decide_rigid_query(&query).case);
            hits += usize::from(own.is_some());
        }
    }
    assert!(hits > 30, "{hits}");
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
