//! The closest points of two segments, in `f64`. Heuristic: nothing that is proved rests on it.

use nalgebra::Vector3;

/// The distance of two segments.
pub(crate) fn distance(x: &[Vector3<f64>; 4]) -> f64 {
    let (u, v) = closest(x);
    let [a, b, c, d] = x;
    (a + (b - a) * u - c - (d - c) * v).norm()
}

/// The parameters of the closest points of two segments (Ericson, Real-Time Collision Detection,
/// 5.1.9).
pub(crate) fn closest([a, b, c, d]: &[Vector3<f64>; 4]) -> (f64, f64) {
    let (k, l, r) = (b - a, d - c, a - c);
    let (kk, ll, lr) = (k.dot(&k), l.dot(&l), l.dot(&r));
    if kk == 0.0 && ll == 0.0 {
        return (0.0, 0.0);
    }
    if kk == 0.0 {
        return (0.0, (lr / ll).clamp(0.0, 1.0));
    }
    let kr = k.dot(&r);
    if ll == 0.0 {
        return ((-kr / kk).clamp(0.0, 1.0), 0.0);
    }
    let kl = k.dot(&l);
    let determinant = kk * ll - kl * kl;
    let u = if determinant > 0.0 {
        ((kl * lr - kr * ll) / determinant).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let v = (kl * u + lr) / ll;
    if v < 0.0 {
        ((-kr / kk).clamp(0.0, 1.0), 0.0)
    } else if v > 1.0 {
        (((kl - kr) / kk).clamp(0.0, 1.0), 1.0)
    } else {
        (u, v)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn closest_points_of_parallel_and_point_segments() {
        let v = Vector3::new;
        let (a, b) = (v(0.0, 0.0, 0.0), v(1.0, 0.0, 0.0));
        assert_eq!(
            distance(&[a, b, v(3.0, 1.0, 0.0), v(2.0, 1.0, 0.0)]),
            2f64.sqrt()
        );
        assert_eq!(distance(&[a, a, v(-1.0, 2.0, 0.0), v(1.0, 2.0, 0.0)]), 2.0);
        assert_eq!(distance(&[a, b, v(0.25, 0.0, 3.0), v(0.25, 0.0, 3.0)]), 3.0);
    }
}
