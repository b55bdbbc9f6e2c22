//! Shards put together: the bytes that one command without shards would have written.

use std::collections::BTreeSet;
use std::fs::File;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, Result, bail};
use closeranks_report::sweep::file::Groups;
use closeranks_report::sweep::rows::Rows;
use closeranks_sim::sweep::Plan;

use crate::block::Job;
use crate::shard::Shard;
use crate::status::{self, Status};
use crate::store::{self, Store};
use crate::work;

/// The job that all folders together are, and the files of their rows, in the order of shards. Everything that can be known without
/// reading rows is checked.
pub fn plan(folders: &[PathBuf]) -> Result<(Job, Vec<PathBuf>)> {
    let of = |folder: &PathBuf| Ok((folder.display().to_string(), status::of(folder)?));
    let all = folders.iter().map(of).collect::<Result<Vec<(String, Status)>>>()?;
    let whole = status::together(&all)?;
    if !whole.open.is_empty() || !whole.at_work.is_empty() {
        let open: BTreeSet<u64> = whole.open.union(&whole.at_work).copied().collect();
        bail!(
            "{} of {} shards are not finished: {}; allowed is the folders of all shards, each finished",
            open.len(),
            whole.count,
            status::ranges(&open)
        );
    }
    let manifest = all[0].1.manifest.of_shard(Shard::WHOLE);
    let Ok(plan) = Plan::read(&manifest.text) else {
        bail!("`{}` holds a file that cannot be read", all[0].0)
    };
    let job = Job { plan, manifest };
    let mut files: Vec<(u64, PathBuf)> = Vec::new();
    for (folder, (name, status)) in folders.iter().zip(&all) {
        let shard = status.manifest.shard;
        let path = folder.join(store::rows(shard));
        let file = File::open(&path).with_context(|| format!("cannot read `{}`", path.display()))?;
        if !(Job { manifest: job.manifest.of_shard(shard), plan: job.plan.clone() }).is_of(file)? {
            bail!("`{name}` is of another version of closeranks; allowed is the one that made its rows");
        }
        files.push((shard.index, path));
    }
    files.sort();
    Ok((job, files.into_iter().map(|(_, path)| path).collect()))
}

/// Writes all rows of `files` to the folder. Every run must be there once, with a row for each controller.
///
/// Of every shard one group of rows is in memory at a time.
pub fn merge(job: &Job, files: &[PathBuf], store: &Store) -> Result<()> {
    let mut shards = files.iter().map(|path| Rest::open(path)).collect::<Result<Vec<Rest>>>()?;
    let blocks = (0..job.blocks()).map(|block| gather(job, block, &mut shards));
    store.write(store.rows(), |file| work::write(job, file, blocks))?;
    for shard in &mut shards {
        shard.fill()?;
        if shard.group.is_some() {
            bail!("`{}` has rows of runs that are not its own", shard.path.display());
        }
    }
    Ok(())
}

/// The rows of a block of the whole, from the shards that have them.
fn gather(job: &Job, block: u64, shards: &mut [Rest]) -> Result<Rows> {
    let mut rows = Rows::empty(&job.heads());
    for run in job.runs(block) {
        let place = usize::try_from(run % shards.len() as u64)?;
        let shard = &mut shards[place];
        shard.take(run, job.rows_per_run(), &mut rows)?;
    }
    Ok(rows)
}

/// What was not taken yet of a file of rows.
struct Rest {
    path: PathBuf,
    groups: Groups<File>,
    /// The group that is being taken from, and which of its rows is next.
    group: Option<Rows>,
    next: usize,
    begun: bool,
}

impl Rest {
    fn open(path: &Path) -> Result<Self> {
        let cannot = || format!("cannot read `{}`", path.display());
        let groups = Groups::of(File::open(path).with_context(cannot)?).with_context(cannot)?;
        Ok(Self { path: path.to_owned(), groups, group: None, next: 0, begun: false })
    }

    /// Reads on until there is a next row; there is no group after the last.
    fn fill(&mut self) -> Result<()> {
        while self.group.as_ref().is_some_and(|group| self.next == group.count()) || !self.begun {
            let group = self.groups.next().transpose();
            self.group = group.with_context(|| format!("`{}` is broken", self.path.display()))?;
            (self.next, self.begun) = (0, true);
        }
        Ok(())
    }

    /// Adds the next rows, which must be those of `run`.
    fn take(&mut self, run: u64, count: usize, rows: &mut Rows) -> Result<()> {
        for _ in 0..count {
            self.fill()?;
            let path = self.path.display();
            let Some(group) = &self.group else { bail!("`{path}` has no row of run {run}") };
            if group.whole("run").get(self.next) != Some(&i64::try_from(run).ok()) {
                bail!("`{path}` has another row where run {run} should be");
            }
            if !rows.append(group.range(self.next..self.next + 1)) {
                bail!("`{path}` has other columns");
            }
            self.next += 1;
        }
        Ok(())
    }
}
