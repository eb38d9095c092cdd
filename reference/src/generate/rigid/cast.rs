//! Bodies that are cast and turn: capsules, segments, and a sphere against a triangle, of which both
//! bodies turn.
//!
//! As in the [casts without turns](crate::generate::CAST_FAMILIES), every number is one that an engine
//! in single precision holds: centres, points in the frames and radii are whole multiples of a power
//! of two, fewer than `2^23` of them, and quaternions have components in `f32`, so that their length is
//! 1 up to rounding.
//!
//! The motion is the one that `b3TimeOfImpact` of Box3D documents. Engines that turn at a constant
//! rate pass through the same orientations at slightly other times
//! ([`RigidMotion`](tunnelproof::rigid::RigidMotion) says by how much), and are judged with a margin.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::Query;
use tunnelproof::rigid::RigidQuery;

use super::RigidFamily;
use super::bodies::{Body, Draft};
use super::draft::{first_query, mean, turn_within};
use crate::distance::estimate_gap;
use crate::generate::motion::real_vector;

/// Every family of bodies that are cast and turn, in the order of tables.
pub const TURNING_CAST_FAMILIES: &[RigidFamily] = &[
    family(
        "cast_turning_uniform",
        "capsules cast and turned: general motion",
        |rng| general(rng, Pair::Capsules, METRES),
    ),
    family(
        "cast_turning_spin",
        "capsules cast and turned: a rod that turns fast about a centre at rest",
        |rng| spin(rng, Pair::Capsules),
    ),
    family(
        "cast_turning_grazing",
        "capsules cast and turned: past each other at the sum of the radii, nearly",
        |rng| grazing(rng, Pair::Capsules),
    ),
    family(
        "cast_turning_long_thin",
        "capsules cast and turned: tens of metres long against millimetres",
        long_thin,
    ),
    family(
        "cast_turning_far",
        "capsules cast and turned: of centimetres, hundreds of metres off the origin",
        |rng| general(rng, Pair::Capsules, FAR),
    ),
    family(
        "cast_turning_start",
        "capsules cast and turned: in contact at the start, by overlap or nearly just so",
        |rng| start(rng, Pair::Capsules),
    ),
    family(
        "cast_turning_thin_uniform",
        "segments cast and turned: general motion",
        |rng| general(rng, Pair::Segments, METRES),
    ),
    family(
        "cast_turning_thin_spin",
        "segments cast and turned: a rod that turns fast about a centre at rest",
        |rng| spin(rng, Pair::Segments),
    ),
    family(
        "cast_turning_face_uniform",
        "sphere and triangle cast and turned: general motion",
        |rng| general(rng, Pair::SphereFace, METRES),
    ),
    family(
        "cast_turning_face_spin",
        "sphere and triangle cast and turned: a blade that turns fast about a centre at rest",
        |rng| spin(rng, Pair::SphereFace),
    ),
    family(
        "cast_turning_face_grazing",
        "sphere and triangle cast and turned: past each other at the radius, nearly",
        |rng| grazing(rng, Pair::SphereFace),
    ),
    family(
        "cast_turning_face_start",
        "sphere and triangle cast and turned: in contact at the start, by overlap or nearly just so",
        |rng| start(rng, Pair::SphereFace),
    ),
];

const fn family(
    name: &'static str,
    description: &'static str,
    draw: fn(&mut dyn Rng) -> RigidQuery,
) -> RigidFamily {
    RigidFamily {
        name,
        description,
        draw,
    }
}

/// What is cast against what.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pair {
    Capsules,
    Segments,
    SphereFace,
}

/// How large things are, in metres.
#[derive(Clone, Copy)]
struct Scale {
    unit: f64,
    /// Coordinates of the first centre.
    place: f64,
    /// Those of points in the frame of a body, and how far the bodies are apart.
    size: f64,
    /// Translations.
    speed: f64,
    degrees: f64,
    radius: f64,
}

const METRES: Scale = Scale {
    unit: 1.0 / (1 << 20) as f64,
    place: 1.0,
    size: 0.5,
    speed: 1.0,
    degrees: 45.0,
    radius: 0.125,
};

const FAR: Scale = Scale {
    unit: 1.0 / (1 << 13) as f64,
    place: 512.0,
    size: 0.0625,
    speed: 0.0625,
    degrees: 45.0,
    radius: 0.015625,
};

fn to_multiple(value: f64, unit: f64) -> f64 {
    (value / unit).round() * unit
}

/// The query of the bodies with numbers that engines hold; `None` if one turns too far.
fn snapped(mut draft: Draft, radii: [f64; 2], unit: f64) -> Option<RigidQuery> {
    for body in [&mut draft.first, &mut draft.second] {
        let lengths = body.centres.iter_mut().chain(&mut body.local);
        lengths.for_each(|v| *v = v.map(|x| to_multiple(x, unit)));
        let components = body.quaternions.iter_mut().flatten();
        components.for_each(|x| *x = f64::from(*x as f32));
    }
    with_radii(&draft.query()?, radii, unit)
}

/// The query with these radii, each a multiple of the unit, and of a round body one at least.
fn with_radii(query: &RigidQuery, radii: [f64; 2], unit: f64) -> Option<RigidQuery> {
    let whole = |radius: f64| match radius > 0.0 {
        true => to_multiple(radius, unit).max(unit),
        false => 0.0,
    };
    RigidQuery::new(query.sides(), radii.map(whole)).ok()
}

impl Pair {
    /// How many points the bodies have.
    fn counts(self) -> [usize; 2] {
        match self {
            Pair::Capsules | Pair::Segments => [2, 2],
            Pair::SphereFace => [1, 3],
        }
    }

    /// Two radii, each up to this.
    fn radii(self, rng: &mut dyn Rng, most: f64) -> [f64; 2] {
        let [first, second] = [(); 2].map(|()| rng.random_range(0.0..most).max(f64::MIN_POSITIVE));
        match self {
            Pair::Capsules => [first, second],
            Pair::Segments => [0.0, 0.0],
            Pair::SphereFace => [first, 0.0],
        }
    }

    /// Two radii that are together this, or a unit each where it is not above 0.
    fn radii_together(self, rng: &mut dyn Rng, all: f64) -> [f64; 2] {
        let all = all.max(f64::MIN_POSITIVE);
        match self {
            Pair::Capsules => {
                let first = all * rng.random_range(0.125..0.875);
                [first, all - first]
            }
            Pair::Segments => [0.0, 0.0],
            Pair::SphereFace => [all, 0.0],
        }
    }
}

fn body(rng: &mut dyn Rng, count: usize, centre: Vector3<f64>, scale: Scale) -> Body {
    Body {
        quaternions: turn_within(rng, 0.0..scale.degrees),
        centres: [centre, centre + real_vector(rng, scale.speed)],
        local: (0..count).map(|_| real_vector(rng, scale.size)).collect(),
    }
}

/// Of 8 pairs of capsules, in 1 the first and in 1 the second is a sphere.
fn rounded(rng: &mut dyn Rng, pair: Pair, mut draft: Draft) -> Draft {
    if pair == Pair::Capsules {
        match rng.random_range(0..8) {
            0 => draft.first.local[1] = draft.first.local[0],
            1 => draft.second.local[1] = draft.second.local[0],
            _ => {}
        }
    }
    draft
}

/// Moves the first body so that a point of it is `aside` of one of the second at this time.
fn aim(rng: &mut dyn Rng, draft: &mut Draft, time: f64, aside: Vector3<f64>) {
    let Some(query) = draft.query() else { return };
    let points = query.positions(time);
    let (first, second) = points.split_at(draft.first.local.len());
    let way = mean(rng, second) - mean(rng, first) + aside;
    draft.first.centres.iter_mut().for_each(|c| *c += way);
}

fn anywhere(rng: &mut dyn Rng, pair: Pair, scale: Scale) -> Draft {
    let centre = real_vector(rng, scale.place);
    let beside = centre + real_vector(rng, 2.0 * scale.size);
    let [first, second] = pair.counts();
    let draft = Draft {
        first: body(rng, first, beside, scale),
        second: body(rng, second, centre, scale),
    };
    rounded(rng, pair, draft)
}

/// Half of them aimed at each other.
fn general(rng: &mut dyn Rng, pair: Pair, scale: Scale) -> RigidQuery {
    first_query(rng, |rng| {
        let mut draft = anywhere(rng, pair, scale);
        if rng.random() {
            let time = rng.random_range(0.0..1.0);
            let aside = real_vector(rng, scale.radius);
            aim(rng, &mut draft, time, aside);
        }
        let radii = pair.radii(rng, scale.radius);
        snapped(draft, radii, scale.unit)
    })
}

/// A rod or a blade with coordinates up to a metre that turns by 50 to 88 degrees about its centre, and a small body that
/// moves slowly and that it comes to, or nearly.
fn spin(rng: &mut dyn Rng, pair: Pair) -> RigidQuery {
    let small = Scale {
        size: 0.125,
        speed: 0.25,
        radius: 0.03125,
        ..METRES
    };
    first_query(rng, |rng| {
        let mut draft = anywhere(rng, pair, small);
        let fast = &mut draft.second;
        fast.centres[1] = fast.centres[0];
        fast.quaternions = turn_within(rng, 50.0..88.0);
        let way = real_vector(rng, 1.0);
        fast.local[0] = way;
        fast.local[1] = match rng.random() {
            true => -way,
            false => real_vector(rng, 0.0625),
        };
        let time = rng.random_range(0.0..1.0);
        let aside = real_vector(rng, 0.0625);
        aim(rng, &mut draft, time, aside);
        let radii = pair.radii(rng, small.radius);
        snapped(draft, radii, small.unit)
    })
}

/// A number up to 2 to the 10th, each power of two as often, of either sign; 0 in a quarter.
fn few(rng: &mut dyn Rng) -> f64 {
    if rng.random_range(0..4) == 0 {
        return 0.0;
    }
    let octave = rng.random_range(0..=10);
    let size = f64::from(rng.random_range(1..=1 << octave));
    if rng.random() { size } else { -size }
}

/// Bodies with the distance to which they come, about, for their radii.
fn grazing(rng: &mut dyn Rng, pair: Pair) -> RigidQuery {
    let unit = METRES.unit;
    first_query(rng, |rng| {
        let draft = anywhere(rng, pair, METRES);
        let query = snapped(draft, [0.0, 0.0], unit)?;
        let gap = estimate_gap(&query);
        // Not those that go through each other, nor balls of many metres.
        let together = (16.0 * unit..1.0).contains(&gap).then_some(gap)?;
        let together = together + few(rng) * unit;
        let radii = pair.radii_together(rng, together);
        with_radii(&query, radii, unit)
    })
}

/// Beams with coordinates up to 32 m that turn by up to 5 degrees, against millimetres to centimetres.
fn long_thin(rng: &mut dyn Rng) -> RigidQuery {
    let small = Scale {
        unit: 1.0 / (1 << 16) as f64,
        place: 16.0,
        size: 0.03125,
        speed: 0.5,
        degrees: 45.0,
        radius: 0.03125,
    };
    first_query(rng, |rng| {
        let mut draft = anywhere(rng, Pair::Capsules, small);
        let long = &mut draft.second;
        long.local = (0..2).map(|_| real_vector(rng, 32.0)).collect();
        long.quaternions = turn_within(rng, 0.0..5.0);
        let time = rng.random_range(0.0..1.0);
        let aside = real_vector(rng, 0.0625);
        aim(rng, &mut draft, time, aside);
        let radii = Pair::Capsules.radii(rng, small.radius);
        snapped(draft, radii, small.unit)
    })
}

/// Of 4, in 2 overlapping and in 2 touching at the start up to some units.
fn start(rng: &mut dyn Rng, pair: Pair) -> RigidQuery {
    let unit = METRES.unit;
    first_query(rng, |rng| {
        let mut draft = anywhere(rng, pair, METRES);
        let aside = real_vector(rng, 0.25);
        aim(rng, &mut draft, 0.0, aside);
        let query = snapped(draft, [0.0, 0.0], unit)?;
        let at_start = query.positions(0.0);
        let still = Query::new(query.kind().linear(), at_start, at_start, 0.0).ok()?;
        let apart = estimate_gap(&still);
        let apart = (16.0 * unit..0.5).contains(&apart).then_some(apart)?;
        let more = match rng.random() {
            true => rng.random_range(0.0..0.125),
            false => few(rng) * unit,
        };
        let radii = pair.radii_together(rng, apart + more);
        with_radii(&query, radii, unit)
    })
}

#[cfg(test)]
mod tests {
    use tunnelproof::query::QueryKind;
    use tunnelproof::rigid::Side;

    use super::*;
    use crate::oracle::decide_rigid_query;

    const COUNT: u64 = 300;

    fn queries(family: &'static RigidFamily) -> impl Iterator<Item = RigidQuery> {
        (0..COUNT).map(move |index| family.query(1, index))
    }

    #[test]
    fn turning_cast_numbers_are_exact_in_single_precision() {
        for family in TURNING_CAST_FAMILIES {
            for query in queries(family) {
                let [first, second] = query.radius().parts();
                let is_thin = family.name.contains("_thin_");
                let is_face = query.kind().linear() == QueryKind::VertexFace;
                assert_eq!(
                    (first > 0.0, second > 0.0),
                    (!is_thin, !is_thin && !is_face)
                );
                let mut numbers = vec![first, second, first + second];
                for side in query.sides() {
                    let Side::Turning { local, motion } = side else {
                        panic!("{}: a side does not turn", family.name);
                    };
                    let poses = [motion.start(), motion.end()];
                    for point in local.iter().chain(poses.map(|pose| &pose.centre)) {
                        numbers.extend(point.iter());
                    }
                    for pose in poses {
                        let q = pose.quaternion;
                        numbers.extend([q.w, q.i, q.j, q.k]);
                        assert!((q.norm() - 1.0).abs() < 2e-7, "{}", family.name);
                    }
                }
                for number in numbers {
                    assert_eq!(f64::from(number as f32), number, "{}", family.name);
                }
            }
        }
    }

    #[test]
    fn turning_cast_families_have_hits_misses_and_contacts_at_the_start() {
        let mut shares = Vec::new();
        for family in TURNING_CAST_FAMILIES {
            let hits: Vec<_> = queries(family)
                .filter_map(|query| decide_rigid_query(&query).hit)
                .collect();
            let at_start = hits.iter().filter(|hit| hit.toi.above == 0.0).count();
            let share = |count: usize| count as f64 / COUNT as f64;
            shares.push((family.name, share(hits.len()), share(at_start)));
        }
        println!("{shares:?}");
        for (name, hits, at_start) in &shares {
            assert!((0.1..0.98).contains(hits), "{name}: {shares:?}");
            let least = if name.ends_with("start") { 0.6 } else { 0.0 };
            assert!(*at_start >= least, "{name}: {shares:?}");
        }
    }
}
