//! The subjects that the command line knows, by name.

use crate::oracle::Oracle;
use crate::subject::Subject;

/// Every subject, in the order of tables.
pub static SUBJECTS: &[&dyn Subject] = &[&Oracle];

/// The subject with this [`name`](Subject::name), if any.
pub fn by_name(name: &str) -> Option<&'static dyn Subject> {
    SUBJECTS
        .iter()
        .copied()
        .find(|subject| subject.name() == name)
}

/// The names of all subjects, in the order of tables.
pub fn names() -> impl Iterator<Item = &'static str> {
    SUBJECTS.iter().map(|subject| subject.name())
}
