//! Additive continuous collision detection: the baseline to compare with.
//!
//! Li, Kaufman, Jiang, "Codimensional incremental potential contact", ACM TOG 2021, section 5,
//! algorithm 1. The edges advance by nine tenths of what their distance and speed allow, until less
//! than a tenth of the first distance is left, which counts as contact. It converges from below, so
//! it does not miss but for rounding; edges that come near without touching are false hits.
//!
//! ```
//! use tunnelproof::additive::Additive;
//! use tunnelproof::narrow::NarrowPhase;
//! use tunnelproof::{EdgeEdge, Point, decide};
//!
//! let p = Point::new;
//! let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, -1.0, 1.0), p(0.0, 1.0, 1.0)];
//! let mut end = start;
//! end[2].z = 0.03;
//! end[3].z = 0.03;
//! let query = EdgeEdge::new(start, end, 0.0)?;
//! // They come as near as 0.03 and do not touch.
//! assert!(Additive::default().edge_edge(&query)?.verdict.is_hit());
//! assert_eq!(decide(&query), None);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use nalgebra::Vector3;

use crate::closest::{closest, distance};
use crate::contact::{Contact, ContactPoint, EdgePoint, Flags, Verdict};
use crate::narrow::{NarrowPhase, Report, Unsupported};
use crate::query::{EdgeEdge, Point, VertexFace};

/// Additive continuous collision detection. Heuristic.
///
/// Takes edge-edge queries; the radius is the minimum separation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Additive {
    /// Which part of the way to contact is taken, in `(0, 1)`; the paper's experiments and the IPC
    /// Toolkit take 0.9.
    pub rescaling: f64,
    /// After this many advances the edges count as in contact where they are. It takes that many
    /// where the edges start next to each other, or where rounding leaves them no way to advance.
    pub max_steps: u32,
}

impl Default for Additive {
    fn default() -> Self {
        Additive {
            rescaling: 0.9,
            max_steps: 10_000,
        }
    }
}

impl NarrowPhase for Additive {
    fn name(&self) -> &str {
        "additive"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        let speed = |[a, b, c, d]: [f64; 4]| a.max(b) + c.max(d);
        let radius = query.radius().rounded();
        let verdict = match self.advance(query.start(), query.end(), radius, speed, distance) {
            None => Verdict::Miss,
            Some(toi) => Verdict::Hit(contact_at(query, toi)),
        };
        Ok(Report {
            verdict,
            case: None,
            flags: Flags::default(),
        })
    }
}

impl Additive {
    /// The time at which a vertex and a face are nearly in contact, as a fraction of the step; none if they are not. The same
    /// algorithm as for edges: to compare with, not to rely on. The radius is the minimum separation.
    pub fn vertex_face_toi(&self, query: &VertexFace) -> Option<f64> {
        let speed = |[a, b, c, d]: [f64; 4]| a + b.max(c).max(d);
        let radius = query.radius().rounded();
        self.advance(query.start(), query.end(), radius, speed, distance_to_face)
    }

    /// The time at which two sides are nearly in contact. `speed` bounds how fast they approach each other by the speeds of the
    /// points.
    fn advance(
        &self,
        start: &[Point; 4],
        end: &[Point; 4],
        radius: f64,
        speed: impl Fn([f64; 4]) -> f64,
        distance: impl Fn(&[Vector3<f64>; 4]) -> f64,
    ) -> Option<f64> {
        let mut x = start.map(|point| point.coords);
        let mut p = [0, 1, 2, 3].map(|i| end[i] - start[i]);
        let mean = (p[0] + p[1] + p[2] + p[3]) / 4.0;
        p.iter_mut().for_each(|p| *p -= mean);
        let speed = speed(p.map(|p| p.norm()));
        // What is left until contact, as a distance.
        let left = |x: &[Vector3<f64>; 4]| distance(x) - radius;
        let mut gap = left(&x);
        if gap <= 0.0 {
            return Some(0.0);
        }
        if speed == 0.0 {
            return None;
        }
        let enough = (1.0 - self.rescaling) * gap;
        let mut t = 0.0;
        for _ in 0..self.max_steps {
            let step = self.rescaling * gap / speed;
            for (x, p) in x.iter_mut().zip(&p) {
                *x += p * step;
            }
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
}

/// The distance of the point `A` from the triangle `BCD`, by the region in which its nearest point is (Ericson, "Real-Time
/// Collision Detection", 2005, 5.1.5).
fn distance_to_face([a, b, c, d]: &[Vector3<f64>; 4]) -> f64 {
    let (e, f) = (c - b, d - b);
    let [from_b, from_c, from_d] = [b, c, d].map(|corner| a - corner);
    let [[b1, b2], [c1, c2], [d1, d2]] =
        [from_b, from_c, from_d].map(|way| [e.dot(&way), f.dot(&way)]);
    let of_b = c1 * d2 - d1 * c2;
    let of_c = d1 * b2 - b1 * d2;
    let of_d = b1 * c2 - c1 * b2;
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

fn contact_at(query: &EdgeEdge, toi: f64) -> Contact {
    let at = |i: usize| query.start()[i].coords.lerp(&query.end()[i].coords, toi);
    let positions = [at(0), at(1), at(2), at(3)];
    let (u, v) = closest(&positions);
    let [p, q, r, s] = [0, 1, 2, 3].map(|i| query.end()[i] - query.start()[i]);
    let relative = r.lerp(&s, v) - p.lerp(&q, u);
    let first = ContactPoint {
        point: Point::from(positions[0].lerp(&positions[1], u)),
        weights: EdgePoint { u, v }.weights(),
        relative_velocity: relative.try_normalize(0.0),
    };
    Contact {
        toi,
        first,
        second: None,
        normal: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn falling(height: f64, end: f64) -> EdgeEdge {
        let p = Point::new;
        let still = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0)];
        let edge = |z: f64| [p(0.5, -1.0, z), p(0.5, 1.0, z)];
        let ([c, d], [e, f]) = (edge(height), edge(end));
        let [a, b] = still;
        EdgeEdge::new([a, b, c, d], [a, b, e, f], 0.0).unwrap()
    }

    fn toi(query: &EdgeEdge) -> Option<f64> {
        let report = Additive::default().edge_edge(query).unwrap();
        report.verdict.contact().map(|contact| contact.toi)
    }

    #[test]
    fn additive_stops_before_contact_by_less_than_a_tenth_of_the_way() {
        let toi = toi(&falling(1.0, -1.0)).unwrap();
        assert!((0.45..=0.5).contains(&toi), "{toi}");
    }

    #[test]
    fn additive_misses_edges_that_stay_apart_and_hits_those_that_touch_at_first() {
        assert_eq!(toi(&falling(1.0, 2.0)), None);
        assert_eq!(toi(&falling(0.0, 2.0)), Some(0.0));
        assert_eq!(toi(&falling(1.0, 1.0)), None);
    }

    #[test]
    fn distance_to_a_face_is_the_least_of_its_points() {
        let v = Vector3::new;
        let [b, c, d] = [v(0.0, 0.0, 0.0), v(2.0, 0.25, 0.0), v(0.5, 1.5, 0.5)];
        const PARTS: u32 = 100;
        // Over the face, and beyond each of its corners and edges.
        for k in 0..343 {
            let [x, y, z] = [k % 7, k / 7 % 7, k / 49].map(|k| f64::from(k) - 2.5);
            let a = v(x, y, z);
            let mut least = f64::INFINITY;
            for i in 0..=PARTS {
                for j in 0..=PARTS - i {
                    let [u, w] = [i, j].map(|k| f64::from(k) / f64::from(PARTS));
                    least = least.min((a - b - (c - b) * u - (d - b) * w).norm());
                }
            }
            let found = distance_to_face(&[a, b, c, d]);
            assert!(
                found <= least + 1e-12 && least - found < 0.02,
                "{a:?}: {found} {least}"
            );
        }
    }

    #[test]
    fn additive_stops_before_a_vertex_touches_a_face() {
        let p = Point::new;
        let face = [p(-1.0, -1.0, 0.0), p(2.0, -1.0, 0.0), p(-1.0, 2.0, 0.0)];
        let toi = |height: f64, end: f64| {
            let [b, c, d] = face;
            let [start, end] = [height, end].map(|z| [p(0.0, 0.0, z), b, c, d]);
            let query = VertexFace::new(start, end, 0.0).unwrap();
            Additive::default().vertex_face_toi(&query)
        };
        let down = toi(1.0, -1.0).unwrap();
        assert!((0.45..=0.5).contains(&down), "{down}");
        assert_eq!(toi(1.0, 2.0), None);
        assert_eq!(toi(0.0, 2.0), Some(0.0));
    }

    #[test]
    fn additive_calls_a_near_approach_a_hit() {
        // It comes down to 1/32 of the first distance and no farther.
        assert!(toi(&falling(1.0, 0.03125)).is_some());
    }
}
