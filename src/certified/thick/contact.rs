//! What else is said of a contact whose time and place are certain: the side the two come from, and
//! whether the midlines cross.

use wide::f64x2;

use super::advance::Moving;
use super::refine_toi::RefinedToi;
use crate::certified::cubic::Cubic;
use crate::certified::exact::Passage;
use crate::certified::kind::Stages;
use crate::certified::motion::Positions;
use crate::contact::{Case, ContactKind, Flags, Hit};

/// The whole answer for a contact; `None` if some of it is not certain.
pub(super) fn contact<K: Stages>(
    positions: &Positions,
    moving: &Moving<f64x2>,
    &RefinedToi {
        toi: neighbours,
        spot,
        error,
        ..
    }: &RefinedToi,
) -> Option<Hit<K::Place>> {
    let cubic = Cubic::new(&moving.motion);
    let Passage { case, kind } = passage::<K>(positions, cubic.as_ref());
    let ([toi, toi_above], side) = match case {
        _ if neighbours[1] == 0.0 => (neighbours, 0),
        Case::General => {
            let quick = cubic.and_then(|cubic| match side(&cubic, neighbours[0]) {
                0.0 => None,
                side => Some(side as i8),
            });
            let side = quick.or_else(|| K::side(positions, neighbours));
            (neighbours, side?)
        }
        _ => (neighbours, 0),
    };
    Some(Hit {
        toi,
        toi_above,
        kind,
        side,
        case,
        flags: Flags::default(),
        place: K::place(spot.u, spot.v, error),
    })
}

/// What the midlines do during the step.
fn passage<K: Stages>(positions: &Positions, cubic: Option<&Cubic>) -> Passage {
    let quick = || {
        let cubic = cubic.filter(|cubic| cubic.is_not_identically_0())?;
        if cubic.has_no_root() {
            return Some(false);
        }
        let points = positions.points::<f64x2>();
        for bracket in cubic.isolate(|_, _| false)?.as_slice() {
            let crosses = K::crosses_at(&points, cubic, bracket).or_else(|| {
                let (sharp, _) = cubic.sharpen(bracket)?;
                K::crosses_at(&points, cubic, &sharp)
            })?;
            if crosses {
                return Some(true);
            }
        }
        Some(false)
    };
    let of = |crosses| Passage {
        case: Case::General,
        kind: if crosses {
            ContactKind::Crossing
        } else {
            ContactKind::Graze
        },
    };
    quick().map_or_else(|| K::passage(positions), of)
}

/// The sign of `f` just before a time of impact up to `2 u` from `t`; 0 if it is not certain.
///
/// The value is within twice the error of the cubic of that at `t`, and changes by at most 2 u
/// times three differences of coefficients: `12 u P`, less than its error.
#[inline(always)]
pub(super) fn side(cubic: &Cubic, t: f64) -> f64 {
    let (value, _) = cubic.evaluate(t);
    let error = 3.0 * cubic.error;
    let above = if value > error { 1.0 } else { 0.0 };
    let below = if value < -error { 1.0 } else { 0.0 };
    above - below
}
