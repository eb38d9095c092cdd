//! Answers and certificates as JSON, which is read again and merged.

pub mod answer;
pub mod merge;
pub mod results;
