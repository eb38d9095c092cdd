//! How near thick wires come, beside what is guarded of their thickness.
//!
//! Of two segments the share of the thickness that is guarded is divided into 64 steps. Where a
//! motion starts they are beyond some of these distances, and throughout the motion they have to
//! stay beyond the last one. Segments of one wire have as many steps as the stretch of wire between
//! them leaves: it may be bent into half a circle. All is decided by the oracle. Before that, bounds
//! in `f64` leave out what is certain by a wide margin.

use tunnelproof::query::{EdgeEdge, Point, Query, Radius};
use tunnelproof::wire::Vector;
use tunnelproof_reference::oracle::decide_query;

/// Steps of the scale.
const STEPS: u32 = 64;

/// Far more than the rounding of what is computed here, as a part of the largest way between two points.
const ERROR: f64 = 1e-12;

/// Two wires, or two stretches of one: how thick they are, and how much of it is guarded.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thickness {
    /// The share that is guarded.
    pub(super) share: f64,
    /// The radii in m.
    pub(super) radii: [f64; 2],
    /// The length of wire between the two, if they are of one wire.
    pub(super) stretch: Option<f64>,
}

impl Thickness {
    /// The distance at which the surfaces touch, in m.
    pub(super) fn touching(&self) -> f64 {
        let whole = self.radii[0] + self.radii[1];
        self.stretch
            .map_or(whole, |stretch| whole.min(Self::half_circle(stretch)))
    }

    /// The distance of the ends of a stretch that is bent into half a circle.
    fn half_circle(stretch: f64) -> f64 {
        std::f64::consts::FRAC_2_PI * stretch
    }

    /// The steps that there are of it.
    fn limit(&self) -> u32 {
        let whole = self.radii[0] + self.radii[1];
        let Some(stretch) = self.stretch else {
            return STEPS;
        };
        let share = (Self::half_circle(stretch) / whole).clamp(0.0, 1.0);
        (share * f64::from(STEPS)).floor() as u32
    }

    /// How near a step of the scale is.
    fn at(&self, step: u32) -> Radius {
        let share = self.share * (f64::from(step) / f64::from(STEPS));
        self.radii.map(|radius| share * radius).into()
    }

    /// The last step that every one of some pairs at rest is beyond.
    pub(super) fn beyond(&self, pairs: &[[Point; 4]]) -> u32 {
        let mut step = self.limit();
        for points in pairs {
            let bounds = Bounds::new(points);
            while step > 0 && self.is_within(points, &bounds, step) {
                step -= 1;
            }
        }
        step
    }

    fn is_within(&self, points: &[Point; 4], bounds: &Bounds, step: u32) -> bool {
        let reach = self.at(step);
        let size = reach.rounded();
        if bounds.low > size * (1.0 + ERROR) {
            return false;
        }
        if bounds.high < size * (1.0 - ERROR) {
            return true;
        }
        let query = EdgeEdge::at_rest(*points, reach);
        query.is_ok_and(comes_within)
    }

    /// The motion of two segments that do not stay beyond a step of the scale, with this distance as
    /// its radius.
    pub(super) fn broken(&self, start: [Point; 4], end: [Point; 4], step: u32) -> Option<EdgeEdge> {
        let reach = self.at(step);
        let along = [start, end].map(|points| Bounds::new(&points).direction);
        let apart = |direction: Vector| {
            let times = [start, end];
            let low = times.map(|points| low(&points, &direction));
            low[0].min(low[1]) > reach.rounded() * (1.0 + ERROR)
        };
        if along.into_iter().flatten().any(apart) {
            return None;
        }
        let query = EdgeEdge::new(start, end, reach).ok()?;
        comes_within(query).then_some(query)
    }

    /// Whether it is less than the whole of what would be guarded.
    pub(super) fn is_part(&self, step: u32) -> bool {
        step < self.limit()
    }
}

fn comes_within(query: EdgeEdge) -> bool {
    decide_query(&Query::EdgeEdge(query)).hit.is_some()
}

/// Two bounds on the distance of two segments at rest, in m, and the direction of the first.
pub(super) struct Bounds {
    pub(super) low: f64,
    pub(super) high: f64,
    direction: Option<Vector>,
}

impl Bounds {
    /// Of `AB` and `CD`: two of their points are as near as the upper bound, and all of them are
    /// farther apart than the lower one along a direction.
    pub(super) fn new(points: &[Point; 4]) -> Self {
        let way = shortest(points);
        let length = way.norm();
        let direction = (length > 0.0).then(|| way / length);
        Bounds {
            low: direction.map_or(0.0, |direction| low(points, &direction).max(0.0)),
            high: length + ERROR * size(points),
            direction,
        }
    }
}

/// A lower bound on the distance of two segments: how far `CD` is beyond `AB` along a unit vector.
fn low([a, b, c, d]: &[Point; 4], direction: &Vector) -> f64 {
    let ends = [c - a, c - b, d - a, d - b].map(|way| way.dot(direction));
    let least = ends.into_iter().fold(f64::INFINITY, f64::min);
    least - ERROR * size(&[*a, *b, *c, *d])
}

/// The largest coordinate of the way from one of the points to another one. Nothing else is rounded.
fn size([a, rest @ ..]: &[Point; 4]) -> f64 {
    let ways = rest.iter().map(|point| point - a);
    ways.fold(0.0, |size: f64, way| size.max(way.amax()))
}

/// About the shortest way from `AB` to `CD`: between ends and what is nearest to them, or between
/// inner points.
fn shortest([a, b, c, d]: &[Point; 4]) -> Vector {
    let (k, l, m) = (b - a, d - c, c - a);
    let (kk, ll, kl) = (k.dot(&k), l.dot(&l), k.dot(&l));
    let on_ab = |v: f64| part((m + l * v).dot(&k), kk);
    let on_cd = |u: f64| part((k * u - m).dot(&l), ll);
    let inner = part(m.dot(&k) * ll - m.dot(&l) * kl, kk * ll - kl * kl);
    let v = on_cd(inner);
    let places = [
        (on_ab(v), v),
        (0.0, on_cd(0.0)),
        (1.0, on_cd(1.0)),
        (on_ab(0.0), 0.0),
        (on_ab(1.0), 1.0),
    ];
    let ways = places.map(|(u, v)| m + l * v - k * u);
    let shorter = |x: Vector, y: Vector| if y.norm() < x.norm() { y } else { x };
    ways.into_iter().fold(ways[0], shorter)
}

/// A quotient in `[0, 1]`; 0 if it is no number.
fn part(numerator: f64, denominator: f64) -> f64 {
    let quotient = numerator / denominator;
    if quotient > 0.0 {
        quotient.min(1.0)
    } else {
        0.0
    }
}
