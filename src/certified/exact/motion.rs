//! The motion of two edges as polynomials in `t`.
//!
//! `K = B - A`, `L = D - C`, `M = C - A`, all linear; `N = K x L`, quadratic; `f = M . N`, cubic. A
//! polynomial is the array of its coefficients, the constant one first.

use std::cell::OnceCell;

use super::width::{Number, Width};

/// A polynomial of degree 2.
pub(super) type Quadratic<L> = [<L as Width>::Quadratic; 3];

/// A polynomial of degree 3.
pub(super) type Cubic<L> = [<L as Width>::Cubic; 4];

/// A vector in space that moves linearly: its components at the start, and their changes.
pub(super) struct Vector<L: Width> {
    start: [L::Linear; 3],
    change: [L::Linear; 3],
}

/// The motion of two edges.
pub(super) struct Motion<L: Width> {
    pub(super) k: Vector<L>,
    pub(super) l: Vector<L>,
    pub(super) m: Vector<L>,
    pub(super) n: [Quadratic<L>; 3],
    /// The edges can touch only where it is 0.
    pub(super) f: Cubic<L>,
    ends: OnceCell<[End<L>; 4]>,
}

/// An end `X` of an edge against the other edge `YZ`.
pub(super) struct End<L: Width> {
    /// `(Y - X) x (Z - X)`, up to sign. It is 0 where `X` is on the line `YZ`, or where `Y` and `Z`
    /// are the same.
    pub(super) turn: [Quadratic<L>; 3],
    /// `(Y - X) . (Z - X)`. Where the turn is 0 and `X` is on the line `YZ`, it is below 0 between
    /// `Y` and `Z`, 0 at these, above 0 beyond them.
    pub(super) between: Quadratic<L>,
}

impl<L: Width> Vector<L> {
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
        each(|h| self.cross_component(other, h))
    }

    /// The dot product.
    pub(super) fn dot(&self, other: &Self) -> Quadratic<L> {
        let sum = |a: &[L::Linear; 3], b: &[L::Linear; 3]| {
            let [x, y, z] = each(|h| L::times(&a[h], &b[h]));
            x.add(&y).add(&z)
        };
        [
            sum(&self.start, &other.start),
            sum(&self.start, &other.change).add(&sum(&self.change, &other.start)),
            sum(&self.change, &other.change),
        ]
    }
}

impl<L: Width> Motion<L> {
    /// The motion whose component with index `i`, in the order of [`super::scaled::Scaled`], is
    /// `component(i)`.
    #[inline]
    pub(super) fn new(component: impl Fn(usize) -> L::Linear) -> Self {
        let [k, l, m] = each(|i| Vector {
            start: each(|h| component(6 * i + h)),
            change: each(|h| component(6 * i + 3 + h)),
        });
        let n: [Quadratic<L>; 3] = k.cross(&l);
        let sum = |m: &[L::Linear; 3], i: usize| {
            let [x, y, z] = each(|h| L::times_quadratic(&n[h][i], &m[h]));
            x.add(&y).add(&z)
        };
        let f = [
            sum(&m.start, 0),
            sum(&m.start, 1).add(&sum(&m.change, 0)),
            sum(&m.start, 2).add(&sum(&m.change, 1)),
            sum(&m.change, 2),
        ];
        Motion {
            k,
            l,
            m,
            n,
            f,
            ends: OnceCell::new(),
        }
    }

    /// Every end against the other edge, in the order A, B, C, D; computed once.
    pub(super) fn ends(&self) -> &[End<L>; 4] {
        self.ends.get_or_init(|| self.compute_ends())
    }

    fn compute_ends(&self) -> [End<L>; 4] {
        let Motion { k, l, m, n, .. } = self;
        let (ml_turn, mk_turn) = (m.cross(l), m.cross(k));
        let (mm, ml, mk) = (m.dot(m), m.dot(l), m.dot(k));
        let (kk, kl, ll) = (k.dot(k), k.dot(l), l.dot(l));
        // (M - K) . (M + L - K) and (M + L) . (M + L - K)
        let common = subtract::<L>(&add::<L>(&mm, &ml), &add::<L>(&mk, &kl));
        [
            End {
                turn: ml_turn.clone(),
                between: add::<L>(&mm, &ml),
            },
            End {
                turn: subtract_vector::<L>(&ml_turn, n),
                between: add::<L>(&subtract::<L>(&common, &mk), &kk),
            },
            End {
                turn: mk_turn.clone(),
                between: subtract::<L>(&mm, &mk),
            },
            End {
                turn: subtract_vector::<L>(&mk_turn, n),
                between: add::<L>(&add::<L>(&common, &ml), &ll),
            },
        ]
    }
}

/// `a + b`.
pub(super) fn add<L: Width>(a: &Quadratic<L>, b: &Quadratic<L>) -> Quadratic<L> {
    each(|i| a[i].add(&b[i]))
}

/// `a - b`.
pub(super) fn subtract<L: Width>(a: &Quadratic<L>, b: &Quadratic<L>) -> Quadratic<L> {
    each(|i| a[i].sub(&b[i]))
}

/// `a - b`, of vectors.
pub(super) fn subtract_vector<L: Width>(
    a: &[Quadratic<L>; 3],
    b: &[Quadratic<L>; 3],
) -> [Quadratic<L>; 3] {
    each(|h| subtract::<L>(&a[h], &b[h]))
}

/// `-a`.
pub(super) fn negate<L: Width>(a: &Quadratic<L>) -> Quadratic<L> {
    each(|i| a[i].sub(&a[i]).sub(&a[i]))
}

/// The three results; unlike `map` of an array it is always compiled into its caller.
#[inline(always)]
fn each<T>(of: impl Fn(usize) -> T) -> [T; 3] {
    [of(0), of(1), of(2)]
}
