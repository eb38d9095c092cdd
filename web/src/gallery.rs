//! The queries that the page offers: the figures of the thesis, the witnesses of its errata, public
//! bug reports, and finds in the families. All but the first group are read from `vectors/`.

use std::{fs, io};

use serde_json::{Value, json};

/// Why there is no gallery.
#[derive(Debug, thiserror::Error)]
pub(crate) enum GalleryError {
    /// A file of vectors cannot be read.
    #[error("{0}: {1}")]
    File(String, io::Error),
    /// It is not JSON.
    #[error("{0}: {1}")]
    Json(String, serde_json::Error),
    /// The page cannot be put together.
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// The families whose smallest tunnels and false hits are shown.
const FINDS: [&str; 8] = [
    "lattice",
    "near_coplanar",
    "near_parallel",
    "point_on_line",
    "temporarily_parallel",
    "temporarily_point",
    "scales",
    "joint",
];

/// Groups with titles, and entries with a title and a query.
pub(crate) fn all() -> Result<Value, GalleryError> {
    let group = |title: &str, entries: Vec<Value>| json!({ "title": title, "entries": entries });
    let finds = FINDS
        .map(finds)
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    Ok(json!([
        group("Start here", openers()?),
        group("Finds, shrunk to the smallest", finds.concat()),
        group("Public bug reports, rebuilt", entries("reports", |_| true)?),
        group(
            "Errors of the thesis' text (slips are repaired here)",
            entries("errata", |id| !id.ends_with("/shrunk"))?
        ),
        group("Figures of the thesis", entries("figures", |_| true)?),
    ]))
}

/// The smallest queries of a family on which a method fails.
fn finds(family: &str) -> Result<Vec<Value>, GalleryError> {
    let shown = ["thesis/tunnel", "thesis/false-hit", "additive/tunnel"];
    entries(family, |id| {
        let kind = id.split_once('/').map(|(_, kind)| kind);
        kind.is_some_and(|kind| shown.contains(&kind))
    })
}

/// The vectors of a file whose names are chosen.
fn entries(file: &str, is_chosen: impl Fn(&str) -> bool) -> Result<Vec<Value>, GalleryError> {
    let path = format!("{}/../vectors/{file}.json", env!("CARGO_MANIFEST_DIR"));
    let text =
        fs::read_to_string(&path).map_err(|error| GalleryError::File(path.clone(), error))?;
    let file: Value =
        serde_json::from_str(&text).map_err(|error| GalleryError::Json(path, error))?;
    let vectors = file["vectors"].as_array().into_iter().flatten();
    let chosen = vectors.filter(|vector| is_chosen(vector["id"].as_str().unwrap_or_default()));
    Ok(chosen.map(entry).collect())
}

fn entry(vector: &Value) -> Value {
    let id = vector["id"].as_str().unwrap_or_default();
    json!({
        "id": id,
        "title": vector["comment"],
        "query": {
            "kind": vector["kind"],
            "points": vector["points_hex"],
            "radius": vector["radius_hex"],
        },
    })
}

/// Queries that show what there is.
fn openers() -> Result<Vec<Value>, GalleryError> {
    let text = include_str!("../page/openers.json");
    serde_json::from_str(text).map_err(|error| GalleryError::Json("openers.json".into(), error))
}
