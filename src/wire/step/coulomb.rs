//! Coulomb's law at one contact, with all others held.

use nalgebra::{Cholesky, Matrix3, U3, Vector2};

use crate::wire::Vector;

/// Impulse of one contact by Coulomb's law: `u = mobility impulse + others`; apart (`u_n >= 0`) without
/// impulse, or `u_n = 0` and the tangential impulse within the cone, against the sliding on its border.
/// `factor` is that of the mobility, if it has one.
pub(super) fn solve_block(
    mobility: &Matrix3<f64>,
    factor: Option<&Cholesky<f64, U3>>,
    others: &Vector,
    friction: f64,
    start: &Vector,
) -> Vector {
    // The tangential rows are not regularised: without mobility there, nothing can move the places.
    let immovable = mobility[(1, 1)] <= 0.0;
    if others.x >= 0.0 || immovable {
        return Vector::zeros();
    }
    if let Some(factor) = factor {
        let stick = -factor.solve(others);
        if stick.x >= 0.0 && stick.yz().norm() <= friction * stick.x {
            return stick;
        }
    }
    let sliding = slide(mobility, others, friction, start);
    sliding.unwrap_or_else(|| project(mobility, others, friction, start))
}

/// The sliding solution, by Newton's method over the direction `d` of friction. None where that leads nowhere.
///
/// With `u_n = 0` the impulse is `n (1, f d)`, `n = -others_n / a` and `a = m_nn + f m_nt . d`. The sliding,
/// `a u_t = a others_t - others_n (m_tn + f M_tt d)`, has to be along `-d`.
fn slide(
    mobility: &Matrix3<f64>,
    others: &Vector,
    friction: f64,
    start: &Vector,
) -> Option<Vector> {
    const ITERATIONS: usize = 10;
    /// The last change of direction: its square is below rounding.
    const SMALL: f64 = 1e-9;
    let coupling = Vector2::new(mobility[(0, 1)], mobility[(0, 2)]);
    let tangential = mobility.fixed_view::<2, 2>(1, 1).into_owned();
    let last = start.yz();
    let first = if last.norm_squared() > 0.0 {
        last
    } else {
        -others.yz()
    };
    let mut along = first.try_normalize(0.0)?;
    for _ in 0..ITERATIONS {
        let across = Vector2::new(-along.y, along.x);
        let normal = mobility[(0, 0)] + friction * coupling.dot(&along);
        let sliding = others.yz() * normal - (coupling + tangential * along * friction) * others.x;
        let turned = others.yz() * coupling.dot(&across) - tangential * across * others.x;
        let slope = friction * across.dot(&turned) - along.dot(&sliding);
        let change = -across.dot(&sliding) / slope;
        // With more than a radian Newton's method is lost; NaN is no change either.
        let is_found = normal > 0.0 && slope > 0.0 && change.abs() < 1.0;
        if !is_found {
            return None;
        }
        along = (along + across * change).normalize();
        if change.abs() <= SMALL {
            let push = -others.x / (mobility[(0, 0)] + friction * coupling.dot(&along));
            let pull = along * (friction * push);
            let opposes = along.dot(&sliding) <= 0.0;
            return opposes.then(|| Vector::new(push, pull.x, pull.y));
        }
    }
    None
}

/// The sliding solution by projections: normal impulse and projection of the tangential one in turn. Only a scalar step
/// keeps the fixed point that in which the impulse is opposite to the sliding.
fn project(mobility: &Matrix3<f64>, others: &Vector, friction: f64, start: &Vector) -> Vector {
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

fn to_disk(vector: Vector2<f64>, radius: f64) -> Vector2<f64> {
    let length = vector.norm();
    if length > radius {
        vector * (radius / length)
    } else {
        vector
    }
}

#[cfg(test)]
mod tests;
