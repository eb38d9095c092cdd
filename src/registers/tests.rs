#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::sync::RwLock;

use super::*;
use crate::certified::testing::Random;
use crate::mesh::Mesh;
use crate::{Clearance, Coordinate, EdgeEdge, Pairs, VertexFace, advance_pairs};

/// What work is done with, in place of the widest. Other tests may go on meanwhile.
pub(super) static CHOSEN: RwLock<Option<Arch>> = RwLock::new(None);

/// All that this processor has, the widest last.
fn all() -> Vec<Arch> {
    #[cfg(target_arch = "x86_64")]
    let wider = [
        pulp::x86::V3::try_new().map(Arch::V3),
        pulp::x86::V4::try_new().map(Arch::V4),
    ];
    #[cfg(target_arch = "aarch64")]
    let wider = [pulp::aarch64::Neon::try_new().map(Arch::Neon)];
    #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
    let wider: [Option<Arch>; 0] = [];
    [Some(Arch::Scalar)]
        .into_iter()
        .chain(wider)
        .flatten()
        .collect()
}

/// Points at both ends of a step.
struct Points {
    start: Vec<[f64; 3]>,
    end: Vec<[f64; 3]>,
}

impl Points {
    /// Some are on a lattice, where much touches exactly.
    fn new(random: &mut Random, count: usize) -> Self {
        let [start, end] = [(); 2].map(|()| {
            let point = |_| match random.coin() {
                true => [(); 3].map(|()| random.small()),
                false => [(); 3].map(|()| random.signed()),
            };
            (0..count).map(point).collect::<Vec<_>>()
        });
        Points { start, end }
    }

    /// All that is decided of quadruples of them, as text: it has every bit.
    fn answers(&self, quadruples: &[[u32; 4]], radius: f64) -> [String; 5] {
        let Points { start, end } = self;
        let edges = Pairs::<EdgeEdge>::new(start, end, quadruples, radius).unwrap();
        let faces = Pairs::<VertexFace>::new(start, end, quadruples, radius).unwrap();
        let single = |all: &[[f64; 3]]| -> Vec<_> {
            all.iter().map(|point| point.map(|x| x as f32)).collect()
        };
        let double_step = step(start, end, quadruples, radius);
        let single_step = step(&single(start), &single(end), quadruples, radius);
        let faces_of_mesh = quadruples.iter().take(60).map(|q| [q[0], q[1], q[2]]);
        let mesh = Mesh::new(start.len(), &[], &faces_of_mesh.collect::<Vec<_>>()).unwrap();
        [
            format!("{:?}", edges.decide()),
            format!("{:?}", faces.decide()),
            double_step,
            single_step,
            format!("{:?}", mesh.all_contacts(start, end, radius).unwrap()),
        ]
    }
}

/// The step of quadruples of points, of which one is a pair of edges.
fn step<C: Coordinate>(
    start: &[[C; 3]],
    end: &[[C; 3]],
    quadruples: &[[u32; 4]],
    radius: f64,
) -> String {
    let edges = Pairs::<EdgeEdge, C>::new(start, end, &quadruples[..1], radius).unwrap();
    let faces = Pairs::<VertexFace, C>::new(start, end, quadruples, radius).unwrap();
    let step = advance_pairs(&edges, &faces, Clearance::Share(0.5)).unwrap();
    format!("{step:?}")
}

#[test]
fn registers_of_every_width_give_the_same_bits() {
    let random = &mut Random::new(2026);
    let mut hits = 0;
    for radius in [0.0, 0.0, 0.05, 0.3] {
        let count = 400;
        let points = Points::new(random, count);
        let mut index = || random.below(count as u64) as u32;
        let quadruples: Vec<_> = (0..4000).map(|_| [(); 4].map(|()| index())).collect();
        let mut answers = all().into_iter().map(|arch| {
            *CHOSEN.write().unwrap() = Some(arch);
            points.answers(&quadruples, radius)
        });
        let first = answers.next().unwrap();
        hits += first[0].matches("toi:").count();
        assert!(answers.all(|other| other == first), "radius {radius}");
    }
    *CHOSEN.write().unwrap() = None;
    assert!(hits > 1000, "{hits} hits");
}
