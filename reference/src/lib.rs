//! The judge: an exact oracle, an exact shadow of the thesis' algorithms, and what compares them
//! with an engine. [`certify()`] judges an engine from a test.

pub mod algebraic;
pub mod answer;
pub mod audit;
pub mod certify;
pub mod corpus;
pub mod difference;
pub mod field;
pub mod fuzz;
pub mod generate;
pub mod oracle;
pub mod perturb;
pub mod poly;
pub mod program;
pub mod registry;
pub mod replay;
pub mod report;
pub mod scaled;
pub mod shadow;
mod shape;
pub mod shrink;
pub mod simulate;
pub mod subject;
pub mod sweep;
pub mod tables;
pub mod tune;
pub mod vectors;
pub mod vtk;

pub use certify::trial::certify;
