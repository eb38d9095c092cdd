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
use crate::query::{EdgeEdge, Point};

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
        let verdict = match self.advance(query) {
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
    /// The time at which the edges are nearly in contact.
    fn advance(&self, query: &EdgeEdge) -> Option<f64> {
        let mut x = query.start().map(|point| point.coords);
        let mut p = [0, 1, 2, 3].map(|i| query.end()[i] - query.start()[i]);
        let mean = (p[0] + p[1] + p[2] + p[3]) / 4.0;
        p.iter_mut().for_each(|p| *p -= mean);
        let speed = p[0].norm().max(p[1].norm()) + p[2].norm().max(p[3].norm());
        // What is left until contact, as a distance.
        let left = |x: &[Vector3<f64>; 4]| distance(x) - query.radius().rounded();
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
    fn additive_calls_a_near_approach_a_hit() {
        // It comes down to 1/32 of the first distance and no farther.
        assert!(toi(&falling(1.0, 0.03125)).is_some());
    }
}
