//! All methods name the pairs that overlap, whatever the boxes are and however they change.

use proptest::prelude::*;

use super::*;
use crate::query::Point;

/// Where coordinates are at their worst: ends of the range, subnormals, both zeros, edges of cells.
const HARD: [f64; 18] = [
    f64::NEG_INFINITY,
    -f64::MAX,
    -1e308,
    -1e300,
    -1.0,
    -1e-310,
    -5e-324,
    -0.0,
    0.0,
    5e-324,
    f64::MIN_POSITIVE,
    1.0 - f64::EPSILON / 2.0,
    1.0,
    1.0 + f64::EPSILON,
    1e300,
    8.98846567431158e307,
    f64::MAX,
    f64::INFINITY,
];

fn span(a: f64, b: f64) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

fn of(axes: [[f64; 2]; 3]) -> Aabb {
    Aabb {
        low: axes.map(|[low, _]| low),
        high: axes.map(|[_, high]| high),
    }
}

/// Boxes whose three axes are drawn alike.
fn alike(axis: impl Strategy<Value = [f64; 2]> + 'static) -> BoxedStrategy<Aabb> {
    prop::array::uniform3(axis).prop_map(of).boxed()
}

fn sized(place: f64, size: impl Strategy<Value = f64> + 'static) -> BoxedStrategy<Aabb> {
    alike((-place..place, size).prop_map(|(low, size)| span(low, low + size)))
}

fn power() -> impl Strategy<Value = f64> + Clone {
    (-1074..1024i32, any::<bool>(), -1..=1i32).prop_map(|(exponent, is_negative, ulps)| {
        let power = 2f64.powi(exponent / 2) * 2f64.powi(exponent - exponent / 2);
        let near = match ulps {
            -1 => power.next_down(),
            0 => power,
            _ => power.next_up(),
        };
        if is_negative { -near } else { near }
    })
}

/// Boxes of one character; a scene draws all of its boxes from one strategy.
fn boxes() -> Vec<BoxedStrategy<Aabb>> {
    let hard = || prop::sample::select(&HARD[..]);
    let lattice = || (-4..=4i32, 0..=2i32);
    let tenth = || sized(1.0, Just(0.1));
    vec![
        sized(10.0, 0.0..2.0),
        // Clusters.
        sized(1e-3, 0.0..1e-3),
        // From 1 mm to 1 km.
        sized(300.0, (-3.0..3.0).prop_map(|x: f64| 10f64.powf(x))),
        // Faces that touch, points, lines and plates among them.
        alike(lattice().prop_map(|(low, size)| [low, low + size].map(f64::from))),
        // All the same.
        Just(of([[0.1, 0.7]; 3])).boxed(),
        alike((hard(), hard()).prop_map(|(a, b)| span(a, b))),
        alike((power(), power()).prop_map(|(a, b)| span(a, b))),
        // Points.
        alike(power().prop_map(|x| [x, x])),
        sized(1e-322, 0.0..1e-321),
        sized(1e308, 0.0..1e307),
        // Many of one size and few that are huge.
        prop_oneof![20 => tenth(), 1 => sized(1.0, Just(1e9)), 1 => Just(of([HARD_RANGE; 3]))]
            .boxed(),
        // On one plane.
        (sized(10.0, 0.0..1.0), Just([0.0, 1.0]))
            .prop_map(|(aabb, z)| Aabb {
                low: [aabb.low[0], aabb.low[1], z[0]],
                high: [aabb.high[0], aabb.high[1], z[1]],
            })
            .boxed(),
    ]
}

const HARD_RANGE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// What is done to a broad phase; the index picks one of the items there are.
#[derive(Clone, Debug)]
enum Change {
    Insert(Aabb),
    Set(prop::sample::Index, Aabb),
    Shift(prop::sample::Index, [f64; 3]),
    Remove(prop::sample::Index),
}

fn changes() -> impl Strategy<Value = Vec<Vec<Change>>> {
    let shift = prop::array::uniform3(-0.1..0.1);
    (0..boxes().len(), 1..120usize).prop_flat_map(move |(kind, count)| {
        let aabb = boxes().swap_remove(kind);
        let change = prop_oneof![
            aabb.clone().prop_map(Change::Insert),
            (any::<prop::sample::Index>(), aabb.clone()).prop_map(|(i, b)| Change::Set(i, b)),
            (any::<prop::sample::Index>(), shift.clone()).prop_map(|(i, d)| Change::Shift(i, d)),
            any::<prop::sample::Index>().prop_map(Change::Remove),
        ];
        let first = prop::collection::vec(aabb.prop_map(Change::Insert), count);
        let later = prop::collection::vec(prop::collection::vec(change, 0..20), 0..6);
        (first, later).prop_map(|(first, mut later)| {
            later.insert(0, first);
            later
        })
    })
}

/// Broad phases of all methods, to which the same is done.
struct Side {
    phases: [BroadPhase; 3],
    items: Vec<ItemId>,
}

impl Side {
    fn new() -> Self {
        let methods = [
            Method::BruteForce,
            Method::SweepAndPrune,
            Method::HierarchicalGrid,
        ];
        Side {
            phases: methods.map(BroadPhase::new),
            items: Vec::new(),
        }
    }

    fn change(&mut self, change: &Change) {
        let at = |index: &prop::sample::Index| index.index(self.items.len().max(1));
        match change {
            Change::Insert(aabb) => self.insert(*aabb),
            _ if self.items.is_empty() => {}
            Change::Set(index, aabb) => self.set(self.items[at(index)], *aabb),
            Change::Shift(index, by) => {
                let item = self.items[at(index)];
                let mut aabb = *self.phases[0].aabb(item).unwrap();
                for (axis, by) in by.iter().enumerate() {
                    aabb.low[axis] += by;
                    aabb.high[axis] += by;
                }
                self.set(item, aabb);
            }
            Change::Remove(index) => {
                let item = self.items.swap_remove(at(index));
                for phase in &mut self.phases {
                    phase.remove(item).unwrap();
                }
            }
        }
    }

    fn insert(&mut self, aabb: Aabb) {
        let [a, b, c] = self.phases.each_mut().map(|phase| phase.insert(aabb));
        assert!(a == b && b == c, "the same ids");
        self.items.push(a);
    }

    fn set(&mut self, item: ItemId, aabb: Aabb) {
        for phase in &mut self.phases {
            phase.set(item, aabb).unwrap();
        }
    }

    /// The pairs whose boxes have a point in common, by another formula than [`Aabb::overlaps`].
    fn overlapping(&self) -> Vec<Pair> {
        let mut pairs = Vec::new();
        for (index, &item) in self.items.iter().enumerate() {
            for &other in &self.items[..index] {
                let [a, b] = [item, other].map(|id| self.phases[0].aabb(id).unwrap());
                let shared =
                    |axis: usize| a.low[axis].max(b.low[axis]) <= a.high[axis].min(b.high[axis]);
                if shared(0) && shared(1) && shared(2) {
                    pairs.push(Pair::new(item, other));
                }
            }
        }
        pairs.sort();
        pairs
    }

    /// The pairs of all methods, after a look at their order.
    fn pairs(&mut self) -> [Vec<Pair>; 3] {
        self.phases.each_mut().map(|phase| {
            let pairs = phase.pairs(|_| true).to_vec();
            assert!(pairs.is_sorted_by(|a, b| a < b), "in order, each once");
            assert!(pairs.iter().all(|pair| pair.first() < pair.second()));
            pairs
        })
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 1500,
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn broad_phases_name_the_same_pairs_step_after_step(steps in changes()) {
        let mut side = Side::new();
        for step in &steps {
            for change in step {
                side.change(change);
            }
            let expected = side.overlapping();
            let [brute, sweep, grid] = side.pairs();
            prop_assert_eq!(&brute, &expected, "brute force");
            prop_assert_eq!(&sweep, &expected, "sweep-and-prune");
            prop_assert_eq!(&grid, &expected, "hierarchical grid");
        }
    }
}

#[test]
fn broad_phases_agree_on_large_degenerate_scenes() {
    let n = 1500;
    let scenes: [fn(usize) -> Aabb; 4] = [
        |_| of([[0.0, 1.0]; 3]),
        |_| of([HARD_RANGE; 3]),
        // On every level there is, nested.
        |i| of([[0.0, f64::from_bits((i as u64 % 2046) << 52)]; 3]),
        // Points of all magnitudes.
        |i| of([[f64::from_bits((i as u64 % 2046) << 52); 2]; 3]),
    ];
    for (index, scene) in scenes.into_iter().enumerate() {
        let mut side = Side::new();
        (0..n).for_each(|i| side.insert(scene(i)));
        let [brute, sweep, grid] = side.pairs();
        let all = n * (n - 1) / 2;
        assert_eq!(brute.len(), if index == 3 { 0 } else { all });
        assert!(sweep == brute && grid == brute, "scene {index}");
    }
}

#[test]
fn broad_phase_asks_the_filter_once_for_each_pair_and_obeys() {
    let mut side = Side::new();
    // A rope along x, each segment touching the next; and one box around everything.
    (0..200).for_each(|i| side.insert(of([[i as f64, i as f64 + 1.0], [0.0; 2], [0.0; 2]])));
    side.insert(of([[-1.0, 1e3]; 3]));
    for phase in &mut side.phases {
        let mut asked = Vec::new();
        let pairs = phase.pairs(|pair| {
            asked.push(pair);
            pair.second().index() != pair.first().index() + 1
        });
        asked.sort();
        assert_eq!(pairs.len(), 199);
        assert!(pairs.iter().all(|pair| pair.second().index() == 200));
        assert_eq!(asked.len(), 199 + 200);
        assert!(asked.is_sorted_by(|a, b| a < b), "once each");
    }
}

#[test]
fn broad_phase_names_an_item_that_is_not_there() {
    let mut broad = BroadPhase::new(Method::default());
    let aabb = of([[0.0, 1.0]; 3]);
    let [first, second] = [broad.insert(aabb), broad.insert(aabb)];
    assert_eq!(broad.remove(second), Ok(aabb));
    assert_eq!(broad.remove(second), Err(BroadError::UnknownItem(second)));
    let error = broad.set(second, aabb).unwrap_err();
    assert_eq!(error.to_string(), "item 1 is not in the broad phase");
    assert_eq!((broad.len(), broad.aabb(second)), (1, None));
    assert_eq!(broad.insert(aabb), second, "the id is given again");
    assert_eq!(broad.remove(first), Ok(aabb));
    assert!(!broad.is_empty() && broad.pairs(|_| true).is_empty());
}

/// Two segments along x and y, `gap` apart in z, of some radii, placed once.
fn crossed(gap: f64, radii: [f64; 2]) -> (SlowPairs, [ItemId; 2], Pair) {
    let mut items = items::Items::default();
    let aabb = of([[0.0; 2]; 3]);
    let ids = [items.insert(aabb), items.insert(aabb)];
    let mut slow = SlowPairs::default();
    slow.place(ids[0], along_x(), radii[0]).unwrap();
    slow.place(ids[1], along_y(gap), radii[1]).unwrap();
    (slow, ids, Pair::new(ids[0], ids[1]))
}

fn along_x() -> [Point; 2] {
    [Point::new(-1.0, 0.0, 0.0), Point::new(1.0, 0.0, 0.0)]
}

fn along_y(z: f64) -> [Point; 2] {
    [Point::new(0.0, -1.0, z), Point::new(0.0, 1.0, z)]
}

#[test]
fn slow_pairs_are_left_out_by_distance_until_they_have_moved_it() {
    let (mut slow, [_, second], pair) = crossed(1.0, [0.0; 2]);
    let mut needs_test = Vec::new();
    for step in 1..=11 {
        let z = 1.0 - f64::from(step) / 10.0;
        slow.place(second, along_y(z), 0.0).unwrap();
        needs_test.push(!slow.remaining(&[pair]).is_empty());
    }
    // They touch at the end of the tenth step, so at the start of the next one.
    assert_eq!(needs_test, [[false; 9].as_slice(), &[true; 2]].concat());
    let counts = Exclusions {
        asked: 11,
        remembered: 8,
        measured: 1,
    };
    assert_eq!(slow.counts(), counts);
}

#[test]
fn slow_pairs_that_touch_by_their_radii_are_never_left_out() {
    for (gap, radii, is_left) in [
        (1.0, [0.5, 0.5], true),
        (1.0, [1.0, 0.0], true),
        (1.0, [0.5, 0.499_999_999_999], false),
        (0.0, [0.0; 2], true),
        (1e-300, [0.0; 2], false),
        (f64::MAX, [f64::MAX, 0.0], true),
        (1e300, [1.0; 2], false),
    ] {
        let (mut slow, _, pair) = crossed(gap, radii);
        assert_eq!(
            !slow.remaining(&[pair]).is_empty(),
            is_left,
            "{gap} {radii:?}"
        );
    }
}

#[test]
fn slow_pairs_forget_no_motion() {
    // One end that swings through, a radius that grows, a move taken back, a pair not asked about
    // for a step.
    let (mut slow, [first, second], pair) = crossed(1.0, [0.0; 2]);
    let [still, _] = along_y(1.0);
    slow.place(second, [still, Point::new(0.0, 1.0, -3.0)], 0.0)
        .unwrap();
    assert_eq!(slow.remaining(&[pair]), [pair]);

    let (mut slow, _, pair) = crossed(1.0, [0.0; 2]);
    assert!(slow.remaining(&[pair]).is_empty());
    slow.place(first, along_x(), 1.0).unwrap();
    assert_eq!(slow.remaining(&[pair]), [pair]);

    let (mut slow, _, pair) = crossed(1.0, [0.0; 2]);
    assert!(slow.remaining(&[pair]).is_empty());
    slow.place(second, along_y(-5.0), 0.0).unwrap();
    slow.place(second, along_y(1.0), 0.0).unwrap();
    assert_eq!(slow.remaining(&[pair]), [pair]);

    let (mut slow, _, pair) = crossed(1.0, [0.0; 2]);
    assert!(slow.remaining(&[pair]).is_empty());
    slow.place(second, along_y(0.125), 0.0).unwrap();
    assert!(slow.remaining(&[]).is_empty());
    slow.place(second, along_y(-0.125), 0.0).unwrap();
    assert_eq!(slow.remaining(&[pair]), [pair]);
}

#[test]
fn slow_pairs_refuse_what_is_not_finite_and_pass_on_what_they_do_not_know() {
    let (mut slow, [first, _], pair) = crossed(1.0, [0.0; 2]);
    let mut ends = along_x();
    ends[1].z = f64::INFINITY;
    assert!(slow.place(first, ends, 0.0).is_err());
    assert_eq!(
        slow.place(first, along_x(), f64::NAN)
            .map_err(|e| e.to_string()),
        Err("the radius is NaN; it has to be finite, and 0 or more".to_owned())
    );
    assert_eq!(SlowPairs::default().remaining(&[pair]), [pair]);
    assert!(slow.remaining(&[pair]).is_empty());
}
