//! Output folders: written beside, then renamed, so that nothing half-written is left behind and nothing of others is lost.

mod leftovers;

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use closeranks_sweep::store::SWEEP;
use tempfile::TempDir;

use crate::invocation;

/// Names the command that wrote a folder and the files it wrote, so that the same command may replace them.
const MANIFEST: &str = ".closeranks";

/// What the first line of the manifest begins with.
const WRITTEN_BY: &str = "# ";

/// Files to be written together.
#[derive(Debug)]
pub(crate) struct Folder {
    target: PathBuf,
    files: Vec<(String, Vec<u8>)>,
    /// Names of files that are written bit by bit.
    growing: Vec<String>,
    fresh: Option<Fresh>,
}

/// The folder beside the target, on its way to it.
#[derive(Debug)]
struct Fresh {
    folder: TempDir,
    /// Held locked, so that nobody takes it for leftovers; the system lets go of it when the program ends in any way.
    _lock: Option<File>,
}

impl Folder {
    /// Prepares to write `target`; refuses at once if that would lose anything or cannot work.
    pub(crate) fn new(target: &Path) -> Result<Self> {
        let there = exists(target)?;
        let target = if there && target.is_symlink() {
            fs::canonicalize(target).with_context(|| format!("cannot follow `{}`", target.display()))?
        } else {
            target.to_path_buf()
        };
        if let Some(_lock) = lock(parent(&target)) {
            leftovers::clean(&target)?;
        }
        check(&target)?;
        try_writing(&target)?;
        Ok(Self { target, files: Vec::new(), growing: Vec::new(), fresh: None })
    }

    /// Begins a file that is written while a run goes on.
    pub(crate) fn file(&mut self, name: &str) -> Result<File> {
        let path = self.fresh()?.join(name);
        self.growing.push(name.to_owned());
        File::create(&path).with_context(|| format!("cannot write `{}`", path.display()))
    }

    /// True if a file of this name was begun.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.growing.iter().any(|known| known == name)
    }

    /// Adds a file.
    pub(crate) fn add(&mut self, name: impl Into<String>, bytes: impl Into<Vec<u8>>) {
        self.files.push((name.into(), bytes.into()));
    }

    /// The folder beside the target, made when it is first needed.
    fn fresh(&mut self) -> Result<PathBuf> {
        let parent = parent(&self.target);
        let cannot = || format!("cannot write to the folder `{}`", parent.display());
        if self.fresh.is_none() {
            fs::create_dir_all(parent).with_context(cannot)?;
            let _lock = lock(parent); // so that nobody takes it for leftovers before it is locked itself
            let folder = leftovers::beside(&self.target, leftovers::NEW).with_context(cannot)?;
            let held = lock(folder.path());
            self.fresh = Some(Fresh { folder, _lock: held });
        }
        let path = self.fresh.as_ref().map(|fresh| fresh.folder.path().to_owned());
        path.with_context(cannot)
    }

    /// Writes everything else to a folder beside the target and renames it into place.
    pub(crate) fn write(mut self) -> Result<()> {
        let fresh = self.fresh()?;
        for (name, bytes) in self.files.iter().chain([&self.manifest()]) {
            let path = fresh.join(name);
            fs::write(&path, bytes).with_context(|| format!("cannot write `{}`", path.display()))?;
        }
        let _lock = lock(parent(&self.target));
        check(&self.target)?;
        let Some(Fresh { folder, _lock: held }) = self.fresh else { return Ok(()) };
        let swapped = swap(&folder.keep(), &self.target);
        drop(held);
        swapped
    }

    fn manifest(&self) -> (String, Vec<u8>) {
        let mut lines = vec![format!("{WRITTEN_BY}{}", invocation::name())];
        lines.extend(self.growing.iter().chain(self.files.iter().map(|(name, _)| name)).cloned());
        (MANIFEST.to_owned(), lines.join("\n").into_bytes())
    }
}

/// The folder that `target` lies in.
pub(crate) fn parent(target: &Path) -> &Path {
    target.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Fails if nothing can be written beside `target`: better before a long run than after it.
fn try_writing(target: &Path) -> Result<()> {
    let above = std::path::absolute(target)?;
    let there = above.ancestors().skip(1).find(|above| above.is_dir()).unwrap_or(Path::new("."));
    let tried = tempfile::Builder::new().prefix(leftovers::TRIED).tempdir_in(there);
    tried.with_context(|| format!("cannot write to the folder `{}`", there.display()))?;
    Ok(())
}

/// Locks a folder against other programs of ours that put results into it, until the file is dropped. None where the system
/// cannot lock folders: then leftovers stay.
fn lock(folder: &Path) -> Option<File> {
    let file = File::open(folder).ok()?;
    file.lock().ok()?;
    Some(file)
}

/// Puts `fresh` where `target` is; what was there goes only after the new one is in place.
fn swap(fresh: &Path, target: &Path) -> Result<()> {
    let kept = leftovers::kept(fresh, target);
    let failed =
        || format!("cannot put the results at `{}`; they are in `{}`", target.display(), kept.display());
    let moved = readable(fresh).and_then(|()| exchange(fresh, target));
    if moved.is_err() {
        fs::rename(fresh, &kept).with_context(failed)?;
    }
    moved.with_context(failed)
}

fn exchange(fresh: &Path, target: &Path) -> std::io::Result<()> {
    if fs::symlink_metadata(target).is_err() {
        return fs::rename(fresh, target);
    }
    let old = leftovers::beside(target, leftovers::OLD)?;
    let aside = old.path().join(leftovers::ASIDE);
    fs::rename(target, &aside)?;
    if let Err(error) = fs::rename(fresh, target) {
        fs::rename(&aside, target)?;
        return Err(error);
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

/// Refuses a target that holds anything that closeranks did not write, or that another command wrote.
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
    let mut is_empty = true;
    for entry in fs::read_dir(target).with_context(|| format!("cannot read the folder `{shown}`"))? {
        let name = entry?.file_name();
        is_empty = false;
        if !name.to_str().is_some_and(|name| ours.contains(name)) {
            bail!(
                "`{shown}` holds `{}`, which closeranks did not write; allowed is a new name or a folder that closeranks wrote",
                Path::new(&name).display()
            );
        }
    }
    if is_empty { Ok(()) } else { check_command(target, &manifest) }
}

/// Refuses what another command wrote, unless it may be replaced.
fn check_command(target: &Path, manifest: &str) -> Result<()> {
    let writer = manifest.lines().next().and_then(|line| line.strip_prefix(WRITTEN_BY));
    if writer == Some(invocation::name()) || invocation::may_overwrite() {
        return Ok(());
    }
    let writer = writer.map_or("an earlier version of closeranks".to_owned(), |writer| format!("`{writer}`"));
    bail!(
        "`{}` holds what {writer} wrote; allowed is a new name, or --overwrite to replace it",
        target.display()
    )
}

/// Whether there is such a folder; refuses names that cannot be one. Folders above it may be missing: they are made.
pub(crate) fn exists(target: &Path) -> Result<bool> {
    let shown = target.display();
    if target.file_name().is_none() {
        bail!("`{shown}` cannot be an output folder: allowed is the name of a folder of its own");
    }
    let mut above = target.ancestors().skip(1).filter(|above| !above.as_os_str().is_empty());
    if let Some(above) = above.find(|above| fs::symlink_metadata(above).is_ok())
        && !above.is_dir()
    {
        bail!("`{shown}` cannot be an output folder: `{}` is {}", above.display(), kind(above));
    }
    if fs::symlink_metadata(target).is_err() {
        return Ok(false);
    }
    if !target.is_dir() {
        bail!(
            "`{shown}` is {}, not a folder; allowed is a new name or a folder that closeranks wrote",
            kind(target)
        );
    }
    Ok(true)
}

/// What a path that is no folder leads to.
fn kind(path: &Path) -> String {
    match fs::read_link(path) {
        Ok(to) if fs::metadata(path).is_err() => format!("a link to `{}`, which is not there", to.display()),
        Ok(to) => format!("a link to the file `{}`", to.display()),
        Err(_) => "a file".to_owned(),
    }
}
