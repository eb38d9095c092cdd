//! Rigid bodies.

use nalgebra::{Matrix3, UnitQuaternion};

use super::check::{
    finite, finite_point, finite_vector, positive, positive_definite, speed, unit, zero,
};
use super::phases::{out_of_order, phase_at};
use super::shape::PLANE_IS_MASSLESS;
use super::{ModelError, Shape};
use crate::query::Point;
use crate::wire::Vector;

/// A body of a world, by the order in which bodies were added.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct BodyId(pub usize);

impl BodyId {
    /// The body of this number.
    pub(in crate::wire) fn of(self, bodies: &[Body]) -> Result<&Body, ModelError> {
        let (index, count) = (self.0, bodies.len());
        let missing = ModelError::Body { index, count };
        bodies.get(index).ok_or(missing)
    }
}

/// What moves a body.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive {
    /// Nothing does.
    Static,
    /// Its velocity is prescribed: the phases in order of time. Before the first it rests.
    Kinematic(Vec<Phase>),
    /// Forces do. It starts with the given velocities.
    Dynamic {
        /// Density in kg/m^3.
        density: f64,
        /// Velocity of the centre of mass in m/s.
        velocity: Vector,
        /// Angular velocity in rad/s.
        angular_velocity: Vector,
    },
}

/// From a time on, a kinematic body moves at these velocities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    /// Start in s. The phase takes effect with the step that starts nearest to it.
    pub from: f64,
    /// Velocity of the centre of mass in m/s.
    pub velocity: Vector,
    /// Angular velocity in rad/s.
    pub angular_velocity: Vector,
}

/// A body to be added to a world.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyPlan {
    /// Its shape.
    pub shape: Shape,
    /// What moves it.
    pub drive: Drive,
    /// Where its centre of mass starts, in m.
    pub position: Point,
    /// How it starts turned, from its frame to the world.
    pub orientation: UnitQuaternion<f64>,
}

impl BodyPlan {
    /// A body that rests where it is.
    pub fn fixed(shape: Shape, position: Point) -> Self {
        BodyPlan {
            shape,
            drive: Drive::Static,
            position,
            orientation: UnitQuaternion::identity(),
        }
    }

    /// A dynamic body that starts at rest.
    pub fn dynamic(shape: Shape, density: f64, position: Point) -> Self {
        let drive = Drive::Dynamic {
            density,
            velocity: Vector::zeros(),
            angular_velocity: Vector::zeros(),
        };
        BodyPlan {
            drive,
            ..BodyPlan::fixed(shape, position)
        }
    }

    pub(in crate::wire) fn build(self) -> Result<Body, ModelError> {
        let mut body = Body {
            shape: self.shape,
            dynamic: false,
            phases: Vec::new(),
            mass: 0.0,
            inertia: Matrix3::zeros(),
            position: self.position,
            orientation: self.orientation,
            velocity: Vector::zeros(),
            angular_velocity: Vector::zeros(),
        };
        match self.drive {
            Drive::Static => {}
            Drive::Kinematic(phases) => body.phases = phases,
            Drive::Dynamic {
                density,
                velocity,
                angular_velocity,
            } => {
                speed("velocity", &velocity)?;
                speed("angular_velocity", &angular_velocity)?;
                let properties = body.shape.mass_properties(density)?;
                body.dynamic = true;
                (body.mass, body.inertia) = (properties.mass, properties.inertia);
                (body.velocity, body.angular_velocity) = (velocity, angular_velocity);
            }
        }
        body.check()?;
        Ok(body)
    }
}

fn check_phases(phases: &[Phase]) -> Result<(), ModelError> {
    for phase in phases {
        finite("from", phase.from)?;
        speed("velocity", &phase.velocity)?;
        speed("angular_velocity", &phase.angular_velocity)?;
    }
    match out_of_order(phases, |phase| phase.from) {
        Some((phase, from)) => Err(ModelError::PhaseOrder { phase, from }),
        None => Ok(()),
    }
}

/// A body of a world: what it is and how it moves at present.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    pub(in crate::wire) shape: Shape,
    pub(in crate::wire) dynamic: bool,
    pub(in crate::wire) phases: Vec<Phase>,
    pub(in crate::wire) mass: f64,
    pub(in crate::wire) inertia: Matrix3<f64>,
    pub(in crate::wire) position: Point,
    pub(in crate::wire) orientation: UnitQuaternion<f64>,
    pub(in crate::wire) velocity: Vector,
    pub(in crate::wire) angular_velocity: Vector,
}

impl Body {
    pub(in crate::wire) fn check(&self) -> Result<(), ModelError> {
        finite_point("position", &self.position)?;
        for &component in self.orientation.coords.iter() {
            finite("orientation", component)?;
        }
        unit("length of the orientation", self.orientation.norm())?;
        finite_vector("velocity", &self.velocity)?;
        finite_vector("angular_velocity", &self.angular_velocity)?;
        self.shape.check()?;
        check_phases(&self.phases)?;
        if self.dynamic {
            if self.shape == Shape::Plane {
                return Err(PLANE_IS_MASSLESS);
            }
            positive("mass", self.mass)?;
            positive_definite("inertia", &self.inertia)
        } else {
            zero("mass", self.mass)?;
            self.inertia
                .iter()
                .try_for_each(|&moment| zero("inertia", moment))
        }
    }

    /// The shape.
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Whether forces move it.
    pub fn is_dynamic(&self) -> bool {
        self.dynamic
    }

    /// Its prescribed velocities, in order of time; none unless it is kinematic.
    pub fn phases(&self) -> &[Phase] {
        &self.phases
    }

    /// Mass in kg; 0 unless it is dynamic.
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// Inertia about the centre of mass in the body's frame, in kg m^2; 0 unless it is dynamic.
    pub fn inertia(&self) -> &Matrix3<f64> {
        &self.inertia
    }

    /// Centre of mass in m.
    pub fn position(&self) -> Point {
        self.position
    }

    /// From the body's frame to the world.
    pub fn orientation(&self) -> UnitQuaternion<f64> {
        self.orientation
    }

    /// Velocity of the centre of mass in m/s.
    pub fn velocity(&self) -> Vector {
        self.velocity
    }

    /// Angular velocity in rad/s.
    pub fn angular_velocity(&self) -> Vector {
        self.angular_velocity
    }

    /// A point of the body in the world, given in the body's frame relative to the centre of mass.
    pub fn point(&self, local: &Vector) -> Point {
        self.position + self.arm(local)
    }

    /// Velocity in m/s of a point of the body, given as [`point`](Self::point).
    pub fn velocity_at(&self, local: &Vector) -> Vector {
        self.velocity + self.angular_velocity.cross(&self.arm(local))
    }

    /// From the centre of mass to a point of the body, turned into the world.
    pub(in crate::wire) fn arm(&self, local: &Vector) -> Vector {
        self.orientation * local
    }

    /// A mass in kg that is fixed to a point from now on brings its momentum. Returns the velocity of
    /// the two in m/s; that of the mass alone if nothing is known of how the body turns.
    pub(in crate::wire) fn take_up(
        &mut self,
        local: &Vector,
        mass: f64,
        momentum: &Vector,
    ) -> Vector {
        let arm = self.arm(local);
        let cross = arm.cross_matrix();
        let turn = self.world_inertia().try_inverse();
        let together = turn.and_then(|turn| {
            // What an impulse at the point changes of its velocity.
            let mobility = Matrix3::identity() / self.mass - cross * turn * cross;
            let share = (Matrix3::identity() + mobility * mass).try_inverse()?;
            let impulse = share * (momentum - self.velocity_at(local) * mass);
            Some((impulse, turn * arm.cross(&impulse)))
        });
        let Some((impulse, turned)) = together else {
            return momentum / mass;
        };
        self.velocity += impulse / self.mass;
        self.angular_velocity += turned;
        self.velocity_at(local)
    }

    pub(in crate::wire) fn world_inertia(&self) -> Matrix3<f64> {
        let rotation = self.orientation.to_rotation_matrix();
        rotation * self.inertia * rotation.transpose()
    }

    /// The prescribed velocity and angular velocity in the step that starts at a time.
    pub(in crate::wire) fn prescribed(&self, time: f64, step: f64) -> (Vector, Vector) {
        match phase_at(&self.phases, |phase| phase.from, time, step) {
            Some(phase) => (phase.velocity, phase.angular_velocity),
            None => (Vector::zeros(), Vector::zeros()),
        }
    }
}
