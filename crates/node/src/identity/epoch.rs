//! The number of starts of a robot. It makes every message of an earlier start older than all of a later one, so that none of
//! them can be played again, and no robot signs two messages with one number.

use std::fs::{self, File};
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

/// Why there is no new epoch.
#[derive(Debug, thiserror::Error)]
pub enum EpochError {
    /// The file cannot be read or written.
    #[error("{path}: {error}")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why not.
        error: io::Error,
    },
    /// The file does not hold a number. Nothing is guessed: with a number that was used before, the robot would seem
    /// two-faced to others.
    #[error("{path} holds `{found}`, must be a number of starts from 0 to 18446744073709551614")]
    Form {
        /// Which file.
        path: PathBuf,
        /// The beginning of what is there.
        found: String,
    },
}

/// Counts a start: the number in the file plus one, on the disk before this returns. Without a file it is 1.
pub fn next(path: &Path) -> Result<u64, EpochError> {
    let file = |error| EpochError::File { path: path.to_owned(), error };
    let last = match fs::read_to_string(path) {
        Ok(text) => text.trim().parse::<u64>().ok().filter(|last| *last < u64::MAX).ok_or_else(|| {
            EpochError::Form { path: path.to_owned(), found: text.trim().chars().take(40).collect() }
        })?,
        Err(error) if error.kind() == io::ErrorKind::NotFound => 0,
        Err(error) => return Err(file(error)),
    };
    store(path, last + 1).map_err(file)?;
    Ok(last + 1)
}

/// Writes the number whole or not at all.
fn store(path: &Path, epoch: u64) -> io::Result<()> {
    let beside = path.with_extension("epoch-new");
    let mut file = File::create(&beside)?;
    file.write_all(format!("{epoch}\n").as_bytes())?;
    file.sync_all()?;
    fs::rename(&beside, path)?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    File::open(folder.unwrap_or(Path::new(".")))?.sync_all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_start_has_a_greater_number() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.epoch");
        assert_eq!([(); 3].map(|()| next(&path).unwrap()), [1, 2, 3]);
    }

    #[test]
    fn nothing_is_guessed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.epoch");
        for wrong in ["", "-1", "one", "18446744073709551615"] {
            fs::write(&path, wrong).unwrap();
            assert!(matches!(next(&path), Err(EpochError::Form { .. })), "{wrong}");
        }
    }
}
