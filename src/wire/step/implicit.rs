//! Contacts inside the system, each with its law linearised: a stiffness and an impulse.
//!
//! Newton's method, which finds what pulls and slides, then finds what pushes, sticks and slips at
//! once ([`multipliers`](super::multipliers)).

use std::ops::Range;

use nalgebra::Matrix3;
use smallvec::SmallVec;

use super::augmented::Augmented;
use super::carrier::{Carrier, Layout, velocity_of};
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
    /// The unknowns that give it a velocity.
    points: SmallVec<[Point; 4]>,
    /// Of those that are bodies: the velocity along x, y, z that each component of the angular
    /// velocity gives.
    spins: Vec<Vector>,
    /// The velocity along x, y, z that is prescribed.
    given: Vector,
    law: Augmented,
    /// The velocity at which the law is linearised.
    velocity: Vector,
    /// Its impulse there.
    impulse: Vector,
    /// How fast that falls there.
    slope: Matrix3<f64>,
    /// The impulse of the last solution, if the contact was not in the matrix.
    solved: Option<Vector>,
}

/// Three unknowns, a velocity, and what a contact has of it; of a body three more, its angular
/// velocity.
#[derive(Clone, Debug)]
struct Point {
    first: usize,
    weight: f64,
    /// Where its three spins are; empty if it is no body.
    spins: Range<usize>,
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
        let mut points: SmallVec<[Point; 4]> = SmallVec::new();
        let mut spins = Vec::new();
        let mut given = Vector::zeros();
        for (carrier, weight) in layout.contact(world, contact) {
            given += carrier.prescribed_velocity() * weight;
            let (Carrier::Free(first) | Carrier::Body(first, _)) = carrier else {
                continue;
            };
            let known = points.iter().position(|point| point.first == first);
            let at = known.unwrap_or_else(|| {
                let start = spins.len();
                if let Carrier::Body(..) = carrier {
                    spins.extend([Vector::zeros(); 3]);
                }
                points.push(Point {
                    first,
                    weight: 0.0,
                    spins: start..spins.len(),
                });
                points.len() - 1
            });
            let point = &mut points[at];
            point.weight += weight;
            if let Carrier::Body(_, arm) = carrier {
                for (axis, along) in spins[point.spins.clone()].iter_mut().enumerate() {
                    *along += Vector::ith(axis, weight).cross(&arm);
                }
            }
        }
        let frame = frame(&contact.normal);
        let speed = velocity_of(world, &contact.a) - velocity_of(world, &contact.b);
        let row = normal_row(&world.settings, contact, speed.dot(&contact.normal));
        let mut own = Implicit {
            frame,
            points,
            spins,
            given,
            law: Augmented::none(),
            velocity: Vector::zeros(),
            impulse: Vector::zeros(),
            slope: Matrix3::zeros(),
            solved: None,
        };
        let mobility = own.mobility_by(masses);
        if mobility > 0.0 {
            own.law = Augmented::new(mobility, row, contact.friction, &(frame * impulse));
        }
        own
    }

    /// A third of the trace of its mobility, with nothing else but the diagonal of the masses.
    fn mobility_by(&self, masses: &[f64]) -> f64 {
        let mut sum = 0.0;
        for point in &self.points {
            for axis in 0..3 {
                sum += point.weight * point.weight / masses[point.first + axis];
            }
            for (component, along) in self.spins(point) {
                sum += along.norm_squared() / masses[component];
            }
        }
        sum / 3.0
    }

    /// The components of a body's angular velocity, and the velocity that each gives.
    fn spins(&self, point: &Point) -> impl Iterator<Item = (usize, &Vector)> {
        let first = point.first + 3;
        (first..).zip(&self.spins[point.spins.clone()])
    }

    /// Linearises the law at the velocity of a solution, or where it gives the predicted impulse.
    pub(super) fn linearise(&mut self, x: &[f64], predicted: bool) {
        self.velocity = self.at(x);
        if predicted {
            self.velocity = self.law.expected(&self.velocity);
        }
        self.impulse = self.law.impulse(&self.velocity);
        self.slope = self.law.slope(&self.velocity);
        self.solved = None;
    }

    /// The impulse of the linearisation.
    pub(super) fn linearised(&self) -> Vector {
        self.impulse
    }

    /// The impulse of the last solution, or else of the linearisation.
    pub(super) fn solved(&self) -> Vector {
        self.solved.unwrap_or(self.impulse)
    }

    /// Takes an impulse for that of the solution: it is in no matrix.
    pub(super) fn set_solved(&mut self, impulse: Vector) {
        self.solved = Some(impulse);
    }

    /// What Coulomb's law allows of that.
    pub(super) fn solved_in_cone(&self) -> Vector {
        self.law.allowed(&self.solved())
    }

    /// The velocity at a solution, less that which a contact has that pushes with an impulse and sticks.
    pub(super) fn excess(&self, impulse: &Vector, x: &[f64]) -> Vector {
        self.at(x) - self.law.sticking(impulse)
    }

    /// How fast the linearised impulse falls with the velocity.
    pub(super) fn slope(&self) -> &Matrix3<f64> {
        &self.slope
    }

    /// What an impulse changes of its own velocity, about, in 1/kg; with no other contact, and no wire that
    /// resists.
    pub(super) fn mobility(&self) -> f64 {
        self.law.mobility()
    }

    /// The velocity of the linearisation less that at a solution.
    pub(super) fn velocity_missing(&self, x: &[f64]) -> Vector {
        self.velocity - self.at(x)
    }

    /// The velocity that unknowns give beside what is prescribed.
    pub(super) fn velocity_of(&self, x: &[f64]) -> Vector {
        self.at(x) - self.frame * self.given
    }

    /// Adds an impulse, in its frame, to the unknowns.
    pub(super) fn push(&self, impulse: &Vector, x: &mut [f64]) {
        self.each_part(impulse, |component, part| x[component] += part);
    }

    /// The predicted impulse.
    pub(super) fn prediction(&self) -> Vector {
        self.law.prediction()
    }

    /// Predicts what Coulomb's law allows of an impulse.
    pub(super) fn predict(&mut self, impulse: &Vector) {
        self.law.predict(impulse);
    }

    /// Makes the law harder.
    pub(super) fn harden(&mut self) {
        self.law.harden();
    }

    /// Calls back for each entry that it adds to the mass matrix, on and above the diagonal.
    pub(super) fn each_entry(&self, mut take: impl FnMut(usize, usize, f64)) {
        let slope = self.frame.tr_mul(&(self.slope * self.frame));
        for point in &self.points {
            for axis in 0..3 {
                let force = slope.column(axis) * point.weight;
                self.each_entry_of(point.first + axis, &force, &mut take);
            }
            for (component, along) in self.spins(point) {
                self.each_entry_of(component, &(slope * along), &mut take);
            }
        }
    }

    /// Those of one row, given the force for a unit of its unknown.
    fn each_entry_of(&self, i: usize, force: &Vector, mut take: impl FnMut(usize, usize, f64)) {
        let mut upper = |j: usize, value: f64| {
            if i <= j {
                take(i, j, value);
            }
        };
        for point in &self.points {
            upper(point.first, force.x * point.weight);
            upper(point.first + 1, force.y * point.weight);
            upper(point.first + 2, force.z * point.weight);
            for (component, along) in self.spins(point) {
                upper(component, force.dot(along));
            }
        }
    }

    /// Calls back for each impulse that it has if no unknown moves.
    pub(super) fn each_impulse(&self, take: impl FnMut(usize, f64)) {
        self.each_part(&self.linear(&(self.frame * self.given)), take);
    }

    /// Calls back for each unknown that an impulse changes.
    fn each_part(&self, impulse: &Vector, mut take: impl FnMut(usize, f64)) {
        let impulse = self.frame.tr_mul(impulse);
        for point in &self.points {
            take(point.first, point.weight * impulse.x);
            take(point.first + 1, point.weight * impulse.y);
            take(point.first + 2, point.weight * impulse.z);
            for (component, along) in self.spins(point) {
                take(component, along.dot(&impulse));
            }
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
        let mut sum = self.given;
        for point in &self.points {
            let first = point.first;
            sum += Vector::new(x[first], x[first + 1], x[first + 2]) * point.weight;
            for (component, along) in self.spins(point) {
                sum += along * x[component];
            }
        }
        self.frame * sum
    }

    /// The impulse at a velocity, by the law taken as linear; that of the solution, where it is no
    /// function of velocity.
    fn linear(&self, velocity: &Vector) -> Vector {
        let linear = || self.impulse + self.slope * (self.velocity - velocity);
        self.solved.unwrap_or_else(linear)
    }
}
