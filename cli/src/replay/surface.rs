//! The surface of a body as polygons, in its frame.

use std::f64::consts::{PI, TAU};

use tunnelproof::query::Point;
use tunnelproof::wire::{Shape, Vector};

/// Sides of what is round.
const SIDES: usize = 32;

/// Points, and polygons of them by their indices, counterclockwise from outside.
pub(crate) struct Surface {
    pub(crate) points: Vec<Point>,
    pub(crate) polygons: Vec<Vec<usize>>,
}

impl Surface {
    /// Of a shape: a plane has none.
    pub(crate) fn of(shape: &Shape) -> Option<Surface> {
        match shape {
            Shape::Box { half } => Some(Surface::cuboid(half)),
            Shape::Cylinder {
                radius,
                half_height,
            } => Some(Surface::turned(&[
                [*radius, -half_height],
                [*radius, *half_height],
            ])),
            Shape::Sphere { radius } => Some(Surface::rounded(*radius, 0.0)),
            Shape::Capsule {
                radius,
                half_height,
            } => Some(Surface::rounded(*radius, *half_height)),
            Shape::Mesh(mesh) => Some(Surface {
                points: mesh.vertices().to_vec(),
                polygons: mesh.triangles().iter().map(|all| all.to_vec()).collect(),
            }),
            // A plane, or a shape that is not known here.
            _ => None,
        }
    }

    fn cuboid(half: &Vector) -> Surface {
        let sign = |corner: usize, axis: usize| if corner >> axis & 1 == 1 { 1.0 } else { -1.0 };
        let corner = |k: usize| {
            Point::new(
                sign(k, 0) * half.x,
                sign(k, 1) * half.y,
                sign(k, 2) * half.z,
            )
        };
        let polygons = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        Surface {
            points: (0..8).map(corner).collect(),
            polygons: polygons.map(Vec::from).to_vec(),
        }
    }

    /// A sphere whose halves are this far from the middle.
    fn rounded(radius: f64, half_height: f64) -> Surface {
        let rings = SIDES / 2;
        let ring = |k: usize| {
            let angle = PI * (k as f64 + 0.5) / rings as f64 - PI / 2.0;
            let from = if angle < 0.0 {
                -half_height
            } else {
                half_height
            };
            [radius * angle.cos(), from + radius * angle.sin()]
        };
        Surface::turned(&(0..rings).map(ring).collect::<Vec<_>>())
    }

    /// A profile of radii and heights, turned about the z axis and closed by flat ends.
    fn turned(profile: &[[f64; 2]]) -> Surface {
        let points = profile.iter().flat_map(|&[radius, height]| {
            (0..SIDES).map(move |side| {
                let angle = TAU * side as f64 / SIDES as f64;
                Point::new(radius * angle.cos(), radius * angle.sin(), height)
            })
        });
        let bands = (1..profile.len()).flat_map(|upper| {
            (0..SIDES).map(move |side| {
                let next = (side + 1) % SIDES;
                let [low, high] = [(upper - 1) * SIDES, upper * SIDES];
                vec![low + side, low + next, high + next, high + side]
            })
        });
        let top = profile.len().saturating_sub(1) * SIDES;
        let ends = [
            (0..SIDES).rev().collect(),
            (top..top + SIDES).collect::<Vec<_>>(),
        ];
        Surface {
            points: points.collect(),
            polygons: bands.chain(ends).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the divergence theorem.
    fn volume(surface: &Surface) -> f64 {
        let fan = |polygon: &Vec<usize>| -> f64 {
            let at = |k: usize| surface.points[polygon[k]].coords;
            let corners = 1..polygon.len() - 1;
            corners
                .map(|k| at(0).dot(&at(k).cross(&at(k + 1))) / 6.0)
                .sum()
        };
        surface.polygons.iter().map(fan).sum()
    }

    #[test]
    fn surfaces_are_closed_and_face_outwards() {
        let cuboid = Shape::Box {
            half: Vector::new(0.5, 1.0, 1.5),
        };
        let cylinder = Shape::Cylinder {
            radius: 1.0,
            half_height: 2.0,
        };
        let sphere = Shape::Sphere { radius: 1.0 };
        let capsule = Shape::Capsule {
            radius: 1.0,
            half_height: 2.0,
        };
        let exact = [6.0, 4.0 * PI, 4.0 / 3.0 * PI, 16.0 / 3.0 * PI];
        for (shape, exact) in [cuboid, cylinder, sphere, capsule].iter().zip(exact) {
            let share = volume(&Surface::of(shape).unwrap()) / exact;
            assert!((0.97..=1.0 + 1e-12).contains(&share), "{shape:?}: {share}");
        }
        assert!(Surface::of(&Shape::Plane).is_none());
    }
}
