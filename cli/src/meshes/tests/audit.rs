//! That the audit agrees with the engine, and finds planted faults.

use tunnelproof::certified::Clearance;
use tunnelproof::mesh::{Feature, MeshContact, MeshStep};

use super::super::Motion;
use super::super::audit::{Audit, Claims};
use super::{falling, motion};

/// What the engine says of a vertex that falls through a triangle, beside a point and a wire.
struct Said {
    motion: Motion,
    first: Option<MeshContact>,
    contacts: Vec<MeshContact>,
    step: MeshStep,
}

impl Said {
    fn new(radius: f64, clearance: Clearance) -> Self {
        let beside = "v 5 5 5\nv 0.2 -1 0.5\nv 0.2 2 0.5\nl 6 7\n";
        let start = falling(1.0) + beside;
        let end = falling(-1.0) + &beside.replace("0.5", "-0.5");
        let motion = motion([("a.obj", start.as_bytes()), ("b.obj", end.as_bytes())]).unwrap();
        let from = &motion.start.vertices;
        let first = motion
            .mesh
            .first_contact(from, &motion.end, radius)
            .unwrap();
        let contacts = motion.mesh.all_contacts(from, &motion.end, radius).unwrap();
        let step = motion
            .mesh
            .step_with_clearance(from, &motion.end, radius, clearance)
            .unwrap();
        Said {
            motion,
            first,
            contacts,
            step,
        }
    }

    fn audit(&self, radius: f64, clearance: f64) -> Audit {
        let claims = Claims {
            radius,
            clearance,
            first: self.first.as_ref(),
            contacts: &self.contacts,
            step: &self.step,
        };
        Audit::new(&self.motion, &claims)
    }
}

#[test]
fn audit_agrees_with_the_engine() {
    for (radius, clearance) in [(0.0, 0.0), (0.01, 0.0), (0.1, 0.001), (2.0, 0.0)] {
        let said = Said::new(radius, Clearance::Distance(clearance));
        let audit = said.audit(radius, clearance);
        assert!(audit.passes(), "{audit:?}");
        assert!(audit.contacts > 0 && audit.contacts == said.contacts.len());
    }
}

#[test]
fn audit_finds_planted_faults() {
    type Fault = fn(&mut Said);
    let honest = || Said::new(0.01, Clearance::None);
    let faults: [(&str, Fault); 5] = [
        ("a contact that is missed", |said| {
            said.contacts.pop();
        }),
        ("a contact that is not there", |said| {
            let mut contact = said.contacts[0];
            contact.pair.first = Feature::Vertex(4);
            said.contacts.push(contact);
        }),
        ("a time that is off by the last bit", |said| {
            said.contacts[0].toi = said.contacts[0].toi.next_down();
        }),
        ("no first contact", |said| said.first = None),
        ("a step too far", |said| {
            said.step.positions = said.motion.end.clone();
        }),
    ];
    for (what, plant) in faults {
        let mut said = honest();
        plant(&mut said);
        assert!(!said.audit(0.01, 0.0).passes(), "{what}");
    }
}
