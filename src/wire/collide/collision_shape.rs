//! Shapes in the terms of the collision library, and where two of them touch.
//!
//! A piece of wire is a capsule (thesis, table 3.2); triangle meshes bring their own hierarchy of
//! volumes, the middle phase. The library is built without operations that depend on the machine.

use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::UnitQuaternion;
use parry3d_f64::math::{Pose, Rotation, Vector as Vec3};
use parry3d_f64::query::{
    ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher, QueryDispatcher,
    TrackedContact,
};
use parry3d_f64::shape::{
    Segment, Shape as ShapeOfLibrary, SharedShape, TriMeshBuilderError, TriMeshFlags, Triangle,
};

use crate::broad::{Aabb, BroadError};
use crate::query::Point;
use crate::wire::Vector;
use crate::wire::model::{Mesh, Shape};

/// A shape in its own frame.
pub(super) struct CollisionShape {
    shape: SharedShape,
    /// From the library's frame to its own.
    turned: Rotation,
    /// No part of it is farther from the origin of its frame, in m; infinite for a plane.
    pub(super) extent: f64,
}

/// A shape at its place.
pub(super) struct PlacedShape<'f> {
    form: &'f CollisionShape,
    pose: Pose,
}

/// Where two shapes touch, or nearly do.
pub(super) struct ManifoldPoint {
    /// On the surface of each.
    pub(super) points: [Point; 2],
    /// Unit normal from the second to the first.
    pub(super) normal: Vector,
    /// Distance of the surfaces along it in m, below 0 where they penetrate.
    pub(super) gap: f64,
}

impl CollisionShape {
    /// The shape of a body, in the body's frame.
    pub(super) fn of_body(shape: &Shape) -> Result<Self, TriMeshBuilderError> {
        let mut turned = Rotation::IDENTITY;
        let shape = match shape {
            Shape::Box { half } => SharedShape::cuboid(half.x, half.y, half.z),
            Shape::Cylinder {
                radius,
                half_height,
            } => {
                // The library's cylinder is around y.
                turned = Rotation::from_xyzw(FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2);
                SharedShape::cylinder(*half_height, *radius)
            }
            Shape::Sphere { radius } => SharedShape::ball(*radius),
            Shape::Capsule {
                radius,
                half_height,
            } => SharedShape::capsule_z(*half_height, *radius),
            Shape::Plane => SharedShape::halfspace(Vec3::Z),
            Shape::Mesh(mesh) => trimesh(mesh)?,
        };
        let extent = match shape.as_halfspace() {
            Some(_) => f64::INFINITY,
            None => {
                let sphere = shape.compute_local_bounding_sphere();
                sphere.center.length() + sphere.radius
            }
        };
        Ok(CollisionShape {
            shape,
            turned,
            extent,
        })
    }

    /// A straight piece of wire, in the frame of its middle.
    pub(super) fn of_segment(ends: &[Point; 2], radius: f64) -> Self {
        let half = (ends[1] - ends[0]) / 2.0;
        let shape = SharedShape::capsule(to_library(&-half), to_library(&half), radius);
        CollisionShape {
            shape,
            turned: Rotation::IDENTITY,
            extent: half.norm() + radius,
        }
    }

    /// This shape where its frame is.
    pub(super) fn at(
        &self,
        position: &Point,
        orientation: &UnitQuaternion<f64>,
    ) -> PlacedShape<'_> {
        let q = orientation.coords;
        let rotation = Rotation::from_xyzw(q.x, q.y, q.z, q.w);
        let pose = Pose::from_parts(to_library(&position.coords), rotation * self.turned);
        PlacedShape { form: self, pose }
    }
}

fn trimesh(mesh: &Mesh) -> Result<SharedShape, TriMeshBuilderError> {
    let vertices = mesh.vertices().iter();
    let vertices = vertices.map(|vertex| to_library(&vertex.coords)).collect();
    let triangles = mesh.triangles().iter();
    let triangles = triangles.map(|corners| corners.map(|corner| corner as u32));
    let flags = TriMeshFlags::FIX_INTERNAL_EDGES;
    SharedShape::trimesh_with_flags(vertices, triangles.collect(), flags)
}

impl PlacedShape<'_> {
    /// A box that holds it and everything nearer than `margin`; all of space for a plane.
    pub(super) fn aabb(&self, margin: f64) -> Result<Aabb, BroadError> {
        if self.form.extent.is_infinite() {
            let [low, high] = [f64::NEG_INFINITY, f64::INFINITY];
            return Aabb::new(Point::new(low, low, low), Point::new(high, high, high));
        }
        let bounds = self.form.shape.compute_aabb(&self.pose);
        let margin = Vec3::splat(margin);
        let [low, high] = [bounds.mins - margin, bounds.maxs + margin].map(from_library);
        Aabb::new(low.into(), high.into())
    }

    /// How far a point is from its surface in m, below 0 inside.
    pub(super) fn distance(&self, point: &Point) -> f64 {
        let point = to_library(&point.coords);
        let nearest = self.form.shape.project_point(&self.pose, point, false);
        let apart = (nearest.point - point).length();
        // The library finds no direction from the centre of a ball.
        if apart.is_nan() {
            -self.form.extent
        } else if nearest.is_inside {
            -apart
        } else {
            apart
        }
    }

    /// Whether two pieces of a midline, from the first corner over the second to the third, do not
    /// meet it, but the triangle does that straightening them sweeps.
    pub(super) fn is_swept(&self, corners: &[Point; 3]) -> bool {
        let [a, b, c] = corners.map(|corner| to_library(&corner.coords));
        let before = [Segment::new(a, b), Segment::new(b, c)];
        self.meets(&Triangle::new(a, b, c)) && !before.iter().any(|piece| self.meets(piece))
    }

    /// By how much deeper in it a straight wire is from the first corner to the third than over the
    /// second, in m.
    pub(super) fn deepens(&self, corners: &[Point; 3], radius: f64) -> f64 {
        let [a, b, c] = *corners;
        let depth = |ends: [Point; 2]| {
            self.touched_by(&ends, radius)
                .iter()
                .fold(0.0_f64, |depth, spot| depth.max(-spot.gap))
        };
        depth([a, c]) - depth([a, b]).max(depth([b, c]))
    }

    /// Where a straight piece of wire touches it; the first of the two is the wire.
    pub(super) fn touched_by(&self, ends: &[Point; 2], radius: f64) -> Vec<ManifoldPoint> {
        let piece = CollisionShape::of_segment(ends, radius);
        let middle = nalgebra::center(&ends[0], &ends[1]);
        let placed = piece.at(&middle, &UnitQuaternion::identity());
        placed.touches(self, 0.0)
    }

    /// Whether a shape in the world meets it.
    fn meets(&self, shape: &dyn ShapeOfLibrary) -> bool {
        let own = &*self.form.shape;
        let met = DefaultQueryDispatcher.intersection_test(&self.pose.inverse(), own, shape);
        // Everything is supported with pieces and triangles.
        met.is_ok_and(|intersection| intersection.intersecting)
    }

    /// Where the surfaces are closer than `reach`: one to four places on convex shapes, more on
    /// others.
    pub(super) fn touches(&self, other: &Self, reach: f64) -> Vec<ManifoldPoint> {
        let mut manifolds: Vec<ContactManifold<(), ()>> = Vec::new();
        let between = self.pose.inv_mul(&other.pose);
        let shapes = [self, other].map(|placed| &*placed.form.shape);
        // Every pair that is asked for is supported: two planes, which are not, are never dynamic.
        let supported = DefaultQueryDispatcher.contact_manifolds(
            &between,
            shapes[0],
            shapes[1],
            reach,
            &mut manifolds,
            &mut None,
        );
        if supported.is_err() {
            return Vec::new();
        }
        let spots = manifolds.iter().flat_map(|manifold| {
            let points = manifold.points.iter();
            points.filter_map(|point| self.spot(other, manifold, point, reach))
        });
        spots.collect()
    }

    fn spot(
        &self,
        other: &Self,
        manifold: &ContactManifold<(), ()>,
        point: &TrackedContact<()>,
        reach: f64,
    ) -> Option<ManifoldPoint> {
        let normal = -from_library(self.pose.rotation * manifold.local_n1);
        let points = [
            self.pose.transform_point(point.local_p1),
            other.pose.transform_point(point.local_p2),
        ];
        // The library may name points of a face that are farther away.
        let near = point.dist <= reach;
        let is_unit = (normal.norm() - 1.0).abs() < 1e-6;
        (near && is_unit).then(|| ManifoldPoint {
            points: points.map(|point| Point::from(from_library(point))),
            normal: normal.normalize(),
            gap: point.dist,
        })
    }
}

fn to_library(vector: &Vector) -> Vec3 {
    Vec3::new(vector.x, vector.y, vector.z)
}

fn from_library(vector: Vec3) -> Vector {
    Vector::new(vector.x, vector.y, vector.z)
}

#[cfg(test)]
mod tests;
