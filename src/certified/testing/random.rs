//! A small seeded generator, and numbers as tests of floating point want them.

/// SplitMix64 (Steele, Lea and Flood 2014, "Fast splittable pseudorandom number generators").
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Random(seed)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    pub(crate) fn below(&mut self, bound: u64) -> u64 {
        self.bits() % bound
    }

    pub(crate) fn coin(&mut self) -> bool {
        self.bits() >> 63 != 0
    }

    /// From -1 to 1.
    pub(crate) fn signed(&mut self) -> f64 {
        (self.bits() as i64) as f64 * 2f64.powi(-63)
    }

    /// From 0 to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        self.signed().abs()
    }

    /// A whole number from `low` to `high`, an end as often as every fourth time.
    pub(crate) fn whole(&mut self, low: i32, high: i32) -> i32 {
        match self.below(8) {
            0 => low,
            1 => high,
            _ => low + self.below((high - low + 1) as u64) as i32,
        }
    }

    /// A number of few bits.
    pub(crate) fn small(&mut self) -> f64 {
        f64::from(self.whole(-4, 4)) * 2f64.powi(self.whole(-2, 2))
    }

    /// Another number a few units in the last place away.
    pub(crate) fn nudged(&mut self, value: f64) -> f64 {
        let mut value = value;
        for _ in 0..=self.below(3) {
            value = if self.coin() {
                value.next_up()
            } else {
                value.next_down()
            };
        }
        value
    }

    /// Changes one of the numbers, in its bits or by those of another.
    pub(crate) fn change(&mut self, values: &mut [f64]) {
        let count = values.len() as u64;
        let (i, other) = (self.below(count) as usize, self.below(count) as usize);
        let (old, other) = (values[i], values[other]);
        let new = match self.below(12) {
            0..4 => f64::from_bits(old.to_bits() ^ 1 << self.below(52)),
            4 => f64::from_bits(old.to_bits() ^ (self.bits() >> (12 + self.below(52)))),
            5 => self.nudged(old),
            6 => self.nudged(other),
            7 => {
                if self.coin() {
                    other
                } else {
                    -other
                }
            }
            8 => {
                if self.coin() {
                    2.0 * old
                } else {
                    0.5 * old
                }
            }
            9 => old * 2f64.powi(self.whole(-60, 60)),
            // Few bits are left.
            10 => f64::from_bits(old.to_bits() >> 40 << 40),
            _ => -old,
        };
        if new.is_finite() {
            values[i] = new;
        }
    }
}
