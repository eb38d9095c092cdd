//! PLY: elements `vertex`, `face` and `edge`, in text or binary.

use std::io::{BufRead, Cursor, Read as _};

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult,
};

use tunnelproof::certified::Precision;

use super::error::Problem;
use super::{Parts, Position};

/// A vertex, as far as the file states it.
#[derive(Default)]
struct Vertex([Option<f64>; 3]);

/// The corners of a polygon.
#[derive(Default)]
struct Face(Option<Vec<u32>>);

/// The ends of an edge.
#[derive(Default)]
struct Edge([Option<u32>; 2]);

/// An element that is passed over.
struct Other;

/// # Errors
///
/// [`Problem`] if the file is no PLY, or its elements are none of a mesh.
pub(super) fn read(bytes: &[u8]) -> Result<Parts, Problem> {
    let mut reader = Reader::new(Cursor::new(bytes));
    let header = Parser::<Other>::new().read_header(&mut reader);
    let header = header.map_err(|error| problem(&error, true))?;
    let mut parts = Parts::default();
    let mut faces = Vec::new();
    for definition in header.elements.values() {
        // So that what has no properties, and so no length, is no endless work.
        if definition.count > bytes.len() {
            let ElementDef { name, count, .. } = definition;
            let what = format!("is too short for {count} elements {name:?}");
            return Err(Problem::Malformed(what));
        }
        match definition.name.as_str() {
            "face" => faces = read_faces(&mut reader, &header, definition)?,
            _ => read_element(&mut parts, &mut reader, &header, definition)?,
        }
    }
    check_indices(&parts, &faces)?;
    for corners in &faces {
        parts.push_polygon(corners);
    }
    let mut rest = Vec::new();
    // Reading from memory does not fail.
    let _ = reader.get_mut().read_to_end(&mut rest);
    match rest.trim_ascii().is_empty() {
        true => Ok(parts),
        false => {
            let what = format!("has {} bytes after the last element", rest.len());
            Err(Problem::Malformed(what))
        }
    }
}

fn read_element(
    parts: &mut Parts,
    reader: &mut Reader<impl BufRead>,
    header: &Header,
    definition: &ElementDef,
) -> Result<(), Problem> {
    match definition.name.as_str() {
        "vertex" => {
            for Vertex(position) in elements(reader, header, definition)? {
                let [Some(x), Some(y), Some(z)] = position else {
                    let what = "the element \"vertex\" has no numbers x, y and z";
                    return Err(Problem::Malformed(what.to_owned()));
                };
                parts.vertices.push([x, y, z]);
            }
        }
        "edge" => {
            for Edge(ends) in elements(reader, header, definition)? {
                let [Some(a), Some(b)] = ends else {
                    let what = "the element \"edge\" has no vertices vertex1 and vertex2";
                    return Err(Problem::Malformed(what.to_owned()));
                };
                parts.edges.push([a, b]);
            }
        }
        _ => drop(elements::<Other>(reader, header, definition)?),
    }
    Ok(())
}

/// The corners of the polygons.
fn read_faces(
    reader: &mut Reader<impl BufRead>,
    header: &Header,
    definition: &ElementDef,
) -> Result<Vec<Vec<u32>>, Problem> {
    let faces = elements(reader, header, definition)?.into_iter();
    let corners = |(index, Face(corners)): (usize, Face)| {
        let what = match corners {
            Some(corners) if corners.len() >= 3 => return Ok(corners),
            Some(corners) => format!("face {index} has {} vertices, not 3 or more", corners.len()),
            None => {
                format!("face {index} has no list vertex_indices of whole numbers of at least 0")
            }
        };
        Err(Problem::Malformed(what))
    };
    faces.enumerate().map(corners).collect()
}

/// Refuses faces and edges with vertices that do not exist, by their numbers in the file.
fn check_indices(parts: &Parts, faces: &[Vec<u32>]) -> Result<(), Problem> {
    let count = parts.vertices.len();
    let faces = faces.iter().enumerate();
    let faces = faces.map(|(index, corners)| ("face", index, &corners[..]));
    let edges = parts.edges.iter().enumerate();
    let edges = edges.map(|(index, ends)| ("edge", index, &ends[..]));
    for (what, index, vertices) in faces.chain(edges) {
        if let Some(vertex) = vertices.iter().find(|&&vertex| vertex as usize >= count) {
            let what = match count {
                1 => format!("{what} {index} has the vertex {vertex}, and there is 1 vertex"),
                _ => format!(
                    "{what} {index} has the vertex {vertex}, and there are {count} vertices"
                ),
            };
            return Err(Problem::Malformed(what));
        }
    }
    Ok(())
}

fn elements<E: PropertyAccess>(
    reader: &mut Reader<impl BufRead>,
    header: &Header,
    definition: &ElementDef,
) -> Result<Vec<E>, Problem> {
    let elements = Parser::new().read_payload_for_element(reader, definition, header);
    elements.map_err(|error| problem(&error, header.encoding == Encoding::Ascii))
}

/// An error of the library in one line. It quotes lines of the file, which may be long.
fn problem(error: &ParseError, is_text: bool) -> Problem {
    let text = error.to_string();
    // What the library's grammar expected helps nobody.
    let plain = [
        (
            "expected one of",
            "the line does not hold what the header says",
        ),
        (
            "Expected magic number 'ply'",
            "the first line is not \"ply\"",
        ),
    ];
    let plain = plain.iter().find(|(known, _)| text.contains(known));
    if let (Some((_, what)), Some(line)) = (plain, error.line().filter(|_| is_text)) {
        return Problem::line(line, format!("is no PLY: {what}"));
    }
    let place = error.line().map(|line| format!("Line {line}: "));
    let text = text
        .strip_prefix(&place.unwrap_or_default())
        .unwrap_or(&text);
    let mut what = line_of(text).to_owned();
    let cause = text
        .rsplit_once("\tError: ")
        .map(|(_, cause)| line_of(cause));
    if let Some(cause) = cause.filter(|cause| cause.len() <= LONGEST_CAUSE) {
        what += &format!(": {cause}");
    }
    let what = format!("is no PLY: {what}");
    match error.line().filter(|_| is_text) {
        Some(line) => Problem::line(line, what),
        None => Problem::Malformed(what),
    }
}

/// How many bytes of a cause an error has room for.
const LONGEST_CAUSE: usize = 100;

fn line_of(text: &str) -> &str {
    let line = text.lines().next().unwrap_or_default();
    line.trim_end_matches(['.', ',', ' '])
}

impl PropertyAccess for Vertex {
    fn new() -> Self {
        Vertex::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Vertex(position) = self;
        match name {
            "x" => position[0] = number(&property),
            "y" => position[1] = number(&property),
            "z" => position[2] = number(&property),
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Face {
    fn new() -> Self {
        Face::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !["vertex_indices", "vertex_index"].contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        self.0 = property.to_u32_list();
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Edge {
    fn new() -> Self {
        Edge::default()
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let Edge(ends) = self;
        match name {
            "vertex1" => ends[0] = index(&property),
            "vertex2" => ends[1] = index(&property),
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

impl PropertyAccess for Other {
    fn new() -> Self {
        Other
    }
}

/// A number, exactly.
fn number(property: &Property) -> Option<f64> {
    match *property {
        Property::Char(value) => Some(value.into()),
        Property::UChar(value) => Some(value.into()),
        Property::Short(value) => Some(value.into()),
        Property::UShort(value) => Some(value.into()),
        Property::Int(value) => Some(value.into()),
        Property::UInt(value) => Some(value.into()),
        Property::Float(value) => Some(value.into()),
        Property::Double(value) => Some(value),
        _ => None,
    }
}

/// A whole number of at least 0, exactly.
fn index(property: &Property) -> Option<u32> {
    let is_whole = !matches!(property, Property::Float(_) | Property::Double(_));
    let value = number(property).filter(|value| is_whole && *value >= 0.0)?;
    // Of an integer type of at most 32 bits.
    Some(value as u32)
}

/// The bytes of a file: binary, little-endian, with coordinates in the precision that they have.
pub(super) fn write(parts: &Parts, positions: &[Position], precision: Precision) -> Vec<u8> {
    let is_single = precision == Precision::F32;
    let real = if is_single { "float" } else { "double" };
    let mut header = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n\
         property {real} x\nproperty {real} y\nproperty {real} z\n\
         element face {}\nproperty list uchar uint vertex_indices\n",
        positions.len(),
        parts.faces.len()
    );
    if !parts.edges.is_empty() {
        header += &format!(
            "element edge {}\nproperty uint vertex1\nproperty uint vertex2\n",
            parts.edges.len()
        );
    }
    let mut bytes = (header + "end_header\n").into_bytes();
    for &x in positions.iter().flatten() {
        match is_single {
            true => bytes.extend((x as f32).to_le_bytes()),
            false => bytes.extend(x.to_le_bytes()),
        }
    }
    for face in &parts.faces {
        bytes.push(3);
        bytes.extend(face.iter().flat_map(|vertex| vertex.to_le_bytes()));
    }
    bytes.extend(
        parts
            .edges
            .iter()
            .flatten()
            .flat_map(|vertex| vertex.to_le_bytes()),
    );
    bytes
}
