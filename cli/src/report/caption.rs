//! What stands around a picture: what happens in numbers, and what the lines mean.

use nalgebra::Vector2;
use tunnelproof::query::QueryKind;

use tunnelproof_reference::answer::{Enclosure, ExactAnswer, ExactHit, Parameters};

use super::picture::{When, draw_edge};
use super::svg::{Canvas, Font, INK, PAINTS, PALE_INK, elided};

pub(super) const HEADLINE: Font = Font {
    size: 17,
    colour: INK,
    is_bold: true,
    is_centred: false,
};

pub(super) const DETAIL: Font = Font {
    size: 13,
    colour: PALE_INK,
    is_bold: false,
    ..HEADLINE
};

/// The title above the picture.
pub(super) fn title(canvas: &mut Canvas, title: &str) {
    canvas.text(Vector2::new(32.0, 38.0), HEADLINE, &elided(title, 80));
}

/// What happens, below the picture on the left.
pub(super) fn caption(canvas: &mut Canvas, answer: &ExactAnswer, is_drawn_apart: bool) {
    let (headline, detail) = match &answer.hit {
        None => ("No contact".to_owned(), format!("{} case", answer.case)),
        Some(hit) => {
            let kind = capitalised(hit.kind.name());
            let headline = format!("{kind} at t {}", about(hit.toi));
            (headline, details(answer, hit))
        }
    };
    canvas.text(Vector2::new(32.0, 578.0), HEADLINE, &headline);
    canvas.text(Vector2::new(32.0, 600.0), DETAIL, &detail);
    if is_drawn_apart {
        let note = "All points are on one line, or nearly: times are drawn apart, downwards.";
        canvas.text(Vector2::new(32.0, 620.0), DETAIL, note);
    }
}

fn details(answer: &ExactAnswer, hit: &ExactHit) -> String {
    let mut parts = vec![format!("{} case", answer.case)];
    if hit.flags.temporarily_parallel {
        parts.push("temporarily parallel".to_owned());
    }
    if hit.flags.temporarily_point {
        parts.push("temporarily a point".to_owned());
    }
    let place = |place: Parameters| format!("u {}, v {}", about(place.u), about(place.v));
    parts.push(match hit.second {
        None => place(hit.first),
        Some(second) => format!("from {} to {}", place(hit.first), place(second)),
    });
    parts.join(" \u{b7} ")
}

/// `= 0.5`, or `\u{2248} 0.333333` where six digits are not the whole number. More digits where six would be an end of
/// the step or of an edge that it is not.
pub(super) fn about(number: Enclosure) -> String {
    let value = number.below;
    if value == 0.0 && !number.is_exact() {
        return "just above 0".to_owned();
    }
    let mut roundings = (6..17).map(|digits| format!("{value:.digits$}"));
    let rounded = roundings.find(|text| value == 1.0 || text.parse() != Ok(1.0));
    let rounded = rounded.unwrap_or_else(|| value.to_string());
    let short = rounded.trim_end_matches('0').trim_end_matches('.');
    let is_whole = number.is_exact() && format!("{value:.6}").parse() == Ok(value);
    match (is_whole, value > 0.0 && value < 1e-4) {
        (true, _) => format!("= {short}"),
        (false, true) => format!("\u{2248} {value:.3e}"),
        (false, false) => format!("\u{2248} {short}"),
    }
}

/// What the lines mean, below the picture on the right.
pub(super) fn legend(canvas: &mut Canvas, kind: QueryKind, is_hit: bool) {
    let words = Font {
        colour: INK,
        ..DETAIL
    };
    let mut entries = vec![("start", When::Start), ("end", When::End)];
    if is_hit {
        entries.insert(1, ("impact", When::Impact));
    }
    let mut x = if is_hit { 540.0 } else { 700.0 };
    let sides = match kind {
        QueryKind::EdgeEdge => ["AB", "CD"],
        QueryKind::VertexFace => ["A", "BCD"],
    };
    for (edge, name) in sides.into_iter().enumerate() {
        let font = Font {
            size: 11,
            colour: PAINTS[edge].dark,
            is_bold: true,
            is_centred: false,
        };
        let y = 571.0 + 13.0 * edge as f64;
        canvas.text(Vector2::new(x - 28.0, y), font, name);
    }
    for (name, when) in entries {
        for edge in 0..2 {
            let y = 567.0 + 13.0 * edge as f64;
            let ends = [Vector2::new(x, y), Vector2::new(x + 26.0, y)];
            draw_edge(canvas, ends, edge, when, 0.65);
        }
        canvas.text(Vector2::new(x + 38.0, 578.0), words, name);
        x += 60.0 + 8.0 * name.len() as f64;
    }
    if is_hit {
        canvas.sphere(Vector2::new(x + 4.0, 573.5), 7.0);
        canvas.text(Vector2::new(x + 18.0, 578.0), words, "contact");
    }
}

fn capitalised(word: &str) -> String {
    let mut chars = word.chars();
    let first = chars.next().into_iter().flat_map(char::to_uppercase);
    first.chain(chars).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn about_says_equal_only_of_the_whole_number() {
        assert_eq!(about(Enclosure::exactly(0.5)), "= 0.5");
        assert_eq!(about(Enclosure::exactly(0.0)), "= 0");
        assert_eq!(about(Enclosure::exactly(1.0)), "= 1");
        assert_eq!(
            about(Enclosure::exactly(2f64.powi(-20))),
            "\u{2248} 9.537e-7"
        );
        let third = Enclosure {
            below: 1.0 / 3.0,
            above: (1.0f64 / 3.0).next_up(),
        };
        assert_eq!(about(third), "\u{2248} 0.333333");
        assert_eq!(
            about(Enclosure::exactly(0.999_999_995_2)),
            "\u{2248} 0.999999995"
        );
        let last = 1.0f64.next_down();
        assert_eq!(
            about(Enclosure::exactly(last)),
            "\u{2248} 0.9999999999999999"
        );
        let first = Enclosure {
            below: 0.0,
            above: 0.0f64.next_up(),
        };
        assert_eq!(about(first), "just above 0");
    }
}
