use super::*;
use crate::certified::exact::thick::{decide_thick_edges, decide_thick_face};
use crate::certified::testing::Random;
use crate::query::Radius;

/// Whole coordinates, two of three of the small ones off by less than an ulp of 1, so that the four
/// points are often coplanar but for that.
fn positions(random: &mut Random) -> Positions {
    let corners = |random: &mut Random| {
        [0; 4].map(|_: i32| {
            [3, 3, 0].map(|most: i32| {
                let whole = f64::from(random.whole(-most, most));
                let off = f64::from(random.whole(-1, 1)) * 2f64.powi(-60);
                if whole == 0.0 { off } else { whole }
            })
        })
    };
    Positions {
        start: corners(random),
        end: corners(random),
    }
}

#[test]
fn side_at_a_contact_is_that_of_the_general_stage() {
    let mut random = Random::new(81);
    let (mut sides, mut open) = ([0; 2], 0);
    for _ in 0..2_000 {
        let positions = positions(&mut random);
        let radius = Radius::from(f64::from(random.whole(1, 4)) / 4.0);
        let Positions { start, end } = positions;
        let [start, end] = [start, end].map(|[a, b, c, d]| [b, c, a, d]);
        let as_edges = Positions { start, end };
        let edges = decide_thick_edges(&positions, radius);
        let edges = edges.map(|hit| ([hit.toi, hit.toi_above], hit.side, hit.case));
        let face = decide_thick_face(&positions, radius, || passage_of_face(&as_edges));
        let face = face.map(|hit| ([hit.toi, hit.toi_above], hit.side, hit.case));
        for (hit, is_face) in [(edges, false), (face, true)] {
            let Some((toi, expected, Case::General)) = hit else {
                continue;
            };
            if toi[1] == 0.0 {
                continue;
            }
            let side = match is_face {
                true => side_of_face(&as_edges, toi),
                false => side_of_edges(&positions, toi),
            };
            match side {
                Some(side) => {
                    assert_eq!(side, expected, "{positions:?} {radius:?}");
                    sides[usize::from(side > 0)] += 1;
                }
                None => open += 1,
            }
        }
    }
    assert!(
        sides.iter().all(|&count| count > 100) && open < 50,
        "{sides:?} {open}"
    );
}

/// A root of `f` at the contact itself, or between the same two numbers, is for others to decide.
#[test]
fn side_is_left_open_at_a_root() {
    // Two edges at right angles, of which one falls onto the other: f is 0 at 1/2.
    let start = [
        [-1.0, 0.0, 0.5],
        [1.0, 0.0, 0.5],
        [0.0, -1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let mut end = start;
    end[0][2] = -0.5;
    end[1][2] = -0.5;
    let positions = Positions { start, end };
    let side = |toi| side_of_edges(&positions, toi);
    let half = 0.5f64;
    let (before, after) = (side([0.25; 2]), side([0.75; 2]));
    assert!(before.is_some() && before == after.map(|side| -side));
    assert_eq!(side([half.next_down(), half]), before);
    assert_eq!(side([half; 2]), before);
    assert_eq!(side([half, half.next_up()]), None);
}
