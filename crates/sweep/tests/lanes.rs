//! Runs of a sweep that go side by side make the bytes that they make one by one.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use core::sync::atomic::{AtomicU64, Ordering};

use closeranks_report::sweep::entry::Entry;
use closeranks_report::sweep::rows::Rows;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::sweep::Plan;
use closeranks_sim::world::together::together;
use closeranks_sim::world::{Options, run};
use closeranks_sweep::block::{Job, Stopped};
use closeranks_sweep::manifest::Manifest;
use closeranks_sweep::shard::Shard;

/// Runs of which some are alike, but for what lanes do not share, and runs that go alone between them.
const TEXT: &str = "
duration_s = 0.2
[sweep]
controllers = [\"budget\", \"composed\", \"links\"]
[team]
robots = { choose = [8, 11], weights = [1, 4] }
malicious = [1, 2]
[start]
kind = \"random\"
half_side_m = { draw = [0.7, 1.5] }
distance_min_m = 0.3
[attack.level]
kind = \"bias\"
bias = { draw = [-5.0, 5.0] }
[motion]
kind = { choose = [\"paper\", \"wander\"] }
";

/// Enough runs for blocks of more than one group of lanes: 2,600 in 128 blocks of 20.
const RUNS: u64 = 2_600;

fn job(text: &str) -> Job {
    let manifest =
        Manifest { file: "lanes.toml".into(), text: text.into(), seed: 5, runs: RUNS, shard: Shard::WHOLE };
    Job { plan: Plan::read(text).unwrap(), manifest }
}

/// The rows of some runs, each of which is computed alone.
fn one_by_one(job: &Job, runs: core::ops::Range<u64>) -> Rows {
    let options = Options { without_phi: true, ..Options::default() };
    let mut rows = Rows::empty(&job.heads());
    for number in runs {
        let drawing = job.plan.draw(job.manifest.seed, number).unwrap();
        for (scenario, _) in &drawing.scenarios {
            let summary = &run(scenario, options, &mut |_| ()).unwrap().summary;
            let (redraws, drawn) = (drawing.redraws, drawing.drawn.as_slice());
            rows.push(Entry { run: number, redraws, drawn, scenario, summary }.cells());
        }
    }
    rows
}

#[test]
fn files_are_those_of_runs_one_by_one() {
    let job = job(TEXT);
    for block in [0, 7] {
        let runs = block * 20..(block + 1) * 20;
        assert_eq!(job.runs_of(block), 20);
        let bytes = |rows: Rows| job.write(Vec::new(), core::iter::once(Ok(rows))).unwrap();
        let rows = job.rows(block, &|| true).unwrap();
        assert!(bytes(rows) == bytes(one_by_one(&job, runs.clone())), "block {block}");
        let drawn: Vec<_> = runs.take(16).map(|run| job.plan.draw(5, run).unwrap()).collect();
        let scenarios: Vec<&Scenario> =
            drawn.iter().flat_map(|drawing| &drawing.scenarios).map(|(scenario, _)| scenario).collect();
        let side_by_side = together(&scenarios, Options::default()).iter().flatten().count();
        assert!((12..=32).contains(&side_by_side), "{side_by_side} of 48 runs go side by side");
    }
}

/// Whoever asks to stop is heard after the run in whose turn that is, and is told of each run once.
#[test]
fn every_run_is_told_once_and_whoever_stops_is_heard() {
    let job = job(TEXT);
    let told = AtomicU64::new(0);
    let count = |most: u64| told.fetch_add(1, Ordering::Relaxed) + 1 < most;
    assert!(job.rows(1, &|| count(u64::MAX)).is_ok());
    assert_eq!(told.swap(0, Ordering::Relaxed), 20);
    let stopped = job.rows(1, &|| count(3)).unwrap_err();
    assert!(stopped.is::<Stopped>());
    assert_eq!(told.into_inner(), 3);
}
