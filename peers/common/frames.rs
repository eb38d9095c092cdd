//! A program that answers queries in the binary form of docs/bring-your-own.md, and times each
//! answer. At the end of its input it says how long the engine took, in one line of JSON on the
//! standard error.

use std::io::{self, Read, Write};
use std::time::{Duration, Instant};

/// A query as it is sent: points A B C D at the start of the step, then at its end.
pub struct Asked {
    pub is_face: bool,
    pub radii: [f64; 2],
    pub points: [[f64; 3]; 8],
}

/// What an engine says.
pub enum Said {
    Hit(f64),
    Miss,
    Unsupported,
}

/// The times of all answers.
#[derive(Default)]
pub struct Clock {
    times: Vec<Duration>,
}

impl Clock {
    /// What `call` returns, timed. Only the engine's own call belongs in it.
    pub fn timed<T>(&mut self, call: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = call();
        self.times.push(start.elapsed());
        result
    }

    fn report(mut self) {
        self.times.sort_unstable();
        let Some(worst) = self.times.last() else {
            return;
        };
        let count = self.times.len();
        let at = |share: f64| self.times[((share * count as f64) as usize).min(count - 1)];
        let mean = self.times.iter().sum::<Duration>().as_nanos() as f64 / count as f64;
        let [median, p99] = [0.5, 0.99].map(|share| at(share).as_nanos());
        eprintln!(
            r#"{{"calls": {count}, "mean_ns": {mean:.1}, "median_ns": {median}, "p99_ns": {p99}, "worst_ns": {}}}"#,
            worst.as_nanos()
        );
    }
}

/// How much larger the first body is asked to be, in metres.
pub fn skin() -> f64 {
    let text = std::env::var("PEERS_SKIN").unwrap_or_default();
    text.parse().unwrap_or(0.0)
}

/// Answers until the input ends.
///
/// # Errors
///
/// What the pipes say.
pub fn serve(mut answer: impl FnMut(&Asked, &mut Clock) -> Said) -> io::Result<()> {
    let (mut input, mut output) = (io::stdin().lock(), io::stdout().lock());
    let mut clock = Clock::default();
    let mut frame = [0; 228];
    while let Ok(()) = input.read_exact(&mut frame) {
        let (verdict, toi) = match answer(&asked(&frame), &mut clock) {
            Said::Miss => (0u64, 0.0),
            Said::Hit(toi) => (1, toi),
            Said::Unsupported => (2, 0.0),
        };
        let mut reply = 24u32.to_le_bytes().to_vec();
        reply.extend_from_slice(&frame[4..12]);
        reply.extend_from_slice(&verdict.to_le_bytes());
        reply.extend_from_slice(&toi.to_le_bytes());
        output.write_all(&reply)?;
        output.flush()?;
    }
    clock.report();
    Ok(())
}

fn asked(frame: &[u8; 228]) -> Asked {
    let number = |i: usize| {
        let mut bytes = [0; 8];
        bytes.copy_from_slice(&frame[20 + 8 * i..28 + 8 * i]);
        f64::from_le_bytes(bytes)
    };
    Asked {
        is_face: frame[12] == 1,
        radii: [number(0), number(1)],
        points: std::array::from_fn(|i| std::array::from_fn(|k| number(2 + 3 * i + k))),
    }
}
