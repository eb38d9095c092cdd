//! Additive CCD of a vertex and a face, to compare with: the same algorithm as [`tunnelproof::additive`], with the distance of a point
//! from a triangle.

use nalgebra::Vector3;
use tunnelproof::query::VertexFace;

/// The rescaling of the paper's experiments.
const RESCALING: f64 = 0.9;

/// After so many advances it counts as contact.
const MOST_STEPS: usize = 10_000;

/// The time at which the two are nearly in contact.
pub(crate) fn toi(query: &VertexFace) -> Option<f64> {
    let mut x = query.start().map(|point| point.coords);
    let mut p = [0, 1, 2, 3].map(|i| query.end()[i] - query.start()[i]);
    let mean = (p[0] + p[1] + p[2] + p[3]) / 4.0;
    p.iter_mut().for_each(|p| *p -= mean);
    let speed = p[0].norm() + p[1].norm().max(p[2].norm()).max(p[3].norm());
    let left = |x: &[Vector3<f64>; 4]| distance(x) - query.radius().rounded();
    let mut gap = left(&x);
    if gap <= 0.0 {
        return Some(0.0);
    }
    if speed == 0.0 {
        return None;
    }
    let enough = (1.0 - RESCALING) * gap;
    let mut t = 0.0;
    for _ in 0..MOST_STEPS {
        let step = RESCALING * gap / speed;
        x.iter_mut().zip(&p).for_each(|(x, p)| *x += p * step);
        gap = left(&x);
        if t > 0.0 && gap < enough {
            return Some(t);
        }
        t += step;
        if t > 1.0 {
            return None;
        }
    }
    Some(t)
}

/// The distance of the point `A` from the triangle `BCD`, by the region in which its nearest point is (Ericson, "Real-Time Collision
/// Detection", 2005, 5.1.5).
fn distance([a, b, c, d]: &[Vector3<f64>; 4]) -> f64 {
    let (e, f) = (c - b, d - b);
    let [from_b, from_c, from_d] = [b, c, d].map(|corner| a - corner);
    let [[b1, b2], [c1, c2], [d1, d2]] =
        [from_b, from_c, from_d].map(|way| [e.dot(&way), f.dot(&way)]);
    let of_d = b1 * c2 - c1 * b2;
    let of_c = d1 * b2 - b1 * d2;
    let of_b = c1 * d2 - d1 * c2;
    let way = if b1 <= 0.0 && b2 <= 0.0 {
        from_b
    } else if c1 >= 0.0 && c2 <= c1 {
        from_c
    } else if d2 >= 0.0 && d1 <= d2 {
        from_d
    } else if of_d <= 0.0 && b1 >= 0.0 && c1 <= 0.0 {
        from_b - e * (b1 / (b1 - c1))
    } else if of_c <= 0.0 && b2 >= 0.0 && d2 <= 0.0 {
        from_b - f * (b2 / (b2 - d2))
    } else if of_b <= 0.0 && c2 >= c1 && d1 >= d2 {
        let part = (c2 - c1) / ((c2 - c1) + (d1 - d2));
        from_c - (d - c) * part
    } else {
        let sum = of_b + of_c + of_d;
        from_b - e * (of_c / sum) - f * (of_d / sum)
    };
    way.norm()
}
