//! Files that are packed: `.gz` by gzip, `.zst` by zstd, with the feature `packed`. Read as they
//! come, in bounded memory.

use std::io::{self, BufRead, BufReader, Read};

#[cfg(feature = "packed")]
mod frames;

/// How a file is packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Packing {
    None,
    Gzip,
    Zstd,
}

impl Packing {
    /// The packing of a file, by its last extension, and its path without that.
    pub(super) fn of_path(path: &str) -> (Self, &str) {
        let lower = path.to_ascii_lowercase();
        for (extension, packing) in [(".gz", Packing::Gzip), (".zst", Packing::Zstd)] {
            if lower.ends_with(extension) {
                return (packing, &path[..path.len() - extension.len()]);
            }
        }
        (Packing::None, path)
    }

    /// What is packed in the file.
    ///
    /// # Errors
    ///
    /// A packed file without the feature `packed`.
    pub(super) fn unpack(
        self,
        file: impl Read + Send + 'static,
    ) -> io::Result<Box<dyn BufRead + Send>> {
        let file = BufReader::new(file);
        Ok(match self {
            Packing::None => Box::new(file),
            #[cfg(feature = "packed")]
            Packing::Gzip => Box::new(BufReader::new(flate2::bufread::MultiGzDecoder::new(file))),
            #[cfg(feature = "packed")]
            Packing::Zstd => Box::new(BufReader::new(frames::Frames::Between(file))),
            #[cfg(not(feature = "packed"))]
            Packing::Gzip | Packing::Zstd => {
                let reason = "packed files need the feature `packed` of tunnelproof-reference";
                return Err(io::Error::new(io::ErrorKind::Unsupported, reason));
            }
        })
    }
}

#[cfg(feature = "packed")]
#[cfg(test)]
mod tests {
    use std::io::Write;

    use ruzstd::encoding::{CompressionLevel, compress_to_vec};

    use super::*;

    fn text() -> String {
        (0..50_000).map(|n| format!("line {n}\n")).collect()
    }

    fn unpacked(packing: Packing, bytes: Vec<u8>) -> io::Result<String> {
        let mut text = String::new();
        let mut reader = packing.unpack(io::Cursor::new(bytes))?;
        reader.read_to_string(&mut text).map(|_| text)
    }

    fn gzip(text: &str) -> Vec<u8> {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder.write_all(text.as_bytes()).unwrap();
        encoder.finish().unwrap()
    }

    fn zstd(text: &str) -> Vec<u8> {
        compress_to_vec(text.as_bytes(), CompressionLevel::Fastest)
    }

    #[test]
    fn unpack_gives_what_was_packed_in_one_part_or_more() {
        let text = text();
        let (first, second) = text.split_at(text.len() / 3);
        for (packing, pack) in [
            (Packing::Gzip, gzip as fn(&str) -> Vec<u8>),
            (Packing::Zstd, zstd),
        ] {
            assert_eq!(unpacked(packing, pack(&text)).unwrap(), text);
            let both = [pack(first), pack(second)].concat();
            assert_eq!(unpacked(packing, both).unwrap(), text);
        }
    }

    #[test]
    fn unpack_of_a_file_that_is_cut_off_or_broken_fails() {
        for (packing, bytes) in [
            (Packing::Gzip, gzip(&text())),
            (Packing::Zstd, zstd(&text())),
        ] {
            assert!(unpacked(packing, bytes[..bytes.len() / 2].to_vec()).is_err());
            assert!(unpacked(packing, b"line 0\n".to_vec()).is_err());
        }
    }

    #[test]
    fn packing_is_that_of_the_last_extension() {
        assert_eq!(
            Packing::of_path("a/b.jsonl.ZST"),
            (Packing::Zstd, "a/b.jsonl")
        );
        assert_eq!(Packing::of_path("b.csv.gz"), (Packing::Gzip, "b.csv"));
        assert_eq!(Packing::of_path("b.gz.csv"), (Packing::None, "b.gz.csv"));
    }
}
