//! Two bodies that both turn.

use nalgebra::Vector3;
use rand::{Rng, RngExt};
use tunnelproof::rigid::{RigidQuery, Side};

use super::RigidFamily;
use super::draft::{first_query, integers, motion, nudge, points, sides, turn, way_to_contact};
use super::one::{EXACT, nearer, turned};
use crate::generate::motion::{not_zero, real_vector, vector};

pub(super) const UNIFORM: RigidFamily = RigidFamily {
    name: "turning_bodies_uniform",
    description: "two bodies: random poses at most 88 degrees apart, random points",
    draw: uniform,
};

pub(super) const LATTICE: RigidFamily = RigidFamily {
    name: "turning_bodies_lattice",
    description: "two bodies: small integers in quaternions and points, some of them the same",
    draw: lattice,
};

pub(super) const CONFINED: RigidFamily = RigidFamily {
    name: "turning_bodies_confined",
    description: "two bodies: in a plane, on an axis or parallel for the whole step, or nearly",
    draw: confined,
};

pub(super) const GRAZING: RigidFamily = RigidFamily {
    name: "turning_bodies_grazing",
    description: "two bodies: contact at corners and at a fraction of the step, or nearly",
    draw: grazing,
};

pub(super) const STILL: RigidFamily = RigidFamily {
    name: "turning_bodies_still",
    description: "two bodies, of which the first does not turn, in exact coordinates",
    draw: still,
};

pub(super) const SCALES: RigidFamily = RigidFamily {
    name: "turning_bodies_scales",
    description: "two bodies: lengths from 1e-6 to 1e6, and quaternions of any length",
    draw: scales,
};

/// The numbers of a query, before they are checked.
pub(super) struct Draft {
    pub(super) first: Body,
    pub(super) second: Body,
}

pub(super) struct Body {
    pub(super) centres: [Vector3<f64>; 2],
    /// w, x, y, z.
    pub(super) quaternions: [[f64; 4]; 2],
    pub(super) local: Vec<Vector3<f64>>,
}

impl Body {
    fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        let lengths = self.centres.iter_mut().chain(&mut self.local);
        lengths
            .flat_map(|v| v.iter_mut())
            .chain(self.quaternions.iter_mut().flatten())
    }
}

impl Draft {
    /// `None` if a body turns too far.
    pub(super) fn query(&self) -> Option<RigidQuery> {
        let motion = |body: &Body| motion(&body.centres, &body.quaternions);
        let motions = [motion(&self.first)?, motion(&self.second)?];
        let (first, second) = (points(&self.first.local), points(&self.second.local));
        let sides = [(&first, &motions[0]), (&second, &motions[1])];
        let sides = sides.map(|(local, motion)| Side::Turning { local, motion });
        RigidQuery::new(sides, 0.0).ok()
    }

    /// Half of them with the first body moved so that the two about meet at some time.
    fn aimed(mut self, rng: &mut dyn Rng) -> Self {
        if let Some(way) = way_to_contact(rng, self.query()) {
            self.first.centres.iter_mut().for_each(|c| *c += way);
        }
        self
    }

    /// Moves two numbers by up to `2^20` ulp, or not.
    fn nudged(mut self, rng: &mut dyn Rng) -> Self {
        let numbers = self.first.numbers().chain(self.second.numbers());
        nudge(rng, numbers.collect());
        self
    }
}

/// Draws until no body turns by more than it may.
fn first(rng: &mut dyn Rng, draft: impl Fn(&mut dyn Rng) -> Draft) -> RigidQuery {
    first_query(rng, |rng| draft(rng).query())
}

fn anywhere(rng: &mut dyn Rng, degrees: f64, speed: f64) -> Draft {
    let (one, other) = sides(rng);
    let mut body = |points: usize| {
        let centre = real_vector(rng, 1.0);
        Body {
            quaternions: turn(rng, degrees),
            centres: [centre, centre + real_vector(rng, speed)],
            local: (0..points).map(|_| real_vector(rng, 1.0)).collect(),
        }
    };
    Draft {
        first: body(one),
        second: body(other),
    }
}

pub(super) fn uniform(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| anywhere(rng, 88.0, 1.0).aimed(rng))
}

/// Now and then both move alike, or have a point in common, or a side is a point.
pub(super) fn lattice(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let (one, other) = sides(rng);
        let reach = rng.random_range(1..=3);
        let mut body = |points: usize| {
            let centre = integers(rng, 1);
            Body {
                centres: match rng.random() {
                    true => [centre, integers(rng, 1)],
                    false => [centre; 2],
                },
                quaternions: [(); 2]
                    .map(|()| [(); 4].map(|()| f64::from(rng.random_range(-2..=2)))),
                local: (0..points).map(|_| integers(rng, reach)).collect(),
            }
        };
        let mut draft = Draft {
            first: body(one),
            second: body(other),
        };
        match rng.random_range(0..12) {
            0 => {
                draft.first.centres = draft.second.centres;
                draft.first.quaternions = draft.second.quaternions;
            }
            1 => draft.first.centres = draft.second.centres,
            2 => draft.second.local[1] = draft.second.local[0],
            3 => {
                let point = draft.first.local[0];
                draft.first.local.fill(point);
            }
            4 => draft.second.local[0] = Vector3::zeros(),
            _ => {}
        }
        draft
    })
}

/// Both turn about z, with all points in a plane across it, on the axis, or edges parallel to it.
fn confined(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let (one, other) = sides(rng);
        let kind = rng.random_range(0..8);
        let lift = [(); 2].map(|()| f64::from(rng.random_range(-2..=2)));
        let mut body = |points: usize| {
            let mut point = |reach: i32| match kind {
                0 => Vector3::new(0.0, 0.0, f64::from(rng.random_range(-3..=3))),
                _ => {
                    let p = integers(rng, reach);
                    Vector3::new(p.x, p.y, 0.0)
                }
            };
            let centres = [point(2), point(2)];
            let mut local: Vec<_> = (0..points).map(|_| point(3)).collect();
            if kind == 1 && points == 2 {
                local[1] = local[0] + Vector3::z() * f64::from(not_zero(rng, 3));
            }
            Body {
                centres: [0, 1].map(|i| centres[i] + Vector3::z() * lift[i]),
                quaternions: [(); 2].map(|()| {
                    let [w, z] = [(); 2].map(|()| f64::from(rng.random_range(-3..=3)));
                    [w, 0.0, 0.0, z]
                }),
                local,
            }
        };
        let draft = Draft {
            first: body(one),
            second: body(other),
        };
        match rng.random_range(0..3) {
            0 => draft.nudged(rng),
            _ => draft,
        }
    })
}

/// A body in integers that touches at the time `i / n`.
struct Integral {
    ends: [[i32; 4]; 2],
    /// The quaternion at that time, times `n`, and the square of its length.
    q: [i32; 4],
    size: i32,
}

impl Integral {
    fn new(rng: &mut dyn Rng, i: i32, n: i32) -> Self {
        let ends = [(); 2].map(|()| [(); 4].map(|()| rng.random_range(-2..=2)));
        let [q0, q1] = nearer(ends);
        let q = [0, 1, 2, 3].map(|h| (n - i) * q0[h] + i * q1[h]);
        Integral {
            ends,
            q,
            size: q.iter().map(|x| x * x).sum(),
        }
    }

    /// The body with these points, times the square of the length and eight, so that it turns eighths
    /// of their differences into integers; about a centre then.
    fn body(
        &self,
        rng: &mut dyn Rng,
        points: &[Vector3<i32>],
        centre: Vector3<i32>,
        parts: [i32; 2],
    ) -> Body {
        let speed = vector(rng, 4);
        let [before, after] = parts;
        Body {
            centres: [centre - speed * before, centre + speed * after].map(|c| c.map(f64::from)),
            quaternions: self.ends.map(|q| q.map(f64::from)),
            local: points
                .iter()
                .map(|p| (p * (8 * self.size)).map(f64::from))
                .collect(),
        }
    }
}

/// Contact at the time `i / n`, in integers: of a corner of the first side or a place on its edge,
/// with one on an edge of the second side. A third of them is moved by some ulps.
fn grazing(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let (one, other) = sides(rng);
        let n = rng.random_range(1..=4);
        let i = rng.random_range(0..=n);
        let [first, second] = [(); 2].map(|()| Integral::new(rng, i, n));
        let mut side = |points: usize| (0..points).map(|_| vector(rng, 3)).collect::<Vec<_>>();
        let (own, others) = (side(one), side(other));
        // Eight times a place on the first edge of each.
        let mut place = |points: &[Vector3<i32>]| {
            let share = rng.random_range(0..=8);
            points[0] * (8 - share) + points[points.len() - 1] * share
        };
        let (at_first, at_second) = (place(&own), place(&others));
        let centre = vector(rng, 4);
        let other = centre + turned(second.q, at_second) - turned(first.q, at_first);
        let parts = [i, n - i];
        let draft = Draft {
            first: first.body(rng, &own, other, parts),
            second: second.body(rng, &others, centre, parts),
        };
        match rng.random_range(0..3) {
            0 => draft.nudged(rng),
            _ => draft,
        }
    })
}

/// The first body does not turn, and its orientation names the axes otherwise: its points move on
/// lines, in numbers that are exact.
pub(super) fn still(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let mut draft = anywhere(rng, 88.0, 1.0).aimed(rng);
        let unit = 2f64.powi(rng.random_range(-20..=-4));
        let round = |v: &mut Vector3<f64>| *v = v.map(|x| (x / unit).round() * unit);
        draft.first.centres.iter_mut().for_each(round);
        draft.first.local.iter_mut().for_each(round);
        let q = EXACT[rng.random_range(0..EXACT.len())];
        let lengths = [(); 2].map(|()| f64::from(not_zero(rng, 3)));
        draft.first.quaternions = lengths.map(|length| q.map(|x| x * length));
        draft
    })
}

fn scales(rng: &mut dyn Rng) -> RigidQuery {
    first(rng, |rng| {
        let mut draft = anywhere(rng, 88.0, 1.0);
        let all = 10f64.powf(rng.random_range(-6.0..6.0));
        for body in [&mut draft.first, &mut draft.second] {
            let own = 10f64.powf(rng.random_range(-3.0..3.0));
            let lengths = [(); 2].map(|()| 10f64.powf(rng.random_range(-3.0..3.0)));
            body.centres.iter_mut().for_each(|c| *c *= all);
            body.local.iter_mut().for_each(|p| *p *= all * own);
            let is_same: bool = rng.random();
            for (q, length) in body.quaternions.iter_mut().zip(lengths) {
                let length = if is_same { lengths[0] } else { length };
                *q = q.map(|x| x * length);
            }
        }
        draft.aimed(rng)
    })
}
