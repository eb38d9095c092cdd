//! Random queries with coordinates of a few small integers, which meet every degeneracy exactly.

use super::Points;

/// SplitMix64 (Steele, Lea and Flood 2014).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// An integer of `low ..= high`.
    pub(super) fn within(&mut self, low: i64, high: i64) -> i64 {
        low + (self.next() % (high - low + 1).unsigned_abs()) as i64
    }

    fn point(&mut self) -> [i64; 3] {
        [0; 3].map(|_| self.within(-2, 2))
    }
}

/// A query whose motion is free, or confined to a plane, to a line or to a moving line, or whose
/// edges stay parallel, with some points repeated.
pub(super) fn lattice_query(random: &mut Random) -> Points {
    let mut points = [[0; 3]; 8].map(|_| random.point());
    match random.next() % 6 {
        0 | 1 => {}
        2 => confine_to_plane(random, &mut points),
        3 => confine_to_line(random, &mut points),
        4 => make_parallel(random, &mut points),
        _ => confine_to_coordinate_plane(random, &mut points),
    }
    for _ in 0..random.next() % 4 {
        repeat_a_point(random, &mut points);
    }
    points
}

fn confine_to_coordinate_plane(random: &mut Random, points: &mut Points) {
    let axis = (random.next() % 3) as usize;
    for point in points {
        point[axis] = 0;
    }
}

fn confine_to_plane(random: &mut Random, points: &mut Points) {
    let (e, f) = (random.point(), random.point());
    for point in points {
        let [a, b, _] = *point;
        *point = [0, 1, 2].map(|i| a * e[i] + b * f[i]);
    }
}

/// To one line at the start and, every other time, another one at the end.
fn confine_to_line(random: &mut Random, points: &mut Points) {
    let start = (random.point(), random.point());
    let end = if random.next() & 1 == 0 {
        start
    } else {
        (random.point(), random.point())
    };
    for (index, point) in points.iter_mut().enumerate() {
        let (origin, direction) = if index < 4 { start } else { end };
        let a = point[0];
        *point = [0, 1, 2].map(|i| origin[i] + a * direction[i]);
    }
}

/// `D - C` becomes a multiple of `B - A`, or both multiples of one direction.
fn make_parallel(random: &mut Random, points: &mut Points) {
    let fixed = random.point();
    let is_fixed = random.next() & 1 == 0;
    let factor = random.within(-2, 2);
    for start in [0, 4] {
        if is_fixed {
            let a = random.within(-2, 2);
            points[start + 1] = [0, 1, 2].map(|i| points[start][i] + a * fixed[i]);
        }
        let along = [0, 1, 2].map(|i| points[start + 1][i] - points[start][i]);
        let (along, factor) = if is_fixed {
            (fixed, random.within(-2, 2))
        } else {
            (along, factor)
        };
        points[start + 3] = [0, 1, 2].map(|i| points[start + 2][i] + factor * along[i]);
    }
}

/// A position becomes that of another point: at the start, at the end, or both.
fn repeat_a_point(random: &mut Random, points: &mut Points) {
    let mut point = || (random.next() % 4) as usize;
    let (from, to) = (point(), point());
    match random.next() % 3 {
        0 => points[to] = points[from],
        1 => points[4 + to] = points[4 + from],
        _ => {
            points[to] = points[from];
            points[4 + to] = points[4 + from];
        }
    }
}
