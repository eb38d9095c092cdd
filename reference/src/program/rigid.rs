//! Programs as subjects that answer queries of bodies that turn.

use tunnelproof::narrow::Tolerance;
use tunnelproof::rigid::RigidQuery;

use crate::subject::{Answer, NoAnswer, RigidSubject};

use super::Program;

/// Of what is asked in [lines](super::wire::Wire::Lines); the other form has no such queries.
impl RigidSubject for Program {
    fn name(&self) -> &str {
        &self.name
    }

    fn answers(&self, queries: &[RigidQuery]) -> Vec<Result<Answer, NoAnswer>> {
        self.all_answers(queries)
    }

    fn tolerance(&self) -> Tolerance {
        self.tolerance
    }
}
