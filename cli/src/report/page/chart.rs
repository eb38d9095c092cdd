//! Charts as SVG: curves, dots, bars and heat maps over axes that may be logarithmic.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, ValueFormatter};
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;

use super::ticks::{self, Tick};

/// In pixels, of which a telephone has about as many.
const SIZE: (u32, u32) = (380, 290);

/// The background.
pub(super) const PAPER: RGBColor = RGBColor(0xfc, 0xfc, 0xfa);
/// Axes and text.
pub(super) const INK: RGBColor = RGBColor(0x1f, 0x29, 0x33);
/// Lines of the grid.
pub(super) const GRID: RGBColor = RGBColor(0xdd, 0xe2, 0xe8);
/// What matters most.
pub(super) const RED: RGBColor = RGBColor(0xc0, 0x39, 0x2b);
/// What is weighed against it.
pub(super) const BLUE: RGBColor = RGBColor(0x2f, 0x7f, 0xd0);
/// What goes with it.
pub(super) const AMBER: RGBColor = RGBColor(0xb0, 0x7a, 0x14);
/// What is in the background.
pub(super) const GREY: RGBColor = RGBColor(0x8a, 0x96, 0xa3);

/// An axis of a chart.
pub(super) struct Axis {
    /// What it shows, and the unit.
    pub(super) label: String,
    /// Whether its numbers grow by factors.
    pub(super) is_log: bool,
}

/// How a series is drawn.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Shape {
    /// A line through the points.
    Line,
    /// A dot at each point.
    Dots,
    /// A bar from 0, one wide, to each point.
    Bars,
}

/// Points that belong together.
pub(super) struct Series {
    /// What they are.
    pub(super) name: String,
    /// Their colour.
    pub(super) colour: RGBColor,
    /// Their shape.
    pub(super) shape: Shape,
    /// Where they are. On a logarithmic axis those not above 0 are left out.
    pub(super) points: Vec<[f64; 2]>,
}

/// A chart of series.
pub(super) struct Chart {
    /// What it shows.
    pub(super) title: String,
    /// From left to right, then from the bottom up.
    pub(super) axes: [Axis; 2],
    /// In the order of drawing.
    pub(super) series: Vec<Series>,
    /// A value on the first axis that is marked by a line.
    pub(super) mark: Option<f64>,
}

/// A number for each pair of values of two axes.
pub(super) struct HeatMap {
    /// What it shows.
    pub(super) title: String,
    /// From left to right, then from the bottom up, both logarithmic.
    pub(super) axes: [Axis; 2],
    /// The values of the axes.
    pub(super) values: [Vec<f64>; 2],
    /// The number of each pair; those of the second axis next to each other.
    pub(super) numbers: Vec<f64>,
}

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Cartesian = Cartesian2d<Numbered, Numbered>;
type Failure = Box<dyn std::error::Error>;

const NO_FAILURE: &str = "drawing on a string does not fail";

impl Chart {
    /// The chart as an SVG document.
    pub(super) fn svg(&self) -> String {
        let legend: Vec<_> = (self.series.iter())
            .map(|series| (series.name.as_str(), series.colour))
            .collect();
        let ranges = [0, 1].map(|axis| self.range(axis));
        let draw = |chart: &mut ChartContext<SVGBackend, Cartesian>| {
            if let Some(mark) = self.mark.and_then(|mark| self.axes[0].place(mark)) {
                let [_, [low, high]] = ranges;
                let line = vec![(mark, low), (mark, high)];
                chart.draw_series(LineSeries::new(line, GREY.stroke_width(2)))?;
            }
            for series in &self.series {
                self.draw_series(chart, series)?;
            }
            Ok(())
        };
        draw_frame(&self.title, &legend, &self.axes, ranges, draw)
    }

    fn draw_series(
        &self,
        chart: &mut ChartContext<SVGBackend, Cartesian>,
        series: &Series,
    ) -> Result<(), Failure> {
        let points: Vec<_> = series
            .points
            .iter()
            .filter_map(|at| self.place(*at))
            .collect();
        let colour = series.colour;
        match series.shape {
            Shape::Line => {
                chart.draw_series(LineSeries::new(points.clone(), colour.stroke_width(2)))?;
                let dots = points
                    .into_iter()
                    .map(|at| Circle::new(at, 2, colour.filled()));
                chart.draw_series(dots)?;
            }
            Shape::Dots => {
                let dots = points
                    .into_iter()
                    .map(|at| Circle::new(at, 4, colour.filled()));
                chart.draw_series(dots)?;
            }
            Shape::Bars => {
                let bar = |(x, y): (f64, f64)| {
                    Rectangle::new([(x + 0.08, 0.0), (x + 0.92, y)], colour.filled())
                };
                chart.draw_series(points.into_iter().map(bar))?;
            }
        }
        Ok(())
    }

    fn place(&self, [x, y]: [f64; 2]) -> Option<(f64, f64)> {
        Some((self.axes[0].place(x)?, self.axes[1].place(y)?))
    }

    /// What an axis spans: all points and the mark, and 0 where it is not logarithmic.
    fn range(&self, axis: usize) -> [f64; 2] {
        let points = self.series.iter().flat_map(|series| &series.points);
        let mark = self.mark.filter(|_| axis == 0);
        let values = points.map(|point| point[axis]).chain(mark);
        let places: Vec<_> = values
            .filter_map(|value| self.axes[axis].place(value))
            .collect();
        let has_bars = self.series.iter().any(|series| series.shape == Shape::Bars);
        let from_zero = axis == 1 && !self.axes[1].is_log;
        let (mut low, mut high) = match from_zero {
            true => (0.0, 0.0),
            false => (f64::INFINITY, f64::NEG_INFINITY),
        };
        for place in places {
            low = low.min(place);
            high = high.max(place + if has_bars && axis == 0 { 1.0 } else { 0.0 });
        }
        if low > high {
            return [0.0, 1.0];
        }
        // Around a single number there is room for others to compare it with.
        let least = match self.axes[axis].is_log {
            true => 0.5,
            false => (high.abs() / 10.0).max(f64::MIN_POSITIVE),
        };
        let margin = match high > low {
            true => (high - low) * 0.05,
            false => least,
        };
        let margin = match (from_zero, high) {
            (true, 0.0) => 1.0,
            _ => margin,
        };
        [if from_zero { 0.0 } else { low - margin }, high + margin]
    }
}

impl Axis {
    /// Where a value stands: itself or its logarithm.
    fn place(&self, value: f64) -> Option<f64> {
        match self.is_log {
            true => (value > 0.0).then(|| value.log10()),
            false => Some(value),
        }
    }

    /// The numbers on a part of the axis.
    fn ticks(&self, range: [f64; 2]) -> Vec<Tick> {
        match self.is_log {
            true => ticks::logarithmic(range),
            false => ticks::linear(range),
        }
    }
}

/// An axis as it is drawn: from where to where, and its numbers.
struct Numbered {
    range: Range<f64>,
    ticks: Vec<Tick>,
}

impl Ranged for Numbered {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, place: &f64, limit: (i32, i32)) -> i32 {
        RangedCoordf64::from(self.range.clone()).map(place, limit)
    }

    fn key_points<Hint: KeyPointHint>(&self, _hint: Hint) -> Vec<f64> {
        self.ticks.iter().map(|tick| tick.place).collect()
    }

    fn range(&self) -> Range<f64> {
        self.range.clone()
    }
}

impl ValueFormatter<f64> for Numbered {
    fn format_ext(&self, place: &f64) -> String {
        let tick = self.ticks.iter().find(|tick| tick.place == *place);
        tick.map_or_else(String::new, |tick| tick.label.clone())
    }
}

impl HeatMap {
    /// The heat map as an SVG document.
    pub(super) fn svg(&self) -> String {
        let finite = || self.numbers.iter().copied();
        let (low, high) = finite().fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), number| {
            (low.min(number), high.max(number))
        });
        let legend =
            [(low, 0.0), (high, 1.0)].map(|(number, part)| (format!("{number:.0}"), heat(part)));
        let legend = legend
            .each_ref()
            .map(|(name, colour)| (name.as_str(), *colour));
        let cells = [0, 1].map(|axis| cells(&self.axes[axis], &self.values[axis]));
        let ranges = cells
            .each_ref()
            .map(|cells| match (cells.first(), cells.last()) {
                (Some(first), Some(last)) => [first[0], last[1]],
                _ => [0.0, 1.0],
            });
        let draw = |chart: &mut ChartContext<SVGBackend, Cartesian>| {
            let [columns, rows] = &cells;
            let pairs = columns
                .iter()
                .flat_map(|x| rows.iter().map(move |y| (x, y)));
            let rectangles = pairs.zip(&self.numbers).map(|((x, y), number)| {
                let part = (number - low) / (high - low).max(f64::MIN_POSITIVE);
                Rectangle::new([(x[0], y[0]), (x[1], y[1])], heat(part).filled())
            });
            chart.draw_series(rectangles)?;
            Ok(())
        };
        draw_frame(&self.title, &legend, &self.axes, ranges, draw)
    }
}

/// From where to where each value is drawn: half of the way to its neighbours.
fn cells(axis: &Axis, values: &[f64]) -> Vec<[f64; 2]> {
    let places: Vec<_> = values
        .iter()
        .filter_map(|value| axis.place(*value))
        .collect();
    let half = match places[..] {
        [first, second, ..] => (second - first) / 2.0,
        _ => 0.5,
    };
    places
        .iter()
        .map(|place| [place - half, place + half])
        .collect()
}

/// From pale for 0 to strong for 1.
fn heat(part: f64) -> RGBColor {
    let mix = |pale: f64, strong: f64| (pale + (strong - pale) * part.clamp(0.0, 1.0)) as u8;
    RGBColor(mix(253.0, 140.0), mix(231.0, 29.0), mix(200.0, 24.0))
}

/// A chart with its title, legend and axes, and what `draw` draws into it.
fn draw_frame(
    title: &str,
    legend: &[(&str, RGBColor)],
    axes: &[Axis; 2],
    ranges: [[f64; 2]; 2],
    draw: impl FnOnce(&mut ChartContext<SVGBackend, Cartesian>) -> Result<(), Failure>,
) -> String {
    let mut svg = String::new();
    let root = SVGBackend::with_string(&mut svg, SIZE).into_drawing_area();
    let drawn = (|| {
        root.fill(&PAPER)?;
        draw_head(&root, title, legend)?;
        let [columns, rows] = [0, 1].map(|axis| Numbered {
            range: ranges[axis][0]..ranges[axis][1],
            ticks: axes[axis].ticks(ranges[axis]),
        });
        let mut chart = ChartBuilder::on(&root)
            .margin_top(48)
            .margin_right(14)
            .margin_bottom(4)
            .margin_left(6)
            .x_label_area_size(42)
            .y_label_area_size(54)
            .build_cartesian_2d(columns, rows)?;
        chart
            .configure_mesh()
            .max_light_lines(0)
            .bold_line_style(GRID)
            .axis_style(INK)
            .x_desc(axes[0].label.as_str())
            .y_desc(axes[1].label.as_str())
            .label_style(("sans-serif", 14, &INK))
            .axis_desc_style(("sans-serif", 15, &INK))
            .draw()?;
        draw(&mut chart)?;
        root.present()?;
        Ok::<(), Failure>(())
    })();
    drawn.expect(NO_FAILURE);
    drop(root);
    svg
}

fn draw_head(root: &Area, title: &str, legend: &[(&str, RGBColor)]) -> Result<(), Failure> {
    let bold = ("sans-serif", 17, FontStyle::Bold).into_font().color(&INK);
    root.draw(&Text::new(title.to_owned(), (10, 8), bold))?;
    let mut left = 12;
    for (name, colour) in legend {
        let swatch = [(left, 31), (left + 14, 37)];
        root.draw(&Rectangle::new(swatch, colour.filled()))?;
        let plain = ("sans-serif", 14).into_font().color(&INK);
        let text = Text::new((*name).to_owned(), (left + 19, 28), plain);
        root.draw(&text)?;
        left += 19 + 11 + (name.chars().count() as f64 * 6.3) as i32;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes(is_log: bool) -> [Axis; 2] {
        ["a", "b"].map(|label| Axis {
            label: label.to_owned(),
            is_log,
        })
    }

    fn chart(shape: Shape, points: Vec<[f64; 2]>, is_log: bool) -> String {
        let series = Series {
            name: "<one & two>".to_owned(),
            colour: RED,
            shape,
            points,
        };
        let chart = Chart {
            title: "title".to_owned(),
            axes: axes(is_log),
            series: vec![series],
            mark: None,
        };
        chart.svg()
    }

    fn count(svg: &str, element: &str) -> usize {
        let document = roxmltree::Document::parse(svg).unwrap();
        let nodes = document.descendants();
        nodes
            .filter(|node| node.has_tag_name((SVG, element)))
            .count()
    }

    const SVG: &str = "http://www.w3.org/2000/svg";

    #[test]
    fn chart_draws_every_point_that_its_axes_have() {
        let points = vec![[1.0, 2.0], [10.0, 3.0], [100.0, 0.0]];
        assert_eq!(
            count(&chart(Shape::Dots, points.clone(), false), "circle"),
            3
        );
        assert_eq!(count(&chart(Shape::Dots, points, true), "circle"), 2);
    }

    #[test]
    fn chart_without_points_or_with_one_is_a_frame() {
        for points in [vec![], vec![[5.0, 5.0]], vec![[0.0, 0.0]]] {
            for shape in [Shape::Line, Shape::Bars] {
                let svg = chart(shape, points.clone(), false);
                assert!(count(&svg, "text") > 4, "{svg}");
                assert!(!svg.contains("NaN"), "{svg}");
            }
        }
    }

    #[test]
    fn heat_map_has_a_cell_for_each_pair() {
        let map = |numbers| HeatMap {
            title: String::new(),
            axes: axes(true),
            values: [vec![1e-3, 1e-2, 1e-1], vec![1.0, 10.0]],
            numbers,
        };
        let cells = |numbers| count(&map(numbers).svg(), "rect");
        let [empty, full] = [cells(vec![]), cells(vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0])];
        assert_eq!(full - empty, 6);
    }
}
