//! What the edges look like at the time of impact: contact points, parameters, normal and flags
//! (thesis 2.2.2, figure 4.11, table 4.1).
//!
//! The algorithms return a time. What touches where is found here from the positions at that time,
//! which are interpolated between the ends of the step and so are finite whatever the input.

use nalgebra::Vector3;

use super::detect::{detect_case3, same_for_whole_step};
use super::given::{length, static_equality};
use super::motion::Motion;
use super::options::Options;
use crate::contact::{Case, Contact, ContactPoint, EdgePoint, Flags};
use crate::query::{EdgeEdge, Point};

/// The contact at `toi` of a motion of the given case, and the configuration there.
///
/// Edges that are parallel at `toi` touch in the ends of their overlap: one point if those are
/// identical by [`Thresholds::dist`](super::Thresholds::dist), else two, in ascending `u`. Other
/// edges touch in the closest points of both. All parameters are in `[0, 1]`, and 0 on an edge that
/// is a point. Whether the edges do touch at `toi` is the algorithms' claim; it is not checked.
pub fn contact_at(
    toi: f64,
    query: &EdgeEdge,
    case: Case,
    points: &[Motion; 4],
    options: &Options,
) -> (Contact, Flags) {
    let shape = Shape::at(toi, query, case, options);
    let contact_point = |(u, v)| ContactPoint {
        point: Point::from(between(&shape.positions[0], &shape.positions[1], u)),
        weights: EdgePoint { u, v }.weights(),
        relative_velocity: relative_velocity(points, u, v),
    };
    let (first, second) = shape.parameters(options.thresholds.dist);
    let contact = Contact {
        toi,
        first: contact_point(first),
        second: second.map(contact_point),
        normal: None,
    };
    (contact, shape.flags(points, options))
}

/// The configuration at one time.
struct Shape {
    positions: [Vector3<f64>; 4],
    /// Whether AB and CD are points.
    is_point: [bool; 2],
    /// Whether both are edges, and parallel.
    is_parallel: bool,
}

impl Shape {
    /// By the questions of Algorithm 16: points first, then parallel.
    fn at(t: f64, query: &EdgeEdge, case: Case, options: &Options) -> Shape {
        let positions: [Vector3<f64>; 4] = std::array::from_fn(|point| {
            between(&query.start()[point].coords, &query.end()[point].coords, t)
        });
        let [a, b, c, d] = &positions;
        let (r, s) = (b - a, d - c);
        let zero = Vector3::zeros();
        let thresholds = &options.thresholds;
        let is_point = [r, s].map(|x| static_equality(&x, &zero, thresholds.direction));
        let is_parallel = matches!(case, Case::Collinear | Case::Parallel)
            || static_equality(&s.cross(&r), &zero, thresholds.parallel);
        Shape {
            positions,
            is_point,
            is_parallel: is_parallel && is_point == [false, false],
        }
    }

    /// `(u, v)` of the contact, and of its other end if it is more than a point.
    fn parameters(&self, dist: f64) -> ((f64, f64), Option<(f64, f64)>) {
        let [a, b, c, d] = &self.positions;
        match self.is_point {
            [true, true] => ((0.0, 0.0), None),
            [true, false] => ((0.0, unit(along(a, c, d))), None),
            [false, true] => ((unit(along(c, a, b)), 0.0), None),
            [false, false] if self.is_parallel => self.overlap(dist),
            [false, false] => (self.closest(), None),
        }
    }

    /// The ends of the overlap of edges on one line (equations 3.16 and 3.17).
    fn overlap(&self, dist: f64) -> ((f64, f64), Option<(f64, f64)>) {
        let [a, b, c, d] = &self.positions;
        let (uc, ud) = (along(c, a, b), along(d, a, b));
        let (low, high) = (unit(uc.min(ud)), unit(uc.max(ud)));
        let (from, to) = (between(a, b, low), between(a, b, high));
        let first = (low, unit(along(&from, c, d)));
        let second = (high, unit(along(&to, c, d)));
        let is_one_point = static_equality(&from, &to, dist);
        (first, (!is_one_point).then_some(second))
    }

    /// The closest points of edges that are not parallel.
    ///
    /// `u = ((C - A) × S) · N / N²` with `N = R × S` is where the lines are closest; where that is
    /// outside of an edge, its nearest point is projected to the other edge.
    fn closest(&self) -> (f64, f64) {
        let [a, b, c, d] = &self.positions;
        let (r, s) = (b - a, d - c);
        let n = r.cross(&s);
        let u = unit((c - a).cross(&s).dot(&n) / n.dot(&n));
        let v = unit(along(&between(a, b, u), c, d));
        let u = if v == 0.0 || v == 1.0 {
            unit(along(&between(c, d, v), a, b))
        } else {
            u
        };
        (u, v)
    }

    /// Parallel, or a point, now but not for the whole step.
    fn flags(&self, points: &[Motion; 4], options: &Options) -> Flags {
        let thresholds = &options.thresholds;
        let [p0, p1, p2, p3] = points;
        let [ab, cd] = self.is_point;
        Flags {
            temporarily_parallel: self.is_parallel && !detect_case3(points, thresholds),
            temporarily_point: (ab && !same_for_whole_step(p0, p1, thresholds))
                || (cd && !same_for_whole_step(p2, p3, thresholds)),
        }
    }
}

/// The velocity of `CD` at `v` relative to `AB` at `u`, normalised; `None` where it is zero, or no
/// more than the rounding errors of its computation, or overflows.
fn relative_velocity([p0, p1, p2, p3]: &[Motion; 4], u: f64, v: f64) -> Option<Vector3<f64>> {
    let relative = between(&p2.v, &p3.v, v) - between(&p0.v, &p1.v, u);
    let speed = length(&relative);
    let fastest = [p0, p1, p2, p3]
        .iter()
        .flat_map(|p| p.v.iter())
        .fold(0.0, |fastest: f64, x| fastest.max(x.abs()));
    // Each of some six operations on values of up to `fastest` rounds by half an EPSILON of it.
    (speed.is_finite() && speed > 8.0 * f64::EPSILON * fastest).then(|| relative / speed)
}

/// The point at `t` in `[0, 1]` between `a` and `b`; exact at both ends, never outside.
fn between(a: &Vector3<f64>, b: &Vector3<f64>, t: f64) -> Vector3<f64> {
    a.zip_map(b, |a, b| {
        ((1.0 - t) * a + t * b).max(a.min(b)).min(a.max(b))
    })
}

/// The parameter of `x` projected to the line from `a` to `b`.
fn along(x: &Vector3<f64>, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    let direction = b - a;
    (x - a).dot(&direction) / direction.dot(&direction)
}

/// The nearest parameter in `[0, 1]`; 0 for a NaN.
fn unit(parameter: f64) -> f64 {
    if parameter > 0.0 {
        parameter.min(1.0)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Edges = [[f64; 3]; 4];

    /// The contact at `t = 0.5` of a motion that passes `at_half` with these velocities.
    fn contact_of(case: Case, at_half: Edges, velocity: Edges) -> (Contact, Flags) {
        let shifted = |factor: f64| -> [Point; 4] {
            std::array::from_fn(|i| {
                let [p, v] = [at_half[i], velocity[i]].map(Vector3::from);
                Point::from(p + v * factor)
            })
        };
        let query = EdgeEdge::new(shifted(-0.5), shifted(0.5), 0.0).unwrap();
        let points = Motion::of_query(&query);
        contact_at(0.5, &query, case, &points, &Options::default())
    }

    const STILL: [f64; 3] = [0.0; 3];
    const UP: [f64; 3] = [0.0, 0.0, 2.0];

    #[test]
    fn contact_of_crossing_edges_has_parameters_point_and_normal() {
        let at_half = [
            [-1.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 1.0, 0.0],
        ];
        let (contact, flags) =
            contact_of(Case::General, at_half, [STILL, STILL, UP, [0.0, 0.0, 4.0]]);
        assert_eq!(
            (contact.first.on_edges().u, contact.first.on_edges().v),
            (0.25, 0.5)
        );
        assert_eq!(contact.first.point, Point::origin());
        assert_eq!(contact.first.relative_velocity, Some(Vector3::z()));
        assert_eq!(contact.second, None);
        assert_eq!(flags, Flags::default());
    }

    #[test]
    fn contact_normal_is_the_velocity_of_cd_relative_to_ab() {
        let at_half = [
            [-1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 1.0, 0.0],
        ];
        let down = [0.0, 0.0, -2.0];
        let (contact, _) = contact_of(Case::General, at_half, [UP, UP, down, down]);
        assert_eq!(contact.first.relative_velocity, Some(-Vector3::z()));
        let along = [0.1, 0.2, 0.3];
        let (contact, _) = contact_of(Case::Coplanar, at_half, [along; 4]);
        assert_eq!(contact.first.relative_velocity, None);
    }

    #[test]
    fn contact_of_overlapping_edges_has_two_points_in_ascending_u() {
        let at_half = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [5.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
        ];
        let spread = [STILL, STILL, UP, [0.0, 0.0, -2.0]];
        let (contact, flags) = contact_of(Case::Coplanar, at_half, spread);
        assert!(flags.temporarily_parallel && !flags.temporarily_point);
        assert_eq!(contact.first.on_edges(), EdgePoint { u: 0.25, v: 1.0 });
        let second = contact.second.unwrap();
        assert_eq!(second.on_edges(), EdgePoint { u: 1.0, v: 0.25 });
        assert_eq!(second.point, Point::new(4.0, 0.0, 0.0));
        let (_, flags) = contact_of(Case::Parallel, at_half, [STILL, STILL, UP, UP]);
        assert!(!flags.temporarily_parallel, "parallel for the whole step");
    }

    #[test]
    fn contact_of_collinear_edges_that_touch_has_one_point() {
        let at_half = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [6.0, 0.0, 0.0],
        ];
        let towards = [-1.0, 0.0, 0.0];
        let (contact, _) = contact_of(Case::Collinear, at_half, [STILL, STILL, towards, towards]);
        assert_eq!(
            (contact.first.on_edges().u, contact.first.on_edges().v),
            (1.0, 0.0)
        );
        assert_eq!(contact.second, None);
    }

    #[test]
    fn contact_of_an_edge_that_is_a_point_has_parameter_zero() {
        let point_cd = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
        ];
        let opening = [STILL, STILL, UP, [0.0, 0.0, -2.0]];
        let (contact, flags) = contact_of(Case::Coplanar, point_cd, opening);
        assert_eq!(
            (contact.first.on_edges().u, contact.first.on_edges().v),
            (0.25, 0.0)
        );
        assert!(flags.temporarily_point && !flags.temporarily_parallel);
        let (_, flags) = contact_of(Case::Degenerate, point_cd, [STILL, STILL, UP, UP]);
        assert!(!flags.temporarily_point, "a point for the whole step");
        let [a, b, c, d] = point_cd;
        let (contact, _) = contact_of(Case::Coplanar, [c, d, a, b], opening);
        assert_eq!(
            (contact.first.on_edges().u, contact.first.on_edges().v),
            (0.0, 0.25)
        );
        let (contact, _) = contact_of(Case::Coplanar, [c; 4], [UP, STILL, STILL, UP]);
        assert_eq!(
            (contact.first.on_edges().u, contact.first.on_edges().v),
            (0.0, 0.0)
        );
    }

    #[test]
    fn contact_parameters_never_leave_the_unit_interval() {
        // Lines that would meet beyond B, and edges that are near in their ends only.
        let at_half = [
            [-2.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 3.0, 0.0],
        ];
        let (contact, _) = contact_of(Case::General, at_half, [STILL, STILL, UP, STILL]);
        assert_eq!(
            (contact.first.on_edges().u, contact.first.on_edges().v),
            (1.0, 0.0)
        );
    }

    #[test]
    fn between_stays_within_its_ends_at_the_largest_values() {
        let a = Vector3::new(f64::MAX, -f64::MAX, f64::MAX);
        let b = Vector3::new(f64::MAX, f64::MAX, -f64::MAX);
        for n in 0..=1000 {
            let between = between(&a, &b, f64::from(n) / 1000.0);
            assert!(between.iter().all(|x| x.is_finite()), "{n}");
        }
        assert_eq!(between(&a, &b, 0.0), a);
        assert_eq!(between(&a, &b, 1.0), b);
    }
}
