//! The vectors as packages that others can depend on: an archive, a crate and a package for Python.
//!
//! All of them hold data only, each file of it packed by gzip, and are the same on every machine.

use std::io::{self, Write};

use flate2::{Compression, GzBuilder};
use hmac_sha256::Hash;

use super::TURNING;

/// A file by its path in a folder.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its path.
    pub path: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// The version of the packages, which is that of the program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

const LICENCES: [(&str, &str); 2] = [
    ("LICENSE-MIT", include_str!("../../../LICENSE-MIT")),
    ("LICENSE-APACHE", include_str!("../../../LICENSE-APACHE")),
];

/// The packages of the files of a folder, given in the order of their names: the `.json` files and
/// the README.
///
/// # Errors
///
/// None but those of writing to memory.
pub fn packages(folder: &[File]) -> io::Result<Vec<File>> {
    let mut files = archive(folder)?;
    files.extend(in_folder("crate", crate_files(folder)?));
    files.extend(in_folder("python", python_files(folder)?));
    Ok(files)
}

/// The archive of a folder, with the checksum of each file in it, and its own checksum.
fn archive(folder: &[File]) -> io::Result<Vec<File>> {
    let name = format!("tunnelproof-vectors-{VERSION}");
    let mut members = folder.to_vec();
    members.extend(licences());
    members.push(file("VERSION", format!("{VERSION}\n")));
    let sums = members
        .iter()
        .map(|member| sum(&member.path, &member.bytes));
    members.push(file("SHA256SUMS", sums.collect::<String>()));
    let mut tar = tar::Builder::new(Vec::new());
    for member in &members {
        let mut header = tar::Header::new_ustar();
        header.set_mode(0o644);
        header.set_size(member.bytes.len() as u64);
        tar.append_data(
            &mut header,
            format!("{name}/{}", member.path),
            &member.bytes[..],
        )?;
    }
    let path = format!("{name}.tar.gz");
    let bytes = gzip(&tar.into_inner()?)?;
    let sum = file(&format!("{path}.sha256"), sum(&path, &bytes));
    Ok(vec![File { path, bytes }, sum])
}

fn crate_files(folder: &[File]) -> io::Result<Vec<File>> {
    let mut files = data("data", folder)?;
    let entries = files.iter().map(|file| {
        let name = file.path.trim_start_matches("data/").trim_end_matches(".gz");
        format!(
            "    File {{\n        name: \"{name}\",\n        gzip: include_bytes!(\"../{}\"),\n    }},\n",
            file.path
        )
    });
    let in_folder = |entry: &String| entry.contains(&format!("\"{TURNING}/"));
    let (turning, others): (Vec<_>, Vec<_>) = entries.partition(in_folder);
    let library = include_str!("lib.rs.in")
        .replace("ENTRIES\n", &others.concat())
        .replace("TURNS\n", &turning.concat());
    files.push(file("src/lib.rs", library));
    files.push(file("Cargo.toml", versioned(include_str!("Cargo.toml.in"))));
    files.push(file("README.md", include_str!("crate.md").to_owned()));
    files.extend(licences());
    Ok(files)
}

fn python_files(folder: &[File]) -> io::Result<Vec<File>> {
    let module = "tunnelproof_vectors";
    let mut files = data(&format!("{module}/data"), folder)?;
    let source = versioned(include_str!("module.py.in"));
    files.push(file(&format!("{module}/__init__.py"), source));
    files.push(file(&format!("{module}/py.typed"), String::new()));
    files.push(file(
        "pyproject.toml",
        versioned(include_str!("pyproject.toml.in")),
    ));
    files.push(file("README.md", include_str!("python.md").to_owned()));
    files.extend(licences());
    Ok(files)
}

/// The `.json` files, packed.
fn data(to: &str, folder: &[File]) -> io::Result<Vec<File>> {
    let json = folder.iter().filter(|file| file.path.ends_with(".json"));
    json.map(|file| {
        Ok(File {
            path: format!("{to}/{}.gz", file.path),
            bytes: gzip(&file.bytes)?,
        })
    })
    .collect()
}

fn versioned(text: &str) -> String {
    text.replace("VERSION", VERSION)
}

fn licences() -> impl Iterator<Item = File> {
    LICENCES
        .into_iter()
        .map(|(name, text)| file(name, text.to_owned()))
}

fn file(path: &str, text: String) -> File {
    File {
        path: path.to_owned(),
        bytes: text.into_bytes(),
    }
}

fn in_folder(folder: &str, files: Vec<File>) -> impl Iterator<Item = File> {
    let moved = move |file: File| File {
        path: format!("{folder}/{}", file.path),
        ..file
    };
    files.into_iter().map(moved).collect::<Vec<_>>().into_iter()
}

/// A line as `sha256sum` writes it.
fn sum(path: &str, bytes: &[u8]) -> String {
    let hash = Hash::hash(bytes);
    let hash: String = hash.iter().map(|byte| format!("{byte:02x}")).collect();
    format!("{hash}  {path}\n")
}

/// Packed without a time and a name, so that equal bytes give equal bytes.
fn gzip(bytes: &[u8]) -> io::Result<Vec<u8>> {
    let mut encoder = GzBuilder::new()
        .mtime(0)
        .write(Vec::new(), Compression::best());
    encoder.write_all(bytes)?;
    encoder.finish()
}

#[cfg(test)]
mod tests {
    use std::io::Read;

    use super::*;

    fn unpacked(bytes: &[u8]) -> Vec<u8> {
        let mut unpacked = Vec::new();
        let mut decoder = flate2::read::GzDecoder::new(bytes);
        decoder.read_to_end(&mut unpacked).unwrap();
        unpacked
    }

    #[test]
    fn packages_hold_every_file_of_the_folder() {
        let folder = [
            "README.md",
            "a.json",
            "b.json",
            "schema.json",
            "turning/c.json",
        ];
        let folder = folder.map(|name| file(name, format!("text of {name}")));
        let packages = packages(&folder).unwrap();
        assert_eq!(packages, super::packages(&folder).unwrap());
        let find = |path: &str| {
            &packages
                .iter()
                .find(|file| file.path == path)
                .unwrap()
                .bytes
        };
        let name = format!("tunnelproof-vectors-{VERSION}");
        let archive = find(&format!("{name}.tar.gz"));
        let tar = unpacked(archive);
        let mut members = tar::Archive::new(&tar[..]);
        let members = members.entries().unwrap().map(|entry| {
            let mut entry = entry.unwrap();
            let path = entry.path().unwrap().display().to_string();
            let mut text = String::new();
            entry.read_to_string(&mut text).unwrap();
            (path, text)
        });
        let members: Vec<_> = members.collect();
        for file in &folder {
            let text = String::from_utf8(file.bytes.clone()).unwrap();
            assert!(members.contains(&(format!("{name}/{}", file.path), text)));
        }
        let (path, sums) = members.last().unwrap();
        assert_eq!(*path, format!("{name}/SHA256SUMS"));
        // Of "text of a.json", by coreutils.
        assert!(sums.contains(SUM_OF_A), "{sums}");
        for path in [
            "crate/data/a.json.gz",
            "python/tunnelproof_vectors/data/a.json.gz",
        ] {
            assert_eq!(unpacked(find(path)), b"text of a.json");
        }
        let library = String::from_utf8(find("crate/src/lib.rs").clone()).unwrap();
        assert_eq!(library.matches("include_bytes!(\"../data/").count(), 4);
        let turning = library.split_once("TURNING: &[File]").unwrap().1;
        assert_eq!(turning.matches("include_bytes!").count(), 1);
        assert!(turning.contains("name: \"turning/c.json\""), "{library}");
    }

    const SUM_OF_A: &str =
        "1db66ad915864374b2ac0c497605b78c02d15db8cefdd3c4b85d6de92586081b  a.json\n";
}
