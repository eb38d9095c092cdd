//! Contacts with the rest, without contacts in the matrix: conjugate gradients (Hestenes, Stiefel
//! 1952) on the impulses of a Newton step.
//!
//! The linearised laws `l = l0 + S (v - u)` with `S = B B` have the solution `l = l0 + B y`, where `y`
//! solves `(I + B W B) y = B (v - u0)`. `W` is what impulses do to the velocities of contacts, one
//! solve with the factor of everything but contacts, and `u0` is the velocity under `l0`. The matrix is
//! symmetric and at least `I`, and it grows with the slopes only where contacts are tied to each other.
//! Blocks of three on its diagonal, from the mobility, are the preconditioner.

use nalgebra::Matrix3;

use super::budget::Budget;
use super::contact_blocks::best_fraction;
use super::implicit::Implicit;
use super::system::System;
use crate::wire::Vector;

/// Iterations that are done at most; a dozen is usual.
const ITERATIONS: usize = 300;

/// The part of the first error at which a Newton step is good enough, and the part of the tolerance.
const REDUCED: f64 = 1e-2;
const SMALL: f64 = 0.05;

/// Finds the velocities of a Newton step, and the impulses of its contacts, which are noted in them. What
/// it comes to when the budget is spent is a motion too, under impulses that are not those of the
/// linearised laws.
pub(super) fn solve(system: &mut System, tolerance: f64, budget: &mut Budget) -> Vec<f64> {
    solve_to(system, REDUCED, tolerance * SMALL, budget)
}

/// The same to a part of the first error, or an error in m/s.
fn solve_to(system: &mut System, part: f64, least: f64, budget: &mut Budget) -> Vec<f64> {
    for contact in &mut system.implicit {
        contact.set_solved(contact.linearised());
    }
    let cost = system.multiplications_of_response();
    let mut x = system.estimate();
    budget.spend(cost);
    let mut gradients = Gradients::new(&system.implicit, &x);
    let mut error = gradients.error(&system.implicit);
    let goal = (error * part).max(least);
    let mut iterations = 0;
    while error > goal && iterations < ITERATIONS && !budget.is_spent() {
        let pushes = gradients.pushes();
        let mut impulses = vec![0.0; x.len()];
        for (contact, push) in system.implicit.iter().zip(&pushes) {
            contact.push(push, &mut impulses);
        }
        let response = system.response(impulses);
        budget.spend(cost);
        let Some(step) = gradients.advance(&system.implicit, &response) else {
            break;
        };
        for (contact, push) in system.implicit.iter_mut().zip(&pushes) {
            contact.set_solved(contact.solved() + push * step);
        }
        for (x, response) in x.iter_mut().zip(&response) {
            *x += step * response;
        }
        error = gradients.error(&system.implicit);
        iterations += 1;
    }
    x
}

/// Ends a Newton step whose impulses are not those of their laws: with what of them is in the cones of
/// Coulomb's law, times the factor, at most 1, at which there is least energy in them. Returns the
/// velocities.
pub(super) fn end_within_cones(system: &mut System) -> Vec<f64> {
    let contacts = system.implicit.iter();
    let impulses: Vec<Vector> = contacts.map(Implicit::solved_in_cone).collect();
    // Works of the impulses, on velocities with them and without.
    let now = {
        let x = under(system, &impulses, 1.0);
        let pairs = system.implicit.iter().zip(&impulses);
        let works = pairs.map(|(contact, impulse)| impulse.dot(&contact.excess(impulse, &x)));
        works.sum::<f64>()
    };
    let due = {
        let x = under(system, &impulses, 0.0);
        let pairs = system.implicit.iter().zip(&impulses);
        let works =
            pairs.map(|(contact, impulse)| impulse.dot(&contact.excess(&Vector::zeros(), &x)));
        works.sum::<f64>()
    };
    under(system, &impulses, best_fraction(now - due, due))
}

/// Velocities under the multiple of impulses, which is noted in the contacts.
fn under(system: &mut System, impulses: &[Vector], multiple: f64) -> Vec<f64> {
    for (contact, impulse) in system.implicit.iter_mut().zip(impulses) {
        contact.set_solved(impulse * multiple);
    }
    system.estimate()
}

/// Residuals and the direction of the search.
struct Gradients {
    /// `B`.
    roots: Vec<Matrix3<f64>>,
    /// The inverses of the blocks.
    inverses: Vec<Matrix3<f64>>,
    /// `B (v - u) - y`, by contacts.
    residuals: Vec<Vector>,
    direction: Vec<Vector>,
    /// The product of residuals and what the preconditioner makes of them.
    product: f64,
}

impl Gradients {
    /// At the velocities under the impulses of the linearisation.
    fn new(contacts: &[Implicit], x: &[f64]) -> Self {
        let roots: Vec<_> = contacts
            .iter()
            .map(|contact| root(contact.slope()))
            .collect();
        let inverse = |(contact, root): (&Implicit, &Matrix3<f64>)| {
            let block = Matrix3::identity() + root * root * contact.mobility();
            block
                .cholesky()
                .map_or_else(Matrix3::identity, |factor| factor.inverse())
        };
        let inverses: Vec<_> = contacts.iter().zip(&roots).map(inverse).collect();
        let residual =
            |(contact, root): (&Implicit, &Matrix3<f64>)| root * contact.velocity_missing(x);
        let residuals: Vec<_> = contacts.iter().zip(&roots).map(residual).collect();
        let direction: Vec<_> = inverses
            .iter()
            .zip(&residuals)
            .map(|(inverse, r)| inverse * r)
            .collect();
        Gradients {
            product: dot(&residuals, &direction),
            roots,
            inverses,
            residuals,
            direction,
        }
    }

    /// The largest change of a contact's own velocity by an impulse that is still missing, in m/s.
    fn error(&self, contacts: &[Implicit]) -> f64 {
        let each = contacts.iter().zip(&self.roots).zip(&self.residuals);
        each.fold(0.0, |most: f64, ((contact, root), residual)| {
            most.max((root * residual).amax() * contact.mobility())
        })
    }

    /// The impulses of the direction.
    fn pushes(&self) -> Vec<Vector> {
        let each = self.roots.iter().zip(&self.direction);
        each.map(|(root, direction)| root * direction).collect()
    }

    /// Goes along the direction, whose impulses have this response; how far. None at the solution, as well
    /// as it can be told.
    fn advance(&mut self, contacts: &[Implicit], response: &[f64]) -> Option<f64> {
        let images: Vec<Vector> = (contacts.iter().zip(&self.roots).zip(&self.direction))
            .map(|((contact, root), direction)| direction + root * contact.velocity_of(response))
            .collect();
        let step = self.product / dot(&self.direction, &images);
        if !(step > 0.0 && step.is_finite()) {
            return None;
        }
        for (residual, image) in self.residuals.iter_mut().zip(&images) {
            *residual -= image * step;
        }
        let preconditioned: Vec<Vector> = self
            .inverses
            .iter()
            .zip(&self.residuals)
            .map(|(inverse, r)| inverse * r)
            .collect();
        let product = dot(&self.residuals, &preconditioned);
        let kept = product / self.product;
        for (direction, new) in self.direction.iter_mut().zip(preconditioned) {
            *direction = new + *direction * kept;
        }
        self.product = product;
        Some(step)
    }
}

fn dot(a: &[Vector], b: &[Vector]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.dot(b)).sum()
}

/// The root of a symmetric positive semidefinite matrix.
fn root(matrix: &Matrix3<f64>) -> Matrix3<f64> {
    let eigen = matrix.symmetric_eigen();
    let roots = eigen.eigenvalues.map(|value| value.max(0.0).sqrt());
    eigen.eigenvectors * Matrix3::from_diagonal(&roots) * eigen.eigenvectors.transpose()
}

#[cfg(test)]
mod tests;
