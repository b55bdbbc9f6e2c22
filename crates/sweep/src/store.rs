//! The folder of a sweep: locked, and every file in it whole, whenever the program is killed.

use core::time::Duration;
use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use crate::manifest::Manifest;
use crate::shard::Shard;

/// Says which sweep a folder holds.
pub const SWEEP: &str = "sweep.json";

/// Held locked while a program works in the folder; the system lets go of it when the program ends in any way.
const LOCK: &str = "sweep.lock";
/// How often a lock that somebody holds is asked for, and how long is waited in between.
const TRIES: u32 = 10;
const WAIT: Duration = Duration::from_millis(10);
/// Files that are being written.
const UNFINISHED: &str = ".closeranks-";
/// Blocks of rows.
const PART: &str = "part-";
/// What a finished sweep has besides its rows.
pub const PAGES: [&str; 5] = ["report.html", "laws.svg", "laws.png", "gyration.svg", "gyration.png"];

/// A folder that is ours as long as this lives.
#[derive(Debug)]
pub struct Store {
    folder: PathBuf,
    rows: String,
    _lock: File,
}

impl Store {
    /// Makes the folder, or goes on in it; refuses folders of others, of other sweeps, and those where another program works.
    pub fn open(folder: &Path, manifest: &Manifest) -> Result<Self> {
        let shown = folder.display();
        let cannot = || format!("cannot write to the folder `{shown}`");
        if folder.exists() {
            check_names(folder)?;
        } else if let Err(error) = fs::create_dir_all(folder)
            && !folder.is_dir()
        {
            return Err(error).with_context(cannot);
        }
        let lock = lock(folder)?;
        let store = Self { folder: folder.to_path_buf(), rows: rows(manifest.shard), _lock: lock };
        store.sweep_up()?;
        store.check_manifest(manifest)?;
        Ok(store)
    }

    fn check_manifest(&self, manifest: &Manifest) -> Result<()> {
        let path = self.path(SWEEP);
        let found = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return self.put(SWEEP, manifest.to_json().as_bytes());
            }
            Err(error) => return Err(error).with_context(|| format!("cannot read `{}`", path.display())),
        };
        if let Some(difference) = manifest.difference(&String::from_utf8_lossy(&found)) {
            bail!(
                "`{}` holds another sweep: {difference}; allowed is the command that began it or a new name",
                self.folder.display()
            );
        }
        Ok(())
    }

    /// Removes what a killed program was writing.
    fn sweep_up(&self) -> Result<()> {
        for name in names(&self.folder)? {
            if name.starts_with(UNFINISHED) {
                fs::remove_file(self.path(&name)).with_context(|| format!("cannot remove `{name}`"))?;
            }
        }
        Ok(())
    }

    /// Path of a file in the folder.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Name of the file with all rows.
    #[must_use]
    pub fn rows(&self) -> &str {
        &self.rows
    }

    /// True if all rows are there.
    #[must_use]
    pub fn is_finished(&self) -> bool {
        self.path(&self.rows).is_file()
    }

    /// Blocks that are there.
    pub fn parts(&self) -> Result<BTreeSet<u64>> {
        Ok(names(&self.folder)?.iter().filter_map(|name| block(name)).collect())
    }

    /// Name of the file of a block.
    #[must_use]
    pub fn part(block: u64) -> String {
        format!("{PART}{block:07}.parquet")
    }

    /// Removes a block.
    pub fn remove_part(&self, block: u64) -> Result<()> {
        let name = Self::part(block);
        fs::remove_file(self.path(&name)).with_context(|| format!("cannot remove `{name}`"))
    }

    /// Removes all blocks.
    pub fn remove_parts(&self) -> Result<()> {
        self.parts()?.into_iter().try_for_each(|block| self.remove_part(block))
    }

    /// Writes a file: it is there whole or not at all.
    pub fn put(&self, name: &str, bytes: &[u8]) -> Result<()> {
        self.write(name, |file| Ok(file.write_all(bytes)?))
    }

    /// Writes a file with `fill`: beside, to the disk, then renamed.
    pub fn write(&self, name: &str, fill: impl FnOnce(&mut File) -> Result<()>) -> Result<()> {
        let path = self.path(name);
        let cannot = || format!("cannot write `{}`", path.display());
        let mut file = builder().tempfile_in(&self.folder).with_context(cannot)?;
        fill(file.as_file_mut()).with_context(cannot)?;
        file.as_file().sync_all().with_context(cannot)?;
        file.persist(&path).with_context(cannot)?;
        sync(&self.folder).with_context(cannot)
    }
}

/// Name of the file with all rows of a shard.
#[must_use]
pub fn rows(shard: Shard) -> String {
    match shard {
        Shard::WHOLE => "runs.parquet".to_owned(),
        Shard { index, count } => format!("runs-{index}-of-{count}.parquet"),
    }
}

/// Temporary files for everybody whom the umask allows.
#[cfg(unix)]
fn builder() -> tempfile::Builder<'static, 'static> {
    use std::os::unix::fs::PermissionsExt as _;
    let mut builder = tempfile::Builder::new();
    builder.prefix(UNFINISHED).permissions(fs::Permissions::from_mode(0o666));
    builder
}

#[cfg(not(unix))]
fn builder() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(UNFINISHED);
    builder
}

/// Names in a folder are on the disk too.
#[cfg(unix)]
fn sync(folder: &Path) -> std::io::Result<()> {
    File::open(folder)?.sync_all()
}

#[cfg(not(unix))]
fn sync(_folder: &Path) -> std::io::Result<()> {
    Ok(())
}

fn lock(folder: &Path) -> Result<File> {
    let path = folder.join(LOCK);
    let opened = File::options().create(true).truncate(false).write(true).open(&path);
    let file = opened.with_context(|| format!("cannot write `{}`", path.display()))?;
    for _ in 0..TRIES {
        match file.try_lock() {
            Ok(()) => return Ok(file),
            // Perhaps somebody asks for the status of the folder, which takes an instant.
            Err(TryLockError::WouldBlock) => std::thread::sleep(WAIT),
            Err(TryLockError::Error(error)) => {
                return Err(error).with_context(|| format!("cannot lock `{}`", path.display()));
            }
        }
    }
    bail!("another closeranks is at work in `{}`; allowed is to wait for it, or a new name", folder.display())
}

/// True if a program is at work in the folder.
pub(crate) fn is_locked(folder: &Path) -> bool {
    let Ok(file) = File::open(folder.join(LOCK)) else { return false };
    matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock))
}

/// Names of everything in a folder.
pub(crate) fn names(folder: &Path) -> Result<Vec<String>> {
    let cannot = || format!("cannot read the folder `{}`", folder.display());
    let entries = fs::read_dir(folder).with_context(cannot)?;
    let names = entries.map(|entry| Ok(entry?.file_name().to_string_lossy().into_owned()));
    names.collect::<std::io::Result<_>>().with_context(cannot)
}

/// Refuses a folder that holds anything that no sweep writes, or is not a sweep's.
fn check_names(folder: &Path) -> Result<()> {
    let names = names(folder)?;
    let begun = names.iter().any(|name| name == SWEEP);
    let ours = |name: &String| {
        name == LOCK || name.starts_with(UNFINISHED) || (begun && (name == SWEEP || is_result(name)))
    };
    if let Some(stray) = names.iter().find(|name| !ours(name)) {
        bail!(
            "`{}` holds `{stray}`, which no sweep wrote; allowed is a new name or the folder of this sweep",
            folder.display()
        );
    }
    Ok(())
}

fn is_result(name: &str) -> bool {
    let rows = name == "runs.parquet" || (name.starts_with("runs-") && name.ends_with(".parquet"));
    rows || block(name).is_some() || PAGES.contains(&name)
}

/// Number of the block whose file `name` is.
pub(crate) fn block(name: &str) -> Option<u64> {
    let block = name.strip_prefix(PART)?.strip_suffix(".parquet")?.parse().ok()?;
    (Store::part(block) == name).then_some(block)
}
