//! The order in which nodes and bodies are eliminated, and with it whether contacts are solved
//! within the system.
//!
//! Contacts tie what they press together. Where the factor hardly fills for that, as with chains on
//! a deck or wires that lie across one, Newton's method finds what pushes, sticks and slips along
//! with what pulls ([`multipliers`](super::multipliers)). Where it would, as with wires that are
//! wound about each other, contacts are swept ([`friction`](super::friction)), or, if they are many,
//! found by [conjugate gradients](super::conjugate_gradients). So are those of which the factor hardly
//! fills, but takes more than the budget has.

use crate::wire::contact::{ContactConstraint, ContactSite};
use crate::wire::model::NodeKind;
use crate::wire::sparse::{dissect, least_degree};
use crate::wire::world::World;

/// Fewer contacts converge in few sweeps, mostly.
const MANY: usize = 8;

/// The most multiplications of a factorisation, for each contact, for which contacts are solved
/// within the system.
const MOST: usize = 4000;

/// Unknowns that are eliminated together, with the rows that they can eliminate.
#[derive(Clone, Copy, Debug)]
pub(super) enum Block {
    /// A free node of a wire.
    Node {
        /// Which wire.
        wire: usize,
        /// Which of its nodes.
        node: usize,
    },
    /// A dynamic body.
    Body(usize),
}

/// Wires one after the other, each by nested dissection, then bodies: no contact is in the system,
/// and ways from one to the root are short.
pub(super) fn by_wires(world: &World) -> Vec<Block> {
    let mut order = Vec::new();
    let mut blocks = Vec::new();
    for (w, wire) in world.wires.iter().enumerate() {
        order.clear();
        let free = |node: usize| wire.nodes[node].kind == NodeKind::Free;
        let mut start = 0;
        for node in 0..=wire.nodes.len() {
            if node == wire.nodes.len() || !free(node) {
                dissect(start..node, &mut order);
                start = node + 1;
            }
        }
        blocks.extend(order.iter().map(|&node| Block::Node { wire: w, node }));
    }
    let bodies = (0..world.bodies.len()).filter(|&at| world.bodies[at].dynamic);
    blocks.extend(bodies.map(Block::Body));
    blocks
}

/// [`by_least_degree`]; none as well if contacts are few, or it takes too many multiplications for each contact.
pub(super) fn for_contacts(
    world: &World,
    contacts: &[ContactConstraint],
    most: usize,
) -> Option<(Vec<Block>, usize)> {
    if contacts.len() < MANY {
        return None;
    }
    by_least_degree(world, contacts, most.min(MOST * contacts.len()))
}

/// By least degree, with contacts as ties, and how many multiplications a factorisation takes. None if
/// it takes more than `most`.
pub(super) fn by_least_degree(
    world: &World,
    contacts: &[ContactConstraint],
    most: usize,
) -> Option<(Vec<Block>, usize)> {
    let Blocks {
        blocks,
        sizes,
        nodes,
        bodies,
    } = Blocks::new(world);
    let mut ties = vec![Vec::new(); blocks.len()];
    let mut tie = |group: &[Option<usize>]| {
        for &a in group.iter().flatten() {
            ties[a].extend(group.iter().flatten().filter(|&&b| a != b));
        }
    };
    for nodes in &nodes {
        nodes.windows(2).for_each(&mut tie);
    }
    for contact in contacts {
        let mut group = [None; 4];
        for (place, group) in [contact.a, contact.b].iter().zip(group.chunks_mut(2)) {
            match *place {
                ContactSite::World => {}
                ContactSite::Body { body, .. } => group[0] = bodies[body.0],
                ContactSite::Wire { wire, arc } => {
                    let (segment, _) = world.wires[wire.0].at(arc);
                    group.copy_from_slice(&nodes[wire.0][segment..segment + 2]);
                }
            }
        }
        tie(&group);
    }
    for ties in &mut ties {
        ties.sort_unstable();
        ties.dedup();
    }
    let (order, multiplications) = least_degree(&sizes, ties, most)?;
    let order = order.into_iter().map(|block| blocks[block]).collect();
    Some((order, multiplications))
}

/// All blocks, and which one carries what.
struct Blocks {
    blocks: Vec<Block>,
    /// Their unknowns; a node has one segment's.
    sizes: Vec<usize>,
    /// By wire and node.
    nodes: Vec<Vec<Option<usize>>>,
    bodies: Vec<Option<usize>>,
}

impl Blocks {
    fn new(world: &World) -> Self {
        let mut all = Blocks {
            blocks: Vec::new(),
            sizes: Vec::new(),
            nodes: Vec::new(),
            bodies: Vec::new(),
        };
        for (at, body) in world.bodies.iter().enumerate() {
            let block = body.dynamic.then(|| all.add(Block::Body(at), 6));
            all.bodies.push(block);
        }
        for (w, wire) in world.wires.iter().enumerate() {
            let size = if wire.material.is_chain() { 4 } else { 7 };
            let nodes = wire.nodes.iter().enumerate();
            let nodes = nodes.map(|(node, own)| match own.kind.carrier() {
                Some((body, _)) => all.bodies[body.0],
                None if own.kind == NodeKind::Free => {
                    Some(all.add(Block::Node { wire: w, node }, size))
                }
                None => None,
            });
            let nodes = nodes.collect();
            all.nodes.push(nodes);
        }
        all
    }

    fn add(&mut self, block: Block, size: usize) -> usize {
        self.blocks.push(block);
        self.sizes.push(size);
        self.blocks.len() - 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::query::Point;
    use crate::wire::{Material, Settings, Stop, Vector, WireId, WirePlan};

    /// Straight wires: so many along x, and so many along y over them, with a contact where they
    /// cross, and a segment for each. Those above rest on the floor with both ends.
    fn net(along: usize, across: usize) -> (World, Vec<ContactConstraint>) {
        let mut world = World::new(Settings::default()).unwrap();
        let mut add = |from: Point, way: Vector| {
            let route = vec![Stop::Free(from), Stop::Free(from + way)];
            let plan = WirePlan::new(Material::steel(0.01), 0.25, route);
            world.add_wire(&plan).unwrap()
        };
        let place = |k: usize| 0.25 * k as f64 + 0.1;
        let mut contacts = Vec::new();
        let (x, y) = (
            Vector::x() * 0.25 * across as f64,
            Vector::y() * 0.25 * along as f64,
        );
        let below: Vec<WireId> = (0..along)
            .map(|k| add(Point::new(0.0, place(k), 0.0), x))
            .collect();
        for j in 0..across {
            let above = add(Point::new(place(j), 0.0, 0.02), y);
            let on = below.iter().enumerate().map(|(k, &wire)| {
                let arc = place(j);
                (place(k), ContactSite::Wire { wire, arc })
            });
            let ends = [0.0, 0.25 * along as f64].map(|arc| (arc, ContactSite::World));
            for (arc, b) in on.chain(ends) {
                contacts.push(ContactConstraint {
                    key: contacts.len() as u64,
                    a: ContactSite::Wire { wire: above, arc },
                    b,
                    normal: Vector::z(),
                    gap: 0.0,
                    friction: 0.5,
                });
            }
        }
        (world, contacts)
    }

    #[test]
    fn wires_across_one_are_solved_with_it_and_a_net_is_swept() {
        let suits = |along, across| {
            let (world, contacts) = net(along, across);
            for_contacts(&world, &contacts, usize::MAX).is_some()
        };
        assert!(!suits(1, 2));
        assert!(suits(1, 40));
        assert!(!suits(12, 12));
    }

    #[test]
    fn both_orders_have_every_block_once() {
        let (world, contacts) = net(1, 40);
        let number = |block: &Block| match *block {
            Block::Node { wire, node } => (wire, node),
            Block::Body(at) => (usize::MAX, at),
        };
        let [mut wires, mut ties] = [
            by_wires(&world),
            by_least_degree(&world, &contacts, usize::MAX).unwrap().0,
        ]
        .map(|order| {
            let numbers: Vec<_> = order.iter().map(number).collect();
            assert_eq!(numbers.len(), 41 + 40 * 2);
            numbers
        });
        assert_ne!(wires, ties);
        wires.sort_unstable();
        ties.sort_unstable();
        assert_eq!(wires, ties);
    }
}
