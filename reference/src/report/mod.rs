//! What is written down about queries and answers: lines of JSON, text and pictures.

pub mod answer;
pub mod audit;
mod caption;
pub mod explanation;
pub mod junit;
mod labels;
pub mod merge;
mod number;
pub mod page;
pub mod picture;
pub mod prices;
pub mod results;
mod svg;
pub mod tuning;
mod view;
