//! Rigid bodies that are cast along lines, as physics engines do: capsules, segments, and a sphere
//! against a triangle. Each body is carried by one translation.
//!
//! Two capsules are two edges whose radius is the sum of theirs, a sphere is an edge without
//! length, and a sphere against a triangle is a vertex and a face. Probes what the shape casts of
//! physics engines answer, so every number is one that they can hold: each coordinate at either end
//! of the step, each translation and each radius is a whole multiple of a unit, fewer than `2^23`
//! of them, and the unit a power of two. So each is a number in `f32`, both points of a body are
//! translated by the same vector exactly, and an engine in single precision is asked the same query
//! as one in double precision.
//!
//! The two parts of the radius are those of the two bodies. Of capsules neither is 0; of 8 pairs of
//! capsules, in 1 the first, in 1 the second and in 1 either is a sphere.

use nalgebra::{Matrix3, Vector3};
use rand::{Rng, RngExt};
use tunnelproof::query::{Point, Query, QueryKind};

use super::motion::{Motion, end_of_step_or_inside, in_units, not_zero, placed, vector};
use super::{Draw, Family};

/// Every family of bodies that are cast, in the order of tables.
pub const CAST_FAMILIES: &[Family] = &[
    family("cast_uniform", "capsules cast: general motion", |rng| {
        uniform(rng, Pair::Capsules)
    }),
    family("cast_lattice", "capsules cast: small integers", |rng| {
        lattice(rng, Pair::Capsules)
    }),
    family(
        "cast_coplanar",
        "capsules cast: in one plane, exactly or nearly",
        |rng| coplanar(rng, Pair::Capsules),
    ),
    family(
        "cast_parallel",
        "capsules cast: parallel, exactly or nearly",
        |rng| parallel(rng, Pair::Capsules),
    ),
    family(
        "cast_grazing",
        "capsules cast: past each other at the sum of the radii, exactly or nearly",
        |rng| grazing(rng, Pair::Capsules),
    ),
    family(
        "cast_long_thin",
        "capsules cast: hundreds of metres long against millimetres",
        |rng| long_thin(rng, Pair::Capsules),
    ),
    family(
        "cast_far",
        "capsules cast: of centimetres, hundreds of metres off the origin",
        |rng| far(rng, Pair::Capsules),
    ),
    family("cast_tiny", "capsules cast: steps of a few units", |rng| {
        tiny(rng, Pair::Capsules)
    }),
    family(
        "cast_start",
        "capsules cast: in contact at the start, by overlap or just so",
        |rng| start(rng, Pair::Capsules),
    ),
    family(
        "cast_thin_uniform",
        "segments cast: general motion",
        |rng| uniform(rng, Pair::Segments),
    ),
    family(
        "cast_thin_lattice",
        "segments cast: small integers",
        |rng| lattice(rng, Pair::Segments),
    ),
    family(
        "cast_thin_coplanar",
        "segments cast: in one plane, exactly or nearly",
        |rng| coplanar(rng, Pair::Segments),
    ),
    family(
        "cast_thin_parallel",
        "segments cast: parallel, exactly or nearly",
        |rng| parallel(rng, Pair::Segments),
    ),
    family(
        "cast_thin_far",
        "segments cast: of centimetres, hundreds of metres off the origin",
        |rng| far(rng, Pair::Segments),
    ),
    family(
        "cast_face_uniform",
        "sphere and triangle cast: general motion",
        |rng| uniform(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_lattice",
        "sphere and triangle cast: small integers",
        |rng| lattice(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_grazing",
        "sphere and triangle cast: past each other at the radius, exactly or nearly",
        |rng| grazing(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_long_thin",
        "sphere and triangle cast: hundreds of metres long against millimetres",
        |rng| long_thin(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_far",
        "sphere and triangle cast: of centimetres, hundreds of metres off the origin",
        |rng| far(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_tiny",
        "sphere and triangle cast: steps of a few units",
        |rng| tiny(rng, Pair::SphereFace),
    ),
    family(
        "cast_face_start",
        "sphere and triangle cast: in contact at the start, by overlap or just so",
        |rng| start(rng, Pair::SphereFace),
    ),
];

const fn family(
    name: &'static str,
    description: &'static str,
    draw: fn(&mut dyn Rng) -> Query,
) -> Family {
    Family {
        name,
        description,
        draw: Draw::Query(draw),
    }
}

/// What is cast against what.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Pair {
    Capsules,
    Segments,
    SphereFace,
}

impl Pair {
    fn kind(self) -> QueryKind {
        match self {
            Pair::Capsules | Pair::Segments => QueryKind::EdgeEdge,
            Pair::SphereFace => QueryKind::VertexFace,
        }
    }

    /// Which body each of the four points belongs to.
    fn bodies(self) -> [usize; 4] {
        match self.kind() {
            QueryKind::EdgeEdge => [0, 0, 1, 1],
            QueryKind::VertexFace => [0, 1, 1, 1],
        }
    }

    /// Two radii of which the greater is at most this, or which are together this.
    fn radii(self, rng: &mut dyn Rng, size: Size) -> [i32; 2] {
        match (self, size) {
            (Pair::Segments, _) => [0, 0],
            (Pair::SphereFace, Size::AtMost(most)) => [rng.random_range(1..=most), 0],
            (Pair::SphereFace, Size::Together(all)) => [all, 0],
            (Pair::Capsules, Size::AtMost(most)) => [(); 2].map(|()| rng.random_range(1..=most)),
            (Pair::Capsules, Size::Together(all)) => {
                let first = rng.random_range(1..all.max(2));
                [first, (all - first).max(1)]
            }
        }
    }
}

/// How large radii are, in units.
#[derive(Clone, Copy)]
enum Size {
    AtMost(i32),
    Together(i32),
}

/// Two bodies at one time of the step, and how the second moves relative to the first, in units.
///
/// A point of the first and one of the second are `apart` then; which ones is said in eighths of the
/// `sides`: of AB and CD, or of BC and BD, where the first body is the vertex A.
struct Cast {
    pair: Pair,
    /// An eighth of each side.
    sides: [Vector3<i32>; 2],
    places: [i32; 2],
    apart: Vector3<i32>,
    /// How much of the step is before that time and how much after it.
    times: [i32; 2],
    /// The translation in one of these parts of the step.
    passing: Vector3<i32>,
    radii: [i32; 2],
}

impl Cast {
    /// The points, A at rest.
    fn motion(&self) -> Motion<i32> {
        let ([p, q], [i, j]) = (self.sides, self.places);
        let zero = Vector3::zeros();
        let [first, second] = match self.pair.kind() {
            QueryKind::EdgeEdge => [[zero, p * 8], [zero, q * 8]],
            QueryKind::VertexFace => [[zero, zero], [p * 8, q * 8]],
        };
        let met = match self.pair.kind() {
            QueryKind::EdgeEdge => p * i - q * j,
            QueryKind::VertexFace => -(p * i + q * j),
        };
        let [before, after] = self.times;
        [-before, after].map(|since| {
            let origin = met + self.apart + self.passing * since;
            match self.pair.kind() {
                QueryKind::EdgeEdge => [first[0], first[1], origin, origin + second[1]],
                QueryKind::VertexFace => [zero, origin, origin + second[0], origin + second[1]],
            }
        })
    }

    /// Some of the bodies as spheres.
    fn rounded(mut self, rng: &mut dyn Rng) -> Self {
        if self.pair == Pair::Capsules {
            let which = rng.random_range(0..8);
            for (body, side) in self.sides.iter_mut().enumerate() {
                if which == body || which == 2 && rng.random() {
                    *side = Vector3::zeros();
                }
            }
        }
        self
    }

    /// The query in a space mapped at random, so that distances change, with this unit.
    fn mapped(&self, rng: &mut dyn Rng, exponent: i32) -> Query {
        let motion = placed(rng, self.motion());
        query(self.pair, motion, self.radii, exponent)
    }

    /// The query in a space rotated at random and made larger, so that every distance to be exact
    /// stays so, with this unit.
    fn rotated(&self, rng: &mut dyn Rng, exponent: i32) -> Query {
        let (rotation, scale) = rotation(rng);
        let motion = self.motion();
        let motion = motion.map(|points| points.map(|point| rotation * point));
        let motion = carried(rng, motion, 1 << 21);
        let radii = self.radii.map(|radius| radius * scale);
        query(self.pair, motion, radii, exponent)
    }
}

/// An integer matrix that rotates and makes all distances larger by an integer.
fn rotation(rng: &mut dyn Rng) -> (Matrix3<i32>, i32) {
    let [w, x, y, z] = [(); 4].map(|()| rng.random_range(-2..=2));
    let scale = w * w + x * x + y * y + z * z;
    if scale == 0 {
        return (Matrix3::identity(), 1);
    }
    let matrix = Matrix3::new(
        w * w + x * x - y * y - z * z,
        2 * (x * y - w * z),
        2 * (x * z + w * y),
        2 * (x * y + w * z),
        w * w - x * x + y * y - z * z,
        2 * (y * z - w * x),
        2 * (x * z - w * y),
        2 * (y * z + w * x),
        w * w - x * x - y * y + z * z,
    );
    (matrix, scale)
}

/// The motion carried along by a translation, of coordinates up to `reach`.
fn carried(rng: &mut dyn Rng, motion: Motion<i32>, reach: i32) -> Motion<i32> {
    motion.map(|points| {
        let origin = vector(rng, reach);
        points.map(|point| point + origin)
    })
}

fn query(pair: Pair, motion: Motion<i32>, radii: [i32; 2], exponent: i32) -> Query {
    let unit = 2f64.powi(exponent);
    let [start, end] = in_units(motion, unit).map(|points| points.map(Point::from));
    let radii = radii.map(|radius| f64::from(radius) * unit);
    Query::new(pair.kind(), start, end, radii).expect("integers are finite")
}

/// A vector along which something is off by a few units: 0 in half of the cases, else one
/// coordinate of up to `2^10`, each power of two as often.
fn nudge(rng: &mut dyn Rng) -> Vector3<i32> {
    let mut nudge = Vector3::zeros();
    if rng.random() {
        let octave = rng.random_range(0..=10);
        nudge[rng.random_range(0..3)] = not_zero(rng, 1 << octave);
    }
    nudge
}

/// Every coordinate evenly from `[-1, 1)` at the start, and translations of as much.
fn uniform(rng: &mut dyn Rng, pair: Pair) -> Query {
    const REACH: i32 = 1 << 20;
    let mut start = [(); 4].map(|()| vector(rng, REACH));
    if pair == Pair::Capsules {
        let which = rng.random_range(0..8);
        for (end, body) in [(1, 0), (3, 1)] {
            if which == body || which == 2 && rng.random() {
                start[end] = start[end - 1];
            }
        }
    }
    let steps = [(); 2].map(|()| vector(rng, REACH));
    let radii = pair.radii(rng, Size::AtMost(REACH / 4));
    translated(pair, start, steps, radii, -20)
}

/// Integers up to 3, translations of as much, and radii in halves: every degeneracy exactly and
/// often.
fn lattice(rng: &mut dyn Rng, pair: Pair) -> Query {
    let reach = rng.random_range(1..=3);
    let mut start = [(); 4].map(|()| vector(rng, reach) * 2);
    match rng.random_range(0..16) {
        0..2 if pair != Pair::SphereFace => start[1] = start[0],
        2..4 => start[3] = start[2],
        _ => {}
    }
    let steps = [(); 2].map(|()| vector(rng, 3) * 2);
    let radii = pair.radii(rng, Size::AtMost(3));
    translated(pair, start, steps, radii, -1)
}

fn translated(
    pair: Pair,
    start: [Vector3<i32>; 4],
    steps: [Vector3<i32>; 2],
    radii: [i32; 2],
    exponent: i32,
) -> Query {
    let bodies = pair.bodies();
    let end = [0, 1, 2, 3].map(|i| start[i] + steps[bodies[i]]);
    query(pair, [start, end], radii, exponent)
}

/// A point in eighths of a side: on it or a little beyond.
fn places(rng: &mut dyn Rng) -> [i32; 2] {
    [(); 2].map(|()| rng.random_range(-1..=9))
}

/// A point in eighths of a side that is on the body.
fn places_within(rng: &mut dyn Rng, pair: Pair) -> [i32; 2] {
    let first = rng.random_range(0..=8);
    let most = match pair.kind() {
        QueryKind::EdgeEdge => 8,
        QueryKind::VertexFace => 8 - first,
    };
    [first, rng.random_range(0..=most)]
}

fn in_plane(rng: &mut dyn Rng, reach: i32) -> Vector3<i32> {
    let mut vector = vector(rng, reach);
    vector.z = 0;
    vector
}

/// Bodies and their translations in one plane, or off it by a few units; then the space is mapped.
fn coplanar(rng: &mut dyn Rng, pair: Pair) -> Query {
    const REACH: i32 = 1 << 11;
    let cast = Cast {
        pair,
        sides: [(); 2].map(|()| in_plane(rng, REACH)),
        places: places(rng),
        apart: in_plane(rng, 8 * REACH) + nudge(rng),
        times: end_of_step_or_inside(rng),
        passing: in_plane(rng, REACH),
        radii: pair.radii(rng, Size::AtMost(REACH)),
    };
    cast.rounded(rng).mapped(rng, -16)
}

/// Parallel edges, or off that by a few units; then the space is mapped.
fn parallel(rng: &mut dyn Rng, pair: Pair) -> Query {
    const REACH: i32 = 1 << 9;
    let direction = vector(rng, REACH);
    let mut sides = [(); 2].map(|()| direction * not_zero(rng, 4));
    sides[1] += nudge(rng);
    let apart = match pair {
        Pair::Segments if rng.random() => nudge(rng),
        _ => vector(rng, REACH),
    };
    let passing = match rng.random_range(0..4) {
        0 => direction,
        _ => vector(rng, REACH),
    };
    let cast = Cast {
        pair,
        sides,
        places: places(rng),
        apart,
        times: end_of_step_or_inside(rng),
        passing,
        radii: pair.radii(rng, Size::AtMost(REACH)),
    };
    cast.mapped(rng, -16)
}

/// Bodies on two parallel planes whose distance is the sum of the radii, exactly or up to a few
/// units: they slide along these or meet at an end of the step. Then the space is rotated.
fn grazing(rng: &mut dyn Rng, pair: Pair) -> Query {
    const REACH: i32 = 1 << 11;
    let together = rng.random_range(2..REACH);
    let mut passing = in_plane(rng, REACH);
    let mut times = end_of_step_or_inside(rng);
    if rng.random_range(0..4) == 0 {
        // Down to the contact at the end of the step, or up from that at its start.
        let steps = rng.random_range(1..=8);
        let is_down: bool = rng.random();
        times = if is_down { [steps, 0] } else { [0, steps] };
        let height = rng.random_range(1..REACH);
        passing.z = if is_down { -height } else { height };
    }
    let mut apart = Vector3::new(0, 0, together);
    if rng.random() {
        apart += nudge(rng);
    }
    let cast = Cast {
        pair,
        sides: [(); 2].map(|()| in_plane(rng, REACH)),
        places: places(rng),
        apart,
        times,
        passing,
        radii: pair.radii(rng, Size::Together(together)),
    };
    cast.rounded(rng).rotated(rng, -18)
}

/// A side of up to 512 m and one of some millimetres to centimetres; radii and steps of
/// centimetres to decimetres.
fn long_thin(rng: &mut dyn Rng, pair: Pair) -> Query {
    let [long, short] = [1 << 16, 1 << 3].map(|reach| vector(rng, reach));
    let sides = if rng.random() {
        [long, short]
    } else {
        [short, long]
    };
    let passing = vector(rng, 1 << 7);
    let cast = Cast {
        pair,
        sides,
        places: places(rng),
        apart: vector(rng, 1 << 8),
        times: end_of_step_or_inside(rng),
        passing,
        radii: pair.radii(rng, Size::AtMost(1 << 8)),
    };
    let motion = carried(rng, cast.motion(), 1 << 20);
    query(pair, motion, cast.radii, -10)
}

/// Bodies of some centimetres with steps of as much, up to 512 m off the origin along each axis.
fn far(rng: &mut dyn Rng, pair: Pair) -> Query {
    const REACH: i32 = 1 << 9;
    let mut start = [(); 4].map(|()| vector(rng, REACH));
    let offset = Vector3::from_fn(|_, _| not_zero(rng, 1 << 22));
    start = start.map(|point| point + offset);
    let steps = [(); 2].map(|()| vector(rng, REACH));
    let radii = pair.radii(rng, Size::AtMost(REACH / 4));
    translated(pair, start, steps, radii, -13)
}

/// Bodies that are in contact up to a few units, and move by a few units.
fn tiny(rng: &mut dyn Rng, pair: Pair) -> Query {
    const REACH: i32 = 1 << 11;
    let together = rng.random_range(8..REACH);
    let off = rng.random_range(-3..=3);
    let cast = Cast {
        pair,
        sides: [(); 2].map(|()| in_plane(rng, REACH)),
        places: places_within(rng, pair),
        apart: Vector3::new(0, 0, together + off),
        times: end_of_step_or_inside(rng),
        passing: vector(rng, 1),
        radii: pair.radii(rng, Size::Together(together)),
    };
    let (rotation, scale) = rotation(rng);
    let [start, _] = cast.motion();
    let origin = vector(rng, 1 << 20);
    let start = start.map(|point| rotation * point + origin);
    // The step is that of the bodies before they were made larger.
    let steps = [
        Vector3::zeros(),
        cast.passing * (cast.times[0] + cast.times[1]),
    ];
    let radii = cast.radii.map(|radius| radius * scale);
    translated(pair, start, steps, radii, -20)
}

/// Bodies in contact at the start: of 4, in 2 by overlap of any depth, in 2 just so or nearly so.
/// They move anywhere.
fn start(rng: &mut dyn Rng, pair: Pair) -> Query {
    const REACH: i32 = 1 << 11;
    let together = rng.random_range(2..REACH);
    let height = match rng.random_range(0..4) {
        0..2 => rng.random_range(0..together),
        2 => together,
        _ => together + rng.random_range(-2..=2),
    };
    let cast = Cast {
        pair,
        sides: [(); 2].map(|()| in_plane(rng, REACH)),
        places: places_within(rng, pair),
        apart: Vector3::new(0, 0, height),
        times: [0, 8],
        passing: vector(rng, REACH),
        radii: pair.radii(rng, Size::Together(together)),
    };
    cast.rounded(rng).rotated(rng, -18)
}

#[cfg(test)]
mod tests {
    use super::*;
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
            let family = super::super::by_name(name).unwrap();
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
}
