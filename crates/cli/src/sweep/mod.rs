//! `closeranks sweep FILE`: many runs drawn from one file, resumable, in shards, one row each.

mod merge;
mod save;
mod status;
mod work;

use std::path::PathBuf;

use anyhow::Result;
use clap::{Args, Subcommand};
use closeranks_sweep::manifest::RUNS;
use closeranks_sweep::shard::Shard;

use crate::{Speech, invocation};

/// Seed of a sweep that names none.
pub(crate) const SEED: u64 = 1;

/// Longer help.
pub(crate) const HELP: &str = "\
A sweep file is a scenario in which any value may be drawn anew for every run:

    # campaign.toml
    [sweep]
    controllers = [\"budget\", \"composed\"]     # each drawn scenario runs under both, same seed

    [team]
    robots = { draw = [4, 12] }              # a whole number, both ends included

    [link]
    q2 = { draw = [0.1, 0.9], log = true }   # a number, here even in the logarithm

    [attack]
    level = { choose = [{ kind = \"none\" }, { kind = \"bias\", bias = { draw = [-4.0, 4.0] } }], weights = [1, 3] }

    closeranks sweep campaign.toml --runs 10000 -o out              # again after a kill: it goes on
    closeranks sweep campaign.toml --runs 10000 --shard 2/8 -o out-2   # every eighth run, on another machine
    closeranks sweep --status out-*                                 # what is done, what is open
    closeranks sweep merge out-* -o out                             # all shards as one sweep
    closeranks run campaign.toml --draw 17 --sweep-seed 1           # run 17 again, by itself

Run K depends on the file, the seed and K alone: not on --runs, --jobs or --shard. DIR gets runs.parquet (one row a run and
controller), figures and report.html. More: docs/sweeps.md.

Exit codes: 0 fine; 1 a law was broken although all held that it rests on, under `budget`, or under any controller if `budget`
is not among them; with --status: a shard is open; 2 bad input.";

#[derive(Args, Debug)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub(crate) struct Sweep {
    #[command(subcommand)]
    action: Option<Action>,
    #[command(flatten)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum Action {
    /// Put the folders of all shards together: the bytes that one command without --shard would have written.
    ///
    /// Every shard must be there once and finished. Every run is checked to be there once.
    Merge(merge::Merge),
}

/// What is run, or looked at.
#[derive(Args, Debug)]
pub(crate) struct What {
    /// Scenario with draws, a TOML file; `-` reads standard input. (A file called `merge` is ./merge.)
    #[arg(value_name = "FILE", required_unless_present = "status")]
    file: Option<PathBuf>,
    /// How many runs, in all shards together.
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = clap::value_parser!(u64).range(RUNS))]
    runs: u64,
    /// Threads; by default one a core. The rows do not depend on it.
    #[arg(long, value_name = "J", value_parser = clap::value_parser!(u16).range(1..=1_024))]
    jobs: Option<u16>,
    /// Only runs k with k % M == I - 1; I from 1 to M. `auto`: I and M are what Slurm, AWS Batch, Cloud Run or Kubernetes tell
    /// this task of an array; CLOSERANKS_SHARDS is M where they do not tell it.
    #[arg(long, value_name = "I/M|auto", default_value = "1/1", value_parser = shard)]
    shard: Shard,
    /// Seed of all draws.
    #[arg(long, value_name = "S", default_value_t = SEED, value_parser = invocation::seed, allow_negative_numbers = true)]
    seed: u64,
    /// Folder to write to; a folder where the same command was killed is gone on with.
    #[arg(short, long, value_name = "DIR", required_unless_present = "status")]
    output: Option<PathBuf>,
    /// Say what is done and what is open in these folders, and run nothing. The last line is what to submit again.
    #[arg(long, value_name = "DIR", num_args = 1.., conflicts_with_all = ["file", "output", "runs", "jobs", "shard", "seed"])]
    status: Vec<PathBuf>,
    #[command(flatten)]
    speech: Speech,
}

/// Reads a shard, or asks the scheduler.
fn shard(text: &str) -> Result<Shard, String> {
    if text == "auto" {
        closeranks_sweep::array::auto(&|name| std::env::var(name).ok())
    } else {
        text.parse()
    }
}

/// Runs the sweep, or what is left of it; false when a law was broken that should hold.
pub(crate) fn sweep(arguments: &Sweep) -> Result<bool> {
    let What { file, output, status, .. } = &arguments.what;
    match (&arguments.action, file, output) {
        (Some(Action::Merge(merge)), ..) => merge::merge(merge),
        (None, Some(file), Some(output)) => work::work(&arguments.what, file, output),
        _ => status::status(status, arguments.what.speech),
    }
}
