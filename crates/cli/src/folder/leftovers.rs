//! What a program that was killed while it wrote a folder leaves beside it.
//!
//! ```text
//! .closeranks-new-XXXXXX-NAME          files on their way to NAME
//! .closeranks-old-XXXXXX-NAME/folder   what was at NAME, until the new one is in place
//! ```

use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use tempfile::TempDir;

use super::parent;
use crate::output;

/// Begins the name of a folder that is being written.
pub(super) const NEW: &str = ".closeranks-new-";
/// Begins the name of the folder that holds what is being replaced.
pub(super) const OLD: &str = ".closeranks-old-";
/// Begins the name of a folder that is only made to see whether it can be.
pub(super) const TRIED: &str = ".closeranks-try-";
/// Name in it of what is being replaced.
pub(super) const ASIDE: &str = "folder";
/// Letters and digits that tell two programs apart.
const RANDOM: usize = 6;

/// A new folder beside `target`, gone when it is dropped.
pub(super) fn beside(target: &Path, prefix: &str) -> io::Result<TempDir> {
    let suffix = suffix(target);
    let mut builder = tempfile::Builder::new();
    builder.prefix(prefix).rand_bytes(RANDOM).suffix(&suffix);
    builder.tempdir_in(parent(target))
}

fn suffix(target: &Path) -> OsString {
    let mut suffix = OsString::from("-");
    suffix.push(target.file_name().unwrap_or_default());
    suffix
}

/// Where results stay that could not be put at `target`: under a name that nobody cleans up.
pub(super) fn kept(fresh: &Path, target: &Path) -> PathBuf {
    let mut name = target.file_name().unwrap_or_default().to_owned();
    name.push(".kept-");
    let fresh = fresh.file_name().and_then(|name| name.to_str()).unwrap_or_default();
    name.push(fresh.get(NEW.len()..NEW.len() + RANDOM).unwrap_or("results"));
    parent(target).join(name)
}

/// Removes what a killed program left beside `target`, after putting back what it had moved away. The caller holds the lock
/// of the folder above, so nobody begins to write; who does it already holds the lock of its new folder, which stays.
pub(super) fn clean(target: &Path) -> Result<()> {
    for old in of(target, OLD)? {
        let aside = old.join(ASIDE);
        if fs::symlink_metadata(target).is_err() && aside.is_dir() {
            fs::rename(&aside, target).with_context(|| {
                format!("cannot put `{}` back to `{}`", aside.display(), target.display())
            })?;
        }
        remove(&old);
    }
    of(target, NEW)?.iter().filter(|new| !is_held(new)).for_each(|new| remove(new));
    Ok(())
}

/// True if a program that lives writes to `folder`.
fn is_held(folder: &Path) -> bool {
    File::open(folder).is_ok_and(|file| matches!(file.try_lock(), Err(TryLockError::WouldBlock)))
}

/// What cannot be removed is in nobody's way.
fn remove(folder: &Path) {
    if let Err(error) = fs::remove_dir_all(folder) {
        output::note(&format!("cannot remove what a killed run left: `{}`: {error}", folder.display()));
    }
}

/// Folders that programs made for `target` under `prefix`.
fn of(target: &Path, prefix: &str) -> Result<Vec<PathBuf>> {
    let suffix = suffix(target);
    let is_one = |name: &OsString| {
        let inner = name.as_encoded_bytes().strip_prefix(prefix.as_bytes());
        let inner = inner.and_then(|rest| rest.strip_suffix(suffix.as_encoded_bytes()));
        inner.is_some_and(|random| random.len() == RANDOM && random.iter().all(u8::is_ascii_alphanumeric))
    };
    let folder = parent(target);
    let entries =
        fs::read_dir(folder).with_context(|| format!("cannot read the folder `{}`", folder.display()))?;
    let names = entries.filter_map(|entry| Some(entry.ok()?.file_name()));
    Ok(names.filter(is_one).map(|name| folder.join(name)).filter(|path| path.is_dir()).collect())
}
