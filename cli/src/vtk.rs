//! A run for ParaView: a file of polygons (`.vtp`) for each step, and a `.pvd` that puts them on a
//! clock.
//!
//! A `.vtp` has every segment as a line, with its tension in N, its radius in m and its wire, and
//! every contact as a point with the force on its place A in N. The formats are those of VTK's XML,
//! in text.

use std::fmt::Write as _;

use tunnelproof::query::Point;
use tunnelproof::wire::StepRecord;

use crate::replay::place;

/// The steps of a run on their clock: the text of the `.pvd`, of files named by [`file`](fn@file).
pub fn collection(times: &[(u64, f64)]) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n",
    );
    for (step, time) in times {
        let name = file(*step);
        text += &format!("<DataSet timestep=\"{time}\" part=\"0\" file=\"{name}\"/>\n");
    }
    text + "</Collection>\n</VTKFile>\n"
}

/// The name of the file of a step.
pub fn file(step: u64) -> String {
    format!("step-{step:06}.vtp")
}

/// The wires and contacts after a step: the text of a `.vtp`.
pub fn polygons(record: &StepRecord, radii: &[f64]) -> String {
    let mut points: Vec<Point> = Vec::new();
    let mut lines = Vec::new();
    let (mut tensions, mut thickness, mut wires) = (Vec::new(), Vec::new(), Vec::new());
    for (w, wire) in record.wires.iter().enumerate() {
        let first = points.len();
        points.extend(&wire.after);
        for (segment, tension) in wire.tensions.iter().enumerate() {
            lines.extend([first + segment, first + segment + 1]);
            tensions.push(*tension);
            thickness.push(radii.get(w).copied().unwrap_or(0.0));
            wires.push(w);
        }
    }
    let mut vertices = Vec::new();
    let mut forces = Vec::new();
    for contact in &record.contacts {
        let at = place(record, &contact.contact.a).or_else(|| place(record, &contact.contact.b));
        if let Some(at) = at {
            vertices.push(points.len());
            points.push(at);
            forces.extend(contact.force.iter().copied());
        }
    }
    let (segments, contacts) = (wires.len(), vertices.len());
    // Cell data are of vertices first, then of lines.
    let padded = |of: Vec<f64>| [vec![0.0; contacts], of].concat();
    let forces = [forces, vec![0.0; 3 * segments]].concat();
    let wires = [
        vec![-1; contacts],
        wires.iter().map(|w| *w as i64).collect(),
    ]
    .concat();
    let coordinates = points.iter().flat_map(|point| [point.x, point.y, point.z]);
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\">\n<PolyData>\n<Piece \
         NumberOfPoints=\"{}\" NumberOfVerts=\"{contacts}\" NumberOfLines=\"{segments}\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"0\">\n",
        points.len()
    );
    text += "<Points>\n";
    array(&mut text, "Float64", "points", 3, coordinates);
    text += "</Points>\n<Verts>\n";
    cells(&mut text, &vertices, 1);
    text += "</Verts>\n<Lines>\n";
    cells(&mut text, &lines, 2);
    text += "</Lines>\n<CellData Scalars=\"tension\">\n";
    array(&mut text, "Float64", "tension", 1, padded(tensions));
    array(&mut text, "Float64", "radius", 1, padded(thickness));
    array(&mut text, "Int64", "wire", 1, wires);
    array(&mut text, "Float64", "force", 3, forces);
    text + "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n"
}

/// Cells of so many points each.
fn cells(text: &mut String, points: &[usize], each: usize) {
    let offsets = (1..=points.len() / each).map(|cell| cell * each);
    array(text, "Int64", "connectivity", 1, points);
    array(text, "Int64", "offsets", 1, offsets);
}

fn array<T: std::fmt::Display>(
    text: &mut String,
    kind: &str,
    name: &str,
    components: usize,
    values: impl IntoIterator<Item = T>,
) {
    // Writing to a string does not fail.
    let _ = writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
    );
    for value in values {
        let _ = write!(text, "{value} ");
    }
    *text += "\n</DataArray>\n";
}

#[cfg(test)]
mod tests {
    use crate::scenes::Scene;
    use tunnelproof::wire::Collisions;

    use super::*;

    #[test]
    fn vtk_files_are_xml_with_as_many_values_as_they_say() {
        let scene = Scene::embedded("basic-collision").unwrap();
        let mut world = scene.world().unwrap();
        let mut collisions = Collisions::default();
        let mut record = world.step_colliding(&mut collisions, &[]).unwrap();
        record.wires[1].tensions[3] = 123.5;
        let contacts = record.contacts.len();
        assert!(contacts > 0);
        let text = polygons(&record, &[0.02; 3]);
        let document = roxmltree::Document::parse(&text).unwrap();
        let values = |parent: &str, name: &str| -> Vec<f64> {
            let array = document.descendants().find(|node| {
                node.attribute("Name") == Some(name)
                    && node
                        .parent()
                        .is_some_and(|above| above.has_tag_name(parent))
            });
            let text = array.unwrap().text().unwrap();
            text.split_whitespace()
                .map(|value| value.parse().unwrap())
                .collect()
        };
        let nodes = record
            .wires
            .iter()
            .map(|wire| wire.after.len())
            .sum::<usize>();
        assert_eq!(values("Points", "points").len(), 3 * (nodes + contacts));
        assert_eq!(values("Verts", "connectivity")[0], nodes as f64);
        assert_eq!(values("Lines", "connectivity").len(), 2 * (nodes - 3));
        assert_eq!(
            values("Lines", "offsets").last(),
            Some(&(2.0 * (nodes - 3) as f64))
        );
        // Of the second wire the fourth.
        assert_eq!(
            values("CellData", "tension")[contacts + record.wires[0].tensions.len() + 3],
            123.5
        );
        assert_eq!(
            values("CellData", "force").len(),
            3 * (nodes - 3 + contacts)
        );
        let piece = document
            .descendants()
            .find(|node| node.has_tag_name("Piece"))
            .unwrap();
        assert_eq!(
            piece.attribute("NumberOfLines").unwrap(),
            (nodes - 3).to_string()
        );
        let clock = collection(&[(0, 0.5), (1, 1.0)]);
        let clock = roxmltree::Document::parse(&clock).unwrap();
        let files: Vec<_> = clock
            .descendants()
            .filter_map(|node| node.attribute("file"))
            .collect();
        assert_eq!(files, ["step-000000.vtp", "step-000001.vtp"]);
    }
}
