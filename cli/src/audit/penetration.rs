//! How far wires stand inside each other.

use serde::{Serialize, Serializer};
use tunnelproof::wire::SegmentId;

use super::segments::{Segment, candidates, four};
use super::thickness::{Bounds, Thickness};

/// How far two wires stand inside each other, as a share of their thickness: 0 where the surfaces
/// touch, 1 where midlines do.
///
/// The thickness is the sum of both radii, or of one wire not more than half a circle of the wire
/// between the two has for its diameter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Penetration {
    /// The step at the end of which they do, from 0.
    pub step: u64,
    /// The share is not below this.
    pub low: f64,
    /// The share is not above this.
    pub high: f64,
    /// The segments, numbered as in the step.
    #[serde(serialize_with = "as_numbers")]
    pub segments: [SegmentId; 2],
}

impl Penetration {
    /// The deeper of two: bounds on the larger share.
    pub(super) fn deeper(self, other: Self) -> Self {
        let deeper = if self.low >= other.low { self } else { other };
        Penetration {
            high: self.high.max(other.high),
            ..deeper
        }
    }
}

fn as_numbers<S: Serializer>(segments: &[SegmentId; 2], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(segments.iter().map(|id| [id.wire.0, id.segment]))
}

/// The largest share at the end of a step; none if no surfaces meet.
pub(super) fn of(step: u64, segments: &[Segment]) -> Option<Penetration> {
    let ended: Vec<Segment> = segments.iter().map(Segment::ended).collect();
    let share = |[a, b]: [usize; 2]| {
        let [a, b] = [&ended[a], &ended[b]];
        let touching = Thickness {
            share: 0.0,
            radii: [a.radius, b.radius],
            stretch: a.stretch(b),
        }
        .touching();
        let bounds = Bounds::new(&four(a.end, b.end));
        (touching > bounds.low).then(|| Penetration {
            step,
            low: (1.0 - (bounds.high / touching).next_up())
                .next_down()
                .max(0.0),
            high: (1.0 - (bounds.low / touching).next_down())
                .next_up()
                .min(1.0),
            segments: [a.id, b.id],
        })
    };
    let pairs = candidates(&ended, 1.0).into_iter();
    pairs.filter_map(share).reduce(Penetration::deeper)
}
