//! What is said of mistakes in scene files, and that what is let through is read.

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::check;
use crate::scenes::Scene;

const FILE: &str = r#"title = "A wire that holds a ball"
duration = 2

[settings]
step = 0.016
gravity = [0, 0, -9.8]
sweeps = 200

[[bodies]]
name = "ball"
shape = { sphere = { radius = 0.1 } }
position = [0, 0, -2.1]
turn = { axis = [1, 0, 0], degrees = 90 }
drive = { dynamic = { density = 1000 } }

[[bodies]]
name = "deck"
shape = "plane"
position = [0, 0, -9]

[[bodies]]
name = "cart"
shape = { mesh = { vertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], triangles = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]] } }
position = [5, 2, 3]
drive = { kinematic = [{ from = 1, velocity = [1, 0, 0] }, { from = 2 }] }

[[wires]]
name = "rope"
material = { radius = 0.01, bend_modulus = 0 }
resolution = 0.25
adaptive = false
reel = [{ from = 0, speed = 0 }]
route = [
  { pinned = [0, 0, 0] },
  { hang = 7 },
  { contact = { body = "cart", local = [0, 0, 0], normal = [0, 0, 2], friction = 0.25 } },
  { eye = { body = "ball", local = [0, 0, 0.1] } },
]
"#;

const STOPS: &str = "{ free = [x, y, z] }, { pinned = [x, y, z] }, { eye = { body = \"text\", local = [x, y, z] } }, \
    { contact = { body = \"text\", local = [x, y, z], normal = [x, y, z], friction = number } }, { hang = number }";

const PINNED: &str = "{ pinned = [0, 0, 0] }";
const EYE: &str = "{ eye = { body = \"ball\", local = [0, 0, 0.1] } }";
const SPHERE: &str = "{ sphere = { radius = 0.1 } }";
const DYNAMIC: &str = "{ dynamic = { density = 1000 } }";

fn said(from: &str, to: &str) -> String {
    assert_eq!(FILE.matches(from).count(), 1, "{from}");
    let error = Scene::from_toml(&FILE.replacen(from, to, 1));
    error.map(|_| ()).unwrap_err().to_string()
}

#[test]
fn mistakes_in_routes_are_said_in_words_of_the_file() {
    assert!(Scene::from_toml(FILE).is_ok());
    let cases = [
        (
            PINNED,
            "{ pin = [0, 0, 0] }",
            &*format!("[0]: there is no pin, it must be one of {STOPS}"),
        ),
        (
            PINNED,
            "[0, 0, 0]",
            &*format!("[0]: is a list, it must be one of {STOPS}"),
        ),
        (
            PINNED,
            "{ }",
            &*format!("[0]: is a table, it must be one of {STOPS}"),
        ),
        (
            PINNED,
            "{ pinned = [0, 0] }",
            "[0].pinned: has 2 numbers, it must be [x, y, z]",
        ),
        (
            PINNED,
            "{ pinned = [0, 0, 0, 0] }",
            "[0].pinned: has 4 numbers, it must be [x, y, z]",
        ),
        (
            PINNED,
            "{ pinned = 3 }",
            "[0].pinned: is the number 3, it must be 3 numbers, [x, y, z]",
        ),
        (
            PINNED,
            "{ pinned = { x = 0 } }",
            "[0].pinned: is a table, it must be 3 numbers, [x, y, z]",
        ),
        (
            PINNED,
            "{ pinned = [0, \"0\", 0] }",
            "[0].pinned[1]: is the text \"0\", it must be a number, without quotes",
        ),
        (
            PINNED,
            "\"pinned\"",
            "[0]: is \"pinned\" alone, it must be { pinned = [x, y, z] }",
        ),
        (
            PINNED,
            "{ pinned = [0, 0, 0], free = [1, 0, 0] }",
            "[0]: has free and pinned, only one of them may be there",
        ),
        (
            PINNED,
            "{ pinned = [0, 0, 0], friction = 1 }",
            "[0]: has friction and pinned, it must be { pinned = [x, y, z] }",
        ),
        (
            "hang = 7",
            "hang = { length = 5 }",
            "[1].hang: is a table, it must be a number",
        ),
        (
            "hang = 7",
            "hang = -5",
            "[1].hang: hang is -5, it must be above 6.164414002968976, the way between the stops before \
             and after it",
        ),
        (
            "{ pinned = [0, 0, 0] },\n  { hang = 7 }",
            "{ hang = 7 },\n  { pinned = [0, 0, 0] }",
            "[0].hang: hang is 7, it must be between two stops that have places: free, pinned, eye or \
             contact",
        ),
        (
            EYE,
            "{ eye = \"ball\" }",
            "[3].eye: is the text \"ball\", it must be a table, { body = \"text\", local = [x, y, z] }",
        ),
        (
            EYE,
            "{ eye = { body = \"ball\" } }",
            "[3].eye: local is missing, 3 numbers, [x, y, z]: the point in the body's frame, in m",
        ),
        (
            EYE,
            "{ eye = { body = 1, local = [0, 0, 0.1] } }",
            "[3].eye.body: is the number 1, it must be a text in quotes",
        ),
        (
            EYE,
            "{ eye = { bdy = \"ball\", local = [0, 0, 0.1] } }",
            "[3].eye.bdy: there is no such field; the fields are body, local",
        ),
        (
            EYE,
            "{ eye = { body = \"bal\", local = [0, 0, 0.1] } }",
            "[3].eye.body: there is no body \"bal\"; bodies are ball, deck, cart",
        ),
        (
            ", friction = 0.25",
            "",
            "[2].contact: friction is missing, a number: coefficient of friction",
        ),
    ];
    for (from, to, wrong) in cases {
        let text = said(from, to);
        let at = text.find(wrong);
        assert!(
            at.is_some_and(|at| text[..at].ends_with(": wires[0].route")),
            "{text}"
        );
        let line = 1 + FILE[..FILE.find(from).unwrap()].matches('\n').count();
        assert!(text.starts_with(&format!("line {line}: ")), "{text}");
    }
}

#[test]
fn mistakes_in_bodies_and_elsewhere_are_said_in_words_of_the_file() {
    let shapes = "{ box = { half = [x, y, z] } }, { cylinder = { radius = number, half_height = number } }, \
        { sphere = { radius = number } }, { capsule = { radius = number, half_height = number } }, \"plane\", \
        { mesh = { vertices = [[x, y, z], ...], triangles = [[i, j, k], ...] } }";
    let drives =
        "\"static\", { kinematic = [{ from = number }, ...] }, { dynamic = { density = number } }";
    let cases = [
        (
            SPHERE,
            "{ sfere = { radius = 0.1 } }",
            &*format!("line 11: bodies[0].shape: there is no sfere, it must be one of {shapes}"),
        ),
        (
            SPHERE,
            "\"cube\"",
            &*format!("line 11: bodies[0].shape: is the text \"cube\", it must be one of {shapes}"),
        ),
        (
            SPHERE,
            "\"sphere\"",
            "line 11: bodies[0].shape: is \"sphere\" alone, it must be { sphere = { radius = number } }",
        ),
        (
            SPHERE,
            "{ sphere = 0.1 }",
            "line 11: bodies[0].shape.sphere: is the number 0.1, it must be a table, { radius = number }",
        ),
        (
            SPHERE,
            "{ sphere = { radius = \"10 cm\" } }",
            "line 11: bodies[0].shape.sphere.radius: is the text \"10 cm\", it must be a number",
        ),
        (
            SPHERE,
            "{ sphere = { radius = -0.1 } }",
            "line 11: bodies[0].shape.sphere.radius: radius is -0.1, it must be finite and above 0",
        ),
        (
            SPHERE,
            "{ box = [0.1, 0.1, 0.1] }",
            "line 11: bodies[0].shape.box: is a list, it must be a table, { half = [x, y, z] }",
        ),
        (
            SPHERE,
            "{ cylinder = { radius = 0.1 } }",
            "line 11: bodies[0].shape.cylinder: half_height is missing, a number: half of the height",
        ),
        (
            "\"plane\"",
            "{ plane = true }",
            "line 18: bodies[1].shape: is a table, it must be \"plane\"",
        ),
        (
            "[1, 2, 3]]",
            "[1, 2, -3]]",
            "line 23: bodies[2].shape.mesh.triangles[3][2]: is the number -3, it must be a whole number from 0 on",
        ),
        (
            "[1, 2, 3]]",
            "[1, 2]]",
            "line 23: bodies[2].shape.mesh.triangles[3]: has 2 numbers, it must be [i, j, k]",
        ),
        (
            DYNAMIC,
            "\"fixed\"",
            &*format!(
                "line 14: bodies[0].drive: is the text \"fixed\", it must be one of {drives}"
            ),
        ),
        (
            DYNAMIC,
            "{ dynamic = { mass = 3 } }",
            "line 14: bodies[0].drive.dynamic.mass: there is no such field; the fields are angular_velocity, density, velocity",
        ),
        (
            DYNAMIC,
            "{ dynamic = 1000 }",
            "line 14: bodies[0].drive.dynamic: is the number 1000, it must be a table, { density = number }",
        ),
        (
            "turn = { axis = [1, 0, 0], degrees = 90 }",
            "turn = 90",
            "line 13: bodies[0].turn: is the number 90, it must be a table, { axis = [x, y, z], degrees = number }",
        ),
        (
            "turn = { axis = [1, 0, 0], degrees = 90 }",
            "density = 9",
            "line 13: bodies[0].density: there is no such field here, but drive.dynamic.density; the fields are drive, name, position, shape, turn",
        ),
        (
            "position = [0, 0, -2.1]\n",
            "",
            "line 9: bodies[0]: position is missing, 3 numbers, [x, y, z]: where its centre of mass starts, in m",
        ),
        (
            "reel = [{ from = 0, speed = 0 }]",
            "reel = 0.5",
            "line 32: wires[0].reel: is the number 0.5, it must be a list, [{ from = number, speed = number }, ...]",
        ),
        (
            "reel = [{ from = 0, speed = 0 }]",
            "reel = [{ from = 0, speed = 0 }, { from = 0, speed = 1 }]",
            "line 32: wires[0].reel: phase 2 of the reel starts at 0 s, it must start after phase 1, which starts at 0 s",
        ),
        (
            "adaptive = false",
            "adaptive = 0",
            "line 31: wires[0].adaptive: is the number 0, it must be true or false",
        ),
        (
            "resolution = 0.25",
            "resolution = 123456789012345678901",
            "line 30: wires[0].resolution: is the number 123456789012345678901, it must be a number, this large with an exponent",
        ),
        (
            "resolution = 0.25",
            "resolution = 1979-05-27",
            "line 30: wires[0].resolution: is a date, it must be a number",
        ),
        (
            "sweeps = 200",
            "sweeps = 1.5",
            "line 7: settings.sweeps: is the number 1.5, it must be a whole number from 0 on",
        ),
        (
            "duration = 2\n",
            "",
            "line 1: duration is missing, a number: how long it lasts in s; rounded to whole steps",
        ),
        (
            "duration = 2\n",
            "duration = 2\ngravity = [0, 0, 0]\n",
            "line 3: gravity: there is no such field here, but settings.gravity; the fields are bodies, contact_nodes, duration, friction, guarded_thickness, settings, title, wires",
        ),
        (
            "[[wires]]",
            "[wires]",
            "line 27: wires: is a table, it must be a list of tables, each under [[wires]]",
        ),
        (
            "[settings]\n",
            "[[settings]]\n",
            "line 4: settings: is a list, it must be a table under [settings]",
        ),
        (
            "duration = 2\n",
            "duration = 2\nduration = 3\n",
            "line 3: \"duration = 3\": duration is there twice",
        ),
        (
            "step = 0.016",
            "step = 1/60",
            "line 5: \"step = 1/60\": what is no number, true, false, [list] or { table } has to be in quotes; no sums are worked out, such as 1/60",
        ),
        (
            "step = 0.016",
            "step = [",
            "line 6: \"gravity = [0, 0, -9.8]\": this is no TOML: ",
        ),
    ];
    for (from, to, wrong) in cases {
        let text = said(from, to);
        assert!(text.starts_with(wrong), "{text}\n{wrong}");
    }
}

/// Where each value of a file stands.
fn places(value: &Spanned<DeValue<'_>>, spans: &mut Vec<std::ops::Range<usize>>) {
    spans.push(value.span());
    match value.get_ref() {
        DeValue::Array(values) => values.iter().for_each(|value| places(value, spans)),
        DeValue::Table(values) => values.iter().for_each(|(_, value)| places(value, spans)),
        _ => {}
    }
}

/// Everything in the file replaced by everything else: the reader takes what the check lets through, and
/// what the check says has no words of the reader.
#[test]
fn what_is_let_through_is_read() {
    let mut spans = Vec::new();
    let root = DeTable::parse(FILE).unwrap();
    for (_, value) in root.get_ref() {
        places(value, &mut spans);
    }
    let others = [
        "\"text\"",
        "\"plane\"",
        "\"static\"",
        "\"pinned\"",
        "3",
        "-1",
        "1.5",
        "inf",
        "0x1f",
        "true",
        "[]",
        "[1, 2]",
        "[1, 2, 3]",
        "[1, 2, 3, 4]",
        "[[1, 2, 3]]",
        "{}",
        "{ hang = 1 }",
        "{ plane = {} }",
        "{ from = 1, speed = 2 }",
        "[{ from = 1, speed = 2 }]",
        "1979-05-27",
        SPHERE,
        DYNAMIC,
        EYE,
    ];
    let (mut read, mut refused) = (0, 0);
    for span in spans {
        for other in others {
            let text = format!("{}{other}{}", &FILE[..span.start], &FILE[span.end..]);
            let known = toml::from_str::<Scene>(&text);
            match check(&text) {
                Ok(()) => {
                    assert!(known.is_ok(), "{text}\n{known:?}");
                    read += 1;
                }
                Err(error) => {
                    let said = error.to_string();
                    assert!(said.starts_with("line ") && !said.contains('\n'), "{said}");
                    for word in [
                        "variant", "newtype", "untagged", "struct", "f64", "usize", "map",
                        "sequence", "expected",
                    ] {
                        assert!(!said.contains(word) || said.contains("no TOML"), "{said}");
                    }
                    refused += 1;
                }
            }
        }
    }
    println!("{read} read, {refused} refused");
    assert!(read > 300 && refused > 1000, "{read} {refused}");
}
