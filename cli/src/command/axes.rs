//! `--threshold NAME --from VALUE --to VALUE --steps N`, as often as there are thresholds.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::error::ErrorKind;
use clap::parser::ValuesRef;
use clap::{Arg, ArgAction, ArgMatches, Args, Command, Error, FromArgMatches, value_parser};
use tunnelproof::thesis::Threshold;
use tunnelproof_cli::sweep::{Axis, AxisError, Domain, Grid, STEPS};

/// The thresholds that are asked for; none for each alone.
#[derive(Clone)]
pub(super) struct Axes(Vec<Asked>);

/// One threshold, and which of its values.
#[derive(Clone)]
struct Asked {
    threshold: Threshold,
    from: Option<f64>,
    to: Option<f64>,
    steps: Option<usize>,
}

impl Axes {
    /// The settings that are asked for.
    pub(super) fn grid(&self, domain: &Domain) -> Result<Grid, AxisError> {
        if self.0.is_empty() {
            let axes = Threshold::ALL.map(|threshold| Asked::new(threshold).axis(domain));
            return Ok(Grid::alone(axes.into_iter().collect::<Result<_, _>>()?));
        }
        let axes = self.0.iter().map(|asked| asked.axis(domain));
        Grid::product(axes.collect::<Result<_, _>>()?)
    }
}

impl Asked {
    fn new(threshold: Threshold) -> Self {
        Asked {
            threshold,
            from: None,
            to: None,
            steps: None,
        }
    }

    fn axis(&self, domain: &Domain) -> Result<Axis, AxisError> {
        let [from, to] = Axis::usual_ends(self.threshold, domain);
        let steps = self.steps.unwrap_or(STEPS);
        let ends = [self.from.unwrap_or(from), self.to.unwrap_or(to)];
        Axis::new(self.threshold, ends[0], ends[1], steps)
    }
}

impl Args for Axes {
    fn augment_args(command: Command) -> Command {
        let names = Threshold::ALL.map(Threshold::name);
        let threshold = PossibleValuesParser::new(names)
            .try_map(|name| Threshold::from_name(&name).ok_or("unknown threshold"));
        let number = |name: &'static str, help: &'static str| {
            Arg::new(name)
                .long(name)
                .help(help)
                .action(ArgAction::Append)
                .allow_negative_numbers(true)
        };
        command
            .arg(
                number(
                    "threshold",
                    "A threshold to sweep; of several every combination",
                )
                .value_name("NAME")
                .value_parser(threshold),
            )
            .arg(
                number("from", "The first value of the threshold before it")
                    .value_name("VALUE")
                    .value_parser(value_parser!(f64)),
            )
            .arg(
                number("to", "The last value of the threshold before it")
                    .value_name("VALUE")
                    .value_parser(value_parser!(f64)),
            )
            .arg(
                number(
                    "steps",
                    "How many values of the threshold before it, 30 by default",
                )
                .value_name("N")
                .value_parser(value_parser!(usize)),
            )
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for Axes {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, Error> {
        let thresholds: Vec<_> = placed::<Threshold>(matches, "threshold").collect();
        let mut asked: Vec<_> = (thresholds.iter())
            .map(|(_, threshold)| Asked::new(*threshold))
            .collect();
        let starts: Vec<_> = thresholds.iter().map(|(place, _)| *place).collect();
        // Each value belongs to the last threshold before it.
        let owner = |name: &str, place: usize| match starts.iter().rposition(|at| *at < place) {
            Some(index) => Ok(index),
            None => Err(refuse(format!("--{name} without a --threshold before it"))),
        };
        for (place, from) in placed(matches, "from") {
            set(&mut asked[owner("from", place)?].from, from, "from")?;
        }
        for (place, to) in placed(matches, "to") {
            set(&mut asked[owner("to", place)?].to, to, "to")?;
        }
        for (place, steps) in placed(matches, "steps") {
            set(&mut asked[owner("steps", place)?].steps, steps, "steps")?;
        }
        Ok(Axes(asked))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

/// The values of an argument and where they stand.
fn placed<'a, T: Copy + Send + Sync + 'static>(
    matches: &'a ArgMatches,
    name: &'a str,
) -> impl Iterator<Item = (usize, T)> {
    let values: Option<ValuesRef<T>> = matches.get_many(name);
    let places = matches.indices_of(name).into_iter().flatten();
    places.zip(values.into_iter().flatten().copied())
}

fn set<T>(slot: &mut Option<T>, value: T, name: &str) -> Result<(), Error> {
    match slot.replace(value) {
        None => Ok(()),
        Some(_) => Err(refuse(format!(
            "--{name} is there twice for one --threshold"
        ))),
    }
}

fn refuse(message: String) -> Error {
    Error::raw(ErrorKind::ValueValidation, message + "\n")
}
