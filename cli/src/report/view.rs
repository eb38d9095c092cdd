//! From where to look at points in space, so that a flat picture shows them well.

use nalgebra::{Vector2, Vector3};

/// How many directions are tried.
const DIRECTIONS: u32 = 600;

/// A parallel projection.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    centre: Vector3<f64>,
    /// What the points are divided by before anything else, so that nothing overflows.
    unit: f64,
    right: Vector3<f64>,
    up: Vector3<f64>,
    /// Towards the viewer.
    toward: Vector3<f64>,
}

impl View {
    /// A view of `points` that separates them, and in which no edge between two of them that is in
    /// `edges` is looked at end on. Their longest extent is horizontal, and the z axis points up if
    /// it shows at all.
    pub(super) fn of(points: &[Vector3<f64>], edges: &[[usize; 2]]) -> Self {
        let largest = points.iter().map(Vector3::amax).fold(0.0, f64::max);
        let unit = if largest > 0.0 { largest } else { 1.0 };
        let scaled: Vec<_> = points.iter().map(|point| point / unit).collect();
        let centre = scaled.iter().sum::<Vector3<f64>>() / scaled.len().max(1) as f64;
        let pairs: Vec<_> = pairs(scaled.len())
            .map(|[i, j]| scaled[j] - scaled[i])
            .collect();
        let edges: Vec<_> = edges.iter().map(|&[i, j]| scaled[j] - scaled[i]).collect();
        let merit = |toward: &Vector3<f64>| separation(&pairs, &edges, toward);
        let toward = directions()
            .map(|toward| (merit(&toward), toward))
            .max_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(Vector3::z(), |best| best.1);
        let centred = scaled.iter().map(|point| point - centre);
        let right = longest_extent(centred, &toward);
        View {
            centre,
            unit,
            right,
            up: toward.cross(&right),
            toward,
        }
        .upright()
    }

    /// Turned in its plane by half a turn if that shows the z axis upwards (or else y to the
    /// right).
    fn upright(self) -> Self {
        let is_upright = match self.up.z.abs() > 1e-3 {
            true => self.up.z > 0.0,
            false => self.right.sum() > 0.0,
        };
        let sign = if is_upright { 1.0 } else { -1.0 };
        View {
            right: self.right * sign,
            up: self.up * sign,
            ..self
        }
    }

    /// Where a point is in the picture: to the right and upwards, in a unit of the view's own.
    pub(super) fn project(&self, point: &Vector3<f64>) -> Vector2<f64> {
        let point = point / self.unit - self.centre;
        Vector2::new(point.dot(&self.right), point.dot(&self.up))
    }

    /// This length across the picture, in the unit of the view.
    pub(super) fn length(&self, length: f64) -> f64 {
        length / self.unit
    }

    /// How near to the viewer a point is.
    pub(super) fn nearness(&self, point: &Vector3<f64>) -> f64 {
        (point / self.unit - self.centre).dot(&self.toward)
    }
}

/// How well a direction separates points: 1 for each of two parts if nothing is foreshortened.
fn separation(pairs: &[Vector3<f64>], edges: &[Vector3<f64>], toward: &Vector3<f64>) -> f64 {
    let seen = |difference: &Vector3<f64>| {
        let length = difference.norm();
        (length > 0.0).then(|| difference.cross(toward).norm() / length)
    };
    let shares: Vec<_> = pairs.iter().filter_map(seen).map(f64::sqrt).collect();
    let mean = shares.iter().sum::<f64>() / shares.len().max(1) as f64;
    let worst_edge = edges.iter().filter_map(seen).fold(1.0, f64::min);
    mean + worst_edge
}

fn pairs(count: usize) -> impl Iterator<Item = [usize; 2]> {
    (0..count).flat_map(move |j| (0..j).map(move |i| [i, j]))
}

/// Directions spread evenly over a hemisphere (a Fibonacci lattice), after those of the axes.
fn directions() -> impl Iterator<Item = Vector3<f64>> {
    let golden_angle = std::f64::consts::PI * (3.0 - 5f64.sqrt());
    let spread = (0..DIRECTIONS).map(move |i| {
        let z = (f64::from(i) + 0.5) / f64::from(DIRECTIONS);
        let (sin, cos) = (golden_angle * f64::from(i)).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        Vector3::new(radius * cos, radius * sin, z)
    });
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    spread.chain(axes)
}

/// The unit vector across `toward` along which points vary most.
fn longest_extent(
    points: impl Iterator<Item = Vector3<f64>>,
    toward: &Vector3<f64>,
) -> Vector3<f64> {
    let helper = if toward.x.abs() < 0.9 {
        Vector3::x()
    } else {
        Vector3::y()
    };
    let first = toward.cross(&helper).normalize();
    let second = toward.cross(&first);
    let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
    for point in points {
        let (x, y) = (point.dot(&first), point.dot(&second));
        (xx, xy, yy) = (xx + x * x, xy + x * y, yy + y * y);
    }
    let angle = 0.5 * f64::atan2(2.0 * xy, xx - yy);
    first * angle.cos() + second * angle.sin()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn view_of_a_plane_shows_it_undistorted() {
        let normal = Vector3::new(1.0, 2.0, -2.0) / 3.0;
        let across = Vector3::new(2.0, 1.0, 2.0) / 3.0;
        let along = normal.cross(&across);
        let points = [(0.0, 0.0), (4.0, 0.0), (1.0, 2.0), (3.0, -1.0)]
            .map(|(x, y)| across * x + along * y + normal * 7.0);
        let view = View::of(&points, &[[0, 1], [2, 3]]);
        for [i, j] in pairs(4) {
            let seen = (view.project(&points[i]) - view.project(&points[j])).norm() * view.unit;
            let length = (points[i] - points[j]).norm();
            assert!(seen > 0.98 * length && seen < 1.0001 * length);
        }
    }

    #[test]
    fn view_looks_at_no_edge_end_on() {
        let points = [
            Vector3::new(0.0, 0.0, -1.0),
            Vector3::new(0.0, 0.0, 1.0),
            Vector3::new(1.0, -0.5, 0.0),
            Vector3::new(2.0, 0.5, 0.3),
        ];
        let view = View::of(&points, &[[0, 1], [2, 3]]);
        for [i, j] in [[0, 1], [2, 3]] {
            let seen = (view.project(&points[i]) - view.project(&points[j])).norm() * view.unit;
            assert!(seen > 0.5 * (points[i] - points[j]).norm());
        }
    }

    #[test]
    fn view_shows_the_z_axis_upwards() {
        let points = [
            Vector3::new(0.0, 0.0, 0.0),
            Vector3::new(1.0, 0.0, 0.2),
            Vector3::new(0.3, 0.1, 0.9),
        ];
        let view = View::of(&points, &[]);
        let [low, high] = [points[0], Vector3::z()].map(|point| view.project(&point).y);
        assert!(high > low);
    }
}
