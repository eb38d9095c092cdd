//! Motion confined to a plane or a line, in small integers: which decisions of Algorithms 8 to 18
//! are clear.
//!
//! Where every coordinate is an integer of at most [`LARGEST`] in some power of two, the case,
//! every coefficient and everything at `t = 0` and `t = 1` is computed without rounding, and a
//! number that is not 0 is above every threshold. What is left are the roots of quadratics, each
//! known to within [`SPREAD`], and what is asked of the edges there. The derivation is in
//! `docs/method.md`, "What excuses the thesis path".

use std::cmp::Ordering;

use nalgebra::Vector3;
use tunnelproof::contact::Case;
use tunnelproof::query::{EdgeEdge, Query};
use tunnelproof::thesis::Thresholds;

use super::{Meeting, U, Z, rounded};
use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::Integer;
use crate::poly::Poly;
use crate::scaled::Scaled;

/// The largest magnitude of a coordinate.
const LARGEST: u64 = 16;

/// The exponents of the powers of two that coordinates are counted in.
const UNITS: std::ops::RangeInclusive<i64> = -4..=4;

/// How far a root is from the one in `f64`, at most, and how far a time from 0 is known.
const SPREAD: f64 = 1.0 / (1u64 << 33) as f64;

/// Whether no decision of the thesis path on this query, of one of the three confined cases with
/// edges that have length, is near its border.
pub(super) fn is_clear(query: &EdgeEdge, case: Case, thresholds: &Thresholds) -> bool {
    let Some((points, unit)) = small_integers(query) else {
        return false;
    };
    let asked = Asked {
        points,
        least: 2.0 * thresholds.dist.max(thresholds.dist_1d) / unit,
        parameter: thresholds.dist_1d / 4.0,
        same_root: 2.0 * thresholds.same_root,
    };
    match case {
        // Algorithms 9 at the start and 10: quotients of small integers.
        Case::Collinear => true,
        Case::Parallel => asked.parallel_is_clear(),
        Case::Coplanar => match asked.overlap_at_start(unit, thresholds) {
            Some(is_overlap) => is_overlap || asked.planar_is_clear(),
            None => false,
        },
        Case::Degenerate | Case::SharedStart | Case::General => false,
    }
}

/// The points in units, and the unit in metres, if coordinates are small integers in it.
fn small_integers(query: &EdgeEdge) -> Option<([Line; 4], f64)> {
    let scaled = Scaled::<Z>::new(&Query::EdgeEdge(*query));
    let small = |z: &Z| z.to_i64().filter(|n| n.unsigned_abs() <= LARGEST);
    let position = |[x, y, z]: &[Z; 3]| Some([small(x)?, small(y)?, small(z)?]);
    let mut points = [Line::default(); 4];
    for (i, point) in points.iter_mut().enumerate() {
        let (p, end) = (position(&scaled.start[i])?, position(&scaled.end[i])?);
        *point = Line {
            p,
            v: [0, 1, 2].map(|h| end[h] - p[h]),
        };
    }
    UNITS
        .contains(&scaled.exponent)
        .then(|| (points, 2f64.powi(scaled.exponent as i32)))
}

/// A point or vector in units that changes linearly: its value at the start and its velocity.
#[derive(Clone, Copy, Default)]
struct Line {
    p: [i64; 3],
    v: [i64; 3],
}

impl Line {
    fn minus(&self, other: &Line) -> Line {
        Line {
            p: [0, 1, 2].map(|h| self.p[h] - other.p[h]),
            v: [0, 1, 2].map(|h| self.v[h] - other.v[h]),
        }
    }

    /// The cross product: three quadratics, coefficients ascending.
    fn cross(&self, other: &Line) -> [[i64; 3]; 3] {
        let minor = |x: &[i64; 3], y: &[i64; 3], h: usize| {
            let (i, j) = ((h + 1) % 3, (h + 2) % 3);
            x[i] * y[j] - x[j] * y[i]
        };
        [0, 1, 2].map(|h| {
            let mixed = minor(&self.p, &other.v, h) + minor(&self.v, &other.p, h);
            [
                minor(&self.p, &other.p, h),
                mixed,
                minor(&self.v, &other.v, h),
            ]
        })
    }

    fn at(&self, t: f64) -> Vector3<f64> {
        Vector3::from_fn(|h, _| self.p[h] as f64 + self.v[h] as f64 * t)
    }
}

/// A time at which the path asks whether the edges touch.
struct Moment<'a> {
    exact: &'a Algebraic<Z>,
    t: f64,
    /// How far a difference of two coordinates may be off in `f64`, in units: nothing at the ends
    /// of the step, where all of it is integers.
    error: f64,
}

impl<'a> Moment<'a> {
    fn new(exact: &'a Algebraic<Z>) -> Self {
        let t = rounded(exact);
        let (largest, is_end) = (LARGEST as f64, t == 0.0 || t == 1.0);
        let error = if is_end {
            0.0
        } else {
            // A velocity of a difference is at most four times the largest coordinate.
            4.0 * largest * SPREAD + 32.0 * U * largest
        };
        Moment { exact, t, error }
    }
}

/// What the end of an edge does to the other edge: the first time at which it is clear that it is
/// on it, and the first one before that at which it is not clear whether it is.
#[derive(Default)]
struct Reach {
    contact: Option<f64>,
    doubt: Option<f64>,
}

impl Reach {
    fn doubtful_at(t: f64) -> Self {
        Reach {
            contact: None,
            doubt: Some(t),
        }
    }

    /// Takes the first of these times at which it is so.
    fn first(times: &[Algebraic<Z>], is_so: impl Fn(&Moment) -> Option<bool>) -> Self {
        let mut reach = Reach::default();
        for time in times {
            let moment = Moment::new(time);
            match is_so(&moment) {
                Some(true) => {
                    reach.contact = Some(moment.t);
                    break;
                }
                Some(false) => {}
                None => reach.doubt = reach.doubt.or(Some(moment.t)),
            }
        }
        reach
    }
}

/// The points, and what lies beyond the thresholds.
struct Asked {
    /// A, B, C and D in units.
    points: [Line; 4],
    /// Twice the distance thresholds, in units.
    least: f64,
    /// A quarter of how far line parameters of different coordinates may be apart.
    parameter: f64,
    /// Twice how far apart roots are taken for one.
    same_root: f64,
}

impl Asked {
    /// Algorithms 12 and 13.
    fn parallel_is_clear(&self) -> bool {
        let [a, b, c, _] = &self.points;
        let Some(times) = self.common_roots(&b.minus(a).cross(&c.minus(a))) else {
            return false;
        };
        Reach::first(&times, |moment| self.overlaps(moment))
            .doubt
            .is_none()
    }

    /// Algorithm 18 but for its first step: no doubt is earlier than the first contact.
    fn planar_is_clear(&self) -> bool {
        let [a, b, c, d] = &self.points;
        let ends = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
        let reaches = ends.map(|(point, from, to)| self.reach(point, from, to));
        let first = |times: &mut dyn Iterator<Item = f64>| times.fold(f64::INFINITY, f64::min);
        let contact = first(&mut reaches.iter().filter_map(|reach| reach.contact));
        first(&mut reaches.iter().filter_map(|reach| reach.doubt)) >= contact
            || reaches.iter().all(|reach| reach.doubt.is_none())
    }

    /// Algorithm 17.
    fn reach(&self, point: &Line, from: &Line, to: &Line) -> Reach {
        let (direction, offset) = (to.minus(from), point.minus(from));
        let turn = direction.cross(&offset);
        if turn == [[0; 3]; 3] {
            let meetings = [from, to].map(|end| meeting_time(point, end));
            return Reach {
                contact: meetings.into_iter().flatten().min_by(f64::total_cmp),
                doubt: None,
            };
        }
        match self.common_roots(&turn) {
            None => Reach::doubtful_at(0.0),
            Some(times) => Reach::first(&times, |moment| {
                self.is_on_segment(moment, &direction, &offset)
            }),
        }
    }

    /// Algorithm 12: the times at which three quadratics are 0; `None` if roots of two of them are
    /// different and yet so near that they may be taken for one.
    fn common_roots(&self, quadratics: &[[i64; 3]; 3]) -> Option<Vec<Algebraic<Z>>> {
        let mut common: Option<Vec<Algebraic<Z>>> = None;
        for quadratic in quadratics.iter().filter(|q| **q != [0; 3]) {
            let roots = isolate_roots(&Poly::new(quadratic.map(<Z as Integer>::from_i64).into()));
            let Some(before) = common else {
                common = Some(roots);
                continue;
            };
            let mut kept = Vec::new();
            for time in before {
                let orders = roots
                    .iter()
                    .map(|root| (root.compare(&time), rounded(root)));
                let (same, others): (Vec<_>, Vec<_>) =
                    orders.partition(|(order, _)| *order == Ordering::Equal);
                let t = rounded(&time);
                if others
                    .iter()
                    .any(|(_, other)| (other - t).abs() <= self.same_root + 2.0 * SPREAD)
                {
                    return None;
                }
                if !same.is_empty() {
                    kept.push(time);
                }
            }
            common = Some(kept);
        }
        Some(common.unwrap_or_default())
    }

    /// A vector at a time, its components that are 0 exactly so; `None` if one that is not may
    /// count as 0.
    fn clear_vector(&self, moment: &Moment, vector: &Line) -> Option<Vector3<f64>> {
        let mut value = vector.at(moment.t);
        for h in 0..3 {
            let component = Poly::new(
                [vector.p[h], vector.v[h]]
                    .map(<Z as Integer>::from_i64)
                    .into(),
            );
            if moment.exact.sign_of(&component).is_eq() {
                value[h] = 0.0;
            } else if value[h].abs() <= self.least + 2.0 * moment.error {
                return None;
            }
        }
        Some(value)
    }

    /// Algorithm 15, at a time at which the point is on the line, or the segment is a point.
    fn is_on_segment(&self, moment: &Moment, direction: &Line, offset: &Line) -> Option<bool> {
        let s = self.clear_vector(moment, direction)?;
        let b = match s == Vector3::zeros() {
            true => return Some(self.clear_vector(moment, offset)? == Vector3::zeros()),
            false => offset.at(moment.t),
        };
        // Where s is 0, so is b: they are parallel.
        let axes = || (0..3).filter(|&h| s[h] != 0.0);
        let parameter = |h: usize| b[h] / s[h];
        let error = |h: usize| 2.0 * moment.error * (1.0 + parameter(h).abs()) / s[h].abs();
        if axes().any(|h| error(h) > self.parameter) {
            return None;
        }
        let h = axes().next()?;
        let (u, off) = (parameter(h), error(h));
        match (u >= off && u <= 1.0 - off, u < -off || u > 1.0 + off) {
            (false, false) => None,
            (is_inside, _) => Some(is_inside),
        }
    }

    /// Algorithm 9, at a time at which the edges are on one line, or AB is a point.
    fn overlaps(&self, moment: &Moment) -> Option<bool> {
        let [a, b, c, d] = &self.points;
        let (k, l) = (b.minus(a), d.minus(c));
        let (along, from) = match self.clear_vector(moment, &k)? {
            k if k != Vector3::zeros() => (k, a),
            _ => match self.clear_vector(moment, &l)? {
                l if l != Vector3::zeros() => (l, c),
                _ => {
                    let apart = self.clear_vector(moment, &c.minus(a))?;
                    return Some(apart == Vector3::zeros());
                }
            },
        };
        let offsets = [a, b, c, d].map(|point| point.minus(from).at(moment.t));
        let size = offsets
            .iter()
            .map(|offset| offset.amax())
            .fold(along.amax(), f64::max);
        let off = 16.0 * moment.error * (size + moment.error);
        let [a, b, c, d] = offsets.map(|offset| offset.dot(&along));
        let overlap = a.max(b).min(c.max(d)) - a.min(b).max(c.min(d));
        match (overlap >= off, overlap < -off) {
            (false, false) => None,
            (is_overlap, _) => Some(is_overlap),
        }
    }

    /// Algorithm 16 at the start.
    fn overlap_at_start(&self, unit: f64, thresholds: &Thresholds) -> Option<bool> {
        let [a, b, c, d] = &self.points;
        let (k, l, m) = (b.minus(a), d.minus(c), c.minus(a));
        let start = Algebraic::zero();
        let moment = Moment::new(&start);
        let is_point = |edge: &Line| edge.p == [0; 3];
        if is_point(&k) {
            return self.is_on_segment_at_start(&moment, &l, &a.minus(c));
        }
        if is_point(&l) {
            return self.is_on_segment_at_start(&moment, &k, &m);
        }
        let [k_0, l_0, m_0] = [&k, &l, &m].map(|vector| vector.at(0.0) * unit);
        let normal = k_0.cross(&l_0);
        if normal == Vector3::zeros() {
            let is_one_line = m_0.cross(&k_0) == Vector3::zeros();
            return if is_one_line {
                self.overlaps(&moment)
            } else {
                Some(false)
            };
        }
        let meeting = Meeting {
            lengths: [k_0.norm(), l_0.norm()],
            turn: normal.norm(),
            between: m_0.norm(),
            error: 0.0,
            parameters: Some(
                [l_0, k_0].map(|edge| m_0.cross(&edge).dot(&normal) / normal.norm_squared()),
            ),
        };
        meeting.is_inside(thresholds)
    }

    /// Algorithm 15, wherever the point is.
    fn is_on_segment_at_start(
        &self,
        moment: &Moment,
        direction: &Line,
        offset: &Line,
    ) -> Option<bool> {
        let is_on_line = direction
            .cross(offset)
            .iter()
            .all(|[at_start, ..]| *at_start == 0);
        if is_on_line {
            self.is_on_segment(moment, direction, offset)
        } else {
            Some(false)
        }
    }
}

/// Algorithm 10: when in `[0, 1]` two points are the same, the start if they always are.
fn meeting_time(point: &Line, other: &Line) -> Option<f64> {
    let Line { p, v } = point.minus(other);
    let moving: Vec<usize> = (0..3).filter(|&h| v[h] != 0).collect();
    if (0..3).any(|h| v[h] == 0 && p[h] != 0) {
        return None;
    }
    let Some(&first) = moving.first() else {
        return Some(0.0);
    };
    let is_same = |&h: &usize| p[h] * v[first] == p[first] * v[h];
    let t = -p[first] as f64 / v[first] as f64;
    (moving.iter().all(is_same) && (0.0..=1.0).contains(&t)).then_some(t)
}
