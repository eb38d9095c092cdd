//! What is written down about queries and answers: lines of JSON, text and pictures.

pub mod answer;
pub mod results;
