//! Whether two files are of the same mesh.

use super::Parts;

/// # Errors
///
/// The first thing in which the second differs from the first, but for positions.
pub(super) fn same(start: &Parts, end: &Parts) -> Result<(), String> {
    let counts = [
        ("vertex", start.vertices.len(), end.vertices.len()),
        ("edge", start.edges.len(), end.edges.len()),
        ("triangle", start.faces.len(), end.faces.len()),
    ];
    for (what, expected, found) in counts {
        if found != expected {
            return Err(differs(what, found, expected));
        }
    }
    same_indices("edge", &start.edges, &end.edges)?;
    same_indices("triangle", &start.faces, &end.faces)
}

/// That the second has another number of something.
pub(super) fn differs(what: &str, found: usize, expected: usize) -> String {
    let what = match (found, what) {
        (1, one) => one,
        (_, "vertex") => "vertices",
        (_, "edge") => "edges",
        _ => "triangles",
    };
    format!("has {found} {what}, not {expected}")
}

fn same_indices<const N: usize>(
    what: &str,
    start: &[[u32; N]],
    end: &[[u32; N]],
) -> Result<(), String> {
    let mut both = start.iter().zip(end).enumerate();
    match both.find(|(_, (expected, found))| expected != found) {
        Some((index, (expected, found))) => Err(format!(
            "{what} {index} has the vertices {found:?}, not {expected:?}"
        )),
        None => Ok(()),
    }
}
