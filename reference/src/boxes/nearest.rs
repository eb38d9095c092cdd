//! How near two bodies come, by the nearest point of their difference: P. Wolfe, "Finding the
//! nearest point in a polytope", *Mathematical Programming* 11, 1976, in rational numbers.
//!
//! Two bodies are as far apart, without their radii, as the origin is from the set of all
//! differences of a point of the second and one of the first. Over a part of the step the second
//! passes the first by `w`, and the nearest approach is the distance of the origin from the hull of
//! that set at both ends of the part: at a time between, each difference is between two of these.
//!
//! The method keeps some corners, of which none is needed less, and the nearest point `x` of their
//! hull. Where no corner `c` of the whole has `x . c < x . x`, `x` is the nearest point of the whole.
//! Otherwise such a corner is added; the distance falls each time, so no set of corners comes twice,
//! and in exact arithmetic the method ends.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::vector::{dot, sub};

use super::body::{BoxCast, Vector, add, number, scale, vector};

/// The square of the least distance of the bodies, without their radii, from the start until this
/// time of the step.
pub fn least_square(cast: &BoxCast, until: &BigRational) -> BigRational {
    square_between(cast, &BigRational::zero(), until)
}

/// Whether they come as near as their radii, and by this distance more, from the start until this
/// time of the step.
pub fn comes_within(cast: &BoxCast, distance: f64, until: &BigRational) -> bool {
    let [first, second] = cast.bodies();
    let reach = number(first.radius()) + number(second.radius()) + number(distance);
    least_square(cast, until) <= &reach * &reach
}

/// The square of the least distance between two times of the step.
fn square_between(cast: &BoxCast, from: &BigRational, to: &BigRational) -> BigRational {
    let corners = difference(cast, from, to);
    let nearest = nearest(&corners);
    dot(&nearest, &nearest)
}

/// The corners of the set of differences at both times, each of which is between others or not.
fn difference(cast: &BoxCast, from: &BigRational, to: &BigRational) -> Vec<Vector> {
    let [first, second] = cast.bodies();
    let passing = sub(&vector(&second.step()), &vector(&first.step()));
    let [p, q] = [first, second].map(|body| {
        let corners = body.corners().into_iter();
        corners
            .map(|corner| vector(&corner.coords))
            .collect::<Vec<_>>()
    });
    let ways = [from, to].map(|time| scale(&passing, time));
    let mut corners = Vec::with_capacity(2 * p.len() * q.len());
    for (own, other) in p.iter().flat_map(|own| q.iter().map(move |q| (own, q))) {
        let apart = sub(other, own);
        corners.extend(ways.iter().map(|way| add(&apart, way)));
    }
    corners
}

/// A corner that is kept, and its weight in the nearest point.
type Kept = (usize, BigRational);

/// The point of the hull of corners, at least one, that is nearest to the origin.
fn nearest(corners: &[Vector]) -> Vector {
    let mut kept: Vec<Kept> = vec![(0, BigRational::one())];
    loop {
        let nearest = weighted(corners, &kept);
        let along = corners.iter().map(|corner| dot(&nearest, corner));
        let least = along.enumerate().min_by(|(_, x), (_, y)| x.cmp(y));
        let Some((corner, _)) = least.filter(|(_, along)| *along < dot(&nearest, &nearest)) else {
            return nearest;
        };
        kept.push((corner, BigRational::zero()));
        reduce(corners, &mut kept);
    }
}

/// Moves to the nearest point of the hull of the kept corners, and drops those without weight.
fn reduce(corners: &[Vector], kept: &mut Vec<Kept>) {
    loop {
        let weights = weights(corners, kept);
        if weights.iter().all(|weight| weight.is_positive()) {
            kept.iter_mut()
                .zip(weights)
                .for_each(|(kept, weight)| kept.1 = weight);
            return;
        }
        // As far towards these weights as none is below 0.
        let shares = kept.iter().zip(&weights);
        let shares = shares.filter(|(_, weight)| !weight.is_positive());
        let shares = shares.map(|((_, own), weight)| own / (own - weight));
        let share = shares.min().unwrap_or_else(BigRational::one);
        for ((_, own), weight) in kept.iter_mut().zip(&weights) {
            *own += &share * (weight - &*own);
        }
        kept.retain(|(_, weight)| weight.is_positive());
    }
}

fn weighted(corners: &[Vector], kept: &[Kept]) -> Vector {
    let zero = [(); 3].map(|()| BigRational::zero());
    kept.iter().fold(zero, |sum, (corner, weight)| {
        add(&sum, &scale(&corners[*corner], weight))
    })
}

/// The weights, of sum 1, of the point nearest to the origin on the flat through the kept corners,
/// which is a point, a line, a plane or all: no kept corner is on the flat of the others.
///
/// With the ways `e` from the first corner `a` to the others, the point `a + sum of l e` is nearest
/// where it has no part along any `e`: `sum of l_j e_i . e_j = -e_i . a`.
fn weights(corners: &[Vector], kept: &[Kept]) -> Vec<BigRational> {
    let origin = &corners[kept[0].0];
    let ways = kept[1..].iter().map(|(c, _)| sub(&corners[*c], origin));
    let ways: Vec<Vector> = ways.collect();
    let row = |way: &Vector| {
        let products = ways.iter().map(|other| dot(way, other));
        products.chain([-dot(way, origin)]).collect()
    };
    let rest = solve(ways.iter().map(row).collect());
    let first = rest.iter().fold(BigRational::one(), |sum, l| sum - l);
    std::iter::once(first).chain(rest).collect()
}

/// The solution of a linear system with a positive definite matrix, each row with its right-hand
/// side: by elimination, which needs no other pivot.
fn solve(mut rows: Vec<Vec<BigRational>>) -> Vec<BigRational> {
    let count = rows.len();
    for pivot in 0..count {
        let divisor = rows[pivot][pivot].clone();
        rows[pivot].iter_mut().for_each(|x| *x /= &divisor);
        let row = rows[pivot].clone();
        for (_, other) in rows.iter_mut().enumerate().filter(|(i, _)| *i != pivot) {
            let factor = other[pivot].clone();
            let entries = other.iter_mut().zip(&row);
            entries.for_each(|(x, y)| *x -= &factor * y);
        }
    }
    rows.iter_mut().filter_map(Vec::pop).collect()
}
