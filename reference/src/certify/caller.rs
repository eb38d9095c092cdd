//! Who asked for a certification, and how a find is shown again there.

use serde::{Deserialize, Serialize};

use super::query::AnyQuery;
use super::tally::Witness;
use crate::corpus::jsonl::Numbers;

/// Who asked for a certification: where a command that explains a find has to work.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Caller {
    /// The command line.
    Shell {
        /// What commands begin with: [`CHECKOUT`] or [`INSTALLED`].
        program: String,
        /// How programs and libraries are asked, such as `--wire binary`; empty if as usual.
        options: String,
    },
    /// A test in Rust, with an engine that no command line knows.
    Test,
    /// Python, with a method that no command line knows.
    Python,
}

impl Caller {
    /// The command that explains a query that is in no file, ready to paste.
    pub fn explain_query(&self, id: &str, query: &AnyQuery) -> String {
        match self {
            Caller::Shell { program, .. } => line_of(id, query, program),
            Caller::Test => line_of(id, query, INSTALLED),
            Caller::Python => {
                let line = query.line(id, Numbers::Decimal);
                format!("print(tunnelproof.explain({}))", in_quotes(&line))
            }
        }
    }

    /// Whether the other asks in the same way, wherever its program was started from.
    pub(super) fn asks_as(&self, other: &Caller) -> bool {
        match (self, other) {
            (
                Caller::Shell { options, .. },
                Caller::Shell {
                    options: others, ..
                },
            ) => options == others,
            _ => self == other,
        }
    }

    /// The command that explains a witness against a subject, ready to paste.
    pub fn explain(&self, witness: &Witness, subject: Option<&str>) -> String {
        let is_nowhere = witness.id.starts_with(NOWHERE);
        match self {
            Caller::Shell { program, options } => {
                let subject = subject.map_or(String::new(), |name| asked(name, options));
                match is_nowhere {
                    true => line_of(&witness.id, &witness.query, program) + &subject,
                    false => named(program, witness) + &subject,
                }
            }
            Caller::Test if is_nowhere => self.explain_query(&witness.id, &witness.query),
            Caller::Test => named(INSTALLED, witness),
            Caller::Python => {
                let query = match is_nowhere {
                    true => witness.query.line(&witness.id, Numbers::Decimal),
                    false => witness.id.clone(),
                };
                let method = subject.filter(|name| is_name(name)).unwrap_or("method");
                format!(
                    "print(tunnelproof.explain({}, {method}))",
                    in_quotes(&query)
                )
            }
        }
    }
}

/// The options that ask for a subject besides.
fn asked(name: &str, options: &str) -> String {
    let is_program = PROGRAMS.iter().any(|program| name.starts_with(program));
    let options = match is_program && !options.is_empty() {
        true => format!(" {options}"),
        false => String::new(),
    };
    format!(" --subject {}{options}", quoted(name))
}

/// The command that explains a query that is in no file, ready to paste into a shell in a checkout.
pub fn explain_line(id: &str, query: &AnyQuery) -> String {
    line_of(id, query, CHECKOUT)
}

fn line_of(id: &str, query: &AnyQuery, program: &str) -> String {
    let line = query.line(id, Numbers::Decimal);
    format!(
        "echo {} | {program} explain{} -",
        quoted(&line),
        turning(query)
    )
}

/// The command that explains a query that is known by its identifier.
fn named(program: &str, witness: &Witness) -> String {
    let is_file = witness.id.contains('#');
    let turning = if is_file { turning(&witness.query) } else { "" };
    format!("{program} explain{turning} {}", quoted(&witness.id))
}

/// The option that says that a line is of a body that turns; families say so by their names.
fn turning(query: &AnyQuery) -> &'static str {
    if query.turns() { " --turning" } else { "" }
}

/// What commands begin with in a checkout of the project.
pub const CHECKOUT: &str = "cargo run --release --";

/// What commands begin with where the program is installed.
pub const INSTALLED: &str = "tunnelproof";

/// What the names of programs and of shared libraries begin with on the command line.
const PROGRAMS: [&str; 2] = ["cmd:", "lib:"];

/// What the identifiers of queries begin with that no file holds.
const NOWHERE: &str = "-#";

/// A text as one word of a shell.
pub fn quoted(text: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./:@%+,=".contains(c);
    match text.chars().all(is_plain) {
        true => text.to_owned(),
        false => format!("'{}'", text.replace('\'', r"'\''")),
    }
}

/// A text in quotes, as Python reads it.
pub fn in_quotes(text: &str) -> String {
    format!("'{}'", text.replace('\\', r"\\").replace('\'', r"\'"))
}

/// Whether it is a name in Python.
fn is_name(text: &str) -> bool {
    let is_letter = |c: char| c.is_ascii_alphabetic() || c == '_';
    text.starts_with(is_letter) && text.chars().all(|c| is_letter(c) || c.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::by_name;
    use crate::oracle::decide_query;

    fn witness(id: &str) -> Witness {
        let query = by_name("lattice").unwrap().query(1, 7);
        Witness {
            severity: 0.0,
            rank: 0.0,
            place: 7,
            id: id.to_owned(),
            query: query.into(),
            truth: decide_query(&query),
            answer: None,
            lapse: None,
        }
    }

    #[test]
    fn shell_commands_name_the_subject_and_how_programs_are_asked() {
        let shell = Caller::Shell {
            program: INSTALLED.to_owned(),
            options: "--wire binary".to_owned(),
        };
        let known = shell.explain(&witness("lattice:1:7"), Some("thesis"));
        assert_eq!(known, "tunnelproof explain lattice:1:7 --subject thesis");
        let program = shell.explain(&witness("a b.csv#3"), Some("cmd:./x -y"));
        assert_eq!(
            program,
            "tunnelproof explain 'a b.csv#3' --subject 'cmd:./x -y' --wire binary"
        );
        let nowhere = shell.explain(&witness("-#7"), Some("thesis"));
        assert!(nowhere.starts_with("echo '{"), "{nowhere}");
        assert!(
            nowhere.ends_with("| tunnelproof explain - --subject thesis"),
            "{nowhere}"
        );
    }

    #[test]
    fn python_and_tests_have_commands_of_their_own() {
        let python = |id, name| Caller::Python.explain(&witness(id), Some(name));
        assert_eq!(
            python("lattice:1:7", "my_ccd"),
            "print(tunnelproof.explain('lattice:1:7', my_ccd))"
        );
        assert!(python("-#mine:7", "my ccd").starts_with("print(tunnelproof.explain('{\"id\""));
        assert!(python("-#mine:7", "my ccd").ends_with("}', method))"));
        let alone = {
            let witness = witness("step-7");
            Caller::Python.explain_query(&witness.id, &witness.query)
        };
        assert!(alone.starts_with("print(tunnelproof.explain('{\"id\""));
        assert!(alone.ends_with("}'))"), "{alone}");
        let test = Caller::Test.explain(&witness("lattice:1:7"), Some("mine"));
        assert_eq!(test, "tunnelproof explain lattice:1:7");
    }

    #[test]
    fn quoted_text_is_one_word() {
        assert_eq!(quoted("lattice:1:4711"), "lattice:1:4711");
        assert_eq!(quoted("a b.csv#3"), "'a b.csv#3'");
        assert_eq!(quoted("it's"), r"'it'\''s'");
        assert_eq!(quoted(r"a\b c"), r"'a\b c'");
        assert_eq!(in_quotes(r"it's a\b"), r"'it\'s a\\b'");
    }
}
