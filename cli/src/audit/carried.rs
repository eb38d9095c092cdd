//! Whether nodes are where their records say that something has them.
//!
//! What is fixed to a body is not asked about beside this body, and what is fixed to one point not
//! beside what else is. So that a node is fixed is checked, where each step starts and where it ends.

use std::borrow::Cow;

use nalgebra::Vector3;
use tunnelproof::query::Point;
use tunnelproof::rigid::RigidMotion;
use tunnelproof::wire::{NodeKind, Pose, StepRecord};

use super::bodies::pose;
use super::finding::What;

/// How far rounding may take a node from its place on a body, in each coordinate, as a part of the
/// largest coordinates of the place `l` in the body's frame and of the body's centre `c`.
///
/// With `u = 2^-53`: the stepper puts a node at `c + (l + w t + v x t)` with `t = 2 v x l`, once, by the
/// pose where the step ends. Each coordinate of `t` is off by at most `4 u |l|`, so `t` by `7 u |l|`, and
/// each coordinate of the place by `24 u |l| + u |c|`. A contact node that is put on a body stays where
/// it is, and gets its `l` by the same formula turned back: that moves its place by at most `44 u |l|`.
/// The formula used here divides by `|q|^2`, and is off by `35 u |l| + u |c|`. As `|l|` is less than
/// 1.75 times the largest coordinate of `l`, these are 139, and 16 more are for the rounding of `|q|^2`
/// in [`is_there`].
const ROUNDING: f64 = 256.0 * (f64::EPSILON / 2.0);

/// How far the square of the length of an orientation may be from 1: the stepper takes lengths that are
/// 1 within 1e-9.
const UNIT: f64 = 2.1e-9;

/// Whether an orientation is one that the stepper takes.
pub(super) fn is_unit(pose: &Pose) -> bool {
    off_unit(pose) <= UNIT
}

fn off_unit(pose: &Pose) -> f64 {
    (pose.orientation.quaternion().norm_squared() - 1.0).abs()
}

/// Whether a node is at a point of a body.
///
/// The formula of the stepper is a turn of `l` only if `|q|^2 = 1`: it adds `(1 + e) (R - 1) l`, if
/// that is `1 + e`, and so is off by at most `2 e |l|`.
fn is_there(node: &Point, local: &Vector3<f64>, body: &Pose) -> bool {
    let at = pose(body);
    let Ok(rest) = RigidMotion::new(at, at) else {
        return false;
    };
    let place = rest.position(&Point::from(*local), 0.0);
    let sloppy = 4.0 * off_unit(body);
    let within = (ROUNDING + sloppy) * local.amax() + ROUNDING * at.centre.coords.amax();
    // Coordinates that are no numbers are nowhere.
    (node - place).iter().all(|apart| apart.abs() <= within)
}

/// The nodes that are not where what carries them has them.
pub(super) fn astray(record: &StepRecord) -> Vec<What> {
    let mut astray = Vec::new();
    for (wire, of) in record.wires.iter().enumerate() {
        let ways = of.before.iter().zip(&of.after);
        for (node, (kind, (before, after))) in of.kinds.iter().zip(ways).enumerate() {
            let mut found = |body: Option<usize>, at_end: bool| {
                astray.push(What::Astray {
                    wire,
                    node,
                    body,
                    at_end,
                });
            };
            let Some((carrier, local)) = kind.carrier() else {
                if *kind == NodeKind::Pinned && before != after {
                    found(None, true);
                }
                continue;
            };
            let body = record.bodies.get(carrier.0);
            let is_at = |node, pose| is_there(node, &local, pose);
            if !body.is_some_and(|body| is_at(before, &body.before)) {
                found(Some(carrier.0), false);
            } else if !body.is_some_and(|body| is_at(after, &body.after)) {
                found(Some(carrier.0), true);
            }
        }
    }
    astray
}

/// The same record, but nodes that are astray are free.
pub(super) fn freed<'a>(record: &'a StepRecord, astray: &[What]) -> Cow<'a, StepRecord> {
    let mut freed = Cow::Borrowed(record);
    for what in astray {
        if let What::Astray { wire, node, .. } = *what {
            freed.to_mut().wires[wire].kinds[node] = NodeKind::Free;
        }
    }
    freed
}

#[cfg(test)]
mod tests;
