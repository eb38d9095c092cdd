//! Linking numbers of closed wires, from the crossings of their projections.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_rational::BigRational;
use tunnelproof::query::Point;
use tunnelproof::wire::{NodeKind, StepRecord, WireRecord};

type Exact = [BigRational; 3];

/// Directions of view, none along anything.
const VIEWS: [[i64; 2]; 2] = [[3, 7], [-5, 11]];

fn exact(point: &Point) -> Exact {
    [point.x, point.y, point.z].map(|x| BigRational::from_float(x).expect("finite"))
}

/// Whether both ends of a wire are pinned to one point.
fn is_closed(wire: &WireRecord) -> bool {
    let pinned = |kind: Option<&NodeKind>| kind == Some(&NodeKind::Pinned);
    pinned(wire.kinds.first())
        && pinned(wire.kinds.last())
        && wire.before.first() == wire.before.last()
}

/// The sum of the signs of the crossings at which the first curve is above the second, seen along a
/// direction. `None` if corners cover each other.
fn linking(a: &[Point], b: &[Point], view: [i64; 2]) -> Option<i64> {
    let flat = |point: &Point| {
        let [x, y, z] = exact(point);
        let along = |k: usize| BigRational::new(BigInt::from(view[k]), BigInt::from(1013));
        [x - &z * along(0), y - &z * along(1), z]
    };
    let [a, b] = [a, b].map(|curve| curve.iter().map(flat).collect::<Vec<_>>());
    let zero = || BigRational::from_integer(BigInt::ZERO);
    let mut sum = 0;
    for p in a.windows(2) {
        for q in b.windows(2) {
            let way = |from: &Exact, to: &Exact| [0, 1, 2].map(|h| &to[h] - &from[h]);
            let turn = |u: &Exact, v: &Exact| &u[0] * &v[1] - &u[1] * &v[0];
            let (k, l, m) = (way(&p[0], &p[1]), way(&q[0], &q[1]), way(&p[0], &q[0]));
            let n = turn(&k, &l);
            if n == zero() {
                continue;
            }
            let (u, v) = (turn(&m, &l) / &n, turn(&m, &k) / &n);
            let one = BigRational::from_integer(BigInt::from(1));
            let is_edge = |x: &BigRational| *x == zero() || *x == one;
            let is_off = |x: &BigRational| *x < zero() || *x > one;
            if is_off(&u) || is_off(&v) {
                continue;
            }
            let above = &m[2] + &l[2] * &v - &k[2] * &u;
            if is_edge(&u) || is_edge(&v) || above == zero() {
                return None;
            }
            if above < zero() {
                sum += if n > zero() { -1 } else { 1 };
            }
        }
    }
    Some(sum)
}

/// How many pairs of closed wires were compared: the change of their linking number is the number
/// of passages.
pub(crate) fn differing(
    records: &[StepRecord],
    sums: &BTreeMap<[usize; 2], i64>,
) -> Result<u64, String> {
    let Some((first, last)) = records.first().zip(records.last()) else {
        return Ok(0);
    };
    if !last.remeshes.is_empty() {
        return Ok(0);
    }
    let mut compared = 0;
    for a in 0..first.wires.len() {
        for b in a + 1..first.wires.len() {
            let closed = |w: usize| is_closed(&first.wires[w]);
            let pin = |w: usize| first.wires[w].before[0];
            if !(closed(a) && closed(b)) || pin(a) == pin(b) {
                continue;
            }
            let link = |view| {
                let before = linking(&first.wires[a].before, &first.wires[b].before, view)?;
                Some(linking(&last.wires[a].after, &last.wires[b].after, view)? - before)
            };
            let Some(changes) = VIEWS.map(link).into_iter().collect::<Option<Vec<_>>>() else {
                continue;
            };
            let sum = sums.get(&[a, b]).copied().unwrap_or(0);
            if changes.iter().any(|change| *change != sum) {
                return Err(format!(
                    "wires {a} and {b} count {sum}, linking numbers change by {changes:?}"
                ));
            }
            compared += 1;
        }
    }
    Ok(compared)
}
