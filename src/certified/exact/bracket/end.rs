//! An end of a bracket, and what is known of the polynomial there.

use std::cell::Cell;
use std::cmp::Ordering;

use super::super::dyadic::Dyadic;
use super::super::integer::Integer;
use super::super::poly::Poly;

/// An end of a bracket.
#[derive(Clone, Debug)]
pub(super) struct End {
    pub(super) at: Dyadic,
    /// Whether the polynomial is known not to be 0 there; another root may be there at first.
    pub(super) is_proved: bool,
    /// The value of the polynomial there, as far as it was computed. An end stays where it is while
    /// the other one moves.
    value: Option<Value>,
}

/// What is known of a value.
#[derive(Clone, Debug)]
enum Value {
    /// What [`Poly::approximate_at`] says.
    Approximate(Ordering, (f64, i64)),
    /// What [`Poly::leading_at`] says, and the bits that it was asked for. On the heap, as most
    /// brackets have none, and move a lot.
    Leading(Box<(Integer, i64, u64)>),
}

impl End {
    pub(super) fn new(at: Dyadic) -> Self {
        End {
            at,
            is_proved: false,
            value: None,
        }
    }

    pub(super) fn proved(at: Dyadic) -> Self {
        End {
            is_proved: true,
            ..End::new(at)
        }
    }

    /// [`Poly::approximate_at`] there.
    pub(super) fn approximate<const N: usize>(
        &mut self,
        poly: &Poly<N>,
        enough: &Cell<u64>,
    ) -> (Ordering, (f64, i64)) {
        if let Some(Value::Approximate(sign, value)) = self.value {
            return (sign, value);
        }
        let (sign, value) = poly.approximate_at(&self.at, enough);
        self.value = Some(Value::Approximate(sign, value));
        (sign, value)
    }

    /// [`Poly::leading_at`] there, with so many bits or more.
    pub(super) fn leading<const N: usize>(
        &mut self,
        poly: &Poly<N>,
        lost: &mut u64,
        bits: u64,
    ) -> (Integer, i64) {
        if let Some(Value::Leading(known)) = &self.value
            && known.2 >= bits
        {
            return (known.0.clone(), known.1);
        }
        let (value, exponent) = poly.leading_at(&self.at, lost, bits);
        let known = (value.clone(), exponent, bits);
        self.value = Some(Value::Leading(Box::new(known)));
        (value, exponent)
    }
}
