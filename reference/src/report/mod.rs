//! Answers and certificates as JSON, which is read again and merged; explanations as text and
//! JSON.

pub mod answer;
pub mod boxes;
pub mod explanation;
pub mod merge;
pub mod number;
pub mod results;
