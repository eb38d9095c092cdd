//! Whether the numbers of a record are those of a motion.

use tunnelproof::query::Point;
use tunnelproof::wire::{StepRecord, WireRecord};

use super::finding::{Field, StepField, What};

/// Each wire with numbers that are no motion: the first of them.
pub(super) fn unsound(record: &StepRecord) -> Vec<What> {
    let wires = record.wires.iter().enumerate();
    let faults = wires.filter_map(|(wire, of)| {
        let (field, at) = fault(of)?;
        Some(What::Unsound { wire, field, at })
    });
    faults.collect()
}

/// Whether no question can be asked about a record with this fault: what is in it depends on the number.
pub(super) fn hides_motion(what: &What) -> bool {
    !matches!(
        what,
        What::Unsound {
            field: Field::Tensions | Field::Torque | Field::Twist,
            ..
        }
    )
}

fn fault(wire: &WireRecord) -> Option<(Field, Option<usize>)> {
    let nodes = wire.before.len();
    let lengths = [
        (Field::Before, nodes.max(2), nodes),
        (Field::After, nodes, wire.after.len()),
        (Field::Arcs, nodes, wire.arcs.len()),
        (Field::Kinds, nodes, wire.kinds.len()),
    ];
    let uneven = lengths.into_iter().find(|(_, due, is)| due != is);
    if let Some((field, ..)) = uneven {
        return Some((field, None));
    }
    let is_finite = |point: &Point| point.iter().all(|x| x.is_finite());
    for (field, points) in [(Field::Before, &wire.before), (Field::After, &wire.after)] {
        if let Some(at) = points.iter().position(|point| !is_finite(point)) {
            return Some((field, Some(at)));
        }
    }
    if !(wire.radius > 0.0 && wire.radius.is_finite()) {
        return Some((Field::Radius, None));
    }
    let ascends = |at: usize| match at.checked_sub(1) {
        None => wire.arcs[0] == 0.0,
        Some(before) => wire.arcs[at] > wire.arcs[before] && wire.arcs[at].is_finite(),
    };
    if let Some(at) = (0..nodes).find(|&at| !ascends(at)) {
        return Some((Field::Arcs, Some(at)));
    }
    if wire.tensions.len() + 1 != nodes {
        return Some((Field::Tensions, None));
    }
    let not_finite = wire
        .tensions
        .iter()
        .position(|tension| !tension.is_finite());
    if let Some(at) = not_finite {
        return Some((Field::Tensions, Some(at)));
    }
    let numbers = [(Field::Torque, wire.torque), (Field::Twist, wire.twist)];
    let not_finite = numbers.into_iter().find(|(_, value)| !value.is_finite());
    not_finite.map(|(field, _)| (field, None))
}

/// Number and time of a step.
pub(super) type Clock = (u64, f64);

/// What of a step does not follow the one before, or is no number for a step.
pub(super) fn out_of_order(record: &StepRecord, before: Option<Clock>) -> Vec<What> {
    let follows = |(step, _): Clock| step.checked_add(1) == Some(record.step);
    let is_later = |(_, time): Clock| record.time > time;
    let share = record.collisions.guarded_thickness;
    let checks = [
        (StepField::Number, before.is_none_or(follows)),
        (
            StepField::Time,
            record.time.is_finite() && before.is_none_or(is_later),
        ),
        (StepField::GuardedThickness, (0.0..1.0).contains(&share)),
    ];
    let wrong = checks.into_iter().filter(|(_, is_right)| !is_right);
    wrong
        .map(|(field, _)| What::StepUnsound { field })
        .collect()
}
