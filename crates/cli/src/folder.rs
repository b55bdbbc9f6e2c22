//! Output folders: written beside, then renamed, so that nothing half-written is left behind and nothing of others is lost.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

/// Names the files that closeranks wrote to a folder, so that a later run may replace them.
const MANIFEST: &str = ".closeranks";

/// Says which sweep a folder holds.
pub(crate) const SWEEP: &str = "sweep.json";

/// Files to be written together.
#[derive(Debug)]
pub(crate) struct Folder {
    target: PathBuf,
    files: Vec<(String, Vec<u8>)>,
}

impl Folder {
    /// Prepares to write `target`; refuses at once if that would lose anything or cannot work.
    pub(crate) fn new(target: &Path) -> Result<Self> {
        check(target)?;
        Ok(Self { target: target.to_path_buf(), files: Vec::new() })
    }

    /// Adds a file.
    pub(crate) fn add(&mut self, name: impl Into<String>, bytes: impl Into<Vec<u8>>) {
        self.files.push((name.into(), bytes.into()));
    }

    /// Writes everything to a folder beside the target and renames it into place.
    pub(crate) fn write(self) -> Result<()> {
        let parent = parent(&self.target);
        let fresh = tempfile::Builder::new().prefix(".closeranks-").tempdir_in(parent);
        let fresh = fresh.with_context(|| format!("cannot write to the folder `{}`", parent.display()))?;
        let names: Vec<&str> = self.files.iter().map(|(name, _)| name.as_str()).collect();
        let manifest = (MANIFEST.to_owned(), names.join("\n").into_bytes());
        for (name, bytes) in self.files.iter().chain([&manifest]) {
            let path = fresh.path().join(name);
            fs::write(&path, bytes).with_context(|| format!("cannot write `{}`", path.display()))?;
        }
        check(&self.target)?;
        swap(&fresh.keep(), &self.target)
    }
}

/// The folder that `target` lies in.
pub(crate) fn parent(target: &Path) -> &Path {
    target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Puts `fresh` where `target` is; what was there goes only after the new one is in place.
fn swap(fresh: &Path, target: &Path) -> Result<()> {
    let failed =
        || format!("cannot put the results at `{}`; they are in `{}`", target.display(), fresh.display());
    readable(fresh).with_context(failed)?;
    if fs::symlink_metadata(target).is_err() {
        return fs::rename(fresh, target).with_context(failed);
    }
    let old = tempfile::Builder::new()
        .prefix(".closeranks-old-")
        .tempdir_in(parent(target))
        .with_context(failed)?;
    let aside = old.path().join("folder");
    fs::rename(target, &aside).with_context(failed)?;
    if let Err(error) = fs::rename(fresh, target) {
        fs::rename(&aside, target).with_context(failed)?;
        return Err(error).with_context(failed);
    }
    Ok(())
}

/// Temporary folders are private; results are for everybody whom the umask allows.
#[cfg(unix)]
fn readable(folder: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt as _;
    fs::set_permissions(folder, fs::Permissions::from_mode(0o755))
}

#[cfg(not(unix))]
fn readable(_folder: &Path) -> std::io::Result<()> {
    Ok(())
}

/// Refuses a target that is a file, lies in no folder, or holds anything that closeranks did not write.
fn check(target: &Path) -> Result<()> {
    if !exists(target)? {
        return Ok(());
    }
    let shown = target.display();
    if target.join(SWEEP).exists() {
        bail!("`{shown}` holds a sweep, which nothing else replaces; allowed is a new name");
    }
    let manifest = fs::read_to_string(target.join(MANIFEST)).unwrap_or_default();
    let ours: BTreeSet<&str> = manifest.lines().chain([MANIFEST]).collect();
    for entry in fs::read_dir(target).with_context(|| format!("cannot read the folder `{shown}`"))? {
        let name = entry?.file_name();
        if !name.to_str().is_some_and(|name| ours.contains(name)) {
            bail!(
                "`{shown}` holds `{}`, which closeranks did not write; allowed is a new name or a folder that closeranks wrote",
                Path::new(&name).display()
            );
        }
    }
    Ok(())
}

/// Whether there is such a folder; refuses names that cannot be one.
pub(crate) fn exists(target: &Path) -> Result<bool> {
    let shown = target.display();
    if target.file_name().is_none() {
        bail!("`{shown}` cannot be an output folder: allowed is the name of a folder of its own");
    }
    if !parent(target).is_dir() {
        bail!("`{shown}` cannot be an output folder: `{}` is not a folder", parent(target).display());
    }
    if fs::symlink_metadata(target).is_err() {
        return Ok(false);
    }
    if !target.is_dir() || target.is_symlink() {
        bail!(
            "`{shown}` exists and is not a folder; allowed is a new name or a folder that closeranks wrote"
        );
    }
    Ok(true)
}
