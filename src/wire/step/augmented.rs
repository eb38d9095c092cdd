//! Coulomb's law as a function of velocity, near a predicted impulse (Alart, Curnier, CMAME 92,
//! 1991).
//!
//! The law itself is no function of velocity: a contact that does not move may have any impulse of
//! its cone. The method of multipliers (augmented Lagrangian) makes it one, near a predicted
//! impulse and for a predicted bound of friction. Where the solution has the predicted impulse, it
//! satisfies Coulomb's law; else its impulse is the next prediction. For any prediction, the
//! negative of the impulse is the gradient of a convex function of the velocity.

use nalgebra::{Matrix2, Matrix3, Vector2};

use super::coulomb::{to_cone, to_disk};
use super::softness::Softness;
use crate::wire::Vector;

/// The impulse of one contact by its velocity `u`, both in the contact's frame: along the normal,
/// then across.
#[derive(Clone, Copy, Debug)]
pub(super) struct Augmented {
    /// Regularisation of the normal row, in 1/kg.
    sigma: f64,
    /// What is asked for of the normal velocity, in m/s.
    target: f64,
    friction: f64,
    /// The predicted impulse, in N s.
    predicted: Vector,
    /// The largest friction, in N s.
    bound: f64,
    /// Whether it is predicted to slide.
    slides: bool,
    softness: Softness,
}

impl Augmented {
    /// The law of a contact with a predicted impulse.
    pub(super) fn new(
        mobility: f64,
        [target, sigma]: [f64; 2],
        friction: f64,
        impulse: &Vector,
    ) -> Self {
        /// Rounding of an impulse that was on the border of its cone.
        const BORDER: f64 = 1.0 - 1e-7;
        let slides = impulse.yz().norm() >= BORDER * friction * impulse.x;
        let impulse = to_cone(impulse, friction);
        Augmented {
            sigma,
            target,
            friction,
            predicted: impulse,
            bound: friction * impulse.x,
            slides,
            softness: Softness::new(mobility),
        }
    }

    /// That of a contact which nothing can move: no impulse.
    pub(super) fn none() -> Self {
        Augmented::new(1.0, [f64::NEG_INFINITY, 0.0], 0.0, &Vector::zeros())
    }

    /// The impulse at a velocity: `((target - u_n + soft predicted_n) / (soft + sigma))+` and what
    /// of `predicted_t - u_t / soft` is within the bound.
    pub(super) fn impulse(&self, velocity: &Vector) -> Vector {
        let normal = (self.push(velocity) / (self.sigma + self.softness.compliance)).max(0.0);
        let tangential = to_disk(self.stuck(velocity), self.bound);
        Vector::new(normal, tangential.x, tangential.y)
    }

    /// How fast the impulse falls with the velocity, in kg: symmetric, and positive semidefinite.
    pub(super) fn slope(&self, velocity: &Vector) -> Matrix3<f64> {
        let stuck = self.stuck(velocity);
        let length = stuck.norm();
        let across = if length <= self.bound {
            Matrix2::identity()
        } else {
            let along = stuck / length;
            (Matrix2::identity() - along * along.transpose()) * (self.bound / length)
        };
        let mut slope = Matrix3::zeros();
        if self.push(velocity) > 0.0 {
            slope[(0, 0)] = 1.0 / (self.sigma + self.softness.compliance);
        }
        let mut tangential = slope.fixed_view_mut::<2, 2>(1, 1);
        tangential.copy_from(&(across / self.softness.compliance));
        slope
    }

    /// The velocity nearest to another one at which the law gives the predicted impulse.
    pub(super) fn expected(&self, near: &Vector) -> Vector {
        let pushed = self.target - self.sigma * self.predicted.x;
        let normal = if self.predicted.x > 0.0 {
            pushed
        } else {
            near.x.max(pushed)
        };
        if self.slides {
            Vector::new(normal, near.y, near.z)
        } else {
            Vector::new(normal, 0.0, 0.0)
        }
    }

    /// How far velocities are off if an impulse is taken for that of the law, in m/s.
    pub(super) fn linearisation_error(&self, velocity: &Vector, impulse: &Vector) -> f64 {
        (self.impulse(velocity) - impulse).amax() * self.softness.mobility
    }

    /// How far velocities are off because an impulse differs from the prediction, in m/s.
    pub(super) fn residual(&self, velocity: &Vector, impulse: &Vector) -> f64 {
        let given_way = (impulse - self.predicted).amax() * self.softness.compliance;
        let bound = self.friction * impulse.x;
        let unbound = if self.is_sliding(velocity) {
            (bound - self.bound).abs()
        } else {
            impulse.yz().norm() - bound
        };
        given_way.max(unbound * self.softness.mobility)
    }

    /// What an impulse changes of its own velocity, about, in 1/kg.
    pub(super) fn mobility(&self) -> f64 {
        self.softness.mobility
    }

    /// What Coulomb's law allows of an impulse.
    pub(super) fn allowed(&self, impulse: &Vector) -> Vector {
        to_cone(impulse, self.friction)
    }

    /// The velocity of a contact that pushes with an impulse and sticks.
    pub(super) fn sticking(&self, impulse: &Vector) -> Vector {
        Vector::new(self.target - self.sigma * impulse.x, 0.0, 0.0)
    }

    /// The predicted impulse.
    pub(super) fn prediction(&self) -> Vector {
        self.predicted
    }

    /// Predicts what Coulomb's law allows of an impulse.
    pub(super) fn predict(&mut self, impulse: &Vector) {
        self.predicted = self.allowed(impulse);
        self.bound = self.friction * self.predicted.x;
    }

    /// Predicts the impulse that came out at a velocity.
    pub(super) fn update_prediction(&mut self, velocity: &Vector, impulse: &Vector) {
        self.slides = self.is_sliding(velocity);
        self.predicted = Vector::new(impulse.x.max(0.0), impulse.y, impulse.z);
        self.bound = self.friction * self.predicted.x;
    }

    /// Gives way less to what is not predicted.
    pub(super) fn harden(&mut self) {
        self.softness.harden();
    }

    /// Above 0 where it pushes, in m/s.
    fn push(&self, velocity: &Vector) -> f64 {
        self.target - velocity.x + self.softness.compliance * self.predicted.x
    }

    /// The friction if there were no bound.
    fn stuck(&self, velocity: &Vector) -> Vector2<f64> {
        self.predicted.yz() - velocity.yz() / self.softness.compliance
    }

    fn is_sliding(&self, velocity: &Vector) -> bool {
        self.stuck(velocity).norm() > self.bound
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// Laws that push or not, with more or less friction than is predicted.
    fn laws(rng: &mut ChaCha8Rng) -> Augmented {
        let impulse = Vector::from_fn(|_, _| rng.random_range(-1.0..1.0));
        let row = [rng.random_range(-0.1..0.1), rng.random_range(0.0..0.1)];
        Augmented::new(2.0, row, 0.5, &impulse)
    }

    #[test]
    fn slope_is_that_of_the_impulse_and_never_rises() {
        let rng = &mut ChaCha8Rng::seed_from_u64(1);
        let mut kinds = [0; 3];
        for _ in 0..1000 {
            let law = laws(rng);
            let fastest = [0.02, 0.002][rng.random_range(0..2)];
            let velocity = Vector::from_fn(|_, _| rng.random_range(-fastest..fastest));
            let slope = law.slope(&velocity);
            kinds[usize::from(law.is_sliding(&velocity))] += 1;
            kinds[2] += usize::from(law.impulse(&velocity).x > 0.0);
            for axis in 0..3 {
                let by = Vector::ith(axis, 1e-7);
                let change = law.impulse(&(velocity - by)) - law.impulse(&(velocity + by));
                let difference = (change / 2e-7 - slope.column(axis)).amax();
                assert!(
                    difference < 1e-4 * slope.amax().max(1.0),
                    "{law:?} {velocity}"
                );
            }
            assert_eq!(slope, slope.transpose());
            let least = slope.symmetric_eigenvalues().min();
            assert!(least >= -1e-12 * slope.amax());
        }
        assert!(kinds.iter().all(|count| *count > 100), "{kinds:?}");
    }

    #[test]
    fn predicted_impulse_comes_out_at_the_expected_velocity_without_residual() {
        let rng = &mut ChaCha8Rng::seed_from_u64(2);
        let mut sliding = 0;
        for _ in 0..1000 {
            let law = laws(rng);
            let near = Vector::from_fn(|_, _| rng.random_range(-1.0..1.0));
            // What slides goes against its friction.
            let against = -law.predicted.yz() * rng.random_range(0.0..1.0);
            let near = if law.slides {
                Vector::new(near.x, against.x, against.y)
            } else {
                near
            };
            sliding += usize::from(law.slides && law.predicted.x > 0.0);
            let expected = law.expected(&near);
            let impulse = law.impulse(&expected);
            assert!((impulse - law.predicted).amax() < 1e-12, "{law:?} {near}");
            assert!(law.residual(&expected, &impulse) < 1e-12);
        }
        assert!(sliding > 100, "{sliding}");
    }

    #[test]
    fn what_nothing_can_move_has_no_impulse() {
        let law = Augmented::none();
        for speed in [-1e9, 0.0, 1e9] {
            assert_eq!(law.impulse(&Vector::repeat(speed)), Vector::zeros());
        }
    }
}
