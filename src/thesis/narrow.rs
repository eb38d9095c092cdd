//! The thesis path as a narrow phase.

use super::general::handle_general_case;
use super::motion::Motion;
use super::options::Options;
use super::witness::contact_at;
use crate::contact::{Flags, Verdict};
use crate::narrow::{NarrowPhase, Report, Tolerance, Unsupported};
use crate::query::EdgeEdge;
use crate::thesis::Thresholds;

/// Algorithm 20 with everything that follows from it. Heuristic.
///
/// Takes edge-edge queries of radius 0.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Thesis {
    /// Thresholds, readings and repairs; by default those of the text, slips repaired.
    pub options: Options,
}

impl NarrowPhase for Thesis {
    fn name(&self) -> &str {
        "thesis"
    }

    fn edge_edge(&self, query: &EdgeEdge) -> Result<Report, Unsupported> {
        if !query.radius().is_zero() {
            return Err(Unsupported::Radius(query.radius()));
        }
        let points = Motion::of_query(query);
        let (case, toi) = handle_general_case(&points, &self.options);
        let (verdict, flags) = match toi {
            None => (Verdict::Miss, Flags::default()),
            Some(toi) => {
                let (contact, flags) = contact_at(toi, query, case, &points, &self.options);
                (Verdict::Hit(contact), flags)
            }
        };
        Ok(Report {
            verdict,
            case: Some(case),
            flags,
        })
    }

    /// The thesis' thresholds for distance and time (table 3.1).
    fn tolerance(&self) -> Tolerance {
        let Thresholds { dist, t, .. } = self.options.thresholds;
        Tolerance {
            near: dist,
            late: t,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use proptest::test_runner::{Config, RngSeed};

    use super::*;
    use crate::contact::{Case, ContactPoint};
    use crate::query::{Point, QueryKind, VertexFace};
    use crate::thesis::text::Repairs;
    use crate::thesis::threshold::Thresholds;

    fn query(values: &[f64], radius: f64) -> EdgeEdge {
        let point = |i: usize| Point::new(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
        let start = std::array::from_fn(point);
        let end = std::array::from_fn(|i| point(i + 4));
        EdgeEdge::new(start, end, radius).unwrap()
    }

    /// The path with no, the usual and all repairs, with and without thresholds.
    fn every_path() -> Vec<Thesis> {
        let mut paths = Vec::new();
        for repairs in [Repairs::NONE, Repairs::SLIPS, Repairs::ALL] {
            for thresholds in [Thresholds::default(), Thresholds::ZERO] {
                let options = Options {
                    thresholds,
                    repairs,
                    ..Options::default()
                };
                paths.push(Thesis { options });
            }
        }
        paths
    }

    fn assert_sound(report: &Report) {
        let Some(contact) = report.verdict.contact() else {
            assert_eq!(report.flags, Flags::default());
            return;
        };
        let in_unit = |x: f64| (0.0..=1.0).contains(&x) && !(x == 0.0 && x.is_sign_negative());
        assert!(in_unit(contact.toi), "{contact:?}");
        let check = |at: &ContactPoint| {
            assert!(at.weights.into_iter().all(in_unit), "{contact:?}");
            assert!(at.point.iter().all(|x| x.is_finite()), "{contact:?}");
            let is_unit = at
                .relative_velocity
                .is_none_or(|n| (n.norm() - 1.0).abs() < 1e-9);
            assert!(is_unit, "{contact:?}");
        };
        check(&contact.first);
        if let Some(second) = contact.second {
            check(&second);
            assert!(
                contact.first.on_edges().u < second.on_edges().u,
                "{contact:?}"
            );
        }
    }

    #[test]
    fn thesis_refuses_what_the_method_does_not_take() {
        let thesis = Thesis::default();
        let refused = thesis.edge_edge(&query(&[0.0; 24], 0.5));
        assert_eq!(refused, Err(Unsupported::Radius(0.5.into())));
        let face = VertexFace::new([Point::origin(); 4], [Point::origin(); 4], 0.0).unwrap();
        let refused = thesis.vertex_face(&face);
        assert_eq!(refused, Err(Unsupported::Kind(QueryKind::VertexFace)));
    }

    #[test]
    fn thesis_declares_its_distance_threshold() {
        assert_eq!(Thesis::default().tolerance().near, 1e-6);
        assert_eq!(Thesis::default().name(), "thesis");
    }

    #[test]
    fn thesis_answers_a_query_of_one_point() {
        for path in every_path() {
            let report = path.edge_edge(&query(&[0.0; 24], 0.0)).unwrap();
            assert_eq!(report.case, Some(Case::Degenerate));
            assert_sound(&report);
        }
    }

    fn seeded() -> Config {
        Config {
            rng_seed: RngSeed::Fixed(2),
            cases: 4096,
            failure_persistence: None,
            ..Config::default()
        }
    }

    proptest! {
        #![proptest_config(seeded())]

        #[test]
        fn thesis_answers_are_sound_on_any_finite_input(
            values in prop::collection::vec(any::<f64>(), 24),
        ) {
            for path in every_path() {
                assert_sound(&path.edge_edge(&query(&values, 0.0)).unwrap());
            }
        }

        #[test]
        fn thesis_answers_are_sound_on_extreme_values(
            values in prop::collection::vec(
                prop::sample::select(vec![
                    0.0, -0.0, 1.0, -1.0, 5e-324, 1e-160, -1e-160, 1e154, 1e300, -1e300,
                    f64::MAX, f64::MIN,
                ]),
                24,
            ),
        ) {
            for path in every_path() {
                assert_sound(&path.edge_edge(&query(&values, 0.0)).unwrap());
            }
        }

        #[test]
        fn thesis_answers_are_sound_on_lattice_points(
            values in prop::collection::vec(-1..=1_i8, 24),
        ) {
            let values: Vec<f64> = values.into_iter().map(f64::from).collect();
            for path in every_path() {
                assert_sound(&path.edge_edge(&query(&values, 0.0)).unwrap());
            }
        }
    }
}
