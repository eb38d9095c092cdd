//! The method of a Master's thesis, with its thresholds: Michael Brandl, "Continuous Collision
//! Detection for Wires with Adaptive Resolution", Umeå University, 2017. Algorithms 1 to 20 in
//! `f64`.
//!
//! Every algorithm is a function of its own name, in the order of the text:
//!
//! | algorithms | section | module |
//! | --- | --- | --- |
//! | 1 to 7: which case | 3.1.1 | [`detect`] |
//! | 8 to 14: parallel for the whole step | 3.1.2 | [`parallel`] |
//! | 15 to 18: coplanar for the whole step | 3.1.3 | [`planar`] |
//! | 19, 20: general, and all together | 3.1.4 | [`general`] |
//!
//! What the algorithms call without stating it is in [`given`] and [`solve`]. Thresholds are in
//! [`threshold`], places where the text is wrong in [`text`] and in `docs/errata.md`. [`witness`]
//! is not part of Algorithms 1 to 20: it finds the points, parameters and normal at the time of
//! impact, which 2.2.2 asks for.
//!
//! ```
//! use tunnelproof::narrow::NarrowPhase;
//! use tunnelproof::thesis::Thesis;
//! use tunnelproof::{Case, EdgeEdge, Point};
//!
//! let p = Point::new;
//! let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, -1.0, 1.0), p(0.0, 1.0, 1.0)];
//! let mut end = start;
//! end[2].z = -1.0;
//! end[3].z = -1.0;
//! let report = Thesis::default().edge_edge(&EdgeEdge::new(start, end, 0.0)?)?;
//! assert!(report.verdict.is_hit());
//! assert_eq!(report.case, Some(Case::General));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The path is a heuristic: it rounds, and it decides by thresholds. It can miss contacts and
//! report contacts that do not exist. Where differences or products of coordinates overflow, a NaN
//! counts neither as zero nor as equal to anything; the answer then means little, but it is a miss
//! or a contact made of finite numbers.

pub mod detect;
pub mod general;
pub mod given;
pub mod motion;
pub mod narrow;
pub mod options;
pub mod parallel;
pub mod planar;
pub mod solve;
pub mod text;
pub mod threshold;
pub mod witness;

pub use motion::Motion;
pub use narrow::Thesis;
pub use options::{Options, Residual};
pub use text::{Erratum, Repairs};
pub use threshold::{Threshold, Thresholds};
