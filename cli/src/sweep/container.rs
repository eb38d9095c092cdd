//! Files that say what they are: a header, a payload and a checksum, written whole or not at all.
//!
//! | bytes | what |
//! | --- | --- |
//! | 8 | `tnlproof` |
//! | 4 | the format of header and payload, little endian like every number |
//! | 32 | the key: a hash of what the payload belongs to |
//! | 8 | the length of the payload |
//! | | the payload |
//! | 32 | SHA-256 of all bytes before |

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use hmac_sha256::Hash;
use tempfile::NamedTempFile;

/// A hash of what a payload belongs to.
pub(super) type Key = [u8; 32];

const MAGIC: &[u8; 8] = b"tnlproof";
/// To be raised whenever a payload is laid out otherwise or means something else.
const FORMAT: u32 = 1;
const HEADER: usize = 8 + 4 + 32 + 8;
const CHECKSUM: usize = 32;

/// Why a file is not what it should be.
#[derive(Debug, thiserror::Error)]
pub enum Damage {
    /// It begins otherwise.
    #[error("is not a file of this program")]
    Foreign,
    /// It was written in another format.
    #[error("has format {0}, not {FORMAT}")]
    Format(u32),
    /// It belongs to something else.
    #[error("belongs to another corpus")]
    Key,
    /// It is shorter or longer than it says.
    #[error("has {actual} bytes instead of {stated}")]
    Length {
        /// What there is.
        actual: u64,
        /// What its header says; that of the shortest file if it has no whole header.
        stated: u64,
    },
    /// A byte of it has changed.
    #[error("does not have the checksum that it states")]
    Checksum,
    /// Its payload is not what is written.
    #[error("holds something that is never written: {0}")]
    Payload(String),
    /// It cannot be read.
    #[error("cannot be read: {0}")]
    Unreadable(#[from] io::Error),
}

/// Writes a file, with its folder; one of that name is replaced.
pub(super) fn write(path: &Path, key: &Key, payload: &[u8]) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    fs::create_dir_all(folder)?;
    let mut bytes = Vec::with_capacity(HEADER + payload.len() + CHECKSUM);
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&FORMAT.to_le_bytes());
    bytes.extend_from_slice(key);
    bytes.extend_from_slice(&(payload.len() as u64).to_le_bytes());
    bytes.extend_from_slice(payload);
    bytes.extend_from_slice(&Hash::hash(&bytes));
    let mut file = NamedTempFile::new_in(folder)?;
    file.write_all(&bytes)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

/// The payload of a file; `None` if there is no such file.
pub(super) fn read(path: &Path, key: &Key) -> Result<Option<Vec<u8>>, Damage> {
    let mut bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        Err(error) => return Err(error.into()),
    };
    check(&bytes, key)?;
    bytes.truncate(bytes.len() - CHECKSUM);
    bytes.drain(..HEADER);
    Ok(Some(bytes))
}

fn check(bytes: &[u8], key: &Key) -> Result<(), Damage> {
    let actual = bytes.len() as u64;
    let length = |payload: u64| payload.saturating_add((HEADER + CHECKSUM) as u64);
    if !bytes.starts_with(MAGIC) {
        return Err(Damage::Foreign);
    }
    let Some((header, _)) = bytes.split_at_checked(HEADER) else {
        let stated = length(0);
        return Err(Damage::Length { actual, stated });
    };
    let format = u32::from_le_bytes(part(header, 8));
    if format != FORMAT {
        return Err(Damage::Format(format));
    }
    if part::<32>(header, 12) != *key {
        return Err(Damage::Key);
    }
    let stated = length(u64::from_le_bytes(part(header, 44)));
    if actual != stated {
        return Err(Damage::Length { actual, stated });
    }
    let (content, checksum) = bytes.split_at(bytes.len() - CHECKSUM);
    if Hash::hash(content)[..] != *checksum {
        return Err(Damage::Checksum);
    }
    Ok(())
}

/// The `N` bytes from `start` on; there are as many.
fn part<const N: usize>(bytes: &[u8], start: usize) -> [u8; N] {
    let mut part = [0; N];
    part.copy_from_slice(&bytes[start..start + N]);
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEY: Key = [7; 32];
    const PAYLOAD: &[u8] = b"what was found";

    /// What is said of the file after its bytes were changed.
    fn after(change: impl Fn(&mut Vec<u8>)) -> Result<Option<Vec<u8>>, Damage> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deep/file.bin");
        write(&path, &KEY, PAYLOAD).unwrap();
        let mut bytes = fs::read(&path).unwrap();
        change(&mut bytes);
        fs::write(&path, bytes).unwrap();
        read(&path, &KEY)
    }

    #[test]
    fn container_read_gives_what_was_written() {
        assert_eq!(after(|_| {}).unwrap().as_deref(), Some(PAYLOAD));
        let folder = tempfile::tempdir().unwrap();
        assert!(read(&folder.path().join("none"), &KEY).unwrap().is_none());
    }

    #[test]
    fn container_read_notices_every_changed_byte() {
        let length = HEADER + PAYLOAD.len() + CHECKSUM;
        for index in 0..length {
            for bit in 0..8 {
                assert!(after(|bytes| bytes[index] ^= 1 << bit).is_err(), "{index}");
            }
        }
    }

    #[test]
    fn container_read_notices_every_missing_or_surplus_byte() {
        for kept in 0..HEADER + PAYLOAD.len() + CHECKSUM {
            assert!(after(|bytes| bytes.truncate(kept)).is_err(), "{kept}");
        }
        let surplus = after(|bytes| bytes.push(0));
        assert!(matches!(surplus, Err(Damage::Length { .. })), "{surplus:?}");
    }

    #[test]
    fn container_read_says_what_is_wrong() {
        let foreign = after(|bytes| bytes[0] = b'x');
        assert!(matches!(foreign, Err(Damage::Foreign)), "{foreign:?}");
        let format = after(|bytes| bytes[8] = 99);
        assert!(matches!(format, Err(Damage::Format(99))), "{format:?}");
        let key = after(|bytes| bytes[12] = 0);
        assert!(matches!(key, Err(Damage::Key)), "{key:?}");
        let flipped = after(|bytes| bytes[HEADER] ^= 1);
        assert!(matches!(flipped, Err(Damage::Checksum)), "{flipped:?}");
    }
}
