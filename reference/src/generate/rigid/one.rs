//! A body and an edge or a vertex in space.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::rigid::RigidQuery;

use super::super::motion::{not_zero, real_vector, vector};
use super::draft::{Draft, anywhere, first, integers, sides};

pub(super) fn uniform(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| anywhere(rng, 88.0, 1.0).aimed(rng))
}

pub(super) fn lattice(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let (world, local) = sides(rng);
        let reach = rng.random_range(1..=3);
        let mut at = || (0..world).map(|_| integers(rng, reach)).collect::<Vec<_>>();
        let mut world = [at(), at()];
        if rng.random_range(0..4) == 0 {
            world[1] = world[0].clone();
        }
        let centre = integers(rng, 1);
        let mut draft = Draft {
            centres: match rng.random() {
                true => [centre, integers(rng, 1)],
                false => [centre; 2],
            },
            quaternions: [(); 2].map(|()| [(); 4].map(|()| f64::from(rng.random_range(-2..=2)))),
            world,
            local: (0..local).map(|_| integers(rng, reach)).collect(),
            radius: 0.0,
        };
        match rng.random_range(0..12) {
            0 => draft.local[1] = draft.local[0],
            1 => draft.local = vec![draft.local[0]; local],
            2 => draft.world.iter_mut().for_each(|side| {
                let first = side[0];
                side.fill(first);
            }),
            3 => draft.local[0] = Vector3::zeros(),
            _ => {}
        }
        draft
    })
}

/// Turns about z, with all points in a plane across it, on the axis or parallel to it; under other
/// names of the axes.
pub(super) fn confined(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let (world, local) = sides(rng);
        let kind = rng.random_range(0..8);
        let point = |rng: &mut dyn Rng| match kind {
            0 => Vector3::new(0.0, 0.0, f64::from(rng.random_range(-3..=3))),
            _ => {
                let p = integers(rng, 3);
                Vector3::new(p.x, p.y, 0.0)
            }
        };
        let mut start: Vec<_> = (0..world).map(|_| point(rng)).collect();
        let mut end: Vec<_> = (0..world).map(|_| point(rng)).collect();
        let mut body: Vec<_> = (0..local).map(|_| point(rng)).collect();
        if kind == 1 && world == 2 {
            // Edges along the axis.
            for points in [&mut start, &mut end, &mut body] {
                points[1] = points[0] + Vector3::z() * f64::from(not_zero(rng, 3));
            }
        }
        let centres = [point(rng), point(rng)];
        let centres = if rng.random() {
            centres
        } else {
            [centres[0]; 2]
        };
        let lift = [(); 2].map(|()| Vector3::z() * f64::from(rng.random_range(-2..=2)));
        let [first, second] = [(); 2].map(|()| [0; 2].map(|_| f64::from(rng.random_range(-3..=3))));
        let draft = Draft {
            centres: [centres[0] + lift[0], centres[1] + lift[1]],
            quaternions: [first, second].map(|[w, z]| [w, 0.0, 0.0, z]),
            world: [
                start.iter().map(|p| p + lift[0]).collect(),
                end.iter().map(|p| p + lift[1]).collect(),
            ],
            local: body,
            radius: 0.0,
        };
        let draft = renamed(rng, draft);
        match rng.random_range(0..3) {
            0 => draft.nudged(rng),
            _ => draft,
        }
    })
}

/// The same with the axes named otherwise, in the same order around.
fn renamed(rng: &mut dyn Rng, mut draft: Draft) -> Draft {
    for _ in 0..rng.random_range(0..3) {
        let next = |v: &mut Vector3<f64>| *v = Vector3::new(v.z, v.x, v.y);
        draft.centres.iter_mut().for_each(next);
        draft.world.iter_mut().flatten().for_each(next);
        draft.local.iter_mut().for_each(next);
        for [_, x, y, z] in &mut draft.quaternions {
            (*x, *y, *z) = (*z, *x, *y);
        }
    }
    draft
}

/// `|q|^2` times the turned vector.
pub(super) fn turned([w, x, y, z]: [i32; 4], p: Vector3<i32>) -> Vector3<i32> {
    let v = Vector3::new(x, y, z);
    p * (w * w - v.dot(&v)) + v * (2 * v.dot(&p)) + v.cross(&p) * (2 * w)
}

/// Contact at the time `i / n`, in integers: the quaternion there is `((n - i) q0 + i q1) / n`, and
/// points of the body are multiples of the square of its length.
pub(super) fn grazing(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let is_double = rng.random_range(0..3) == 0;
        at_a_fraction(rng, is_double, false)
    })
}

/// Half of them moved by some ulps; beyond it means at a distance, which is the radius.
pub(super) fn at_a_fraction(rng: &mut dyn Rng, is_double: bool, is_beyond: bool) -> Draft {
    let n = rng.random_range(1..=4);
    let i = rng.random_range(0..=n);
    let ends = [(); 2].map(|()| {
        let mut q = [(); 4].map(|()| rng.random_range(-2..=2));
        if is_double {
            (q[1], q[2]) = (0, 0);
        }
        q
    });
    let [q0, q1] = nearer(ends);
    let q = [0, 1, 2, 3].map(|h| (n - i) * q0[h] + i * q1[h]);
    let draft = match is_double {
        true => tangent(rng, q, is_beyond),
        false => touching(rng, q, [i, n - i]),
    };
    let draft = Draft {
        quaternions: ends.map(|q| q.map(f64::from)),
        ..draft
    };
    match rng.random_range(0..3) {
        0 => draft.nudged(rng),
        _ => draft,
    }
}

pub(super) fn nearer([q0, q1]: [[i32; 4]; 2]) -> [[i32; 4]; 2] {
    let along: i32 = q0.iter().zip(&q1).map(|(a, b)| a * b).sum();
    [q0, if along < 0 { q1.map(|x| -x) } else { q1 }]
}

/// A vertex on an edge or a corner of the face, or an end of an edge on the other one, when the
/// quaternion is `q`; everything moves.
fn touching(rng: &mut dyn Rng, q: [i32; 4], [before, after]: [i32; 2]) -> Draft {
    let (world, local) = sides(rng);
    let size: i32 = q.iter().map(|x| x * x).sum();
    let body: Vec<_> = (0..local).map(|_| vector(rng, 3)).collect();
    // Eighths of the body's edge, so that the place is an integer as well.
    let share = rng.random_range(0..=8);
    let place = body[0] * (8 - share) + body[1] * share;
    let centre = vector(rng, 4);
    let touched = centre + turned(q, place);
    let mut points = vec![touched, touched + vector(rng, 8 * size.max(1))];
    points.truncate(world);
    let mut both = |p: Vector3<i32>| {
        let speed = vector(rng, 4);
        [p - speed * before, p + speed * after].map(|p| p.map(f64::from))
    };
    let centres = both(centre);
    let moved: Vec<_> = points.into_iter().map(&mut both).collect();
    Draft {
        centres,
        quaternions: [[0.0; 4]; 2],
        world: [0, 1].map(|end| moved.iter().map(|ends| ends[end]).collect()),
        local: body
            .iter()
            .map(|p| (p * (8 * size)).map(f64::from))
            .collect(),
        radius: 0.0,
    }
}

/// A vertex at rest that a face of a body which spins about z just touches, or an edge along z and
/// an edge.
fn tangent(rng: &mut dyn Rng, q: [i32; 4], is_beyond: bool) -> Draft {
    let (world, local) = sides(rng);
    let size: i32 = q.iter().map(|x| x * x).sum();
    // Beyond, of length 5.
    let (arm, out) = match is_beyond {
        true => (ARMS[rng.random_range(0..4)], rng.random_range(1..=3)),
        false => ([not_zero(rng, 3), rng.random_range(-3..=3)], 0),
    };
    let arm = Vector3::new(arm[0], arm[1], 0);
    let centre = vector(rng, 4);
    let [w, x, y, z] = q;
    let place = turned([w, -x, -y, -z], arm);
    let along = Vector3::z().cross(&place);
    let [one, two] = [(); 2].map(|()| rng.random_range(1..=3));
    let points = vec![
        centre + arm * (size + out),
        centre + arm * (size + out) + Vector3::z() * not_zero(rng, 9),
    ];
    let below = rng.random_range(0..=4);
    let mut side = points;
    if world == 2 {
        side[0].z -= below;
    }
    side.truncate(world);
    let body = match local {
        2 => vec![place + along * one, place - along * two],
        _ => vec![
            place + along * one,
            place - along * two + Vector3::z() * two,
            place - Vector3::z() * one,
        ],
    };
    let side: Vec<_> = side.iter().map(|p| p.map(f64::from)).collect();
    Draft {
        centres: [centre.map(f64::from); 2],
        quaternions: [[0.0; 4]; 2],
        world: [side.clone(), side],
        local: body.iter().map(|p| p.map(f64::from)).collect(),
        radius: f64::from(5 * out),
    }
}

const ARMS: [[i32; 2]; 4] = [[3, 4], [-4, 3], [5, 0], [0, -5]];

pub(super) fn spin(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let speed = if rng.random() { 0.0 } else { 1e-3 };
        let mut draft = anywhere(rng, 88.0, 1.0);
        draft.centres[1] = draft.centres[0];
        draft.world[1] = draft.world[0].clone();
        for point in &mut draft.world[1] {
            *point += real_vector(rng, 1.0) * speed;
        }
        draft.aimed(rng)
    })
}

/// Quaternions that name the axes otherwise, or their signs.
pub(super) const EXACT: [[f64; 4]; 4] = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
    [1.0, 1.0, 1.0, 1.0],
    [1.0, 0.0, 0.0, 1.0],
];

/// The points of a body without a turn: its orientation names the axes otherwise, or their signs.
pub(super) fn translation(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let (world, local) = sides(rng);
        let unit = 2f64.powi(rng.random_range(-20..=-1));
        let mut point = || integers(rng, 1 << 6) * unit;
        let start = (0..world).map(|_| point()).collect();
        let end = (0..world).map(|_| point()).collect();
        let body = (0..local).map(|_| point()).collect();
        let centres = [point(), point()];
        let q = EXACT[rng.random_range(0..4)];
        let [first, second] = [(); 2].map(|()| f64::from(not_zero(rng, 3)));
        Draft {
            centres,
            quaternions: [q.map(|x| x * first), q.map(|x| x * second)],
            world: [start, end],
            local: body,
            radius: 0.0,
        }
    })
}

pub(super) fn plates(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let mut draft = anywhere(rng, 60.0, 0.5);
        let thin = 10f64.powi(rng.random_range(-6..=-2));
        for point in &mut draft.local {
            point.z *= thin;
            point.y *= if rng.random() { 1.0 } else { 0.1 };
        }
        draft.aimed(rng)
    })
}

pub(super) fn scales(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let mut draft = anywhere(rng, 88.0, 1.0);
        let all = 10f64.powf(rng.random_range(-6.0..6.0));
        let [world, local, first, second] =
            [(); 4].map(|()| 10f64.powf(rng.random_range(-3.0..3.0)));
        let moving = draft
            .centres
            .iter_mut()
            .chain(draft.world.iter_mut().flatten());
        moving.for_each(|p| *p *= all);
        draft
            .world
            .iter_mut()
            .flatten()
            .for_each(|p| *p *= world.min(1.0));
        draft.local.iter_mut().for_each(|p| *p *= all * local);
        let lengths = if rng.random() {
            [first; 2]
        } else {
            [first, second]
        };
        for (q, length) in draft.quaternions.iter_mut().zip(lengths) {
            *q = q.map(|x| x * length);
        }
        draft.aimed(rng)
    })
}
