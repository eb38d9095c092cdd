//! Passages counted a second time, with nothing of the audit: exact integers, wires moved by a hair
//! in other directions, and roots kept in by subdivision of Bernstein polynomials.
//!
//! Places are integers in the unit of their last bit, times `2^HAIR`; each wire is moved by some
//! integers and sheared along its arc length, and all nodes fixed to one point go together. Every
//! pair of segments is looked at whose boxes meet and that is not joined, whether it touches before
//! it is moved or not.

use std::collections::BTreeMap;

use num_bigint::{BigInt, Sign};
use tunnelproof::query::Point;
use tunnelproof::wire::{NodeKind, RemeshKind, StepRecord};

/// A hair is `2^-HAIR` of the last bit of the smallest coordinate.
const HAIR: u32 = 300;

/// How deep the step is divided. At the end of a hair's width nothing is undecided any more.
const DEEPEST: u32 = 3000;

type Place = [f64; 3];
type Exact = [BigInt; 3];
/// Bernstein coefficients over the binomial coefficients' multiples: a polynomial on an interval.
type Bernstein = Vec<BigInt>;

/// A node where a motion starts and ends.
#[derive(Clone, Copy, Debug)]
struct Node {
    wire: usize,
    arc: f64,
    kind: NodeKind,
    from: Place,
    to: Place,
}

impl Node {
    /// What it is fixed to.
    fn anchor(&self) -> Option<String> {
        match self.kind {
            NodeKind::Pinned => Some(format!("world {:?}", self.from.map(|x| x + 0.0))),
            NodeKind::Eye { body, local } | NodeKind::Contact { body, local, .. } => Some(format!(
                "body {} {:?}",
                body.0,
                [local.x + 0.0, local.y + 0.0, local.z + 0.0]
            )),
            _ => None,
        }
    }
}

/// Signed passages by pair of wires.
#[derive(Debug, Default)]
pub(crate) struct Count {
    pub(crate) sums: BTreeMap<[usize; 2], i64>,
    /// Passages in steps, whatever their sign, and in changes of resolution.
    pub(crate) passages: [u64; 2],
    seed: u64,
}

fn scrambled(text: &str) -> u64 {
    // FNV-1a.
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

fn integers(text: &str) -> [f64; 3] {
    ["x", "y", "z"].map(|axis| (scrambled(&format!("{axis} {text}")) >> 20) as u32 as f64 - 2e9)
}

impl Count {
    pub(crate) fn new(seed: u64) -> Self {
        Count {
            seed,
            ..Count::default()
        }
    }

    pub(crate) fn standing(&self) -> Vec<([usize; 2], i64)> {
        let sums = self.sums.iter().filter(|(_, sum)| **sum != 0);
        sums.map(|(wires, sum)| (*wires, *sum)).collect()
    }

    pub(crate) fn step(&mut self, record: &StepRecord) {
        let mut wires: Vec<Vec<Node>> = (record.wires.iter().enumerate())
            .map(|(wire, w)| {
                let node = |k: usize| Node {
                    wire,
                    arc: w.arcs[k],
                    kind: w.kinds[k],
                    from: w.before[k].into(),
                    to: w.after[k].into(),
                };
                (0..w.before.len()).map(node).collect()
            })
            .collect();
        let segments: Vec<(usize, [Node; 2])> = (wires.iter())
            .flat_map(|nodes| {
                nodes
                    .windows(2)
                    .enumerate()
                    .map(|(k, two)| (k, [two[0], two[1]]))
            })
            .collect();
        for (i, (k, a)) in segments.iter().enumerate() {
            for (l, b) in &segments[i + 1..] {
                let neighbours = a[0].wire == b[0].wire && k.abs_diff(*l) <= 1;
                if !neighbours && !are_fixed_together(a, b) {
                    self.pair(a, b, 0);
                }
            }
        }
        for nodes in &mut wires {
            nodes.iter_mut().for_each(|node| node.from = node.to);
        }
        for change in &record.remeshes {
            let corners = change.triangle.map(|point: Point| <[f64; 3]>::from(point));
            let own = change.wire.0;
            let first = wires[own].iter().position(|node| node.from == corners[0]);
            let first = first.expect("the change is of this wire");
            let is_merge = change.kind == RemeshKind::Merge;
            let middle = Node {
                wire: own,
                arc: change.arcs[1],
                kind: NodeKind::Free,
                from: corners[1],
                to: corners[1],
            };
            let last = first + 1 + usize::from(is_merge);
            let (a, c) = (wires[own][first], wires[own][last]);
            // The end of the first of the two segments goes to the far corner, or comes from there.
            let goes = if is_merge { [middle, c] } else { [c, middle] };
            for nodes in &wires {
                for (k, two) in nodes.windows(2).enumerate() {
                    let beside = nodes[0].wire == own && k + 1 >= first && k <= last;
                    let two = [two[0], two[1]];
                    if !beside && !are_fixed_together(&[a, c], &two) {
                        self.swept([a, a], goes, two);
                    }
                }
            }
            if is_merge {
                wires[own].remove(first + 1);
            } else {
                wires[own].insert(first + 1, middle);
            }
        }
    }

    /// A segment whose end goes from one node's place to another's.
    fn swept(&mut self, start: [Node; 2], goes: [Node; 2], other: [Node; 2]) {
        let offsets = [start[0], goes[0], other[0], other[1]].map(|node| self.offset(&node));
        let ends = [start[1], goes[1], other[0], other[1]].map(|node| self.offset(&node));
        let from = [start[0], goes[0], other[0], other[1]].map(|node| node.from);
        let to = [start[1], goes[1], other[0], other[1]].map(|node| node.from);
        self.enter(
            [start[0].wire, other[0].wire],
            [from, to],
            [offsets, ends],
            1,
        );
    }

    fn pair(&mut self, a: &[Node; 2], b: &[Node; 2], kind: usize) {
        let four = [a[0], a[1], b[0], b[1]];
        let offsets = four.map(|node| self.offset(&node));
        let places = [four.map(|node| node.from), four.map(|node| node.to)];
        self.enter(
            [a[0].wire, b[0].wire],
            places,
            [offsets.clone(), offsets],
            kind,
        );
    }

    fn enter(
        &mut self,
        wires: [usize; 2],
        places: [[Place; 4]; 2],
        offsets: [[Exact; 4]; 2],
        kind: usize,
    ) {
        if are_apart(&places) {
            return;
        }
        let sum = crossings(&exact(&places, &offsets));
        self.passages[kind] += sum.unsigned_abs();
        *self
            .sums
            .entry([wires[0].min(wires[1]), wires[0].max(wires[1])])
            .or_default() += sum;
    }

    /// By how much a node is moved: with what it is fixed to, else with its wire, by an amount that
    /// grows with arc length.
    fn offset(&self, node: &Node) -> Exact {
        let fixed = node
            .anchor()
            .filter(|_| !matches!(node.kind, NodeKind::Contact { .. }));
        let seed = self.seed;
        let numbers = match fixed {
            Some(anchor) => integers(&format!("{seed} {anchor}")),
            None => {
                // A cubic: what is straight is so no more.
                let power = |k: i32| {
                    let numbers = integers(&format!("{seed} wire {} to {k}", node.wire));
                    numbers.map(|x| x * node.arc.powi(k))
                };
                let powers = [0, 1, 2, 3].map(power);
                [0, 1, 2].map(|h| powers.iter().map(|power| power[h]).sum::<f64>().round())
            }
        };
        numbers.map(|x| BigInt::from(x as i64))
    }
}

fn are_fixed_together(a: &[Node; 2], b: &[Node; 2]) -> bool {
    let anchors = |two: &[Node; 2]| [two[0].anchor(), two[1].anchor()];
    let others = anchors(b);
    anchors(a)
        .iter()
        .flatten()
        .any(|anchor| others.contains(&Some(anchor.clone())))
}

/// Whether the boxes of two moving segments do not meet.
fn are_apart([from, to]: &[[Place; 4]; 2]) -> bool {
    (0..3).any(|h| {
        let range = |k: usize| {
            let of = [from[k][h], from[k + 1][h], to[k][h], to[k + 1][h]];
            (
                of.into_iter().fold(f64::INFINITY, f64::min),
                of.into_iter().fold(f64::NEG_INFINITY, f64::max),
            )
        };
        let (a, b) = (range(0), range(2));
        a.1 < b.0 || b.1 < a.0
    })
}

/// Places as integers, each moved by a hair.
fn exact(places: &[[Place; 4]; 2], offsets: &[[Exact; 4]; 2]) -> [[Exact; 4]; 2] {
    let parts = |x: f64| {
        let bits = x.to_bits();
        let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i64, (bits & ((1 << 52) - 1)) as i64);
        let (mantissa, exponent) = match exponent {
            0 => (fraction, -1074),
            _ => (fraction | 1 << 52, exponent - 1075),
        };
        (if x < 0.0 { -mantissa } else { mantissa }, exponent)
    };
    let all = places.as_flattened().as_flattened().iter();
    let least = all
        .filter(|x| **x != 0.0)
        .map(|&x| parts(x).1)
        .min()
        .unwrap_or(0);
    let integer = |x: f64| match parts(x) {
        (0, _) => BigInt::ZERO,
        (mantissa, exponent) => BigInt::from(mantissa) << (exponent - least) as u32,
    };
    [0, 1].map(|time| {
        [0, 1, 2, 3].map(|k| {
            [0, 1, 2].map(|h| (integer(places[time][k][h]) << HAIR) + &offsets[time][k][h])
        })
    })
}

/// A vector of polynomials as coefficients of `t^k`.
type Vector = [Vec<BigInt>; 3];

fn product(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    let mut terms = vec![BigInt::ZERO; a.len() + b.len() - 1];
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            terms[i + j] += x * y;
        }
    }
    terms
}

fn difference(a: &[BigInt], b: &[BigInt]) -> Vec<BigInt> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)]
        .map(|(i, j)| difference(&product(&a[i], &b[j]), &product(&a[j], &b[i])))
}

fn dot(a: &Vector, b: &Vector) -> Vec<BigInt> {
    let [x, y, z] = [0, 1, 2].map(|h| product(&a[h], &b[h]));
    x.iter()
        .zip(&y)
        .zip(&z)
        .map(|((x, y), z)| x + y + z)
        .collect()
}

/// Multiples of the Bernstein coefficients on `[0, 1]`, all by one positive number.
fn bernstein(poly: &[BigInt]) -> Bernstein {
    let n = poly.len() - 1;
    let choose = |n: usize, k: usize| (0..k).fold(1u64, |c, i| c * (n - i) as u64 / (i + 1) as u64);
    let all: u64 = (0..=n).map(|k| choose(n, k)).product();
    (0..=n)
        .map(|i| {
            (0..=i)
                .map(|k| &poly[k] * (choose(i, k) * (all / choose(n, k))))
                .sum()
        })
        .collect()
}

/// The polynomial on both halves, by de Casteljau's algorithm, times a positive number.
fn halves(mut all: Bernstein) -> [Bernstein; 2] {
    let n = all.len() - 1;
    let (mut left, mut right) = (vec![all[0].clone() << n], vec![all[n].clone() << n]);
    for level in 1..=n {
        for k in 0..=n - level {
            all[k] = &all[k] + &all[k + 1];
        }
        left.push(all[0].clone() << (n - level));
        right.push(all[n - level].clone() << (n - level));
    }
    right.reverse();
    [left, right]
}

/// The sign that a polynomial has on the whole interval, as its coefficients show it.
fn definite(poly: &Bernstein) -> Option<Sign> {
    let first = poly[0].sign();
    (first != Sign::NoSign && poly.iter().all(|c| c.sign() == first)).then_some(first)
}

/// The signed number of times at which the insides of two edges cross.
fn crossings(points: &[[Exact; 4]; 2]) -> i64 {
    let way = |from: usize, to: usize| -> Vector {
        [0, 1, 2].map(|h| {
            let at = |time: usize| &points[time][to][h] - &points[time][from][h];
            vec![at(0), at(1) - at(0)]
        })
    };
    let (k, l, m) = (way(0, 1), way(2, 3), way(0, 2));
    let n = cross(&k, &l);
    let f = bernstein(&dot(&n, &m));
    let (all, u, v) = (
        dot(&n, &n),
        dot(&cross(&m, &l), &n),
        dot(&cross(&m, &k), &n),
    );
    let insides = [difference(&all, &u), u, difference(&all, &v), v].map(|poly| bernstein(&poly));
    within(f, insides.to_vec(), 0)
}

/// The sum over the roots of `f` in an interval at which all the others are positive.
fn within(f: Bernstein, insides: Vec<Bernstein>, depth: u32) -> i64 {
    if definite(&f).is_some() || f.iter().all(|c| c.sign() == Sign::NoSign) {
        return 0;
    }
    let signs: Vec<_> = insides.iter().map(definite).collect();
    if signs.contains(&Some(Sign::Minus)) {
        return 0;
    }
    if signs.iter().all(|sign| *sign == Some(Sign::Plus)) {
        let is_above = |c: &BigInt| match c.sign() {
            Sign::NoSign => unreachable!("edges moved by a hair cross where an interval ends"),
            sign => i64::from(sign == Sign::Plus),
        };
        return is_above(&f[f.len() - 1]) - is_above(&f[0]);
    }
    assert!(
        depth < DEEPEST,
        "two edges touch at an end, though moved by a hair"
    );
    let [low, high] = halves(f);
    let (mut lows, mut highs) = (Vec::new(), Vec::new());
    for (inside, sign) in insides.into_iter().zip(signs) {
        if sign.is_none() {
            let [low, high] = halves(inside);
            lows.push(low);
            highs.push(high);
        }
    }
    within(low, lows, depth + 1) + within(high, highs, depth + 1)
}
