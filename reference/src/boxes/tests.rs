use num_rational::BigRational;
use num_traits::{One, Zero};
use tunnelproof::query::Point;

use super::body::number;
use super::*;
use crate::answer::Enclosure;

/// How many casts of each family; `TUNNELPROOF_BOX_COUNT` sets another number.
fn count() -> u64 {
    let asked = std::env::var("TUNNELPROOF_BOX_COUNT").ok();
    let usual = if cfg!(debug_assertions) { 15 } else { 60 };
    asked.and_then(|text| text.parse().ok()).unwrap_or(usual)
}

fn casts() -> impl Iterator<Item = (BoxId, BoxCast)> {
    let families = BOX_FAMILIES.iter();
    families.flat_map(|family| {
        (0..count()).map(move |index| {
            let id = BoxId {
                family,
                seed: 1,
                index,
            };
            (id, id.cast())
        })
    })
}

/// Whether a rational number is what is enclosed, as tightly as can be.
fn is_enclosed(toi: Enclosure, exact: &BigRational) -> bool {
    let [below, above] = [toi.below, toi.above].map(number);
    match toi.is_exact() {
        true => *exact == below,
        false => *exact > below && *exact < above && toi.above == toi.below.next_up(),
    }
}

/// What the nearest point says is wrong with a time of impact, or with a miss.
fn nearest_objection(cast: &BoxCast, toi: Option<Enclosure>) -> Option<&'static str> {
    let within = |until: f64| comes_within(cast, 0.0, &number(until));
    match toi {
        None => within(1.0).then_some("there is contact in a miss"),
        Some(toi) if !within(toi.above) => Some("there is no contact yet"),
        Some(toi) if toi.above == 0.0 => None,
        Some(toi) => {
            let before = if toi.is_exact() {
                toi.below.next_down()
            } else {
                toi.below
            };
            within(before).then_some("there is contact before")
        }
    }
}

/// What the times without a separating plane say is wrong, of bodies without radius.
fn span_objection(cast: &BoxCast, toi: Option<Enclosure>) -> Option<&'static str> {
    match (span(cast), toi) {
        (None, None) => None,
        (Some(span), Some(toi)) => {
            (!is_enclosed(toi, &span.from)).then_some("another time of impact")
        }
        _ => Some("another verdict"),
    }
}

fn has_radius(cast: &BoxCast) -> bool {
    cast.bodies().iter().any(|body| body.radius() > 0.0)
}

#[test]
fn box_casts_are_decided_alike_by_pairs_spans_and_nearest_points() {
    let mut compared = [0; 2];
    for (id, cast) in casts() {
        let toi = decide_pairs(&cast);
        assert_eq!(nearest_objection(&cast, toi), None, "{id}: {toi:?}");
        compared[0] += 1;
        if !has_radius(&cast) {
            assert_eq!(span_objection(&cast, toi), None, "{id}: {toi:?}");
            compared[1] += 1;
        }
    }
    println!("{compared:?} compared with nearest points and spans");
    assert!(compared[1] * 2 > compared[0]);
}

/// Times off by an ulp, verdicts reversed, and pairs left out are seen.
#[test]
fn box_casts_with_planted_faults_are_seen() {
    let [mut late, mut early, mut reversed] = [0; 3];
    for (id, cast) in casts() {
        let toi = decide_pairs(&cast);
        let wrong = |toi| {
            nearest_objection(&cast, toi).is_some()
                && (has_radius(&cast) || span_objection(&cast, toi).is_some())
        };
        let verdict = match toi {
            Some(_) => None,
            None => Some(Enclosure::exactly(0.5)),
        };
        assert!(wrong(verdict), "{id}: the other verdict");
        reversed += 1;
        let Some(toi) = toi.filter(|toi| toi.below > 0.0 && toi.above < 1.0) else {
            continue;
        };
        let moved = |by: fn(f64) -> f64| {
            Some(Enclosure {
                below: by(toi.below),
                above: by(toi.above),
            })
        };
        assert!(wrong(moved(f64::next_up)), "{id}: an ulp late");
        assert!(wrong(moved(f64::next_down)), "{id}: an ulp early");
        late += 1;
        early += 1;
    }
    assert!(reversed > 0 && late > count() && early > count());
}

/// Every sort of pair is the earliest at some time: none is there in vain, and one that is forgotten
/// changes answers.
#[test]
fn box_casts_need_every_kind_of_pair() {
    let mut needed = std::collections::BTreeSet::new();
    let family = box_family("cast_box_turned_uniform").unwrap();
    for cast in (0..200).map(|index| family.cast(1, index)) {
        let Some(toi) = decide_pairs(&cast).filter(|toi| toi.above > 0.0) else {
            continue;
        };
        let all = pairs(&cast);
        // Of 12 by 12 edges, then of 8 vertices of the first body by 12 triangles, then the others.
        for (kind, range) in [(0, 0..144), (1, 144..240), (2, 240..336)] {
            let hits = all[range].iter();
            let hits = hits.filter_map(|query| crate::oracle::decide_query(query).hit);
            if hits.map(|hit| hit.toi).all(|own| own.below > toi.below) {
                continue;
            }
            needed.insert(kind);
        }
        assert_eq!(all.len(), 336);
    }
    assert_eq!(needed.len(), 3);
}

#[test]
fn box_numbers_are_exact_in_single_precision() {
    let is_single = |number: f64| f64::from(number as f32) == number;
    for (id, cast) in casts() {
        for body in cast.bodies() {
            let corners = body.corners();
            let ends = corners.iter().map(|corner| corner + body.step());
            let points = corners.iter().copied().chain(ends);
            assert!(
                points
                    .flat_map(<[f64; 3]>::from)
                    .chain(<[f64; 3]>::from(body.step()))
                    .all(is_single),
                "{id}"
            );
            assert!(is_single(body.radius()), "{id}");
            if body.shape() == Shape::Box {
                let [origin, beside @ ..] = body.points();
                let halves = beside.map(|point| (point - origin) / 2.0);
                let middle = origin + halves[0] + halves[1] + halves[2];
                let numbers = halves
                    .iter()
                    .flat_map(|half| half.iter())
                    .chain(middle.iter());
                assert!(numbers.copied().all(is_single), "{id}: {halves:?} {middle}");
                let is_straight = halves
                    .iter()
                    .all(|half| half.iter().filter(|x| **x != 0.0).count() == 1);
                let turned = id.family.name().contains("turned");
                assert!(turned || is_straight, "{id}");
            }
        }
    }
}

#[test]
fn box_families_have_hits_and_misses() {
    for family in BOX_FAMILIES {
        let truths = (0..count().max(60)).map(|index| decide(&family.cast(1, index)));
        let truths: Vec<_> = truths.collect();
        let hits = truths.iter().filter(|truth| truth.toi.is_some()).count();
        let overlaps = truths.iter().filter(|truth| truth.overlaps).count();
        let at_start = truths.iter().filter_map(|truth| truth.toi);
        let at_start = at_start.filter(|toi| toi.above == 0.0).count();
        println!(
            "{}: {hits} hits, {overlaps} pass, {at_start} at the start",
            family.name()
        );
        let share = hits as f64 / truths.len() as f64;
        let most = if family.name().ends_with("start") {
            1.0
        } else {
            0.95
        };
        assert!(share > 0.05 && share < most, "{}: {share}", family.name());
    }
}

fn cuboid(corner: [f64; 3], size: f64, step: [f64; 3]) -> Body {
    let corner = Point::from(corner);
    let beside = [[size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, size]];
    let points = [
        corner,
        corner + nalgebra::Vector3::from(beside[0]),
        corner + nalgebra::Vector3::from(beside[1]),
        corner + nalgebra::Vector3::from(beside[2]),
    ];
    Body::new(Shape::Box, &points, step.into(), 0.0).unwrap()
}

fn toi(bodies: [Body; 2]) -> Option<f64> {
    let cast = BoxCast::new(bodies).unwrap();
    let toi = decide_pairs(&cast);
    assert_eq!(nearest_objection(&cast, toi), None);
    toi.map(|toi| toi.below)
}

#[test]
fn box_in_a_box_is_in_contact_at_the_start() {
    let large = cuboid([0.0; 3], 4.0, [0.0; 3]);
    let small = cuboid([1.0; 3], 1.0, [10.0, 0.0, 0.0]);
    assert_eq!(toi([large, small]), Some(0.0));
    assert_eq!(toi([small, large]), Some(0.0));
    let sphere = Body::new(
        Shape::Sphere,
        &[Point::new(2.0, 2.0, 2.0)],
        [0.0; 3].into(),
        0.5,
    );
    assert_eq!(toi([large, sphere.unwrap()]), Some(0.0));
}

#[test]
fn box_meets_what_is_known() {
    let still = cuboid([0.0; 3], 1.0, [0.0; 3]);
    assert_eq!(
        toi([still, cuboid([3.0, 0.0, 0.0], 1.0, [-4.0, 0.0, 0.0])]),
        Some(0.5)
    );
    assert_eq!(
        toi([still, cuboid([3.0, 1.0, 1.0], 1.0, [-4.0, 0.0, 0.0])]),
        Some(0.5)
    );
    assert_eq!(
        toi([still, cuboid([3.0, 1.5, 1.0], 1.0, [-4.0, 0.0, 0.0])]),
        None
    );
    // A sphere that comes to the corner along a diagonal, to the distance of 3 from it.
    let at = [Point::new(4.0, 5.0, 5.0)];
    let sphere = Body::new(Shape::Sphere, &at, [-4.0, -4.0, -4.0].into(), 3.0).unwrap();
    let cast = BoxCast::new([still, sphere]).unwrap();
    let exact = decide(&cast).toi.unwrap();
    // (3 - 4t)^2 + 2 (4 - 4t)^2 = 9: 48 t^2 - 88 t + 32 = 0.
    let expected = (88.0 - f64::sqrt(88.0 * 88.0 - 4.0 * 48.0 * 32.0)) / 96.0;
    assert!(
        (exact.below - expected).abs() < 1e-15,
        "{exact:?} {expected}"
    );
    assert_eq!(
        least_square(&cast, &BigRational::one()),
        BigRational::zero()
    );
}

#[test]
fn bodies_that_are_none_are_refused() {
    let points =
        |list: &[[f64; 3]]| -> Vec<Point> { list.iter().map(|p| Point::from(*p)).collect() };
    let new = |shape, list: &[[f64; 3]], radius| {
        Body::new(shape, &points(list), [0.0; 3].into(), radius).map(|_| ())
    };
    let corner = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(new(Shape::Box, &corner, 0.0), Ok(()));
    assert_eq!(new(Shape::Box, &corner, 0.5), Err(BodyError::Radius));
    assert_eq!(
        new(Shape::Sphere, &corner[..1], -1.0),
        Err(BodyError::Radius)
    );
    assert_eq!(
        new(Shape::Box, &corner[..3], 0.0),
        Err(BodyError::Count {
            expected: 4,
            found: 3
        })
    );
    let skew = [[0.0; 3], [1.0, 0.25, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    assert_eq!(new(Shape::Box, &skew, 0.0), Err(BodyError::Sides));
    let flat = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]];
    assert_eq!(new(Shape::Box, &flat, 0.0), Err(BodyError::Sides));
    let lost = [
        [1.0, 0.0, 0.0],
        [1e-20, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, 0.0, 1.0],
    ];
    assert_eq!(new(Shape::Box, &lost, 0.0), Err(BodyError::Corner));
    let infinite = [[f64::INFINITY, 0.0, 0.0]];
    assert_eq!(new(Shape::Sphere, &infinite, 0.0), Err(BodyError::Finite));
    let sphere = Body::new(Shape::Sphere, &points(&corner[..1]), [0.0; 3].into(), 1.0).unwrap();
    assert_eq!(BoxCast::new([sphere, sphere]), Err(BodyError::NoBox));
}
