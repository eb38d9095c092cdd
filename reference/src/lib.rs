//! The judge: an exact oracle, an exact shadow of the thesis' algorithms, and what compares them
//! with an engine. [`certify()`] judges an engine from a test.

pub mod algebraic;
pub mod answer;
pub mod boxes;
pub mod certify;
pub mod corpus;
pub mod difference;
pub mod distance;
pub mod field;
pub mod figures;
pub mod generate;
pub mod instant;
pub mod normal;
pub mod oracle;
pub mod places;
pub mod poly;
pub mod program;
pub mod registry;
pub mod report;
pub mod scaled;
pub mod shadow;
pub mod shape;
pub mod shrink;
pub mod slowest;
pub mod subject;
mod vector;

pub use certify::trial::certify;
