//! Families of queries of bodies that turn: half of each family edges, half vertices and faces.

use std::fmt;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rand::{Rng, RngExt};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use tunnelproof::query::{Point, Radius};
use tunnelproof::rigid::{EdgeTurningEdge, Pose, RigidMotion, RigidQuery, VertexTurningFace};

use super::IdError;
use super::motion::{not_zero, real_vector, vector};

mod thick;

/// Every family of bodies that turn.
pub const RIGID_FAMILIES: &[RigidFamily] = &[
    RigidFamily {
        name: "turning_uniform",
        description: "random poses at most 88 degrees apart, random points",
        draw: uniform,
    },
    RigidFamily {
        name: "turning_lattice",
        description: "small integers in quaternions and points, some of them the same",
        draw: lattice,
    },
    RigidFamily {
        name: "turning_confined",
        description: "all in a plane, on a line or parallel for the whole step, or nearly",
        draw: confined,
    },
    RigidFamily {
        name: "turning_grazing",
        description: "double roots, contact at corners and at ends of the step, or nearly",
        draw: grazing,
    },
    RigidFamily {
        name: "turning_spin",
        description: "a centre at rest, and an edge or vertex at rest or slow",
        draw: spin,
    },
    RigidFamily {
        name: "turning_translation",
        description: "no turn, in coordinates in which the linear query is exact",
        draw: translation,
    },
    RigidFamily {
        name: "turning_plates",
        description: "thin plates and rods that turn fast, past what is slow",
        draw: plates,
    },
    RigidFamily {
        name: "turning_scales",
        description: "lengths from 1e-6 to 1e6, and quaternions of any length",
        draw: scales,
    },
    thick::UNIFORM,
    thick::LATTICE,
    thick::CONFINED,
    thick::TANGENT,
    thick::STILL,
    thick::PLATES,
    thick::SCALES,
];

/// An endless, seeded sequence of queries of bodies that turn.
#[derive(Debug)]
pub struct RigidFamily {
    name: &'static str,
    description: &'static str,
    draw: fn(&mut dyn Rng) -> RigidQuery,
}

impl RigidFamily {
    /// The name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// What its queries are like, in one line.
    pub fn description(&self) -> &'static str {
        self.description
    }

    /// The query of this seed and index.
    pub fn query(&self, seed: u64, index: u64) -> RigidQuery {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        for (byte, letter) in key[8..].iter_mut().zip(self.name.bytes()) {
            *byte = letter;
        }
        let mut rng = ChaCha8Rng::from_seed(key);
        rng.set_stream(index);
        (self.draw)(&mut rng)
    }

    /// A query made of any random numbers, such as the bytes that a fuzzer chooses.
    pub fn draw(&self, rng: &mut dyn Rng) -> RigidQuery {
        (self.draw)(rng)
    }
}

/// The family with this name, if any.
pub fn rigid_by_name(name: &str) -> Option<&'static RigidFamily> {
    RIGID_FAMILIES.iter().find(|family| family.name == name)
}

/// The name of a generated query of a body that turns, written `FAMILY:SEED:INDEX`.
#[derive(Clone, Copy, Debug)]
pub struct RigidId {
    /// The family.
    pub family: &'static RigidFamily,
    /// The seed of the family.
    pub seed: u64,
    /// Which query of that seed, from 0.
    pub index: u64,
}

impl fmt::Display for RigidId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}", self.family.name, self.seed, self.index)
    }
}

impl RigidId {
    /// The query of this name.
    pub fn query(&self) -> RigidQuery {
        self.family.query(self.seed, self.index)
    }

    /// The identifier that a text is, if it starts with the name of a family of bodies that turn.
    pub fn parse(text: &str) -> Option<Result<Self, IdError>> {
        let (name, rest) = text.split_once(':')?;
        let family = rigid_by_name(name)?;
        let of_rest = || {
            let (seed, index) = rest.split_once(':').ok_or(IdError::Form)?;
            Ok(RigidId {
                family,
                seed: seed.parse().map_err(|_| IdError::Seed)?,
                index: index.parse().map_err(|_| IdError::Index)?,
            })
        };
        Some(of_rest())
    }
}

/// The numbers of a query, before they are checked.
#[derive(Clone, Debug)]
struct Draft {
    centres: [Vector3<f64>; 2],
    /// w, x, y, z.
    quaternions: [[f64; 4]; 2],
    /// Of edges A and B, else A, at the start and at the end of the step.
    world: [Vec<Vector3<f64>>; 2],
    local: Vec<Vector3<f64>>,
    radius: f64,
}

impl Draft {
    /// `None` if the body turns too far.
    fn query(&self) -> Option<RigidQuery> {
        let pose = |i: usize| {
            let [w, x, y, z] = self.quaternions[i];
            Pose::new(Point::from(self.centres[i]), Quaternion::new(w, x, y, z))
        };
        let motion = RigidMotion::new(pose(0), pose(1)).ok()?;
        let [start, end] = &self.world;
        let points = |points: &[Vector3<f64>]| -> Vec<Point> {
            points.iter().copied().map(Point::from).collect()
        };
        let (start, end, local) = (points(start), points(end), points(&self.local));
        match (&start[..], &end[..], &local[..]) {
            (&[a, b], &[a1, b1], &[c, d]) => {
                let sides = ([a, b], [a1, b1], [c, d]);
                edges(sides, motion, self.radius.into())
            }
            (&[a], &[a1], &[b, c, d]) => face(([a], [a1], [b, c, d]), motion, self.radius.into()),
            _ => None,
        }
    }

    /// Half of them moved in space so that a point of the first side is about on one of the body at
    /// some time.
    fn aimed(mut self, rng: &mut dyn Rng) -> Self {
        let Some(query) = self.query().filter(|_| rng.random()) else {
            return self;
        };
        let t = rng.random_range(0.0..1.0);
        let points = query.positions(t);
        let (first, second) = points.split_at(self.world[0].len());
        let mut mean = |points: &[Point]| {
            let weights: Vec<f64> = points.iter().map(|_| rng.random_range(0.0..1.0)).collect();
            let all: f64 = weights.iter().sum();
            let parts = points
                .iter()
                .zip(weights)
                .map(|(p, w)| p.coords * (w / all));
            parts.sum::<Vector3<f64>>()
        };
        let way = mean(second) - mean(first);
        self.world.iter_mut().flatten().for_each(|p| *p += way);
        self
    }

    /// Every number, each to be changed.
    fn numbers(&mut self) -> Vec<&mut f64> {
        let lengths = self
            .centres
            .iter_mut()
            .chain(self.world.iter_mut().flatten());
        let lengths = lengths.chain(&mut self.local).flat_map(|v| v.iter_mut());
        lengths
            .chain(self.quaternions.iter_mut().flatten())
            .collect()
    }

    /// Moves two numbers by up to `2^20` ulp, or not.
    fn nudged(mut self, rng: &mut dyn Rng) -> Self {
        for _ in 0..2 {
            let ulps = 1_i64 << rng.random_range(0..=20);
            let ulps = if rng.random() { ulps } else { -ulps };
            let mut numbers = self.numbers();
            let at = rng.random_range(0..numbers.len());
            let number = &mut *numbers[at];
            if *number != 0.0 {
                *number = f64::from_bits(number.to_bits().wrapping_add_signed(ulps));
            }
        }
        self
    }
}

type Sides<const WORLD: usize, const LOCAL: usize> =
    ([Point; WORLD], [Point; WORLD], [Point; LOCAL]);

fn edges(sides: Sides<2, 2>, motion: RigidMotion, radius: Radius) -> Option<RigidQuery> {
    let (start, end, local) = sides;
    let query = EdgeTurningEdge::with_radius(start, end, local, motion, radius);
    query.ok().map(RigidQuery::EdgeTurningEdge)
}

fn face(sides: Sides<1, 3>, motion: RigidMotion, radius: Radius) -> Option<RigidQuery> {
    let (start, end, local) = sides;
    let query = VertexTurningFace::with_radius(start, end, local, motion, radius);
    query.ok().map(RigidQuery::VertexTurningFace)
}

/// Draws until the body turns by no more than it may.
fn first(rng: &mut dyn Rng, draft: impl Fn(&mut dyn Rng) -> Draft) -> RigidQuery {
    loop {
        if let Some(query) = draft(rng).query() {
            return query;
        }
    }
}

/// How many points are in space and how many are of the body.
fn sides(rng: &mut dyn Rng) -> (usize, usize) {
    if rng.random() { (2, 2) } else { (1, 3) }
}

fn unit_quaternion(rng: &mut dyn Rng) -> UnitQuaternion<f64> {
    let axis = real_vector(rng, 1.0);
    UnitQuaternion::from_scaled_axis(axis * 3.0)
}

/// Two orientations of this angle at most, and both signs.
fn turn(rng: &mut dyn Rng, degrees: f64) -> [[f64; 4]; 2] {
    let first = unit_quaternion(rng);
    let axis = nalgebra::Unit::new_normalize(real_vector(rng, 1.0) + Vector3::new(0.0, 0.0, 1e-3));
    let angle = rng.random_range(0.0..degrees).to_radians();
    let second = UnitQuaternion::from_axis_angle(&axis, angle) * first;
    let sign = if rng.random() { 1.0 } else { -1.0 };
    let plain = |q: UnitQuaternion<f64>| [q.w, q.i, q.j, q.k];
    [plain(first), plain(second).map(|x| sign * x)]
}

fn anywhere(rng: &mut dyn Rng, degrees: f64, speed: f64) -> Draft {
    let (world, local) = sides(rng);
    let start: Vec<_> = (0..world).map(|_| real_vector(rng, 1.0)).collect();
    let moved = start.iter().map(|p| p + real_vector(rng, speed)).collect();
    let centre = real_vector(rng, 1.0);
    Draft {
        quaternions: turn(rng, degrees),
        centres: [centre, centre + real_vector(rng, speed)],
        local: (0..local).map(|_| real_vector(rng, 1.0)).collect(),
        world: [start, moved],
        radius: 0.0,
    }
}

fn uniform(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| anywhere(rng, 88.0, 1.0).aimed(rng))
}

fn integers(rng: &mut dyn Rng, reach: i32) -> Vector3<f64> {
    vector(rng, reach).map(f64::from)
}

fn lattice(rng: &mut dyn Rng) -> RigidQuery {
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
fn confined(rng: &mut dyn Rng) -> RigidQuery {
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
fn turned([w, x, y, z]: [i32; 4], p: Vector3<i32>) -> Vector3<i32> {
    let v = Vector3::new(x, y, z);
    p * (w * w - v.dot(&v)) + v * (2 * v.dot(&p)) + v.cross(&p) * (2 * w)
}

/// Contact at the time `i / n`, in integers: the quaternion there is `((n - i) q0 + i q1) / n`, and
/// points of the body are multiples of the square of its length.
fn grazing(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let is_double = rng.random_range(0..3) == 0;
        at_a_fraction(rng, is_double, false)
    })
}

/// Half of them moved by some ulps; beyond it means at a distance, which is the radius.
fn at_a_fraction(rng: &mut dyn Rng, is_double: bool, is_beyond: bool) -> Draft {
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

fn nearer([q0, q1]: [[i32; 4]; 2]) -> [[i32; 4]; 2] {
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

fn spin(rng: &mut dyn Rng) -> RigidQuery {
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

/// The points of a body without a turn: its orientation names the axes otherwise, or their signs.
fn translation(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let (world, local) = sides(rng);
        let unit = 2f64.powi(rng.random_range(-20..=-1));
        let mut point = || integers(rng, 1 << 6) * unit;
        let start = (0..world).map(|_| point()).collect();
        let end = (0..world).map(|_| point()).collect();
        let body = (0..local).map(|_| point()).collect();
        let centres = [point(), point()];
        const EXACT: [[f64; 4]; 4] = [
            [1.0, 0.0, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [1.0, 1.0, 1.0, 1.0],
            [1.0, 0.0, 0.0, 1.0],
        ];
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

fn plates(rng: &mut dyn Rng) -> RigidQuery {
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

fn scales(rng: &mut dyn Rng) -> RigidQuery {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle::decide_rigid_query;

    /// Hits, misses, and hits with `toi` at an end of the step, per family.
    #[test]
    fn rigid_families_have_hits_and_misses_of_both_kinds() {
        for family in RIGID_FAMILIES {
            let mut counts = [[0; 2]; 2];
            for index in 0..400 {
                let query = family.query(1, index);
                let kind = usize::from(query.kind() == "edge-turning-edge");
                let is_hit = decide_rigid_query(&query).hit.is_some();
                counts[kind][usize::from(is_hit)] += 1;
            }
            println!("{} {counts:?}", family.name());
            assert!(
                counts.as_flattened().iter().all(|&count| count >= 4),
                "{} {counts:?}",
                family.name()
            );
        }
    }
}
