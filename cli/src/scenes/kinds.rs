//! Whether a scene file has the entries that its schema says, each of its kind, so that what is
//! wrong is said in words of the file and not of its reader.

use std::sync::LazyLock;

use serde_json::Value;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::error::{Reason, SceneError, line_at};
use super::file::Scene;

static SCHEMA: LazyLock<Value> = LazyLock::new(Scene::schema);

/// What is wrong at a place of the file, a number of bytes from its start.
type Checked = Result<(), (usize, Vec<String>, String)>;

/// Sees to it that a file is TOML with the entries of a scene. Whether values make sense is seen
/// where the world is built.
///
/// # Errors
///
/// The first thing that is wrong, with its line.
pub(super) fn check(text: &str) -> Result<(), SceneError> {
    let root = DeTable::parse(text).map_err(|error| no_toml(text, &error))?;
    let checked = table(&SCHEMA, root.get_ref(), root.span().start, &[]);
    checked.map_err(|(at, path, wrong)| SceneError {
        line: Some(line_at(text, at)),
        path,
        reason: Reason::Text(wrong),
    })
}

/// What cannot be read at all.
fn no_toml(text: &str, error: &toml::de::Error) -> SceneError {
    let span = error.span().unwrap_or_default();
    let shown = |range| text.get(range).unwrap_or_default();
    let start = shown(0..span.start).rfind('\n').map_or(0, |at| at + 1);
    let line = shown(start..text.len()).lines().next().unwrap_or_default();
    let wrong = match error.message() {
        "duplicate key" => format!("{} is there twice", shown(span.clone())),
        message if message.starts_with("string values must be quoted") => {
            "what is no number, true, false, [list] or { table } has to be in quotes; no sums are worked \
             out, such as 1/60"
                .to_owned()
        }
        message => format!("this is no TOML: {message}"),
    };
    SceneError {
        line: Some(line_at(text, span.start)),
        path: Vec::new(),
        reason: Reason::Text(match line.trim() {
            "" => wrong,
            line => format!("\"{line}\": {wrong}"),
        }),
    }
}

/// A part of the schema where it is written out, without that it may be left out.
fn written(part: &Value) -> &Value {
    let name = part["$ref"].as_str();
    let name = name.and_then(|name| name.strip_prefix("#/$defs/"));
    match (name, part["anyOf"].get(0)) {
        (Some(name), _) => &SCHEMA["$defs"][name],
        (_, Some(first)) => written(first),
        _ => part,
    }
}

/// `number`, `integer`, `string`, `boolean`, `array` or `object`.
fn kind(part: &Value) -> &str {
    let kind = &part["type"];
    kind.as_str()
        .or(kind[0].as_str())
        .unwrap_or("one of several")
}

/// The fields of a table with their parts of the schema.
fn fields(part: &Value) -> impl Iterator<Item = (&String, &Value)> {
    part["properties"].as_object().into_iter().flatten()
}

/// The names of the fields that have to be there.
fn required(part: &Value) -> impl Iterator<Item = &str> {
    let names = part["required"].as_array().into_iter().flatten();
    names.filter_map(Value::as_str)
}

/// Of one of several: the field of a table of one field, or the text that stands alone.
fn names(part: &Value) -> impl Iterator<Item = (&str, &Value)> {
    let several = part["oneOf"].as_array().into_iter().flatten();
    several.filter_map(|one| match one["const"].as_str() {
        Some(text) => Some((text, one)),
        None => fields(one).next().map(|(name, _)| (name.as_str(), one)),
    })
}

fn entry(value: &Spanned<DeValue<'_>>, part: &Value, path: &[String]) -> Checked {
    let part = written(part);
    let at = value.span().start;
    let wrong = |said| Err((at, path.to_vec(), said));
    let fits = match (kind(part), value.get_ref()) {
        ("one of several", value) => return one_of(part, value, at, path),
        ("object", DeValue::Table(fields)) => return table(part, fields, at, path),
        ("array", DeValue::Array(values)) => {
            let count = part["minItems"].as_u64();
            if count.is_some_and(|count| count != values.len() as u64) {
                let numbers = match values.len() {
                    1 => "1 number",
                    count => &format!("{count} numbers"),
                };
                return wrong(format!("has {numbers}, it must be {}", example(part)));
            }
            let each = |(k, value): (usize, &Spanned<DeValue<'_>>)| {
                entry(value, &part["items"], &within(path, &k.to_string()))
            };
            return values.iter().enumerate().try_for_each(each);
        }
        ("number", DeValue::Float(_)) => true,
        ("number", DeValue::Integer(number)) => {
            i64::from_str_radix(number.as_str(), number.radix()).is_ok()
        }
        ("integer", DeValue::Integer(number)) => {
            let number = i64::from_str_radix(number.as_str(), number.radix());
            number.is_ok_and(|number| number >= 0)
        }
        ("string", DeValue::String(_)) | ("boolean", DeValue::Boolean(_)) => true,
        _ => false,
    };
    if fits {
        return Ok(());
    }
    let accepted = match (path, kind(part)) {
        ([name], "array") => format!("a list of tables, each under [[{name}]]"),
        ([name], "object") => format!("a table under [{name}]"),
        _ => accepted(part),
    };
    let (found, hint) = (found(value.get_ref()), hint(value.get_ref(), part));
    wrong(format!("is {found}, it must be {accepted}{hint}"))
}

/// How what was meant for a number is written as one.
fn hint(value: &DeValue<'_>, part: &Value) -> &'static str {
    match value {
        DeValue::String(text) if kind(part) == "number" && text.parse::<f64>().is_ok() => {
            ", without quotes"
        }
        DeValue::Integer(number) if kind(part) == "number" && number.as_str().len() > 18 => {
            ", this large with an exponent"
        }
        _ => "",
    }
}

fn table(part: &Value, values: &DeTable<'_>, at: usize, path: &[String]) -> Checked {
    for (name, _) in values {
        let name: &str = name.get_ref();
        if part["properties"][name].is_null() {
            let elsewhere: Vec<String> = fields(part)
                .flat_map(|(field, inner)| deeper(field, inner, name))
                .collect();
            let elsewhere = match elsewhere.as_slice() {
                [] => String::new(),
                places => format!(" here, but {}", places.join(" and ")),
            };
            let known: Vec<&str> = fields(part).map(|(name, _)| name.as_str()).collect();
            let at = values.get_key_value(name);
            let at = at.map_or(0, |(name, _)| name.span().start);
            let known = known.join(", ");
            let said = format!("there is no such field{elsewhere}; the fields are {known}");
            return Err((at, within(path, name), said));
        }
    }
    if let Some(name) = required(part).find(|&name| !values.contains_key(name)) {
        let field = &part["properties"][name];
        let said = format!(
            "{name} is missing, {}{}",
            accepted(written(field)),
            about(field)
        );
        return Err((at, path.to_vec(), said));
    }
    values.iter().try_for_each(|(name, value)| {
        let name: &str = name.get_ref();
        entry(value, &part["properties"][name], &within(path, name))
    })
}

/// What the schema says about a field.
fn about(field: &Value) -> String {
    let text = field["description"].as_str().unwrap_or_default();
    let words: Vec<&str> = text.trim_end_matches('.').split_whitespace().collect();
    let text = words.join(" ");
    let mut letters = text.chars();
    match letters.next() {
        Some(first) => format!(": {}{}", first.to_lowercase(), letters.as_str()),
        None => String::new(),
    }
}

fn one_of(part: &Value, value: &DeValue<'_>, at: usize, path: &[String]) -> Checked {
    let named = |name: &str| names(part).find(|(known, _)| *known == name);
    let wrong = |said| Err((at, path.to_vec(), said));
    match value {
        DeValue::String(text) => match named(text) {
            Some((_, one)) if one["const"].is_string() => return Ok(()),
            Some((_, one)) => {
                return wrong(format!("is \"{text}\" alone, it must be {}", example(one)));
            }
            None => {}
        },
        DeValue::Table(values) => {
            let keys: Vec<&str> = values
                .iter()
                .map(|(key, _)| key.get_ref().as_ref())
                .collect();
            let known: Vec<_> = keys.iter().filter_map(|key| named(key)).collect();
            match (keys.as_slice(), known.as_slice()) {
                ([_], [(_, one)]) if one["const"].is_string() => {
                    return wrong(format!("is a table, it must be {}", example(one)));
                }
                ([_], [(_, one)]) => return table(one, values, at, path),
                ([_, _, ..], [(_, one)]) => {
                    let keys = keys.join(" and ");
                    return wrong(format!("has {keys}, it must be {}", example(one)));
                }
                ([_, _, ..], [_, _, ..]) => {
                    let known: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
                    let known = known.join(" and ");
                    return wrong(format!("has {known}, only one of them may be there"));
                }
                ([name, ..], []) => {
                    let said = format!("there is no {name}, it must be {}", accepted(part));
                    return wrong(said);
                }
                _ => {}
            }
        }
        _ => {}
    }
    wrong(format!(
        "is {}, it must be {}",
        found(value),
        accepted(part)
    ))
}

/// Where further in a field of a name is.
fn deeper(path: &str, part: &Value, name: &str) -> Vec<String> {
    let part = written(part);
    let mut places = Vec::new();
    let several = part["oneOf"].as_array().into_iter().flatten();
    for (field, inner) in fields(part).chain(several.flat_map(fields)) {
        let path = format!("{path}.{field}");
        if field == name {
            places.push(path);
        } else {
            places.extend(deeper(&path, inner, name));
        }
    }
    places
}

fn within(path: &[String], name: &str) -> Vec<String> {
    let mut path = path.to_vec();
    path.push(name.to_owned());
    path
}

/// What a value is.
fn found(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) => format!("the text {text:?}"),
        DeValue::Integer(number) => format!("the number {number}"),
        DeValue::Float(number) => format!("the number {number}"),
        DeValue::Boolean(value) => value.to_string(),
        DeValue::Datetime(_) => "a date".to_owned(),
        DeValue::Array(_) => "a list".to_owned(),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

/// What a value must be.
fn accepted(part: &Value) -> String {
    match kind(part) {
        "number" => "a number".to_owned(),
        "integer" => "a whole number from 0 on".to_owned(),
        "string" => "a text in quotes".to_owned(),
        "boolean" => "true or false".to_owned(),
        "array" => match part["minItems"].as_u64() {
            Some(count) => format!("{count} numbers, {}", example(part)),
            None => format!("a list, {}", example(part)),
        },
        "object" => format!("a table, {}", example(part)),
        _ => {
            let several: Vec<String> = names(part).map(|(_, one)| example(one)).collect();
            format!("one of {}", several.join(", "))
        }
    }
}

/// How a value is written, with the fields that have to be there.
fn example(part: &Value) -> String {
    let part = written(part);
    match kind(part) {
        "number" => "number".to_owned(),
        "integer" => "whole number".to_owned(),
        "string" => format!("\"{}\"", part["const"].as_str().unwrap_or("text")),
        "boolean" => "true".to_owned(),
        "array" => match kind(written(&part["items"])) {
            "number" => "[x, y, z]".to_owned(),
            "integer" => "[i, j, k]".to_owned(),
            "one of several" => "[...]".to_owned(),
            _ => format!("[{}, ...]", example(&part["items"])),
        },
        "object" => {
            let fields: Vec<String> = required(part)
                .map(|name| format!("{name} = {}", example(&part["properties"][name])))
                .collect();
            match fields.as_slice() {
                [] => "{ ... }".to_owned(),
                fields => format!("{{ {} }}", fields.join(", ")),
            }
        }
        _ => "...".to_owned(),
    }
}

#[cfg(test)]
mod tests;
