//! Points that move on straight lines, as position and velocity.

use std::ops::Sub;

use nalgebra::Vector3;

use crate::query::EdgeEdge;

/// A point or vector that changes linearly with time, `p + v t` (thesis equations 2.8 and 3.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// The value at `t = 0`, in metres.
    pub p: Vector3<f64>,
    /// The change during the step, in metres.
    pub v: Vector3<f64>,
}

impl Motion {
    /// The value at time `t`.
    pub fn at(&self, t: f64) -> Vector3<f64> {
        self.p + self.v * t
    }

    /// The motions of A, B, C and D, which the thesis stores as `P0` to `P3` and `V0` to `V3`.
    ///
    /// `V = end - start` rounds, so `at(1.0)` need not be the end position of the query.
    pub fn of_query(query: &EdgeEdge) -> [Motion; 4] {
        std::array::from_fn(|point| {
            let p = query.start()[point].coords;
            let v = query.end()[point].coords - p;
            Motion { p, v }
        })
    }
}

impl Sub for Motion {
    type Output = Motion;

    /// The motion of one point as seen from another.
    fn sub(self, other: Motion) -> Motion {
        Motion {
            p: self.p - other.p,
            v: self.v - other.v,
        }
    }
}

#[cfg(test)]
pub(super) mod testing {
    use super::*;

    /// A point at `p` at the start that moves by `v`.
    pub(in crate::thesis) fn moving(p: [f64; 3], v: [f64; 3]) -> Motion {
        Motion {
            p: p.into(),
            v: v.into(),
        }
    }

    /// A point that does not move.
    pub(in crate::thesis) fn still(p: [f64; 3]) -> Motion {
        moving(p, [0.0; 3])
    }
}
