//! The kinds of queries, without their points.

use std::fmt;

use crate::query::QueryKind;

/// The kind of a query of bodies that turn, without its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RigidQueryKind {
    /// Edge against an edge of a turning body; written `edge-turning-edge`.
    EdgeTurningEdge,
    /// Vertex against a face of a turning body; written `vertex-turning-face`.
    VertexTurningFace,
    /// Edge of a turning body against an edge of another one; written `turning-edge-turning-edge`.
    TurningEdgeTurningEdge,
    /// Vertex of a turning body against a face of another one; written
    /// `turning-vertex-turning-face`.
    TurningVertexTurningFace,
}

/// How long the lists are that files and arrays keep a query in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lengths {
    /// Points in space: those of the first side at `t = 0`, then at `t = 1`; none of a body.
    pub points: usize,
    /// Points in the frames of bodies: those of the first side, if it turns, then of the second.
    pub local: usize,
    /// Poses: two of each body, the first side's before the second side's.
    pub poses: usize,
}

impl RigidQueryKind {
    /// Every kind.
    pub const ALL: [Self; 4] = [
        RigidQueryKind::EdgeTurningEdge,
        RigidQueryKind::VertexTurningFace,
        RigidQueryKind::TurningEdgeTurningEdge,
        RigidQueryKind::TurningVertexTurningFace,
    ];

    /// The name used in files and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            RigidQueryKind::EdgeTurningEdge => "edge-turning-edge",
            RigidQueryKind::VertexTurningFace => "vertex-turning-face",
            RigidQueryKind::TurningEdgeTurningEdge => "turning-edge-turning-edge",
            RigidQueryKind::TurningVertexTurningFace => "turning-vertex-turning-face",
        }
    }

    /// The kind with this [`name`](Self::name), if any.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }

    /// The kind of the linear query of such sides: two edges, or a vertex and a face.
    pub fn linear(self) -> QueryKind {
        match self {
            RigidQueryKind::EdgeTurningEdge | RigidQueryKind::TurningEdgeTurningEdge => {
                QueryKind::EdgeEdge
            }
            RigidQueryKind::VertexTurningFace | RigidQueryKind::TurningVertexTurningFace => {
                QueryKind::VertexFace
            }
        }
    }

    /// How many points the first side has.
    pub(super) fn first(self) -> usize {
        match self.linear() {
            QueryKind::EdgeEdge => 2,
            QueryKind::VertexFace => 1,
        }
    }

    /// How long the lists of [`RigidQuery::from_lists`](super::RigidQuery::from_lists) are.
    pub fn lengths(self) -> Lengths {
        let (points, local, poses) = match self {
            RigidQueryKind::EdgeTurningEdge => (4, 2, 2),
            RigidQueryKind::VertexTurningFace => (2, 3, 2),
            RigidQueryKind::TurningEdgeTurningEdge => (0, 4, 4),
            RigidQueryKind::TurningVertexTurningFace => (0, 4, 4),
        };
        Lengths {
            points,
            local,
            poses,
        }
    }
}

impl fmt::Display for RigidQueryKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
