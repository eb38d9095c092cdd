//! Boxes, and what they are cast against.

use nalgebra::Vector3;
use num_rational::BigRational;
use num_traits::Zero;
use tunnelproof::query::Point;

use crate::vector::{dot, sub};

/// What a body is, without its radius.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shape {
    /// A point.
    Sphere,
    /// A segment.
    Edge,
    /// A triangle.
    Triangle,
    /// A box.
    Box,
}

/// A convex body that moves along a line and does not turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    shape: Shape,
    points: [Point; 4],
    step: Vector3<f64>,
    radius: f64,
}

/// Two bodies of which at least one is a box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoxCast {
    bodies: [Body; 2],
}

/// Why numbers are no body, or two bodies no cast of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// The number of points is not that of the shape.
    #[error("the shape has {expected} points, not {found}")]
    Count {
        /// Of the shape.
        expected: usize,
        /// Of the list.
        found: usize,
    },
    /// A number is infinite or no number.
    #[error("a number is not finite")]
    Finite,
    /// A radius is below 0, or that of a triangle or a box is not 0.
    #[error("the radius is not 0 or more, and 0 for a triangle and a box")]
    Radius,
    /// Two sides of a box are not at right angles, exactly, or one has no length.
    #[error("the sides of a box are not at right angles, or one has no length")]
    Sides,
    /// A corner, at the start or at the end of the step, is no `f64`.
    #[error("a corner is no f64 at the start or at the end of the step")]
    Corner,
    /// Neither body is a box.
    #[error("neither body is a box")]
    NoBox,
}

impl Shape {
    /// Every shape, in the order of their numbers in [frames](crate::program::frames).
    pub const ALL: [Shape; 4] = [Shape::Sphere, Shape::Edge, Shape::Triangle, Shape::Box];

    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Sphere => "sphere",
            Shape::Edge => "edge",
            Shape::Triangle => "triangle",
            Shape::Box => "box",
        }
    }

    /// How many points say where it is.
    pub fn count(self) -> usize {
        match self {
            Shape::Sphere => 1,
            Shape::Edge => 2,
            Shape::Triangle => 3,
            Shape::Box => 4,
        }
    }
}

impl Body {
    /// The body with these points at the start of the step, in metres: of a box a corner and the
    /// three corners beside it. `step` is its translation, `radius` by how much it is larger.
    ///
    /// # Errors
    ///
    /// [`BodyError`], also for numbers of which a corner is not exactly an `f64`: then the body could
    /// not be told to anyone.
    pub fn new(
        shape: Shape,
        points: &[Point],
        step: Vector3<f64>,
        radius: f64,
    ) -> Result<Self, BodyError> {
        let (expected, found) = (shape.count(), points.len());
        if expected != found {
            return Err(BodyError::Count { expected, found });
        }
        let numbers = points.iter().flat_map(|point| point.iter());
        if !numbers.chain(&step).all(|number| number.is_finite()) {
            return Err(BodyError::Finite);
        }
        let has_radius = matches!(shape, Shape::Sphere | Shape::Edge);
        if !(radius.is_finite() && radius >= 0.0 && (has_radius || radius == 0.0)) {
            return Err(BodyError::Radius);
        }
        let body = Body {
            shape,
            // Those that the shape does not have are its first.
            points: [0, 1, 2, 3].map(|i| points.get(i).copied().unwrap_or(points[0])),
            step,
            radius,
        };
        let corners = body.exact_corners().ok_or(BodyError::Corner)?;
        match shape == Shape::Box && !is_right(&corners) {
            true => Err(BodyError::Sides),
            false => Ok(body),
        }
    }

    /// What it is.
    pub fn shape(&self) -> Shape {
        self.shape
    }

    /// Its points at the start, four of them: those that the shape does not have are the first.
    pub fn points(&self) -> [Point; 4] {
        self.points
    }

    /// Its translation.
    pub fn step(&self) -> Vector3<f64> {
        self.step
    }

    /// By how much it is larger than its shape.
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// All its corners at the start; of a box, eight: bit `i` of the number of one says whether it is
    /// at the far end of side `i`.
    pub fn corners(&self) -> Vec<Point> {
        let [origin, ..] = self.points;
        match self.shape {
            Shape::Box => (0..8).map(|corner| self.corner(corner)).collect(),
            Shape::Sphere => vec![origin],
            Shape::Edge | Shape::Triangle => self.points[..self.shape.count()].to_vec(),
        }
    }

    /// The corners of each edge, by their numbers: those of a box differ in one bit. A sphere has none.
    pub fn edges(&self) -> Vec<[usize; 2]> {
        match self.shape {
            Shape::Sphere => Vec::new(),
            Shape::Edge => vec![[0, 1]],
            Shape::Triangle => vec![[0, 1], [1, 2], [0, 2]],
            Shape::Box => {
                let near = |side: usize| (0..8).filter(move |corner| corner & side == 0);
                let along = |side| near(side).map(move |corner| [corner, corner | side]);
                [1, 2, 4].into_iter().flat_map(along).collect()
            }
        }
    }

    fn corner(&self, number: usize) -> Point {
        let [origin, beside @ ..] = self.points;
        let sides = beside.map(|point| point - origin);
        let far = (0..3).filter(|side| number >> side & 1 == 1);
        far.fold(origin, |corner, side| corner + sides[side])
    }

    /// The corners at the start in rational numbers, if they and those at the end are what
    /// [`corners`](Self::corners) and their translations say in `f64`.
    fn exact_corners(&self) -> Option<Vec<Vector>> {
        let [origin, beside @ ..] = self.points.map(|point| vector(&point.coords));
        let step = vector(&self.step);
        let rounded = self.corners();
        let exact = (0..rounded.len()).map(|number| match self.shape {
            Shape::Box => {
                let far = (0..3).filter(|side| number >> side & 1 == 1);
                far.fold(origin.clone(), |corner, side| {
                    add(&corner, &sub(&beside[side], &origin))
                })
            }
            _ => vector(&self.points[number].coords),
        });
        let exact: Vec<Vector> = exact.collect();
        let is_exact = exact.iter().zip(&rounded).all(|(exact, rounded)| {
            let end = rounded + self.step;
            vector(&rounded.coords) == *exact && vector(&end.coords) == add(exact, &step)
        });
        is_exact.then_some(exact)
    }
}

/// Whether the sides of a box with these corners are at right angles and have a length.
fn is_right(corners: &[Vector]) -> bool {
    let sides = [1, 2, 4].map(|corner| sub(&corners[corner], &corners[0]));
    let products = [(0, 1), (1, 2), (2, 0)].map(|(i, j)| dot(&sides[i], &sides[j]));
    products.iter().all(Zero::is_zero) && !sides.iter().any(|side| dot(side, side).is_zero())
}

impl BoxCast {
    /// The cast of two bodies.
    ///
    /// # Errors
    ///
    /// [`BodyError::NoBox`] if neither is a box.
    pub fn new(bodies: [Body; 2]) -> Result<Self, BodyError> {
        match bodies.iter().any(|body| body.shape == Shape::Box) {
            true => Ok(BoxCast { bodies }),
            false => Err(BodyError::NoBox),
        }
    }

    /// The bodies.
    pub fn bodies(&self) -> &[Body; 2] {
        &self.bodies
    }
}

/// A vector in rational numbers.
pub(super) type Vector = [BigRational; 3];

/// A finite number, exactly.
pub(super) fn number(value: f64) -> BigRational {
    BigRational::from_float(value).unwrap_or_default()
}

pub(super) fn vector(from: &Vector3<f64>) -> Vector {
    [from.x, from.y, from.z].map(number)
}

pub(super) fn add(x: &Vector, y: &Vector) -> Vector {
    [0, 1, 2].map(|h| &x[h] + &y[h])
}

pub(super) fn scale(x: &Vector, by: &BigRational) -> Vector {
    [0, 1, 2].map(|h| &x[h] * by)
}
