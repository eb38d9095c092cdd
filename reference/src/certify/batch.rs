//! Work on a stream in parallel, results in the order of the stream.

use std::panic::resume_unwind;
use std::sync::mpsc::{Receiver, sync_channel};
use std::thread;

use rayon::prelude::*;

/// How many items are worked on at once, and how many more are read ahead.
const BATCH: usize = 4096;

/// Calls `work` on every item, in parallel, and `sink` on every result, in the order of the items.
/// See [`map_chunks_in_order`].
///
/// # Errors
///
/// The first error of the stream, of `work` or of `sink`, after the results before it.
pub fn map_in_order<T, R, E>(
    items: impl Iterator<Item = Result<T, E>> + Send + 'static,
    work: impl Fn(T) -> Result<R, E> + Sync,
    sink: impl FnMut(Vec<R>) -> Result<(), E>,
) -> Result<(), E>
where
    T: Send + 'static,
    R: Send,
    E: Send + 'static,
{
    let work = |items: Vec<T>| items.into_iter().map(&work).collect();
    map_chunks_in_order(items, 1, work, sink)
}

/// Calls `work` on chunks of up to `size` consecutive items, in parallel, and `sink` on every
/// result, in the order of the items. `work` gives as many results as it gets items, or ends with
/// an error.
///
/// The stream is read on a thread of its own, and what there is of it is worked on at once: whoever
/// waits for an answer before asking on gets it. Memory is bounded by the size of a batch.
///
/// # Errors
///
/// The first error of the stream, of `work` or of `sink`, after the results before it.
pub fn map_chunks_in_order<T, R, E>(
    items: impl Iterator<Item = Result<T, E>> + Send + 'static,
    size: usize,
    work: impl Fn(Vec<T>) -> Vec<Result<R, E>> + Sync,
    mut sink: impl FnMut(Vec<R>) -> Result<(), E>,
) -> Result<(), E>
where
    T: Send + 'static,
    R: Send,
    E: Send + 'static,
{
    let (sender, receiver) = sync_channel(BATCH);
    let reader = thread::spawn(move || {
        for item in items {
            if sender.send(item).is_err() {
                return;
            }
        }
    });
    while let Some(batch) = next_batch(&receiver) {
        let results: Vec<_> = batch
            .into_par_iter()
            .chunks(size)
            .flat_map_iter(|chunk| up_to_error(chunk, &work))
            .collect();
        let mut failure = None;
        let good = results
            .into_iter()
            .map_while(|result| result.map_err(|error| failure = Some(error)).ok())
            .collect();
        sink(good)?;
        if let Some(error) = failure {
            return Err(error);
        }
    }
    // A stream that panics has not ended.
    match reader.join() {
        Ok(()) => Ok(()),
        Err(panic) => resume_unwind(panic),
    }
}

/// The work on the items before the first error, and that error.
fn up_to_error<T, R, E>(
    chunk: Vec<Result<T, E>>,
    work: impl Fn(Vec<T>) -> Vec<Result<R, E>>,
) -> Vec<Result<R, E>> {
    let mut failure = None;
    let good = chunk.into_iter().map_while(|item| match item {
        Ok(item) => Some(item),
        Err(error) => {
            failure = Some(Err(error));
            None
        }
    });
    let mut results = work(good.collect());
    results.extend(failure);
    results
}

/// The items that are there, at least one; `None` at the end of the stream.
fn next_batch<T>(receiver: &Receiver<T>) -> Option<Vec<T>> {
    let mut batch = vec![receiver.recv().ok()?];
    batch.extend(receiver.try_iter().take(BATCH - 1));
    Some(batch)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn map_in_order_keeps_the_order_over_many_batches() {
        let items = (0..3 * BATCH as u64 + 7).map(Ok::<_, ()>);
        let mut seen = Vec::new();
        let sink = |results: Vec<_>| {
            seen.extend(results);
            Ok(())
        };
        map_in_order(items, |n| Ok(n * n), sink).unwrap();
        let expected: Vec<_> = (0..3 * BATCH as u64 + 7).map(|n| n * n).collect();
        assert_eq!(seen, expected);
    }

    #[test]
    fn map_chunks_in_order_gives_chunks_and_stops_at_an_error_within_one() {
        let items = (0..1_000).map(|n| if n == 700 { Err("stream") } else { Ok(n) });
        let mut seen = Vec::new();
        let work = |chunk: Vec<u32>| {
            assert!(chunk.len() <= 64);
            chunk.into_iter().map(|n| Ok(n + 1)).collect()
        };
        let sink = |results: Vec<u32>| {
            seen.extend(results);
            Ok(())
        };
        assert_eq!(map_chunks_in_order(items, 64, work, sink), Err("stream"));
        assert_eq!(seen, (1..=700).collect::<Vec<_>>());
    }

    #[test]
    #[should_panic(expected = "broken stream")]
    fn map_in_order_stream_that_panics_does_not_pass_for_its_end() {
        let items = (0..10).map(|n| match n {
            7 => panic!("broken stream"),
            n => Ok::<_, ()>(n),
        });
        let _ = map_in_order(items, Ok, |_| Ok(()));
    }

    #[test]
    fn map_in_order_delivers_what_is_before_the_first_error() {
        let items = (0..10_000).map(|n| if n == 9_000 { Err("stream") } else { Ok(n) });
        for (bad, last, error) in [(7_777, 7_777, "work"), (9_500, 9_000, "stream")] {
            let mut count = 0;
            let work = |n| if n == bad { Err("work") } else { Ok(n) };
            let sink = |results: Vec<_>| {
                count += results.len();
                Ok(())
            };
            assert_eq!(map_in_order(items.clone(), work, sink), Err(error));
            assert_eq!(count, last);
        }
    }
}
