//! What the broad phase refuses.

use std::fmt;

use super::item_id::ItemId;

/// Why something is no box, no moving segment or no item.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum BroadError {
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Which of the points, from 0.
        point: usize,
        /// Whether it is the position at the end of the step or at its start.
        at_end: bool,
        /// Which coordinate, 0 to 2 for x to z.
        axis: usize,
        /// The value refused.
        value: f64,
    },
    /// A radius is NaN, infinite or negative.
    Radius(f64),
    /// There is no point to put a box around.
    NoPoints,
    /// The bounds of a box are NaN, or the lower one is above the upper one.
    Bounds {
        /// Which coordinate, 0 to 2 for x to z.
        axis: usize,
        /// The lower bound refused.
        low: f64,
        /// The upper bound refused.
        high: f64,
    },
    /// The item is not in this broad phase: removed, or of another one.
    UnknownItem(ItemId),
}

const AXES: [char; 3] = ['x', 'y', 'z'];

impl fmt::Display for BroadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            BroadError::NotFinite {
                point,
                at_end,
                axis,
                value,
            } => {
                let (axis, time) = (AXES[axis], u8::from(at_end));
                write!(
                    f,
                    "{axis} of point {point} at t = {time} is {value}, not a finite number"
                )
            }
            BroadError::Radius(value) => {
                write!(
                    f,
                    "the radius is {value}; it has to be finite, and 0 or more"
                )
            }
            BroadError::NoPoints => f.write_str("a box needs at least one point"),
            BroadError::Bounds { axis, low, high } => {
                let axis = AXES[axis];
                write!(f, "{axis} of a box is from {low} to {high}, not a range")
            }
            BroadError::UnknownItem(item) => {
                write!(f, "item {} is not in the broad phase", item.index())
            }
        }
    }
}

impl std::error::Error for BroadError {}
