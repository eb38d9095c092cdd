//! Vectors that move: polynomials for components.

use super::Poly;
use crate::certified::exact::integer::Integer;

pub(in crate::certified::exact) type Vector = [Poly; 3];

pub(in crate::certified::exact) fn add(x: &Vector, y: &Vector) -> Vector {
    [0, 1, 2].map(|i| Poly::sum(&x[i], &y[i]))
}

pub(in crate::certified::exact) fn sub(x: &Vector, y: &Vector) -> Vector {
    [0, 1, 2].map(|i| Poly::difference(&x[i], &y[i]))
}

pub(in crate::certified::exact) fn neg(x: &Vector) -> Vector {
    sub(&Default::default(), x)
}

pub(in crate::certified::exact) fn cross(x: &Vector, y: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| Poly::difference(&Poly::product(&x[i], &y[j]), &Poly::product(&x[j], &y[i])))
}

pub(in crate::certified::exact) fn dot(x: &Vector, y: &Vector) -> Poly {
    let [a, b, c] = [0, 1, 2].map(|i| Poly::product(&x[i], &y[i]));
    Poly::sum(&Poly::sum(&a, &b), &c)
}

pub(in crate::certified::exact) fn times(x: &Vector, factor: &Poly) -> Vector {
    x.each_ref().map(|x| Poly::product(x, factor))
}

/// The polynomial that is 1.
pub(in crate::certified::exact) fn one() -> Poly {
    Poly::new(&[Integer::from(1)])
}

/// Whether it is 0 for the whole step.
pub(in crate::certified::exact) fn is_zero(x: &Vector) -> bool {
    x.iter().all(Poly::is_zero)
}
