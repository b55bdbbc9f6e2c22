//! What a tick of a large team costs: `swarm ROBOTS TICKS [core|paper]`, under `links` with ranks.
//!
//! Says what the run came to; time it from outside, or count instructions:
//!
//! ```sh
//! cargo build --release -p closeranks-sim --example swarm
//! valgrind --tool=callgrind target/release/examples/swarm 1000 20
//! ```

use std::process::ExitCode;

use closeranks_sim::parse::scenario;
use closeranks_sim::world::{Options, World};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [robots, ticks] = arguments.as_slice() else { return usage() };
    let (Ok(robots), Ok(ticks)) = (robots.parse::<u16>(), ticks.parse::<u32>()) else { return usage() };
    let text = format!(
        "duration_s = 600.0
        team = {{ robots = {robots}, faults = 2, malicious = {{ local = 400, within_m = 8.0 }}, ranks = {{ core = 7, listen = \"counted\" }} }}
        controller = {{ kind = \"links\" }}
        clock = {{ tau_1_s = 0.02 }}
        start = {{ kind = \"hexagon\", spacing_m = 1.4 }}
        motion = {{ kind = \"wander\" }}"
    );
    let scenario = match scenario(&text) {
        Ok(scenario) => scenario,
        Err(problems) => {
            problems.iter().for_each(|problem| eprintln!("{problem}"));
            return ExitCode::from(2);
        }
    };
    let options = Options { without_phi: true, ..Options::default() };
    let Ok(mut world) = World::<2>::new(&scenario, options) else { return usage() };
    for _ in 0..ticks {
        world.step();
    }
    let (links, liars) = (world.frame().links, scenario.malicious.len());
    println!("{robots} robots, {liars} liars, {links} links after {ticks} ticks");
    for verdict in world.monitors().verdicts().iter().filter(|verdict| verdict.covered > 0) {
        println!("{}: {verdict:?}", verdict.law.name());
    }
    println!("{:?}", world.monitors().void());
    ExitCode::SUCCESS
}

fn usage() -> ExitCode {
    eprintln!("swarm ROBOTS TICKS");
    ExitCode::from(2)
}
