//! The narrow phase: the trait of every method that answers queries, also of your own.
//!
//! ```
//! use tunnelproof::certified::Certified;
//! use tunnelproof::narrow::NarrowPhase;
//! use tunnelproof::{EdgeEdge, Point};
//!
//! let p = Point::new;
//! let start = [p(-1.0, 0.0, 0.0), p(1.0, 0.0, 0.0), p(0.0, -1.0, 1.0), p(0.0, 1.0, 1.0)];
//! let mut end = start;
//! end[2].z = -1.0;
//! end[3].z = -1.0;
//! let method: &dyn NarrowPhase = &Certified;
//! let report = method.edge_edge(&EdgeEdge::new(start, end, 0.0)?)?;
//! assert_eq!(report.verdict.contact().map(|contact| contact.toi), Some(0.5));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

use std::fmt;

use crate::contact::{Case, Contact, ContactPoint, Flags, Verdict};
use crate::query::{EdgeEdge, Point, QueryKind, Radius, VertexFace};
use crate::rigid::RigidQueryKind;

/// A continuous narrow phase: the thesis path, the certified path, or a user's own.
///
/// Only [`edge_edge`](Self::edge_edge) has to be written. An answer is a function of the query:
/// batches are judged on several threads, in any order. Of a [`Report`] the time of impact is
/// judged, whether it is a hit, and the case, if it is stated; contact points and flags are not.
///
/// The judge, `tunnelproof_reference`, compares it with the exact answer. This one sees whether the
/// four points change their orientation during the step, and takes the middle of the step for the
/// time of impact:
///
/// ```
/// use tunnelproof::narrow::{NarrowPhase, Report, Unsupported};
/// use tunnelproof::query::{EdgeEdge, Point};
///
/// struct Orientation;
///
/// impl NarrowPhase for Orientation {
///     fn name(&self) -> &str {
///         "orientation"
///     }
///
///     fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
///         if !query.radius().is_zero() {
///             return Err(Unsupported::Radius(query.radius()));
///         }
///         let volume = |[a, b, c, d]: &[Point; 4]| (b - a).cross(&(d - c)).dot(&(c - a));
///         let changes = volume(query.start()) * volume(query.end()) < 0.0;
///         Ok(if changes { Report::hit(0.5) } else { Report::miss() })
///     }
/// }
///
/// let outcome = tunnelproof_reference::certify(Orientation).count(100).run()?;
/// assert!(outcome.failures[0].starts_with("orientation: "));
/// assert!(outcome.failures[0].contains(" tunnels"));
/// assert!(outcome.failures[0].contains(" false hits"));
/// # Ok::<(), tunnelproof_reference::certify::run::RunError>(())
/// ```
///
/// `certify(...).assert_passes()` in a `#[test]` fails with the worst witness of each kind.
pub trait NarrowPhase: Sync {
    /// A short name for tables, such as `my-engine`.
    fn name(&self) -> &str;

    /// Whether and when two moving edges touch.
    ///
    /// # Errors
    ///
    /// [`Unsupported`] where the method cannot take the query, for example a radius above 0.
    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported>;

    /// Whether and when a moving vertex touches a moving face.
    ///
    /// # Errors
    ///
    /// [`Unsupported`] unless the method overrides this.
    fn vertex_face(&self, _query: &VertexFace) -> Result<Report, Unsupported> {
        Err(Unsupported::Kind(QueryKind::VertexFace))
    }

    /// How far off the method declares its answers to be; nothing for one that claims exactness.
    fn tolerance(&self) -> Tolerance {
        Tolerance::NONE
    }
}

/// How far off the answers of a method may be, as it declares of itself. Finite numbers from 0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tolerance {
    /// The distance in metres that a pair without contact may come within and be called a hit.
    pub near: f64,
    /// How much later than the exact time of impact its own may be, as a part of the step.
    pub late: f64,
}

impl Tolerance {
    /// That of a method which claims exactness.
    pub const NONE: Tolerance = Tolerance {
        near: 0.0,
        late: 0.0,
    };

    /// Whether a time of impact may be later than the exact one by this.
    pub fn permits_late(&self, by: f64) -> bool {
        by <= self.late
    }
}

/// The answer to one query, with how it was reached.
///
/// [`Report::hit`] and [`Report::miss`] make one of what every method knows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Hit or miss.
    pub verdict: Verdict,
    /// The case that was taken; `None` for a method without cases.
    pub case: Option<Case>,
    /// The configuration at the time of impact.
    pub flags: Flags,
}

impl Report {
    /// A contact at this time of the step, from 0 to 1, of which no more is known: its point and
    /// weights are NaN.
    pub fn hit(toi: f64) -> Self {
        Report {
            verdict: Verdict::Hit(Contact {
                toi,
                first: ContactPoint {
                    point: Point::new(f64::NAN, f64::NAN, f64::NAN),
                    weights: [f64::NAN; 4],
                    relative_velocity: None,
                },
                second: None,
                normal: None,
            }),
            ..Report::miss()
        }
    }

    /// No contact.
    pub fn miss() -> Self {
        Report {
            verdict: Verdict::Miss,
            case: None,
            flags: Flags::default(),
        }
    }
}

/// A query that a method does not take.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Unsupported {
    /// Queries of this kind.
    Kind(QueryKind),
    /// Queries of this kind, of bodies that turn.
    Turning(RigidQueryKind),
    /// A radius other than 0.
    Radius(Radius),
}

impl fmt::Display for Unsupported {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Unsupported::Kind(kind) => write!(f, "{kind} queries are not supported"),
            Unsupported::Turning(kind) => write!(f, "{kind} queries are not supported"),
            Unsupported::Radius(radius) => {
                write!(
                    f,
                    "a radius above 0 is not supported (this one is {radius})"
                )
            }
        }
    }
}

impl std::error::Error for Unsupported {}
