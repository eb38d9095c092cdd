//! A contact in space.

use super::kind::{Kind, Stages};
use super::normal::{HasNormal, Normal};
use super::vector::{between, normalised};
use crate::contact::{Contact, ContactPoint, Hit, Place};
use crate::query::Point;

impl<P> Hit<P> {
    /// The contact in space, from the positions at [`toi`](Hit::toi).
    ///
    /// The hit has to be that of this query.
    ///
    /// With `S` the largest magnitude of a coordinate of the first side, and `e` the error of the
    /// place, each coordinate of a point is within
    /// `(8 * 2^-53 + 2 e + 2 (toi_above - toi)) S + 2^-1072` of the exact one. The relative velocity
    /// is a difference of changes of position. With `C` the largest magnitude of a coordinate of
    /// `end - start`, each coordinate of that difference is within `(2^-49 + 4 e) C` of the exact
    /// one, before it is brought to length 1; where none is larger than that, the direction is
    /// `None`. The normal is that of [`Hit::normal`].
    pub fn contact<K: Kind<Place = P>>(&self, query: &K) -> Contact {
        let (first, second) = self.points(query);
        Contact {
            toi: self.toi,
            first,
            second,
            normal: self.normal(query).map(|normal| normal.direction),
        }
    }

    /// The points of [`contact`](Self::contact), without the normal.
    pub fn points<K: Kind<Place = P>>(&self, query: &K) -> (ContactPoint, Option<ContactPoint>) {
        let (first, second) = K::Stages::weights(&self.place);
        let error = error::<K>(&self.place);
        let point = |weights| contact_point(query, self.toi, weights, error);
        (point(first), second.map(point))
    }

    /// The contact normal: the unit vector along which the sides are nearest, from the first side
    /// (the edge AB, or the vertex A) to the second (the edge CD, or the face BCD), and a bound on
    /// its error.
    ///
    /// It is the direction of the shortest vector from the first side to the second, in the limit
    /// just before the contact; with a radius, at the contact:
    ///
    /// - Inside two edges that meet at an angle: the common perpendicular. Inside a face: the
    ///   face's normal.
    /// - With a radius: the line of the nearest points.
    /// - At ends of edges and corners, for parallel and coplanar motion: the same limit, in
    ///   integers. It takes from ten to some hundreds of microseconds there, and
    ///   milliseconds where exponents span the range of `f64`, else well under one microsecond.
    ///
    /// Of [bodies that turn](crate::decide_rigid) it is the same, in space; integers mostly take from
    /// fifty to three hundred microseconds there.
    ///
    /// `None` if and only if the sides share a point at the start of the step: then there is no
    /// direction that they come from. Sides that start within the radius and apart have one. The
    /// hit has to be that of this query; the normal of another hit means nothing.
    ///
    /// ```
    /// use tunnelproof::nalgebra::Vector3;
    /// use tunnelproof::{EdgeEdge, Point, decide};
    ///
    /// let p = Point::new;
    /// let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.5, -1.0, 1.0), p(0.5, 1.0, 1.0)];
    /// let mut end = start;
    /// end[2].z = -3.0;
    /// end[3].z = -3.0;
    /// let query = EdgeEdge::new(start, end, 0.0)?;
    /// let normal = decide(&query).and_then(|hit| hit.normal(&query)).expect("they cross");
    /// // CD comes from above.
    /// assert!((normal.direction - Vector3::z()).norm() <= normal.error);
    /// assert!(normal.error < 1e-14);
    /// # Ok::<(), tunnelproof::QueryError>(())
    /// ```
    pub fn normal<Q: HasNormal<P>>(&self, query: &Q) -> Option<Normal> {
        let touches_at_start = self.toi_above == 0.0 && query.contact_radius().is_zero();
        let is_of_step = 0.0 <= self.toi && self.toi <= self.toi_above && self.toi_above <= 1.0;
        match touches_at_start || !is_of_step {
            true => None,
            false => query.normal_of(self),
        }
    }
}

/// How far the parameters or weights of a place are from the exact ones at most.
fn error<K: Kind>(place: &K::Place) -> f64 {
    let place: Place = (*place).into();
    place.error()
}

/// What rounding takes of a relative velocity, as a share of the largest change of position.
const ROUNDING: f64 = 16.0 * (f64::EPSILON / 2.0);

/// The point of the first side with these weights, which are known up to an error, at a time.
fn contact_point<K: Kind>(query: &K, toi: f64, weights: [f64; 4], error: f64) -> ContactPoint {
    let (start, end) = (query.start(), query.end());
    let at = |i: usize| between(&start[i].coords, &end[i].coords, toi);
    let point = match K::Stages::FIRST {
        1 => at(0),
        _ => between(&at(0), &at(1), weights[1]),
    };
    // Half of each position where a difference overflows; the largest change is 1 where squares or
    // blends would overflow or underflow.
    let full: [_; 4] = std::array::from_fn(|i| end[i].coords - start[i].coords);
    let is_finite = full.iter().all(|change| change.amax().is_finite());
    let changes = match is_finite {
        true => full,
        false => std::array::from_fn(|i| end[i].coords * 0.5 - start[i].coords * 0.5),
    };
    let largest = changes
        .iter()
        .map(|change| change.amax())
        .fold(0.0, f64::max);
    let is_ordinary = is_finite && (1e-280..1e300).contains(&largest);
    let unit = if is_ordinary { 1.0 } else { largest };
    let change = |i: usize| changes[i] / unit;
    let relative = match K::Stages::FIRST {
        1 => change(1) * weights[1] + change(2) * weights[2] + change(3) * weights[3] - change(0),
        _ => {
            let second = between(&change(2), &change(3), weights[3]);
            second - between(&change(0), &change(1), weights[1])
        }
    };
    // The weights add up to 4 errors at most. Rounding: the changes, what they are divided by, their
    // blends and the difference take 12 units of the last place of the largest change at most.
    let lost = (ROUNDING + 4.0 * error) * (largest / unit);
    ContactPoint {
        point: Point::from(point),
        weights,
        relative_velocity: normalised(&relative).filter(|_| relative.amax() > lost),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use crate::query::{EdgeEdge, Point, VertexFace};

    /// Two edges of half-length `size` that cross, CD from `height` above AB to as far below.
    fn crossing(size: f64, height: f64) -> EdgeEdge {
        let at = |z: f64| {
            let p = |x: f64, y: f64, z: f64| Point::new(x, y, z);
            [
                p(-size, 0.0, 0.0),
                p(size, 0.0, 0.0),
                p(0.0, -size, z),
                p(0.0, size, z),
            ]
        };
        EdgeEdge::new(at(height), at(-height), 0.0).unwrap()
    }

    #[test]
    fn relative_velocity_is_told_at_every_scale() {
        let least = f64::from_bits(1);
        for size in [least, 1e-300, 1.0, 1e300, f64::MAX] {
            for height in [least, 1e-300, 1.0, 1e300, f64::MAX] {
                let query = crossing(size, height);
                let hit = crate::decide(&query).unwrap();
                let (first, _) = hit.points(&query);
                let velocity = first.relative_velocity;
                assert_eq!(velocity, Some(-Vector3::z()), "{size:e} {height:e}");
            }
        }
    }

    /// Two edges, and a vertex and a face, that touch at the start and then move as one.
    #[test]
    fn no_relative_velocity_of_what_moves_as_one() {
        let p = |x: f64, y: f64, z: f64| Point::new(x, y, z);
        let edges = [
            p(-1.0, 0.0, 0.0),
            p(2.0, 0.0, 0.0),
            p(-1.0, -1.0, 0.0),
            p(4.0, 4.0, 0.0),
        ];
        let face = [
            p(1.0, 1.0, 0.0),
            p(-3.0, -1.0, 0.0),
            p(4.0, 0.0, 0.0),
            p(0.0, 5.0, 0.0),
        ];
        for scale in [-1000, -30, 0, 30, 1000].map(|exponent| 2f64.powi(exponent)) {
            for motion in [Vector3::new(1.0, 7.0, -3.0), Vector3::new(0.0, 0.0, 5.0)] {
                let moved = |points: [Point; 4]| {
                    let start = points.map(|q| q * scale);
                    (start, start.map(|q| q + motion * scale))
                };
                let (start, end) = moved(edges);
                let query = EdgeEdge::new(start, end, 0.0).unwrap();
                let hit = crate::decide(&query).expect("they touch at the start");
                let first = hit.contact(&query).first;
                assert_eq!(first.relative_velocity, None, "edges {scale:e} {motion}");
                let (start, end) = moved(face);
                let query = VertexFace::new(start, end, 0.0).unwrap();
                let hit = crate::decide(&query).expect("they touch at the start");
                let first = hit.contact(&query).first;
                assert_eq!(first.relative_velocity, None, "face {scale:e} {motion}");
            }
        }
    }

    /// A motion that is a thousandth of the common one is still told.
    #[test]
    fn relative_velocity_of_what_moves_almost_as_one() {
        let mut query = crossing(1.0, 1e-3);
        let common = Vector3::new(1.0, 2.0, 3.0);
        let end = query.end().map(|q| q + common);
        query = EdgeEdge::new(*query.start(), end, 0.0).unwrap();
        let hit = crate::decide(&query).unwrap();
        let velocity = hit.contact(&query).first.relative_velocity.unwrap();
        assert!((velocity + Vector3::z()).norm() < 1e-11, "{velocity}");
    }
}
