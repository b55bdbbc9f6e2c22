//! What many worlds of one scenario cost: `worlds FILE WORLDS TICKS [HOW]`, seeds from 0 on.
//!
//! Worlds are stepped in blocks, as a batch does, or one by one (`one-by-one`), or in blocks of one (`alone`). With `runs` they are whole runs
//! with their summaries, as a sweep computes them. Time it, or count instructions, from outside:
//!
//! ```sh
//! cargo build --release -p closeranks-sim --example worlds
//! valgrind --tool=callgrind target/release/examples/worlds scenarios/random.toml 16 220   # less 20 ticks, over 16 * 200
//! ```

use std::io::Write as _;
use std::process::ExitCode;

use closeranks_sim::parse::scenario;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::Options;
use closeranks_sim::world::any::{AnyGiven, AnyWorld};
use closeranks_sim::world::block::Block;
use closeranks_sim::world::together::together;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let told = match &arguments[..] {
        [file, worlds, ticks] => told(file, worlds, ticks, "together"),
        [file, worlds, ticks, how] => told(file, worlds, ticks, how),
        _ => None,
    };
    let Some(told) = told else { return usage() };
    // Nobody listens if this fails.
    let _ = std::io::stdout().write_all(told.as_bytes());
    ExitCode::SUCCESS
}

fn usage() -> ExitCode {
    let _ = std::io::stderr().write_all(b"worlds FILE WORLDS TICKS [one-by-one | alone | runs]\n");
    ExitCode::FAILURE
}

/// What it came to, and how the worlds were computed.
fn told(file: &str, worlds: &str, ticks: &str, how: &str) -> Option<String> {
    let scenario = scenario(&std::fs::read_to_string(file).ok()?).ok()?;
    let (worlds, ticks): (u64, u32) = (worlds.parse().ok()?, ticks.parse().ok()?);
    let seeds: Vec<u64> = (0..worlds).collect();
    match how {
        "together" => stepped(&scenario, seeds.chunks(Block::MOST), ticks),
        "alone" => stepped(&scenario, seeds.chunks(1), ticks),
        "one-by-one" => {
            let ends_m = seeds.iter().filter_map(|seed| alone(&scenario, *seed, ticks));
            Some(format!("{} m, one by one\n", ends_m.sum::<f64>()))
        }
        "runs" => Some(runs(&scenario, &seeds, ticks)),
        _ => None,
    }
}

/// Where the first robot of every world is at the end, added up.
fn stepped<'a>(scenario: &Scenario, blocks: impl Iterator<Item = &'a [u64]>, ticks: u32) -> Option<String> {
    let (mut sum_m, mut in_lanes) = (0.0, 0);
    for seeds in blocks {
        let mut block = Block::new(scenario, seeds, Options::default()).ok()?;
        in_lanes += usize::from(block.is_in_lanes()) * seeds.len();
        let nothing = vec![AnyGiven::default(); seeds.len()];
        for _ in 0..ticks {
            block.step_with(&nothing).ok()?;
        }
        sum_m += block.worlds().iter().map(|world| world.positions_m()[0]).sum::<f64>();
    }
    Some(format!("{sum_m} m, {in_lanes} worlds in lanes\n"))
}

fn alone(scenario: &Scenario, seed: u64, ticks: u32) -> Option<f64> {
    let mut world = AnyWorld::new(&Scenario { seed, ..scenario.clone() }, Options::default()).ok()?;
    for _ in 0..ticks {
        world.step();
    }
    Some(world.positions_m()[0])
}

/// How wide the teams of whole runs of so many ticks are at the end, added up.
fn runs(scenario: &Scenario, seeds: &[u64], ticks: u32) -> String {
    let duration_s = f64::from(ticks) * scenario.tick_s();
    let of = |seed: &u64| Scenario { seed: *seed, duration_s, ..scenario.clone() };
    let scenarios: Vec<Scenario> = seeds.iter().map(of).collect();
    let finished = together(&scenarios.iter().collect::<Vec<_>>(), Options::default());
    let side_by_side = finished.iter().flatten().count();
    let sum_m: f64 = finished.iter().flatten().map(|run| run.summary.gyration_m).sum();
    format!("{sum_m} m, {side_by_side} of {} runs in lanes\n", seeds.len())
}
