//! Parts of a set of queries that are judged apart and put together again.

use std::fmt;
use std::num::NonZeroU64;
use std::str::FromStr;

/// One of several parts of equal size: of every so many groups of queries one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Which part, from 0.
    index: u64,
    /// How many parts.
    of: NonZeroU64,
}

impl Shard {
    /// The only part.
    pub const WHOLE: Shard = Shard {
        index: 0,
        of: NonZeroU64::MIN,
    };

    /// Which part, from 0.
    pub fn index(self) -> u64 {
        self.index
    }

    /// How many parts there are.
    pub fn of(self) -> u64 {
        self.of.get()
    }

    /// Whether it is the only part.
    pub fn is_whole(self) -> bool {
        self == Shard::WHOLE
    }

    /// Whether the group of this number, from 0, is in this part.
    pub fn has(self, group: u64) -> bool {
        group % self.of == self.index
    }
}

/// A text names no part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("not of the form I/N, with I from 1 to N")]
pub struct ShardError;

impl FromStr for Shard {
    type Err = ShardError;

    /// Reads `I/N`, with `I` from 1 to `N`.
    fn from_str(text: &str) -> Result<Self, ShardError> {
        let (number, of) = text.split_once('/').ok_or(ShardError)?;
        let number: u64 = number.parse().map_err(|_| ShardError)?;
        let of: NonZeroU64 = of.parse().map_err(|_| ShardError)?;
        match number.checked_sub(1) {
            Some(index) if index < of.get() => Ok(Shard { index, of }),
            _ => Err(ShardError),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index + 1, self.of)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_have_each_group_once() {
        for of in 1..6 {
            let shards = (1..=of).map(|i| format!("{i}/{of}").parse::<Shard>().unwrap());
            let shards: Vec<_> = shards.collect();
            for group in 0..20 {
                assert_eq!(shards.iter().filter(|shard| shard.has(group)).count(), 1);
            }
        }
        assert!("1/1".parse::<Shard>().unwrap().is_whole());
    }

    #[test]
    fn shard_that_is_none_is_refused() {
        for text in ["", "1", "0/2", "3/2", "1/0", "a/2", "1/2/3", "-1/2"] {
            assert_eq!(text.parse::<Shard>(), Err(ShardError), "{text}");
        }
    }
}
