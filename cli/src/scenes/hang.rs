//! How a wire hangs between two points.

use tunnelproof::query::Point;
use tunnelproof::wire::Vector;

/// Why a wire cannot hang as a catenary.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoCatenary {
    /// There is no stop with a place on both sides.
    AtEnd,
    /// Nothing pulls.
    Weightless,
    /// It is no longer than the way, in m.
    Short(f64),
    /// Its ends are one above the other: it would fold onto itself. A place beside where it would turn.
    Above([f64; 3]),
}

/// The corners of a polygon of `count` equal arcs of the catenary from one point to another, ends
/// left out, so that the polygon has a length in m. It knows no bodies.
///
/// # Errors
///
/// Unless gravity pulls, the points are apart across it and nearer to each other than the length.
pub(super) fn hang(
    [from, to]: [Point; 2],
    length: f64,
    gravity: &Vector,
    count: usize,
) -> Result<Vec<Point>, NoCatenary> {
    let up = (-gravity)
        .try_normalize(0.0)
        .ok_or(NoCatenary::Weightless)?;
    let way = to - from;
    if !(length > way.norm() && length.is_finite()) {
        return Err(NoCatenary::Short(way.norm()));
    }
    let rise = way.dot(&up);
    let across = way - up * rise;
    let distance = across.norm();
    let Some(ahead) = across.try_normalize(0.0) else {
        let lower = if rise > 0.0 { from } else { to };
        let slack = length - rise.abs();
        let aside = Vector::ith(up.iamin(), slack / 10.0);
        return Err(NoCatenary::Above(
            (lower - up * (slack / 2.0) + aside).into(),
        ));
    };
    let points = |a: f64| -> Vec<Point> {
        let at = |(x, z): (f64, f64)| from + ahead * x + up * z;
        arcs(a, distance, rise, count).map(at).collect()
    };
    // The length falls with a. Where a is least, the hyperbolic sine is still a number.
    let mut bracket = [distance / 1400.0, distance * 1e6];
    for _ in 0..100 {
        let a = (bracket[0] * bracket[1]).sqrt();
        let polygon = points(a);
        let parts = polygon.windows(2).map(|two| (two[1] - two[0]).norm());
        let longer = parts.sum::<f64>() > length;
        bracket[usize::from(!longer)] = a;
    }
    let polygon = points(bracket[0]);
    Ok(polygon[1..count].to_vec())
}

/// Corners at equal arcs, from (0, 0) to (`distance`, `rise`), of the catenary `z = a cosh((x - x0)
/// / a) + c`.
fn arcs(a: f64, distance: f64, rise: f64, count: usize) -> impl Iterator<Item = (f64, f64)> {
    let half = distance / (2.0 * a);
    let lowest = distance / 2.0 - a * libm::asinh(rise / (2.0 * a * libm::sinh(half)));
    let start = libm::sinh(-lowest / a);
    let arc = libm::sinh((distance - lowest) / a) - start;
    let height = move |x: f64| a * libm::cosh((x - lowest) / a);
    (0..=count).map(move |k| {
        let share = k as f64 / count as f64;
        let x = lowest + a * libm::asinh(start + arc * share);
        (x, height(x) - height(0.0))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sag(span: f64, rise: f64, length: f64) -> Vec<Point> {
        let ends = [Point::origin(), Point::new(0.0, span, rise)];
        let gravity = Vector::new(0.0, 0.0, -9.8);
        hang(ends, length, &gravity, 100).unwrap()
    }

    #[test]
    fn hang_polygon_has_its_length_and_balances_weight_by_tension() {
        for (span, rise, length) in [(30.0, 0.0, 50.0), (30.0, 7.0, 31.0), (0.5, -3.0, 20.0)] {
            let mut points = vec![Point::origin()];
            points.extend(sag(span, rise, length));
            points.push(Point::new(0.0, span, rise));
            let parts: Vec<Vector> = points.windows(2).map(|two| two[1] - two[0]).collect();
            let sum: f64 = parts.iter().map(|part| part.norm()).sum();
            assert!((sum - length).abs() < 1e-9 * length, "{sum}");
            // The horizontal tension is the same everywhere, so slopes rise by equal weights: equal
            // parts to second order of the angle between them.
            let slope = |part: &Vector| part.z / part.y;
            let rises: Vec<f64> = (parts.windows(2))
                .map(|two| slope(&two[1]) - slope(&two[0]))
                .collect();
            if span > 1.0 {
                let (low, high) = (rises.iter()).fold((f64::MAX, 0.0), |(low, high), &rise| {
                    (rise.min(low), rise.max(high))
                });
                assert!(high < 1.01 * low, "{low} {high}");
            }
        }
    }

    #[test]
    fn hang_is_refused_where_there_is_no_catenary() {
        let gravity = Vector::new(0.0, 0.0, -9.8);
        let none = Vector::zeros();
        let ends = [Point::origin(), Point::new(3.0, 0.0, 4.0)];
        let hang = |ends, length, gravity| hang(ends, length, gravity, 4);
        assert!(hang(ends, 5.1, &gravity).is_ok());
        assert_eq!(hang(ends, 5.0, &gravity), Err(NoCatenary::Short(5.0)));
        assert_eq!(hang(ends, f64::NAN, &gravity), Err(NoCatenary::Short(5.0)));
        assert_eq!(hang(ends, 5.1, &none), Err(NoCatenary::Weightless));
        let above = [Point::origin(), Point::new(0.0, 0.0, 4.0)];
        // A metre of slack is half a metre below the lower end, whichever that is.
        let turn = Err(NoCatenary::Above([0.1, 0.0, -0.5]));
        assert_eq!(hang(above, 5.0, &gravity), turn);
        let [high, low] = above;
        assert_eq!(hang([low, high], 5.0, &gravity), turn);
    }
}
