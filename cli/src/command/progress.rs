//! Progress bars, on the standard error if that is a terminal.

use std::io::IsTerminal;
use std::sync::atomic::{AtomicU64, Ordering};

use indicatif::{ProgressBar, ProgressStyle};
use tunnelproof_reference::certify::shard::Shard;
use tunnelproof_reference::certify::source::{AnySource, Source};

/// A bar for the queries of a part of these sources.
pub(super) fn of_sources(sources: &[AnySource], shard: Shard) -> ProgressBar {
    of_counts(sources.iter().map(AnySource::count).sum(), shard)
}

fn of_counts(count: Option<u64>, shard: Shard) -> ProgressBar {
    match count {
        Some(count) => of(count / shard.of()),
        None if is_shown() => ProgressBar::new_spinner(),
        None => ProgressBar::hidden(),
    }
}

/// Reads queries under a bar.
pub(super) fn reading<T>(sources: &[Source], read: impl FnOnce(&dyn Fn(u64)) -> T) -> T {
    let bar = of_counts(sources.iter().map(Source::count).sum(), Shard::WHOLE);
    bar.set_message("reading");
    let read = read(&|queries| bar.inc(queries));
    bar.finish_and_clear();
    read
}

/// Works under a bar with a message.
pub(super) fn working<T>(
    count: usize,
    message: &'static str,
    work: impl FnOnce(&(dyn Fn(u64) + Sync)) -> T,
) -> T {
    let bar = of(count as u64);
    bar.set_message(message);
    let result = work(&|queries| bar.inc(queries));
    bar.finish_and_clear();
    result
}

/// Works under a count; how many there will be is not known.
pub(super) fn counting<T>(message: &'static str, work: impl FnOnce(&dyn Fn(u64)) -> T) -> T {
    let bar = match is_shown() {
        true => ProgressBar::new_spinner(),
        false => ProgressBar::hidden(),
    };
    let result = work(&|more| {
        bar.inc(more);
        bar.set_message(format!("{} {message}", bar.position()));
    });
    bar.finish_and_clear();
    result
}

/// Works under a count of settings, each judged on so many queries; how many there will be is not
/// known.
pub(super) fn searching<T>(queries: usize, work: impl FnOnce(&(dyn Fn(u64) + Sync)) -> T) -> T {
    let bar = match is_shown() {
        true => ProgressBar::new_spinner(),
        false => ProgressBar::hidden(),
    };
    let judged = AtomicU64::new(0);
    let result = work(&|more| {
        let judged = judged.fetch_add(more, Ordering::Relaxed) + more;
        bar.set_message(format!("{} settings", judged / queries.max(1) as u64));
        bar.tick();
    });
    bar.finish_and_clear();
    result
}

/// A bar for so many queries.
pub(super) fn of(count: u64) -> ProgressBar {
    match is_shown() {
        true => ProgressBar::new(count).with_style(style()),
        false => ProgressBar::hidden(),
    }
}

fn is_shown() -> bool {
    std::io::stderr().is_terminal()
}

fn style() -> ProgressStyle {
    ProgressStyle::with_template("{bar:40} {human_pos} of {human_len} {msg} {eta}")
        .unwrap_or_else(|_| ProgressStyle::default_bar())
}
