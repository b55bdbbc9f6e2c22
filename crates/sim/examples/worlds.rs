//! What many worlds of one scenario cost: `worlds FILE WORLDS TICKS [one-by-one]`, seeds from 0 on.
//!
//! Worlds are stepped in blocks, as a batch does, or one by one. Time it, or count instructions, from outside:
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

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let told = match &arguments[..] {
        [file, worlds, ticks] => stepped(file, worlds, ticks, false),
        [file, worlds, ticks, how] if how == "one-by-one" => stepped(file, worlds, ticks, true),
        _ => None,
    };
    let Some(told) = told else { return usage() };
    // Nobody listens if this fails.
    let _ = std::io::stdout().write_all(told.as_bytes());
    ExitCode::SUCCESS
}

fn usage() -> ExitCode {
    let _ = std::io::stderr().write_all(b"worlds FILE WORLDS TICKS [one-by-one]\n");
    ExitCode::FAILURE
}

/// Where the first robot of every world is at the end, added up, and how the worlds were computed.
fn stepped(file: &str, worlds: &str, ticks: &str, one_by_one: bool) -> Option<String> {
    let scenario = scenario(&std::fs::read_to_string(file).ok()?).ok()?;
    let (worlds, ticks): (u64, u32) = (worlds.parse().ok()?, ticks.parse().ok()?);
    let seeds: Vec<u64> = (0..worlds).collect();
    let (mut sum_m, mut in_lanes) = (0.0, 0);
    for seeds in seeds.chunks(Block::MOST) {
        let mut block = Block::new(&scenario, seeds, Options::default()).ok()?;
        if one_by_one {
            sum_m += seeds.iter().filter_map(|seed| alone(&scenario, *seed, ticks)).sum::<f64>();
            continue;
        }
        in_lanes += usize::from(block.is_in_lanes()) * seeds.len();
        let nothing = vec![AnyGiven::default(); seeds.len()];
        for _ in 0..ticks {
            block.step_with(&nothing).ok()?;
        }
        sum_m += block.worlds().iter().map(|world| world.positions_m()[0]).sum::<f64>();
    }
    Some(format!("{sum_m} m, {in_lanes} of {worlds} worlds in lanes\n"))
}

fn alone(scenario: &Scenario, seed: u64, ticks: u32) -> Option<f64> {
    let mut world = AnyWorld::new(&Scenario { seed, ..scenario.clone() }, Options::default()).ok()?;
    for _ in 0..ticks {
        world.step();
    }
    Some(world.positions_m()[0])
}
