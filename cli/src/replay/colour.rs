//! Colours of wires and bodies that are called after one.

/// Names and the colours to draw them in, which can be told from a light and from a dark
/// background.
const COLOURS: [(&str, &str); 20] = [
    ("beige", "#cdb98a"),
    ("black", "#555b61"),
    ("blue", "#2f7fd0"),
    ("brown", "#9c6a3c"),
    ("cyan", "#17a8bd"),
    ("gold", "#c79a1b"),
    ("gray", "#8a949e"),
    ("green", "#2f9e44"),
    ("grey", "#8a949e"),
    ("magenta", "#c2379b"),
    ("navy", "#3f5fa8"),
    ("olive", "#85892c"),
    ("orange", "#e8730c"),
    ("pink", "#e377a8"),
    ("purple", "#8a57c2"),
    ("red", "#d63333"),
    ("teal", "#1a8f86"),
    ("violet", "#8a57c2"),
    ("white", "#b9c1c9"),
    ("yellow", "#d3ae0e"),
];

/// The colour that a name has in it as a word of its own, such as `blue box`.
pub(super) fn of_name(name: &str) -> Option<&'static str> {
    let words = name.split(|c: char| !c.is_alphabetic());
    let mut colours = words.filter_map(|word| {
        let known = |(name, _): &&(&str, _)| word.eq_ignore_ascii_case(name);
        COLOURS.iter().find(known).map(|(_, colour)| *colour)
    });
    colours.next()
}

#[cfg(test)]
mod tests {
    use super::of_name;

    #[test]
    fn colour_is_a_word_of_the_name() {
        assert_eq!(of_name("Blue box"), of_name("blue"));
        assert!(of_name("blue").is_some());
        assert_ne!(of_name("brown-cylinder"), of_name("blue"));
        assert_eq!(of_name("tired"), None);
        assert_eq!(of_name(""), None);
    }
}
