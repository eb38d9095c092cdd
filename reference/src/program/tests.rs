//! What programs write, read; programs in a shell, asked.

use tunnelproof::contact::Case;
use tunnelproof::narrow::Unsupported;
use tunnelproof::query::{Query, QueryKind};

use super::wire::{Message, Reply, Wire};
use super::*;
use crate::answer::Enclosure;
use crate::generate::{self, rigid_by_name};
use crate::subject::Said;

fn queries(family: &str) -> Vec<Query> {
    let family = generate::by_name(family).unwrap();
    (0..20).map(|index| family.query(1, index)).collect()
}

fn said(toi: Option<f64>, case: Option<Case>) -> Reply {
    let toi = toi.map(Enclosure::exactly);
    Reply::Said(Said { toi, case })
}

fn line(text: &str) -> Result<Message, Lapse> {
    Wire::Lines.parse(text.as_bytes())
}

#[test]
fn line_says_what_it_says() {
    for (text, id, reply) in [
        (r#"{"hit":false}"#, None, said(None, None)),
        (r#"{"hit":true,"toi":0.25}"#, None, said(Some(0.25), None)),
        (r#"{"hit":true,"toi":1}"#, None, said(Some(1.0), None)),
        (
            r#"{"hit":true,"toi":"0x1p-2"}"#,
            None,
            said(Some(0.25), None),
        ),
        (
            r#"{"id":"7","hit":false,"toi":9}"#,
            Some(7),
            said(None, None),
        ),
        (
            r#"{"id":7,"hit":false,"more":[]}"#,
            Some(7),
            said(None, None),
        ),
        (
            r#"{"id":null,"hit":false,"case":"coplanar"}"#,
            None,
            said(None, Some(Case::Coplanar)),
        ),
        (r#"{"unsupported":true}"#, None, Reply::Unsupported),
    ] {
        assert_eq!(line(text), Ok(Message { id, reply }), "{text}");
    }
    let toi = Some(Enclosure {
        below: 0.25,
        above: 0.5,
    });
    let reply = Reply::Said(Said { toi, case: None });
    let text = r#"{"hit":true,"toi":{"below":0.25,"above":0.5}}"#;
    assert_eq!(line(text), Ok(Message { id: None, reply }));
}

#[test]
fn line_with_a_time_that_is_none_is_read_and_judged() {
    for (text, expected) in [
        ("NaN", f64::NAN),
        ("null", f64::NAN),
        ("Infinity", f64::INFINITY),
        ("-Infinity", f64::NEG_INFINITY),
        ("1e999", f64::INFINITY),
        ("-0.1", -0.1),
    ] {
        let message = line(&format!(r#"{{"hit":true,"toi":{text}}}"#)).unwrap();
        let Reply::Said(Said { toi: Some(toi), .. }) = message.reply else {
            panic!("{message:?}")
        };
        assert_eq!(toi.below.to_bits(), expected.to_bits(), "{text}");
        assert_eq!(toi.above.to_bits(), expected.to_bits(), "{text}");
    }
}

#[test]
fn line_that_is_no_answer_is_unreadable() {
    for (text, what) in [
        (r#"{"hit": fa"#, r#"not JSON: {"hit": fa"#),
        ("hello", "not JSON: hello"),
        ("[]", "not a JSON object"),
        (r#"[null,null,true,0.5,null]"#, "not a JSON object"),
        ("5", "not a JSON object"),
        (
            r#"{"hit":true,"toi":0.5,"hit":false}"#,
            "hit is there twice: {",
        ),
        (
            r#"{"hit":true,"toi":0.5,"toi":0.25}"#,
            "toi is there twice: {",
        ),
        (
            r#"{"hit":true,"toi":{"below":0,"below":0.1,"above":1}}"#,
            "toi.below is there twice: {",
        ),
        ("{}", "there is no hit: {}"),
        (r#"{"unsupported":false}"#, "there is no hit: {"),
        (r#"{"hit":1}"#, "hit is 1, neither true nor false: {"),
        (
            r#"{"unsupported":"yes"}"#,
            r#"unsupported is "yes", neither true nor false: {"#,
        ),
        (r#"{"hit":true}"#, "a hit without toi: {"),
        (r#"{"hit":true,"toi":true}"#, "toi is true, not a number: {"),
        (
            r#"{"hit":true,"toi":"a"}"#,
            r#"toi is "a", not a number: {"#,
        ),
        (
            r#"{"hit":true,"toi":{"below":0}}"#,
            "there is no toi.above: {",
        ),
        (
            r#"{"hit":true,"toi":{"below":[0],"above":1}}"#,
            "toi.below is [0], not a number: {",
        ),
        (
            r#"{"hit":true,"toi":{"below":1,"above":0}}"#,
            "toi.below is above toi.above: {",
        ),
        (
            r#"{"hit":false,"case":"x"}"#,
            r#"case is "x", not the name of one: {"#,
        ),
        (
            r#"{"hit":false,"id":"lattice:1:2"}"#,
            r#"id is "lattice:1:2", that of no query: {"#,
        ),
    ] {
        let lapse = line(text).unwrap_err();
        assert_eq!(lapse.kind, LapseKind::Unreadable);
        assert!(lapse.detail.starts_with(what), "{text}: {lapse}");
    }
    let lapse = line(&format!(r#"{{"hit":{:?}}}"#, "\n".repeat(5000))).unwrap_err();
    assert!(lapse.detail.len() < 180, "{lapse}");
    assert!(
        Wire::Lines
            .parse(b"\xff")
            .unwrap_err()
            .detail
            .starts_with("not UTF-8")
    );
}

#[test]
fn line_that_is_too_long_is_unreadable_and_says_so() {
    let longest = |more: usize| {
        let line = r#"{"hit":false}"#;
        let blanks = " ".repeat(lines::LONGEST_LINE + more - line.len());
        let mut text = &*format!("{{{blanks}{}\n", &line[1..]).into_bytes();
        Wire::Lines.read(&mut text).unwrap().unwrap()
    };
    assert_eq!(
        Wire::Lines.parse(&longest(0)).unwrap().reply,
        said(None, None)
    );
    let lapse = Wire::Lines.parse(&longest(1)).unwrap_err();
    assert!(
        lapse.detail.starts_with("longer than 65536 bytes: {"),
        "{lapse}"
    );
    assert!(lapse.detail.len() < 120, "{lapse}");
}

/// Whether a JSON schema of `schema/` takes this text.
fn is_valid(schema: &str, text: &str) -> bool {
    let schema = serde_json::from_str(schema).unwrap();
    serde_json::from_str(text).is_ok_and(|json| jsonschema::is_valid(&schema, &json))
}

#[test]
fn schema_of_answers_takes_the_lines_that_are_read() {
    let schema = include_str!("../../schema/answer.json");
    for text in [
        r#"{"hit":false}"#,
        r#"{"id":"7","hit":true,"toi":0.25,"more":1}"#,
        r#"{"id":7,"hit":true,"toi":"0x1.8p-2","case":"general"}"#,
        r#"{"id":null,"hit":true,"toi":{"below":0.25,"above":0.5}}"#,
        r#"{"hit":true,"toi":null}"#,
        r#"{"unsupported":true}"#,
        r#"{}"#,
        r#"{"hit":1}"#,
        r#"{"hit":true}"#,
        r#"{"hit":true,"toi":true}"#,
        r#"{"hit":true,"toi":"a"}"#,
        r#"{"hit":true,"toi":{"below":0}}"#,
        r#"{"hit":false,"case":"x"}"#,
        r#"{"hit":false,"id":"lattice:1:2"}"#,
        r#"{"unsupported":false}"#,
    ] {
        assert_eq!(is_valid(schema, text), line(text).is_ok(), "{text}");
    }
}

#[test]
fn schema_of_queries_takes_the_lines_that_are_written() {
    let schema = include_str!("../../schema/query.json");
    for family in ["scales", "face_uniform", "thick_face_lattice"] {
        for query in queries(family) {
            let mut bytes = Vec::new();
            query.write(Wire::Lines, 7, &mut bytes);
            let text = String::from_utf8(bytes).unwrap();
            assert!(is_valid(schema, &text), "{text}");
        }
    }
    assert!(!is_valid(
        schema,
        r#"{"id":"7","kind":"edge-edge","points":[],"radius":0}"#
    ));
}

/// A frame of an answer, with its length, written the way the documentation has it.
fn frame(id: u64, verdict: u32, toi: f64) -> Vec<u8> {
    let mut bytes = vec![24, 0, 0, 0];
    bytes.extend(id.to_le_bytes());
    bytes.extend(verdict.to_le_bytes());
    bytes.extend([0; 4]);
    bytes.extend(toi.to_le_bytes());
    bytes
}

#[test]
fn frame_of_a_query_has_every_number_in_its_place() {
    for query in queries("thick_face_lattice")
        .into_iter()
        .chain(queries("scales"))
    {
        let mut bytes = Vec::new();
        query.write(Wire::Binary, 9, &mut bytes);
        assert_eq!(bytes.len(), 4 + frames::QUERY);
        assert_eq!(bytes[..4], [224, 0, 0, 0]);
        assert_eq!(bytes[4..12], 9u64.to_le_bytes());
        assert_eq!(bytes[12] == 1, query.kind() == QueryKind::VertexFace);
        assert_eq!(bytes[13..20], [0; 7]);
        let numbers = bytes[20..].chunks(8);
        let numbers: Vec<_> = numbers
            .map(|b| f64::from_le_bytes(b.try_into().unwrap()))
            .collect();
        assert_eq!(numbers[..2], query.radius().parts());
        let points = query.start().iter().chain(query.end());
        let flat: Vec<_> = points.flat_map(|p| [p.x, p.y, p.z]).collect();
        assert_eq!(numbers[2..], flat);
    }
}

#[test]
fn frame_of_bodies_that_turn_has_every_number_in_its_place() {
    let mut kinds = Vec::new();
    for name in ["turning_thick_scales", "turning_bodies_thick_uniform"] {
        let family = rigid_by_name(name).unwrap();
        for query in (0..20).map(|index| family.query(1, index)) {
            let mut bytes = Vec::new();
            query.write(Wire::Binary, 9, &mut bytes);
            let length = u32::from_le_bytes(bytes[..4].try_into().unwrap());
            assert_eq!(bytes.len(), 4 + length as usize);
            assert_eq!(bytes[4..12], 9u64.to_le_bytes());
            assert_eq!(bytes[13..20], [0; 7]);
            kinds.push((bytes[12], query.kind().name(), length));
            let numbers = bytes[20..].chunks(8);
            let numbers = numbers.map(|b| f64::from_le_bytes(b.try_into().unwrap()));
            // The same numbers as in a line of JSON, in the order of its fields.
            let mut lines = Vec::new();
            query.write(Wire::Lines, 9, &mut lines);
            let line: serde_json::Value = serde_json::from_slice(&lines).unwrap();
            let mut expected = query.radius().parts().to_vec();
            for rows in ["points", "local", "poses"].map(|name| line[name].as_array()) {
                let rows = rows
                    .into_iter()
                    .flatten()
                    .flat_map(|row| row.as_array().unwrap());
                expected.extend(rows.map(|x| x.as_f64().unwrap()));
            }
            assert_eq!(numbers.collect::<Vec<_>>(), expected);
        }
    }
    kinds.sort_unstable();
    kinds.dedup();
    let expected = [
        (3, "edge-turning-edge", 288),
        (4, "vertex-turning-face", 264),
        (5, "turning-edge-turning-edge", 352),
        (6, "turning-vertex-turning-face", 352),
    ];
    assert_eq!(kinds, expected);
}

#[test]
fn frame_of_an_answer_is_read_and_garbage_is_not() {
    let mut bytes = frame(3, 1, 0.25);
    bytes.extend(frame(4, 0, f64::NAN));
    bytes.extend(frame(5, 2, 0.0));
    bytes.extend(frame(6, 3, 0.0));
    bytes.extend([24, 0, 0]);
    let mut reader = bytes.as_slice();
    let mut next = || {
        let frame = Wire::Binary.read(&mut reader).unwrap();
        frame.map(|frame| Wire::Binary.parse(&frame))
    };
    let message = |id, reply| {
        Some(Ok(Message {
            id: Some(id),
            reply,
        }))
    };
    assert_eq!(next(), message(3, said(Some(0.25), None)));
    assert_eq!(next(), message(4, said(None, None)));
    assert_eq!(next(), message(5, Reply::Unsupported));
    assert_eq!(
        next().unwrap().unwrap_err().detail,
        "the verdict is 3, not 0, 1 or 2"
    );
    assert_eq!(
        next().unwrap().unwrap_err().detail,
        "not a frame of 24 bytes: starts with [18, 00, 00]"
    );
    assert_eq!(next(), None);
}

#[test]
fn command_is_split_as_a_shell_splits_it() {
    let words = |text| Command::parse(text, Wire::Lines, TIME_LIMIT).map(|command| command.words);
    assert_eq!(
        words("./a  --b 'c d' \"e\"").unwrap(),
        ["./a", "--b", "c d", "e"]
    );
    assert_eq!(words(" "), Err(CommandError::Empty));
    assert_eq!(words("a 'b"), Err(CommandError::Quotes));
}

/// A program that runs this in a shell for each line.
#[cfg(unix)]
fn shell(body: &str, limit: Duration) -> Program {
    let words = ["sh", "-c", &format!("while read -r line; do {body}; done")];
    let command = Command {
        words: words.map(str::to_owned).to_vec(),
        wire: Wire::Lines,
        time_limit: limit,
    };
    Program::start("cmd:sh", command).unwrap()
}

#[cfg(unix)]
fn kinds(answers: &[Result<Answer, NoAnswer>]) -> Vec<Option<LapseKind>> {
    let kind = |answer: &Result<_, NoAnswer>| match answer {
        Ok(_) => None,
        Err(NoAnswer::Lapse(lapse)) => Some(lapse.kind),
        Err(NoAnswer::Unsupported(reason)) => panic!("{reason}"),
    };
    answers.iter().map(kind).collect()
}

#[cfg(unix)]
const PATIENT: Duration = Duration::from_secs(60);

#[cfg(unix)]
#[test]
fn program_that_answers_is_started_once() {
    let program = shell(r#"echo '{"hit":false}'; echo heard >&2"#, PATIENT);
    let queries = queries("uniform");
    for _ in 0..3 {
        let answers = program.answers(&queries);
        assert_eq!(answers, vec![Ok(Answer::Said(Said::default())); 20]);
    }
    let conduct = program.finish();
    assert_eq!((conduct.starts, conduct.surplus), (1, 0));
    assert_eq!(conduct.stderr, "heard\n".repeat(60));
}

#[cfg(unix)]
#[test]
fn program_that_ends_at_once_fails_every_query() {
    let program = shell("kill -KILL $$", PATIENT);
    let answers = program.answers(&queries("uniform"));
    assert_eq!(kinds(&answers), vec![Some(LapseKind::Crashed); 20]);
    let detail = answers[0].clone().unwrap_err().to_string();
    assert!(detail.contains("signal: 9"), "{detail}");
    assert_eq!(program.finish().starts, 20);
}

#[cfg(unix)]
#[test]
fn program_that_hangs_is_given_up_with_all_that_it_started() {
    let limit = Duration::from_millis(50);
    let program = shell("sleep 3600", limit);
    let mut answers = program.answers(&queries("uniform"));
    assert_eq!(kinds(&answers), vec![Some(LapseKind::Hung); 20]);
    answers = program.answers(&queries("lattice"));
    assert_eq!(kinds(&answers), vec![Some(LapseKind::GivenUp); 20]);
    assert_eq!(program.finish().starts, 20);
}

#[cfg(unix)]
#[test]
fn program_that_answers_another_query_is_out_of_step() {
    let program = shell(r#"echo '{"id":3,"hit":false}'"#, PATIENT);
    let answers = program.answers(&queries("uniform"));
    assert_eq!(kinds(&answers), vec![Some(LapseKind::Misplaced); 20]);
}

#[cfg(unix)]
#[test]
fn program_that_answers_twice_is_found_out_at_the_latest_in_the_end() {
    let program = shell(r#"echo '{"hit":false}'; echo '{"hit":false}'"#, PATIENT);
    assert_eq!(kinds(&program.answers(&queries("uniform")[..1])), [None]);
    assert_eq!(program.finish().surplus, 1);
}

#[cfg(unix)]
#[test]
fn program_that_refuses_a_sort_does_not_take_it() {
    let program = shell(r#"echo '{"unsupported":true}'"#, PATIENT);
    let refusal = program.answer(&queries("face_uniform")[0]);
    assert_eq!(
        refusal,
        Err(Unsupported::Kind(QueryKind::VertexFace).into())
    );
    let query = queries("thick_uniform")[0];
    let refusal = program.answer(&query);
    assert_eq!(refusal, Err(Unsupported::Radius(query.radius()).into()));
}

#[test]
fn program_that_is_not_there_is_refused() {
    let command = Command::parse("./no-such-program", Wire::Lines, TIME_LIMIT).unwrap();
    assert!(Program::start("cmd:./no-such-program", command).is_err());
}
