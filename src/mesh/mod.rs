//! Whole meshes: the first contact of a step, all contacts, and the largest step without any.
//!
//! A [`Mesh`] is vertices, edges and faces by their indices. It may have any of them: cloth and
//! bodies have faces, wires and hair have edges without faces, and a vertex in no edge is a point.
//! Positions are given with each question, at the start of the step and at its end.
//!
//! ```
//! use tunnelproof::mesh::{Feature, Mesh};
//!
//! // A triangle, and the vertex 3 that falls through it.
//! let mesh = Mesh::new(4, &[], &[[0, 1, 2]])?;
//! let start = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.25, 0.25, 1.0]];
//! let mut end = start;
//! end[3][2] = -1.0;
//!
//! let contact = mesh.first_contact(&start, &end, 0.0)?.expect("it falls through");
//! assert_eq!(contact.toi, 0.5);
//! assert_eq!(contact.pair.first, Feature::Vertex(3));
//! assert_eq!(contact.pair.second, Feature::Face(0));
//!
//! // The positions to store: nothing has touched, and nothing does at them.
//! let step = mesh.step(&start, &end, 0.0)?;
//! assert!(step.positions[3][2] > 0.0 && step.positions[3][2] < 1e-9);
//! assert!(mesh.is_free(&start, &step.positions, 0.0)?);
//! # Ok::<(), tunnelproof::mesh::MeshError>(())
//! ```
//!
//! # What is asked of which pairs
//!
//! Every edge against every edge, and every vertex against every face. The edges of faces are edges,
//! whether they are given or not. A vertex in no edge counts as an edge between itself and itself,
//! so that points and wires meet, too. Two parts that share a vertex are never a pair. Others are
//! left out if their groups are ([`Mesh::leave_out`]): static parts, for instance, against
//! themselves.
//!
//! A tree of boxes (`tree`) finds the pairs whose swept boxes come within the thickness. It is
//! built anew for each question; nothing rests on what it was. The [certified
//! path](crate::certified) decides each pair. With the feature `rayon` both use all threads of the
//! current pool, and give the same answers, in the same order, on any number of them.

mod candidates;
mod chunk;
mod contacts;
mod error;
mod step;
mod topology;
mod tree;

pub use contacts::MeshContact;
pub use error::MeshError;
pub use step::{MeshLimit, MeshStep};
pub use topology::{Feature, Mesh, Pair, Thickness};
