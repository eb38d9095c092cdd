//! Why a model is refused.

use std::fmt;

/// What is wrong with a model: which field, its value, and what is accepted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ModelError {
    /// A number out of its range.
    Value {
        /// The name of the field.
        field: &'static str,
        /// The value refused.
        value: f64,
        /// What is accepted instead.
        accepted: &'static str,
    },
    /// A body that is not there.
    Body {
        /// The index asked for.
        index: usize,
        /// How many bodies there are.
        count: usize,
    },
    /// A wire that is not there.
    Wire {
        /// The index asked for.
        index: usize,
        /// How many wires there are.
        count: usize,
    },
    /// Two neighbouring stops of a route at one place.
    ZeroLength {
        /// The first of the two stops, from 0.
        stop: usize,
    },
    /// A route with fewer than two stops.
    ShortRoute {
        /// How many it has.
        stops: usize,
    },
    /// A route that starts or ends in a contact node, which has a wire on both sides.
    ContactAtEnd {
        /// The stop, from 0.
        stop: usize,
    },
    /// A dynamic body of a shape that has no mass.
    Massless {
        /// The name of the shape.
        shape: &'static str,
    },
    /// A corner of a triangle that is not among the vertices.
    Vertex {
        /// The triangle, from 0.
        triangle: usize,
        /// The index asked for.
        index: usize,
        /// How many vertices there are.
        count: usize,
    },
    /// A mesh with an edge that does not belong to exactly two triangles, once in each direction.
    OpenMesh {
        /// The edge, by its vertices.
        edge: [usize; 2],
    },
    /// Phases of a kinematic body that do not follow each other in time.
    PhaseOrder {
        /// The phase that does not start after the one before, from 0.
        phase: usize,
        /// When it and the one before it start, in s.
        from: [f64; 2],
    },
    /// Phases of a reel that do not follow each other in time.
    ReelOrder {
        /// The phase that does not start after the one before, from 0.
        phase: usize,
        /// When it and the one before it start, in s.
        from: [f64; 2],
    },
    /// A reel at an end that is free.
    ReelAtFreeEnd,
    /// A reel at an end that is clamped.
    ReelAtClamp,
}

impl ModelError {
    pub(in crate::wire) fn value(field: &'static str, value: f64, accepted: &'static str) -> Self {
        ModelError::Value {
            field,
            value,
            accepted,
        }
    }
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ModelError::Value {
                field,
                value,
                accepted,
            } => write!(f, "{field} is {}, it must be {accepted}", Short(*value)),
            ModelError::Body { index, count } => {
                write!(
                    f,
                    "there is no body {index}: bodies are 0 to {count} (excluded)"
                )
            }
            ModelError::Wire { index, count } => {
                write!(
                    f,
                    "there is no wire {index}: wires are 0 to {count} (excluded)"
                )
            }
            ModelError::ZeroLength { stop } => write!(
                f,
                "stops {stop} and {} of the route are at the same place, their distance must be \
                above 0",
                stop + 1
            ),
            ModelError::ShortRoute { stops } => {
                let noun = if *stops == 1 { "stop" } else { "stops" };
                write!(f, "the route has {stops} {noun}, it must have at least 2")
            }
            ModelError::ContactAtEnd { stop } => write!(
                f,
                "stop {stop} is a contact node at an end of the route, where only fixed points, \
                eyes and free nodes may be"
            ),
            ModelError::Massless { shape } => write!(
                f,
                "a {shape} has no mass, a body of this shape must be static or kinematic"
            ),
            ModelError::Vertex {
                triangle,
                index,
                count,
            } => write!(
                f,
                "triangle {triangle} has corner {index}: vertices are 0 to {count} (excluded)"
            ),
            ModelError::OpenMesh { edge: [a, b] } => write!(
                f,
                "the mesh is not closed: edge {a} to {b} must be in exactly two triangles, once \
                in each direction"
            ),
            ModelError::PhaseOrder { phase, from } => order(f, "kinematic body", *phase, *from),
            ModelError::ReelOrder { phase, from } => order(f, "reel", *phase, *from),
            ModelError::ReelAtFreeEnd => {
                f.write_str("the wire ends free, a reel must be at a fixed point or an eye")
            }
            ModelError::ReelAtClamp => f.write_str(
                "the last two nodes are fixed to the same thing, which clamps the wire: a reel must \
                be at an end that is not clamped",
            ),
        }
    }
}

/// Of phases, counted from 1 as people do.
fn order(f: &mut fmt::Formatter<'_>, of: &str, phase: usize, from: [f64; 2]) -> fmt::Result {
    let [from, before] = from.map(Short);
    write!(
        f,
        "phase {} of the {of} starts at {from} s, it must start after phase {phase}, which starts at \
        {before} s",
        phase + 1
    )
}

impl std::error::Error for ModelError {}

/// A number with its exponent where that is shorter, so that `1e308` is not 309 digits.
struct Short(f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = self;
        match value.abs() {
            1e-5..1e16 | 0.0 => write!(f, "{value}"),
            _ => write!(f, "{value:e}"),
        }
    }
}
