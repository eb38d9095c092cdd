//! The subjects that the command line knows, by name, and why the published text is wrong.

use tunnelproof::query::Query;
use tunnelproof::thesis::{Erratum, Repairs, Thesis};

use crate::answer::ExactAnswer;
use crate::oracle::Oracle;
use crate::shadow::Shadow;
use crate::subject::{Answer, Engine, Subject};
