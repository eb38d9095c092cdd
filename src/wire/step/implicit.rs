//! Contacts inside the system, each with its law linearised: a stiffness and an impulse.
//!
//! Newton's method, which finds what pulls and slides, then finds what pushes, sticks and slips at
//! once ([`multipliers`](super::multipliers)).

use nalgebra::Matrix3;
use smallvec::SmallVec;

use super::augmented::Augmented;
use super::carrier::{Layout, velocity_of};
use super::rows::normal_row;
use crate::wire::contact::ContactConstraint;
use crate::wire::vector::{Vector, frame};
use crate::wire::world::World;

/// One contact, its law taken as linear at one velocity. Velocities and impulses are those of place
/// A against B, in the frame of the contact.
#[derive(Clone, Debug)]
pub(super) struct Implicit {
    /// Normal and tangents.
    frame: Matrix3<f64>,
    /// The velocity along x, y, z that unknowns give it.
    columns: SmallVec<[(usize, Vector); 12]>,
    /// The velocity along x, y, z that is prescribed.
    given: Vector,
    law: Augmented,
    /// The velocity at which the law is linearised.
    velocity: Vector,
    /// Its impulse there.
    impulse: Vector,
    /// How fast that falls there.
    slope: Matrix3<f64>,
}

impl Implicit {
    /// A contact with a predicted impulse along x, y, z. `masses` is the diagonal of
    /// the mass matrix.
    pub(super) fn new(
        world: &World,
        layout: &Layout,
        masses: &[f64],
        contact: &ContactConstraint,
        impulse: &Vector,
    ) -> Self {
        let mut columns: SmallVec<[(usize, Vector); 12]> = SmallVec::new();
        let mut given = Vector::zeros();
        for (carrier, weight) in layout.contact(world, contact) {
            given += carrier.prescribed_velocity() * weight;
            for axis in 0..3 {
                let direction = Vector::ith(axis, weight);
                carrier.each_column(&direction, |column, value| {
                    match columns.iter_mut().find(|(other, _)| *other == column) {
                        Some((_, along)) => along[axis] += value,
                        None => columns.push((column, Vector::ith(axis, value))),
                    }
                });
            }
        }
        let mobilities = columns
            .iter()
            .map(|(column, along)| along.norm_squared() / masses[*column]);
        let mobility = mobilities.sum::<f64>() / 3.0;
        let frame = frame(&contact.normal);
        let speed = velocity_of(world, &contact.a) - velocity_of(world, &contact.b);
        let row = normal_row(&world.settings, contact, speed.dot(&contact.normal));
        let law = if mobility > 0.0 {
            Augmented::new(mobility, row, contact.friction, &(frame * impulse))
        } else {
            Augmented::none()
        };
        Implicit {
            frame,
            columns,
            given,
            law,
            velocity: Vector::zeros(),
            impulse: Vector::zeros(),
            slope: Matrix3::zeros(),
        }
    }

    /// Linearises the law at the velocity of a solution, or where it gives the predicted impulse.
    pub(super) fn linearise(&mut self, x: &[f64], predicted: bool) {
        self.velocity = self.at(x);
        if predicted {
            self.velocity = self.law.expected(&self.velocity);
        }
        self.impulse = self.law.impulse(&self.velocity);
        self.slope = self.law.slope(&self.velocity);
    }

    /// Calls back for each entry that it adds to the mass matrix, on and above the diagonal.
    pub(super) fn each_entry(&self, mut take: impl FnMut(usize, usize, f64)) {
        let slope = self.frame.tr_mul(&(self.slope * self.frame));
        for (i, along) in &self.columns {
            let force = slope * along;
            for (j, along) in self.columns.iter().filter(|(j, _)| i <= j) {
                take(*i, *j, force.dot(along));
            }
        }
    }

    /// Calls back for each impulse that it has if no unknown moves.
    pub(super) fn each_impulse(&self, mut take: impl FnMut(usize, f64)) {
        let impulse = self.linear(&(self.frame * self.given));
        let impulse = self.frame.tr_mul(&impulse);
        for (column, along) in &self.columns {
            take(*column, along.dot(&impulse));
        }
    }

    /// Impulse on place A along x, y, z at a solution, in N s; a push, never a pull.
    pub(super) fn world_impulse(&self, x: &[f64]) -> Vector {
        let mut impulse = self.linear(&self.at(x));
        impulse.x = impulse.x.max(0.0);
        self.frame.tr_mul(&impulse)
    }

    /// How far velocities are off because the law is not linear, and because another impulse was
    /// predicted, in m/s.
    pub(super) fn residuals(&self, x: &[f64]) -> [f64; 2] {
        let velocity = self.at(x);
        let impulse = self.linear(&velocity);
        let linearisation_error = self.law.linearisation_error(&velocity, &impulse);
        [linearisation_error, self.law.residual(&velocity, &impulse)]
    }

    /// Makes the impulse of a solution the next prediction.
    pub(super) fn update_prediction(&mut self, x: &[f64]) {
        let velocity = self.at(x);
        let impulse = self.linear(&velocity);
        self.law.update_prediction(&velocity, &impulse);
    }

    /// The power of the linearised law's impulse less that of the law, between two solutions, as a
    /// function of the fraction between them.
    pub(super) fn slope_between(&self, x: &[f64], newton: &[f64]) -> impl Fn(f64) -> f64 {
        let start = self.at(x);
        let rise = self.at(newton) - start;
        move |fraction| {
            let velocity = start + rise * fraction;
            rise.dot(&(self.linear(&velocity) - self.law.impulse(&velocity)))
        }
    }

    /// The velocity at a solution.
    fn at(&self, x: &[f64]) -> Vector {
        let columns = self.columns.iter();
        let along = columns.fold(self.given, |sum, (column, along)| sum + along * x[*column]);
        self.frame * along
    }

    /// The impulse at a velocity, by the law taken as linear.
    fn linear(&self, velocity: &Vector) -> Vector {
        self.impulse + self.slope * (self.velocity - velocity)
    }
}
