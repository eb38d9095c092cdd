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
/// Either the directions keep still and the coefficients `k` differ between the ends of the step,
/// or the other way round.
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

/// Shifts points of a motion aside at the start of the step and to the other side at its end, so
/// that each is where it was at one time, `before / (before + after)` with both from 1 to 4.
pub(super) fn swing(rng: &mut dyn Rng, motion: &mut Motion<i32>, points: &[usize], reach: i32) {
    let aside: Vector3<i32> = vector(rng, reach);
    let [before, after] = [(); 2].map(|()| rng.random_range(1..=4));
    for &point in points {
        motion[0][point] += aside * before;
        motion[1][point] -= aside * after;
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Matrix3;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    use super::*;

    /// `B - A`, `C - A` and `D - A` at these parts of the step, times their sum.
    fn differences(motion: &Motion<i32>, parts: [i64; 2]) -> Matrix3<i64> {
        let at = |i: usize| {
            let [start, end] = [0, 1].map(|end| motion[end][i].map(i64::from));
            start * parts[0] + end * parts[1]
        };
        Matrix3::from_columns(&[1, 2, 3].map(|i| at(i) - at(0)))
    }

    #[test]
    fn confined_motion_stays_in_its_line_or_plane_for_the_whole_step() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..2000 {
            let reach = Reach::wide(&mut rng);
            let planar = confined::<2>(&mut rng, [0; 4], &reach);
            let linear = confined::<1>(&mut rng, [0; 4], &reach);
            // A polynomial of degree 3 is 0 if it is at four points.
            for parts in [[1, 0], [0, 1], [1, 1], [2, -1]] {
                assert_eq!(det(&differences(&planar, parts)), 0);
                let [b, c, d] =
                    [0, 1, 2].map(|i| differences(&linear, parts).column(i).into_owned());
                for cross in [b.cross(&c), c.cross(&d), d.cross(&b)] {
                    assert_eq!(cross, Vector3::zeros());
                }
            }
        }
    }

    fn det(m: &Matrix3<i64>) -> i128 {
        let [x, y, z] = [0, 1, 2].map(|i| m.column(i).map(i128::from));
        x.cross(&y).dot(&z)
    }

    #[test]
    fn swing_leaves_points_in_their_place_at_one_time_of_the_step() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for _ in 0..200 {
            let mut motion = [[Vector3::zeros(); 4]; 2];
            swing(&mut rng, &mut motion, &[1, 3], 100);
            let [start, end] = motion;
            assert_eq!([start[0], start[2], end[0], end[2]], [Vector3::zeros(); 4]);
            assert_eq!((start[1], end[1]), (start[3], end[3]));
            assert!(start[1].dot(&end[1]) < 0 && start[1].cross(&end[1]) == Vector3::zeros());
        }
    }
}
