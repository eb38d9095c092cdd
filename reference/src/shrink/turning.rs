//! Queries of bodies that turn, as numbers, and what may make one simpler.

use std::hash::{Hash, Hasher};
use std::iter;
use std::ops::Range;

use tunnelproof::rigid::{RigidQuery, RigidQueryKind};

use super::Complexity;
use super::form::{Form, Shrinkable, Step};
use super::steps::{BITS, lowest_bit, rounding, simpler};
use crate::corpus::turning::Fields;

/// The most numbers that a query has: of two bodies four points and four poses.
pub(super) const MOST: usize = 40;

/// The numbers of a query of bodies that turn: the points in space at both ends of the step, those
/// in frames of bodies, and the poses, seven numbers each; the rest are 0.
#[derive(Clone, Copy, Debug)]
pub struct TurningForm {
    kind: RigidQueryKind,
    /// How many of the numbers are of points in space, of points in frames, and of poses.
    counts: [usize; 3],
    numbers: [f64; MOST],
    radii: [f64; 2],
}

impl Shrinkable for RigidQuery {
    type Form = TurningForm;

    fn form(&self) -> TurningForm {
        let fields = Fields::of(self);
        let points = fields.points.iter().chain(&fields.local).flatten();
        let own = points.chain(fields.poses.iter().flatten());
        let mut numbers = [0.0; MOST];
        numbers
            .iter_mut()
            .zip(own)
            .for_each(|(place, number)| *place = *number);
        TurningForm {
            kind: self.kind(),
            counts: [
                3 * fields.points.len(),
                3 * fields.local.len(),
                7 * fields.poses.len(),
            ],
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
        let points = |run: Range<usize>| {
            let (points, _) = self.numbers[run].as_chunks();
            points.to_vec()
        };
        let (poses, _) = self.numbers[self.poses()].as_chunks();
        let fields = Fields {
            points: points(self.points()),
            local: points(self.local()),
            poses: poses.to_vec(),
        };
        fields.query(self.kind, self.radii.into()).ok()
    }
}

impl TurningForm {
    /// The points in space, first at the start, then as many at the end.
    fn points(&self) -> Range<usize> {
        0..self.counts[0]
    }

    /// The points in frames of bodies.
    fn local(&self) -> Range<usize> {
        let first = self.points().end;
        first..first + self.counts[1]
    }

    /// The poses: x, y and z of the centre, w, x, y and z of the quaternion, of each body at the start
    /// and at the end.
    fn poses(&self) -> Range<usize> {
        let first = self.local().end;
        first..first + self.counts[2]
    }

    /// Where the poses of each body begin.
    fn bodies(&self) -> impl Iterator<Item = usize> + use<> {
        self.poses().step_by(14)
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
        let parts = |body: usize| {
            [0..3, 3..7, 7..10, 10..14].map(|part| body + part.start..body + part.end)
        };
        let parts = self.bodies().flat_map(parts);
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

    fn bits(&self) -> (RigidQueryKind, [u64; MOST], [u64; 2]) {
        let numbers = self.numbers.map(f64::to_bits);
        (self.kind, numbers, self.radii.map(f64::to_bits))
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
    Box::new(radii.map(move |radius| {
        let mut simpler = form;
        simpler.radii = [radius, 0.0];
        simpler
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
    let middle = form.points().end / 2;
    let in_space = [
        (0..middle, middle),
        (0..middle.min(3), middle),
        (middle.saturating_sub(3)..middle, middle),
    ];
    let of_body = |body: usize| {
        [
            (body..body + 7, 7),
            (body..body + 3, 7),
            (body + 3..body + 7, 7),
        ]
    };
    let moving = in_space.into_iter().chain(form.bodies().flat_map(of_body));
    Box::new(moving.flat_map(move |(start, by)| {
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
    Box::new((0..3).flat_map(move |axis| {
        let points = (0..form.points().end / 3).map(move |point| 3 * point + axis);
        let centres = form.poses().step_by(7).map(move |pose| pose + axis);
        let all: Vec<_> = points.chain(centres).collect();
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
