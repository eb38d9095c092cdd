//! A contact in space.

use super::kind::Kind;
use super::normal::Normal;
use super::vector::{between, normalised};
use crate::contact::{Contact, ContactPoint, Hit};
use crate::query::Point;

impl<P> Hit<P> {
    /// The contact in space, from the positions at [`toi`](Hit::toi).
    ///
    /// The hit has to be that of this query.
    ///
    /// With `S` the largest magnitude of a coordinate of the first side, and `e` the error of the
    /// place, each coordinate of a point is within
    /// `(8 * 2^-53 + 2 e + 2 (toi_above - toi)) S + 2^-1072` of the exact one. The relative velocity
    /// is a difference of differences of positions: where these cancel it loses accuracy in the
    /// same measure. The normal is that of [`Hit::normal`].
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
        let (first, second) = K::weights(&self.place);
        let point = |weights| contact_point(query, self.toi, weights);
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
    /// `None` if and only if the sides share a point at the start of the step: then there is no
    /// direction that they come from. Sides that start within the radius and apart have one. The hit has to be that of this query; the normal of another hit means
    /// nothing.
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
    pub fn normal<K: Kind<Place = P>>(&self, query: &K) -> Option<Normal> {
        let (_, radius) = query.parts();
        let touches_at_start = self.toi_above == 0.0 && radius.is_zero();
        let is_of_step = 0.0 <= self.toi && self.toi <= self.toi_above && self.toi_above <= 1.0;
        if touches_at_start || !is_of_step {
            return None;
        }
        query.normal(self)
    }
}

/// The point of the first side with these weights at a time.
fn contact_point<K: Kind>(query: &K, toi: f64, weights: [f64; 4]) -> ContactPoint {
    let ([start, end], _) = query.parts();
    let at = |i: usize| between(&start[i].coords, &end[i].coords, toi);
    let point = match K::FIRST {
        1 => at(0),
        _ => between(&at(0), &at(1), weights[1]),
    };
    // A quarter of each position where the difference may overflow.
    let largest = start
        .iter()
        .chain(end)
        .map(|p| p.coords.amax())
        .fold(0.0, f64::max);
    let unit = if largest < f64::MAX / 8.0 { 1.0 } else { 0.125 };
    let change = |i: usize| end[i].coords * unit - start[i].coords * unit;
    let relative = match K::FIRST {
        1 => change(1) * weights[1] + change(2) * weights[2] + change(3) * weights[3] - change(0),
        _ => {
            let second = between(&change(2), &change(3), weights[3]);
            second - between(&change(0), &change(1), weights[1])
        }
    };
    ContactPoint {
        point: Point::from(point),
        weights,
        relative_velocity: normalised(&relative),
    }
}
