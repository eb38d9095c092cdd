use super::super::start_distance;
use super::super::testing::nearly_parallel;
use super::*;
use crate::certified::testing::{Random, layout, points};
use crate::query::{EdgeEdge, VertexFace};

/// How many queries are asked.
const COUNT: u32 = if cfg!(debug_assertions) { 1000 } else { 4000 };

/// Sides whose distance at the start is that of the radius, but for some rounding, and which then
/// slide, part or meet.
fn is_never_said_in_vain<K: Stages>(seed: u64, coordinates: impl Fn(&mut Random) -> [f64; 24]) {
    let random = &mut Random::new(seed);
    let [mut said, mut apart] = [0; 2];
    for _ in 0..COUNT {
        let mut x = coordinates(random);
        x.copy_within(..12, 12);
        let difference = {
            let sample = Moving::<f64x2>::new::<K>(&layout(&x).points(), 0.0);
            Instant::new::<K, _>(&sample, 0.0).difference
        };
        let speed = f64::from(random.whole(-1, 2)) * random.unit();
        let slide = [0.0; 3].map(|_| random.signed() * 2f64.powi(-random.whole(0, 60)));
        for p in K::FIRST..4 {
            for i in 0..3 {
                x[12 + 3 * p + i] += speed * difference[i] + slide[i];
            }
        }
        let positions = layout(&x);
        let distance = start_distance::<K>(&positions);
        let nudged = [distance.next_down(), distance, distance.next_up()];
        let radius = nudged[random.whole(0, 2) as usize];
        if !(radius > 1e-30) {
            continue;
        }
        let radius = Radius::from(radius);
        let moving = Moving::new::<K>(&positions.points(), super::super::rounded_up(radius));
        let here = Instant::new::<K, _>(&moving, 0.0);
        let is_said = moving.stays_apart_sharply::<K>(&positions, radius, &here, 0.0);
        let is_apart = K::decide_thick_exactly(&positions, radius).is_none();
        assert!(is_apart || !is_said, "{positions:?} {radius:?}");
        said += u32::from(is_said);
        apart += u32::from(is_apart);
    }
    println!("thick: sharp planes separate {said} of {apart} of {COUNT}");
    assert!(said > COUNT / 15 && 2 * said > apart, "{said} of {apart}");
}

#[test]
fn sharp_planes_separate_edges() {
    is_never_said_in_vain::<EdgeEdge>(1, |random| points(random, (-4, 4)));
}

#[test]
fn sharp_planes_separate_a_vertex_and_a_face() {
    is_never_said_in_vain::<VertexFace>(2, |random| points(random, (-4, 4)));
}

#[test]
fn sharp_planes_separate_edges_that_are_nearly_parallel() {
    is_never_said_in_vain::<EdgeEdge>(3, nearly_parallel);
}
