//! The lines of a text, numbered, each of bounded length.

use std::io::{BufRead, Read};

use super::error::{CorpusError, Problem};

/// The longest line that is read, in bytes; a query takes far fewer.
pub(super) const LONGEST_LINE: usize = 1 << 20;

/// A line that is not blank.
pub(super) struct Line {
    /// From 1.
    pub(super) number: u64,
    /// Without the line end and the blanks before it.
    pub(super) text: String,
}

/// The lines of `reader` that are not blank.
///
/// A byte order mark before the first is dropped. A line that is too long, is not UTF-8 or cannot
/// be read is an error, and so is a text without any line but blank ones. The reader of `path` is
/// asked for no more than a line at a time.
pub(super) struct Lines<R> {
    reader: R,
    path: String,
    number: u64,
    is_empty: bool,
}

impl<R: BufRead> Lines<R> {
    pub(super) fn new(reader: R, path: &str) -> Self {
        Lines {
            reader,
            path: path.to_owned(),
            number: 0,
            is_empty: true,
        }
    }

    /// The next line, blank or not; `None` at the end.
    fn read(&mut self) -> Result<Option<Line>, Problem> {
        self.number += 1;
        let mut bytes = Vec::new();
        self.reader
            .by_ref()
            .take(LONGEST_LINE as u64 + 1)
            .read_until(b'\n', &mut bytes)
            .map_err(Problem::Io)?;
        if bytes.is_empty() {
            return Ok(None);
        }
        if bytes.len() > LONGEST_LINE {
            return Err(Problem::LineTooLong);
        }
        let text = std::str::from_utf8(&bytes).map_err(|_| Problem::NotUtf8)?;
        let text = match self.number {
            1 => text.strip_prefix('\u{feff}').unwrap_or(text),
            _ => text,
        };
        Ok(Some(Line {
            number: self.number,
            text: text.trim_end().to_owned(),
        }))
    }
}

impl<R: BufRead> Iterator for Lines<R> {
    type Item = Result<Line, CorpusError>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            match self.read() {
                Ok(Some(line)) if line.text.trim_start().is_empty() => {}
                Ok(Some(line)) => {
                    self.is_empty = false;
                    return Some(Ok(line));
                }
                Ok(None) if self.is_empty => {
                    self.is_empty = false;
                    return Some(Err(CorpusError::new(&self.path, Problem::Empty)));
                }
                Ok(None) => return None,
                Err(problem) => {
                    self.is_empty = false;
                    return Some(Err(CorpusError::at(&self.path, self.number, problem)));
                }
            }
        }
    }
}
