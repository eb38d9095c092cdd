//! The bounds of the module, by the code that they speak of: its own functions, on polynomials in the
//! components of the motion in place of numbers, and on bounds of magnitudes for values at a time.
//!
//! Every sum and every product that is computed is checked against the bits that its type has. What
//! depends on a sign takes either way, by chance, so that many runs go through every branch.

use std::cell::Cell;
use std::cmp::Ordering;
use std::collections::BTreeMap;

use num_bigint::BigUint;

use super::super::curve::{Curve, bernstein_signs};
use super::super::face::Face;
use super::super::fraction::Fraction;
use super::super::motion::Motion;
use super::super::time::Time;
use super::super::{Huge, Large, Medium, Small, Tiny};
use super::*;

thread_local! {
    /// The `b` of the bounds, and how far chance has come.
    static WIDTH: Cell<u32> = const { Cell::new(0) };
    static CHANCE: Cell<u64> = const { Cell::new(1) };
}

fn chance() -> Ordering {
    let mut x = CHANCE.get();
    x ^= x << 13;
    x ^= x >> 7;
    x ^= x << 17;
    CHANCE.set(x);
    [Ordering::Less, Ordering::Equal, Ordering::Greater][(x >> 33) as usize % 3]
}

/// The functions of a number that tell its value, of which nothing is known.
macro_rules! values_by_chance {
    () => {
        fn sign(&self) -> Ordering {
            chance()
        }

        fn to_f64(&self) -> f64 {
            f64::from(chance() as i8)
        }

        fn to_integer(&self) -> Integer {
            Integer::default()
        }
    };
}

/// A polynomial in the components of a motion, of degree `D`: the product of the components with
/// these indices, in ascending order, times a coefficient each. So what cancels is seen.
#[derive(Clone, Debug)]
struct Terms<const D: u32>(BTreeMap<Vec<usize>, i64>);

/// A magnitude that a value does not exceed.
#[derive(Clone, Debug)]
struct Bound<const D: u32>(BigUint);

/// The bits of the magnitude of a coefficient of a degree, or of a value, that the documentation of
/// the module states.
fn stated_bits(degree: u32) -> u64 {
    let b = u64::from(WIDTH.get());
    match degree {
        1 => b,
        2 => 2 * b + 7,
        3 => 3 * b + 8,
        // Values of degree 2, and what is of degree 4.
        4 => 2 * b + 7 + 256,
        _ => 3 * b + 8 + 384,
    }
}

impl<const D: u32> Terms<D> {
    /// With components below `2^b`.
    fn magnitude(&self) -> BigUint {
        let sum: u64 = self.0.values().map(|c| c.unsigned_abs()).sum();
        BigUint::from(sum) << (D * WIDTH.get())
    }

    fn checked(self) -> Self {
        // All components are below 2^b, so that the sum is.
        let magnitude = self.magnitude();
        let limit = BigUint::from(1u32) << stated_bits(D);
        assert!(magnitude <= limit, "{magnitude} of degree {D}");
        self
    }

    fn plus(&self, other: &Self, factor: i64) -> Self {
        let mut terms = self.0.clone();
        for (product, coefficient) in &other.0 {
            *terms.entry(product.clone()).or_default() += factor * coefficient;
        }
        terms.retain(|_, coefficient| *coefficient != 0);
        Terms(terms).checked()
    }

    fn times<const E: u32, const F: u32>(&self, other: &Terms<E>) -> Terms<F> {
        let mut terms = BTreeMap::new();
        for (a, x) in &self.0 {
            for (b, y) in &other.0 {
                let mut product = [&a[..], b].concat();
                product.sort_unstable();
                *terms.entry(product).or_default() += x * y;
            }
        }
        Terms(terms).checked()
    }
}

impl<const D: u32> Number for Terms<D> {
    fn add(&self, other: &Self) -> Self {
        self.plus(other, 1)
    }

    fn sub(&self, other: &Self) -> Self {
        self.plus(other, -1)
    }

    values_by_chance!();
}

impl<const D: u32> Bound<D> {
    fn checked(magnitude: BigUint) -> Self {
        assert!(
            magnitude.bits() <= stated_bits(D),
            "{magnitude} of degree {D}"
        );
        Bound(magnitude)
    }
}

impl<const D: u32> Number for Bound<D> {
    fn add(&self, other: &Self) -> Self {
        Bound::checked(&self.0 + &other.0)
    }

    fn sub(&self, other: &Self) -> Self {
        self.add(other)
    }

    values_by_chance!();
}

/// `|c0| + |c1| + ...` times the power of a denominator: what a value at a time in `[0, 1]` is not
/// above, nor any sum on the way.
fn value<const D: u32, const V: u32>(c: &[Terms<D>], denominator: &BigUint) -> Bound<V> {
    let sum: BigUint = c.iter().map(Terms::magnitude).sum();
    Bound::checked(sum * denominator.pow(c.len() as u32 - 1))
}

fn grid() -> BigUint {
    BigUint::from(1u32) << 128
}

struct Bounds;

impl Width for Bounds {
    type Linear = Terms<1>;
    type Quadratic = Terms<2>;
    type Cubic = Terms<3>;
    type QuadraticValue = Bound<4>;
    type CubicValue = Bound<5>;
    type Isolated = Isolated;
    type Poly = Poly;

    fn times(a: &Terms<1>, b: &Terms<1>) -> Terms<2> {
        a.times(b)
    }

    fn times_quadratic(a: &Terms<2>, b: &Terms<1>) -> Terms<3> {
        a.times(b)
    }

    fn times_quadratics(a: &Terms<2>, b: &Terms<2>) -> Bound<4> {
        Bound::checked(a.magnitude() * b.magnitude())
    }

    fn quadratic_at(c: &[Terms<2>; 3], _: u128) -> Bound<4> {
        value(c, &grid())
    }

    fn cubic_at(c: &[Terms<3>; 4], _: u128) -> Bound<5> {
        value(c, &grid())
    }

    fn widened(c: &Terms<3>) -> Bound<5> {
        Bound::checked(c.magnitude())
    }

    fn quadratic_at_fraction(c: &[Terms<2>; 3], at: Fraction) -> Bound<4> {
        value(c, &BigUint::from(at.denominator))
    }

    fn cubic_at_fraction(c: &[Terms<3>; 4], at: Fraction) -> Bound<5> {
        value(c, &BigUint::from(at.denominator))
    }
}

/// The component with an index.
fn component(i: usize) -> Terms<1> {
    Terms(BTreeMap::from([(vec![i], 1)]))
}

/// Everything that is computed of a motion with differences below `2^b`.
fn compute_all(b: u32) {
    WIDTH.set(b);
    let motion = || Motion::<Bounds>::new(component);
    let at = Fraction {
        numerator: 1,
        denominator: Fraction::LIMIT - 1,
    };
    let visit = |c: &[Terms<2>; 3]| {
        let curve = Curve::<Bounds>::Quadratic(c.clone());
        let _ = bernstein_signs::<Bounds>(c);
        let _ = (curve.bernstein_signs(), curve.discriminant_sign());
        let derivative = curve.derivative().expect("a quadratic");
        let _ = (derivative.bernstein_signs(), derivative.is_root(at));
        Bounds::quadratic_at(c, 1);
        Bounds::times_quadratics(&c[0], &c[2]).sub(&Bounds::times_quadratics(&c[2], &c[0]));
        Bounds::quadratic_at_fraction(c, at);
    };
    let edges = motion();
    for end in edges.ends() {
        end.turn.iter().for_each(visit);
        visit(&end.between);
    }
    edges.n.iter().for_each(visit);
    let curve = Curve::<Bounds>::Cubic(edges.f.clone());
    let _ = (curve.bernstein_signs(), curve.is_root(at));
    Bounds::cubic_at(&edges.f, 1);
    let face = Face::new(motion());
    for end in face.edges() {
        end.turn.iter().for_each(visit);
        visit(&end.between);
    }
    for _ in 0..500 {
        for time in [Time::start(), Time::end()] {
            let _ = (edges.locus(&time).is_some(), face.place(&time).is_some());
        }
        let _ = (edges.confined_case(), face.case());
    }
}

#[test]
fn widths_hold_every_number_that_is_computed() {
    for b in [
        Tiny::BITS,
        Small::BITS,
        Medium::BITS,
        Large::BITS,
        Huge::BITS,
    ] {
        compute_all(b);
    }
}

/// The bits that are stated fit into the limbs that each width has, and no width is a bit too
/// careful: one more does not fit.
#[test]
fn widths_have_the_limbs_of_their_bounds() {
    fn check<const L: u32, const Q: u32, const C: u32>(b: u32) {
        let fits = |b: u32| {
            WIDTH.set(b);
            let limbs = |bits: u64| (bits + 1).div_ceil(64) as u32;
            limbs(stated_bits(1)) <= L
                && limbs(stated_bits(2)) <= Q
                && limbs(stated_bits(3)) <= C
                && limbs(stated_bits(4)) <= Q + 4
                && limbs(stated_bits(5)) <= C + 6
        };
        assert!(fits(b) && !fits(b + 1), "{b}");
    }
    check::<1, 1, 2>(Tiny::BITS);
    check::<1, 2, 2>(Small::BITS);
    check::<1, 2, 3>(Medium::BITS);
    check::<2, 3, 5>(Large::BITS);
    check::<2, 4, 6>(Huge::BITS);
}

/// A sum that is larger than is stated is noticed.
#[test]
#[should_panic(expected = "of degree 2")]
fn widths_do_not_hold_larger_sums() {
    WIDTH.set(Tiny::BITS);
    let square: Terms<2> = component(0).times(&component(0));
    let mut sum = square.clone();
    for _ in 0..128 {
        sum = sum.add(&square);
    }
}
