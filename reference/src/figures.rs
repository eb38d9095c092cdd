//! The collision cases of thesis section 4.1, figures 4.1 to 4.12.
//!
//! The thesis shows pictures and gives no coordinates. The motions here are built from what its
//! captions state: which case, how the segments move, when they touch. Coordinates are small
//! multiples of 1/64 so that they are exact in `f64`, and every time of impact is a small fraction.
//! Edge `AB` is the blue segment, edge `CD` the green one.

use tunnelproof::contact::{Case, Flags};
use tunnelproof::query::{EdgeEdge, Point};

/// What the figures are called as a source of queries.
pub const SOURCE: &str = "figures";

/// What they are like, in one line.
pub const DESCRIPTION: &str = "the collision cases of the thesis' figures 4.1 to 4.12";

/// One figure: a motion and what is to be found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figure {
    /// The number of the figure, such as `4.1`.
    pub name: &'static str,
    /// What the caption states, in short.
    pub caption: &'static str,
    /// A, B, C and D at `t = 0`, in metres.
    pub start: [[f64; 3]; 4],
    /// A, B, C and D at `t = 1`, in metres.
    pub end: [[f64; 3]; 4],
    /// The case of the motion.
    pub case: Case,
    /// The first contact; `None` where the midlines miss each other.
    pub contact: Option<FigureContact>,
}

/// The first contact in a figure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FigureContact {
    /// The time of impact, exactly.
    pub toi: Fraction,
    /// The configuration at that time.
    pub flags: Flags,
    /// How many contact points there are: 2 where the edges overlap in more than a point.
    pub points: usize,
}

/// An exact rational number, in lowest terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fraction {
    /// Above the line.
    pub numerator: u32,
    /// Below the line.
    pub denominator: u32,
}

impl Fraction {
    const fn new(numerator: u32, denominator: u32) -> Self {
        Fraction {
            numerator,
            denominator,
        }
    }

    /// The nearest `f64`.
    pub fn to_f64(self) -> f64 {
        f64::from(self.numerator) / f64::from(self.denominator)
    }
}

impl Figure {
    /// The figure with this name, if any.
    pub fn from_name(name: &str) -> Option<&'static Figure> {
        FIGURES.iter().find(|figure| figure.name == name)
    }

    /// The motion as a query for touching midlines.
    pub fn query(&self) -> EdgeEdge {
        let [start, end] = [self.start, self.end].map(|points| points.map(Point::from));
        EdgeEdge::new(start, end, 0.0).expect("a figure has finite coordinates and radius 0")
    }
}

const NO_FLAGS: Flags = Flags {
    temporarily_parallel: false,
    temporarily_point: false,
};

const PARALLEL: Flags = Flags {
    temporarily_parallel: true,
    ..NO_FLAGS
};

const POINT: Flags = Flags {
    temporarily_point: true,
    ..NO_FLAGS
};

const fn contact(numerator: u32, denominator: u32, flags: Flags, points: usize) -> FigureContact {
    FigureContact {
        toi: Fraction::new(numerator, denominator),
        flags,
        points,
    }
}

/// Figures 4.1 to 4.12.
pub static FIGURES: [Figure; 12] = [
    Figure {
        name: "4.1",
        caption: "General: blue from left to right, green from right to left, contact at t ≈ 0.69.",
        start: [
            [-2.75, -1.0, 0.0],
            [-4.125, 3.0, -1.375],
            [2.75, 0.0, -1.0],
            [4.125, -1.375, 1.0],
        ],
        end: [
            [1.25, -1.0, 0.0],
            [1.875, 3.0, 0.625],
            [-1.25, 0.0, -1.0],
            [-1.875, 0.625, 1.0],
        ],
        case: Case::General,
        contact: Some(contact(11, 16, NO_FLAGS, 1)),
    },
    Figure {
        name: "4.2",
        caption: "General: both turn by 90 degrees and are parallel where they touch, at t = 0.5.",
        start: [
            [2.0, 0.0, -1.0],
            [2.0, 0.0, 1.0],
            [-2.0, -1.0, 0.0],
            [-2.0, 1.0, 0.0],
        ],
        end: [
            [-2.0, -1.0, 0.0],
            [-2.0, 1.0, 0.0],
            [2.0, 0.0, -1.0],
            [2.0, 0.0, 1.0],
        ],
        case: Case::General,
        contact: Some(contact(1, 2, PARALLEL, 2)),
    },
    Figure {
        name: "4.3",
        caption: "General: blue turns inside out and is a point at t = 0.5, where green meets it.",
        start: [
            [-1.0, 0.0, -2.0],
            [1.0, 0.0, -2.0],
            [-2.0, -2.0, 0.0],
            [-2.0, 0.0, 0.0],
        ],
        end: [
            [1.0, 0.0, 2.0],
            [-1.0, 0.0, 2.0],
            [2.0, 0.0, 0.0],
            [2.0, 2.0, 0.0],
        ],
        case: Case::General,
        contact: Some(contact(1, 2, POINT, 1)),
    },
    Figure {
        name: "4.4",
        caption: "Shared start: A and C move together from right to left, contact at t = 0.",
        start: [
            [2.0, 0.0, 0.0],
            [3.0, 1.0, 0.0],
            [2.0, 0.0, 0.0],
            [3.0, -1.0, 0.5],
        ],
        end: [
            [-2.0, 0.0, 0.0],
            [-1.0, 1.0, 0.5],
            [-2.0, 0.0, 0.0],
            [-1.0, -1.0, 0.0],
        ],
        case: Case::SharedStart,
        contact: Some(contact(0, 1, NO_FLAGS, 1)),
    },
    Figure {
        name: "4.5",
        caption: "Collinear: overlap at t = 0, then apart in opposite directions.",
        start: [
            [0.0, 0.0, 0.0],
            [2.0, 1.0, 0.0],
            [1.0, 0.5, 0.0],
            [3.0, 1.5, 0.0],
        ],
        end: [
            [4.0, 2.0, 0.0],
            [6.0, 3.0, 0.0],
            [-4.0, -2.0, 0.0],
            [-2.0, -1.0, 0.0],
        ],
        case: Case::Collinear,
        contact: Some(contact(0, 1, NO_FLAGS, 2)),
    },
    Figure {
        name: "4.6",
        caption: "Collinear: towards and through each other, contact at t = 0.0625.",
        start: [
            [-2.0, -1.0, 0.0],
            [0.0, 0.0, 0.0],
            [1.0, 0.5, 0.0],
            [3.0, 1.5, 0.0],
        ],
        end: [
            [6.0, 3.0, 0.0],
            [8.0, 4.0, 0.0],
            [-7.0, -3.5, 0.0],
            [-5.0, -2.5, 0.0],
        ],
        case: Case::Collinear,
        contact: Some(contact(1, 16, NO_FLAGS, 1)),
    },
    Figure {
        name: "4.7",
        caption: "Nearly collinear: the midlines pass beside each other, only the radii would \
        touch.",
        start: [
            [-2.0, 0.0, 0.0],
            [-1.0, 0.0, 0.0],
            [1.0, 0.015625, 0.0],
            [2.0, 0.015625, 0.0],
        ],
        end: [
            [1.0, 0.0, 0.0],
            [2.0, 0.0, 0.0],
            [-2.0, 0.015625, 0.0],
            [-1.0, 0.015625, 0.0],
        ],
        case: Case::Parallel,
        contact: None,
    },
    Figure {
        name: "4.8",
        caption: "Parallel: green from the top right to the middle, blue upwards, contact at t = \
        0.6.",
        start: [
            [1.0, 1.0, 0.0],
            [3.0, 1.0, 0.0],
            [4.0, 4.0, 0.0],
            [6.0, 4.0, 0.0],
        ],
        end: [
            [1.0, 4.0, 0.0],
            [3.0, 4.0, 0.0],
            [1.0, 2.0, 0.0],
            [3.0, 2.0, 0.0],
        ],
        case: Case::Parallel,
        contact: Some(contact(3, 5, NO_FLAGS, 2)),
    },
    Figure {
        name: "4.9",
        caption: "Coplanar: crossing at t = 0, then turning and moving apart.",
        start: [
            [-1.0, 1.0, 0.0],
            [1.0, -1.0, 0.0],
            [-1.0, -1.0, 0.0],
            [1.0, 1.0, 0.0],
        ],
        end: [
            [2.0, 1.5, 0.0],
            [3.0, -1.5, 0.0],
            [-3.0, -1.5, 0.0],
            [-2.0, 1.5, 0.0],
        ],
        case: Case::Coplanar,
        contact: Some(contact(0, 1, NO_FLAGS, 1)),
    },
    Figure {
        name: "4.10",
        caption: "Coplanar: blue's lower end stays on green's line and meets green at t ≈ 0.41.",
        start: [
            [0.0, 0.0, 0.0],
            [-1.0, 2.0, 0.0],
            [-3.625, 0.0, 0.0],
            [-1.625, 0.0, 0.0],
        ],
        end: [
            [2.0, 0.0, 0.0],
            [4.0, 2.0, 0.0],
            [2.375, 0.0, 0.0],
            [4.375, 0.0, 0.0],
        ],
        case: Case::Coplanar,
        contact: Some(contact(13, 32, NO_FLAGS, 1)),
    },
    Figure {
        name: "4.11",
        caption: "Coplanar: as 4.10, but blue's upper end meets green, parallel at t = 0.5, two \
        points.",
        start: [
            [0.0, 0.0, 0.0],
            [1.0, 2.0, 0.0],
            [1.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
        ],
        end: [
            [2.0, 0.0, 0.0],
            [5.0, -2.0, 0.0],
            [3.0, 0.0, 0.0],
            [5.0, 0.0, 0.0],
        ],
        case: Case::Coplanar,
        contact: Some(contact(1, 2, PARALLEL, 2)),
    },
    // In the plane z = x / 2 + y / 4.
    Figure {
        name: "4.12",
        caption: "Coplanar in a tilted plane: towards each other, contact at t ≈ 0.56.",
        start: [
            [-4.25, 0.0, -2.125],
            [-3.375, -0.125, -1.71875],
            [2.25, -2.0, 0.625],
            [3.375, 2.0, 2.1875],
        ],
        end: [
            [-0.25, 0.0, -0.125],
            [2.625, 1.875, 1.78125],
            [-1.75, -2.0, -1.375],
            [-2.625, 2.0, -0.8125],
        ],
        case: Case::Coplanar,
        contact: Some(contact(9, 16, NO_FLAGS, 1)),
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use tunnelproof::contact::EdgePoint;
    use tunnelproof::narrow::NarrowPhase;
    use tunnelproof::thesis::Thesis;

    #[test]
    fn figures_are_solved_by_the_thesis_path_as_their_captions_state() {
        for figure in &FIGURES {
            let name = figure.name;
            let report = Thesis::default().edge_edge(&figure.query()).unwrap();
            assert_eq!(report.case, Some(figure.case), "{name}");
            let Some(expected) = figure.contact else {
                assert!(!report.verdict.is_hit(), "{name}");
                continue;
            };
            let contact = report.verdict.contact().expect(name);
            let deviation = (contact.toi - expected.toi.to_f64()).abs();
            assert!(deviation <= 1e-9, "{name}: toi {}", contact.toi);
            assert_eq!(report.flags, expected.flags, "{name}");
            let points = 1 + usize::from(contact.second.is_some());
            assert_eq!(points, expected.points, "{name}");
        }
    }

    #[test]
    fn figures_touch_where_their_contact_points_say() {
        for figure in &FIGURES {
            let name = figure.name;
            let report = Thesis::default().edge_edge(&figure.query()).unwrap();
            let Some(contact) = report.verdict.contact() else {
                continue;
            };
            let [a, b, c, d]: [Point; 4] = std::array::from_fn(|i| {
                Point::from(figure.start[i]).lerp(&Point::from(figure.end[i]), contact.toi)
            });
            for at in [Some(contact.first), contact.second].into_iter().flatten() {
                let EdgePoint { u, v } = at.on_edges();
                assert!((a.lerp(&b, u) - at.point).norm() < 1e-9, "{name}: u {u}");
                assert!((c.lerp(&d, v) - at.point).norm() < 1e-9, "{name}: v {v}");
            }
        }
    }

    #[test]
    fn figures_are_named_in_order_and_found_by_name() {
        for (index, figure) in FIGURES.iter().enumerate() {
            assert_eq!(figure.name, format!("4.{}", index + 1));
            assert_eq!(Figure::from_name(figure.name), Some(figure));
        }
        assert_eq!(Figure::from_name("4.13"), None);
    }

    #[test]
    fn figure_contact_times_are_those_of_the_captions() {
        let stated = [
            (0.69, 2),
            (0.5, 1),
            (0.5, 1),
            (0.0, 1),
            (0.0, 1),
            (0.0625, 4),
            (f64::NAN, 0),
            (0.6, 1),
            (0.0, 1),
            (0.41, 2),
            (0.5, 1),
            (0.56, 2),
        ];
        for (figure, (toi, digits)) in FIGURES.iter().zip(stated) {
            let half_digit = 0.5 * 10.0_f64.powi(-digits);
            match figure.contact {
                None => assert!(toi.is_nan(), "{}", figure.name),
                Some(contact) => {
                    assert!(
                        (contact.toi.to_f64() - toi).abs() <= half_digit,
                        "{}",
                        figure.name
                    );
                }
            }
        }
    }
}
