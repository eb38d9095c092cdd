//! From the bytes of a fuzzer to a query.
//!
//! First a few changes, then what they are made to: a query of any family, whose random numbers are
//! the bytes that follow; 24 numbers of any bits, or 24 small integers, and a radius. Every
//! sequence of bytes makes a query. Where the bytes end, zeros follow.

use std::convert::Infallible;

use arbitrary::{Arbitrary, Unstructured};
use rand::TryRng;
use rand::rand_core::utils;
use tunnelproof::query::{Query, QueryKind};

use tunnelproof_reference::generate::{self, FAMILIES, Family};
use tunnelproof_reference::shape::Shape;

/// The query that these bytes make.
pub fn query(bytes: &[u8]) -> Query {
    let mut bytes = Unstructured::new(bytes);
    let count = byte(&mut bytes) % 8;
    let changes: Vec<Change> = (0..count)
        .filter_map(|_| Change::arbitrary(&mut bytes).ok())
        .collect();
    let base = base(&mut bytes);
    let changed = changes.iter().fold(Shape::new(&base), Change::make);
    changed.query().unwrap_or(base)
}

/// The same of edges without radius.
pub fn edges(bytes: &[u8]) -> Query {
    let query = query(bytes);
    let edges = Shape {
        kind: QueryKind::EdgeEdge,
        radii: [0.0; 2],
        ..Shape::new(&query)
    };
    edges.query().unwrap_or(query)
}

/// Bytes that make a query of this family, which is given by its place in the table, out of these
/// random numbers: the seeds of a corpus.
pub fn seed(family: usize, random: &[u8]) -> Vec<u8> {
    [&[0, Base::Family as u8, family as u8], random].concat()
}

/// The family of this place in the table, those of edges without radius first.
fn family(place: u8) -> &'static Family {
    let place = usize::from(place) % generate::all().count();
    let family = generate::all().nth(place);
    family.unwrap_or(&FAMILIES[0])
}

/// Numbers of any bits are within a factor of 2 to this power of 1. Exact arithmetic takes a
/// thousand times as long on numbers that span all of `f64`, and these are as rare.
fn span(byte: u8) -> u64 {
    match byte % 64 {
        0 => 1023,
        1..4 => 200,
        4..16 => 30,
        16..40 => 8,
        _ => 2,
    }
}

/// What changes are made to.
enum Base {
    Family,
    AnyBits,
    SmallIntegers,
}

fn base(bytes: &mut Unstructured) -> Query {
    const BASES: [Base; 4] = [
        Base::Family,
        Base::AnyBits,
        Base::SmallIntegers,
        Base::Family,
    ];
    match BASES[usize::from(byte(bytes) % 4)] {
        Base::Family => family(byte(bytes)).draw(&mut Numbers::new(bytes)),
        Base::AnyBits => {
            let span = span(byte(bytes));
            of_numbers(bytes, |bytes| finite(word(bytes), span))
        }
        Base::SmallIntegers => {
            let largest = 1 + i16::from(byte(bytes) % 16);
            let integer = |byte: u8| i16::from(byte) % (2 * largest + 1) - largest;
            of_numbers(bytes, |bytes| f64::from(integer(byte(bytes))))
        }
    }
}

/// A query of these numbers. What kind it is, and whether it has a radius, is in the byte after
/// them.
fn of_numbers(bytes: &mut Unstructured, mut number: impl FnMut(&mut Unstructured) -> f64) -> Query {
    let numbers = [0; 24].map(|_| number(bytes));
    let more = byte(bytes);
    let mut radius = |bit: u8| match more & bit {
        0 => 0.0,
        _ => number(bytes).abs(),
    };
    let shape = Shape {
        numbers,
        radii: [radius(2), radius(4)],
        kind: match more & 1 {
            0 => QueryKind::EdgeEdge,
            _ => QueryKind::VertexFace,
        },
    };
    shape.query().unwrap_or_else(|| FAMILIES[0].query(0, 0))
}

/// The number of these bits, its exponent brought to within `span` of that of 1; 0, subnormal and
/// large numbers stay what they are if `span` is all there is.
pub(super) fn finite(bits: u64, span: u64) -> f64 {
    let biased = bits >> 52 & 0x7ff;
    let biased = match span {
        1023 => biased.min(0x7fe),
        span => 1023 - span + biased % (2 * span + 1),
    };
    f64::from_bits(bits & !(0x7ff << 52) | biased << 52)
}

pub(super) fn byte(bytes: &mut Unstructured) -> u8 {
    u8::arbitrary(bytes).unwrap_or(0)
}

pub(super) fn word(bytes: &mut Unstructured) -> u64 {
    u64::arbitrary(bytes).unwrap_or(0)
}

/// A change to a query. Indices are taken modulo what there is.
#[derive(Arbitrary, Clone, Copy, Debug)]
enum Change {
    /// A number takes the value of another one.
    Copy { from: u8, to: u8 },
    /// A position takes the value of another one.
    CopyPosition { from: u8, to: u8 },
    /// A point becomes the same as another one for the whole step.
    CopyPoint { from: u8, to: u8 },
    /// A number moves to one of its neighbours in `f64`.
    Nudge { number: u8, by: i8 },
    /// A number becomes a small integer.
    Set { number: u8, to: i8 },
    /// A position becomes a point of the line through two others, nearly.
    Align { from: u8, to: u8, moved: u8, at: i8 },
    /// A point does not move.
    Rest { point: u8 },
    /// Everything is scaled by a power of two.
    Scale { exponent: i8 },
    /// Everything is shifted along an axis.
    Shift { axis: u8, by: i16 },
}

impl Change {
    fn make(shape: Shape, change: &Self) -> Shape {
        let mut result = shape;
        let position = |index: u8| usize::from(index % 8);
        match *change {
            Change::Copy { from, to } => {
                result.numbers[usize::from(to % 24)] = shape.numbers[usize::from(from % 24)];
            }
            Change::CopyPosition { from, to } => {
                result.set_position(position(to), shape.position(position(from)));
            }
            Change::CopyPoint { from, to } => {
                for end in [0, 4] {
                    let from = shape.position(usize::from(from % 4) + end);
                    result.set_position(usize::from(to % 4) + end, from);
                }
            }
            Change::Nudge { number, by } => {
                let number = &mut result.numbers[usize::from(number % 24)];
                for _ in 0..by.unsigned_abs() {
                    *number = if by > 0 {
                        number.next_up()
                    } else {
                        number.next_down()
                    };
                }
            }
            Change::Set { number, to } => {
                result.numbers[usize::from(number % 24)] = f64::from(to);
            }
            Change::Align {
                from,
                to,
                moved,
                at,
            } => {
                let (a, b) = (shape.position(position(from)), shape.position(position(to)));
                let share = f64::from(at) / 8.0;
                let between = [0, 1, 2].map(|axis| a[axis] + share * (b[axis] - a[axis]));
                result.set_position(position(moved), between);
            }
            Change::Rest { point } => {
                let point = usize::from(point % 4);
                result.set_position(point + 4, shape.position(point));
            }
            Change::Scale { exponent } => {
                let factor = 2f64.powi(exponent.into());
                result = shape.changed(0..24, |number| number * factor);
            }
            Change::Shift { axis, by } => {
                let axis = usize::from(axis % 3);
                let by = f64::from(by) / 16.0;
                result = shape.changed((axis..24).step_by(3), |number| number + by);
            }
        }
        if result.query().is_some() {
            result
        } else {
            shape
        }
    }
}

/// The bytes as random numbers: zeros where they have ended and, after many of these, numbers that
/// differ, so that who draws until something fits comes to an end.
pub(super) struct Numbers<'a, 'b> {
    bytes: &'b mut Unstructured<'a>,
    past_the_end: u64,
}

/// How many numbers past the end are 0.
const ZEROS: u64 = 1 << 10;

impl<'a, 'b> Numbers<'a, 'b> {
    pub(super) fn new(bytes: &'b mut Unstructured<'a>) -> Self {
        Numbers {
            bytes,
            past_the_end: 0,
        }
    }

    fn next<const N: usize>(&mut self) -> [u8; N] {
        let mut next = [0; N];
        if self.bytes.is_empty() {
            self.past_the_end += 1;
        }
        if self.past_the_end > ZEROS {
            // An odd factor: every number of 64 bits comes.
            let number = self.past_the_end.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            next.copy_from_slice(&number.rotate_left(32).to_le_bytes()[..N]);
        } else {
            let count = self.bytes.len().min(N);
            // There are that many.
            let _ = self.bytes.fill_buffer(&mut next[..count]);
        }
        next
    }
}

impl TryRng for Numbers<'_, '_> {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok(u32::from_le_bytes(self.next()))
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(u64::from_le_bytes(self.next()))
    }

    fn try_fill_bytes(&mut self, destination: &mut [u8]) -> Result<(), Infallible> {
        utils::fill_bytes_via_next_word(destination, || self.try_next_u64())
    }
}
