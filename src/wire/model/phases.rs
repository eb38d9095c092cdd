//! What is prescribed by phases in order of time.

/// The phase that the step which starts at a time is in: a phase takes effect with the step that starts
/// nearest to it. None before the first.
pub(super) fn phase_at<P>(
    phases: &[P],
    from: impl Fn(&P) -> f64,
    time: f64,
    step: f64,
) -> Option<&P> {
    let started = |phase: &&P| from(phase) <= time + 0.5 * step;
    phases.iter().rev().find(started)
}

/// The first phase that does not start after the one before, and when the two start, it first.
pub(super) fn out_of_order<P>(phases: &[P], from: impl Fn(&P) -> f64) -> Option<(usize, [f64; 2])> {
    let starts = phases.windows(2).map(|two| [from(&two[1]), from(&two[0])]);
    let mut early = starts
        .enumerate()
        .filter(|(_, [this, before])| this <= before);
    early.next().map(|(before, starts)| (before + 1, starts))
}
