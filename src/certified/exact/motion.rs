//! The motion of two edges as polynomials in `t`.
//!
//! `K = B - A`, `L = D - C`, `M = C - A`, all linear; `N = K x L`, quadratic; `f = M . N`, cubic. A
//! polynomial is the array of its coefficients, the constant one first.

use std::cmp::Ordering;

use super::lane::{Lane, Number};

/// A polynomial of degree 2.
pub(super) type Quadratic<L> = [<L as Lane>::Quadratic; 3];

/// A polynomial of degree 3.
pub(super) type Cubic<L> = [<L as Lane>::Cubic; 4];

/// A vector in space that moves linearly: its components at the start, and their changes.
pub(super) struct Vector<L: Lane> {
    start: [L::Linear; 3],
    change: [L::Linear; 3],
}

/// The motion of two edges.
pub(super) struct Motion<L: Lane> {
    pub(super) k: Vector<L>,
    pub(super) l: Vector<L>,
    pub(super) m: Vector<L>,
    pub(super) n: [Quadratic<L>; 3],
    /// The edges can touch only where it is 0.
    pub(super) f: Cubic<L>,
}

/// An end of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    A,
    B,
    C,
    D,
}

impl<L: Lane> Vector<L> {
    /// Whether it is 0 during the whole step.
    pub(super) fn is_zero(&self) -> bool {
        self.start.iter().chain(&self.change).all(Number::is_zero)
    }

    /// Component `h` of the cross product.
    #[inline]
    pub(super) fn cross_component(&self, other: &Self, h: usize) -> Quadratic<L> {
        let (i, j) = ((h + 1) % 3, (h + 2) % 3);
        let minor = |a: &[L::Linear; 3], b: &[L::Linear; 3]| {
            L::times(&a[i], &b[j]).sub(&L::times(&a[j], &b[i]))
        };
        [
            minor(&self.start, &other.start),
            minor(&self.start, &other.change).add(&minor(&self.change, &other.start)),
            minor(&self.change, &other.change),
        ]
    }

    /// The cross product.
    #[inline]
    pub(super) fn cross(&self, other: &Self) -> [Quadratic<L>; 3] {
        [0, 1, 2].map(|h| self.cross_component(other, h))
    }

    /// The dot product.
    pub(super) fn dot(&self, other: &Self) -> Quadratic<L> {
        let sum = |a: &[L::Linear; 3], b: &[L::Linear; 3]| {
            let [x, y, z] = [0, 1, 2].map(|h| L::times(&a[h], &b[h]));
            x.add(&y).add(&z)
        };
        [
            sum(&self.start, &other.start),
            sum(&self.start, &other.change).add(&sum(&self.change, &other.start)),
            sum(&self.change, &other.change),
        ]
    }
}

impl<L: Lane> Motion<L> {
    /// The motion whose component with index `i`, in the order of [`super::scaled::Scaled`], is
    /// `component(i)`.
    #[inline]
    pub(super) fn new(component: impl Fn(usize) -> L::Linear) -> Self {
        let [k, l, m] = [0, 6, 12].map(|first| Vector {
            start: [0, 1, 2].map(|h| component(first + h)),
            change: [0, 1, 2].map(|h| component(first + 3 + h)),
        });
        let n: [Quadratic<L>; 3] = k.cross(&l);
        let sum = |m: &[L::Linear; 3], i: usize| {
            let [x, y, z] = [0, 1, 2].map(|h| L::times_quadratic(&n[h][i], &m[h]));
            x.add(&y).add(&z)
        };
        let f = [
            sum(&m.start, 0),
            sum(&m.start, 1).add(&sum(&m.change, 0)),
            sum(&m.start, 2).add(&sum(&m.change, 1)),
            sum(&m.change, 2),
        ];
        Motion { k, l, m, n, f }
    }

    /// For an end `X` and the other edge `YZ`: `(Y - X) x (Z - X)`, up to sign. It is 0 where `X` is
    /// on the line `YZ`, or where `Y` and `Z` are the same.
    pub(super) fn turn(&self, end: End) -> [Quadratic<L>; 3] {
        match end {
            End::A => self.m.cross(&self.l),
            End::B => subtract_vector::<L>(&self.m.cross(&self.l), &self.n),
            End::C => self.m.cross(&self.k),
            End::D => subtract_vector::<L>(&self.m.cross(&self.k), &self.n),
        }
    }

    /// For an end `X` and the other edge `YZ`: `(Y - X) . (Z - X)`. Where the [`turn`](Self::turn)
    /// is 0 and `X` is on the line `YZ`, it is below 0 between `Y` and `Z`, 0 at these, above 0
    /// beyond them.
    pub(super) fn between(&self, end: End) -> Quadratic<L> {
        let (mm, ml, mk) = (
            self.m.dot(&self.m),
            self.m.dot(&self.l),
            self.m.dot(&self.k),
        );
        match end {
            End::A => add::<L>(&mm, &ml),
            End::C => subtract::<L>(&mm, &mk),
            // (M - K) . (M + L - K)
            End::B => {
                let (kl, kk) = (self.k.dot(&self.l), self.k.dot(&self.k));
                let both = subtract::<L>(&add::<L>(&mm, &ml), &add::<L>(&mk, &mk));
                subtract::<L>(&add::<L>(&both, &kk), &kl)
            }
            // (M + L) . (M + L - K)
            End::D => {
                let (kl, ll) = (self.k.dot(&self.l), self.l.dot(&self.l));
                let both = subtract::<L>(&add::<L>(&mm, &add::<L>(&ml, &ml)), &mk);
                subtract::<L>(&add::<L>(&both, &ll), &kl)
            }
        }
    }

    /// The signs of the Bernstein coefficients of `f` on `[0, 1]`.
    pub(super) fn bernstein_signs(&self) -> [Ordering; 4] {
        // Times 3: 3 f0, 3 f0 + f1, 3 f0 + 2 f1 + f2, 3 (f0 + f1 + f2 + f3).
        let [f0, f1, f2, f3] = &self.f;
        let two = f0.add(f1);
        let both = two.add(f0).add(f0);
        let third = both.add(f1).add(f2);
        [
            f0.sign(),
            both.sign(),
            third.sign(),
            two.add(f2).add(f3).sign(),
        ]
    }
}

/// `a + b`.
pub(super) fn add<L: Lane>(a: &Quadratic<L>, b: &Quadratic<L>) -> Quadratic<L> {
    std::array::from_fn(|i| a[i].add(&b[i]))
}

/// `a - b`.
pub(super) fn subtract<L: Lane>(a: &Quadratic<L>, b: &Quadratic<L>) -> Quadratic<L> {
    std::array::from_fn(|i| a[i].sub(&b[i]))
}

fn subtract_vector<L: Lane>(a: &[Quadratic<L>; 3], b: &[Quadratic<L>; 3]) -> [Quadratic<L>; 3] {
    std::array::from_fn(|h| subtract::<L>(&a[h], &b[h]))
}

/// `-a`.
pub(super) fn negate<L: Lane>(a: &Quadratic<L>) -> Quadratic<L> {
    a.each_ref().map(|c| c.sub(c).sub(c))
}
