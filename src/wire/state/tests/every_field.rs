//! A state that is made by hand.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, UnitQuaternion};

use crate::broad::SlowPairs;
use crate::query::Point;
use crate::wire::collide::{BODY_KEYS, KnownContacts, Side, WIRE_KEYS, WireContact, WireContacts};
use crate::wire::model::{Body, Node, NodeKind, Segment, Wire};
use crate::wire::site::WireSite;
use crate::wire::solver_cache::{SolverCache, WarmStart};
use crate::wire::state::State;
use crate::wire::world::{Epoch, World};
use crate::wire::{
    BodyId, CollisionMemory, CollisionSettings, ContactConstraint, ContactSite, Material, Mesh,
    Mode, Phase, ReelPhase, Resolution, Settings, Shape, Vector, WireId,
};

/// Numbers of which no two are the same, in order of use.
struct Numbers(f64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 += 1.0;
        self.0
    }

    fn vector(&mut self) -> Vector {
        Vector::from_fn(|_, _| self.next())
    }
}

/// A state with something in every field, and no number twice where there is a choice: made by
/// hand, so that it does not hang on the bits of steps.
pub(super) fn every_field() -> State {
    let mut n = Numbers(0.0);
    let settings = Settings {
        step: n.next(),
        gravity: n.vector(),
        contact_compliance: n.next(),
        contact_damping: n.next(),
        impact_speed: n.next(),
        sweeps: 17,
        work: 19,
        contact_tolerance: n.next(),
        stability_margin: 0.25,
        split_ratio: n.next(),
    };
    let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mesh = Mesh::new(corners.map(Point::from).to_vec(), triangles).unwrap();
    let shapes = [
        Shape::Mesh(mesh),
        Shape::Box { half: n.vector() },
        Shape::Cylinder {
            radius: n.next(),
            half_height: n.next(),
        },
        Shape::Sphere { radius: n.next() },
        Shape::Capsule {
            radius: n.next(),
            half_height: n.next(),
        },
        Shape::Plane,
    ];
    let mut bodies = Vec::new();
    for (k, shape) in shapes.into_iter().enumerate() {
        let dynamic = k == 1;
        let phases = (0..k / 2).map(|_| Phase {
            from: n.next(),
            velocity: n.vector(),
            angular_velocity: n.vector(),
        });
        let phases = phases.collect();
        let (mut mass, mut inertia) = (0.0, Matrix3::zeros());
        if dynamic {
            mass = n.next();
            let diagonal = n.vector() * 100.0;
            inertia = Matrix3::from_diagonal(&diagonal);
            (inertia[(0, 1)], inertia[(1, 0)]) = (0.5, 0.5);
        }
        bodies.push(Body {
            shape,
            dynamic,
            phases,
            mass,
            inertia,
            position: n.vector().into(),
            orientation: UnitQuaternion::from_euler_angles(0.1, 0.2, 0.3),
            velocity: n.vector(),
            angular_velocity: n.vector(),
        });
    }
    let material = Material {
        density: n.next(),
        radius: n.next(),
        stretch_modulus: n.next(),
        bend_modulus: n.next(),
        twist_modulus: n.next(),
        stretch_damping: n.next(),
        bend_damping: n.next(),
        twist_damping: n.next(),
    };
    let local = n.vector();
    let body = BodyId(2);
    let contact = NodeKind::Contact {
        body,
        local,
        normal: n.vector(),
        friction: n.next(),
        aside: Some(n.vector()),
    };
    let eye = NodeKind::Eye { body, local };
    let at = bodies[2].point(&local);
    let kinds = [NodeKind::Pinned, NodeKind::Free, contact, eye];
    let nodes = kinds.into_iter().enumerate().map(|(k, kind)| Node {
        position: if k < 2 { n.vector().into() } else { at },
        velocity: n.vector(),
        arc: 10.0 * k as f64,
        kind,
        slide: if k == 2 { -n.next() } else { 0.0 },
        remesh_from: k as u64,
    });
    let nodes = nodes.collect();
    let segments = (0..3).map(|_| Segment {
        tension: -n.next(),
        tension_history: std::array::from_fn(|_| n.next()),
    });
    let segments = segments.collect();
    let wire = Wire {
        material,
        resolution: Resolution {
            length: n.next(),
            adaptive: true,
        },
        nodes,
        segments,
        twist: 0.0,
        reel: vec![
            ReelPhase {
                from: -n.next(),
                speed: n.next(),
            },
            ReelPhase {
                from: n.next(),
                speed: -n.next(),
            },
        ],
    };
    // One that is clamped by the world and by a body, and so may be twisted.
    let kinds = [local, local * 2.0].map(|local| NodeKind::Eye { body, local });
    let kinds = [NodeKind::Pinned, NodeKind::Pinned, kinds[0], kinds[1]];
    let nodes = kinds.into_iter().enumerate().map(|(k, kind)| Node {
        position: match kind.carrier() {
            Some((_, local)) => bodies[2].point(&local),
            None => n.vector().into(),
        },
        velocity: n.vector(),
        arc: 10.0 * k as f64,
        kind,
        slide: 0.0,
        remesh_from: k as u64,
    });
    let twisted = Wire {
        nodes: nodes.collect(),
        twist: -n.next(),
        reel: Vec::new(),
        ..wire.clone()
    };
    let impulses = [(3, n.vector()), (8, n.vector())];
    let world = World {
        settings,
        bodies,
        wires: vec![wire, twisted],
        steps: 1000,
        epoch: Epoch {
            steps: 900,
            time: n.next(),
        },
        cache: SolverCache {
            warm_start: WarmStart::new(impulses.into_iter()),
            structures: BTreeMap::new(),
        },
    };
    let site = |arc| WireSite {
        wire: WireId(0),
        arc,
    };
    let touch = WireContact {
        key: WIRE_KEYS + 5,
        sites: [site(1.0), site(25.0)],
        wrong: true,
        normal: -Vector::y(),
        gap: n.next(),
        pushing: false,
        at_node: Some(Side::B),
    };
    let other = WireContact {
        key: WIRE_KEYS + 4,
        sites: [site(2.0), site(26.0)],
        wrong: false,
        pushing: true,
        at_node: None,
        ..touch.clone()
    };
    let with_body = ContactConstraint {
        key: BODY_KEYS + 7,
        a: site(3.0).into(),
        b: ContactSite::Body { body, local },
        normal: Vector::z(),
        gap: n.next(),
        friction: n.next(),
    };
    let placed = [0.0, 1e4, 2e4].map(|z| {
        let ends = [0.0, 1.0].map(|x| Point::new(x, n.next(), z));
        (n.next(), ends)
    });
    let [a, b, c] = placed;
    let memory = CollisionMemory {
        slow: SlowPairs::between_steps(
            vec![Some(a), None, Some(b), Some(c)],
            vec![([0, 2], n.next()), ([0, 3], n.next())],
        ),
        between_wires: WireContacts {
            list: vec![touch, other],
            made: 6,
        },
        with_bodies: KnownContacts {
            last: vec![with_body],
            given: 9,
            pushed: vec![site(4.0)],
        },
    };
    State {
        world,
        narrow: "certified".to_owned(),
        settings: CollisionSettings {
            mode: Mode::Thesis,
            friction: n.next(),
            guarded_thickness: 0.375,
            bodies: true,
            contact_nodes: false,
        },
        memory,
    }
}
