//! Passages of two edges that are moved aside by an infinitesimal, without roots.
//!
//! Let `F(u, v, t) = (A + u K) - (C + v L)` on the unit cube. A passage is a zero of `F`, and `f`
//! rises or falls there as `det DF` is positive or negative. If `F` is not 0 on the border of the
//! cube, the sum of these signs is the degree of `F`, which its values on the border decide: the
//! points of the border at which `F` is a positive multiple of a fixed vector, each with the sign
//! of its orientation (Milnor, Topology from the Differentiable Viewpoint, 1965, section 5). On two
//! faces of the cube `F` is linear in `u` and `v`; on the other four such points are roots of a
//! quadratic polynomial in `t`, which a Cauchy index counts (Basu, Pollack and Roy, Algorithms in
//! Real Algebraic Geometry, 2006, section 2.2.2).
//!
//! Coordinates are `c + e d` with integers `c` and `d` and an infinitesimal `e > 0`, so every
//! number is a polynomial in `e` and has the sign of its lowest term. That is its sign for every
//! positive number `e` that is small enough. Nothing is rounded.

use std::cmp::Ordering;

use tunnelproof::query::{EdgeEdge, Query};

use crate::field::{self, Integer};
use crate::poly::Poly;
use crate::scaled::Scaled;

/// Vectors along which the border is looked at. The first for which no point is on a border of a
/// face, or touches it, is used.
const RAYS: [[i64; 3]; 4] = [
    [7919, -6101, 9973],
    [-3571, 9161, 8117],
    [-8807, -2749, 6947],
    [5309, 7703, 9689],
];

/// How often two edges pass through each other if A, B, C and D are moved by these vectors at the
/// start and at the end of the step, each times one positive infinitesimal: +1 where `f = (K x L) .
/// M` rises, -1 where it falls. `None` if the edges still touch at an end of an edge or of the
/// step, which vectors in general position exclude.
pub fn passages_beside(query: &EdgeEdge, offsets: &[[[i64; 3]; 4]; 2]) -> Option<i64> {
    let points = Scaled::<field::Default>::new(&Query::EdgeEdge(*query));
    RAYS.iter()
        .find_map(|ray| Cube::new(&points, offsets, ray).degree())
}

/// A number: a polynomial in the infinitesimal.
type Number<Z> = Poly<Z>;

fn sign<Z: Integer>(number: &Number<Z>) -> Ordering {
    let mut signs = number.coefficients().iter().map(Z::sign);
    signs.find(|sign| sign.is_ne()).unwrap_or(Ordering::Equal)
}

/// The sign as an integer; `None` for 0.
fn unit<Z: Integer>(number: &Number<Z>) -> Option<i64> {
    match sign(number) {
        Ordering::Less => Some(-1),
        Ordering::Equal => None,
        Ordering::Greater => Some(1),
    }
}

/// A polynomial in time: coefficients ascending, the last one not 0.
#[derive(Clone)]
struct InTime<Z>(Vec<Number<Z>>);

impl<Z: Integer> InTime<Z> {
    fn new(mut coefficients: Vec<Number<Z>>) -> Self {
        while coefficients.last().is_some_and(Poly::is_zero) {
            coefficients.pop();
        }
        InTime(coefficients)
    }

    /// `a b - c d`.
    fn determinant([a, b]: [&Self; 2], [c, d]: [&Self; 2]) -> Self {
        let size = |x: &Self, y: &Self| (x.0.len() + y.0.len()).saturating_sub(1);
        let mut terms = vec![Poly::zero(); size(a, b).max(size(c, d))];
        for (i, x) in a.0.iter().enumerate() {
            for (j, y) in b.0.iter().enumerate() {
                terms[i + j].add_product(x, y);
            }
        }
        for (i, x) in c.0.iter().enumerate() {
            for (j, y) in d.0.iter().enumerate() {
                terms[i + j].sub_product(x, y);
            }
        }
        InTime::new(terms)
    }

    fn mul(&self, other: &Self) -> Self {
        let zero = InTime(Vec::new());
        InTime::determinant([self, other], [&zero, &zero])
    }

    /// The remainder by a polynomial other than 0, times some positive number.
    fn remainder(&self, other: &Self) -> Self {
        let mut rest = self.0.clone();
        let Some((leading, lower)) = other.0.split_last() else {
            return InTime(Vec::new());
        };
        let is_negative = sign(leading).is_lt();
        let turned = |number: Number<Z>| if is_negative { number.neg() } else { number };
        let size = turned(leading.clone());
        while rest.len() > lower.len() {
            let Some(top) = rest.pop().map(turned) else {
                break;
            };
            let shift = rest.len() - lower.len();
            for (k, term) in rest.iter_mut().enumerate() {
                *term = term.mul(&size);
                if k >= shift {
                    term.sub_product(&top, &lower[k - shift]);
                }
            }
        }
        InTime::new(rest)
    }

    /// The signs at the times 0 and 1.
    fn signs(&self) -> [Ordering; 2] {
        let mut sum = Poly::zero();
        for term in &self.0 {
            sum.add_assign(term);
        }
        [self.0.first().map_or(Ordering::Equal, sign), sign(&sum)]
    }
}

/// The sum of the signs of `h' g` over the roots of `h` strictly between 0 and 1: the Cauchy index
/// of `g / h`, by the sequence of signed remainders. `None` if `h` is 0 at 0 or 1, or has a root in
/// common with `g`.
fn index<Z: Integer>(h: &InTime<Z>, g: &InTime<Z>) -> Option<i64> {
    let mut changes = [0, 0];
    let mut last = h.signs();
    if last.contains(&Ordering::Equal) {
        return None;
    }
    let (mut before, mut this) = (h.clone(), g.remainder(h));
    if h.0.len() == 1 {
        return Some(0);
    }
    while !this.0.is_empty() {
        for (k, sign) in this.signs().into_iter().enumerate() {
            if sign.is_ne() {
                changes[k] += i64::from(sign != last[k]);
                last[k] = sign;
            }
        }
        let mut next = before.remainder(&this);
        next.0.iter_mut().for_each(|term| *term = term.neg());
        before = std::mem::replace(&mut this, next);
    }
    (before.0.len() == 1).then_some(changes[0] - changes[1])
}

type Triple<T> = [T; 3];

/// The cube, and the third axis in the direction of the ray.
struct Cube<Z> {
    /// From C and D to A, and from C and D to B, at the start and at the end.
    ways: [[[Triple<Number<Z>>; 2]; 2]; 2],
}

impl<Z: Integer> Cube<Z> {
    fn new(points: &Scaled<Z>, offsets: &[[[i64; 3]; 4]; 2], ray: &[i64; 3]) -> Self {
        let [rx, ry, rz] = ray.map(Z::from_i64);
        // It keeps orientations: the determinant is rz^2. No axis is along a former one.
        let turned = |[x, y, z]: [Z; 3]| {
            let across = |c: &Z, r: &Z| c.mul(&rz).sub(&z.mul(r));
            let (mut x, mut y) = (across(&x, &rx), across(&y, &ry));
            x.add_product(&y, &Z::from_i64(1021));
            y.add_product(&x, &Z::from_i64(4093));
            [x, y, z]
        };
        let way = |time: usize, from: usize, to: usize| {
            let (at, offsets) = ([&points.start, &points.end][time], &offsets[time]);
            let place = turned([0, 1, 2].map(|h| at[to][h].sub(&at[from][h])));
            let offset = turned([0, 1, 2].map(|h| Z::from_i64(offsets[to][h] - offsets[from][h])));
            [0, 1, 2].map(|h| Poly::new(vec![place[h].clone(), offset[h].clone()]))
        };
        let ways =
            [0, 1].map(|time| [0, 1].map(|first| [2, 3].map(|second| way(time, second, first))));
        Cube { ways }
    }

    /// The degree of `F`; `None` if the ray meets a border of a face.
    fn degree(&self) -> Option<i64> {
        let way = |first: usize, second: usize| {
            [0, 1, 2].map(|h| {
                let [start, end] = [0, 1].map(|time| &self.ways[time][first][second][h]);
                InTime::new(vec![start.clone(), end.sub(start)])
            })
        };
        let [[ac, ad], [bc, bd]] = [0, 1].map(|first| [0, 1].map(|second| way(first, second)));
        let sides = side(&ac, &ad)? - side(&bc, &bd)? + side(&ad, &bd)? - side(&ac, &bc)?;
        Some(sides + flat(&self.ways[1])? - flat(&self.ways[0])?)
    }
}

/// The points of the ray on the edge from `p` to `q`, which moves: each +1 where `h = p x q` rises.
///
/// At a root of `h` the edge meets the line of the ray if `p` and `q` are on different sides of it,
/// `px qx < 0`, and is on the ray if `w qx > 0` with `w = pz qx - qz px`.
fn side<Z: Integer>(
    [px, py, pz]: &Triple<InTime<Z>>,
    [qx, qy, qz]: &Triple<InTime<Z>>,
) -> Option<i64> {
    let h = InTime::determinant([px, qy], [py, qx]);
    if h.0.is_empty() {
        return Some(0);
    }
    let w = InTime::determinant([pz, qx], [qz, px]);
    let one = InTime(vec![Poly::constant(Z::one())]);
    let all = index(&h, &one)? - index(&h, &px.mul(qx))?;
    Some((all + index(&h, &w.mul(qx))? - index(&h, &w.mul(px))?) / 4)
}

/// The point of the ray on the parallelogram `F(u, v)` of a time, with its orientation in `u` and
/// `v`.
fn flat<Z: Integer>([[ac, ad], [bc, _]]: &[[Triple<Number<Z>>; 2]; 2]) -> Option<i64> {
    let from = |a: &Triple<Number<Z>>, b: &Triple<Number<Z>>| [0, 1, 2].map(|h| b[h].sub(&a[h]));
    let (k, l, m) = (from(ac, bc), from(ad, ac), [0, 1, 2].map(|h| ac[h].neg()));
    let cross = |a: &Triple<Number<Z>>, b: &Triple<Number<Z>>, h: usize| {
        let (i, j) = ((h + 1) % 3, (h + 2) % 3);
        let mut product = a[i].mul(&b[j]);
        product.sub_product(&a[j], &b[i]);
        product
    };
    let n = cross(&k, &l, 2);
    if n.is_zero() {
        return Some(0);
    }
    let mut f = Poly::zero();
    for (h, m) in m.iter().enumerate() {
        f.add_product(m, &cross(&k, &l, h));
    }
    let (u, v) = (cross(&m, &l, 2), cross(&m, &k, 2));
    let way = unit(&n)?;
    let inside = [&u, &n.sub(&u), &v, &n.sub(&v)].map(unit);
    let mut hit = unit(&f)? != way;
    for sign in inside {
        hit &= sign? == way;
    }
    Some(if hit { -way } else { 0 })
}

#[cfg(test)]
mod tests {
    use rand::RngExt;
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;
    use tunnelproof::query::Point;

    use super::*;
    use crate::oracle::passages_inside;

    type Points = [[i64; 3]; 4];

    fn points(rng: &mut ChaCha8Rng, most: i64) -> Points {
        [[0; 3]; 4].map(|point| point.map(|_| rng.random_range(-most..=most)))
    }

    fn query(at: &[Points; 2], offsets: &[Points; 2], unit: f64) -> EdgeEdge {
        let [start, end] = [0, 1].map(|time| {
            [0, 1, 2, 3].map(|k| {
                let at = |h: usize| at[time][k][h] as f64 + unit * offsets[time][k][h] as f64;
                Point::new(at(0), at(1), at(2))
            })
        });
        EdgeEdge::new(start, end, 0.0).unwrap()
    }

    /// Coordinates of a few small integers: points that coincide, edges on one line and motion in a
    /// plane are common. A unit of 2^-40 m is below the gaps there, and exact.
    #[test]
    fn passages_beside_are_those_of_edges_moved_by_a_hair() {
        let rng = &mut ChaCha8Rng::seed_from_u64(30);
        let (mut touching, mut sums) = (0, [0; 3]);
        for round in 0..3000 {
            let most = [1, 2, 8][round % 3];
            let mut at = [(); 2].map(|()| points(rng, most));
            match round % 5 {
                // In a plane.
                0 => at
                    .as_flattened_mut()
                    .iter_mut()
                    .for_each(|point| point[2] = 0),
                // CD is moved along.
                1 => {
                    at[1] = std::array::from_fn(|k| {
                        if k < 2 {
                            at[0][k]
                        } else {
                            at[0][k].map(|c| c + most)
                        }
                    })
                }
                // AB has no length.
                2 => at.iter_mut().for_each(|four| four[1] = four[0]),
                _ => {}
            }
            let mut offsets = [points(rng, 1 << 10); 2];
            if round % 2 == 0 {
                offsets[1] = points(rng, 1 << 10);
            }
            let still = query(&at, &offsets, 0.0);
            let moved = query(&at, &offsets, (-40f64).exp2());
            let beside = passages_beside(&still, &offsets);
            assert_eq!(
                beside,
                passages_inside(&moved).or(Some(0)),
                "{still:?} {offsets:?}"
            );
            touching += usize::from(passages_inside(&still).is_none());
            sums[(beside.unwrap().signum() + 1) as usize] += 1;
        }
        println!("{touching} touch where they end; passages {sums:?}");
        assert!(touching > 1000 && sums.iter().all(|&count| count > 100));
    }

    /// CD along y falls through the height of AB along x, by which `f` falls.
    #[test]
    fn passages_inside_are_counted_only_inside_both_edges_and_the_step() {
        let passages = |x: i64, y: i64, from: i64, to: i64| {
            let at = |z| [[-2, 0, 0], [2, 0, 0], [x, y - 2, z], [x, y + 2, z]];
            passages_inside(&query(&[at(from), at(to)], &[[[0; 3]; 4]; 2], 0.0))
        };
        assert_eq!(passages(1, 1, 1, -1), Some(-1));
        assert_eq!(passages(1, 1, -1, 1), Some(1));
        assert_eq!(passages(3, 1, 1, -1), Some(0), "beyond an edge");
        assert_eq!(passages(1, 1, 2, 1), Some(0), "no root");
        for [x, y] in [[-2, 0], [2, 1], [1, 2], [0, -2]] {
            assert_eq!(passages(x, y, 1, -1), None, "in an end: {x}, {y}");
        }
        assert_eq!(passages(1, 1, 0, 1), None, "at the start");
        assert_eq!(passages(1, 1, 1, 0), None, "at the end");
        assert_eq!(passages(1, 1, 0, 0), None, "in a plane");
    }
}
