//! `--record FILE.mcap`: a run as messages of ROS 2, written while it goes on. The file is whole from its first moment, so what a
//! program that is killed leaves behind can be read.

use std::fs::{self, File};
use std::io::Read as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::{Context as _, Result, bail};
use closeranks_report::recording::mcap::{ROBOTS_MAX, RunWriter, opened_by};
use closeranks_sim::output::snapshot::Snapshot;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::any::AnyWorld;
use closeranks_sim::world::{Options, Run};

use crate::folder::parent;
use crate::results::recorder::{Watch, metadata};
use crate::threads::Threads;
use crate::{invocation, output};

/// How names of such recordings end.
const ENDING: &str = "mcap";
/// So much of a file is read to see who wrote it: metadata with the longest scenario.
const START_MAX: u64 = 1 << 20;

/// Where recordings go, checked before anything is run.
#[derive(Clone, Debug)]
pub(crate) struct Target(PathBuf);

impl Target {
    /// The file `path`; refuses at once if that would lose anything or cannot work.
    pub(crate) fn new(path: &Path) -> Result<Self> {
        let shown = path.display();
        if path.extension().is_none_or(|ending| ending != ENDING) {
            bail!(
                "`{shown}` cannot be a recording: allowed is a name that ends in .{ENDING} (`-o DIR` writes every tick as Parquet)"
            );
        }
        let target = Self(path.to_path_buf());
        target.check()?;
        Ok(target)
    }

    /// One of several recordings of a command: `run.mcap` becomes `run-NAME.mcap`.
    pub(crate) fn of(path: &Path, name: &str) -> Result<Self> {
        let mut file = path.file_stem().unwrap_or_default().to_owned();
        file.push("-");
        file.push(name);
        // Of the whole name the ending is checked first.
        Self::new(path)?;
        Self::new(&path.with_file_name(file).with_added_extension(ENDING))
    }

    fn check(&self) -> Result<()> {
        let shown = self.0.display();
        let Ok(kind) = fs::metadata(&self.0) else {
            if fs::symlink_metadata(&self.0).is_ok() {
                bail!("`{shown}` is a link to what is not there; allowed is a new name");
            }
            return Ok(());
        };
        if !kind.is_file() {
            bail!("`{shown}` is no file; allowed is a new name, or a recording that closeranks wrote");
        }
        let mut start = Vec::new();
        let file = File::open(&self.0).with_context(|| format!("cannot read `{shown}`"))?;
        file.take(START_MAX).read_to_end(&mut start).with_context(|| format!("cannot read `{shown}`"))?;
        match opened_by(&start) {
            None => bail!("`{shown}` is there and closeranks did not write it; allowed is a new name"),
            Some(command) if command == invocation::name() || invocation::may_overwrite() => Ok(()),
            Some(command) => bail!(
                "`{shown}` holds what `{command}` wrote; allowed is a new name, or --overwrite to replace it"
            ),
        }
    }

    /// The file, empty and in its place.
    fn file(&self) -> Result<File> {
        let cannot = || format!("cannot write `{}`", self.0.display());
        let folder = parent(&self.0);
        fs::create_dir_all(folder).with_context(cannot)?;
        // A file beside, put in the place of an old recording that somebody may be reading.
        let fresh =
            tempfile::Builder::new().prefix(".closeranks-").tempfile_in(folder).with_context(cannot)?;
        self.check()?;
        readable(fresh.path()).with_context(cannot)?;
        fresh.persist(fs::canonicalize(&self.0).as_ref().unwrap_or(&self.0)).with_context(cannot)
    }
}

/// Temporary files are private; recordings are for everybody whom the umask allows.
#[cfg(unix)]
fn readable(file: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt as _;
    fs::set_permissions(file, fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn readable(_file: &Path) -> std::io::Result<()> {
    Ok(())
}

/// A recording that grows.
pub(crate) struct Tape {
    writer: RunWriter<File>,
    path: PathBuf,
}

impl Tape {
    /// Begins the recording of a run of `scenario`, whose text is `text`.
    pub(crate) fn new(target: &Target, scenario: &Scenario, text: &str) -> Result<Self> {
        let robots = scenario.team.robots;
        if robots > ROBOTS_MAX {
            bail!("`team.robots` is {robots}, allowed with --record is at most {ROBOTS_MAX}");
        }
        if !scenario.teams.is_empty() {
            bail!(
                "`teams` with --record FILE.mcap: messages of ROS 2 have no word for several teams; allowed is a folder with -o, whose \
                 run.parquet has all robots, one team after another"
            );
        }
        if !scenario.absences.is_empty() {
            bail!(
                "`team.absent` with --record FILE.mcap: messages of ROS 2 have no word for robots that come and go; allowed is a \
                 folder with -o, whose run.parquet has them"
            );
        }
        let file = target.file()?;
        let writer = RunWriter::new(scenario, &metadata(text, scenario), invocation::name(), file);
        let writer = writer.with_context(|| format!("cannot write `{}`", target.0.display()))?;
        Ok(Self { writer, path: target.0.clone() })
    }

    /// Adds a tick.
    pub(crate) fn tick(&mut self, now: &Snapshot<'_>) -> Result<()> {
        self.writer.tick(now).with_context(|| format!("cannot write `{}`", self.path.display()))
    }

    /// Writes what is left; says where.
    pub(crate) fn finish(self) -> Result<PathBuf> {
        self.writer.finish().with_context(|| format!("cannot write `{}`", self.path.display()))?;
        Ok(self.path)
    }
}

/// Runs `scenario` from the first tick to the last; `watch` sees every tick.
pub(crate) fn run(
    scenario: &Scenario,
    options: Options,
    progress: &mut dyn FnMut(u32),
    watch: &mut Watch<'_>,
) -> Result<Run> {
    let mut world = AnyWorld::new(scenario, options)?;
    world.employ(Arc::new(Threads::all()));
    while !world.is_over() {
        progress(world.ticks_done());
        world.step();
        if let Some(now) = world.snapshot() {
            watch(&now)?;
        }
    }
    Ok(world.finish())
}

/// A watch that records, if there is a tape.
pub(crate) fn record(tape: &mut Option<Tape>) -> impl FnMut(&Snapshot<'_>) -> Result<()> + '_ {
    |now| tape.as_mut().map_or(Ok(()), |tape| tape.tick(now))
}

/// Says where runs were recorded.
pub(crate) fn say<'a>(files: impl Iterator<Item = &'a Path>) {
    let names: Vec<String> = files.map(|file| file.display().to_string()).collect();
    if !names.is_empty() {
        output::say(&format!("recorded in {}\n", names.join(", ")));
    }
}
