//! Scenes of moving segments for the broad phase: the swept boxes of some steps in a row.

use tunnelproof::broad::{Aabb, BroadPhase, ItemId, Method, SlowPairs};
use tunnelproof::query::Point;

/// A scene of so many segments.
type Make = fn(usize) -> Scene;

/// Scenes by name.
pub(crate) const SCENES: [(&str, Make); 2] = [("coil", coil), ("cloud", cloud)];

/// How many segments scenes are measured with.
pub(crate) const SIZES: [usize; 4] = [10, 100, 1000, 10_000];

/// Methods by name, and whether slow pairs are left out as well.
pub(crate) const METHODS: [(&str, Method, bool); 4] = [
    ("brute-force", Method::BruteForce, false),
    ("sweep-and-prune", Method::SweepAndPrune, false),
    ("sweep-excluding", Method::SweepAndPrune, true),
    ("hierarchical-grid", Method::HierarchicalGrid, false),
];

const STEPS: usize = 12;
/// The length of a step in seconds.
const STEP: f64 = 1.0 / 60.0;
/// Of a segment, in metres.
const LENGTH: f64 = 0.1;
/// Of a wire, in metres.
const RADIUS: f64 = 0.01;

/// All segments, step by step.
pub(crate) struct Scene {
    /// Their ends at the beginning of each step, and at the end of the last.
    ends: Vec<Vec<[Point; 2]>>,
    /// Their swept boxes in each step.
    boxes: Vec<Vec<Aabb>>,
}

impl Scene {
    fn new(count: usize, ends: impl Fn(usize, f64) -> [Point; 2]) -> Self {
        let at = |step: usize| (0..count).map(|i| ends(i, step as f64 * STEP)).collect();
        let ends: Vec<Vec<[Point; 2]>> = (0..=STEPS).map(at).collect();
        let swept = |(start, end): (&[Point; 2], &[Point; 2])| {
            Aabb::swept(start, end, RADIUS).expect("finite coordinates")
        };
        let step = |ends: &[Vec<[Point; 2]>]| ends[0].iter().zip(&ends[1]).map(swept).collect();
        Scene {
            boxes: ends.windows(2).map(step).collect(),
            ends,
        }
    }
}

/// A wire in turns of half a metre radius that lie next to each other, and a wave that runs through
/// it at up to 2 m/s.
fn coil(count: usize) -> Scene {
    let node = |index: usize, time: f64| {
        let along = index as f64 * LENGTH;
        let angle = along / 0.5;
        let radius = 0.5 + 0.1 * (3.0 * along - 20.0 * time).sin();
        let x = 0.02 * angle / std::f64::consts::TAU;
        Point::new(x, radius * angle.cos(), radius * angle.sin())
    };
    Scene::new(count, |i, time| [node(i, time), node(i + 1, time)])
}

/// Segments of all directions and speeds up to 5 m/s, one in a cubic decimetre.
fn cloud(count: usize) -> Scene {
    let side = LENGTH * (count as f64).cbrt();
    Scene::new(count, |i, time| {
        let random = |which: u64| uniform(16 * i as u64 + which);
        let triple = |which: u64| [0, 1, 2].map(|axis| random(which + axis));
        let (place, velocity) = (triple(0), triple(3).map(|x| 5.0 * (2.0 * x - 1.0)));
        let (height, turn) = (2.0 * random(6) - 1.0, std::f64::consts::TAU * random(7));
        let across = (1.0 - height * height).sqrt();
        let direction = [across * turn.cos(), across * turn.sin(), height];
        let axes = [0, 1, 2];
        let start = axes.map(|axis: usize| side * place[axis] + velocity[axis] * time);
        let end = axes.map(|axis: usize| start[axis] + LENGTH * direction[axis]);
        [start.into(), end.into()]
    })
}

/// A number in `[0, 1)` that looks random (SplitMix64).
fn uniform(index: u64) -> f64 {
    let mut z = index.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
}

/// A scene that goes on, forth and back, under a broad phase.
pub(crate) struct Run {
    scene: Scene,
    broad: BroadPhase,
    slow: Option<SlowPairs>,
    items: Vec<ItemId>,
    step: usize,
}

impl Run {
    /// The scene before its first step, and one of [`METHODS`].
    pub(crate) fn new(scene: Scene, (_, method, excludes): (&str, Method, bool)) -> Self {
        let mut broad = BroadPhase::new(method);
        let items = scene.boxes[0].iter().map(|&aabb| broad.insert(aabb));
        let mut run = Run {
            items: items.collect(),
            scene,
            broad,
            slow: excludes.then(SlowPairs::default),
            step: 0,
        };
        run.place(0);
        run
    }

    /// Places the segments for the exclusion of slow pairs.
    fn place(&mut self, time: usize) {
        if let Some(slow) = &mut self.slow {
            for (item, ends) in self.items.iter().zip(&self.scene.ends[time]) {
                slow.place(*item, *ends, RADIUS)
                    .expect("finite coordinates");
            }
        }
    }

    /// The next step: how many pairs of segments that are not neighbours need a test.
    pub(crate) fn step(&mut self) -> usize {
        let turn = self.step % (2 * STEPS);
        self.step += 1;
        let is_forth = turn < STEPS;
        let step = if is_forth { turn } else { 2 * STEPS - 1 - turn };
        for (item, aabb) in self.items.iter().zip(&self.scene.boxes[step]) {
            self.broad.set(*item, *aabb).expect("an item");
        }
        self.place(if is_forth { step + 1 } else { step });
        let pairs = self
            .broad
            .pairs(|pair| pair.first().index() + 1 < pair.second().index());
        match &mut self.slow {
            None => pairs.len(),
            Some(slow) => slow.remaining(pairs).len(),
        }
    }
}
