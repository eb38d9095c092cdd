//! Motion confined to a line or a plane for the whole step, in integers.

use nalgebra::Vector3;
use rand::{Rng, RngExt};

use super::motion::{Motion, power_of_two, vector};

/// The largest coordinate of what a confined motion is made of.
pub(super) struct Reach {
    pub(super) directions: i32,
    pub(super) coefficients: i32,
    pub(super) origins: i32,
}

impl Reach {
    /// Up to eight bits each, so that products round once they are multiplied in `f64`.
    pub(super) fn wide(rng: &mut dyn Rng) -> Self {
        Reach {
            directions: power_of_two(rng, 0..=8),
            coefficients: power_of_two(rng, 1..=8),
            origins: power_of_two(rng, 0..=8),
        }
    }
}

/// Each point `X = O + sum of k P` over the `DIMENSION` directions `P`, which all points share, and
/// with the origin `O` of the number that `origins` gives for the point.
///
/// Either the directions keep still and the coefficients `k` differ between the ends of the step, or
/// the other way round.
pub(super) fn confined<const DIMENSION: usize>(
    rng: &mut dyn Rng,
    origins: [usize; 4],
    reach: &Reach,
) -> Motion<i32> {
    let is_carried = rng.random();
    let directions = ends(rng, is_carried, |rng| {
        [(); DIMENSION].map(|()| vector(rng, reach.directions))
    });
    let coefficients = ends(rng, !is_carried, |rng| {
        let bound = reach.coefficients;
        [(); 4].map(|()| [(); DIMENSION].map(|()| rng.random_range(-bound..=bound)))
    });
    [0, 1].map(|end| {
        let origin = [vector(rng, reach.origins), vector(rng, reach.origins)];
        [0, 1, 2, 3].map(|point| {
            let terms = directions[end].iter().zip(coefficients[end][point]);
            terms.fold(origin[origins[point]], |sum, (p, k)| sum + p * k)
        })
    })
}

/// What is drawn for the start and the end of the step: twice if it changes, else once for both.
fn ends<T: Copy>(rng: &mut dyn Rng, changes: bool, draw: impl Fn(&mut dyn Rng) -> T) -> [T; 2] {
    let start = draw(rng);
    [start, if changes { draw(rng) } else { start }]
}

/// Shifts points of a motion aside at the start of the step and to the other side at its end, so that
/// each is where it was at one time, `before / (before + after)` with both from 1 to 4.
pub(super) fn swing(rng: &mut dyn Rng, motion: &mut Motion<i32>, points: &[usize], reach: i32) {
    let aside: Vector3<i32> = vector(rng, reach);
    let [before, after] = [(); 2].map(|()| rng.random_range(1..=4));
    for &point in points {
        motion[0][point] += aside * before;
        motion[1][point] -= aside * after;
    }
}
