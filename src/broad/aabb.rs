//! Boxes along the axes that hold a moving thing for a whole step.

use crate::query::Point;

use super::error::BroadError;

/// A box along the axes, in metres: all points from `low` to `high`, faces included.
///
/// No bound is NaN and none is below its lower one. They may be infinite, as of a half-space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    pub(super) low: [f64; 3],
    pub(super) high: [f64; 3],
}

impl Aabb {
    /// The box from `low` to `high`.
    ///
    /// # Errors
    ///
    /// [`BroadError::Bounds`] names the first axis on which the bounds are no range.
    pub fn new(low: Point, high: Point) -> Result<Self, BroadError> {
        for axis in 0..3 {
            let (low, high) = (low[axis], high[axis]);
            // So that NaN is refused.
            let is_range = low <= high;
            if !is_range {
                return Err(BroadError::Bounds { axis, low, high });
            }
        }
        let (low, high) = (low.into(), high.into());
        Ok(Aabb { low, high })
    }

    /// A box that holds everything within `radius` of the convex hull of some points, while each
    /// goes on a straight line from its place in `start` to its place in `end`: the swept box of a
    /// segment, given by its ends.
    ///
    /// Exact for a radius of 0, else rounded outward. A point on its way lies between its places on
    /// every axis, and of two things that come within `r + s` of each other, the boxes of radius
    /// `r` and `s` overlap.
    ///
    /// # Errors
    ///
    /// [`BroadError`] if there are no points, a coordinate is not finite, or the radius is not a
    /// finite number of at least 0.
    pub fn swept(start: &[Point], end: &[Point], radius: f64) -> Result<Self, BroadError> {
        check(start, false)?;
        check(end, true)?;
        check_radius(radius)?;
        let mut points = start.iter().chain(end);
        let first: [f64; 3] = (*points.next().ok_or(BroadError::NoPoints)?).into();
        let (mut low, mut high) = (first, first);
        for point in points {
            for axis in 0..3 {
                low[axis] = low[axis].min(point[axis]);
                high[axis] = high[axis].max(point[axis]);
            }
        }
        Ok(Aabb { low, high }.widened(radius))
    }

    /// The box moved outward by `radius` on all sides, at least.
    fn widened(self, radius: f64) -> Self {
        if radius == 0.0 {
            return self;
        }
        Aabb {
            low: self.low.map(|x| (x - radius).next_down()),
            high: self.high.map(|x| (x + radius).next_up()),
        }
    }

    /// The corner of the least coordinates.
    pub fn low(&self) -> Point {
        self.low.into()
    }

    /// The corner of the largest coordinates.
    pub fn high(&self) -> Point {
        self.high.into()
    }

    /// Whether the boxes have a point in common; to touch is enough. Exact.
    #[inline]
    pub fn overlaps(&self, other: &Aabb) -> bool {
        (0..3).all(|axis| self.low[axis] <= other.high[axis] && other.low[axis] <= self.high[axis])
    }
}

/// Refuses coordinates that are not finite.
pub(super) fn check(points: &[Point], at_end: bool) -> Result<(), BroadError> {
    for (point, position) in points.iter().enumerate() {
        for (axis, &value) in position.iter().enumerate() {
            if !value.is_finite() {
                return Err(BroadError::NotFinite {
                    point,
                    at_end,
                    axis,
                    value,
                });
            }
        }
    }
    Ok(())
}

/// Refuses radii that are not finite or below 0.
pub(super) fn check_radius(radius: f64) -> Result<(), BroadError> {
    if radius.is_finite() && radius >= 0.0 {
        Ok(())
    } else {
        Err(BroadError::Radius(radius))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORIGIN: Point = Point::new(0.0, 0.0, 0.0);

    #[test]
    fn swept_box_holds_infinity_where_the_radius_overflows() {
        let far = Point::new(f64::MAX, -f64::MAX, 0.0);
        let swept = Aabb::swept(&[far], &[far], f64::MAX).unwrap();
        assert_eq!(swept.high().x, f64::INFINITY);
        assert_eq!(swept.low().y, f64::NEG_INFINITY);
        assert!(swept.low().x <= 0.0 && swept.high().y >= 0.0);
        // A radius that a large coordinate swallows still moves the face.
        let swept = Aabb::swept(&[far], &[far], 5e-324).unwrap();
        assert_eq!(swept.high().x, f64::INFINITY);
        assert_eq!(swept.low().x, f64::MAX.next_down());
    }

    #[test]
    fn swept_box_of_radius_zero_has_the_points_on_its_faces() {
        let swept = Aabb::swept(&[ORIGIN], &[Point::new(1.0, -2.0, 5e-324)], 0.0).unwrap();
        assert_eq!(swept.low(), Point::new(0.0, -2.0, 0.0));
        assert_eq!(swept.high(), Point::new(1.0, 0.0, 5e-324));
    }

    #[test]
    fn boxes_that_touch_overlap_and_boxes_an_ulp_apart_do_not() {
        let of = |x: f64, y: f64| Aabb::new([x, 0.0, 0.0].into(), [y, 1.0, 1.0].into()).unwrap();
        assert!(of(0.0, 1.0).overlaps(&of(1.0, 2.0)));
        assert!(of(1.0, 2.0).overlaps(&of(0.0, 1.0)));
        assert!(!of(0.0, 1.0).overlaps(&of(1f64.next_up(), 2.0)));
        assert!(!of(1f64.next_up(), 2.0).overlaps(&of(0.0, 1.0)));
        assert!(of(f64::NEG_INFINITY, f64::INFINITY).overlaps(&of(1e308, 1e308)));
    }

    #[test]
    fn box_names_what_it_refuses() {
        let text = |result: Result<Aabb, BroadError>| result.unwrap_err().to_string();
        let nan = Point::new(0.0, f64::NAN, 0.0);
        assert_eq!(
            text(Aabb::swept(&[ORIGIN], &[ORIGIN, nan], 0.0)),
            "y of point 1 at t = 1 is NaN, not a finite number"
        );
        assert_eq!(
            text(Aabb::swept(&[ORIGIN], &[], -1.0)),
            "the radius is -1; it has to be finite, and 0 or more"
        );
        assert_eq!(
            text(Aabb::swept(&[], &[], 0.0)),
            "a box needs at least one point"
        );
        assert_eq!(
            text(Aabb::new(ORIGIN, Point::new(0.0, 0.0, -1.0))),
            "z of a box is from 0 to -1, not a range"
        );
        assert!(Aabb::new(ORIGIN, nan).is_err() && Aabb::new(nan, ORIGIN).is_err());
    }
}
