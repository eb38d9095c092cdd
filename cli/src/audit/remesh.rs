//! The wires between two steps, while changes of resolution are made.

use tunnelproof::query::EdgeEdge;
use tunnelproof::wire::{
    BodyId, ContactConstraint, ContactSite, NodeKind, Remesh, RemeshKind, SegmentId, StepRecord,
    WireId,
};

use super::aside::{Held, Node, Passages, passages};
use super::finding::{Field, What};
use super::first_contact;
use super::segments::{four, is_one_point};
use super::thickness::Thickness;

/// All wires where a step has left them.
#[derive(Clone, Debug, Default)]
pub(super) struct Wires {
    nodes: Vec<Vec<Node>>,
    radii: Vec<f64>,
    /// The contacts that pushed.
    pushing: Vec<ContactConstraint>,
    /// Contact nodes that were taken out.
    gone: Vec<Gone>,
}

/// A contact node that was taken out, beside no other one that its body carries: it makes place for some that the body
/// carries in the next step.
#[derive(Clone, Debug)]
struct Gone {
    wire: usize,
    body: BodyId,
    /// Of its neighbours, between which it was.
    arcs: [f64; 2],
}

impl Gone {
    /// Whether there is a node that the body carries where it was.
    fn has_made_place(&self, next: &StepRecord) -> bool {
        let Some(wire) = next.wires.get(self.wire) else {
            return false;
        };
        let mut nodes = wire.arcs.iter().zip(&wire.kinds);
        nodes.any(|(&arc, kind)| self.is_around(arc) && is_on(kind, self.body))
    }

    fn is_around(&self, arc: f64) -> bool {
        self.arcs[0] <= arc && arc <= self.arcs[1]
    }
}

/// A segment that a change passes through, with a witness.
pub(super) struct Meeting {
    pub(super) id: SegmentId,
    pub(super) query: EdgeEdge,
    pub(super) passages: Passages,
}

/// Whether a body carries a node of this kind.
fn is_on(kind: &NodeKind, body: BodyId) -> bool {
    kind.carrier().is_some_and(|(carrier, _)| carrier == body)
}

impl Wires {
    /// After the motion of a step, and with contact nodes that leave their bodies free.
    pub(super) fn after(record: &StepRecord) -> Self {
        let wires = record.wires.iter().map(|wire| {
            let places = wire.arcs.iter().zip(&wire.kinds).zip(&wire.after);
            places
                .map(|((&arc, &kind), &at)| Node { arc, kind, at })
                .collect()
        });
        let mut nodes: Vec<Vec<Node>> = wires.collect();
        for slide in &record.slides {
            let wire = nodes.get_mut(slide.wire.0);
            let node = wire.and_then(|wire| wire.get_mut(slide.node));
            // A contact node, or the last one at a reel.
            let is_fixed = |node: &&mut Node| node.kind != NodeKind::Free;
            if let Some(node) = node.filter(is_fixed) {
                node.arc += slide.distance;
                if slide.left {
                    node.kind = NodeKind::Free;
                }
            }
        }
        let pushing = record.contacts.iter();
        let pushing = pushing.filter(|contact| contact.normal_force() > 0.0);
        Wires {
            nodes,
            radii: record.wires.iter().map(|wire| wire.radius).collect(),
            pushing: pushing.map(|record| record.contact).collect(),
            gone: Vec::new(),
        }
    }

    /// What of each wire is not in the next step as it is here: its arc lengths, or what carries its
    /// nodes. One that has other nodes there jumps.
    pub(super) fn altered(&self, next: &StepRecord) -> Vec<What> {
        let wires = self.nodes.iter().zip(&next.wires).enumerate();
        let same = wires.filter(|(_, (here, next))| here.len() == next.kinds.len());
        let altered = same.filter_map(|(wire, (here, next))| {
            let arc = || {
                here.iter()
                    .zip(&next.arcs)
                    .position(|(n, arc)| n.arc != *arc)
            };
            let kind = || (0..here.len()).find(|&k| !self.may_become(wire, k, &next.kinds));
            let (field, at) = match arc() {
                Some(at) => (Field::Arcs, at),
                None => (Field::Kinds, kind()?),
            };
            let at = Some(at);
            Some(What::Altered { wire, field, at })
        });
        altered.collect()
    }

    /// Whether a node may be of the kind that it has in the next step: of its own one, or a contact node where it was free.
    /// Then it is one of some in a row that the body carries in the next step. One of these it carries here, or carried one
    /// between them that is gone, and the wire comes onto it beside that one; or a contact with the body pushed on the wire nearer
    /// than at the neighbours of the row.
    fn may_become(&self, wire: usize, node: usize, next: &[NodeKind]) -> bool {
        let nodes = &self.nodes[wire];
        let (NodeKind::Free, NodeKind::Contact { body, friction, .. }) =
            (&nodes[node].kind, &next[node])
        else {
            return nodes[node].kind == next[node];
        };
        if node == 0 || node + 1 == nodes.len() {
            return false;
        }
        let is_carried = |k: &usize| is_on(&next[*k], *body);
        let first = (0..=node).rev().take_while(is_carried).last();
        let last = (node..next.len()).take_while(is_carried).last();
        let (first, last) = (first.unwrap_or(node), last.unwrap_or(node));
        if nodes[first..=last]
            .iter()
            .any(|node| is_on(&node.kind, *body))
        {
            return true;
        }
        let row = &nodes[first..=last];
        let is_for_row = |gone: &Gone| {
            let is_own = gone.wire == wire && gone.body == *body;
            is_own && row.iter().any(|node| gone.is_around(node.arc))
        };
        if self.gone.iter().any(is_for_row) {
            return true;
        }
        let before = first.checked_sub(1).map(|before| nodes[before].arc);
        let after = nodes.get(last + 1).map(|after| after.arc);
        let is_beside = |arc: f64| {
            before.is_none_or(|before| before < arc) && after.is_none_or(|after| arc < after)
        };
        self.pushing
            .iter()
            .any(|contact| match (contact.a, contact.b) {
                (ContactSite::Wire { wire: of, arc }, ContactSite::Body { body: on, .. }) => {
                    of.0 == wire && on == *body && contact.friction == *friction && is_beside(arc)
                }
                _ => false,
            })
    }

    /// The wires that do not start there in the next step, or have lost a contact node without another one in its place.
    pub(super) fn jumped(&self, next: &StepRecord) -> Vec<usize> {
        let count = self.nodes.len().max(next.wires.len());
        let starts = |w: usize| {
            let before = next.wires.get(w).map(|wire| wire.before.iter());
            let here = self
                .nodes
                .get(w)
                .map(|wire| wire.iter().map(|node| &node.at));
            match (before, here) {
                (Some(before), Some(here)) => here.eq(before),
                _ => false,
            }
        };
        let has_lost = |w: usize| {
            let mut gone = self.gone.iter().filter(|gone| gone.wire == w);
            gone.any(|gone| !gone.has_made_place(next))
        };
        (0..count).filter(|&w| !starts(w) || has_lost(w)).collect()
    }

    /// Where the triangle of a change is: the number of the node before its middle. None if it is not there, or
    /// the node in the middle is fixed or would not be between the others.
    fn place(&self, change: &Remesh) -> Option<usize> {
        let wire = self.nodes.get(change.wire.0)?;
        let corners: &[usize] = match change.kind {
            RemeshKind::Merge => &[0, 1, 2],
            RemeshKind::Split => &[0, 2],
        };
        let corners = corners
            .iter()
            .map(|&k| (change.triangle[k], change.arcs[k]));
        // A body may lose a contact node beside another node that it carries, or between nodes of which it may carry one in the
        // next step: whether it does is seen there.
        let may_go = |nodes: &[Node]| match nodes {
            [before, middle, after] => match middle.kind {
                NodeKind::Free => true,
                NodeKind::Contact { body, .. } => [before, after]
                    .iter()
                    .any(|node| is_on(&node.kind, body) || node.kind == NodeKind::Free),
                _ => false,
            },
            _ => true,
        };
        let mut windows = wire.windows(corners.len());
        let place = windows.position(|nodes| {
            let places = nodes.iter().map(|node| (node.at, node.arc));
            places.eq(corners.clone()) && may_go(nodes)
        });
        place.filter(|_| change.arcs.is_sorted_by(|a, b| a < b))
    }

    /// The first segment that a change takes out or divides.
    pub(super) fn segment(&self, change: &Remesh) -> Option<SegmentId> {
        let segment = self.place(change)?;
        let wire = change.wire;
        Some(SegmentId { wire, segment })
    }

    /// The segments that are no neighbours of a change.
    fn apart<'a>(
        &'a self,
        change: &'a Remesh,
    ) -> impl Iterator<Item = (SegmentId, [Node; 2])> + 'a {
        let own = change.wire.0;
        let first = self.place(change).unwrap_or(0);
        let last = first
            + if change.kind == RemeshKind::Merge {
                2
            } else {
                1
            };
        let corner = |k: usize| self.nodes.get(own)?.get(k).map(|node| (node.kind, node.at));
        let corners: Vec<_> = [first, last].into_iter().filter_map(corner).collect();
        let segments = self.nodes.iter().enumerate().flat_map(|(w, wire)| {
            let wire_id = WireId(w);
            let pairs = wire.windows(2).enumerate();
            pairs.map(move |(segment, two)| {
                (
                    SegmentId {
                        wire: wire_id,
                        segment,
                    },
                    [two[0], two[1]],
                )
            })
        });
        segments.filter(move |(id, two)| {
            let at_corner = id.wire.0 == own && id.segment + 1 >= first && id.segment <= last;
            let fixed = two.iter().any(|node| {
                corners
                    .iter()
                    .any(|corner| is_one_point(corner, &(node.kind, node.at)))
            });
            !at_corner && !fixed
        })
    }

    /// The segments that a change passes through. It is swept around the middle of the triangle, which is not how the
    /// engine sweeps it. None if it is not a change of these wires.
    pub(super) fn meetings(&self, change: &Remesh) -> Option<Vec<Meeting>> {
        self.place(change)?;
        let [a, b, c] = change.triangle;
        let mut met = Vec::new();
        for (id, two) in self.apart(change) {
            let [p, q] = two.map(|node| node.at);
            let query = EdgeEdge::new([a, b, p, q], [c, b, p, q], 0.0).ok()?;
            if first_contact(query).is_some() {
                let passages = self.passages(change, id, two)?;
                met.push(Meeting {
                    id,
                    query,
                    passages,
                });
            }
        }
        Some(met)
    }

    /// The segments of a wire, each with both nodes.
    pub(super) fn segments(&self, wire: usize) -> impl Iterator<Item = [Node; 2]> + '_ {
        let windows = self.nodes[wire].windows(2);
        windows.map(|two| [two[0], two[1]])
    }

    /// How many wires there are.
    pub(super) fn count(&self) -> usize {
        self.nodes.len()
    }

    /// The segments that a change comes nearer to than it may, with a witness, and whether they were
    /// nearer than a share of the thickness before. Swept as in [`meetings`](Self::meetings).
    pub(super) fn nearings(&self, change: &Remesh, share: f64) -> Vec<(SegmentId, EdgeEdge, bool)> {
        let [a, b, c] = change.triangle;
        let own = match change.kind {
            RemeshKind::Merge => vec![[a, b], [b, c]],
            RemeshKind::Split => vec![[a, c]],
        };
        let [from, _, to] = change.arcs;
        let wire = change.wire;
        let nearing = |(id, two): (SegmentId, [Node; 2])| {
            let thickness = Thickness {
                share,
                radii: [wire, id.wire].map(|wire| self.radii[wire.0]),
                stretch: (id.wire == wire)
                    .then(|| (two[0].arc - to).max(from - two[1].arc).max(0.0)),
            };
            let other = two.map(|node| node.at);
            let before: Vec<_> = own.iter().map(|&own| four(own, other)).collect();
            let step = thickness.beyond(&before);
            let broken = thickness.broken(four([a, b], other), four([c, b], other), step)?;
            Some((id, broken, thickness.is_part(step)))
        };
        self.apart(change).filter_map(nearing).collect()
    }

    /// How often a change passes through a segment: taking `b` out moves the start of `bc` to `a`.
    fn passages(&self, change: &Remesh, id: SegmentId, two: [Node; 2]) -> Option<Passages> {
        let first = self.place(change)?;
        let wire = &self.nodes[change.wire.0];
        let (a, middle) = (wire[first], middle(change));
        let (last, from, to) = match change.kind {
            RemeshKind::Merge => (first + 2, middle, a),
            RemeshKind::Split => (first + 1, a, middle),
        };
        let c = wire[last];
        let own = Held {
            id: SegmentId {
                wire: change.wire,
                segment: first,
            },
            ends: [[from, c], [to, c]],
            is_last: [false, last + 1 == wire.len()],
        };
        let other = Held {
            id,
            ends: [two; 2],
            is_last: [
                id.segment == 0,
                id.segment + 2 == self.nodes[id.wire.0].len(),
            ],
        };
        let [p, q] = two.map(|node| node.at);
        let query = EdgeEdge::new([from.at, c.at, p, q], [to.at, c.at, p, q], 0.0).ok()?;
        Some(passages(&query, [own, other]))
    }

    /// Makes a change.
    pub(super) fn make(&mut self, change: &Remesh) {
        let Some(first) = self.place(change) else {
            return;
        };
        let wire = &mut self.nodes[change.wire.0];
        match change.kind {
            RemeshKind::Merge => {
                let neighbours = [wire[first], wire[first + 2]];
                let gone = wire.remove(first + 1);
                if let NodeKind::Contact { body, .. } = gone.kind
                    && !neighbours.iter().any(|node| is_on(&node.kind, body))
                {
                    self.gone.push(Gone {
                        wire: change.wire.0,
                        body,
                        arcs: neighbours.map(|node| node.arc),
                    });
                }
            }
            RemeshKind::Split => {
                wire.insert(first + 1, middle(change));
            }
        }
    }
}

/// The node in the middle of a change.
fn middle(change: &Remesh) -> Node {
    Node {
        arc: change.arcs[1],
        kind: NodeKind::Free,
        at: change.triangle[1],
    }
}
