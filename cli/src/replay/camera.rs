//! Perspective onto a picture.

use tunnelproof::query::Point;
use tunnelproof::wire::Vector;

/// Half of the height that is seen at a distance of 1.
const SLOPE: f64 = 0.36;

/// Looks along one way from so far that all is within a rectangle of the picture. Up is `z`.
pub(super) struct Camera {
    /// To the right, up, and towards the eye.
    axes: [Vector; 3],
    /// Of the eye along the axes.
    eye: Vector,
    /// The middle of the rectangle in pixels.
    middle: [f64; 2],
    /// Pixels of a length of 1 at a distance of 1.
    focal: f64,
}

/// A point on the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// In pixels.
    pub(super) at: [f64; 2],
    /// From the eye, along the way it looks, in m.
    pub(super) distance: f64,
}

/// A part of the picture in pixels.
#[derive(Clone, Copy)]
pub(super) struct Rectangle {
    pub(super) left: f64,
    pub(super) top: f64,
    pub(super) width: f64,
    pub(super) height: f64,
}

impl Camera {
    /// The camera nearest to points that sees all of them. Without points it sees some place.
    pub(super) fn fit(points: &[Point], room: Rectangle) -> Camera {
        let back = Vector::new(0.55, -1.05, 0.45).normalize();
        let right = Vector::z().cross(&back).normalize();
        let top = back.cross(&right);
        let most = |way: Vector| {
            let along = points.iter().map(|point| point.coords.dot(&way));
            along.fold(f64::NEG_INFINITY, f64::max)
        };
        // A point is within the rectangle if |x - middle| <= slope (distance - depth).
        let bounds = |way: Vector, slope: f64| {
            let [high, low] = [1.0, -1.0].map(|sign| most(sign * way + slope * back));
            [(high + low) / (2.0 * slope), (high - low) / 2.0]
        };
        let [wide, x] = bounds(right, SLOPE * room.width / room.height);
        let [tall, y] = bounds(top, SLOPE);
        let eye = match points {
            [] => Vector::new(0.0, 0.0, 1.0),
            // In front of all points even if they are one.
            _ => Vector::new(x, y, wide.max(tall).max(most(back) + 1e-3)),
        };
        Camera {
            axes: [right, top, back],
            eye,
            middle: [room.left + room.width / 2.0, room.top + room.height / 2.0],
            focal: room.height / (2.0 * SLOPE),
        }
    }

    /// Where a point is on the picture, unless it is not in front of the eye.
    pub(super) fn spot(&self, point: &Point) -> Option<Spot> {
        let [x, y, depth] = self.axes.map(|axis| point.coords.dot(&axis));
        let distance = self.eye.z - depth;
        let scale = self.focal / distance;
        (distance > 0.0).then(|| Spot {
            at: [
                self.middle[0] + scale * (x - self.eye.x),
                self.middle[1] - scale * (y - self.eye.y),
            ],
            distance,
        })
    }

    /// Pixels of a length at a distance.
    pub(super) fn pixels(&self, length: f64, distance: f64) -> f64 {
        length * self.focal / distance
    }

    /// How much a surface with this normal faces the eye, from -1 to 1.
    pub(super) fn facing(&self, normal: &Vector, at: &Point) -> f64 {
        let [right, top, back] = self.axes;
        let eye = right * self.eye.x + top * self.eye.y + back * self.eye.z;
        normal.dot(&(eye - at.coords).normalize())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn camera_sees_all_points_and_touches_the_border() {
        let points = [
            Point::new(-3.0, 0.2, 0.0),
            Point::new(5.0, 0.0, 0.4),
            Point::new(0.0, 9.0, -1.0),
        ];
        let room = Rectangle {
            left: 40.0,
            top: 20.0,
            width: 600.0,
            height: 200.0,
        };
        let camera = Camera::fit(&points, room);
        let spots = points.map(|point| camera.spot(&point).unwrap());
        let mut nearest = f64::INFINITY;
        for Spot {
            at: [x, y],
            distance,
        } in spots
        {
            assert!(distance > 0.0);
            for gap in [x - 40.0, 640.0 - x, y - 20.0, 220.0 - y] {
                assert!(gap > -1e-9, "{spots:?}");
                nearest = nearest.min(gap);
            }
        }
        assert!(nearest < 1e-9, "{spots:?}");
    }
}
