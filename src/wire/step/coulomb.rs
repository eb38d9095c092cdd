//! Coulomb's law at one contact, with all others held.

use nalgebra::{Cholesky, Const, Matrix3, Vector2};

use crate::wire::Vector;

/// The mobility of a contact, and its factor if there is one.
pub(super) struct Mobility {
    matrix: Matrix3<f64>,
    factor: Option<Cholesky<f64, Const<3>>>,
}

impl Mobility {
    pub(super) fn new(matrix: Matrix3<f64>) -> Self {
        let factor = matrix.cholesky();
        Mobility { matrix, factor }
    }

    pub(super) fn matrix(&self) -> &Matrix3<f64> {
        &self.matrix
    }
}

/// Impulse of one contact by Coulomb's law: `u = mobility impulse + others`; apart (`u_n >= 0`)
/// without impulse, or `u_n = 0` and the tangential impulse within the cone, against the sliding on
/// its border.
pub(super) fn solve_block(
    mobility: &Mobility,
    others: &Vector,
    friction: f64,
    start: &Vector,
) -> Vector {
    let Mobility { matrix, factor } = mobility;
    // The tangential rows are not regularised: without mobility there, nothing can move the places.
    let immovable = matrix[(1, 1)] <= 0.0;
    if others.x >= 0.0 || immovable {
        return Vector::zeros();
    }
    if let Some(factor) = factor {
        let stick = -factor.solve(others);
        if stick.x >= 0.0 && stick.yz().norm() <= friction * stick.x {
            return stick;
        }
    }
    slide(matrix, others, friction, start)
}

/// The sliding solution: normal impulse and projection of the tangential one in turn. Only a scalar
/// step keeps the fixed point that in which the impulse is opposite to the sliding.
fn slide(mobility: &Matrix3<f64>, others: &Vector, friction: f64, start: &Vector) -> Vector {
    const ITERATIONS: usize = 20;
    let step = 1.0 / (mobility[(1, 1)] + mobility[(2, 2)]);
    let mut impulse = *start;
    for _ in 0..ITERATIONS {
        let without = others.x + mobility[(0, 1)] * impulse.y + mobility[(0, 2)] * impulse.z;
        impulse.x = (-without / mobility[(0, 0)]).max(0.0);
        let sliding = (mobility * impulse + others).yz();
        let tangential = to_disk(impulse.yz() - sliding * step, friction * impulse.x);
        let change = (tangential - impulse.yz()).amax();
        (impulse.y, impulse.z) = (tangential.x, tangential.y);
        if change <= 1e-15 * impulse.x {
            break;
        }
    }
    impulse
}

/// The impulse without pull, and with no more friction than its push allows.
pub(super) fn to_cone(impulse: &Vector, friction: f64) -> Vector {
    let normal = impulse.x.max(0.0);
    let tangential = to_disk(impulse.yz(), friction * normal);
    Vector::new(normal, tangential.x, tangential.y)
}

/// The nearest of a disk.
pub(super) fn to_disk(vector: Vector2<f64>, radius: f64) -> Vector2<f64> {
    let length = vector.norm();
    if length > radius {
        vector * (radius / length)
    } else {
        vector
    }
}
