//! Queries and answers as frames of bytes, little-endian, for speed.
//!
//! A frame is a `u32`, the length of what follows in bytes, then that.
//!
//! | query, 224 bytes | | answer, 24 bytes | |
//! | --- | --- | --- | --- |
//! | 0 | `u64` number of the query | 0 | `u64` the same number |
//! | 8 | `u32` kind: 0 edge-edge, 1 vertex-face | 8 | `u32` 0 miss, 1 hit, 2 not supported |
//! | 12 | `u32` 0 | 12 | `u32` 0 |
//! | 16 | `f64` two radii, whose exact sum is meant | 16 | `f64` toi of a hit |
//! | 32 | `f64` A B C D at `t = 0`, then at `t = 1`, each x y z | | |
//!
//! | cast of a box, 272 bytes | |
//! | --- | --- |
//! | 0 | `u64` number of the query |
//! | 8 | `u32` kind: 2 |
//! | 12 | `u16` shape of the first body, `u16` of the second: 0 sphere, 1 edge, 2 triangle, 3 box |
//! | 16 | `f64` the radii of both bodies |
//! | 32 | `f64` of the first body four points at `t = 0` and its translation, each x y z; then of the second |
//!
//! | query of bodies that turn, 264 to 352 bytes | |
//! | --- | --- |
//! | 0 | `u64` number of the query |
//! | 8 | `u32` kind: 3 edge-turning-edge, 4 vertex-turning-face, 5 turning-edge-turning-edge, 6 turning-vertex-turning-face |
//! | 12 | `u32` 0 |
//! | 16 | `f64` two radii, whose exact sum is meant |
//! | 32 | `f64` the fields `points`, `local` and `poses` of the line of JSON |

use std::io::{self, BufRead, Read};

use tunnelproof::query::{Query, QueryKind};
use tunnelproof::rigid::{RigidQuery, RigidQueryKind};

use crate::answer::Enclosure;
use crate::boxes::{BoxCast, Shape};
use crate::corpus::turning::Fields;
use crate::subject::Said;

use super::wire::{Message, Reply};

/// The bytes of a query, without those of the length.
pub const QUERY: usize = 224;
/// The bytes of a cast of a box, without those of the length.
pub const CAST: usize = 272;
/// The bytes of an answer, without those of the length.
pub const ANSWER: usize = 24;

pub(super) fn write(id: u64, query: &Query, bytes: &mut Vec<u8>) {
    let kind: u32 = match query.kind() {
        QueryKind::EdgeEdge => 0,
        QueryKind::VertexFace => 1,
    };
    bytes.extend((QUERY as u32).to_le_bytes());
    bytes.extend(id.to_le_bytes());
    bytes.extend(kind.to_le_bytes());
    bytes.extend(0u32.to_le_bytes());
    let points = query.start().iter().chain(query.end());
    let coordinates = points.flat_map(|point| <[f64; 3]>::from(*point));
    let numbers = query.radius().parts().into_iter().chain(coordinates);
    bytes.extend(numbers.flat_map(f64::to_le_bytes));
}

pub(super) fn write_rigid(id: u64, query: &RigidQuery, bytes: &mut Vec<u8>) {
    let kind: u32 = match query.kind() {
        RigidQueryKind::EdgeTurningEdge => 3,
        RigidQueryKind::VertexTurningFace => 4,
        RigidQueryKind::TurningEdgeTurningEdge => 5,
        RigidQueryKind::TurningVertexTurningFace => 6,
    };
    let fields = Fields::of(query);
    let points = fields.points.iter().chain(&fields.local).flatten();
    let radii = query.radius().parts();
    let numbers = radii
        .iter()
        .chain(points)
        .chain(fields.poses.iter().flatten());
    let numbers: Vec<u8> = numbers.copied().flat_map(f64::to_le_bytes).collect();
    bytes.extend((16 + numbers.len() as u32).to_le_bytes());
    bytes.extend(id.to_le_bytes());
    bytes.extend(kind.to_le_bytes());
    bytes.extend(0u32.to_le_bytes());
    bytes.extend(numbers);
}

/// The frame of a cast of a box with this number.
pub fn of_cast(id: u64, cast: &BoxCast) -> Vec<u8> {
    let mut bytes = (CAST as u32).to_le_bytes().to_vec();
    bytes.extend(id.to_le_bytes());
    bytes.extend(2u32.to_le_bytes());
    for body in cast.bodies() {
        let shape = Shape::ALL.iter().position(|shape| *shape == body.shape());
        bytes.extend((shape.unwrap_or_default() as u16).to_le_bytes());
    }
    let radii = cast.bodies().iter().map(|body| body.radius());
    let numbers = radii.chain(cast.bodies().iter().flat_map(|body| {
        let points = body.points().into_iter().map(<[f64; 3]>::from);
        points.chain([body.step().into()]).flatten()
    }));
    bytes.extend(numbers.flat_map(f64::to_le_bytes));
    bytes
}

/// What follows the next length. The start of it, if it is cut off or has another length than an
/// answer.
pub(super) fn read(reader: &mut impl BufRead) -> io::Result<Option<Vec<u8>>> {
    let mut length = Vec::new();
    reader.by_ref().take(4).read_to_end(&mut length)?;
    let Ok(bytes) = <[u8; 4]>::try_from(length.as_slice()) else {
        return Ok((!length.is_empty()).then_some(length));
    };
    let length = u32::from_le_bytes(bytes) as usize;
    if length != ANSWER {
        return Ok(Some(bytes.to_vec()));
    }
    let mut frame = Vec::with_capacity(ANSWER);
    reader
        .by_ref()
        .take(ANSWER as u64)
        .read_to_end(&mut frame)?;
    Ok(Some(frame))
}

/// What a frame says, or what is wrong with it.
pub(super) fn parse(frame: &[u8]) -> Result<Message, String> {
    let Ok(frame) = <[u8; ANSWER]>::try_from(frame) else {
        return Err(format!(
            "not a frame of {ANSWER} bytes: starts with {:02x?}",
            &frame[..frame.len().min(8)]
        ));
    };
    let [id, verdict, toi] = [0, 8, 16].map(|at| word(&frame, at));
    let reply = match verdict {
        0 => Reply::Said(Said::default()),
        1 => Reply::Said(Said {
            toi: Some(Enclosure::exactly(f64::from_bits(toi))),
            case: None,
        }),
        2 => Reply::Unsupported,
        other => {
            // A C `int`, unless the four bytes after it are not 0.
            let verdict = u32::try_from(other).map(u32::cast_signed);
            let verdict = verdict.map_or(other.to_string(), |verdict| verdict.to_string());
            return Err(format!("the verdict is {verdict}, not 0, 1 or 2"));
        }
    };
    let id = Some(id);
    Ok(Message { id, reply })
}

/// The eight bytes from here. Those of a verdict are its four and the four that are 0.
fn word(frame: &[u8; ANSWER], at: usize) -> u64 {
    let bytes = &frame[at..at + 8];
    bytes
        .iter()
        .rev()
        .fold(0, |word, byte| word << 8 | u64::from(*byte))
}
