//! One property that is probed, each: how the bodies of a family lie and move.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::query::{Query, QueryKind};

use super::super::motion::{end_of_step_or_inside, not_zero, vector};
use super::bodies::{Cast, carried, query, rotation};
use super::pair::{Pair, Size};

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
pub(super) fn uniform(rng: &mut dyn Rng, pair: Pair) -> Query {
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
pub(super) fn lattice(rng: &mut dyn Rng, pair: Pair) -> Query {
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
pub(super) fn coplanar(rng: &mut dyn Rng, pair: Pair) -> Query {
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
pub(super) fn parallel(rng: &mut dyn Rng, pair: Pair) -> Query {
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
pub(super) fn grazing(rng: &mut dyn Rng, pair: Pair) -> Query {
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
pub(super) fn long_thin(rng: &mut dyn Rng, pair: Pair) -> Query {
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
pub(super) fn far(rng: &mut dyn Rng, pair: Pair) -> Query {
    const REACH: i32 = 1 << 9;
    let mut start = [(); 4].map(|()| vector(rng, REACH));
    let offset = Vector3::from_fn(|_, _| not_zero(rng, 1 << 22));
    start = start.map(|point| point + offset);
    let steps = [(); 2].map(|()| vector(rng, REACH));
    let radii = pair.radii(rng, Size::AtMost(REACH / 4));
    translated(pair, start, steps, radii, -13)
}

/// Bodies that are in contact up to a few units, and move by a few units.
pub(super) fn tiny(rng: &mut dyn Rng, pair: Pair) -> Query {
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
pub(super) fn start(rng: &mut dyn Rng, pair: Pair) -> Query {
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
