//! A run for ParaView: files of polygons (`.vtp`) for each step, and a `.pvd` that puts them on a
//! clock.
//!
//! `step-NNNNNN.vtp` has every segment as a line, with its tension in N, its radius in m and its
//! wire, every node with its arc length in m, its velocity in m/s and what carries it (0 free, 1 pinned, 2 an eye,
//! 3 a contact node), and every contact as a point (kind 4) with the force on its place A in N, its gap in m
//! and the body, -1 if it is with a wire. `bodies-NNNNNN.vtp` has
//! the surfaces of all bodies where they are, each polygon with the number of its body, and as field
//! data the pose of every body: `position` in m and `orientation`, a unit quaternion (x, y, z, w).
//! The formats are those of VTK's XML, in text.

use std::fmt::Write as _;

use tunnelproof::query::Point;
use tunnelproof::wire::{ContactConstraint, ContactSite, NodeKind, Shape, StepRecord};

use crate::replay::{Surface, place};

/// The steps of a run on their clock: the text of the `.pvd`, of files named by [`file`](fn@file)
/// and, if there are bodies, by [`bodies_file`].
pub fn collection(times: &[(u64, f64)], has_bodies: bool) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n",
    );
    for (step, time) in times {
        let bodies = has_bodies.then(|| bodies_file(*step));
        for (part, name) in std::iter::once(file(*step)).chain(bodies).enumerate() {
            text += &format!("<DataSet timestep=\"{time}\" part=\"{part}\" file=\"{name}\"/>\n");
        }
    }
    text + "</Collection>\n</VTKFile>\n"
}

/// The name of the file of a step.
pub fn file(step: u64) -> String {
    format!("step-{step:06}.vtp")
}

/// The name of the file of the bodies after a step.
pub fn bodies_file(step: u64) -> String {
    format!("bodies-{step:06}.vtp")
}

/// The surfaces of bodies, in their frames.
pub struct Bodies(Vec<Option<Surface>>);

impl Bodies {
    /// Of these shapes. A plane has a pose, and no surface.
    pub fn new<'a>(shapes: impl IntoIterator<Item = &'a Shape>) -> Self {
        Bodies(shapes.into_iter().map(Surface::of).collect())
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Where they are after a step: the text of a `.vtp`.
    pub fn polygons(&self, record: &StepRecord) -> String {
        let mut points: Vec<Point> = Vec::new();
        let (mut corners, mut ends, mut bodies) = (Vec::new(), Vec::new(), Vec::new());
        for (body, (surface, pose)) in self.0.iter().zip(&record.bodies).enumerate() {
            let (Some(surface), pose) = (surface, &pose.after) else {
                continue;
            };
            let first = points.len();
            points.extend(
                surface
                    .points
                    .iter()
                    .map(|at| pose.position + pose.orientation * at.coords),
            );
            for polygon in &surface.polygons {
                corners.extend(polygon.iter().map(|corner| first + corner));
                ends.push(corners.len());
                bodies.push(body);
            }
        }
        let poses = record.bodies.iter().map(|body| &body.after);
        let positions = poses
            .clone()
            .flat_map(|pose| <[f64; 3]>::from(pose.position.coords));
        let orientations = poses.flat_map(|pose| <[f64; 4]>::from(pose.orientation.coords));
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\">\n<PolyData>\n<FieldData>\n",
        );
        field(&mut text, "position", 3, record.bodies.len(), positions);
        field(
            &mut text,
            "orientation",
            4,
            record.bodies.len(),
            orientations,
        );
        text += &format!(
            "</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
             NumberOfPolys=\"{}\">\n<Points>\n",
            points.len(),
            ends.len()
        );
        let coordinates = points.iter().flat_map(|at| [at.x, at.y, at.z]);
        array(&mut text, "Float64", "points", 3, coordinates);
        text += "</Points>\n<Polys>\n";
        array(&mut text, "Int64", "connectivity", 1, corners);
        array(&mut text, "Int64", "offsets", 1, ends);
        text += "</Polys>\n<CellData Scalars=\"body\">\n";
        array(&mut text, "Int64", "body", 1, bodies);
        text + "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n"
    }
}

/// The wires and contacts after a step of `step` seconds: the text of a `.vtp`.
pub fn polygons(record: &StepRecord, radii: &[f64], step: f64) -> String {
    let mut points: Vec<Point> = Vec::new();
    let (mut kinds, mut arcs, mut velocities) = (Vec::new(), Vec::new(), Vec::new());
    let mut lines = Vec::new();
    let (mut tensions, mut torques) = (Vec::new(), Vec::new());
    let (mut thickness, mut wires) = (Vec::new(), Vec::new());
    for (w, wire) in record.wires.iter().enumerate() {
        let first = points.len();
        points.extend(&wire.after);
        kinds.extend(wire.kinds.iter().map(kind));
        arcs.extend(&wire.arcs);
        let ways = wire.after.iter().zip(&wire.before);
        velocities
            .extend(ways.flat_map(|(after, before)| <[f64; 3]>::from((after - before) / step)));
        for (segment, tension) in wire.tensions.iter().enumerate() {
            lines.extend([first + segment, first + segment + 1]);
            tensions.push(*tension);
            torques.push(wire.torque);
            thickness.push(radii.get(w).copied().unwrap_or(0.0));
            wires.push(w);
        }
    }
    let mut vertices = Vec::new();
    let (mut forces, mut gaps, mut bodies) = (Vec::new(), Vec::new(), Vec::new());
    for contact in &record.contacts {
        let at = place(record, &contact.contact.a).or_else(|| place(record, &contact.contact.b));
        if let Some(at) = at {
            vertices.push(points.len());
            points.push(at);
            forces.extend(contact.force.iter().copied());
            gaps.push(contact.contact.gap);
            bodies.push(body_of(&contact.contact));
            kinds.push(CONTACT);
            arcs.push(0.0);
            velocities.extend([0.0; 3]);
        }
    }
    let (segments, contacts) = (wires.len(), vertices.len());
    // Cell data are of vertices first, then of lines.
    let padded = |of: Vec<f64>| [vec![0.0; contacts], of].concat();
    let forces = [forces, vec![0.0; 3 * segments]].concat();
    let gaps = [gaps, vec![0.0; segments]].concat();
    let bodies = [bodies, vec![-1; segments]].concat();
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
    text += "</Lines>\n<PointData>\n";
    array(&mut text, "Int64", "kind", 1, kinds);
    array(&mut text, "Float64", "arc", 1, arcs);
    array(&mut text, "Float64", "velocity", 3, velocities);
    text += "</PointData>\n<CellData Scalars=\"tension\">\n";
    array(&mut text, "Float64", "tension", 1, padded(tensions));
    array(&mut text, "Float64", "torque", 1, padded(torques));
    array(&mut text, "Float64", "radius", 1, padded(thickness));
    array(&mut text, "Int64", "wire", 1, wires);
    array(&mut text, "Float64", "force", 3, forces);
    array(&mut text, "Float64", "gap", 1, gaps);
    array(&mut text, "Int64", "body", 1, bodies);
    text + "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n"
}

/// Of a point that is the place of a contact.
const CONTACT: i64 = 4;

/// What carries a node, as a number: free, pinned, an eye, a contact node.
fn kind(kind: &NodeKind) -> i64 {
    match kind {
        NodeKind::Free => 0,
        NodeKind::Pinned => 1,
        NodeKind::Eye { .. } => 2,
        _ => 3,
    }
}

/// The body that a contact is with, the second of two; -1 for two wires.
fn body_of(contact: &ContactConstraint) -> i64 {
    match (contact.b, contact.a) {
        (ContactSite::Body { body, .. }, _) | (_, ContactSite::Body { body, .. }) => body.0 as i64,
        _ => -1,
    }
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
    let head = format!("type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\"");
    listed(text, &head, values);
}

/// Numbers of the whole file, so many tuples.
fn field(
    text: &mut String,
    name: &str,
    components: usize,
    tuples: usize,
    values: impl IntoIterator<Item = f64>,
) {
    let head = format!(
        "type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" NumberOfTuples=\"{tuples}\""
    );
    listed(text, &head, values);
}

fn listed<T: std::fmt::Display>(
    text: &mut String,
    head: &str,
    values: impl IntoIterator<Item = T>,
) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "<DataArray {head} format=\"ascii\">");
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
        let text = polygons(&record, &[0.02; 3], world.settings().step);
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
        for (name, each) in [("kind", 1), ("arc", 1), ("velocity", 3)] {
            assert_eq!(values("PointData", name).len(), each * (nodes + contacts));
        }
        assert_eq!(values("PointData", "kind")[0], 1.0);
        assert_eq!(values("PointData", "kind").last(), Some(&4.0));
        assert_eq!(values("CellData", "gap")[0], record.contacts[0].contact.gap);
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
        let clock = collection(&[(0, 0.5), (1, 1.0)], false);
        let clock = roxmltree::Document::parse(&clock).unwrap();
        let files: Vec<_> = clock
            .descendants()
            .filter_map(|node| node.attribute("file"))
            .collect();
        assert_eq!(files, ["step-000000.vtp", "step-000001.vtp"]);
    }

    #[test]
    fn vtk_has_bodies_where_they_are() {
        let scene = Scene::embedded("twisting-under-load").unwrap();
        let mut world = scene.world().unwrap();
        let mut collisions = Collisions::default();
        let record = world.step_colliding(&mut collisions, &[]).unwrap();
        let bodies = Bodies::new(world.bodies().iter().map(|body| body.shape()));
        let text = bodies.polygons(&record);
        let document = roxmltree::Document::parse(&text).unwrap();
        let values = |name: &str| -> Vec<f64> {
            let mut nodes = document.descendants();
            let array = nodes.find(|node| node.attribute("Name") == Some(name));
            let text = array.unwrap().text().unwrap();
            text.split_whitespace()
                .map(|value| value.parse().unwrap())
                .collect()
        };
        let poses: Vec<_> = record.bodies.iter().map(|body| body.after).collect();
        assert_eq!(values("position").len(), 3 * poses.len());
        assert_eq!(values("orientation")[3], poses[0].orientation.w);
        let [numbers, offsets] = ["body", "offsets"].map(values);
        assert_eq!(numbers.len(), offsets.len());
        // The load, a symmetrical body: the mean of its corners is where it is.
        let corners = values("connectivity");
        let mut of_load: Vec<usize> = Vec::new();
        for (cell, end) in offsets.iter().enumerate() {
            let from = if cell == 0 { 0.0 } else { offsets[cell - 1] };
            if numbers[cell] == 1.0 {
                of_load.extend(
                    corners[from as usize..*end as usize]
                        .iter()
                        .map(|at| *at as usize),
                );
            }
        }
        of_load.sort_unstable();
        of_load.dedup();
        let points = values("points");
        let mean = |axis: usize| {
            let sum: f64 = of_load.iter().map(|at| points[3 * at + axis]).sum();
            sum / of_load.len() as f64
        };
        for axis in 0..3 {
            assert!(
                (mean(axis) - poses[1].position[axis]).abs() < 1e-9,
                "{axis}"
            );
        }
        let clock = collection(&[(0, 0.5)], true);
        assert!(
            clock.contains("part=\"1\" file=\"bodies-000000.vtp\""),
            "{clock}"
        );
    }
}
