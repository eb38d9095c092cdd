//! The system of one step: `[[M~, G^T], [G, -Sigma]] [v+; -lambda] = [M~ v + h f; target]`, where
//! `M~` is the mass and [what there is beside it](super::added_inertia).

use super::added_inertia::{AddedInertias, added_inertias};
use super::capstan;
use super::carrier::{Carrier, Columns, Layout};
use super::constitutive::Branch;
use super::implicit::Implicit;
use super::linearisation::Linearisation;
use super::order::Block;
use super::rows::{Row, rows};
use super::spin::spin_freely;
use super::start::Start;
use super::transverse::SteepSegment;
use crate::wire::contact::ContactConstraint;
use crate::wire::error::Reason;
use crate::wire::sparse::{Ldl, SparseColumns, Structure, Symmetric, Triplets};
use crate::wire::vector::{Vector, frame};
use crate::wire::world::World;

/// The largest backward error of a solution that is accepted.
pub(super) const RESIDUAL: f64 = 1e-10;

/// How often a solution above it is refined, after the first time.
const MORE_REFINEMENTS: usize = 4;

/// The equations of motion, of nodes, bodies and what slides over contact nodes, and the rows of
/// all wires, ready to be factored.
pub(super) struct System {
    pub(super) layout: Layout,
    pub(super) rows: Vec<Row>,
    /// What there is beside the masses.
    pub(super) inertias: AddedInertias,
    /// Contacts that are solved with the rest.
    pub(super) implicit: Vec<Implicit>,
    /// How they are.
    pub(super) method: ContactMethod,
    /// Entries: first those of masses, then those of contacts and rows.
    triplets: Triplets,
    mass_entries: usize,
    /// Whether an unknown is a velocity.
    is_velocity: Vec<bool>,
    right: Vec<f64>,
    structure: Option<Structure>,
    /// Factorisations so far.
    pub(super) factorisations: usize,
}

/// How the linearised laws of contacts are solved with the rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum ContactMethod {
    /// They are in the matrix that is factored.
    InMatrix,
    /// By [conjugate gradients](super::conjugate_gradients), with the factor of everything else.
    ByGradients,
}

impl System {
    /// Puts the system of the next step together. `structure` is that of the last one.
    pub(super) fn new(
        world: &World,
        linearisation: &Linearisation,
        order: &[Block],
        structure: Option<Structure>,
    ) -> Self {
        let inertias = added_inertias(world, linearisation);
        let layout = Layout::new(world, linearisation, order, &inertias.nodes);
        let mut rows = rows(world, linearisation, &layout);
        rows.extend(capstan::friction_rows(world, &layout));
        let mut system = System {
            triplets: Triplets::default(),
            mass_entries: 0,
            is_velocity: vec![true; layout.size],
            right: vec![0.0; layout.size],
            structure,
            factorisations: 0,
            layout,
            rows,
            inertias,
            implicit: Vec::new(),
            method: ContactMethod::InMatrix,
        };
        for row in &system.rows {
            system.is_velocity[row.multiplier] = false;
        }
        for first in system.layout.steep.iter().flatten() {
            system.is_velocity[*first..first + 3].fill(false);
        }
        system.add_nodes(world);
        system.add_bodies(world);
        system.add_inertia_terms();
        system.add_steep_segments();
        system.add_geometric_stiffness(world, linearisation);
        system.mass_entries = system.triplets.index.len();
        system
    }

    /// Mass and momentum of every node, to whatever carries it.
    fn add_nodes(&mut self, world: &World) {
        let fall = world.settings.gravity * world.settings.step;
        for (wire, &first) in world.wires.iter().zip(&self.layout.first_node) {
            for (i, node) in wire.nodes.iter().enumerate() {
                let mass = wire.node_mass(i);
                let velocity = node.velocity + fall;
                if let Some(column) = self.layout.slides[first + i] {
                    self.triplets.add(column, column, mass);
                    self.right[column] += mass * node.slide + capstan::fall(wire, i).dot(&fall);
                }
                let carrier = self.layout.nodes[first + i];
                if let Carrier::Free(first) = carrier {
                    for axis in 0..3 {
                        self.triplets.add(first + axis, first + axis, mass);
                        self.right[first + axis] += mass * velocity[axis];
                    }
                    continue;
                }
                for axis in 0..3 {
                    let mut columns = Columns::new();
                    let along = Vector::ith(axis, 1.0);
                    carrier.columns(&along, &mut columns);
                    self.triplets.add_outer(&columns, mass);
                    push(&mut self.right, &columns, mass * velocity[axis]);
                }
            }
        }
    }

    fn add_bodies(&mut self, world: &World) {
        let step = world.settings.step;
        for (body, first) in world.bodies.iter().zip(&self.layout.bodies) {
            let Some(first) = *first else { continue };
            let inertia = body.world_inertia();
            let local = body
                .orientation
                .inverse_transform_vector(&body.angular_velocity);
            let spin = body.orientation * spin_freely(&body.inertia, &local, step);
            let momentum = (body.velocity + world.settings.gravity * step) * body.mass;
            let spinning = inertia * spin;
            for i in 0..3 {
                self.triplets.add(first + i, first + i, body.mass);
                for j in i..3 {
                    self.triplets
                        .add(first + 3 + i, first + 3 + j, inertia[(i, j)]);
                }
                self.right[first + i] += momentum[i];
                self.right[first + 3 + i] += spinning[i];
            }
        }
    }

    /// What there is at bodies, and at segments that are too short, and not steep.
    fn add_inertia_terms(&mut self) {
        for term in &self.inertias.terms {
            let mut momentum = Vector::zeros();
            let mut columns: [Columns; 3] = Default::default();
            for (wire, node, part) in &term.nodes {
                let carrier = self.layout.nodes[self.layout.first_node[*wire] + node];
                momentum -= part * carrier.prescribed_velocity();
                for (axis, columns) in columns.iter_mut().enumerate() {
                    carrier.columns(&part.row(axis).transpose(), columns);
                }
            }
            if let Some((body, parts)) = term.body
                && let Some(first) = self.layout.bodies[body]
            {
                for (part, first) in parts.iter().zip([first, first + 3]) {
                    for (axis, columns) in columns.iter_mut().enumerate() {
                        Carrier::Free(first).columns(&part.row(axis).transpose(), columns);
                    }
                }
            }
            momentum *= term.mass;
            for (columns, momentum) in columns.iter().zip(&momentum) {
                self.triplets.add_outer(columns, term.mass);
                push(&mut self.right, columns, *momentum);
            }
        }
    }

    /// The [geometric stiffness](super::linearisation) of segments, which is there for what a solution differs from the last
    /// one.
    fn add_geometric_stiffness(&mut self, world: &World, linearisation: &Linearisation) {
        for (at, wire) in world.wires.iter().enumerate() {
            for segment in 0..wire.segments.len() {
                let linear = linearisation.of(at, segment);
                let Some(geometric) = linear.geometric else {
                    continue;
                };
                let node = self.layout.first_node[at] + segment;
                let [start, end] = [node, node + 1].map(|node| self.layout.nodes[node]);
                let given = end.prescribed_velocity() - start.prescribed_velocity();
                let frame = frame(&linear.along.normalize());
                for across in [1, 2].map(|row| frame.row(row).transpose()) {
                    let mut columns = Columns::new();
                    start.columns(&-across, &mut columns);
                    end.columns(&across, &mut columns);
                    self.triplets.add_outer(&columns, geometric.stiffness);
                    let impulse = geometric.stiffness * across.dot(&(geometric.way - given));
                    push(&mut self.right, &columns, impulse);
                }
            }
        }
    }

    /// `K_s z` in the equations of motion, and `K_s v - (c M + K_s) z = 0`.
    fn add_steep_segments(&mut self) {
        for node in &self.inertias.nodes {
            let at = self.layout.first_node[node.wire] + node.node;
            let Some(first) = self.layout.steep[at] else {
                continue;
            };
            let own = node.followed / (node.needed * node.needed);
            for axis in first..first + 3 {
                self.triplets.add(axis, axis, -own);
            }
        }
        let scales = self.scales_of_steep_nodes();
        for segment in &self.inertias.steep {
            let ends = self.ends_of(segment);
            let impulses = ends.map(|at| self.layout.steep[at].map(|first| (first, scales[at])));
            for (q, impulse) in impulses.iter().enumerate() {
                let Some((column, scale)) = *impulse else {
                    continue;
                };
                for p in 0..2 {
                    let sign = if p == q { scale } else { -scale };
                    let part = segment.stiffness * sign;
                    let carrier = self.layout.nodes[ends[p]];
                    let given = part * carrier.prescribed_velocity();
                    for axis in 0..3 {
                        carrier.each_column(&part.column(axis).into_owned(), |motion, value| {
                            self.triplets.add(motion, column + axis, value);
                        });
                        self.right[column + axis] -= given[axis];
                    }
                    let Some((other, of_other)) = impulses[p].filter(|_| p <= q) else {
                        continue;
                    };
                    for i in 0..3 {
                        for j in if p == q { i } else { 0 }..3 {
                            let value = -part[(i, j)] * of_other;
                            self.triplets.add(other + i, column + j, value);
                        }
                    }
                }
            }
        }
    }

    /// The nodes of a segment, among all.
    fn ends_of(&self, segment: &SteepSegment) -> [usize; 2] {
        let first = self.layout.first_node[segment.wire] + segment.segment;
        [first, first + 1]
    }

    /// What `z` is of an unknown, at each node, in 1/kg; 0 where there is none.
    fn scales_of_steep_nodes(&self) -> Vec<f64> {
        let mut scales = vec![0.0; self.layout.nodes.len()];
        for node in &self.inertias.nodes {
            scales[self.layout.first_node[node.wire] + node.node] = 1.0 / node.needed;
        }
        scales
    }

    /// `v . W v` of steep segments in J.
    pub(super) fn energy_of_steep_segments(&self, x: &[f64]) -> f64 {
        let scales = self.scales_of_steep_nodes();
        let z = |at: usize| {
            self.layout.steep[at].map_or_else(Vector::zeros, |first| {
                Vector::new(x[first], x[first + 1], x[first + 2]) * scales[at]
            })
        };
        let energies = self.inertias.steep.iter().map(|segment| {
            let [start, end] = self.ends_of(segment);
            let velocity = |at: usize| self.layout.nodes[at].velocity(x);
            (z(end) - z(start)).dot(&(segment.stiffness * (velocity(end) - velocity(start))))
        });
        energies.sum()
    }

    /// Takes contacts into the system, with their predicted impulses, and softens what chains hold.
    pub(super) fn take(
        &mut self,
        world: &World,
        contacts: &[ContactConstraint],
        start: &Start,
        method: ContactMethod,
    ) {
        self.release_contacts();
        self.method = method;
        let mut masses = vec![0.0; self.layout.size];
        let entries = self.triplets.index.iter().zip(&self.triplets.value);
        for (&(i, j), value) in entries.take(self.mass_entries) {
            if i == j {
                masses[i as usize] += value;
            }
        }
        for node in &self.inertias.nodes {
            let at = self.layout.first_node[node.wire] + node.node;
            if let Carrier::Free(first) = self.layout.nodes[at] {
                masses[first..first + 3]
                    .iter_mut()
                    .for_each(|mass| *mass += node.needed);
            }
        }
        let contacts = contacts.iter().zip(&start.impulses);
        let contacts = contacts.map(|(contact, impulse)| {
            Implicit::new(world, &self.layout, &masses, contact, impulse)
        });
        self.implicit = contacts.collect();
        for (row, &tension) in self.rows.iter_mut().zip(start.tensions.iter().flatten()) {
            row.soften(&masses, tension);
        }
    }

    /// Leaves the contacts out again.
    pub(super) fn release_contacts(&mut self) {
        self.implicit.clear();
        self.triplets.index.truncate(self.mass_entries);
    }

    /// The velocities before the step.
    pub(super) fn start(&self, world: &World) -> Vec<f64> {
        let mut x = vec![0.0; self.layout.size];
        let mut take = |first: usize, velocity: &Vector| {
            x[first..first + 3].copy_from_slice(velocity.as_slice());
        };
        for (body, first) in world.bodies.iter().zip(&self.layout.bodies) {
            if let Some(first) = *first {
                take(first, &body.velocity);
                take(first + 3, &body.angular_velocity);
            }
        }
        let nodes = world.wires.iter().flat_map(|wire| &wire.nodes);
        for (node, carrier) in nodes.clone().zip(&self.layout.nodes) {
            if let Carrier::Free(first) = *carrier {
                take(first, &node.velocity);
            }
        }
        for (node, column) in nodes.zip(&self.layout.slides) {
            if let Some(column) = *column {
                x[column] = node.slide;
            }
        }
        x
    }

    /// Factors the system with the rows that are active now, unless no entry has changed.
    pub(super) fn factor(&mut self) -> Result<(), Reason> {
        // Where entries are depends on what contacts and rows there are, not on their state.
        let is_indexed = self.triplets.index.len() > self.mass_entries;
        let triplets = &mut self.triplets;
        let masses = triplets.value[..self.mass_entries].to_vec();
        let before = std::mem::replace(&mut triplets.value, masses);
        let mut add = |i: usize, j: usize, value: f64| {
            if is_indexed {
                let index = triplets.index.get(triplets.value.len());
                debug_assert_eq!(index, Some(&(i.min(j) as u32, i.max(j) as u32)));
                triplets.value.push(value);
            } else {
                triplets.add(i, j, value);
            }
        };
        if self.method == ContactMethod::InMatrix {
            for contact in &self.implicit {
                contact.each_entry(&mut add);
            }
        }
        for row in &self.rows {
            // A row that is not active keeps its place in the structure: -1 x multiplier = 0.
            let Branch { active, start, .. } = row.branch;
            let weight = if active { 1.0 } else { 0.0 };
            row.each_column(|column, value| add(column, row.multiplier, weight * value));
            let sigma = if active { row.regularisation() } else { 1.0 };
            add(row.multiplier, row.multiplier, -sigma);
            self.right[row.multiplier] = weight * (row.target + start - row.given());
        }
        if is_indexed && self.structure.is_some() && before == self.triplets.value {
            return Ok(());
        }
        self.factorisations += 1;
        let stands = |s: &Structure| is_indexed || s.index == self.triplets.index;
        let structure = self.structure.take().filter(stands);
        let mut structure = structure.unwrap_or_else(|| {
            let matrix = Symmetric::new(self.layout.size, &self.triplets.index);
            let ldl = Ldl::analyse(&matrix);
            let index = self.triplets.index.clone();
            Structure { index, matrix, ldl }
        });
        structure.matrix.fill(&self.triplets.value);
        let factored = structure.ldl.factor(&structure.matrix, &self.is_velocity);
        self.structure = Some(structure);
        factored.map_err(|unknown| Reason::Pivot {
            part: self.layout.part(unknown),
        })
    }

    /// Multiplications of a factorisation and a solve, and what putting the system together takes as
    /// long as.
    pub(super) fn multiplications(&self) -> usize {
        /// Of an entry.
        const ENTRY: usize = 8;
        let own = ENTRY * self.triplets.index.len();
        own + self.ldl().map_or(0, |ldl| {
            ldl.multiplications() + ldl.multiplications_of_solve()
        })
    }

    /// What the laws of contacts and a line search with them take as long as.
    pub(super) fn multiplications_of_laws(&self) -> usize {
        /// Of a contact.
        const CONTACT: usize = 1500;
        CONTACT * self.implicit.len()
    }

    /// What a line search to the last bit takes as long as.
    pub(super) fn multiplications_of_line_search(&self) -> usize {
        /// Of a row.
        const ROW: usize = 500;
        ROW * self.rows.len()
    }

    /// Multiplications of a [`response`](Self::response), and of what contacts make of it.
    pub(super) fn multiplications_of_response(&self) -> usize {
        /// Of a contact.
        const CONTACT: usize = 120;
        let own = CONTACT * self.implicit.len();
        own + self.ldl().map_or(0, Ldl::multiplications_of_solve)
    }

    /// Multiplications of a solve that is refined and checked.
    pub(super) fn multiplications_of_solve(&self) -> usize {
        let entries = 4 * self.triplets.index.len();
        self.ldl()
            .map_or(0, |ldl| 2 * ldl.multiplications_of_solve() + entries)
    }

    /// The solution with impulses on velocities, given as columns and values, and its backward
    /// error.
    pub(super) fn solve(&self, impulses: &[(usize, f64)]) -> Result<(Vec<f64>, f64), Reason> {
        let Some(structure) = &self.structure else {
            return Ok((Vec::new(), 0.0));
        };
        let right = self.right_side(impulses);
        let error_of =
            |x: &[f64]| self.backward_error(&structure.matrix.residual_and_magnitude(&right, x));
        let mut x = structure.refined(&right);
        let mut error = error_of(&x);
        for _ in 0..MORE_REFINEMENTS {
            if error <= RESIDUAL {
                break;
            }
            structure.refine(&right, &mut x);
            error = error_of(&x);
        }
        if error <= RESIDUAL {
            Ok((x, error))
        } else {
            // A number that is none spreads to all of a solution: then it is where most was asked for.
            let sums = structure.matrix.residual_and_magnitude(&right, &x);
            let off: Vec<f64> = match error.is_nan() {
                true => (right.iter().zip(&self.is_velocity))
                    .map(|(impulse, is)| if *is { impulse.abs() } else { 0.0 })
                    .collect(),
                false => sums.iter().map(|[residual, _]| residual.abs()).collect(),
            };
            let worst = (0..off.len())
                .rev()
                .max_by(|&a, &b| off[a].total_cmp(&off[b]));
            Err(Reason::Residual {
                part: self.layout.part(worst.unwrap_or(0)),
                error,
                limit: RESIDUAL,
            })
        }
    }

    /// The solution without impulses on velocities, refined and not checked.
    pub(super) fn solve_free(&self) -> Vec<f64> {
        self.structure.as_ref().map_or_else(Vec::new, |structure| {
            structure.refined(&self.right_side(&[]))
        })
    }

    /// The solution without impulses on velocities, neither refined nor checked.
    pub(super) fn estimate(&self) -> Vec<f64> {
        self.response(self.right_side(&[]))
    }

    /// What impulses change in a solution with the rows as they were factored, not refined.
    pub(super) fn response(&self, mut impulses: Vec<f64>) -> Vec<f64> {
        if let Some(ldl) = self.ldl() {
            ldl.solve(&mut impulses);
        }
        impulses
    }

    /// The tensions of the segments of each wire for a solution, as impulses in N s.
    pub(super) fn tensions(&self, x: &[f64]) -> impl Iterator<Item = Vec<f64>> {
        let layout = &self.layout;
        let firsts = layout.first_node.iter().copied();
        let ends = firsts.clone().skip(1).chain([layout.nodes.len()]);
        firsts.zip(ends).enumerate().map(|(wire, (first, end))| {
            let segments = first - wire..end - wire - 1;
            let stretch = self.rows[segments].iter();
            stretch.map(|row| row.impulse(x)).collect()
        })
    }

    /// What the [directions at the end](super::linearisation) of a step take from the motion, in J.
    pub(super) fn damped_by_lead(&self, x: &[f64]) -> f64 {
        let rows = self.rows.iter().filter(|row| row.lead != 0.0);
        rows.map(|row| -row.lead * row.impulse(x)).sum()
    }

    /// What prescribed velocities do by the rows of a solution, in J.
    pub(super) fn work_of_rows(&self, x: &[f64]) -> f64 {
        self.rows.iter().map(|row| row.work(x)).sum()
    }

    fn right_side(&self, impulses: &[(usize, f64)]) -> Vec<f64> {
        let mut right = self.right.clone();
        for row in &self.rows {
            row.each_offset(|column, impulse| right[column] -= impulse);
        }
        for contact in &self.implicit {
            contact.each_impulse(|column, impulse| right[column] += impulse);
        }
        for &(column, impulse) in impulses {
            right[column] += impulse;
        }
        right
    }

    /// `v . (M~ v + G^T l)` of velocities and multipliers, with the rows as they were factored.
    pub(super) fn curvature(&self, y: &[f64]) -> f64 {
        let Some(structure) = &self.structure else {
            return 0.0;
        };
        let negative = structure.matrix.residual(&vec![0.0; y.len()], y);
        let entries = y.iter().zip(&negative).zip(&self.is_velocity);
        let velocities = entries.filter(|(_, velocity)| **velocity);
        velocities.map(|((y, negative), _)| -y * negative).sum()
    }

    /// `L Y = C` for the rows of one contact.
    pub(super) fn forward(&self, columns: &[(usize, [f64; 3])]) -> SparseColumns {
        self.ldl()
            .map_or_else(SparseColumns::default, |ldl| ldl.forward(columns))
    }

    /// `D`, row by row.
    pub(super) fn pivots(&self) -> &[f64] {
        self.ldl().map_or(&[], Ldl::pivots)
    }

    /// The largest residual relative to the largest magnitude that was summed up: equations of
    /// motion among each other (N s), rows among each other (m/s). NaN if there is one.
    fn backward_error(&self, sums: &[[f64; 2]]) -> f64 {
        let worst = |of_motion: bool| {
            let rows = sums.iter().zip(&self.is_velocity);
            let kind = rows.filter(|(_, velocity)| **velocity == of_motion);
            // Not `f64::max`, which passes over NaN.
            let larger = |a: f64, b: f64| if a >= b { a } else { b };
            let (r, m) = kind.fold((0.0, f64::MIN_POSITIVE), |(r, m), ([residual, sum], _)| {
                (larger(r, residual.abs()), larger(m, *sum))
            });
            r / m
        };
        let [motion, rows] = [worst(true), worst(false)];
        if motion >= rows { motion } else { rows }
    }

    /// The factor, once there is one.
    fn ldl(&self) -> Option<&Ldl> {
        self.structure.as_ref().map(|structure| &structure.ldl)
    }

    /// The structure, for the next system.
    pub(super) fn take_structure(&mut self) -> Option<Structure> {
        self.structure.take()
    }

    /// Takes the structure of another system, for the next one.
    pub(super) fn give_structure(&mut self, structure: Option<Structure>) {
        self.structure = structure;
    }
}

fn push(right: &mut [f64], columns: &Columns, impulse: f64) {
    for (column, value) in columns {
        right[*column] += value * impulse;
    }
}
