//! The page: everything in one file, so that it works from any place and without network.

use std::io::{self, Write as _};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use flate2::Compression;
use flate2::write::GzEncoder;

use crate::gallery;

const TEMPLATE: &str = include_str!("../page/index.html");

/// What stands in the template, and in its place.
const PARTS: [(&str, &str); 9] = [
    ("/* style.css */", include_str!("../page/style.css")),
    ("/* engine.js */", include_str!("../page/engine.js")),
    ("/* worker.js */", include_str!("../page/worker.js")),
    ("/* state.js */", include_str!("../page/state.js")),
    ("/* view.js */", include_str!("../page/view.js")),
    ("/* charts.js */", include_str!("../page/charts.js")),
    ("/* answers.js */", include_str!("../page/answers.js")),
    ("/* controls.js */", include_str!("../page/controls.js")),
    ("/* page.js */", include_str!("../page/page.js")),
];

/// The page with this module in it.
pub(crate) fn write(module: &[u8]) -> Result<String, gallery::GalleryError> {
    let mut page = TEMPLATE.to_owned();
    for (mark, text) in PARTS {
        page = page.replacen(mark, text, 1);
    }
    // No text in it may end the element.
    let gallery = gallery::all()?.to_string().replace('<', "\\u003c");
    page = page.replacen("/* gallery.json */", &gallery, 1);
    Ok(page.replacen("/* module.wasm.gz */", &packed(module)?, 1))
}

/// The module packed by gzip, as text.
fn packed(module: &[u8]) -> io::Result<String> {
    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    packer.write_all(module)?;
    Ok(STANDARD.encode(packer.finish()?))
}
