//! What programs write to their standard error, in bounded memory.

use std::collections::VecDeque;
use std::io::Read;
use std::sync::{Arc, Mutex};

use super::lock;

/// How much of it is kept, in bytes.
const MOST: usize = 16 << 10;

/// The end of what was written.
#[derive(Default)]
pub(super) struct Stderr {
    bytes: VecDeque<u8>,
    has_lost: bool,
}

impl Stderr {
    fn push(&mut self, bytes: &[u8]) {
        self.bytes.extend(bytes);
        let surplus = self.bytes.len().saturating_sub(MOST);
        self.has_lost |= surplus > 0;
        self.bytes.drain(..surplus);
    }

    /// What is kept, from the first whole line on.
    pub(super) fn text(&self) -> String {
        let bytes: Vec<u8> = self.bytes.iter().copied().collect();
        let text = String::from_utf8_lossy(&bytes).into_owned();
        match text.split_once('\n') {
            Some((_, rest)) if self.has_lost => format!("...\n{rest}"),
            _ => text,
        }
    }
}

/// Keeps all that comes, to the end.
pub(super) fn keep(mut from: impl Read, stderr: &Arc<Mutex<Stderr>>) {
    let mut bytes = [0; 4096];
    while let Ok(count @ 1..) = from.read(&mut bytes) {
        lock(stderr).push(&bytes[..count]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stderr_keeps_the_last_whole_lines_of_much() {
        let stderr = Arc::default();
        let text: String = (0..10_000).map(|n| format!("line {n}\n")).collect();
        keep(text.as_bytes(), &stderr);
        let kept = lock(&stderr).text();
        assert!(kept.len() <= MOST && kept.len() > MOST / 2);
        assert!(kept.starts_with("...\nline ") && kept.ends_with("line 9999\n"));
        assert!(text.ends_with(kept.trim_start_matches("...\n")));
    }
}
