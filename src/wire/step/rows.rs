//! The rows of stretch, bend and twist.

use nalgebra::Matrix3;
use smallvec::{SmallVec, smallvec};

use super::carrier::{Carrier, Layout};
use super::constitutive::{Branch, ConstitutiveLaw};
use super::linearisation::Linearisation;
use super::softness::Softness;
use crate::wire::contact::ContactConstraint;
use crate::wire::model::Wire;
use crate::wire::settings::Settings;
use crate::wire::torsion::Torsion;
use crate::wire::vector::{Vector, unit};
use crate::wire::world::World;

/// One row of `G v+ + Sigma lambda = target`.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// The unknown that is its multiplier.
    pub(super) multiplier: usize,
    /// Carriers, and the direction along which each one's velocity counts.
    pub(super) terms: SmallVec<[(Carrier, Vector); 3]>,
    /// Unknown speeds of sliding, and what they count.
    pub(super) slides: SmallVec<[(usize, f64); 2]>,
    /// What the row's velocity is less by, in m/s: what is let out of a segment.
    pub(super) fed: f64,
    /// What the row's velocity is more by, in m/s: what a segment becomes longer by beside the [direction](super::linearisation) that it
    /// has.
    pub(super) lead: f64,
    /// What it gives way to a force, in m/N, or to a moment, in 1/(N m); 0 for friction.
    pub(super) compliance: f64,
    /// The damping time in s.
    pub(super) damping: f64,
    /// Regularisation in 1/kg.
    pub(super) sigma: f64,
    /// What the row asks for, in m/s or 1/s, prescribed velocities included on the left.
    pub(super) target: f64,
    /// How the multiplier follows from the excess.
    pub(super) law: ConstitutiveLaw,
    /// The branch of the law that is solved with.
    pub(super) branch: Branch,
    /// Where contacts are in the system, the laws of segments that may push with all they can are softened.
    pub(super) softened: Option<Softened>,
}

/// The law of a segment, which gives way to a multiplier that was not predicted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Softened {
    pub(super) softness: Softness,
    /// The largest push in N s.
    most: f64,
    /// The predicted multiplier in N s.
    pub(super) predicted: f64,
}

impl Softened {
    /// Predicts a multiplier, or the largest push.
    pub(super) fn predict(&mut self, multiplier: f64) {
        self.predicted = multiplier.max(-self.most);
    }
}

impl Row {
    /// Calls back for each column and value of the row.
    pub(super) fn each_column(&self, mut take: impl FnMut(usize, f64)) {
        for (carrier, direction) in &self.terms {
            carrier.each_column(direction, &mut take);
        }
        for &(column, value) in &self.slides {
            take(column, value);
        }
    }

    /// `G v` of the velocities that are prescribed.
    pub(super) fn given(&self) -> f64 {
        let terms = self.terms.iter();
        terms.fold(self.lead - self.fed, |sum, (carrier, direction)| {
            sum + carrier.prescribed_velocity().dot(direction)
        })
    }

    /// `G v` for a solution.
    pub(super) fn velocity(&self, x: &[f64]) -> f64 {
        let terms = self.terms.iter();
        let of_points = terms.fold(self.lead - self.fed, |sum, (carrier, direction)| {
            sum + carrier.velocity(x).dot(direction)
        });
        let slides = self.slides.iter();
        slides.fold(of_points, |sum, &(column, value)| sum + value * x[column])
    }

    /// Its multiplier for a solution, in N s or N m s.
    pub(super) fn impulse(&self, x: &[f64]) -> f64 {
        x[self.multiplier] + self.branch.offset
    }

    /// How fast the second carrier leaves the first for a solution, in m/s: of a row of stretch.
    pub(super) fn way(&self, x: &[f64]) -> Vector {
        self.terms[1].0.velocity(x) - self.terms[0].0.velocity(x)
    }

    /// `G v - target` for a solution.
    pub(super) fn excess(&self, x: &[f64]) -> f64 {
        self.velocity(x) - self.target
    }

    /// The largest magnitude that its velocity and target are summed up from.
    pub(super) fn speed(&self, x: &[f64]) -> f64 {
        let of = |carrier: &Carrier| carrier.velocity(x).amax();
        let terms = self.terms.iter().map(|(carrier, _)| of(carrier));
        let slides = self.slides.iter().map(|&(column, _)| x[column].abs());
        terms.chain(slides).fold(self.target.abs(), f64::max)
    }

    /// The energy in J that the force of a solution stores. With SPOOK the force is `f = (e + tau G v+) / eps`, with
    /// `e` as the row is halfway. What damping adds to a force stores nothing, and what it takes from one
    /// is never given back: so it is `min(|e|, |eps f|)^2 / (2 eps)`, and 0 where damping alone gives the force.
    /// Of a segment that has buckled `f` is what it would have, and what it is shorter is stored at the force that it has.
    pub(super) fn elastic_energy(&self, x: &[f64], step: f64) -> f64 {
        let has_buckled = self.branch.offset != 0.0;
        let impulse = if has_buckled {
            self.excess(x) / self.sigma
        } else {
            x[self.multiplier]
        };
        let force = impulse / step;
        if force == 0.0 || self.compliance == 0.0 {
            return 0.0;
        }
        let way = self.compliance * force.abs();
        let added = self.damping * self.velocity(x) * force.signum();
        let stored = (way - added.max(0.0)).max(0.0);
        let most = -self.branch.offset / step;
        let beyond = if has_buckled {
            (stored - self.compliance * most).max(0.0)
        } else {
            0.0
        };
        let elastic = stored - beyond;
        elastic * elastic / (2.0 * self.compliance) + most * beyond
    }

    /// What the velocities that are prescribed do by the multiplier of a solution, in J.
    pub(super) fn work(&self, x: &[f64]) -> f64 {
        let is_given = |(carrier, _): &(Carrier, Vector)| matches!(carrier, Carrier::Prescribed(_));
        if self.fed == 0.0 && !self.terms.iter().any(is_given) {
            return 0.0;
        }
        (self.given() - self.lead) * self.impulse(x)
    }

    /// Whether the solution decides which branch holds.
    pub(super) fn may_change(&self) -> bool {
        match self.law {
            ConstitutiveLaw::Linear => false,
            // A segment without length has no direction.
            ConstitutiveLaw::LimitedPush { .. } => {
                let mut terms = self.terms.iter();
                terms.any(|(_, along)| along.norm_squared() > 0.0)
            }
            ConstitutiveLaw::Friction { .. } => true,
        }
    }

    /// Softens the law of a segment near a predicted multiplier if it may well be at its largest push, as a chain always
    /// may, and takes the branch that gives it. `masses` is the diagonal of the mass matrix.
    pub(super) fn soften(&mut self, masses: &[f64], predicted: f64) {
        let ConstitutiveLaw::LimitedPush { most } = self.law else {
            return;
        };
        let is_far = most > 0.0 && predicted > -most / 2.0;
        if is_far || !self.may_change() {
            return;
        }
        let mut mobility = 0.0;
        self.each_column(|column, value| mobility += value * value / masses[column]);
        // What nothing can move has no velocity to find.
        if mobility > 0.0 {
            self.softened = Some(Softened {
                softness: Softness::new(mobility),
                most,
                predicted: predicted.max(-most),
            });
        }
    }

    /// Lets a segment that resists bending push with whatever it has to.
    pub(super) fn let_push(&mut self) {
        if matches!(self.law, ConstitutiveLaw::LimitedPush { most } if most > 0.0) {
            self.law = ConstitutiveLaw::Linear;
            if self.branch.offset != 0.0 {
                self.branch = Branch::ACTIVE;
            }
        }
    }

    /// What the multiplier changes of the row's velocity, in 1/kg.
    pub(super) fn regularisation(&self) -> f64 {
        let soft = self.softened.as_ref();
        self.sigma + soft.map_or(0.0, |soft| soft.softness.compliance)
    }

    /// The branch of the law, softened or not, at an excess.
    pub(super) fn branch_at(&self, excess: f64) -> Branch {
        match &self.softened {
            None => self.law.branch(excess, self.sigma),
            Some(soft) => {
                let start = -soft.softness.compliance * soft.predicted;
                Branch::of_push(excess, start, self.regularisation(), soft.most)
            }
        }
    }

    /// Takes the branch that holds at a solution, or, of a law that is softened, that which gives
    /// what was predicted. Returns whether this changes the system.
    pub(super) fn take_branch(&mut self, x: &[f64], predicted: bool) -> bool {
        let excess = match &self.softened {
            Some(soft) if predicted && soft.predicted > -soft.most => self.sigma * soft.predicted,
            _ => self.excess(x),
        };
        let branch = self.branch_at(excess);
        let changed = (branch.active, branch.start) != (self.branch.active, self.branch.start);
        self.branch = branch;
        changed
    }

    /// Lets a wire stick whose friction has a branch that lets it slide too far. Returns whether it
    /// has.
    pub(super) fn stick_if_too_far(&mut self, x: &[f64], accepted: f64) -> bool {
        let is_friction = matches!(self.law, ConstitutiveLaw::Friction { .. });
        let is_too_far = is_friction
            && self.may_change()
            && self.branch.slides_too_far(self.excess(x), accepted);
        if is_too_far {
            self.branch = Branch::ALWAYS;
        }
        is_too_far
    }

    /// How far velocities are off at a solution because the law is not the branch that was taken, and
    /// because another multiplier was predicted, in m/s; zeros for a law that is not softened.
    pub(super) fn residuals(&self, x: &[f64]) -> [f64; 2] {
        let Some(soft) = &self.softened else {
            return [0.0; 2];
        };
        let (excess, sigma) = (self.excess(x), self.regularisation());
        let due = self.branch_at(excess).load(excess, sigma);
        let off = (due - self.branch.load(excess, sigma)).abs() / sigma;
        let unforeseen = (self.impulse(x).max(-soft.most) - soft.predicted).abs();
        [
            off * soft.softness.mobility,
            unforeseen * soft.softness.compliance,
        ]
    }

    /// Makes the multiplier of a solution the next prediction.
    pub(super) fn update_prediction(&mut self, x: &[f64]) {
        let impulse = self.impulse(x);
        if let Some(soft) = &mut self.softened {
            soft.predict(impulse);
        }
    }

    /// Gives way less to what is not predicted.
    pub(super) fn harden(&mut self) {
        if let Some(soft) = &mut self.softened {
            soft.softness.harden();
        }
    }

    /// Whether it is friction that lets no wire slide.
    pub(super) fn sticks(&self) -> bool {
        let friction = matches!(self.law, ConstitutiveLaw::Friction { .. });
        friction && self.branch.active && self.branch.start == 0.0
    }

    /// Whether it is friction of a wire that slides, which has a bound.
    pub(super) fn slides_over(&self) -> bool {
        let ConstitutiveLaw::Friction { factor, .. } = self.law else {
            return false;
        };
        factor < 1.0 && !self.sticks()
    }

    /// The constant part of the multiplier, which is in no unknown.
    pub(super) fn each_offset(&self, mut take: impl FnMut(usize, f64)) {
        let offset = self.branch.offset;
        if offset != 0.0 {
            self.each_column(|column, value| take(column, value * offset));
        }
    }
}

/// The numbers of SPOOK for one kind of row.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spook {
    /// `Sigma = 4/h^2 eps / (1 + 4 tau/h)`.
    pub(super) sigma: f64,
    /// `Upsilon = 1 / (1 + 4 tau/h)`.
    pub(super) upsilon: f64,
    step: f64,
    /// `tau`.
    damping: f64,
}

/// The least damping time of what pulls or pushes to one side alone, in steps. Without one, what is far stiffer than a step
/// resolves has the eigenvalue -1 twice: it grows where all is linear, and without bound where things become taut or touch. With
/// this it loses more than two fifths in each step, and what swings at `omega` and is resolved `omega^2 h / 4` a second.
const LEAST_DAMPING: f64 = 0.5;

impl Spook {
    /// `compliance` is eps, `damping` the damping time tau in s.
    pub(super) fn new(compliance: f64, damping: f64, step: f64) -> Self {
        let upsilon = 1.0 / (1.0 + 4.0 * damping / step);
        Spook {
            sigma: 4.0 / (step * step) * compliance * upsilon,
            upsilon,
            step,
            damping,
        }
    }

    /// That of what pulls or pushes to one side alone: with [`LEAST_DAMPING`] steps at least.
    fn one_sided(compliance: f64, damping: f64, step: f64) -> Self {
        Spook::new(compliance, damping.max(LEAST_DAMPING * step), step)
    }

    /// `-(4/h) Upsilon g + Upsilon G v`, what the row asks for.
    pub(super) fn target(&self, violation: f64, velocity: f64) -> f64 {
        self.upsilon * (velocity - 4.0 / self.step * violation)
    }
}

/// What the normal row asks for and its regularisation. Apart, `J v+ >= -g/h`; where the two
/// penetrate, a SPOOK row, which forgets the velocity of an impact.
pub(super) fn normal_row(settings: &Settings, contact: &ContactConstraint, speed: f64) -> [f64; 2] {
    if contact.gap >= 0.0 {
        return [-contact.gap / settings.step, 0.0];
    }
    let damping = settings.contact_damping * settings.step;
    let spook = Spook::one_sided(settings.contact_compliance, damping, settings.step);
    let kept = if speed < -settings.impact_speed {
        0.0
    } else {
        speed
    };
    [spook.target(contact.gap, kept), spook.sigma]
}

/// The rows of all wires: first those of stretch, one for each segment in order, then those of
/// bend, then those of twist.
pub(super) fn rows(world: &World, linearisation: &Linearisation, layout: &Layout) -> Vec<Row> {
    let mut rows = Vec::with_capacity(layout.stretch.len() + 3 * layout.bend.len());
    for (at, (wire, &first)) in world.wires.iter().zip(&layout.first_node).enumerate() {
        let step = world.settings.step;
        let most = step * wire.largest_push(step);
        for segment in 0..wire.segments.len() {
            let multiplier = layout.stretch[rows.len()];
            let ends = [first + segment, first + segment + 1];
            let carriers = ends.map(|node| layout.nodes[node]);
            let linear = linearisation.of(at, segment);
            let mut row = stretch(
                wire,
                segment,
                linear.along,
                carriers,
                multiplier,
                most,
                step,
            );
            row.lead = linear.lead;
            // Arc length that moves over its nodes changes what the segment is unstretched.
            let slides = ends.into_iter().zip([1.0, -1.0]);
            row.slides = slides
                .filter_map(|(node, value)| layout.slides[node].map(|column| (column, value)))
                .collect();
            if segment + 1 == wire.segments.len() {
                row.fed = wire.reel_speed(world.time(), step);
            }
            rows.push(row);
        }
    }
    for (wire, &first) in world.wires.iter().zip(&layout.first_node) {
        for node in 0..wire.nodes.len() {
            if let Some(multiplier) = layout.bend[first + node] {
                let at = first + node;
                let three = [layout.nodes[at - 1], layout.nodes[at], layout.nodes[at + 1]];
                rows.extend(bend(wire, node, three, multiplier, &world.settings));
            }
        }
    }
    let wires = 0..world.wires.len();
    rows.extend(wires.filter_map(|wire| twist(world, layout, wire)));
    rows
}

/// `g = |d| - l0`, `G = [-t, t]`, `eps = l0 / (E A)`, with the direction `t` that the step is linear about. A
/// segment without length has no direction: its row does not count. It pushes with `most` N s at
/// most, from [`Wire::largest_push`].
fn stretch(
    wire: &Wire,
    segment: usize,
    along: Vector,
    [start, end]: [Carrier; 2],
    multiplier: usize,
    most: f64,
    step: f64,
) -> Row {
    let (t, length) = unit(&wire.span(segment));
    let rest = wire.rest_length(segment);
    let material = &wire.material;
    let compliance = rest / material.stretch_stiffness();
    let spook = Spook::one_sided(compliance, material.stretch_damping, step);
    let nodes = &wire.nodes[segment..segment + 2];
    let sliding = nodes[1].slide - nodes[0].slide;
    let speed = (nodes[1].velocity - nodes[0].velocity).dot(&t) - sliding;
    let law = ConstitutiveLaw::LimitedPush { most };
    let is_buckled = length < rest && step * wire.segments[segment].tension <= -most;
    Row {
        multiplier,
        terms: smallvec![(start, -along), (end, along)],
        slides: SmallVec::new(),
        fed: 0.0,
        lead: 0.0,
        compliance,
        damping: spook.damping,
        sigma: spook.sigma,
        target: spook.target(length - rest, speed),
        law,
        branch: if length == 0.0 {
            Branch::INACTIVE
        } else {
            let excess = if is_buckled {
                f64::NEG_INFINITY
            } else {
                f64::INFINITY
            };
            law.branch(excess, spook.sigma)
        },
        softened: None,
    }
}

/// `g = t2 - t1`, `d t1 = [-P1/l1, P1/l1, 0]`, `d t2 = [0, -P2/l2, P2/l2]`, `eps = l_mean / (E I)`.
fn bend(
    wire: &Wire,
    node: usize,
    carriers: [Carrier; 3],
    multiplier: usize,
    settings: &Settings,
) -> impl Iterator<Item = Row> {
    let [(t1, l1), (t2, l2)] = [wire.span(node - 1), wire.span(node)].map(|span| unit(&span));
    let mean = (wire.rest_length(node - 1) + wire.rest_length(node)) / 2.0;
    let compliance = mean / wire.material.bend_stiffness();
    let spook = Spook::new(compliance, wire.material.bend_damping, settings.step);
    let active = l1 > 0.0 && l2 > 0.0;
    let across = |t: &Vector, l: f64| {
        let projection = Matrix3::identity() - t * t.transpose();
        if active {
            projection / l
        } else {
            Matrix3::zeros()
        }
    };
    let (p1, p2) = (across(&t1, l1), across(&t2, l2));
    let jacobian = [p1, -(p1 + p2), p2];
    let nodes = &wire.nodes[node - 1..node + 2];
    let turning = p1 * nodes[0].velocity + p2 * nodes[2].velocity - (p1 + p2) * nodes[1].velocity;
    (0..3).map(move |axis| {
        let term = |i: usize| (carriers[i], jacobian[i].row(axis).transpose());
        Row {
            multiplier: multiplier + axis,
            terms: smallvec![term(0), term(1), term(2)],
            slides: SmallVec::new(),
            fed: 0.0,
            lead: 0.0,
            compliance,
            damping: spook.damping,
            sigma: spook.sigma,
            target: spook.target((t2 - t1)[axis], turning[axis]),
            law: ConstitutiveLaw::Linear,
            branch: if active {
                Branch::ACTIVE
            } else {
                Branch::INACTIVE
            },
            softened: None,
        }
    })
}

/// `g = Theta`, `eps = l / (G J)`; `G` by all nodes and by what clamps the ends.
fn twist(world: &World, layout: &Layout, at: usize) -> Option<Row> {
    let multiplier = layout.twist[at]?;
    let wire = &world.wires[at];
    let torsion = Torsion::of(wire, &world.bodies)?;
    let compliance = wire.twisted_length() / wire.material.twist_stiffness();
    let spook = Spook::new(compliance, wire.material.twist_damping, world.settings.step);
    let nodes = layout.nodes[layout.first_node[at]..].iter().copied();
    let nodes = nodes.zip(torsion.gradient.iter().copied());
    let ends = torsion.ends.iter();
    let ends = ends.map(|&(clamp, by)| (layout.spin(world, clamp), by));
    Some(Row {
        multiplier,
        terms: nodes.chain(ends).collect(),
        slides: SmallVec::new(),
        fed: 0.0,
        lead: 0.0,
        compliance,
        damping: spook.damping,
        sigma: spook.sigma,
        target: spook.target(wire.twist, torsion.rate(wire, &world.bodies)),
        law: ConstitutiveLaw::Linear,
        branch: Branch::ACTIVE,
        softened: None,
    })
}
