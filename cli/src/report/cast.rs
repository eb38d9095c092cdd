//! A cast of a box as a picture: both bodies by their edges, seen with the second one, at the start, at the end
//! and at the contact, and the paths of the corners.

use nalgebra::{Vector2, Vector3};
use tunnelproof_reference::boxes::{Body, BoxAnswer, BoxCast, Shape};

use super::caption::{self, DETAIL, HEADLINE};
use super::svg::{Canvas, PAINTS};
use super::view::View;

const WIDTH: f64 = 960.0;
const HEIGHT: f64 = 640.0;
/// How much room the bodies have, about the middle.
const ROOM: [f64; 2] = [820.0, 430.0];
const MIDDLE: [f64; 2] = [480.0, 295.0];

/// The picture of a cast and its exact answer, an SVG document.
pub fn draw(title: &str, cast: &BoxCast, answer: &BoxAnswer) -> String {
    let scene = Scene::new(cast);
    let mut canvas = Canvas::new(WIDTH, HEIGHT, title);
    caption::title(&mut canvas, title);
    for corner in &scene.bodies[0].corners {
        let ends = [0.0, 1.0].map(|t| scene.place(&(corner + scene.passing * t)));
        canvas.path(&ends, 0);
    }
    let [first, second] = &PAINTS;
    scene.body(&mut canvas, 0, 0.0, first.faint);
    scene.body(&mut canvas, 0, 1.0, first.solid);
    scene.body(&mut canvas, 1, 0.0, second.solid);
    if let Some(toi) = answer.toi {
        scene.body(&mut canvas, 0, toi.below, first.dark);
    }
    let [headline, detail] = words(answer);
    canvas.text(Vector2::new(32.0, 578.0), HEADLINE, &headline);
    canvas.text(Vector2::new(32.0, 600.0), DETAIL, &detail);
    legend(&mut canvas, answer.toi.is_some());
    canvas.finish()
}

fn words(answer: &BoxAnswer) -> [String; 2] {
    let Some(toi) = answer.toi else {
        let detail = "the bodies stay apart";
        return ["No contact".to_owned(), detail.to_owned()];
    };
    let detail = match answer.overlaps {
        true => "without their radii they pass into each other",
        false => "without their radii they do not pass into each other",
    };
    let headline = format!("Contact at t {}", caption::about(toi));
    [headline, format!("{detail}; seen from the second body")]
}

fn legend(canvas: &mut Canvas, is_hit: bool) {
    let [first, second] = &PAINTS;
    let mut entries = vec![
        ("start", first.faint),
        ("end", first.solid),
        ("second body", second.solid),
    ];
    if is_hit {
        entries.insert(1, ("contact", first.dark));
    }
    let mut x = if is_hit { 540.0 } else { 640.0 };
    for (words, colour) in entries {
        let ends = [0.0, 20.0].map(|along| Vector2::new(x + along, 573.5));
        canvas.line(ends, colour, 4.0);
        canvas.text(Vector2::new(x + 30.0, 578.0), DETAIL, words);
        x += 52.0 + 7.5 * words.len() as f64;
    }
}

/// A body at the start.
struct Outline {
    corners: Vec<Vector3<f64>>,
    /// By the numbers of corners; of a sphere the one from its centre to itself.
    edges: Vec<[usize; 2]>,
    radius: f64,
}

impl Outline {
    fn new(body: &Body) -> Self {
        let edges = match body.shape() {
            Shape::Sphere => vec![[0, 0]],
            _ => body.edges(),
        };
        let corners = body.corners().into_iter();
        Outline {
            corners: corners.map(|corner| corner.coords).collect(),
            edges,
            radius: body.radius(),
        }
    }
}

struct Scene {
    bodies: [Outline; 2],
    /// How the first body passes the second one during the step.
    passing: Vector3<f64>,
    view: View,
    middle: Vector2<f64>,
    /// Pixels for a unit of the view, and for a metre.
    scale: f64,
    pixels: f64,
}

impl Scene {
    fn new(cast: &BoxCast) -> Self {
        let [first, second] = cast.bodies();
        let passing = first.step() - second.step();
        let bodies = [first, second].map(Outline::new);
        let [own, other] = &bodies;
        let moved = own.corners.iter().map(|corner| corner + passing);
        let points: Vec<Vector3<f64>> = moved
            .chain(own.corners.iter().copied())
            .chain(other.corners.iter().copied())
            .collect();
        let radius = own.radius.max(other.radius);
        let view = View::of(&points, &[]);
        let projected: Vec<_> = points.iter().map(|point| view.project(point)).collect();
        let fold = |start: f64, ends: fn(f64, f64) -> f64| {
            let vector = Vector2::repeat(start);
            projected.iter().fold(vector, |sum, p| sum.zip_map(p, ends))
        };
        let (low, high) = (fold(f64::MAX, f64::min), fold(f64::MIN, f64::max));
        // A metre in the unit of the view.
        let unit = view.length(1.0);
        let size = (high - low).map(|size| size + 2.0 * radius * unit);
        let [width, height] = ROOM;
        let fit = |room: f64, size: f64| if size > 0.0 { room / size } else { f64::MAX };
        let scale = fit(width, size.x).min(fit(height, size.y));
        let scale = if scale < f64::MAX { scale } else { 1.0 };
        Scene {
            bodies,
            passing,
            view,
            middle: (low + high) * 0.5,
            scale,
            pixels: scale * unit,
        }
    }

    fn place(&self, point: &Vector3<f64>) -> Vector2<f64> {
        let at = (self.view.project(point) - self.middle) * self.scale;
        Vector2::from(MIDDLE) + Vector2::new(at.x, -at.y)
    }

    /// A body at a time of the step; one with a radius is drawn as wide as it is.
    fn body(&self, canvas: &mut Canvas, which: usize, time: f64, colour: &str) {
        let body = &self.bodies[which];
        let moved = if which == 0 { time } else { 0.0 };
        for &[i, j] in &body.edges {
            let ends = [i, j].map(|i| self.place(&(body.corners[i] + self.passing * moved)));
            canvas.line(ends, colour, (2.0 * body.radius * self.pixels).max(3.0));
        }
    }
}

#[cfg(test)]
mod tests {
    use tunnelproof_reference::boxes::{BOX_FAMILIES, decide};

    use super::*;

    #[test]
    fn cast_pictures_are_on_the_sheet() {
        for family in BOX_FAMILIES {
            for index in 0..4 {
                let cast = family.cast(1, index);
                let picture = draw("a cast", &cast, &decide(&cast));
                let document = roxmltree::Document::parse(&picture).unwrap();
                let lines: Vec<_> = document
                    .descendants()
                    .filter(|node| node.has_tag_name("line"))
                    .collect();
                let edges = |body: &Body| Outline::new(body).edges.len();
                let [first, second] = cast.bodies();
                assert!(lines.len() >= 2 * edges(first) + edges(second) + 3);
                for line in lines {
                    for (name, most) in
                        [("x1", WIDTH), ("y1", HEIGHT), ("x2", WIDTH), ("y2", HEIGHT)]
                    {
                        let at: f64 = line.attribute(name).unwrap().parse().unwrap();
                        assert!((0.0..=most).contains(&at), "{}: {at}", family.name());
                    }
                }
            }
        }
    }
}
