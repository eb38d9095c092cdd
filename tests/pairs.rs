//! Pairs by index: the answers of one by one, and what is refused.

use std::fmt::Debug;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use tunnelproof::certified::Stage;
use tunnelproof::{
    Clearance, EdgeEdge, Hit, Kind, Pairs, PairsError, Point, Query, Radius, VertexFace,
    advance_pairs, decide,
};
use tunnelproof_reference::generate::{FAMILIES, Family, OTHER_KINDS};

type Position = [f64; 3];

/// Around the sizes in which the first stages take queries.
const COUNTS: [usize; 12] = [0, 1, 7, 8, 9, 31, 32, 33, 64, 65, 257, 1000];

/// Queries with their points in arrays.
#[derive(Default)]
struct Set {
    start: Vec<Position>,
    end: Vec<Position>,
    indices: Vec<[u32; 4]>,
    radii: Vec<Radius>,
}

impl Set {
    fn push<K: Kind>(&mut self, query: &K) {
        let first = self.start.len() as u32;
        let plain = |point: &Point| [point.x, point.y, point.z];
        self.start.extend(query.start().iter().map(plain));
        self.end.extend(query.end().iter().map(plain));
        self.indices.push([0, 1, 2, 3].map(|corner| first + corner));
        self.radii.push(query.radius());
    }

    fn points(&self, pair: usize) -> [[Point; 4]; 2] {
        let of = |all: &[Position]| self.indices[pair].map(|index| all[index as usize].into());
        [of(&self.start), of(&self.end)]
    }

    /// Asks the first pairs, with the radius of each: how many hits there are.
    fn check<K: Kind>(&self, count: usize, query: impl Fn([[Point; 4]; 2], Radius) -> K) -> usize {
        let (indices, radii) = (&self.indices[..count], &self.radii[..count]);
        let pairs = Pairs::<K>::with_radii(&self.start, &self.end, indices, radii);
        let pairs = pairs.expect("they are pairs");
        let one_by_one = |pair: usize| decide(&query(self.points(pair), radii[pair]));
        let expected = (0..count).filter_map(|pair| Some((pair, one_by_one(pair)?)));
        let expected: Vec<_> = expected.collect();
        assert_eq!(bits(&pairs.decide()), bits(&expected), "{count}");
        let whole = |pair: &K| (*pair.start(), *pair.end(), pair.radius());
        for (pair, &radius) in radii.iter().enumerate() {
            let query = query(self.points(pair), radius);
            assert_eq!(pairs.get(pair).as_ref().map(whole), Some(whole(&query)));
        }
        assert!(pairs.get(count).is_none());
        let (mut found, mut stages) = (Vec::new(), Vec::<Stage>::new());
        pairs.decide_observed(
            |pair, hit| found.push((pair, hit)),
            |stage| stages.push(stage),
        );
        assert_eq!((found, stages.len()), (expected, pairs.len()), "{count}");
        #[cfg(feature = "rayon")]
        assert_eq!(pairs.par_decide(), pairs.decide());
        pairs.decide().len()
    }
}

/// Zeros of both signs differ in it, as they do not by `==`.
fn bits<P: Debug>(hits: &[(usize, Hit<P>)]) -> String {
    format!("{hits:?}")
}

fn edges([start, end]: [[Point; 4]; 2], radius: Radius) -> EdgeEdge {
    EdgeEdge::new(start, end, radius).expect("finite")
}

fn face([start, end]: [[Point; 4]; 2], radius: Radius) -> VertexFace {
    VertexFace::new(start, end, radius).expect("finite")
}

/// The first queries of a family: those of edges, and those of a vertex and a face.
fn sets_of(family: &Family, seed: u64, count: u64) -> [Set; 2] {
    let mut sets = [Set::default(), Set::default()];
    for index in 0..count {
        match family.query(seed, index) {
            Query::EdgeEdge(query) => sets[0].push(&query),
            Query::VertexFace(query) => sets[1].push(&query),
        }
    }
    sets
}

/// Asks as many of them as they have, and adds the hits of each kind.
fn add_checked(hits: &mut [usize; 2], [of_edges, of_faces]: &[Set; 2], counts: &[usize]) {
    for &count in counts {
        if count <= of_edges.indices.len() {
            hits[0] += of_edges.check(count, edges);
        }
        if count <= of_faces.indices.len() {
            hits[1] += of_faces.check(count, face);
        }
    }
}

#[test]
fn pairs_of_every_family_are_decided_as_one_by_one() {
    let mut hits = [0; 2];
    for family in FAMILIES.iter().chain(OTHER_KINDS) {
        let sets = sets_of(family, 5, 1000);
        add_checked(&mut hits, &sets, &COUNTS);
    }
    assert!(hits[0] > 10_000 && hits[1] > 1000, "{hits:?}");
}

/// Runs that touch and runs that miss in turn, longer than what one thread takes and than what is
/// decided one by one after a sample of those that touch.
#[test]
fn long_lists_of_pairs_are_decided_as_one_by_one() {
    let rng = &mut ChaCha8Rng::seed_from_u64(23);
    let mut set = Set::default();
    while set.indices.len() < 20_000 {
        let shift = if set.indices.len() % 10_000 < 5000 {
            0.0
        } else {
            0.5
        };
        for _ in 0..rng.random_range(1..700) {
            let mut point = |axis: usize, way: f64| {
                let mut point = [0.0; 3];
                point[axis] = way;
                point.map(|x| x + rng.random_range(-0.01..0.01))
            };
            let mut start = [point(0, -1.0), point(0, 1.0), point(1, -1.0), point(1, 1.0)];
            let mut end = start;
            (start[2][2], start[3][2]) = (0.4, 0.4);
            (end[2][2], end[3][2]) = (shift - 0.4, shift - 0.4);
            let [start, end] = [start, end].map(|all| all.map(Point::from));
            let query = EdgeEdge::new(start, end, 0.0).expect("finite");
            set.push(&query);
        }
    }
    let all = set.indices.len();
    let hits = set.check(all, edges);
    assert!(all / 4 < hits && hits < 3 * all / 4, "{hits} of {all}");
    set.radii
        .iter_mut()
        .for_each(|radius| *radius = 0.01.into());
    set.check(all, edges);
}

/// Pairs with a radius and pairs without one side by side, in every mixture.
#[test]
fn pairs_with_and_without_a_radius_are_decided_as_one_by_one() {
    let mut hits = [0; 2];
    for family in FAMILIES.iter().chain(OTHER_KINDS) {
        for (every, is_thin) in [(2, true), (16, false), (100, true)] {
            let mut sets = sets_of(family, 6, 200);
            for set in &mut sets {
                for (pair, radius) in set.radii.iter_mut().enumerate() {
                    let is_other = pair % every == every - 1;
                    let thick = if radius.is_zero() {
                        0.05.into()
                    } else {
                        *radius
                    };
                    *radius = if is_other == is_thin {
                        Radius::ZERO
                    } else {
                        thick
                    };
                }
            }
            add_checked(&mut hits, &sets, &[15, 16, 17, 33, 200]);
        }
    }
    assert!(hits[0] > 10_000 && hits[1] > 1000, "{hits:?}");
}

/// What all points share moves boxes and no differences: the stage that answers is the same, alone and with others.
#[test]
fn pairs_that_move_far_together_are_decided_as_one_by_one() {
    let size = 2f64.powi(148);
    let start = [
        [-3.0, 0.0, 0.0],
        [4.0, 1.0, 0.0],
        [1.0, -5.0, 2.0],
        [0.0, 3.0, 3.0],
    ];
    let start = start.map(|point| point.map(|x: f64| x * size));
    let mut hits = 0;
    for exponent in [170, 178, 180, 181, 188, 200] {
        let shift = 2f64.powi(exponent);
        let mut end = start.map(|[x, y, z]| [x + shift, y, z]);
        end[2][2] -= 7.0 * size;
        end[3][2] -= 7.0 * size;
        let [start, end] = [start, end].map(|all| all.map(Point::from));
        let mut set = Set::default();
        for _ in 0..40 {
            set.push(&edges([start, end], (4.0 * size).into()));
        }
        hits += set.check(40, edges);
    }
    assert_eq!(hits, 240);
}

/// Points of a small cloud, which pairs share, and a pair may have twice.
#[test]
fn pairs_that_share_points_are_decided_as_one_by_one() {
    let rng = &mut ChaCha8Rng::seed_from_u64(11);
    for radius in [0.0, 0.02, 0.3] {
        let mut set = Set::default();
        let mut points = |size: f64| -> Vec<Position> {
            let point = |_| [(); 3].map(|()| rng.random_range(-size..size));
            (0..60).map(point).collect()
        };
        (set.start, set.end) = (points(1.0), points(1.0));
        let mut indices = || [(); 4].map(|()| rng.random_range(0..60));
        set.indices = (0..1000).map(|_| indices()).collect();
        // The same for all, and of every fifth pair another one.
        set.radii = vec![radius.into(); 1000];
        let (of_edges, of_faces) = (set.check(1000, edges), set.check(1000, face));
        assert!(of_edges > 10 && of_faces > 10, "{of_edges} {of_faces}");
        let same = Pairs::<EdgeEdge>::new(&set.start, &set.end, &set.indices, radius);
        let each = Pairs::with_radii(&set.start, &set.end, &set.indices, &set.radii);
        let decided =
            |pairs: Result<Pairs<EdgeEdge>, PairsError>| pairs.map(|pairs| pairs.decide());
        assert_eq!(decided(same), decided(each));
        for (pair, radius) in set.radii.iter_mut().enumerate() {
            if pair % 5 == 0 {
                *radius = [0.1, 0.05].into();
            }
        }
        set.check(1000, edges);
        set.check(1000, face);
    }
}

/// Positions in `f32` are decided as the same numbers in `f64`.
#[test]
fn pairs_in_f32_are_decided_as_the_same_numbers_in_f64() {
    let is_f32 = |query: &Query| {
        let points = query.start().iter().chain(query.end());
        points
            .flat_map(|point| point.iter())
            .all(|&x| (x as f32).is_finite())
    };
    let (mut hits, mut later) = (0, 0);
    for family in FAMILIES.iter().chain(OTHER_KINDS) {
        let queries = (0..600).map(|index| family.query(6, index)).filter(is_f32);
        let mut set = Set::default();
        for query in queries {
            match query {
                Query::EdgeEdge(query) => set.push(&query),
                Query::VertexFace(query) => set.push(&query),
            }
        }
        // The points of each query as two edges, and as a vertex and a face.
        let times = [
            times_in_f32::<EdgeEdge>(&set),
            times_in_f32::<VertexFace>(&set),
        ];
        for (single, double) in times.concat() {
            assert!(f64::from(single) <= double && f64::from(single.next_up()) > double);
            later += u32::from(f64::from(double as f32) > double);
            hits += 1;
        }
    }
    assert!(
        hits > 5000 && later > 500,
        "{hits} hits, {later} would be later"
    );
}

/// Checks that the points of a set, rounded to `f32`, are decided as the same numbers in `f64`; the
/// times of impact.
fn times_in_f32<K: Kind>(set: &Set) -> Vec<(f32, f64)>
where
    K::Place: Debug + PartialEq,
{
    let [start, end] = [&set.start, &set.end].map(|all| -> Vec<[f32; 3]> {
        let rounded = |position: &Position| position.map(|x| x as f32);
        all.iter().map(rounded).collect()
    });
    let in_f64 =
        |all: &[[f32; 3]]| -> Vec<Position> { all.iter().map(|p| p.map(f64::from)).collect() };
    let (same_start, same_end) = (in_f64(&start), in_f64(&end));
    let Set { indices, radii, .. } = set;
    let single = Pairs::<K, f32>::with_radii(&start, &end, indices, radii).expect("finite");
    let double = Pairs::<K>::with_radii(&same_start, &same_end, indices, radii).expect("finite");
    let hits = single.decide();
    assert_eq!(bits(&hits), bits(&double.decide()));
    for &(pair, hit) in &hits {
        let query = single.get(pair).expect("it is one of them");
        assert_eq!(decide(&query), Some(hit));
    }
    let times = hits.iter().map(|(_, hit)| (hit.toi_f32(), hit.toi));
    times.collect()
}

#[test]
fn what_is_no_pair_is_refused() {
    let points = [[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]];
    let mut not_finite = points;
    not_finite[2][1] = f64::NAN;
    let all = [[0, 1, 2, 3]];
    let said = |start: &[Position], end: &[Position], indices: &[[u32; 4]], radius: f64| {
        let pairs = Pairs::<EdgeEdge>::new(start, end, indices, radius);
        pairs
            .map(|pairs| pairs.len())
            .map_err(|error| error.to_string())
    };
    assert_eq!(said(&points, &points, &all, 0.0), Ok(1));
    assert_eq!(said(&[], &[], &[], 0.0), Ok(0));
    let error = |text: &str| Err(text.to_owned());
    assert_eq!(
        said(&points, &points[..3], &all, 0.0),
        error("end has 3 entries, and start has 4")
    );
    assert_eq!(
        said(&points, &not_finite, &all, 0.0),
        error("end[2][1] is NaN, not a finite number")
    );
    let single = [[0.0, 1.0, f32::INFINITY]; 4];
    let of_single = Pairs::<EdgeEdge, f32>::new(&single, &single, &all, 0.0);
    assert_eq!(
        of_single.expect_err("it is infinite").to_string(),
        "start[0][2] is inf, not a finite number"
    );
    assert_eq!(
        said(&points, &points, &[[0, 1, 2, 3], [0, 4, 1, 2]], 0.0),
        error("pair 1: point B is position 4, and there are 4, counted from 0")
    );
    assert_eq!(
        said(&points, &points, &all, -1.0),
        error("the radius is -1; it has to be finite, and 0 or more")
    );
    let of_radii = |radii: &[Radius]| {
        let pairs = Pairs::<VertexFace>::with_radii(&points, &points, &all, radii);
        pairs
            .map(|pairs| pairs.len())
            .map_err(|error| error.to_string())
    };
    assert_eq!(of_radii(&[Radius::ZERO]), Ok(1));
    assert_eq!(
        of_radii(&[]),
        error("radii has 0 entries, and there is 1 pair")
    );
    assert_eq!(
        of_radii(&[f64::INFINITY.into()]),
        error("pair 0: the radius is inf; it has to be finite, and 0 or more")
    );
}

#[test]
fn steps_of_pairs_are_refused_with_other_positions_or_clearances() {
    let points = [[0.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]];
    let mut other = points;
    other[0][0] = 1.0;
    let edges = Pairs::new(&points, &points, &[], 0.0).expect("none");
    let copied = points;
    let faces = |end| Pairs::new(&copied, end, &[], 0.0).expect("none");
    let said = |end, clearance| {
        let step = advance_pairs(&edges, &faces(end), clearance);
        step.map(|moved| moved.step)
            .map_err(|error| error.to_string())
    };
    // A copy has the same positions.
    assert_eq!(said(&copied, Clearance::None), Ok(1.0));
    let error = |text: &str| Err(text.to_owned());
    assert_eq!(
        said(&other, Clearance::None),
        error("edges and faces are lists of different positions")
    );
    assert_eq!(
        said(&copied, Clearance::Share(1.0)),
        error("the share is 1; it has to be 0 or more, and below 1")
    );
    let none = Pairs::<EdgeEdge, f32>::new(&[], &[], &[], 0.0).expect("none");
    let faces = Pairs::new(&[], &[], &[], 0.0).expect("none");
    let moved = advance_pairs(&none, &faces, Clearance::None).expect("none");
    assert_eq!((moved.step, moved.positions.len()), (1.0, 0));
}

/// Parts are decided as the same pairs of the whole, and there is no part of what there is not.
#[test]
fn parts_of_pairs_are_decided_as_in_the_whole() {
    let mut set = Set::default();
    for index in 0..100 {
        if let Query::EdgeEdge(query) = FAMILIES[0].query(7, index) {
            set.push(&query);
        }
    }
    set.radii
        .iter_mut()
        .step_by(2)
        .for_each(|radius| *radius = 0.1.into());
    let Set {
        start,
        end,
        indices,
        radii,
    } = &set;
    let each = Pairs::<EdgeEdge>::with_radii(start, end, indices, radii).expect("they are pairs");
    let same = Pairs::<EdgeEdge>::new(start, end, indices, 0.1).expect("they are pairs");
    for pairs in [each, same] {
        let all = pairs.decide();
        assert!(all.len() > 10);
        let (first, rest) = (pairs.part(0..33), pairs.part(33..100));
        let hits = first.expect("it is within").decide().into_iter();
        let rest = rest.expect("it is within").decide().into_iter();
        let hits = hits.chain(rest.map(|(pair, hit)| (pair + 33, hit)));
        assert_eq!(hits.collect::<Vec<_>>(), all);
        assert!(pairs.part(0..101).is_none());
        assert!(pairs.part(100..100).is_some_and(|part| part.is_empty()));
    }
}

/// Stages in `f32` leave open what they cannot prove: sides apart by less than the rounding of
/// `f32`, numbers near its largest and its least, and zeros of both signs.
#[test]
fn pairs_in_f32_at_its_borders_are_decided_as_the_same_numbers_in_f64() {
    let random = &mut ChaCha8Rng::seed_from_u64(2027);
    let mut hits = 0;
    for scale in [
        f32::from_bits(1),
        1e-44,
        f32::MIN_POSITIVE,
        1e-20,
        1e-16,
        1.0,
        1e16,
        1e22,
        2.9e37,
    ] {
        let mut set = Set::default();
        for _ in 0..3000 {
            let offset = [0.0, 1.0, 9.0][random.random_range(0..3)] * scale;
            let mut number = || {
                let x = [0.0, -0.0, 1.0, -1.0, 0.5, 2.0, -2.0, 0.33][random.random_range(0..8)]
                    * scale
                    + offset;
                [x, x, x.next_up(), x.next_down()][random.random_range(0..4)]
            };
            let mut points = || [(); 4].map(|()| [(); 3].map(|()| number()).map(f64::from));
            let (start, end) = (points(), points());
            let count = set.start.len() as u32;
            set.start.extend(start);
            set.end.extend(end);
            set.indices.push([0, 1, 2, 3].map(|corner| count + corner));
            set.radii.push(Radius::ZERO);
        }
        hits += times_in_f32::<EdgeEdge>(&set).len() + times_in_f32::<VertexFace>(&set).len();
    }
    assert!(hits > 5000, "{hits} hits");
}
