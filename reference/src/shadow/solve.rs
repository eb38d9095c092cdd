//! `Solve` of the thesis: the roots of a polynomial in `[0, 1]`, ascending, as real algebraic
//! numbers.

use crate::algebraic::{Algebraic, isolate_roots};
use crate::field::Integer;
use crate::poly::Poly;

/// The distinct roots in `[0, 1]`, ascending, of the polynomial with these coefficients, the one of
/// the highest power first: `c0 t^2 + c1 t + c2` as Algorithm 3 names them.
///
/// The zero polynomial, of which every `t` is a root, has none here: the text does not say what
/// `Solve` returns for it, and a method that looks for isolated roots finds none. It gets here only
/// with `Erratum::StrictSkip` unrepaired.
pub(super) fn solve<Z: Integer>(coefficients: &[Z]) -> Vec<Algebraic<Z>> {
    let ascending = coefficients.iter().rev().cloned().collect();
    isolate_roots(&Poly::new(ascending))
}
