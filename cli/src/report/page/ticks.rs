//! Where an axis has numbers, and how they are written.

/// About how many numbers an axis has room for.
const MOST: f64 = 6.0;

/// A number on an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Where it stands: the number, or its decimal logarithm.
    pub(super) place: f64,
    /// The number.
    pub(super) label: String,
}

/// Round numbers from `low` to `high`.
pub(super) fn linear([low, high]: [f64; 2]) -> Vec<Tick> {
    let step = round_step((high - low) / MOST);
    let (from, to) = ((low / step).ceil(), (high / step).floor());
    let whole = (from as i64..=to as i64).map(|k| k as f64 * step);
    whole
        .map(|place| Tick {
            place,
            label: label(place, step),
        })
        .collect()
}

/// Numbers whose decimal logarithms are from `low` to `high`: whole decades, or where there are few
/// of them also the numbers between, so that there always are some.
pub(super) fn logarithmic([low, high]: [f64; 2]) -> Vec<Tick> {
    let decades = low.ceil() as i64..=high.floor() as i64;
    let every = (decades.clone().count() as f64 / MOST).ceil().max(1.0) as i64;
    let with = |digits: &[i64]| -> Vec<Tick> {
        let all = low.floor() as i64..=high.floor() as i64;
        let of = all.flat_map(|decade| digits.iter().map(move |digit| (*digit, decade)));
        let ticks = of.map(|(digit, decade)| Tick {
            place: (digit as f64).log10() + decade as f64,
            label: of_decade(digit, decade),
        });
        ticks
            .filter(|tick| (low..=high).contains(&tick.place))
            .collect()
    };
    let whole: Vec<_> = with(&[1]);
    if whole.len() >= 3 {
        let shown = |tick: &Tick| (tick.place.round() as i64).rem_euclid(every) == 0;
        return whole.into_iter().filter(shown).collect();
    }
    for digits in [&[1, 2, 5][..], &[1, 2, 3, 4, 5, 6, 7, 8, 9]] {
        let ticks = with(digits);
        if ticks.len() >= 3 {
            return ticks;
        }
    }
    // Less than a third of a decade: as good as linear.
    let mut ticks = linear([10f64.powf(low), 10f64.powf(high)]);
    for tick in &mut ticks {
        tick.place = tick.place.log10();
    }
    ticks
}

/// 1, 2 or 5 times a power of ten, not below a number.
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    let round = [1.0, 2.0, 5.0].map(|digit| digit * power);
    round
        .into_iter()
        .find(|step| *step >= least)
        .unwrap_or(10.0 * power)
}

/// With as many digits as tell a number from the next one.
fn label(number: f64, step: f64) -> String {
    let largest = number.abs().max(step);
    if !(1e-3..1e5).contains(&largest) && number != 0.0 {
        let digits = (number.abs().log10().floor() - step.log10().floor()).max(0.0);
        return format!("{number:.*e}", digits as usize);
    }
    let digits = (-step.log10().floor()).max(0.0) as usize;
    format!("{number:.digits$}")
}

fn of_decade(digit: i64, decade: i64) -> String {
    match decade {
        0..=3 => format!("{}", digit * 10i64.pow(decade as u32)),
        -2..=-1 => format!(
            "{:.*}",
            -decade as usize,
            digit as f64 * 10f64.powi(decade as i32)
        ),
        _ => format!("{digit}e{decade}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &[Tick]) -> Vec<&str> {
        ticks.iter().map(|tick| &*tick.label).collect()
    }

    #[test]
    fn ticks_of_a_linear_axis_are_round() {
        assert_eq!(
            labels(&linear([0.0, 10.0])),
            ["0", "2", "4", "6", "8", "10"]
        );
        assert_eq!(
            labels(&linear([0.02, 0.31])),
            ["0.05", "0.10", "0.15", "0.20", "0.25", "0.30"]
        );
        assert_eq!(
            labels(&linear([0.0, 4e6])),
            ["0", "1e6", "2e6", "3e6", "4e6"]
        );
    }

    #[test]
    fn ticks_of_a_logarithmic_axis_are_decades_or_numbers_between() {
        assert_eq!(
            labels(&logarithmic([-4.1, 0.1])),
            ["1e-4", "1e-3", "0.01", "0.1", "1"]
        );
        assert_eq!(
            labels(&logarithmic([-7.2, -5.9])),
            ["1e-7", "2e-7", "5e-7", "1e-6"]
        );
        assert_eq!(labels(&logarithmic([1.05, 1.75])), ["20", "30", "40", "50"]);
        assert_eq!(
            labels(&logarithmic([-16.0, 0.0])),
            ["1e-15", "1e-12", "1e-9", "1e-6", "1e-3", "1"]
        );
    }

    #[test]
    fn ticks_are_there_however_narrow_an_axis_is() {
        for low in [-300.0, -15.93, -3.2, -0.01, 0.0, 1.234, 8.0, 299.0] {
            for width in [1e-3, 0.01, 0.1, 0.3, 0.5, 0.9, 1.0, 2.0, 7.0] {
                let range = [low, low + width];
                let ticks = logarithmic(range);
                assert!((2..=10).contains(&ticks.len()), "{range:?}: {ticks:?}");
                let mut seen = labels(&ticks);
                seen.dedup();
                assert_eq!(seen.len(), ticks.len(), "{ticks:?}");
                for Tick { place, label } in &ticks {
                    assert!(
                        (low - 1e-9..=low + width + 1e-9).contains(place),
                        "{ticks:?}"
                    );
                    let number: f64 = label.parse().unwrap();
                    assert!((number.log10() - place).abs() < width / 3.0, "{ticks:?}");
                }
            }
        }
    }
}
