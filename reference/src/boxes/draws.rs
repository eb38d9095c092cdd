//! One property that is probed, each: how a box and another body lie and move, in integers.

use nalgebra::{Matrix3, Vector3};
use rand::{Rng, RngExt};
use tunnelproof::query::Point;

use super::body::{Body, BoxCast, Shape};
use crate::generate::{integer_rotation, random_vector};

type Place = Vector3<i32>;

/// What a box is cast against.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Other {
    /// A box; both are along the axes.
    Box,
    /// A box; both are turned by rotations of their own.
    Turned,
    /// A capsule, or of 4 in 1 a sphere.
    Round,
    /// A triangle.
    Face,
    /// A segment.
    Thin,
}

/// A body in integers, at the start.
#[derive(Clone)]
struct Solid {
    shape: Shape,
    /// As those of a [`Body`].
    points: Vec<Place>,
    radius: i32,
}

impl Solid {
    /// A box along the axes about the origin.
    fn cuboid(halves: Place) -> Self {
        let corner = -halves;
        let beside = (0..3).map(|axis| {
            let mut point = corner;
            point[axis] = halves[axis];
            point
        });
        Solid {
            shape: Shape::Box,
            points: std::iter::once(corner).chain(beside).collect(),
            radius: 0,
        }
    }

    /// A box with halves of its sides up to this, turned if `other` is.
    fn any_box(rng: &mut dyn Rng, other: Other, reach: i32) -> Self {
        let turned = other == Other::Turned;
        // A rotation makes all lengths larger, by 16 at most.
        let reach = if turned { (reach / 8).max(1) } else { reach };
        let halves = Vector3::from_fn(|_, _| rng.random_range(1..=reach));
        let rotation = match turned {
            true => turn(rng),
            false => Matrix3::identity(),
        };
        Solid::cuboid(halves).mapped(&rotation)
    }

    /// A body that a box is cast against, about the origin: with coordinates up to this, and a radius
    /// of up to a quarter of it.
    fn other(rng: &mut dyn Rng, other: Other, reach: i32) -> Self {
        let mut points = |count: usize| -> Vec<Place> {
            (0..count).map(|_| random_vector(rng, reach)).collect()
        };
        let (shape, points) = match other {
            Other::Box | Other::Turned => return Solid::any_box(rng, other, reach),
            Other::Face => (Shape::Triangle, points(3)),
            Other::Thin => (Shape::Edge, points(2)),
            Other::Round => {
                let points = points(2);
                match rng.random_range(0..4) {
                    0 => (Shape::Sphere, points[..1].to_vec()),
                    _ => (Shape::Edge, points),
                }
            }
        };
        let radius = match other {
            Other::Round => rng.random_range(1..=(reach / 4).max(1)),
            _ => 0,
        };
        Solid {
            shape,
            points,
            radius,
        }
    }

    fn mapped(mut self, map: &Matrix3<i32>) -> Self {
        self.points
            .iter_mut()
            .for_each(|point| *point = map * *point);
        self
    }

    fn moved(mut self, by: Place) -> Self {
        self.points.iter_mut().for_each(|point| *point += by);
        self
    }

    fn corners(&self) -> Vec<Place> {
        let origin = self.points[0];
        match self.shape {
            Shape::Box => {
                let corner = |number: usize| {
                    let far = (0..3).filter(|side| number >> side & 1 == 1);
                    far.fold(origin, |corner, side| {
                        corner + self.points[side + 1] - origin
                    })
                };
                (0..8).map(corner).collect()
            }
            _ => self.points.clone(),
        }
    }

    /// The least and the largest height, with the radius.
    fn heights(&self) -> [i32; 2] {
        let heights = || self.corners().into_iter().map(|corner| corner.z);
        let [low, high] = [heights().min(), heights().max()].map(Option::unwrap_or_default);
        [low - self.radius, high + self.radius]
    }

    /// A random corner.
    fn corner(&self, rng: &mut dyn Rng) -> Place {
        let corners = self.corners();
        corners[rng.random_range(0..corners.len())]
    }

    fn body(&self, step: Place, unit: f64) -> Body {
        let metres = |place: &Place| place.map(f64::from) * unit;
        let points: Vec<Point> = self.points.iter().map(|p| Point::from(metres(p))).collect();
        let radius = f64::from(self.radius) * unit;
        Body::new(self.shape, &points, metres(&step), radius)
            .expect("integers below 2^23 are exact, and a rotation keeps right angles")
    }
}

/// The cast of two bodies with these translations, in this unit; either of them is the first.
fn cast(rng: &mut dyn Rng, solids: [Solid; 2], steps: [Place; 2], exponent: i32) -> BoxCast {
    let unit = 2f64.powi(exponent);
    let [first, second] = [0, 1].map(|i: usize| solids[i].body(steps[i], unit));
    let bodies = match rng.random() {
        true => [first, second],
        false => [second, first],
    };
    BoxCast::new(bodies).expect("the first is a box")
}

/// A rotation, with all lengths larger, that does not map axes to axes.
fn turn(rng: &mut dyn Rng) -> Matrix3<i32> {
    loop {
        let (rotation, _) = integer_rotation(rng);
        if rotation.iter().filter(|entry| **entry != 0).count() > 3 {
            return rotation;
        }
    }
}

/// A map that permutes the axes and reverses some.
fn signed_permutation(rng: &mut dyn Rng) -> Matrix3<i32> {
    let mut axes = [0, 1, 2];
    for i in (1..3).rev() {
        axes.swap(i, rng.random_range(0..=i));
    }
    let mut map = Matrix3::zeros();
    for (row, axis) in axes.into_iter().enumerate() {
        map[(row, axis)] = if rng.random() { 1 } else { -1 };
    }
    map
}

/// 0 in half of the cases, else up to `2^10`, each power of two as often, of either sign.
fn nudge(rng: &mut dyn Rng) -> i32 {
    if rng.random() {
        return 0;
    }
    let octave = rng.random_range(0..=10);
    let size = rng.random_range(1..=1 << octave);
    if rng.random() { size } else { -size }
}

/// Two bodies of up to half of `reach`, their places up to `reach` from `origin`, and translations of
/// up to as much, half of them aimed at each other.
fn general(rng: &mut dyn Rng, other: Other, reach: i32, origin: Place) -> ([Solid; 2], [Place; 2]) {
    let solids = [
        Solid::any_box(rng, other, reach / 2),
        Solid::other(rng, other, reach / 2),
    ];
    let places = [(); 2].map(|()| random_vector(rng, reach));
    let mut steps = [(); 2].map(|()| random_vector(rng, reach));
    if rng.random() {
        let times = rng.random_range(1..=2);
        let aside = random_vector(rng, reach / 4);
        steps[1] = steps[0] + (places[0] - places[1]) * times + aside;
    }
    let [first, second] = solids;
    let [at, other_at] = places.map(|place| origin + place);
    ([first.moved(at), second.moved(other_at)], steps)
}

/// Places evenly from `[-1, 1]`, halves of sides up to 1/2.
pub(super) fn uniform(rng: &mut dyn Rng, other: Other) -> BoxCast {
    let (solids, steps) = general(rng, other, 1 << 20, Place::zeros());
    cast(rng, solids, steps, -20)
}

/// Small integers: every degeneracy exactly and often.
pub(super) fn lattice(rng: &mut dyn Rng, other: Other) -> BoxCast {
    let reach = rng.random_range(1..=3);
    let solids = [
        Solid::any_box(rng, other, 3),
        Solid::other(rng, other, reach),
    ];
    let solids = solids.map(|solid| solid.moved(random_vector(rng, 2 * reach)));
    let steps = [(); 2].map(|()| random_vector(rng, 3) * 2);
    cast(rng, solids, steps, -1)
}

/// Two bodies on each other, with a gap between the planes of height that they are beyond: a corner
/// of one above a corner of the other.
fn stacked(rng: &mut dyn Rng, other: Other, reach: i32, gap: i32) -> [Solid; 2] {
    let below = Solid::any_box(rng, other, reach);
    let above = Solid::other(rng, other, reach);
    let [_, top] = below.heights();
    let [bottom, _] = above.heights();
    let mut way = below.corner(rng) - above.corner(rng);
    way += random_vector(rng, reach / 4);
    way.z = top + gap - bottom;
    [below, above.moved(way)]
}

/// Bodies and the translation of the second, at the given time of the step, in a space whose axes are
/// permuted; the first body is carried along by a random translation.
fn placed(
    rng: &mut dyn Rng,
    solids: [Solid; 2],
    passing: Place,
    [before, after]: [i32; 2],
    exponent: i32,
) -> BoxCast {
    let map = signed_permutation(rng);
    let origin = random_vector(rng, 1 << 20);
    let carried = random_vector(rng, 1 << 18);
    let [first, second] = solids;
    let solids = [first, second.moved(-passing * before)];
    let solids = solids.map(|solid| solid.mapped(&map).moved(origin));
    let steps = [carried, carried + map * (passing * (before + after))];
    cast(rng, solids, steps, exponent)
}

/// How much of the step is before and after the time that a family is made at.
fn times(rng: &mut dyn Rng) -> [i32; 2] {
    let [before, after] = [(); 2].map(|()| rng.random_range(1..=8));
    match rng.random_range(0..4) {
        0 => [0, after],
        1 => [before, 0],
        _ => [before, after],
    }
}

/// Bodies that slide along the plane of a face, exactly or up to a few units off it, or meet in it at
/// an end of the step.
pub(super) fn grazing(rng: &mut dyn Rng, other: Other) -> BoxCast {
    const REACH: i32 = 1 << 12;
    let gap = nudge(rng);
    let solids = stacked(rng, other, REACH, gap);
    let mut passing = random_vector(rng, REACH / 2);
    passing.z = 0;
    let mut times = times(rng);
    if rng.random_range(0..4) == 0 {
        let steps = rng.random_range(1..=8);
        let is_down: bool = rng.random();
        times = if is_down { [steps, 0] } else { [0, steps] };
        let height = rng.random_range(1..REACH);
        passing.z = if is_down { -height } else { height };
    }
    placed(rng, solids, passing, times, -18)
}

/// A beam of up to 64 m whose other sides are millimetres to centimetres, and a small body.
pub(super) fn long_thin(rng: &mut dyn Rng, other: Other) -> BoxCast {
    let mut halves = Vector3::from_fn(|_, _| rng.random_range(1..=1 << 3));
    halves[rng.random_range(0..3)] = rng.random_range(1 << 10..=1 << 15);
    let beam = Solid::cuboid(halves);
    let small = Solid::other(rng, other, 1 << 5);
    let on_beam = halves.map(|half| rng.random_range(-half..=half));
    let small = small.moved(on_beam + random_vector(rng, 1 << 5));
    let passing = random_vector(rng, 1 << 6);
    let times = times(rng);
    placed(rng, [beam, small], passing, times, -10)
}

/// Bodies of some centimetres with steps of as much, up to 512 m off the origin along each axis.
pub(super) fn far(rng: &mut dyn Rng, other: Other) -> BoxCast {
    let offset = random_vector(rng, (1 << 22) - (1 << 12));
    let (solids, steps) = general(rng, other, 1 << 9, offset);
    cast(rng, solids, steps, -13)
}

/// Bodies that are in contact up to a few units, and move by a few units.
pub(super) fn tiny(rng: &mut dyn Rng, other: Other) -> BoxCast {
    let gap = rng.random_range(-3..=3);
    let solids = stacked(rng, other, 1 << 12, gap);
    let passing = random_vector(rng, 1);
    let times = times(rng);
    placed(rng, solids, passing, times, -20)
}

/// Bodies in contact at the start: of 4, in 2 by overlap, one inside the other in some, and in 2 just
/// so or up to two units off it. They move anywhere.
pub(super) fn start(rng: &mut dyn Rng, other: Other) -> BoxCast {
    const REACH: i32 = 1 << 12;
    let passing = random_vector(rng, REACH);
    let solids = match rng.random_range(0..4) {
        // A corner of the other is inside the box.
        0..2 => {
            let large = Solid::any_box(rng, other, REACH);
            let size = rng.random_range(8..=11);
            let other = Solid::other(rng, other, 1 << size);
            let corner = other.corner(rng);
            let share = rng.random_range(0..=8);
            let inside = large.corner(rng) * share / 16;
            [large, other.moved(inside - corner)]
        }
        2 => stacked(rng, other, REACH, 0),
        _ => {
            let gap = rng.random_range(-2..=2);
            stacked(rng, other, REACH, gap)
        }
    };
    placed(rng, solids, passing, [0, 8], -18)
}
