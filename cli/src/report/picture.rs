//! A query as a picture, as the thesis draws its cases (4.1.1): both edges, or the vertex and the
//! edges of the face, at the start, at the end and at the time of impact, the paths of the points,
//! and the points of contact.

use nalgebra::{Vector2, Vector3};
use tunnelproof::query::{Query, QueryKind};
use tunnelproof::rigid::RigidQuery;

use tunnelproof_reference::answer::{Enclosure, ExactAnswer, ExactHit};
use tunnelproof_reference::certify::query::AnyQuery;

use super::caption;
use super::labels::Labels;
use super::svg::{Canvas, Font, OVERLAP, PAINTS, PAPER};
use super::view::View;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 640.0;
/// Left, top, right and bottom of where the edges are drawn.
const FRAME: [f64; 4] = [70.0, 80.0, 890.0, 510.0];
/// The same for labels.
const LABEL_FRAME: [f64; 4] = [24.0, 52.0, 936.0, 548.0];
/// How far the start and the end of the step are drawn apart where all points are on a line.
const STEP_HEIGHT: f64 = 260.0;

/// When an edge is drawn.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum When {
    Start,
    Impact,
    End,
}

/// The picture of a query and its exact answer, an SVG document.
pub fn draw(title: &str, query: &Query, answer: &ExactAnswer) -> String {
    let [start, end] = [query.start(), query.end()].map(|points| points.map(|point| point.coords));
    let at = |t: f64| [0, 1, 2, 3].map(|i| start[i] * (1.0 - t) + end[i] * t);
    draw_motion(title, query.kind(), &[0.0, 1.0], &at, answer)
}

/// The picture of a query of any sort.
pub fn draw_any(title: &str, query: &AnyQuery, answer: &ExactAnswer) -> String {
    match query {
        AnyQuery::Linear(query) => draw(title, query, answer),
        AnyQuery::Turning(query) => draw_turning(title, query, answer),
    }
}

/// The same of bodies that turn: their points move on arcs.
pub fn draw_turning(title: &str, query: &RigidQuery, answer: &ExactAnswer) -> String {
    let times: Vec<_> = (0..=ARC).map(|i| f64::from(i) / f64::from(ARC)).collect();
    let at = |t: f64| query.positions(t).map(|point| point.coords);
    draw_motion(title, query.kind().linear(), &times, &at, answer)
}

/// How many chords an arc is drawn by.
const ARC: u32 = 24;

/// A motion that is drawn along its places at these times, from 0 to 1.
fn draw_motion(
    title: &str,
    kind: QueryKind,
    times: &[f64],
    at: &dyn Fn(f64) -> [Vector3<f64>; 4],
    answer: &ExactAnswer,
) -> String {
    let scene = Scene::new(kind, times, at, answer);
    let mut canvas = Canvas::new(WIDTH, HEIGHT, title);
    caption::title(&mut canvas, title);
    scene.draw_paths(&mut canvas);
    scene.draw_edges(&mut canvas);
    scene.draw_labels(&mut canvas);
    caption::caption(&mut canvas, answer, scene.is_drawn_apart);
    caption::legend(&mut canvas, kind, answer.hit.is_some());
    canvas.finish()
}

/// An edge at one time; `size` 1 is that of the picture.
pub(super) fn draw_edge(
    canvas: &mut Canvas,
    ends: [Vector2<f64>; 2],
    edge: usize,
    when: When,
    size: f64,
) {
    let paint = &PAINTS[edge];
    match when {
        When::Start => {
            canvas.line(ends, PAPER, 17.0 * size);
            canvas.line(ends, paint.solid, 14.0 * size);
            canvas.line(ends, paint.faint, 11.4 * size);
        }
        When::End => {
            canvas.line(ends, PAPER, 11.0 * size);
            canvas.line(ends, paint.solid, 8.5 * size);
        }
        When::Impact => {
            canvas.line(ends, PAPER, 6.0 * size);
            canvas.line(ends, paint.dark, 3.4);
        }
    }
}

/// One edge at one time, in pixels.
struct Stroke {
    edge: usize,
    when: When,
    ends: [Vector2<f64>; 2],
    /// To the viewer, for the order of drawing.
    nearness: f64,
}

/// Everything in pixels.
struct Scene {
    /// The side that each point belongs to.
    sides: [usize; 4],
    /// The four points at some times, from the start to the end.
    path: Vec<[Vector2<f64>; 4]>,
    strokes: Vec<Stroke>,
    contacts: Vec<Vector2<f64>>,
    /// Whether all points are (nearly) on a line, so that start, impact and end are moved apart.
    is_drawn_apart: bool,
}

impl Scene {
    fn new(
        kind: QueryKind,
        times: &[f64],
        at: &dyn Fn(f64) -> [Vector3<f64>; 4],
        answer: &ExactAnswer,
    ) -> Self {
        let (start, end) = (at(0.0), at(1.0));
        let toi = answer.hit.map(|hit| middle(hit.toi));
        let impact = toi.map(at);
        let contacts = match (&answer.hit, &impact) {
            (Some(hit), Some(points)) => contacts(kind, hit, points),
            _ => Vec::new(),
        };
        let inside = times.iter().filter(|t| **t > 0.0 && **t < 1.0);
        let between: Vec<_> = inside.map(|t| at(*t)).collect();
        let mut telling = [&start[..], &end[..], &contacts[..]].concat();
        let all = telling.iter().chain(between.iter().flatten());
        let all: Vec<_> = all.copied().collect();
        // The view weighs all pairs of points: the middle stands for the others.
        telling.extend(between.get(between.len() / 2).into_iter().flatten());
        let lines = lines(kind);
        let seen = [0, 4].map(|end| lines.iter().map(move |[i, j]| [i + end, j + end]));
        let view = View::of(&telling, &seen.into_iter().flatten().collect::<Vec<_>>());
        let sheet = Sheet::new(view, &all);
        let sides = [0, 1, 2, 3].map(|i| side(kind, i));
        let place = |points: [Vector3<f64>; 4], time| {
            [0, 1, 2, 3].map(|i| sheet.place(&points[i], time, Some(sides[i])))
        };
        let mut strokes = Vec::new();
        let drawn = [
            (Some(start), 0.0, When::Start),
            (Some(end), 1.0, When::End),
            (impact, toi.unwrap_or(0.0), When::Impact),
        ];
        for (points, time, when) in drawn {
            let Some(points) = points else { continue };
            let placed = place(points, time);
            strokes.extend(lines.iter().map(|&[i, j]| Stroke {
                edge: sides[i],
                when,
                ends: [placed[i], placed[j]],
                nearness: view.nearness(&(points[i] * 0.5 + points[j] * 0.5)),
            }));
        }
        strokes.sort_by(|a, b| a.nearness.total_cmp(&b.nearness));
        Scene {
            sides,
            path: times.iter().map(|&t| place(at(t), t)).collect(),
            strokes,
            contacts: contacts
                .iter()
                .map(|at| sheet.place(at, toi.unwrap_or(0.0), None))
                .collect(),
            is_drawn_apart: sheet.is_drawn_apart,
        }
    }

    fn draw_paths(&self, canvas: &mut Canvas) {
        for i in 0..4 {
            let path: Vec<_> = self.path.iter().map(|points| points[i]).collect();
            canvas.path(&path, self.sides[i]);
        }
    }

    /// Start, end and impact on top of each other, thick to thin, so that none hides another where
    /// they coincide; of each the far edge first.
    fn draw_edges(&self, canvas: &mut Canvas) {
        for when in [When::Start, When::End, When::Impact] {
            if let ([a, b], When::Impact) = (&self.contacts[..], when) {
                canvas.line([*a, *b], OVERLAP, 13.0);
            }
            for stroke in self.strokes.iter().filter(|stroke| stroke.when == when) {
                draw_edge(canvas, stroke.ends, stroke.edge, when, 1.0);
            }
        }
        for &at in &self.contacts {
            canvas.sphere(at, 8.5);
        }
    }

    fn draw_labels(&self, canvas: &mut Canvas) {
        let lines = self.strokes.iter().map(|stroke| stroke.ends);
        let chords = self.path.windows(2);
        let paths = chords.flat_map(|ends| (0..4).map(|i| [ends[0][i], ends[1][i]]));
        let lines = lines.chain(paths).collect();
        let mut labels = Labels::new(lines, self.contacts.clone(), LABEL_FRAME);
        let ends = self.path.first().zip(self.path.last());
        let ends = ends.map(|(start, end)| [(start, '\u{2080}'), (end, '\u{2081}')]);
        for (points, time) in ends.into_iter().flatten() {
            for i in 0..4 {
                let at = labels.place(points[i], points[i] - points[i ^ 1]);
                let font = Font {
                    size: 17,
                    colour: PAINTS[self.sides[i]].dark,
                    is_bold: true,
                    is_centred: true,
                };
                canvas.text(at, font, &format!("{}{time}", ['A', 'B', 'C', 'D'][i]));
            }
        }
    }
}

/// From space to pixels.
struct Sheet {
    view: View,
    middle: Vector2<f64>,
    scale: f64,
    is_drawn_apart: bool,
}

impl Sheet {
    fn new(view: View, points: &[Vector3<f64>]) -> Self {
        let projected: Vec<_> = points.iter().map(|point| view.project(point)).collect();
        let low = projected
            .iter()
            .fold(Vector2::repeat(f64::MAX), |low, p| low.inf(p));
        let high = projected
            .iter()
            .fold(Vector2::repeat(f64::MIN), |high, p| high.sup(p));
        let size = high - low;
        let [left, top, right, bottom] = FRAME;
        let fit = |room: f64, size: f64| if size > 0.0 { room / size } else { f64::MAX };
        let scale = fit(right - left, size.x).min(fit(bottom - top, size.y));
        Sheet {
            view,
            middle: (low + high) * 0.5,
            scale: if scale < f64::MAX { scale } else { 0.0 },
            is_drawn_apart: size.y <= 0.03 * size.x,
        }
    }

    /// Where a point of an edge, or of contact, is at this time.
    fn place(&self, point: &Vector3<f64>, time: f64, edge: Option<usize>) -> Vector2<f64> {
        let at = (self.view.project(point) - self.middle) * self.scale;
        let [left, top, right, bottom] = FRAME;
        let middle = Vector2::new((left + right) / 2.0, (top + bottom) / 2.0);
        let beside = match edge {
            Some(0) => -9.0,
            Some(_) => 9.0,
            None => 0.0,
        };
        let lane = STEP_HEIGHT * (time - 0.5) + beside;
        let apart = if self.is_drawn_apart { lane } else { 0.0 };
        middle + Vector2::new(at.x, apart - at.y)
    }
}

/// The lines that are drawn: the edges; a vertex is one from it to itself.
fn lines(kind: QueryKind) -> &'static [[usize; 2]] {
    match kind {
        QueryKind::EdgeEdge => &[[0, 1], [2, 3]],
        QueryKind::VertexFace => &[[0, 0], [1, 2], [2, 3], [1, 3]],
    }
}

/// Which of the two sides a point belongs to.
fn side(kind: QueryKind, point: usize) -> usize {
    match kind {
        QueryKind::EdgeEdge => point / 2,
        QueryKind::VertexFace => usize::from(point > 0),
    }
}

/// The points of contact in space, on `AB` or on the face: one, or the two ends of an overlap.
fn contacts(kind: QueryKind, hit: &ExactHit, points: &[Vector3<f64>; 4]) -> Vec<Vector3<f64>> {
    let places = std::iter::once(hit.first).chain(hit.second);
    let parameters = places.map(|place| [place.u, place.v].map(middle));
    let [a, b, c, d] = points;
    let point = |[u, v]: [f64; 2]| match kind {
        QueryKind::EdgeEdge => a * (1.0 - u) + b * u,
        QueryKind::VertexFace => b * (1.0 - u - v) + c * u + d * v,
    };
    parameters.map(point).collect()
}

fn middle(number: Enclosure) -> f64 {
    number.below + (number.above - number.below) * 0.5
}

#[cfg(test)]
mod tests {
    use tunnelproof::query::{EdgeEdge, Point};
    use tunnelproof_reference::figures::FIGURES;

    use super::*;
    use tunnelproof_reference::generate::{FAMILIES, OTHER_KINDS, all_rigid};
    use tunnelproof_reference::oracle::{decide_query, decide_rigid_query};

    /// Every number in the picture's geometry, and whether the document is well-formed.
    fn coordinates(query: &Query) -> Vec<f64> {
        let answer = decide_query(query);
        let svg = draw("a <query> & \"more\"", query, &answer);
        let document = roxmltree::Document::parse(&svg).unwrap();
        let names = ["x1", "y1", "x2", "y2", "cx", "cy", "x", "y"];
        let shapes = document.descendants().filter(|node| {
            let name = node.tag_name().name();
            ["line", "circle", "text"].contains(&name)
        });
        shapes
            .flat_map(|node| names.map(|name| node.attribute(name).map(str::parse)))
            .flatten()
            .map(Result::unwrap)
            .collect()
    }

    #[test]
    fn picture_of_every_figure_and_family_stays_on_the_sheet() {
        let figures = FIGURES.iter().map(|case| Query::EdgeEdge(case.query()));
        // A tenth where Rust checks its arithmetic.
        let count = if cfg!(debug_assertions) { 15 } else { 150 };
        let drawn = FAMILIES
            .iter()
            .flat_map(|family| (0..count).map(|i| family.query(5, i)));
        let thick_or_face = OTHER_KINDS.iter();
        let thick_or_face =
            thick_or_face.flat_map(|family| (0..count / 3).map(|i| family.query(5, i)));
        for query in figures.chain(drawn).chain(thick_or_face) {
            for value in coordinates(&query) {
                assert!((0.0..=WIDTH).contains(&value), "{value} in {query:?}");
            }
        }
    }

    #[test]
    fn picture_of_bodies_that_turn_has_an_arc_for_each_point() {
        for family in all_rigid() {
            for index in 0..4 {
                let query = family.query(5, index);
                let svg = draw_turning("turning", &query, &decide_rigid_query(&query));
                let document = roxmltree::Document::parse(&svg).unwrap();
                let arcs = document
                    .descendants()
                    .filter(|node| node.has_tag_name("polyline"));
                let arcs: Vec<_> = arcs.filter_map(|node| node.attribute("points")).collect();
                assert!(arcs.len() >= 4);
                let numbers = arcs.iter().flat_map(|arc| arc.split([' ', ',']));
                for number in numbers {
                    let number: f64 = number.parse().unwrap();
                    assert!((0.0..=WIDTH).contains(&number), "{number} in {query:?}");
                }
            }
        }
    }

    #[test]
    fn picture_of_extreme_points_has_finite_numbers() {
        for size in [0.0, f64::from_bits(1), 1e-200, 1e300, f64::MAX] {
            let point = |x: f64, y: f64, z: f64| Point::new(x, y, z) * size;
            let start = [
                point(-1.0, 0.0, 0.0),
                point(1.0, 0.0, 0.0),
                point(0.0, -1.0, 1.0),
                point(0.0, 1.0, 1.0),
            ];
            let end = [
                start[0],
                start[1],
                point(0.0, -1.0, -1.0),
                point(0.0, 1.0, -1.0),
            ];
            let query = Query::EdgeEdge(EdgeEdge::new(start, end, 0.0).unwrap());
            for value in coordinates(&query) {
                assert!((0.0..=WIDTH).contains(&value), "{value} at size {size}");
            }
        }
    }

    #[test]
    fn picture_title_of_any_length_is_cut() {
        let query = Query::EdgeEdge(FIGURES[0].query());
        let answer = decide_query(&query);
        let svg = draw(&"long".repeat(1000), &query, &answer);
        let document = roxmltree::Document::parse(&svg).unwrap();
        let texts = document
            .descendants()
            .filter(|node| node.has_tag_name("text"));
        let longest = texts
            .filter_map(|node| node.text())
            .map(|text| text.chars().count());
        assert!(longest.max().unwrap() <= 100);
    }
}
