//! `closeranks sweep FILE`: many runs drawn from one file, resumable, in shards, one row each.

mod manifest;
mod report;
mod save;
mod shard;
mod store;
mod work;

use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use self::manifest::Manifest;
use self::report::{Outcome, laws};
use self::shard::Shard;
use self::store::{PAGES, Store};
use self::work::Work;
use crate::{Speech, invocation, json, output, source};

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
    closeranks run campaign.toml --draw 17 --sweep-seed 1           # run 17 again, by itself

Run K depends on the file, the seed and K alone: not on --runs, --jobs or --shard. DIR gets runs.parquet (one row a run and
controller), figures and report.html. More: docs/sweeps.md.

Exit codes: 0 fine; 1 a law was broken although all held that it rests on, under `budget`, or under any controller if `budget`
is not among them; 2 bad input.";

#[derive(Args, Debug)]
pub(crate) struct Sweep {
    /// Scenario with draws, a TOML file; `-` reads standard input.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// How many runs, in all shards together.
    #[arg(long, value_name = "N", default_value_t = 1_000, value_parser = clap::value_parser!(u64).range(1..=10_000_000))]
    runs: u64,
    /// Threads; by default one a core. The rows do not depend on it.
    #[arg(long, value_name = "J", value_parser = clap::value_parser!(u16).range(1..=1_024))]
    jobs: Option<u16>,
    /// Only runs k with k % M == I - 1; I from 1 to M.
    #[arg(long, value_name = "I/M", default_value = "1/1")]
    shard: Shard,
    /// Seed of all draws.
    #[arg(long, value_name = "S", default_value_t = SEED, value_parser = invocation::seed, allow_negative_numbers = true)]
    seed: u64,
    /// Folder to write to; a folder where the same command was killed is gone on with.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,
    #[command(flatten)]
    speech: Speech,
}

/// Runs the sweep, or what is left of it; false when a law was broken that should hold.
pub(crate) fn sweep(arguments: &Sweep) -> Result<bool> {
    let (plan, text) = source::plan(&arguments.file)?;
    let Sweep { file, seed, runs, shard, .. } = arguments;
    // What cannot be run at all is refused before anything is written.
    source::draw(file, &text, &plan, *seed, shard.index - 1)?;
    let manifest = Manifest { text: &text, seed: *seed, runs: *runs, shard: *shard };
    let quiet = arguments.speech.quiet;
    let work = Work { file, plan, manifest, jobs: arguments.jobs.unwrap_or(0).into(), quiet };
    let store = Store::open(&arguments.output, &work.manifest)?;
    let finished = store.is_finished();
    if !finished {
        work.finish(&store)?;
    }
    let (tally, spread) = work.count(&store)?;
    let laws = laws(&tally);
    let outcome =
        Outcome { file: &file.display().to_string(), manifest: &work.manifest, tally: &tally, laws: &laws };
    save::save(&store, &outcome, &spread)?;
    store.remove_parts()?;
    say(arguments, &outcome, &store, finished);
    Ok(outcome.is_good())
}

fn say(arguments: &Sweep, outcome: &Outcome<'_>, store: &Store, finished: bool) {
    if arguments.speech.json {
        output::say(&json::text(&outcome.json()));
    } else if !arguments.speech.quiet {
        let folder = arguments.output.display();
        let before =
            if finished { format!("this sweep was finished before in {folder}\n") } else { String::new() };
        output::say(&format!(
            "{before}{}\nin {folder}: {}, {}\n",
            outcome.text(),
            store.rows(),
            PAGES.join(", ")
        ));
    }
}
