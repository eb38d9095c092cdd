use tunnelproof::query::QueryKind;

use super::*;
use crate::generate::by_name;
use crate::oracle::decide_query;

const COUNT: u64 = 4000;

/// The numbers of a query: coordinates, translations and radii.
fn numbers(query: &Query) -> Vec<f64> {
    let points = query.start().iter().chain(query.end());
    let coordinates = points.flat_map(|point| <[f64; 3]>::from(*point));
    let steps = (0..4).flat_map(|i| <[f64; 3]>::from(query.end()[i] - query.start()[i]));
    let radii = query.radius().parts();
    coordinates.chain(steps).chain(radii).collect()
}

#[test]
fn cast_numbers_are_exact_in_single_precision() {
    for family in CAST_FAMILIES {
        for index in 0..COUNT {
            let query = family.query(1, index);
            for number in numbers(&query) {
                let id = || format!("{}:1:{index}: {number}", family.name());
                assert_eq!(f64::from(number as f32), number, "{}", id());
            }
            let [first, second] = query.radius().parts();
            let both = first + second;
            assert_eq!(f64::from(both as f32), both, "{}:1:{index}", family.name());
        }
    }
}

#[test]
fn cast_bodies_are_translated_as_a_whole() {
    for family in CAST_FAMILIES {
        for index in 0..COUNT {
            let query = family.query(1, index);
            let bodies = match query.kind() {
                QueryKind::EdgeEdge => [0, 0, 1, 1],
                QueryKind::VertexFace => [0, 1, 1, 1],
            };
            let steps = [0, 1, 2, 3].map(|i| query.end()[i] - query.start()[i]);
            for (i, body) in bodies.iter().enumerate() {
                let first = bodies.iter().position(|other| other == body).unwrap();
                assert_eq!(steps[i], steps[first], "{}:1:{index}", family.name());
            }
        }
    }
}

#[test]
fn cast_capsules_have_two_radii_and_segments_none() {
    for family in CAST_FAMILIES {
        for index in 0..COUNT {
            let [first, second] = family.query(1, index).radius().parts();
            let is_right = match family.name() {
                name if name.starts_with("cast_thin") => first == 0.0 && second == 0.0,
                name if name.starts_with("cast_face") => first > 0.0 && second == 0.0,
                _ => first > 0.0 && second > 0.0,
            };
            assert!(is_right, "{}:1:{index}: {first}, {second}", family.name());
        }
    }
}

#[test]
fn cast_families_have_hits_and_misses() {
    let mut shares = Vec::new();
    for family in CAST_FAMILIES {
        let is_hit = |index: &u64| decide_query(&family.query(1, *index)).hit.is_some();
        let share = (0..COUNT).filter(is_hit).count() as f64 / COUNT as f64;
        shares.push((family.name(), share));
    }
    for (name, share) in &shares {
        let most = if name.ends_with("start") { 0.98 } else { 0.9 };
        assert!((0.08..most).contains(share), "{name} in {shares:?}");
    }
}

#[test]
fn cast_bodies_in_contact_at_the_start_are_hit_there() {
    for name in ["cast_start", "cast_face_start"] {
        let family = by_name(name).unwrap();
        let [mut at_start, mut touching] = [0, 0];
        for index in 0..COUNT {
            let query = family.query(1, index);
            let answer = decide_query(&query);
            let is_at_start = answer.hit.is_some_and(|hit| hit.toi.above == 0.0);
            at_start += u64::from(is_at_start);
            // With radii less by an ulp there is none.
            let less = query
                .radius()
                .parts()
                .map(f64::next_down)
                .map(|r| r.max(0.0));
            let less = Query::new(query.kind(), *query.start(), *query.start(), less).unwrap();
            touching += u64::from(is_at_start && decide_query(&less).hit.is_none());
        }
        println!("{name}: {at_start} at the start, {touching} just so");
        assert!(at_start > COUNT * 3 / 4, "{name}: {at_start}");
        assert!(touching > COUNT / 8, "{name}: {touching}");
    }
}
