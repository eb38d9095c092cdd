//! Shapes of bodies and what they weigh.

use std::f64::consts::PI;

use nalgebra::Matrix3;

use super::check::{positive, positive_definite};
use super::{Mesh, ModelError};
use crate::wire::Vector;

/// The shape of a body, around its centre of mass. Lengths in m.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Shape {
    /// A box of half edges along x, y, z.
    Box {
        /// Half of each edge.
        half: Vector,
    },
    /// A cylinder around the z axis.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Half of the height.
        half_height: f64,
    },
    /// A sphere.
    Sphere {
        /// Radius.
        radius: f64,
    },
    /// A capsule around the z axis.
    Capsule {
        /// Radius.
        radius: f64,
        /// Half of the distance between the centres of its two caps.
        half_height: f64,
    },
    /// The half-space `z <= 0` of the body's frame; it has no mass.
    Plane,
    /// A closed triangle mesh.
    Mesh(Mesh),
}

pub(super) const PLANE_IS_MASSLESS: ModelError = ModelError::Massless { shape: "plane" };

/// Mass and inertia of a shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MassProperties {
    /// Mass in kg.
    pub mass: f64,
    /// Inertia about the centre of mass in the body's frame, in kg m^2.
    pub inertia: Matrix3<f64>,
}

impl Shape {
    /// What the shape weighs at a density in kg/m^3.
    ///
    /// # Errors
    ///
    /// A dimension that is not above 0, or a plane, which has no mass.
    pub fn mass_properties(&self, density: f64) -> Result<MassProperties, ModelError> {
        self.check()?;
        positive("density", density)?;
        let properties = match self {
            Shape::Box { half } => cuboid(half, density),
            Shape::Cylinder {
                radius,
                half_height,
            } => cylinder(*radius, *half_height, density),
            Shape::Sphere { radius } => capsule(*radius, 0.0, density),
            Shape::Capsule {
                radius,
                half_height,
            } => capsule(*radius, *half_height, density),
            Shape::Plane => return Err(PLANE_IS_MASSLESS),
            Shape::Mesh(mesh) => mesh.mass_properties(density),
        };
        positive("mass", properties.mass)?;
        positive_definite("inertia", &properties.inertia)?;
        Ok(properties)
    }

    /// The largest distance of a point of it from the body's centre of mass, in m, rounded; infinite of a plane.
    pub fn reach(&self) -> f64 {
        match self {
            Shape::Box { half } => half.norm(),
            Shape::Sphere { radius } => *radius,
            Shape::Cylinder {
                radius,
                half_height,
            } => (radius * radius + half_height * half_height).sqrt(),
            Shape::Capsule {
                radius,
                half_height,
            } => radius + half_height,
            Shape::Plane => f64::INFINITY,
            Shape::Mesh(mesh) => {
                let vertices = mesh.vertices().iter();
                vertices.fold(0.0, |far: f64, vertex| far.max(vertex.coords.norm()))
            }
        }
    }

    pub(super) fn check(&self) -> Result<(), ModelError> {
        match self {
            Shape::Box { half } => half
                .iter()
                .try_for_each(|&edge| positive("half edge", edge)),
            Shape::Sphere { radius } => positive("radius", *radius),
            Shape::Cylinder {
                radius,
                half_height,
            }
            | Shape::Capsule {
                radius,
                half_height,
            } => {
                positive("radius", *radius)?;
                positive("half_height", *half_height)
            }
            Shape::Plane | Shape::Mesh(_) => Ok(()),
        }
    }
}

fn diagonal(mass: f64, x: f64, y: f64, z: f64) -> MassProperties {
    MassProperties {
        mass,
        inertia: Matrix3::from_diagonal(&Vector::new(x, y, z)),
    }
}

fn cuboid(half: &Vector, density: f64) -> MassProperties {
    let mass = 8.0 * density * half.x * half.y * half.z;
    let square = half.component_mul(half) * (mass / 3.0);
    diagonal(
        mass,
        square.y + square.z,
        square.x + square.z,
        square.x + square.y,
    )
}

fn cylinder(radius: f64, half_height: f64, density: f64) -> MassProperties {
    let mass = 2.0 * density * PI * radius * radius * half_height;
    let axial = mass * radius * radius / 2.0;
    let across = axial / 2.0 + mass * half_height * half_height / 3.0;
    diagonal(mass, across, across, axial)
}

/// A cylinder and two half spheres, or the sphere alone with `half_height` 0.
fn capsule(radius: f64, half_height: f64, density: f64) -> MassProperties {
    let middle = cylinder(radius, half_height, density);
    let caps = density * 4.0 / 3.0 * PI * radius * radius * radius;
    let sphere = 0.4 * caps * radius * radius;
    // A half sphere's centre of mass is 3/8 r from its flat side.
    let shift = caps * (half_height * half_height + 0.75 * half_height * radius);
    let across = middle.inertia[(0, 0)] + sphere + shift;
    diagonal(
        middle.mass + caps,
        across,
        across,
        middle.inertia[(2, 2)] + sphere,
    )
}

#[cfg(test)]
mod tests;
