//! STL: triangles without shared vertices, in `f32`.

use std::collections::HashMap;
use std::io::Cursor;

use super::compare::differs;
use super::error::{MeshFileError, Problem};
use super::{Parts, Position, bytes};

/// How long the header of a binary file is.
const HEADER: usize = 80;

/// How long a binary file of no triangles is, and how much longer it is with each.
const LENGTHS: [usize; 2] = [HEADER + 4, 50];

/// Reads both files. Corners that are at the same place at the start become one vertex.
///
/// # Errors
///
/// [`MeshFileError`] if a file is no STL, if the two have different numbers of triangles, or if
/// corners part that are together at the start.
pub(super) fn read_both(start: &str, end: &str) -> Result<[Parts; 2], MeshFileError> {
    let corners = |path: &str| {
        let bytes = bytes(path)?;
        corners(bytes).map_err(|problem| MeshFileError::new(path, problem))
    };
    let (first, last) = (corners(start)?, corners(end)?);
    join(&first, &last).map_err(|difference| {
        let start = start.to_owned();
        MeshFileError::new(end, Problem::Differs { difference, start })
    })
}

/// The corners of all triangles, one after the other.
fn corners(bytes: Vec<u8>) -> Result<Vec<Position>, Problem> {
    let malformed = |error: std::io::Error| {
        let what = error.to_string();
        Problem::Malformed(match what.starts_with("expected finite") {
            true => "holds a coordinate that is not a finite number".to_owned(),
            false => format!("is no STL: {what}"),
        })
    };
    let (text, facets) = prepared(bytes)?;
    let mut reader = Cursor::new(text);
    let triangles = stl_io::create_stl_reader(&mut reader).map_err(malformed)?;
    let mut corners = Vec::new();
    for triangle in triangles {
        let vertices = triangle.map_err(malformed)?.vertices;
        corners.extend(vertices.map(|vertex| vertex.0.map(f64::from)));
    }
    if facets.is_some_and(|facets| facets != corners.len() / 3) {
        let what = "holds several solids; join them to one";
        return Err(Problem::Malformed(what.to_owned()));
    }
    Ok(corners)
}

/// The file with a header that says what it is, and how many facets a text has. Many binary files
/// start with the word `solid`, as all text does, and some text has no name after it.
fn prepared(mut bytes: Vec<u8>) -> Result<(Vec<u8>, Option<usize>), Problem> {
    let [empty, triangle] = LENGTHS;
    let count = bytes.get(HEADER..empty).map(|count| {
        let count = count.iter().rev();
        count.fold(0, |all, &byte| all << 8 | usize::from(byte))
    });
    if count.is_some_and(|count| bytes.len() == empty + triangle * count) {
        bytes[..HEADER].fill(0);
        return Ok((bytes, None));
    }
    let Some(text) = bytes.trim_ascii_start().strip_prefix(b"solid") else {
        let what = "is no STL: neither text, nor as long as its number of triangles says";
        return Err(Problem::Malformed(what.to_owned()));
    };
    let body = text.iter().position(|&byte| byte == b'\n');
    let body = &text[body.unwrap_or(text.len())..];
    let lines = body.split(|&byte| byte == b'\n');
    let facets = lines.filter(|line| line.trim_ascii_start().starts_with(b"facet"));
    let facets = facets.count();
    Ok(([b"solid ", body].concat(), Some(facets)))
}

/// The two meshes, with the vertices in the order in which the corners of the start have them.
fn join(start: &[Position], end: &[Position]) -> Result<[Parts; 2], String> {
    if start.len() != end.len() {
        let [expected, found] = [start, end].map(|corners| corners.len() / 3);
        return Err(differs("triangle", found, expected));
    }
    // Equal numbers have equal bits but for the sign of 0.
    let bits = |position: &Position| position.map(|x| (x + 0.0).to_bits());
    let mut known = HashMap::new();
    let mut both = [Parts::default(), Parts::default()];
    let mut indices = Vec::with_capacity(start.len());
    for (corner, (from, to)) in start.iter().zip(end).enumerate() {
        let [first, last] = &mut both;
        let index = *known.entry(bits(from)).or_insert_with(|| {
            first.vertices.push(*from);
            last.vertices.push(*to);
            first.vertices.len() - 1
        });
        if bits(&last.vertices[index]) != bits(to) {
            return Err(format!(
                "corner {} of triangle {} parts from a corner that is at the same place at the start",
                corner % 3,
                corner / 3
            ));
        }
        indices.push(index as u32);
    }
    for parts in &mut both {
        parts.faces = indices.as_chunks().0.to_vec();
    }
    Ok(both)
}
