//! Queries of bodies that turn, as numbers, and what may make one simpler.

use std::hash::{Hash, Hasher};
use std::iter;
use std::ops::Range;

use tunnelproof::query::{Point, Radius};
use tunnelproof::rigid::{EdgeTurningEdge, Pose, RigidMotion, RigidQuery, VertexTurningFace};

use nalgebra::Quaternion;

use super::Complexity;
use super::form::{Form, Shrinkable, Step};
use super::steps::{BITS, lowest_bit, rounding, simpler};
use crate::corpus::turning::Fields;

/// The numbers of a query of a body that turns: the points in space at both ends of the step, those
/// in the body's frame, and both poses, seven numbers each; of a vertex and a face the last three are
/// 0.
#[derive(Clone, Copy, Debug)]
pub struct TurningForm {
    is_face: bool,
    numbers: [f64; 32],
    radii: [f64; 2],
}

impl Shrinkable for RigidQuery {
    type Form = TurningForm;

    fn form(&self) -> TurningForm {
        let fields = Fields::of(self);
        let points = fields.points.iter().chain(&fields.local).flatten();
        let own = points.chain(fields.poses.iter().flatten());
        let mut numbers = [0.0; 32];
        numbers
            .iter_mut()
            .zip(own)
            .for_each(|(place, number)| *place = *number);
        TurningForm {
            is_face: matches!(self, RigidQuery::VertexTurningFace(_)),
            numbers,
            radii: self.radius().parts(),
        }
    }
}

impl Form for TurningForm {
    type Query = RigidQuery;

    const STEPS: &'static [Step<TurningForm>] = &[
        simpler_radius,
        zeros,
        at_rest,
        coarser,
        without_offset,
        single_numbers,
    ];

    fn complexity(&self) -> Complexity {
        let positions = (0..self.poses().start / 3).map(|index| self.position(3 * index));
        Complexity::of_numbers(&self.numbers, self.radii, positions.collect())
    }

    fn query(&self) -> Option<RigidQuery> {
        let point = |number: usize| Point::from(self.position(number));
        let [start, end] = [0, 7].map(|offset| {
            let first = self.poses().start + offset;
            let [w, x, y, z] = [3, 4, 5, 6].map(|i| self.numbers[first + i]);
            Pose::new(point(first), Quaternion::new(w, x, y, z))
        });
        let motion = RigidMotion::new(start, end).ok()?;
        let radius = Radius::from(self.radii);
        match self.is_face {
            false => {
                let ([a, b, a1, b1], local) = ([0, 3, 6, 9].map(point), [12, 15].map(point));
                EdgeTurningEdge::with_radius([a, b], [a1, b1], local, motion, radius)
                    .ok()
                    .map(RigidQuery::EdgeTurningEdge)
            }
            true => {
                let ([a, a1], local) = ([0, 3].map(point), [6, 9, 12].map(point));
                VertexTurningFace::with_radius([a], [a1], local, motion, radius)
                    .ok()
                    .map(RigidQuery::VertexTurningFace)
            }
        }
    }
}

impl TurningForm {
    /// The points in space, first at the start, then as many at the end.
    fn points(&self) -> Range<usize> {
        0..if self.is_face { 6 } else { 12 }
    }

    /// The points in the body's frame.
    fn local(&self) -> Range<usize> {
        self.points().end..if self.is_face { 15 } else { 18 }
    }

    /// The poses: x, y and z of the centre, w, x, y and z of the quaternion, at the start and at the
    /// end.
    fn poses(&self) -> Range<usize> {
        self.local().end..self.local().end + 14
    }

    fn position(&self, first: usize) -> [f64; 3] {
        [0, 1, 2].map(|axis| self.numbers[first + axis])
    }

    /// The same with these numbers changed; a 0 is always the positive one.
    fn changed(&self, run: impl IntoIterator<Item = usize>, change: impl Fn(f64) -> f64) -> Self {
        let mut form = *self;
        for index in run {
            form.numbers[index] = change(form.numbers[index]) + 0.0;
        }
        form
    }

    /// Numbers that belong together, the longest runs first: points in space, at the start, at the
    /// end, in the frame, centres, quaternions, points, and single numbers.
    fn runs(&self) -> Vec<Range<usize>> {
        let [points, local, poses] = [self.points(), self.local(), self.poses()];
        let middle = points.end / 2;
        let halves = [0..middle, middle..points.end];
        let parts = [0..3, 3..7, 7..10, 10..14];
        let parts = parts.map(|part| poses.start + part.start..poses.start + part.end);
        let of_points = (0..poses.start / 3).map(|point| 3 * point..3 * point + 3);
        let single = (0..poses.end).map(|index| index..index + 1);
        iter::once(points)
            .chain(halves)
            .chain(iter::once(local))
            .chain(parts)
            .chain(of_points)
            .chain(single)
            .collect()
    }

    fn bits(&self) -> (bool, [u64; 32], [u64; 2]) {
        let numbers = self.numbers.map(f64::to_bits);
        (self.is_face, numbers, self.radii.map(f64::to_bits))
    }
}

impl PartialEq for TurningForm {
    /// Bit for bit.
    fn eq(&self, other: &Self) -> bool {
        self.bits() == other.bits()
    }
}

impl Eq for TurningForm {}

impl Hash for TurningForm {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.bits().hash(state);
    }
}

/// No radius, one, or one in place of two.
fn simpler_radius(form: &TurningForm) -> Box<dyn Iterator<Item = TurningForm>> {
    let form = *form;
    let [first, second] = form.radii;
    let radii = [0.0, 1.0, first, second, first + second].into_iter();
    Box::new(radii.map(move |radius| TurningForm {
        radii: [radius, 0.0],
        ..form
    }))
}

fn zeros(form: &TurningForm) -> Box<dyn Iterator<Item = TurningForm>> {
    let form = *form;
    Box::new(
        form.runs()
            .into_iter()
            .map(move |run| form.changed(run, |_| 0.0)),
    )
}

/// What does not move: points in space, the body, its centre, or its orientation, as at the start or
/// as at the end.
fn at_rest(form: &TurningForm) -> Box<dyn Iterator<Item = TurningForm>> {
    let form = *form;
    let (middle, poses) = (form.points().end / 2, form.poses().start);
    let moving = [
        (0..middle, middle),
        (0..3, middle),
        (middle - 3..middle, middle),
        (poses..poses + 7, 7),
        (poses..poses + 3, 7),
        (poses + 3..poses + 7, 7),
    ];
    Box::new(moving.into_iter().flat_map(move |(start, by)| {
        let mut rests = [form; 2];
        for index in start {
            rests[0].numbers[index + by] = form.numbers[index];
            rests[1].numbers[index] = form.numbers[index + by];
        }
        rests
    }))
}

/// Numbers rounded to a multiple of a power of two that leaves few bits of the largest.
fn coarser(form: &TurningForm) -> Box<dyn Iterator<Item = TurningForm>> {
    let form = *form;
    Box::new(form.runs().into_iter().flat_map(move |run| {
        BITS.map(|bits| {
            let round = rounding(&form.numbers[run.clone()], bits);
            form.changed(run.clone(), round)
        })
    }))
}

/// Everything in space shifted along an axis such that something is there at 0.
fn without_offset(form: &TurningForm) -> Box<dyn Iterator<Item = TurningForm>> {
    let form = *form;
    let poses = form.poses().start;
    Box::new((0..3).flat_map(move |axis| {
        let points = (0..form.points().end / 3).map(move |point| 3 * point + axis);
        let all: Vec<_> = points.chain([poses + axis, poses + 7 + axis]).collect();
        let offsets: Vec<_> = all.iter().map(|&index| form.numbers[index]).collect();
        offsets.into_iter().flat_map(move |offset| {
            let all = all.clone();
            [offset, lowest_bit(offset)]
                .map(|by| form.changed(all.iter().copied(), |number| number - by))
        })
    }))
}

/// One number smaller or with fewer bits.
fn single_numbers(form: &TurningForm) -> Box<dyn Iterator<Item = TurningForm>> {
    let form = *form;
    Box::new((0..form.poses().end).flat_map(move |index| {
        simpler(form.numbers[index]).map(|value| form.changed([index], |_| value))
    }))
}
