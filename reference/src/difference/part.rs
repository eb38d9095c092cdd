//! The distance of the origin from the polygon, part by part, and the first time at which it is
//! small.

use tunnelproof::query::{QueryKind, Radius};

use crate::algebraic::{Algebraic, decompose, isolate_roots};
use crate::answer::{Feature, Parameters};
use crate::field::Integer;
use crate::poly::Poly;

use super::polygon::Polygon;

/// A corner, an edge or the inside of the polygon, and the point of what it spans that is nearest
/// to the origin.
struct Part<Z> {
    /// The squared distance of that point is `square / size`, times [`Polygon::scale`].
    square: Poly<Z>,
    /// At least 0.
    size: Poly<Z>,
    /// Divided by `size`, how much the point is inside each bound of the part.
    inside: Vec<Poly<Z>>,
    /// The parameters `u` and `v` of the point, times `size`.
    place: [Poly<Z>; 2],
    /// Of a face, the feature that the part is.
    feature: Option<Feature>,
}

/// The distance of the origin from the polygon, and the radius.
pub(super) struct Distance<Z> {
    kind: QueryKind,
    parts: Vec<Part<Z>>,
    /// `square - R^2 size` of each part, times a power of two.
    excesses: Vec<Poly<Z>>,
    /// The squared lengths of the sides and the area, which are 0 where edges are parallel.
    shape: [Poly<Z>; 3],
}

impl<Z: Integer> Part<Z> {
    fn holds(&self, time: &Algebraic<Z>) -> bool {
        let is_inside = |bound: &Poly<Z>| time.sign_of(bound).is_ge();
        time.sign_of(&self.size).is_gt() && self.inside.iter().all(is_inside)
    }

    /// `x / size - y / other.size`, times both.
    fn compare(&self, x: &Poly<Z>, other: &Self, y: &Poly<Z>) -> Poly<Z> {
        x.mul(&other.size).sub(&y.mul(&self.size))
    }

    fn parameters(&self, time: &Algebraic<Z>) -> Parameters {
        let [u, v] = &self.place;
        Parameters {
            u: time.enclose_quotient(u, &self.size),
            v: time.enclose_quotient(v, &self.size),
        }
    }
}

/// The parameters of the corners.
fn corner(kind: QueryKind, index: usize) -> [i64; 2] {
    match kind {
        QueryKind::EdgeEdge => [[0, 0], [0, 1], [1, 0], [1, 1]][index],
        QueryKind::VertexFace => [[0, 0], [1, 0], [0, 1]][index],
    }
}

/// The feature of the face with these corners, from 0 for B; `None` for edges.
fn feature(kind: QueryKind, corners: &[usize]) -> Option<Feature> {
    let spans = |corner| corners.contains(&corner);
    let points = [false, spans(0), spans(1), spans(2)];
    (kind == QueryKind::VertexFace).then(|| Feature::spanned_by(points))
}

/// The parts, corners first.
fn parts<Z: Integer>(polygon: &Polygon<Z>) -> Vec<Part<Z>> {
    let corners = (0..polygon.number_of_corners()).map(|index| Part {
        square: polygon.dot(index, index).clone(),
        size: Poly::constant(Z::one()),
        inside: Vec::new(),
        place: corner(polygon.kind, index).map(|x| Poly::constant(Z::from_i64(x))),
        feature: feature(polygon.kind, &[index]),
    });
    let edges = polygon
        .edges()
        .iter()
        .map(|&edge| along_edge(polygon, edge));
    corners.chain(edges).chain([inside(polygon)]).collect()
}

/// The point of the line through `y` and `z` with the part `s` of the way,
/// `s = -y.(z - y) / |z - y|^2`.
fn along_edge<Z: Integer>(polygon: &Polygon<Z>, edge: (usize, usize)) -> Part<Z> {
    let size = polygon.length(edge);
    let to = polygon.dot_edge(edge.0, edge).neg();
    let [from, until] = [edge.0, edge.1].map(|index| corner(polygon.kind, index));
    let place = [0, 1].map(|axis| {
        let start = size.scale(&Z::from_i64(from[axis]));
        start.add(&to.scale(&Z::from_i64(until[axis] - from[axis])))
    });
    Part {
        square: polygon.turn(edge),
        inside: vec![size.sub(&to), to],
        place,
        feature: feature(polygon.kind, &[edge.0, edge.1]),
        size,
    }
}

/// The point `x_0 + alpha p + beta q` of the plane, by Cramer's rule on the normal equations. Its
/// square is that of `x_0` and what `x_0` has along `p` and `q`.
fn inside<Z: Integer>(polygon: &Polygon<Z>) -> Part<Z> {
    let [pp, pq, qq] = polygon.span();
    let (size, x) = (polygon.area(), polygon.dot(0, 0));
    let (xp, xq) = (polygon.dot_edge(0, (0, 1)), polygon.dot_edge(0, (0, 2)));
    let alpha = pq.mul(&xq).sub(&qq.mul(&xp));
    let beta = pq.mul(&xp).sub(&pp.mul(&xq));
    let square = x.mul(&size).add(&alpha.mul(&xp)).add(&beta.mul(&xq));
    let (bounds, place) = match polygon.kind {
        // q is A - B, p is D - C.
        QueryKind::EdgeEdge => (
            vec![size.sub(&alpha), size.sub(&beta)],
            [beta.clone(), alpha.clone()],
        ),
        QueryKind::VertexFace => (
            vec![size.sub(&alpha).sub(&beta)],
            [alpha.clone(), beta.clone()],
        ),
    };
    Part {
        square,
        inside: bounds.into_iter().chain([alpha, beta]).collect(),
        place,
        feature: feature(polygon.kind, &[0, 1, 2]),
        size,
    }
}

/// `R^2` as a numerator and the binary logarithm of the denominator, in the units of the polygon.
fn squared<Z: Integer>(radius: Radius, unit: i64) -> (Z, u64) {
    let [first, second] = radius.parts().map(decompose);
    let low = first.1.min(second.1).min(unit);
    let term = |(mantissa, own): (i64, i64)| Z::from_i64(mantissa).shl((own - low).unsigned_abs());
    let sum = term(first).add(&term(second));
    (sum.mul(&sum), 2 * (unit - low).unsigned_abs())
}

impl<Z: Integer> Distance<Z> {
    pub(super) fn new(polygon: &Polygon<Z>, radius: Radius, unit: i64) -> Self {
        let parts = parts(polygon);
        let (square, shift) = squared::<Z>(radius, unit);
        // The square of every part has one factor more of what products are multiplied by.
        let square = polygon.scale.scale(&square);
        let excess = |part: &Part<Z>| {
            let square = part.size.mul(&square);
            part.square.scale(&Z::one().shl(shift)).sub(&square)
        };
        let [p2, q2] = polygon.lengths();
        Distance {
            kind: polygon.kind,
            excesses: parts.iter().map(excess).collect(),
            shape: [p2, q2, polygon.area()],
            parts,
        }
    }

    /// The first time at which the distance is at most the radius: the first at which any sign
    /// changes and that is so.
    pub(super) fn first_contact(&self) -> Option<Algebraic<Z>> {
        let of_parts = self.parts.iter().flat_map(|part| part.inside.iter());
        let sizes = self.parts.iter().map(|part| &part.size);
        let signs = of_parts.chain(sizes).chain(&self.excesses);
        let mut times: Vec<_> = signs.flat_map(isolate_roots).collect();
        times.push(Algebraic::zero());
        times.sort_by(Algebraic::compare);
        times.into_iter().find(|time| self.is_contact(time))
    }

    /// Whether the distance is at most the radius.
    pub(super) fn is_contact(&self, time: &Algebraic<Z>) -> bool {
        let mut parts = self.parts.iter().zip(&self.excesses);
        parts.any(|(part, excess)| time.sign_of(excess).is_le() && part.holds(time))
    }

    /// Whether the point of the plane that is nearest to the origin is strictly inside the polygon.
    pub(super) fn is_strictly_inside(&self, time: &Algebraic<Z>) -> bool {
        let is_inside = |part: &Part<Z>| {
            let mut bounds = part.inside.iter().chain([&part.size]);
            bounds.all(|bound| time.sign_of(bound).is_gt())
        };
        self.parts.last().is_some_and(is_inside)
    }

    /// The nearest points: the features, the first place and the last one if there are several.
    pub(super) fn nearest(
        &self,
        time: &Algebraic<Z>,
    ) -> ([Feature; 2], Parameters, Option<Parameters>) {
        let nearest = self.nearest_parts(time);
        let first = nearest[0];
        let mut ends = [first, first];
        if self.is_parallel(time) {
            // Where edges are beside each other, u grows from one end of that part to the other.
            for part in nearest {
                let grows = |than: &Part<Z>| {
                    time.sign_of(&part.compare(&part.place[0], than, &than.place[0]))
                };
                if grows(ends[0]).is_lt() {
                    ends[0] = part;
                }
                if grows(ends[1]).is_gt() {
                    ends[1] = part;
                }
            }
        }
        let [first, last] = ends;
        let parameters = first.parameters(time);
        let features = match first.feature {
            Some(feature) => [Feature::vertex(0), feature],
            None => parameters.features_of_edges(),
        };
        let is_one = std::ptr::eq(first, last);
        let second = (!is_one).then(|| last.parameters(time));
        (features, parameters, second)
    }

    /// Every part that has a nearest point, corners first.
    fn nearest_parts(&self, time: &Algebraic<Z>) -> Vec<&Part<Z>> {
        let mut nearest: Vec<&Part<Z>> = Vec::new();
        for part in self.parts.iter().filter(|part| part.holds(time)) {
            let than = nearest
                .first()
                .map(|than| time.sign_of(&part.compare(&part.square, than, &than.square)));
            match than {
                Some(order) if order.is_gt() => {}
                Some(order) if order.is_eq() => nearest.push(part),
                _ => nearest = vec![part],
            }
        }
        nearest
    }

    /// Whether two edges with a length are parallel.
    fn is_parallel(&self, time: &Algebraic<Z>) -> bool {
        let [p2, q2, area] = &self.shape;
        let vanishes = |poly| time.sign_of(poly).is_eq();
        self.kind == QueryKind::EdgeEdge && vanishes(area) && !vanishes(p2) && !vanishes(q2)
    }
}
