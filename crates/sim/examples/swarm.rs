//! What a tick of a large team costs: `swarm FILE [ROBOTS [TICKS [CONTROLLER [alone]]]]`, a scenario with `robots = 10000` under `links`, that
//! many robots, ticks and the controller to put in place of it.
//!
//! Says what the run came to, without figures or files. With `alone` the engine is stepped alone, without monitors. Time it, or count
//! instructions, from outside:
//!
//! ```sh
//! cargo build --release -p closeranks-sim --example swarm
//! valgrind --tool=callgrind target/release/examples/swarm scenarios/swarm.toml 1000 20 links alone
//! ```

use std::io::Write as _;
use std::process::ExitCode;

use closeranks_core::controller::AnyController;
use closeranks_sim::attack::liars::Liars;
use closeranks_sim::engine::held::Held;
use closeranks_sim::engine::team::Team;
use closeranks_sim::engine::workers::Alone;
use closeranks_sim::frame::Frame;
use closeranks_sim::parse::scenario;
use closeranks_sim::plant::Bodies;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, World, initial_values, want};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some(scenario) = arguments.first().and_then(|file| read(file, &arguments[1..])) else {
        return usage();
    };
    let ticks = arguments.get(2).and_then(|ticks| ticks.parse().ok()).unwrap_or(scenario.ticks());
    let told = match arguments.get(4).map(String::as_str) {
        None => whole(&scenario, ticks),
        Some("alone") => alone(&scenario, ticks),
        Some(_) => None,
    };
    let Some(told) = told else { return usage() };
    // Nobody listens if this fails.
    let _ = std::io::stdout().write_all(told.as_bytes());
    ExitCode::SUCCESS
}

/// The world with its monitors.
fn whole(scenario: &Scenario, ticks: u32) -> Option<String> {
    let options = Options { without_phi: true, digest: true, ..Options::default() };
    let mut world = World::<2>::new(scenario, options).ok()?;
    for _ in 0..ticks {
        world.step();
    }
    let (links, liars, robots) = (world.frame().links, scenario.malicious.len(), scenario.team.robots);
    let broken = world.monitors().verdicts().iter().filter(|verdict| verdict.count > 0);
    let broken: Vec<String> = broken.map(|verdict| format!("{verdict:?}\n")).collect();
    let (void, extremes) = (world.monitors().void(), world.monitors().extremes());
    Some(format!(
        "{robots} robots, {liars} liars, {links} links after {ticks} ticks\n{}{void:?}\n{extremes:?}\ndigest {:016x}\n",
        broken.concat(),
        world.digest().unwrap_or(0)
    ))
}

/// Computes the robots of a tick.
type Step = Box<dyn FnMut(&mut Frame<2>, &mut Liars)>;

/// The engine that computes a whole team, and bodies that follow.
fn alone(scenario: &Scenario, ticks: u32) -> Option<String> {
    let params = scenario.params::<2>().ok()?;
    let values = initial_values(scenario).ok()?;
    let mut frame = Frame::new(scenario.positions::<2>().ok()?, values.clone());
    let mut liars = Liars::new(scenario);
    let mut bodies = Bodies::new(scenario.plant, scenario.tick_s(), &frame.positions_m);
    let mut step: Step = if let Some(links) = params.controller().lists() {
        let mut team = Held::new(scenario, params, links, &values);
        Box::new(move |frame, liars| team.step(frame, liars, &Alone))
    } else {
        let AnyController::Budget(budget) = *params.controller() else { return None };
        let mut team = Team::new(scenario, params, budget, &values);
        Box::new(move |frame, liars| team.step(frame, liars, &Alone))
    };
    for tick in 0..ticks {
        want(scenario, tick, &mut frame);
        frame.asked_m_s.clone_from(&frame.desired_m_s);
        step(&mut frame, &mut liars);
        bodies.integrate(&mut frame.positions_m, &frame.velocities_m_s);
    }
    let neighbors = 2.0 * f64::from(frame.links) / f64::from(scenario.team.robots);
    Some(format!("{neighbors:.1} neighbours each\n"))
}

/// The scenario of a file, with another number of robots and another controller if they are given.
fn read(file: &str, others: &[String]) -> Option<Scenario> {
    let mut text = std::fs::read_to_string(file).ok()?;
    if let Some(robots) = others.first() {
        let liars = robots.parse::<u16>().ok()? / 25;
        text = text.replace("robots = 10000", &format!("robots = {robots}"));
        text = text.replace("local = 400", &format!("local = {liars}"));
    }
    if let Some(controller) = others.get(2) {
        text = text.replace("kind = \"links\"", &format!("kind = \"{controller}\""));
    }
    let read = scenario(&text);
    read.map_err(|problems| problems.iter().for_each(|problem| eprintln!("{problem}"))).ok()
}

fn usage() -> ExitCode {
    eprintln!("swarm FILE [ROBOTS [TICKS [links|budget [alone]]]]");
    ExitCode::from(2)
}
