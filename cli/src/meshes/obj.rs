//! Wavefront OBJ: vertices `v`, polygons `f` and lines `l`.
//!
//! Read here and by no library: those there are read `f32`, number the vertices anew, or take lines
//! for polygons.

use std::fmt::Write as _;

use super::error::Problem;
use super::{Parts, Position};

/// What is passed over, by the first word of the line. A vertex alone (`p`) is one without it, too.
const OTHERS: [&str; 20] = [
    "vt",
    "vn",
    "vp",
    "g",
    "o",
    "s",
    "mg",
    "p",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
];

/// What UTF-8 text may start with.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// # Errors
///
/// [`Problem`] if a line is none of an OBJ of polygons and lines, or names a vertex that does not
/// exist.
pub(super) fn read(bytes: &[u8]) -> Result<Parts, Problem> {
    let mut parts = Parts::default();
    // The largest index so far and its line: a vertex may come after the face that names it.
    let mut largest = (0, 0);
    for (number, line) in statements(bytes) {
        let refuse = |what| Problem::line(number, what);
        let index = read_line(&mut parts, &line).map_err(refuse)?;
        largest = largest.max((index.map_or(0, |index| index + 1), number));
    }
    let ((named, line), count) = (largest, parts.vertices.len());
    match named as usize > count {
        true => Err(Problem::line(line, no_vertex(i64::from(named), count))),
        false => Ok(parts),
    }
}

/// The lines with their numbers, without comments. A line that ends with a backslash goes on in the
/// next one. Lines end with LF, CR and LF, or CR.
fn statements(bytes: &[u8]) -> Vec<(usize, String)> {
    let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
    let lines = bytes.split(|&byte| byte == b'\n').flat_map(|line| {
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        line.split(|&byte| byte == b'\r')
    });
    let mut statements: Vec<(usize, String)> = Vec::new();
    let mut goes_on = false;
    for (number, line) in (1..).zip(lines) {
        // Names may be in any encoding; numbers are ASCII.
        let line = String::from_utf8_lossy(line);
        let line = line.split('#').next().unwrap_or_default().trim_end();
        let (line, is_open) = match line.strip_suffix('\\') {
            Some(line) => (line, true),
            None => (line, false),
        };
        match statements.last_mut().filter(|_| goes_on) {
            Some((_, statement)) => *statement += &format!(" {line}"),
            None => statements.push((number, line.to_owned())),
        }
        goes_on = is_open;
    }
    statements
}

/// Adds what a line says, and tells the largest index of a vertex in it.
fn read_line(parts: &mut Parts, line: &str) -> Result<Option<u32>, String> {
    let mut words = line.split_whitespace();
    let Some(word) = words.next() else {
        return Ok(None);
    };
    let words: Vec<&str> = words.collect();
    match word {
        "v" => {
            parts.vertices.push(position(&words)?);
            Ok(None)
        }
        "f" => {
            let corners = indices(&words, parts.vertices.len())?;
            if corners.len() < 3 {
                return Err(format!(
                    "a face has 3 vertices or more, not {}",
                    corners.len()
                ));
            }
            parts.push_polygon(&corners);
            Ok(corners.into_iter().max())
        }
        "l" => {
            let ends = indices(&words, parts.vertices.len())?;
            if ends.len() < 2 {
                return Err(format!("a line has 2 vertices or more, not {}", ends.len()));
            }
            let pairs = ends.windows(2).map(|pair| [pair[0], pair[1]]);
            parts.edges.extend(pairs);
            Ok(ends.into_iter().max())
        }
        other if OTHERS.contains(&other) => Ok(None),
        other => Err(format!("{other:?} is no statement of an OBJ that is read")),
    }
}

/// The coordinates of `v x y z`, which a weight or a colour may follow.
fn position(words: &[&str]) -> Result<Position, String> {
    let number = |text: &&str| match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(format!("{text:?} is not a finite number")),
        Err(_) => Err(format!("{text:?} is not a number")),
    };
    let numbers: Vec<f64> = words.iter().map(number).collect::<Result<_, _>>()?;
    match numbers[..] {
        [x, y, z, ..] => Ok([x, y, z]),
        [_] => Err("a vertex of 1 coordinate, not 3".to_owned()),
        _ => Err(format!("a vertex of {} coordinates, not 3", numbers.len())),
    }
}

fn no_vertex(number: i64, count: usize) -> String {
    let (verb, vertices) = match count {
        1 => ("is", "vertex"),
        _ => ("are", "vertices"),
    };
    format!("there is no vertex {number}; there {verb} {count} {vertices}")
}

/// The vertices that `1`, `1/2` or `1//3` name, of which -1 is the last one so far.
fn indices(words: &[&str], count: usize) -> Result<Vec<u32>, String> {
    let index = |word: &&str| {
        let text = word.split('/').next().unwrap_or_default();
        let number: i64 = text.parse().map_err(|_| format!("{word:?} is no vertex"))?;
        let index = match number {
            0 => None,
            1.. => Some(number - 1),
            _ => Some(number + count as i64),
        };
        index
            .and_then(|index| u32::try_from(index).ok())
            .ok_or_else(|| no_vertex(number, count))
    };
    words.iter().map(index).collect()
}

/// The text of a file: decimals are the shortest that are read as the same numbers.
pub(super) fn write(parts: &Parts, positions: &[Position]) -> String {
    let mut text = String::new();
    let mut line = |arguments: std::fmt::Arguments<'_>| {
        // Writing to text does not fail.
        let _ = writeln!(text, "{arguments}");
    };
    for [x, y, z] in positions {
        line(format_args!("v {x:?} {y:?} {z:?}"));
    }
    for edge in &parts.edges {
        let [a, b] = edge.map(|vertex| u64::from(vertex) + 1);
        line(format_args!("l {a} {b}"));
    }
    for face in &parts.faces {
        let [a, b, c] = face.map(|vertex| u64::from(vertex) + 1);
        line(format_args!("f {a} {b} {c}"));
    }
    text
}
