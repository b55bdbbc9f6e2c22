//! `closeranks sweep merge DIR... -o DIR`: shards as one sweep.

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;
use closeranks_sweep::merge;
use closeranks_sweep::store::Store;

use super::work::tell;
use crate::Speech;
use crate::folder::exists;

#[derive(Args, Debug)]
pub(crate) struct Merge {
    /// Folders of all shards, in any order.
    #[arg(value_name = "DIR", required = true)]
    folders: Vec<PathBuf>,
    /// Folder to write to.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    #[command(flatten)]
    speech: Speech,
}

/// Puts shards together; false when a law was broken that should hold.
pub(super) fn merge(arguments: &Merge) -> Result<bool> {
    let Merge { folders, output, speech } = arguments;
    let (job, files) = merge::plan(folders)?;
    exists(output)?;
    let store = Store::open(output, &job.manifest)?;
    let finished = store.is_finished();
    if !finished {
        merge::merge(&job, &files, &store)?;
    }
    tell(&job, &store, output, *speech, if finished { "this sweep was finished before in" } else { "" })
}
