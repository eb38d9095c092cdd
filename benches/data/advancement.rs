//! Conservative advancement of two edges, one of a body that turns, for comparison.
//!
//! After Mirtich, "Impulse-based dynamic simulation of rigid body systems", PhD thesis, 1996, with
//! the bound of motion along the direction of the closest points of Zhang, Lee and Kim, "Interactive
//! continuous collision detection for non-convex polyhedra", 2006: no point comes nearer along it
//! than by the speed of the centre along it and the speed of the turn, so that the distance over the
//! sum of both is a time without contact. In `f64`, with a distance at which it counts as
//! contact: it may report contacts that are none, and its times are early.

use tunnelproof::Point;
use tunnelproof::nalgebra::Vector3;
use tunnelproof::rigid::EdgeTurningEdge;

/// The distance at which they touch, in metres, beyond the radius.
const NEAR: f64 = 1e-6;

/// The time of contact in `[0, 1]`, if there is one.
pub(crate) fn toi(query: &EdgeTurningEdge) -> Option<f64> {
    let spin = most_spin(query);
    let [c0, c1] = [query.motion().start(), query.motion().end()].map(|pose| pose.centre);
    let drift = c1 - c0;
    let [a, b] = [0, 1].map(|i| query.end()[i] - query.start()[i] - drift);
    let radius = query.radius().rounded();
    let mut t = 0.0;
    for _ in 0..1000 {
        let way = nearest(&query.positions(t));
        let distance = way.norm() - radius;
        if distance <= NEAR {
            return Some(t);
        }
        let n = way / way.norm();
        t += distance / (spin + f64::max(0.0, f64::max(a.dot(&n), b.dot(&n))));
        if t > 1.0 || t.is_nan() {
            return None;
        }
    }
    Some(t)
}

/// The largest speed that a turn gives a point of the edge: `2 W / D` times its distance from the
/// centre.
fn most_spin(query: &EdgeTurningEdge) -> f64 {
    let [q0, q1] = query.motion().quaternions();
    let product = |x: &[f64; 4], y: &[f64; 4]| -> f64 { (0..4).map(|i| x[i] * y[i]).sum() };
    let (d0, d1, along) = (product(&q0, &q0), product(&q1, &q1), product(&q0, &q1));
    let wedge = (d0 * d1 - along * along).max(0.0).sqrt();
    let least = d0.min(d1) * 0.5 * (1.0 + along / (d0 * d1).sqrt());
    let reach = query.local().iter().map(|p| p.coords.norm());
    2.0 * wedge / least * reach.fold(0.0, f64::max)
}

/// The shortest vector from AB to CD (Ericson, Real-Time Collision Detection, 5.1.9).
fn nearest(points: &[Point; 4]) -> Vector3<f64> {
    let [a, b, c, d] = points;
    let (k, l, r) = (b - a, d - c, a - c);
    let (kk, ll, kl) = (k.dot(&k), l.dot(&l), k.dot(&l));
    let (kr, lr) = (k.dot(&r), l.dot(&r));
    let determinant = kk * ll - kl * kl;
    let mut u = match determinant > 0.0 {
        true => ((kl * lr - kr * ll) / determinant).clamp(0.0, 1.0),
        false => 0.0,
    };
    let mut v = (kl * u + lr) / ll;
    if !(0.0..=1.0).contains(&v) {
        v = v.clamp(0.0, 1.0);
        u = ((kl * v - kr) / kk).clamp(0.0, 1.0);
    }
    (c + l * v) - (a + k * u)
}
