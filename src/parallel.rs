//! Work by all threads of the current pool, with the same results as by one.

/// What a function says of the numbers from 0, in order: each thread takes a share of no less than
/// some numbers.
#[cfg(feature = "rayon")]
pub(crate) fn mapped<A: Send>(
    count: usize,
    least: usize,
    each: impl Fn(usize) -> A + Sync + Send,
) -> Vec<A> {
    use rayon::prelude::*;
    let numbers = (0..count).into_par_iter().with_min_len(least);
    numbers.map(each).collect()
}

/// What a function says of the numbers from 0, in order.
#[cfg(not(feature = "rayon"))]
pub(crate) fn mapped<A>(count: usize, _: usize, each: impl Fn(usize) -> A) -> Vec<A> {
    (0..count).map(each).collect()
}

/// What a function says of the numbers from 0, in order, with tools that it may use up: they are
/// made for some numbers at a time, and what is said must not depend on what they were used for.
#[cfg(feature = "rayon")]
pub(crate) fn mapped_with<T, A: Send>(
    count: usize,
    tools: impl Fn() -> T + Sync + Send,
    each: impl Fn(&mut T, usize) -> A + Sync + Send,
) -> Vec<A> {
    use rayon::prelude::*;
    (0..count).into_par_iter().map_init(tools, each).collect()
}

/// What a function says of the numbers from 0, in order, with tools that it may use up.
#[cfg(not(feature = "rayon"))]
pub(crate) fn mapped_with<T, A>(
    count: usize,
    tools: impl Fn() -> T,
    each: impl Fn(&mut T, usize) -> A,
) -> Vec<A> {
    let mut tools = tools();
    (0..count).map(|number| each(&mut tools, number)).collect()
}

/// What two functions give, at the same time.
#[cfg(feature = "rayon")]
pub(crate) fn both<A: Send, B: Send>(
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    rayon::join(first, second)
}

/// What two functions give.
#[cfg(not(feature = "rayon"))]
pub(crate) fn both<A, B>(first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}

/// What a function makes of each thing, in order.
#[cfg(all(feature = "rayon", feature = "wire"))]
pub(crate) fn made<T: Send, A: Send>(
    things: Vec<T>,
    each: impl Fn(T) -> A + Sync + Send,
) -> Vec<A> {
    use rayon::prelude::*;
    if things.len() < 2 {
        return things.into_iter().map(each).collect();
    }
    things.into_par_iter().map(each).collect()
}

/// What a function makes of each thing, in order.
#[cfg(all(not(feature = "rayon"), feature = "wire"))]
pub(crate) fn made<T, A>(things: Vec<T>, each: impl Fn(T) -> A) -> Vec<A> {
    things.into_iter().map(each).collect()
}
