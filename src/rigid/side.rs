//! One of the two sides of a query.

use super::error::{RigidError, first_not_finite};
use super::motion::RigidMotion;
use crate::query::Point;

/// One side of a query, and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Side<'a> {
    /// Points in space, each of which moves on a straight line.
    Straight {
        /// Where they are at `t = 0`, in metres.
        start: &'a [Point],
        /// Where they are at `t = 1`, as many.
        end: &'a [Point],
    },
    /// Points of a body that turns.
    Turning {
        /// Where they are in the body's frame, in metres.
        local: &'a [Point],
        /// The motion of the body.
        motion: &'a RigidMotion,
    },
}

impl Side<'_> {
    /// How many points it has.
    pub fn number_of_points(&self) -> usize {
        match self {
            Side::Straight { start, .. } => start.len(),
            Side::Turning { local, .. } => local.len(),
        }
    }

    /// Where a point is in space at a time in `[0, 1]`, rounded.
    ///
    /// # Panics
    ///
    /// If there are not so many points.
    pub fn position(&self, point: usize, t: f64) -> Point {
        match self {
            Side::Straight { start, end } => {
                Point::from(start[point].coords * (1.0 - t) + end[point].coords * t)
            }
            Side::Turning { local, motion } => motion.position(&local[point], t),
        }
    }

    /// Refuses the first coordinate that is not finite; the points are the query's from one on.
    pub(super) fn check(&self, from: usize) -> Result<(), RigidError> {
        let first = |points: &[Point]| {
            let mut found = points.iter().enumerate();
            found.find_map(|(i, point)| first_not_finite(point).map(|at| (from + i, at)))
        };
        match self {
            Side::Straight { start, end } => {
                for (at_end, points) in [(false, start), (true, end)] {
                    if let Some((point, (axis, value))) = first(points) {
                        return Err(RigidError::World {
                            point,
                            at_end,
                            axis,
                            value,
                        });
                    }
                }
                Ok(())
            }
            Side::Turning { local, .. } => match first(local) {
                Some((point, (axis, value))) => Err(RigidError::Local { point, axis, value }),
                None => Ok(()),
            },
        }
    }
}
