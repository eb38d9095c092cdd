//! Vertices and faces of a simulation.

use tunnelproof::certified;
use tunnelproof::query::{Point, VertexFace};

use crate::data::boxes::{bounds, overlap};

#[path = "sheet.rs"]
mod sheet;

/// Vertices of the sheet on each side.
const SIDE: u32 = 50;

/// How many of its steps are one here, so that some touch.
const STEPS: f64 = 8.0;

/// Vertices and faces of a rolled-up sheet whose boxes overlap, those of them that touch, and the first with a radius of a twentieth of
/// the spacing of vertices.
pub(crate) fn of_a_sheet() -> [(&'static str, Vec<VertexFace>); 3] {
    let (mesh, start, end) = sheet::rolled_sheet(SIDE);
    let at = |all: &[sheet::Position], i: u32| Point::from(all[i as usize]);
    let end_of = |i: u32| at(&start, i) + (at(&end, i) - at(&start, i)) * STEPS;
    let swept = |indices: &[u32]| {
        let ends = indices.iter().flat_map(|&i| [at(&start, i), end_of(i)]);
        bounds(ends, 0.0)
    };
    let faces = mesh.faces().iter().map(|face| (face, swept(face)));
    let faces: Vec<_> = faces.collect();
    let mut candidates = Vec::new();
    for vertex in 0..start.len() as u32 {
        let own = swept(&[vertex]);
        for (face, of_face) in &faces {
            if overlap(&own, of_face) && !face.contains(&vertex) {
                let corners = [vertex, face[0], face[1], face[2]];
                let from = corners.map(|i| at(&start, i));
                candidates.push(query(from, corners.map(end_of), 0.0));
            }
        }
    }
    let touch = candidates
        .iter()
        .filter(|of| certified::decide(*of).is_some());
    let touch: Vec<_> = touch.copied().collect();
    println!("\nsheet: {} of {} touch", touch.len(), candidates.len());
    let radius = 1.0 / f64::from(20 * SIDE);
    let with_radius = |of: &VertexFace| query(*of.start(), *of.end(), radius);
    let thick = candidates.iter().map(with_radius).collect();
    [
        ("sheet-candidates", candidates),
        ("sheet-hits", touch),
        ("sheet-candidates-thick", thick),
    ]
}

fn query(start: [Point; 4], end: [Point; 4], radius: f64) -> VertexFace {
    VertexFace::new(start, end, radius).expect("finite")
}
