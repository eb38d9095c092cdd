//! Estimates in floating point; whatever uses them proves what follows by exact signs.

use std::cmp::Ordering;

/// A root between `low` and `high` in floating point, by Newton steps and halving; `before` is the
/// sign before it. Only an estimate.
pub(super) fn estimate_root(c: &[f64; 4], low: f64, high: f64, before: Ordering) -> f64 {
    let (mut low, mut high) = (low, high);
    let mut t = 0.5 * (low + high);
    // Ends: after so many steps, converged or not.
    for _ in 0..60 {
        let value = ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
        if (value < 0.0) == before.is_lt() {
            low = t;
        } else {
            high = t;
        }
        let newton = t - value / slope(c, t);
        let next = if newton >= low && newton <= high {
            newton
        } else {
            0.5 * (low + high)
        };
        if (next - t).abs() <= 2.0 * f64::EPSILON * t {
            return next;
        }
        t = next;
    }
    t
}

/// The derivative of a polynomial.
pub(super) fn slope(c: &[f64; 4], t: f64) -> f64 {
    (3.0 * c[3] * t + 2.0 * c[2]) * t + c[1]
}

/// An `f64` strictly between two others that are at least 0, about in the middle of all of them;
/// `None` if there is none.
pub(super) fn between(below: f64, above: f64) -> Option<f64> {
    let (low, high) = (below.to_bits(), above.to_bits());
    (high > low + 1).then(|| f64::from_bits(low + (high - low) / 2))
}

/// Where in `(0, 1)` a polynomial of the sign `first` at both ends comes nearest to the other sign,
/// or farthest into it.
pub(super) fn turning_point(c: &[f64; 4], first: Ordering) -> Option<f64> {
    let value = |t: f64| ((c[3] * t + c[2]) * t + c[1]) * t + c[0];
    let depth = |t: &f64| if first.is_lt() { value(*t) } else { -value(*t) };
    let inside = turning_points(c)
        .into_iter()
        .filter(|&t| t > 0.0 && t < 1.0);
    inside.max_by(|s, t| depth(s).total_cmp(&depth(t)))
}

/// Where a multiple root of a cubic would be: the roots of the derivative, and that of the second
/// one.
pub(super) fn multiple_roots(c: &[f64; 4]) -> [f64; 3] {
    let [first, second] = turning_points(c);
    [first, second, -c[2] / (3.0 * c[3])]
}

/// The roots of the derivative, `3 c3 t^2 + 2 c2 t + c1`, by the formula that does not cancel.
pub(super) fn turning_points(c: &[f64; 4]) -> [f64; 2] {
    let (a, half_b) = (3.0 * c[3], c[2]);
    let root = (half_b * half_b - a * c[1]).sqrt();
    let sum = -(half_b + root.copysign(half_b));
    [sum / a, c[1] / sum]
}
