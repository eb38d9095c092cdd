//! What pictures are drawn on: shapes and text as SVG.

use std::fmt::Write as _;

use nalgebra::Vector2;

/// The colour of text.
pub(super) const INK: &str = "#1f2933";
/// The colour of text that matters less.
pub(super) const PALE_INK: &str = "#616e7c";
/// The colour of the background.
pub(super) const PAPER: &str = "#fcfcfa";

/// The colours of an edge.
pub(super) struct Paint {
    /// At the end of the step.
    pub(super) solid: &'static str,
    /// At its start.
    pub(super) faint: &'static str,
    /// At the time of impact.
    pub(super) dark: &'static str,
}

/// Blue for `AB`, green for `CD`.
pub(super) const PAINTS: [Paint; 2] = [
    Paint {
        solid: "#2f7fd0",
        faint: "#d5e6f7",
        dark: "#14508f",
    },
    Paint {
        solid: "#3aa655",
        faint: "#d6f0dc",
        dark: "#17672d",
    },
];

/// The point of an overlap.
pub(super) const OVERLAP: &str = "#f9b872";

/// Each colour on light paper, and the one in its place where the reader has chosen dark paper.
const ON_DARK: [(&str, &str); 10] = [
    (PAPER, "#1a2128"),
    (INK, "#e4e9ee"),
    (PALE_INK, "#9fb0bf"),
    (OVERLAP, "#a9692a"),
    (PAINTS[0].solid, "#5ba4ec"),
    (PAINTS[0].faint, "#1d3a57"),
    (PAINTS[0].dark, "#a9d2fb"),
    (PAINTS[1].solid, "#55bf73"),
    (PAINTS[1].faint, "#1c4229"),
    (PAINTS[1].dark, "#a5e5b6"),
];

/// Rules for dark paper. Programs that do not know them draw the picture on light paper.
fn on_dark() -> String {
    let rule = |(light, dark): &(&str, &str)| {
        format!(r#"[fill="{light}"]{{fill:{dark}}}[stroke="{light}"]{{stroke:{dark}}}"#)
    };
    let rules: String = ON_DARK.iter().map(rule).collect();
    format!("<style>@media (prefers-color-scheme:dark){{{rules}}}</style>\n")
}

/// How a text looks.
#[derive(Clone, Copy)]
pub(super) struct Font {
    pub(super) size: u32,
    pub(super) colour: &'static str,
    pub(super) is_bold: bool,
    /// Whether it is placed by the middle of its baseline instead of the start.
    pub(super) is_centred: bool,
}

/// An SVG document that is being drawn, lengths in pixels, y downwards.
pub(super) struct Canvas(String);

impl Canvas {
    /// An empty sheet of this size.
    pub(super) fn new(width: f64, height: f64, title: &str) -> Self {
        let title = escape(title);
        let arrows = PAINTS.each_ref().map(|paint| paint.solid);
        let arrows: String = arrows.into_iter().enumerate().map(arrow).collect();
        let style = on_dark();
        Canvas(format!(
            r##"<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" font-family="DejaVu Sans, Helvetica, Arial, sans-serif">
<title>{title}</title>
<defs>
<radialGradient id="sphere" cx="0.36" cy="0.32" r="0.75"><stop offset="0" stop-color="#ffe0b0"/><stop offset="0.45" stop-color="#f79a2d"/><stop offset="1" stop-color="#d96f0b"/></radialGradient>
{arrows}</defs>
{style}<rect width="{width}" height="{height}" fill="{PAPER}"/>
"##
        ))
    }

    /// The document.
    pub(super) fn finish(self) -> String {
        self.0 + "</svg>\n"
    }

    /// A line with round ends; a dot if it has no length.
    pub(super) fn line(&mut self, [a, b]: [Vector2<f64>; 2], colour: &str, width: f64) {
        self.element(format_args!(
            r#"<line x1="{:.1}" y1="{:.1}" x2="{:.1}" y2="{:.1}" stroke="{colour}" stroke-width="{width}" stroke-linecap="round"/>"#,
            a.x, a.y, b.x, b.y
        ));
    }

    /// The path of an end of this edge, with an arrow past its middle if there is room for it.
    pub(super) fn path(&mut self, points: &[Vector2<f64>], edge: usize) {
        let chords = points.windows(2).map(|ends| [ends[0], ends[1]]);
        let length = |[from, to]: [Vector2<f64>; 2]| (to - from).norm();
        let mut left = 0.6 * chords.clone().map(length).sum::<f64>();
        let is_long = left > 18.0;
        // Where the arrow is: on the chord that is past the middle of the whole.
        let arrow = chords.clone().find(|&chord| {
            let is_here = left <= length(chord);
            left -= if is_here { 0.0 } else { length(chord) };
            is_here
        });
        let Some([from, to]) = arrow.or_else(|| chords.clone().next()) else {
            return;
        };
        if points.len() > 2 {
            self.polyline(points, edge, false);
        }
        if points.len() == 2 || is_long {
            let share = match length([from, to]) {
                0.0 => 0.0,
                chord => left / chord,
            };
            let middle = from + (to - from) * share;
            self.polyline(&[from, middle, to], edge, is_long);
        }
    }

    fn polyline(&mut self, points: &[Vector2<f64>], edge: usize, has_arrows: bool) {
        let pair = |p: &Vector2<f64>| format!("{:.1},{:.1}", p.x, p.y);
        let points: Vec<_> = points.iter().map(pair).collect();
        let marker = match has_arrows {
            true => format!(r#" marker-mid="url(#arrow{edge})""#),
            false => String::new(),
        };
        self.element(format_args!(
            r#"<polyline points="{}" fill="none" stroke="{}" stroke-width="1.3" stroke-opacity="0.75"{marker}/>"#,
            points.join(" "),
            PAINTS[edge].solid
        ));
    }

    /// A point of contact.
    pub(super) fn sphere(&mut self, at: Vector2<f64>, radius: f64) {
        self.element(format_args!(
            r##"<circle cx="{:.1}" cy="{:.1}" r="{radius}" fill="url(#sphere)" stroke="#a8560a" stroke-width="1.2"/>"##,
            at.x, at.y
        ));
    }

    /// A text.
    pub(super) fn text(&mut self, at: Vector2<f64>, font: Font, words: &str) {
        let Font { size, colour, .. } = font;
        let weight = if font.is_bold { 600 } else { 400 };
        let anchor = if font.is_centred { "middle" } else { "start" };
        let words = escape(words);
        self.element(format_args!(
            r#"<text x="{:.1}" y="{:.1}" text-anchor="{anchor}" font-size="{size}" font-weight="{weight}" fill="{colour}" stroke="{PAPER}" stroke-width="3" stroke-linejoin="round" paint-order="stroke">{words}</text>"#,
            at.x, at.y
        ));
    }

    fn element(&mut self, element: std::fmt::Arguments) {
        // Writing to a string does not fail.
        let _ = writeln!(self.0, "{element}");
    }
}

/// The arrow on the path of an end of an edge.
fn arrow((edge, colour): (usize, &str)) -> String {
    format!(
        r#"<marker id="arrow{edge}" viewBox="0 0 10 10" refX="6" refY="5" markerUnits="userSpaceOnUse" markerWidth="11" markerHeight="11" orient="auto"><path d="M1 1 L9 5 L1 9 Z" fill="{colour}"/></marker>
"#
    )
}

/// Text as XML may hold it.
fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

/// `text` without its middle if it is longer than `longest` characters.
pub(super) fn elided(text: &str, longest: usize) -> String {
    let count = text.chars().count();
    if count <= longest {
        return text.to_owned();
    }
    let head: String = text.chars().take(longest / 3).collect();
    let kept = longest - longest / 3 - 1;
    let tail: String = text.chars().skip(count - kept).collect();
    format!("{head}\u{2026}{tail}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escape_leaves_nothing_that_xml_forbids() {
        assert_eq!(escape("a<b>&\"c\""), "a&lt;b&gt;&amp;&quot;c&quot;");
        assert_eq!(escape("\u{0}\u{1b}\u{ffff}x"), "\u{fffd}\u{fffd}\u{fffd}x");
    }

    #[test]
    fn every_colour_has_one_for_dark_paper_and_is_the_same_without_it() {
        let mut canvas = Canvas::new(10.0, 10.0, "colours");
        let ends = [Vector2::zeros(), Vector2::new(5.0, 5.0)];
        for (light, _) in ON_DARK {
            canvas.line(ends, light, 1.0);
        }
        canvas.path(&ends, 0);
        let picture = canvas.finish();
        let document = roxmltree::Document::parse(&picture).unwrap();
        let mut used = 0;
        for node in document.descendants() {
            for colour in ["fill", "stroke"]
                .iter()
                .filter_map(|name| node.attribute(*name))
            {
                let is_of_sphere = colour == "none" || colour.starts_with("url");
                assert!(
                    is_of_sphere || picture.contains(&format!("[fill=\"{colour}\"]")),
                    "{colour}"
                );
                used += 1;
            }
        }
        assert!(used > ON_DARK.len());
    }

    #[test]
    fn elided_keeps_both_ends() {
        assert_eq!(elided("abc", 3), "abc");
        assert_eq!(elided("abcdefghijkl", 9), "abc\u{2026}hijkl");
    }
}
