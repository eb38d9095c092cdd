// What the mutated crate is given: which mutant is on, and a file of the places that were reached.

use std::fs::File;
use std::os::unix::fs::FileExt;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

struct State {
    active: u32,
    is_watched: bool,
    reached: Option<(File, Vec<AtomicBool>)>,
    passed: AtomicU64,
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
        passed: AtomicU64::new(0),
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

#[cold]
fn watch(site: u32, state: &State) {
    state.passed.fetch_add(1, Ordering::Relaxed);
    if let Some((file, reached)) = &state.reached
        && !reached[site as usize].swap(true, Ordering::Relaxed)
    {
        file.write_all_at(&[1], u64::from(site)).expect("the file of places can be written");
    }
}

/// How often a place was passed so far: a measure of the work that was done.
pub fn passed() -> u64 {
    STATE.passed.load(Ordering::Relaxed)
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
