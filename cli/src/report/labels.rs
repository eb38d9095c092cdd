//! Where labels stand: near their points, off the lines and off each other.

use nalgebra::Vector2;

/// Half the size of a label, in pixels.
const HALF: Vector2<f64> = Vector2::new(13.0, 9.0);

/// The labels of a picture, placed one after another.
pub(super) struct Labels {
    lines: Vec<[Vector2<f64>; 2]>,
    obstacles: Vec<Vector2<f64>>,
    /// Left, top, right, bottom of where labels may be.
    frame: [f64; 4],
    placed: Vec<Vector2<f64>>,
}

impl Labels {
    pub(super) fn new(
        lines: Vec<[Vector2<f64>; 2]>,
        obstacles: Vec<Vector2<f64>>,
        frame: [f64; 4],
    ) -> Self {
        Labels {
            lines,
            obstacles,
            frame,
            placed: Vec::new(),
        }
    }

    /// The middle of the baseline of a label for a point, if possible in the direction `outward`.
    pub(super) fn place(&mut self, point: Vector2<f64>, outward: Vector2<f64>) -> Vector2<f64> {
        let outward = outward
            .try_normalize(1e-9)
            .unwrap_or(Vector2::new(0.0, -1.0));
        let candidates = [21.0, 32.0].into_iter().flat_map(|radius| {
            (0..16).map(move |i| {
                let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / 16.0).sin_cos();
                radius * Vector2::new(cos, sin)
            })
        });
        let best = candidates
            .map(|offset| {
                let turned_away = 1.0 - offset.normalize().dot(&outward);
                let far = offset.norm() / 21.0;
                (
                    self.crowd(point + offset) + 1.5 * turned_away + far,
                    point + offset,
                )
            })
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let centre = best.map_or(point, |(_, centre)| centre);
        self.placed.push(centre);
        centre + Vector2::new(0.0, 6.0)
    }

    /// How much is in the way of a label with this middle.
    fn crowd(&self, centre: Vector2<f64>) -> f64 {
        let overlaps = |other: &&Vector2<f64>| {
            let apart = (centre - **other).abs();
            apart.x < 2.0 * HALF.x && apart.y < 2.0 * HALF.y
        };
        let crosses = |line: &&[Vector2<f64>; 2]| distance(&centre, line) < HALF.y + 5.0;
        let covers = |at: &&Vector2<f64>| (centre - **at).norm() < HALF.x + 9.0;
        let [left, top, right, bottom] = self.frame;
        let is_inside = (left..right).contains(&centre.x) && (top..bottom).contains(&centre.y);
        20.0 * self.placed.iter().filter(overlaps).count() as f64
            + 4.0 * self.lines.iter().filter(crosses).count() as f64
            + 8.0 * self.obstacles.iter().filter(covers).count() as f64
            + if is_inside { 0.0 } else { 50.0 }
    }
}

/// The distance of a point from a line between two points.
fn distance(point: &Vector2<f64>, [a, b]: &[Vector2<f64>; 2]) -> f64 {
    let along = b - a;
    let length = along.norm_squared();
    let at = match length > 0.0 {
        true => ((point - a).dot(&along) / length).clamp(0.0, 1.0),
        false => 0.0,
    };
    (a + along * at - point).norm()
}
