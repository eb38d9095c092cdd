use std::collections::{BTreeMap, HashSet};
use std::convert::Infallible;
use std::iter;

use nalgebra::Vector3;
use rand::TryRng;
use rand::rand_core::utils;
use tunnelproof::contact::Case;
use tunnelproof::query::QueryKind;

use super::*;

const COUNT: u64 = 20_000;

/// The position at `t` of points that are given by index, 0 to 3 for A to D.
fn at(query: &Query, t: f64) -> [Vector3<f64>; 4] {
    [0, 1, 2, 3].map(|i| query.start()[i].coords * (1.0 - t) + query.end()[i].coords * t)
}

/// `K = B - A`, `L = D - C`, `M = C - A`.
fn edges(query: &Query, t: f64) -> [Vector3<f64>; 3] {
    let [a, b, c, d] = at(query, t);
    [b - a, d - c, c - a]
}

/// The case of a query on small integers, where `f64` is exact: a polynomial of degree 3 or less is
/// 0 if it is 0 at `t` = 0, 1, 2 and 3.
fn case(query: &Query) -> Case {
    let always = |is_zero: fn([Vector3<f64>; 3]) -> bool| {
        [0.0, 1.0, 2.0, 3.0]
            .into_iter()
            .all(|t| is_zero(edges(query, t)))
    };
    let zero = Vector3::zeros();
    if always(|[k, _, _]| k == Vector3::zeros()) || always(|[_, l, _]| l == Vector3::zeros()) {
        Case::Degenerate
    } else if edges(query, 0.0)[2] == zero && edges(query, 1.0)[2] == zero {
        Case::SharedStart
    } else if always(|[k, l, m]| [k.cross(&l), k.cross(&m), l.cross(&m)] == [Vector3::zeros(); 3]) {
        Case::Collinear
    } else if always(|[k, l, _]| k.cross(&l) == Vector3::zeros()) {
        Case::Parallel
    } else if always(|[k, l, m]| k.cross(&l).dot(&m) == 0.0) {
        Case::Coplanar
    } else {
        Case::General
    }
}

/// Whether the edges of a query in general position meet, to within rounding: each change of sign
/// of `f` is bisected and the parameters there are read off.
fn hits(query: &Query) -> bool {
    let f = |t| {
        let [k, l, m] = edges(query, t);
        k.cross(&l).dot(&m)
    };
    let steps = 64;
    (0..steps).any(|step| {
        let (mut low, mut high) = (f64::from(step) / 64.0, f64::from(step + 1) / 64.0);
        if (f(low) < 0.0) == (f(high) < 0.0) {
            return false;
        }
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if (f(low) < 0.0) == (f(middle) < 0.0) {
                low = middle;
            } else {
                high = middle;
            }
        }
        let [k, l, m] = edges(query, low);
        let n = k.cross(&l);
        let u = m.cross(&l).dot(&n) / n.norm_squared();
        let v = m.cross(&k).dot(&n) / n.norm_squared();
        (0.0..=1.0).contains(&u) && (0.0..=1.0).contains(&v)
    })
}

#[test]
fn families_names_are_unique_and_fit_the_key() {
    let names: HashSet<_> = FAMILIES.iter().map(Family::name).collect();
    assert_eq!(names.len(), FAMILIES.len());
    for family in FAMILIES {
        assert!(family.name().len() <= 24, "{}", family.name());
        assert!(!family.name().contains([':', '#']), "{}", family.name());
        assert!(!family.description().is_empty() && !family.description().contains('\n'));
        assert_eq!(by_name(family.name()).unwrap().name(), family.name());
    }
    assert!(by_name("Uniform").is_none());
}

#[test]
fn families_query_depends_on_family_seed_and_index_alone() {
    for family in FAMILIES {
        let forward: Vec<_> = (0..200).map(|index| family.query(7, index)).collect();
        let thread = std::thread::spawn(|| (0..200).rev().map(|i| family.query(7, i)).collect());
        let mut backward: Vec<_> = thread.join().unwrap();
        backward.reverse();
        assert_eq!(forward, backward, "{}", family.name());
        let other: Vec<_> = (0..200).map(|index| family.query(8, index)).collect();
        assert_ne!(forward, other, "{}", family.name());
        assert_ne!(family.query(7, 0), family.query(7, u64::MAX));
    }
    assert_ne!(FAMILIES[0].query(7, 0), FAMILIES[1].query(7, 0));
}

/// The bits of the first queries of seed 1, mixed (FNV-1a).
fn digest(family: &Family) -> u64 {
    let queries = (0..1000).map(|index| family.query(1, index));
    let points = queries.flat_map(|query| [*query.start(), *query.end()].concat());
    let bits = points.flat_map(|point| [point.x, point.y, point.z].map(f64::to_bits));
    bits.fold(0xcbf2_9ce4_8422_2325, |digest, bits| {
        (digest ^ bits).wrapping_mul(0x100_0000_01b3)
    })
}

/// What an identifier names must not change, whatever a family's code does.
#[test]
fn families_queries_stay_the_same() {
    let digests: Vec<_> = FAMILIES.iter().map(|f| (f.name(), digest(f))).collect();
    assert_eq!(digests, DIGESTS);
}

/// The same of a family with radii.
fn digest_with_radii(family: &Family) -> u64 {
    let radii = (0..1000).flat_map(|index| family.query(1, index).radius().parts());
    radii
        .map(f64::to_bits)
        .fold(digest(family), |digest, bits| {
            (digest ^ bits).wrapping_mul(0x100_0000_01b3)
        })
}

#[test]
fn cast_families_queries_stay_the_same() {
    let digests = CAST_FAMILIES
        .iter()
        .map(|f| (f.name(), digest_with_radii(f)));
    assert_eq!(digests.collect::<Vec<_>>(), CAST_DIGESTS);
}

const CAST_DIGESTS: [(&str, u64); 21] = [
    ("cast_uniform", 0xdc59_7e8a_f525_1265),
    ("cast_lattice", 0xe711_7c65_f525_1265),
    ("cast_coplanar", 0x5481_8ec5_f525_1265),
    ("cast_parallel", 0x770d_6a95_f525_1265),
    ("cast_grazing", 0xf830_f096_7525_1265),
    ("cast_long_thin", 0xd684_3203_f525_1265),
    ("cast_far", 0x3577_7c28_f525_1265),
    ("cast_tiny", 0x8660_251a_f525_1265),
    ("cast_start", 0xe916_748e_7525_1265),
    ("cast_thin_uniform", 0xb360_fcbf_f525_1265),
    ("cast_thin_lattice", 0x780d_7c65_f525_1265),
    ("cast_thin_coplanar", 0x13de_9c15_f525_1265),
    ("cast_thin_parallel", 0xf067_6f05_f525_1265),
    ("cast_thin_far", 0x4acf_e044_3525_1265),
    ("cast_face_uniform", 0x06c9_36a8_f525_1265),
    ("cast_face_lattice", 0x9315_7c65_f525_1265),
    ("cast_face_grazing", 0xdad1_70a1_7525_1265),
    ("cast_face_long_thin", 0x37b9_f081_f525_1265),
    ("cast_face_far", 0x8a69_774d_3525_1265),
    ("cast_face_tiny", 0xac5c_6657_f525_1265),
    ("cast_face_start", 0x9a71_4331_7525_1265),
];

const DIGESTS: [(&str, u64); 16] = [
    ("uniform", 0x90e1_f756_7887_2025),
    ("lattice", 0x38a1_60f1_e188_9625),
    ("near_coplanar", 0x7ec1_5ac2_d0d9_16e6),
    ("near_parallel", 0xa59f_0bf4_3aae_9b48),
    ("near_collinear", 0x3b7c_508c_8860_f3e1),
    ("shared_start", 0x5614_785f_7926_0ad5),
    ("point_on_line", 0x86bc_bd03_cccf_fc08),
    ("temporarily_parallel", 0xb44c_c580_eaa6_6c68),
    ("temporarily_point", 0x8327_5a74_0050_4dcc),
    ("grazing", 0x5797_51ad_66e8_5ff0),
    ("triple_root", 0x042a_098f_d4be_bb20),
    ("scales", 0x3ca4_b8d6_aff2_109c),
    ("cancellation", 0xa7dd_99bd_ad37_5f93),
    ("slow", 0x479a_4309_9511_f592),
    ("long_thin", 0x5ce4_777e_6c14_b92d),
    ("joint", 0xbbe5_22b6_e792_b744),
];

/// What an identifier names must not change: a release of `rand` that draws other numbers fails
/// here.
#[test]
fn families_query_stays_the_same_over_releases() {
    let query = by_name("uniform").unwrap().query(1, 0);
    let first = [-0.2608884950115704, 0.9434937473308009, 0.9842958415240841];
    let last = [0.2855403495313489, 0.859427743839916, 0.3966275418495373];
    assert_eq!(query.start()[0].coords.as_slice(), first);
    assert_eq!(query.end()[3].coords.as_slice(), last);
    let query = by_name("lattice").unwrap().query(1, 4711);
    let first: [[f64; 3]; 2] = [[-3.0, -2.0, -2.0], [-1.0, 3.0, -1.0]];
    let last: [[f64; 3]; 2] = [[0.0, 1.0, 1.0], [2.0, 0.0, -1.0]];
    let ends = [query.start(), query.end()];
    assert_eq!(ends.map(|points| points[0]), first.map(Point::from));
    assert_eq!(ends.map(|points| points[3]), last.map(Point::from));
}

#[test]
fn uniform_queries_hit_one_time_in_five() {
    let family = by_name("uniform").unwrap();
    let mut hit = 0;
    for index in 0..COUNT {
        let query = family.query(1, index);
        let points = query.start().iter().chain(query.end());
        for coordinate in points.flat_map(|point| point.iter()) {
            assert!((-1.0..1.0).contains(coordinate));
        }
        assert_eq!(query.kind(), QueryKind::EdgeEdge);
        hit += u64::from(hits(&query));
    }
    let share = hit as f64 / COUNT as f64;
    assert!(
        (0.19..0.21).contains(&share),
        "{share} of uniform queries hit"
    );
}

#[test]
fn lattice_queries_meet_every_case_often() {
    let family = by_name("lattice").unwrap();
    let mut counts = BTreeMap::new();
    let mut temporarily_parallel = 0;
    for index in 0..COUNT {
        let query = family.query(1, index);
        let points = query.start().iter().chain(query.end());
        for coordinate in points.flat_map(|point| point.iter()) {
            assert!(coordinate.fract() == 0.0 && coordinate.abs() <= 5.0);
        }
        *counts.entry(case(&query)).or_insert(0) += 1;
        let [k, l, _] = edges(&query, 0.5);
        temporarily_parallel +=
            u64::from(case(&query) == Case::General && k.cross(&l) == Vector3::zeros());
    }
    for case in Case::ALL {
        let share = f64::from(*counts.get(&case).unwrap_or(&0)) / COUNT as f64;
        assert!(share > 0.1, "{case}: {share} of {counts:?}");
    }
    assert!(temporarily_parallel > COUNT / 500, "{temporarily_parallel}");
}

#[test]
fn generated_id_is_read_as_it_is_written() {
    let id: GeneratedId = "lattice:1:4711".parse().unwrap();
    assert_eq!((id.family.name(), id.seed, id.index), ("lattice", 1, 4711));
    assert_eq!(id.to_string(), "lattice:1:4711");
    assert_eq!(id.query(), by_name("lattice").unwrap().query(1, 4711));
}

#[test]
fn generated_id_errors_name_the_part() {
    let no_family = format!("no such family; there are {}", names());
    for (text, message) in [
        ("lattice", "not of the form FAMILY:SEED:INDEX"),
        ("lattice:1", "not of the form FAMILY:SEED:INDEX"),
        ("lattice:1:2:3", "not of the form FAMILY:SEED:INDEX"),
        ("lettuce:1:2", &no_family),
        (
            "lattice:-1:2",
            "the seed is not an integer from 0 to 18446744073709551615",
        ),
        (
            "lattice:1:18446744073709551616",
            "the index is not an integer from 0 to 18446744073709551615",
        ),
    ] {
        let error = text.parse::<GeneratedId>().unwrap_err();
        assert_eq!(error.to_string(), message, "{text}");
    }
}

/// Random numbers from any bytes.
struct Bytes<I>(I);

impl<I: Iterator<Item = u8>> TryRng for Bytes<I> {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        utils::next_word_via_fill(self)
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        utils::next_word_via_fill(self)
    }

    fn try_fill_bytes(&mut self, target: &mut [u8]) -> Result<(), Infallible> {
        target.fill_with(|| self.0.next().expect("an endless sequence"));
        Ok(())
    }
}

#[test]
fn families_draw_ends_in_a_query_whatever_the_random_numbers() {
    for family in FAMILIES {
        for byte in 0..=u8::MAX {
            family.draw(&mut Bytes(iter::repeat(byte)));
        }
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for length in 0..4000 {
            let mut bytes = vec![0; length % 200];
            random.fill_bytes(&mut bytes);
            family.draw(&mut Bytes(bytes.into_iter().chain(iter::repeat(0))));
        }
    }
}
