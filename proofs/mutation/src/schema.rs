// What the mutated crate is given: which mutant is on, and a file of the places that were reached.

use std::cell::Cell;
use std::fs::File;
use std::os::unix::fs::FileExt;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, Ordering};

struct State {
    active: u32,
    is_watched: bool,
    reached: Option<(File, Vec<AtomicBool>)>,
}

thread_local! {
    /// Of a thread alone: to count for all of them takes longer than what is counted.
    static PASSED: Cell<u64> = const { Cell::new(0) };
}

static STATE: LazyLock<State> = LazyLock::new(|| {
    let reached = std::env::var("MUTATION_REACHED").ok().map(|path| {
        let file = File::options().create(true).truncate(false).write(true).open(path).expect("the file of places can be written");
        (file, (0..SITES).map(|_| AtomicBool::new(false)).collect())
    });
    State {
        active: std::env::var("MUTANT").ok().and_then(|id| id.parse().ok()).unwrap_or(u32::MAX),
        is_watched: reached.is_some() || std::env::var("MUTATION_WORK").is_ok(),
        reached,
    }
});

/// The mutant that is on.
#[inline]
pub fn at(site: u32) -> u32 {
    let state = &*STATE;
    if state.is_watched {
        watch(site, state);
    }
    state.active
}

fn watch(site: u32, state: &State) {
    PASSED.set(PASSED.get().wrapping_add(1));
    if let Some((file, reached)) = &state.reached
        && !reached[site as usize].swap(true, Ordering::Relaxed)
    {
        file.write_all_at(&[1], u64::from(site)).expect("the file of places can be written");
    }
}

/// How often a place was passed so far by this thread: a measure of the work that it did.
pub fn passed() -> u64 {
    PASSED.get()
}

/// A number, or 0, half of it or twice that.
#[inline]
pub fn scaled(site: u32, first: u32, value: f64) -> f64 {
    match at(site).wrapping_sub(first) {
        0 => 0.0,
        1 => 0.5 * value,
        2 => 2.0 * value,
        _ => value,
    }
}
