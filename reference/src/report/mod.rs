//! What is written down about queries and answers: lines of JSON, text and pictures.

pub mod answer;
mod caption;
pub mod explanation;
mod labels;
mod number;
pub mod picture;
pub mod results;
mod svg;
mod view;
