//! Which queries a command is about, and how large the scene is.

use std::ffi::OsStr;

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::error::ContextKind;
use clap::{Arg, Args, Command, Error};
use tunnelproof_cli::sweep::{Domain, DomainError, Precision};
use tunnelproof_reference::certify::source::{AnyFamily, Source};
use tunnelproof_reference::corpus::folder;
use tunnelproof_reference::generate::{
    self, FAMILIES, Family, RigidFamily, all_rigid, rigid_by_name,
};

use super::{Failure, Reading};

/// Queries of families and files.
#[derive(Args)]
pub(super) struct Sources {
    /// Families of generated queries; by default all but scales, or none if files are given
    #[arg(long, value_delimiter = ',', value_parser = family())]
    family: Vec<&'static Family>,
    /// Files of queries (.jsonl or .csv), or folders of them; - is the standard input
    #[arg(long, value_name = "FILE", num_args = 1..)]
    corpus: Vec<String>,
    #[command(flatten)]
    reading: Reading,
}

/// How large the scene is, and how precise.
#[derive(Args)]
pub(super) struct Scene {
    /// A metre of the queries becomes so many: the nearest power of two, which keeps every
    /// degeneracy
    #[arg(
        long,
        value_name = "METRES",
        default_value_t = 1.0,
        allow_negative_numbers = true
    )]
    scale: f64,
    /// Round coordinates to single precision, as if born of an f32 scene
    #[arg(long, value_name = "PRECISION", default_value = "f64", value_parser = precision())]
    precision: Precision,
}

impl Sources {
    /// # Errors
    ///
    /// An option that says how to read files, without any; a folder without a file of queries.
    pub(super) fn sources(&self, seed: u64, count: u64) -> Result<Vec<Source>, Failure> {
        self.reading.check(&self.corpus)?;
        let families = match self.family.is_empty() && self.corpus.is_empty() {
            true => FAMILIES
                .iter()
                .filter(|family| has_a_scale(family))
                .collect(),
            false => once(self.family.iter().copied(), |family| family.name()),
        };
        let families = of_families(&families, seed, count);
        let files = of_files(&self.corpus, &self.reading)?;
        Ok(families.into_iter().chain(files).collect())
    }
}

/// What is listed, each once, where it is listed first.
pub(super) fn once<T>(list: impl IntoIterator<Item = T>, name: impl Fn(&T) -> &str) -> Vec<T> {
    let mut all: Vec<T> = Vec::new();
    for one in list {
        if all.iter().all(|other| name(other) != name(&one)) {
            all.push(one);
        }
    }
    all
}

/// The first queries of families.
pub(super) fn of_families(families: &[&'static Family], seed: u64, count: u64) -> Vec<Source> {
    let families = families.iter().filter(|_| count > 0);
    families
        .map(|family| Source::Family {
            family,
            seed,
            count,
        })
        .collect()
}

/// The queries of files, and of the files in folders. A JSON schema among several has none.
///
/// # Errors
///
/// A folder that cannot be read, or has no file of queries.
pub(super) fn of_files(files: &[String], reading: &Reading) -> Result<Vec<Source>, Failure> {
    let mut sources = Vec::new();
    for path in files {
        if files.len() > 1 && folder::is_schema(path) {
            continue;
        }
        let files = folder::files(path)?.into_iter();
        sources.extend(files.map(|path| Source::File {
            path,
            options: reading.options(),
        }));
    }
    Ok(sources)
}

impl Scene {
    pub(super) fn domain(&self) -> Result<Domain, DomainError> {
        Domain::new(self.scale, self.precision)
    }
}

/// Whether the queries of a family are of scenes of one size, so that a threshold can suit them.
pub(super) fn has_a_scale(family: &Family) -> bool {
    family.name() != "scales"
}

fn precision() -> impl TypedValueParser<Value = Precision> {
    PossibleValuesParser::new(Precision::ALL.map(Precision::name))
        .try_map(|name| Precision::from_name(&name).ok_or("unknown precision"))
}

pub(super) fn any_family() -> impl TypedValueParser<Value = AnyFamily> {
    let turning = all_rigid().map(RigidFamily::name);
    let names = generate::all().map(Family::name).chain(turning);
    Listed::new(names).try_map(|name| {
        let linear = generate::by_name(&name).map(AnyFamily::Linear);
        let turning = || rigid_by_name(&name).map(AnyFamily::Turning);
        linear.or_else(turning).ok_or("unknown family")
    })
}

pub(super) fn family() -> impl TypedValueParser<Value = &'static Family> {
    Listed::new(generate::all().map(Family::name))
        .try_map(|name| generate::by_name(&name).ok_or("unknown family"))
}

/// One of many names, in a list in which there may be spaces. An error does not list them all.
#[derive(Clone)]
pub(super) struct Listed(PossibleValuesParser);

impl Listed {
    pub(super) fn new(names: impl Iterator<Item = &'static str>) -> Self {
        Listed(PossibleValuesParser::new(names))
    }
}

impl TypedValueParser for Listed {
    type Value = String;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<String, Error> {
        let name = value.to_str().map_or(value, |name| OsStr::new(name.trim()));
        let known = self.0.parse_ref(command, arg, name);
        known.map_err(|mut error| {
            error.remove(ContextKind::ValidValue);
            error
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        self.0.possible_values()
    }
}
