//! The polygon and its scalar products.

use tunnelproof::query::QueryKind;

use crate::field::Integer;
use crate::poly::Poly;
use crate::scaled::Scaled;

/// A point in space.
pub(super) type Place<Z> = [Z; 3];

/// The points from which and to which the corners lead.
pub(super) fn ways(kind: QueryKind) -> &'static [(usize, usize)] {
    match kind {
        QueryKind::EdgeEdge => &[(0, 2), (0, 3), (1, 2), (1, 3)],
        QueryKind::VertexFace => &[(0, 1), (0, 2), (0, 3)],
    }
}

/// The difference of the two sides: a parallelogram or a triangle whose corners move.
pub(super) struct Polygon<Z> {
    pub(super) kind: QueryKind,
    /// Of edges `C - A`, `D - A`, `C - B` and `D - B`; of a vertex and a face `B - A`, `C - A` and
    /// `D - A`. Of a body that turns, times something positive.
    corners: Vec<[Poly<Z>; 3]>,
    /// The scalar products of the corners, times [`scale`](Self::scale).
    products: Vec<Vec<Poly<Z>>>,
    /// What the products are multiplied by: 1, or something positive for a body that turns.
    pub(super) scale: Poly<Z>,
}

impl<Z: Integer> Polygon<Z> {
    pub(super) fn new(kind: QueryKind, points: &Scaled<Z>) -> Self {
        let at = |points: &[Place<Z>; 4], (from, to): (usize, usize)| {
            [0, 1, 2].map(|axis| points[to][axis].sub(&points[from][axis]))
        };
        let corner = |&way| {
            let (start, end) = (at(&points.start, way), at(&points.end, way));
            [0, 1, 2].map(|axis| Poly::line(&start[axis], &end[axis]))
        };
        let corners: Vec<_> = ways(kind).iter().map(corner).collect();
        let product = |x: &[Poly<Z>; 3], y: &[Poly<Z>; 3]| {
            let mut sum = Poly::zero();
            for (x, y) in x.iter().zip(y) {
                sum.add_product(x, y);
            }
            sum
        };
        let row = |x| corners.iter().map(|y| product(x, y)).collect();
        let products = corners.iter().map(row).collect();
        Polygon::of(kind, corners, products, Poly::constant(Z::one()))
    }

    /// The polygon with these corners, which have these products times `scale`.
    pub(super) fn of(
        kind: QueryKind,
        corners: Vec<[Poly<Z>; 3]>,
        products: Vec<Vec<Poly<Z>>>,
        scale: Poly<Z>,
    ) -> Self {
        Polygon {
            kind,
            corners,
            products,
            scale,
        }
    }

    pub(super) fn number_of_corners(&self) -> usize {
        self.corners.len()
    }

    /// The edges as pairs of corners: a vertex of one side against an edge of the other. Of edges A
    /// and B against CD, C and D against AB; of a face BC, CD and BD.
    pub(super) fn edges(&self) -> &'static [(usize, usize)] {
        match self.kind {
            QueryKind::EdgeEdge => &[(0, 1), (2, 3), (0, 2), (1, 3)],
            QueryKind::VertexFace => &[(0, 1), (1, 2), (0, 2)],
        }
    }

    /// `x_i . x_j` for the corners `x`.
    pub(super) fn dot(&self, i: usize, j: usize) -> &Poly<Z> {
        &self.products[i][j]
    }

    /// `(x_j - x_i) . (x_l - x_k)`.
    fn dot_edges(&self, (i, j): (usize, usize), (k, l): (usize, usize)) -> Poly<Z> {
        let all = self.dot(j, l).add(self.dot(i, k));
        all.sub(self.dot(j, k)).sub(self.dot(i, l))
    }

    /// `x_i . (x_k - x_j)`.
    pub(super) fn dot_edge(&self, i: usize, (j, k): (usize, usize)) -> Poly<Z> {
        self.dot(i, k).sub(self.dot(i, j))
    }

    /// With `p = x_1 - x_0` and `q = x_2 - x_0`, which span the polygon: `p.p`, `p.q` and `q.q`.
    pub(super) fn span(&self) -> [Poly<Z>; 3] {
        let (p, q) = ((0, 1), (0, 2));
        [(p, p), (p, q), (q, q)].map(|(x, y)| self.dot_edges(x, y))
    }

    /// `p.p` and `q.q`.
    pub(super) fn lengths(&self) -> [Poly<Z>; 2] {
        let [pp, _, qq] = self.span();
        [pp, qq]
    }

    /// The Gram determinant of `p` and `q`: the squared area of the parallelogram.
    pub(super) fn area(&self) -> Poly<Z> {
        let [pp, pq, qq] = self.span();
        pp.mul(&qq).sub(&pq.mul(&pq))
    }

    /// The squared length of an edge.
    pub(super) fn length(&self, edge: (usize, usize)) -> Poly<Z> {
        self.dot_edges(edge, edge)
    }

    /// The Gram determinant of two corners: 0 where both are on one line with the origin.
    pub(super) fn turn(&self, (i, j): (usize, usize)) -> Poly<Z> {
        let product = self.dot(i, j);
        let mut turn = self.dot(i, i).mul(self.dot(j, j));
        turn.sub_product(product, product);
        turn
    }

    /// Whether the corners and the origin are on one line for the whole step.
    pub(super) fn is_on_line(&self) -> bool {
        self.edges().iter().all(|&edge| self.turn(edge).is_zero())
    }

    /// The vector product of two corners.
    pub(super) fn normal(&self, (y, z): (usize, usize)) -> [Poly<Z>; 3] {
        let (y, z) = (&self.corners[y], &self.corners[z]);
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
            let mut component = y[i].mul(&z[j]);
            component.sub_product(&y[j], &z[i]);
            component
        })
    }

    /// The triple product `f` of the two sides (see [`crate::answer`]).
    pub(super) fn volume(&self) -> Poly<Z> {
        let mut sum = Poly::zero();
        for (x, normal) in self.corners[0].iter().zip(&self.normal((1, 2))) {
            sum.add_product(x, normal);
        }
        // det(x_0, x_1, x_2): of edges (C - A) . (D - C) x (A - B) = f, of a face -f.
        match self.kind {
            QueryKind::EdgeEdge => sum,
            QueryKind::VertexFace => sum.neg(),
        }
    }
}
