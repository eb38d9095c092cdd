//! What the equations of a step are linear about.
//!
//! A row of stretch counts velocities along its segment, a point of a body moves across its arm from the
//! centre of mass, and what keeps a step stable beside [short segments](super::transverse) follows from
//! their tensions. All are taken as they are where the step starts. That is not enough where a slack wire is
//! caught, or a body turns by much. The tension is many times what it was, so that the next step may
//! not be stable; nodes go far sideways, and points of bodies along arcs, so that segments become longer
//! than their rows have it: by a hundredth, it may be, that a stiff wire pays back with more energy than
//! there was.
//!
//! So the solution is looked at. A segment that is too short for the tension that it got, if that is
//! [`GROWTH`] times what it was, has that from now on. One that is stretched by another length than its row
//! says has the *mean direction* of the step,
//!
//! ```text
//! t = (s + s+) / (|s| + |s+|),   t (s+ - s) = |s+| - |s|
//! ```
//!
//! with the vectors `s` and `s+` from end to end before and after the step, with which the row has the
//! length right. A body that carries points which come out elsewhere than their rows have it has the mean
//! of its arms in the step,
//!
//! ```text
//! A r,   A = I + (1 - cos a) / a^2 [a] + (a - sin a) / a^3 [a]^2,   a x (A r) = R r - r
//! ```
//!
//! with the rotation `R` by the vector `a`, and its matrix `[a]` of the product `a x`: the points move as far as
//! they do, and forces do the work that they do. Segments on such a body have their mean directions
//! as well: what is between two of its points would seem to change its length otherwise.
//!
//! Then the step is solved again. That is Newton's method: where a segment goes aside by `w` more than was
//! thought, its tension pulls it back with `h T / (|s| + |s+|) P w`, in its *geometric stiffness* (`P`
//! takes the part across). It is there for the difference alone, so that nothing is damped by it at the end. A solution
//! is accepted if the [energy](Followed::error) of what its lengths are off by is less than before; else half
//! of the way to it is tried. After [`ROUNDS`], or when the budget is spent, the best stands.
//!
//! Where that comes to no end and bodies would pay for it, as when a heavy load pulls a slack wire taut within a step, segments get
//! the direction in which the step *ends*,
//!
//! ```text
//! t = s+ / |s+|,   |s+| - |s| = t (s+ - s) + (|s+| - |s| - t (s+ - s))
//! ```
//!
//! where what is in brackets, the [lead](Linearised::lead), is taken from the last solution, and all of the geometric stiffness,
//! `h T / |s+| P w`. The step is then the minimum of a function of the velocities. Where bodies do not turn and nothing is pushed,
//! it is convex: a length is a convex function of the velocities, and the energy of a row grows with it. Newton's method finds such a
//! minimum, mostly within ten rounds. A force along the last direction takes more from what moves than its segment stores, by
//! its impulse times its lead ([`System::damped_by_lead`]). There, no energy comes from nothing; and what swings is damped
//! twice as much as by mean directions, in such steps alone.
//!
//! What lengths may be off by depends on what hangs there. What a wire is off by as a whole it pays back by moving the
//! bodies of its island that far, in a step or so, unless it is too soft for that. A hundredth of the length of a cable may
//! so give a load that spins on it as much energy as it has. Where that is more than [`LARGE`] of the kinetic energy of
//! the island, directions and arms are held to [`FINE`] of what is allowed else. A wire that carries nothing pays nothing
//! back, as its nodes are far too light for what a step resolves. Where contacts push on wires that is not
//! done: they are linear about the start.
//!
//! Bodies whose motion is prescribed are followed like others. What contacts of a wire push on is linear about the start as
//! well: a [body](Held) that is pushed so is not followed, and a segment only if it is off by far more. A solution in
//! which a scripted body is followed and [pushed](Linearisation::suits) does not count: a wire that is fixed to it and touches it
//! would go two ways.

use nalgebra::Matrix3;

use super::body_inertia::is_strong;
use super::carrier::Carrier;
use super::system::System;
use super::transverse::is_short;
use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::model::{BodyId, Node, NodeKind, Wire};
use crate::wire::vector::{Vector, unit};
use crate::wire::world::World;

/// How often a step is solved again.
pub(super) const ROUNDS: usize = 6;

/// How much larger than it was a tension may be. The theory allows `1 / s^2`, but that would damp whatever is pulled
/// in a jerk.
const GROWTH: f64 = 4.0;

/// How far a segment may be from what its row says after the step, as a part of its length. Forces along mean directions
/// damp what swings by `omega^2 h / 4` a second, so what a step follows well is left as it is.
const OFF: f64 = 2e-2;

/// How fast it may get there, in m/s: a heavy load on a long segment would come back as fast.
const SPEED: f64 = 0.5;

/// What lengths may be off by without a closer look, in the energy that is paid back, as a part of the kinetic energy.
const LARGE: f64 = 1e-3;

/// What a closer look allows, as a part of what is allowed else.
const FINE: f64 = 0.05;

/// How many times as much that is for a segment that contacts push on.
const PUSHED: f64 = 3.0;

/// Below this angle in rad series are exact to the last bits.
const SMALL: f64 = 1e-2;

/// How often it is solved again with the directions at its end.
pub(super) const ROUNDS_TO_THE_END: usize = 24;

/// Directions of segments in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Directions {
    /// The mean ones.
    Mean,
    /// Those at its end.
    End,
}

/// What the equations of a step are linear about.
#[derive(Clone)]
pub(super) struct Linearisation {
    /// Which directions segments get that are followed.
    pub(super) directions: Directions,
    /// By wires and segments.
    segments: Vec<Vec<Linearised>>,
    /// By bodies: what takes arms as they are where the step starts to their means; none if they are taken
    /// as they start.
    turns: Vec<Option<Matrix3<f64>>>,
}

/// What the equations of a segment are linear about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Linearised {
    /// The tension in N.
    pub(super) tension: f64,
    /// The direction, by which its row counts velocities; zero if the segment has no length.
    pub(super) along: Vector,
    /// By how much faster it becomes longer than its ends part along that direction, in m/s.
    pub(super) lead: f64,
    /// What pulls it back across that direction, from a solution on.
    pub(super) geometric: Option<GeometricStiffness>,
}

/// `h T / (|s| + |s+|)` or `h T / |s+|` in kg, and how the end of the segment goes from its start in m/s where it has no effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct GeometricStiffness {
    pub(super) stiffness: f64,
    pub(super) way: Vector,
}

/// What contacts of a wire push on: they are linear about the start, and what is between two things of which one is not would be
/// asked to go two ways.
pub(super) struct Held {
    /// By wires and segments: those that are pushed, and those beside them.
    segments: Vec<Vec<bool>>,
    /// By bodies.
    bodies: Vec<bool>,
}

impl Held {
    /// By contacts with these impulses; and scripted bodies with contact nodes.
    pub(super) fn new(world: &World, contacts: &[ContactConstraint], impulses: &[Vector]) -> Self {
        let wires = world.wires.iter();
        let mut held = Held {
            segments: wires.map(|wire| vec![false; wire.segments.len()]).collect(),
            bodies: vec![false; world.bodies.len()],
        };
        // Wire that comes onto a body has its length along the surface.
        for node in world.wires.iter().flat_map(|wire| &wire.nodes) {
            if let NodeKind::Contact { body, .. } = node.kind
                && !world.bodies[body.0].dynamic
            {
                held.bodies[body.0] = true;
            }
        }
        for (contact, impulse) in contacts.iter().zip(impulses) {
            let places = [&contact.a, &contact.b];
            let is_wire = |place: &&ContactSite| matches!(place, ContactSite::Wire { .. });
            if *impulse == Vector::zeros() || !places.iter().any(is_wire) {
                continue;
            }
            for place in places {
                match *place {
                    ContactSite::World => {}
                    ContactSite::Body { body, .. } => held.bodies[body.0] = true,
                    ContactSite::Wire { wire, arc } => {
                        let wire = wire.0;
                        let (segment, _) = world.wires[wire].at(arc);
                        let end = (segment + 2).min(held.segments[wire].len());
                        held.segments[wire][segment.saturating_sub(1)..end].fill(true);
                    }
                }
            }
        }
        held
    }
}

/// Where a solution leads.
pub(super) struct Followed {
    /// What it is linear about to be solved again.
    pub(super) next: Linearisation,
    /// What the lengths of segments that rows do not know of would be in elastic energy, in J.
    pub(super) error: f64,
    /// Whether bodies would be given much of their energy by what lengths are off by.
    pub(super) is_large: bool,
    /// Whether there is a reason to solve again.
    pub(super) is_off: bool,
    /// Whether that is other directions or arms.
    pub(super) has_other_directions: bool,
    /// Whether what it is linear about [suits](Linearisation::suits) its contacts.
    pub(super) suits: bool,
}

impl Linearisation {
    /// About the start of the step: directions as they are there, and the largest tensions of the last
    /// steps.
    pub(super) fn at_start(world: &World) -> Self {
        let wires = world.wires.iter().map(|wire| {
            let segments = wire.segments.iter().enumerate();
            let of = segments.map(|(at, segment)| Linearised {
                tension: segment.largest_tension(),
                along: unit(&wire.span(at)).0,
                lead: 0.0,
                geometric: None,
            });
            of.collect()
        });
        Linearisation {
            directions: Directions::Mean,
            segments: wires.collect(),
            turns: vec![None; world.bodies.len()],
        }
    }

    /// The same to start from with other contacts, where no solution is known: of an island that has other bodies, none of
    /// which carries a node or is moved by forces.
    pub(super) fn of_bodies(&self, before: &[usize], bodies: &[usize]) -> Self {
        let turn = |body| {
            before
                .binary_search(body)
                .ok()
                .and_then(|at| self.turns[at])
        };
        let without_solution = |own: &Linearised| Linearised {
            geometric: None,
            ..*own
        };
        let segments = self.segments.iter();
        Linearisation {
            directions: self.directions,
            segments: segments
                .map(|own| own.iter().map(without_solution).collect())
                .collect(),
            turns: bodies.iter().map(turn).collect(),
        }
    }

    /// The same, whose solution is followed by the directions at its end.
    pub(super) fn to_the_end(&self) -> Self {
        Linearisation {
            directions: Directions::End,
            ..self.clone()
        }
    }

    /// That of a segment of a wire.
    pub(super) fn of(&self, wire: usize, segment: usize) -> &Linearised {
        &self.segments[wire][segment]
    }

    /// From a body's centre of mass to a point of it that carries a node.
    pub(super) fn arm(&self, world: &World, body: BodyId, local: &Vector) -> Vector {
        let arm = world.bodies[body.0].arm(local);
        match &self.turns[body.0] {
            Some(turn) => turn * arm,
            None => arm,
        }
    }

    /// Whether contacts push on no scripted body that it follows: nodes on it go along arcs then, and contacts straight on.
    fn suits(&self, world: &World, held: &Held) -> bool {
        let mut bodies = world.bodies.iter().zip(&self.turns).zip(&held.bodies);
        !bodies.any(|((body, turn), is_held)| !body.dynamic && turn.is_some() && *is_held)
    }

    /// A part of the way to another one.
    pub(super) fn towards(&self, other: &Self, part: f64) -> Self {
        if part == 1.0 {
            return other.clone();
        }
        let mut between = other.clone();
        let from = self.segments.iter().flatten();
        for (to, from) in between.segments.iter_mut().flatten().zip(from) {
            to.along = to.along * part + from.along * (1.0 - part);
        }
        for (to, from) in between.turns.iter_mut().zip(&self.turns) {
            if let Some(to) = to {
                *to = *to * part + from.unwrap_or_else(Matrix3::identity) * (1.0 - part);
            }
        }
        between
    }

    /// Follows the solution `x` of a system that is linear about this, but for what contacts [hold](Held).
    pub(super) fn follow(
        &self,
        world: &World,
        system: &System,
        held: &Held,
        x: &[f64],
    ) -> Followed {
        let step = world.settings.step;
        let bodies = world.bodies.iter().zip(&system.layout.bodies);
        let turns = bodies.zip(&held.bodies).map(|((body, first), is_held)| {
            let spin = match first {
                Some(first) => Carrier::Free(first + 3).velocity(x),
                None => body.prescribed(world.time(), step).1,
            };
            let turn = spin * step;
            let is_followed = !is_held && turn != Vector::zeros();
            is_followed.then(|| (turn, mean_turn(&turn)))
        });
        let turns: Vec<Option<(Vector, Matrix3<f64>)>> = turns.collect();
        // How far a node comes out beside where its rows have it.
        let aside = |node: &Node| {
            let (body, local) = node.kind.carrier()?;
            let (turn, mean) = turns[body.0]?;
            let arm = mean * world.bodies[body.0].arm(&local);
            Some((body, turn.cross(&(arm - self.arm(world, body, &local)))))
        };
        let mut followed = Followed {
            next: self.clone(),
            error: 0.0,
            is_large: false,
            is_off: false,
            has_other_directions: false,
            suits: self.suits(world, held),
        };
        // How far what is carried by each body is aside, in parts of what is allowed.
        let mut turned = vec![0.0_f64; turns.len()];
        // Where segments go that may have to be followed.
        let mut paths = Vec::new();
        let mut rows = system.rows.iter();
        let mass = world.mass_of_bodies();
        let mut paid = 0.0;
        for (at, wire) in world.wires.iter().enumerate() {
            let push = wire.largest_push(step);
            let mut off_by = 0.0;
            for (segment, row) in (0..wire.segments.len()).zip(rows.by_ref()) {
                let own = &self.segments[at][segment];
                let tension = row.impulse(x) / step;
                // Before the first step no tension is known.
                let is_short = || world.steps > 0 && is_short(world, at, segment, tension);
                let is_more = tension > GROWTH * own.tension;
                if is_more && (is_short() || is_strong(world, at, segment, tension)) {
                    followed.next.segments[at][segment].tension = tension;
                    followed.is_off = true;
                }
                let rest = wire.rest_length(segment);
                let allowed = f64::min(OFF * rest, SPEED * step);
                let asides = [segment, segment + 1].map(|node| aside(&wire.nodes[node]));
                for (body, aside) in asides.iter().flatten() {
                    turned[body.0] = turned[body.0].max(aside.norm() / allowed);
                }
                let is_held = held.segments[at][segment];
                let allowed = if is_held { PUSHED * allowed } else { allowed };
                let [from, to] = asides.map(|aside| aside.map_or_else(Vector::zeros, |of| of.1));
                let span = wire.span(segment);
                let way = row.way(x);
                let end = span + way * step + to - from;
                let Some(off) = own.off(wire, segment, push, &(end - span), step) else {
                    continue;
                };
                let stiffness = wire.material.stretch_stiffness() / rest;
                followed.error += stiffness * off * off / 2.0;
                off_by += off;
                let carriers = if is_held {
                    [None; 2]
                } else {
                    carriers(wire, segment)
                };
                let off = off / allowed;
                let (along, lengths, lead, way) = match self.directions {
                    Directions::Mean if off <= FINE && carriers == [None; 2] => continue,
                    Directions::Mean => {
                        let along = mean_direction(&span, &end);
                        (along, span.norm() + end.norm(), 0.0, way)
                    }
                    Directions::End => {
                        let ((along, length), way) = (unit(&end), (end - span) / step);
                        let lead = (length - span.norm()) / step - along.dot(&way);
                        (along, length, lead, way)
                    }
                };
                let pulls = tension > 0.0 && along != Vector::zeros();
                let next = Linearised {
                    tension: followed.next.segments[at][segment].tension,
                    along,
                    lead,
                    geometric: pulls.then(|| GeometricStiffness {
                        stiffness: step * step * tension / lengths,
                        way,
                    }),
                };
                paths.push(Path {
                    wire: at,
                    segment,
                    carriers,
                    off,
                    next,
                });
            }
            let stiffness = wire.material.stretch_stiffness() / wire.length();
            let moved = mass / (step * step);
            paid += f64::min(stiffness, moved) * off_by * off_by / 2.0;
        }
        let is_pushed = held.segments.iter().flatten().any(|is_held| *is_held);
        followed.is_large = paid > LARGE * world.kinetic_energy();
        let is_fine = match self.directions {
            Directions::Mean => followed.is_large && !is_pushed,
            Directions::End => true,
        };
        let allowed = if is_fine { FINE } else { 1.0 };
        let is_off = paths.iter().any(|path| path.off > allowed);
        if !is_off && turned.iter().all(|turned| *turned <= allowed) {
            return followed;
        }
        let mut is_turned: Vec<bool> = turned.iter().map(|turned| *turned > allowed).collect();
        let paths = match self.directions {
            Directions::Mean => followed_together(paths, allowed, &mut is_turned),
            Directions::End => {
                is_turned.fill(true);
                paths
            }
        };
        for path in paths {
            followed.next.segments[path.wire][path.segment] = path.next;
            followed.has_other_directions = true;
        }
        let bodies = followed.next.turns.iter_mut().zip(&turns);
        for ((next, turn), _) in bodies.zip(is_turned).filter(|(_, is_turned)| *is_turned) {
            *next = turn.map(|(_, mean)| mean);
            followed.has_other_directions = true;
        }
        followed.is_off |= followed.has_other_directions;
        followed
    }
}

impl Linearised {
    /// By how much a segment whose end goes this way from its start is stretched by another length than its row
    /// has. What it is shorter by than its largest push asks for does not count; none if it has no length, or
    /// is so short by the row as well.
    fn off(&self, wire: &Wire, segment: usize, push: f64, way: &Vector, step: f64) -> Option<f64> {
        let rest = wire.rest_length(segment);
        let least = -push * rest / wire.material.stretch_stiffness();
        let span = wire.span(segment);
        let before = span.norm();
        let lengths = [
            (span + way).norm(),
            before + self.along.dot(way) + step * self.lead,
        ];
        let [after, by_row] = lengths.map(|length| (length - rest).max(least));
        let counts = before > 0.0 && (after > least || by_row > least);
        counts.then(|| (after - by_row).abs())
    }
}

/// Where a segment goes that may have to be followed.
struct Path {
    wire: usize,
    segment: usize,
    /// The bodies at its ends; none where contacts push on it.
    carriers: [Option<BodyId>; 2],
    /// By how much its length is another one than its row says, in parts of what is allowed.
    off: f64,
    /// What it is linear about if it is followed.
    next: Linearised,
}

/// Those that are off by more than is allowed, and what goes with them: a body with mean arms has segments with mean directions on it,
/// and the other way round, as they would turn it else.
fn followed_together(paths: Vec<Path>, allowed: f64, is_turned: &mut [bool]) -> Vec<Path> {
    let (mut followed, mut others): (Vec<_>, Vec<_>) =
        paths.into_iter().partition(|path| path.off > allowed);
    let mut new = 0;
    loop {
        for path in &followed[new..] {
            let bodies = path.carriers.iter().flatten();
            bodies.for_each(|body| is_turned[body.0] = true);
        }
        new = followed.len();
        let is_carried = |path: &mut Path| {
            let mut bodies = path.carriers.iter().flatten();
            bodies.any(|body| is_turned[body.0])
        };
        followed.extend(others.extract_if(.., is_carried));
        if followed.len() == new {
            return followed;
        }
    }
}

/// The bodies that carry the ends of a segment.
fn carriers(wire: &Wire, segment: usize) -> [Option<BodyId>; 2] {
    [segment, segment + 1].map(|node| wire.nodes[node].kind.carrier().map(|(body, _)| body))
}

/// `(s + s+) / (|s| + |s+|)`, zero if both are.
fn mean_direction(start: &Vector, end: &Vector) -> Vector {
    let lengths = start.norm() + end.norm();
    if lengths > 0.0 {
        (start + end) / lengths
    } else {
        Vector::zeros()
    }
}

/// The mean of the rotations by parts of the vector `turn`, in rad, from none to all of it.
fn mean_turn(turn: &Vector) -> Matrix3<f64> {
    let angle = turn.norm();
    let square = angle * angle;
    // The next terms are below 1e-12 of the first ones.
    let (first, second) = if angle < SMALL {
        let first = 0.5 - square / 24.0 * (1.0 - square / 30.0);
        (first, 1.0 / 6.0 - square / 120.0 * (1.0 - square / 42.0))
    } else {
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        ((1.0 - cos) / square, (angle - sin) / (square * angle))
    };
    let cross = turn.cross_matrix();
    Matrix3::identity() + cross * first + cross * cross * second
}

#[cfg(test)]
mod tests;
