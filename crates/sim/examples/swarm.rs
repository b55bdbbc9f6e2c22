//! What a tick of a large team costs: `swarm FILE [ROBOTS [TICKS]]`, a scenario with `robots = 10000`, that many robots and ticks.
//!
//! Says what the run came to, without figures or files; time it from outside, or count instructions:
//!
//! ```sh
//! cargo build --release -p closeranks-sim --example swarm
//! valgrind --tool=callgrind target/release/examples/swarm scenarios/swarm.toml 1000 20
//! ```

use std::io::Write as _;
use std::process::ExitCode;

use closeranks_sim::parse::scenario;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, World};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some(scenario) = arguments.first().and_then(|file| read(file, arguments.get(1))) else {
        return usage();
    };
    let ticks = arguments.get(2).and_then(|ticks| ticks.parse().ok()).unwrap_or(scenario.ticks());
    let options = Options { without_phi: true, digest: true, ..Options::default() };
    let Ok(mut world) = World::<2>::new(&scenario, options) else { return usage() };
    for _ in 0..ticks {
        world.step();
    }
    let (links, liars, robots) = (world.frame().links, scenario.malicious.len(), scenario.team.robots);
    let broken = world.monitors().verdicts().iter().filter(|verdict| verdict.count > 0);
    let broken: Vec<String> = broken.map(|verdict| format!("{verdict:?}\n")).collect();
    let (void, extremes) = (world.monitors().void(), world.monitors().extremes());
    let told = format!(
        "{robots} robots, {liars} liars, {links} links after {ticks} ticks\n{}{void:?}\n{extremes:?}\ndigest {:016x}\n",
        broken.concat(),
        world.digest().unwrap_or(0)
    );
    // Nobody listens if this fails.
    let _ = std::io::stdout().write_all(told.as_bytes());
    ExitCode::SUCCESS
}

/// The scenario of a file, with another number of robots if one is given.
fn read(file: &str, robots: Option<&String>) -> Option<Scenario> {
    let mut text = std::fs::read_to_string(file).ok()?;
    if let Some(robots) = robots {
        text = text.replace("robots = 10000", &format!("robots = {robots}"));
    }
    let read = scenario(&text);
    read.map_err(|problems| problems.iter().for_each(|problem| eprintln!("{problem}"))).ok()
}

fn usage() -> ExitCode {
    eprintln!("swarm FILE [ROBOTS [TICKS]]");
    ExitCode::from(2)
}
