//! Ticks of whole teams, all in range of each other, and the paper's run.
//!
//! `cargo bench -p closeranks-sim`

use core::time::Duration;

use closeranks_core::controller::AnyController;
use closeranks_core::settings::params::Params;
use closeranks_core::settings::{self, Clock, LinkSettings};
use closeranks_sim::attack::LevelAttack;
use closeranks_sim::attack::liars::Liars;
use closeranks_sim::engine::fleet::Fleet;
use closeranks_sim::engine::held::Held;
use closeranks_sim::engine::team::Team;
use closeranks_sim::engine::workers::Alone;
use closeranks_sim::frame::Frame;
use closeranks_sim::parse;
use closeranks_sim::plant::Bodies;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::any::AnyGiven;
use closeranks_sim::world::block::Block;
use closeranks_sim::world::{Options, initial_values, run, want};
use divan::Bencher;

fn main() {
    divan::main();
}

/// A hexagonal patch of spacing 0.6 m; the radius covers it all.
fn scenario(robots: u16) -> Scenario {
    let radius_m = match robots {
        11 => 3.0,
        100 => 7.0,
        _ => 22.0,
    };
    Scenario {
        start: Start::Hexagon { spacing_m: 0.6 },
        team: settings::Team { robots, ..settings::Team::default() },
        link: LinkSettings { radius_m, ..LinkSettings::default() },
        ..Scenario::default()
    }
}

fn world(scenario: &Scenario) -> (Params<2>, Frame<2>, Vec<f64>) {
    let params = scenario.params().expect("valid");
    let values = initial_values(scenario).expect("drawn");
    let positions = scenario.positions().expect("a hexagon");
    (params, Frame::new(positions, values.clone()), values)
}

/// Sense, share, all robots, integrate; consensus every twentieth tick; monitors off.
#[divan::bench(args = [11, 100, 1_000])]
fn tick_of_a_team(bencher: Bencher<'_, '_>, robots: u16) {
    let scenario = scenario(robots);
    let (params, mut frame, values) = world(&scenario);
    let AnyController::Composed(composed) = *params.controller() else { return };
    let mut team = Team::new(&scenario, params, composed, &values);
    let mut liars = Liars::new(&scenario);
    let mut bodies = Bodies::new(scenario.plant, scenario.tick_s(), &frame.positions_m);
    bencher.bench_local(|| {
        want(&scenario, 0, &mut frame);
        team.step(&mut frame, &mut liars, &Alone);
        bodies.integrate(&mut frame.positions_m, &frame.velocities_m_s);
    });
    let links = u32::from(robots) * u32::from(robots - 1) / 2;
    assert!(frame.links * 10 > links * 9, "nearly all in range: {} of {links}", frame.links);
}

/// A tick of a thousand robots of `budget` of which each sees about 0.7 of the others.
#[divan::bench]
fn tick_of_a_team_of_budget_in_part(bencher: Bencher<'_, '_>) {
    let scenario = in_part(Controller::Budget);
    let (params, frame, values) = world(&scenario);
    let AnyController::Budget(budget) = *params.controller() else { return };
    let mut team = Team::new(&scenario, params, budget, &values);
    tick_in_part(bencher, &scenario, frame, |frame, liars| team.step(frame, liars, &Alone));
}

/// The same under `links`.
#[divan::bench]
fn tick_of_a_team_of_links_in_part(bencher: Bencher<'_, '_>) {
    let scenario = in_part(Controller::Links);
    let (params, frame, values) = world(&scenario);
    let AnyController::Links(links) = *params.controller() else { return };
    let mut team = Held::new(&scenario, params, links, &values);
    tick_in_part(bencher, &scenario, frame, |frame, liars| team.step(frame, liars, &Alone));
}

/// A tick of a swarm that pulls outwards (`scenarios/swarm.toml`) with so many robots at equal density; every second tick has a round.
#[divan::bench(args = [100, 1_000, 10_000])]
fn tick_of_a_swarm_of_links(bencher: Bencher<'_, '_>, robots: u16) {
    let scenario = swarm("links", robots);
    let (params, frame, values) = world(&scenario);
    let AnyController::Links(links) = *params.controller() else { return };
    let mut team = Held::new(&scenario, params, links, &values);
    tick_of_a_swarm(bencher, &scenario, frame, |frame, liars| team.step(frame, liars, &Alone));
}

/// The same under `budget`.
#[divan::bench(args = [100, 1_000, 10_000])]
fn tick_of_a_swarm_of_budget(bencher: Bencher<'_, '_>, robots: u16) {
    let scenario = swarm("budget", robots);
    let (params, frame, values) = world(&scenario);
    let AnyController::Budget(budget) = *params.controller() else { return };
    let mut team = Team::new(&scenario, params, budget, &values);
    tick_of_a_swarm(bencher, &scenario, frame, |frame, liars| team.step(frame, liars, &Alone));
}

fn swarm(controller: &str, robots: u16) -> Scenario {
    let text = include_str!("../../../scenarios/swarm.toml");
    let text = text.replace("robots = 10000", &format!("robots = {robots}"));
    let text = text.replace("local = 400", &format!("local = {}", robots / 25));
    parse::scenario(&text.replace("\"links\"", &format!("\"{controller}\""))).expect("a valid scenario")
}

fn tick_of_a_swarm(
    bencher: Bencher<'_, '_>,
    scenario: &Scenario,
    mut frame: Frame<2>,
    mut step: impl FnMut(&mut Frame<2>, &mut Liars),
) {
    let mut liars = Liars::new(scenario);
    let mut bodies = Bodies::new(scenario.plant, scenario.tick_s(), &frame.positions_m);
    bencher.bench_local(|| {
        want(scenario, 0, &mut frame);
        frame.asked_m_s.clone_from(&frame.desired_m_s);
        step(&mut frame, &mut liars);
        bodies.integrate(&mut frame.positions_m, &frame.velocities_m_s);
    });
    let neighbors = 2.0 * f64::from(frame.links) / f64::from(scenario.team.robots);
    assert!(neighbors > 10.0, "each has more than ten neighbours: {neighbors}");
}

fn in_part(controller: Controller) -> Scenario {
    let link = LinkSettings { radius_m: 11.5, ..LinkSettings::default() };
    Scenario { controller, link, ..scenario(1_000) }
}

fn tick_in_part(
    bencher: Bencher<'_, '_>,
    scenario: &Scenario,
    mut frame: Frame<2>,
    mut step: impl FnMut(&mut Frame<2>, &mut Liars),
) {
    let mut liars = Liars::new(scenario);
    let mut bodies = Bodies::new(scenario.plant, scenario.tick_s(), &frame.positions_m);
    bencher.bench_local(|| {
        want(scenario, 0, &mut frame);
        step(&mut frame, &mut liars);
        bodies.integrate(&mut frame.positions_m, &frame.velocities_m_s);
    });
    let seen = f64::from(frame.links) / (0.5 * 1e6);
    assert!((0.65..0.75).contains(&seen), "each sees about 0.7 of the others: {seen}");
}

/// A tick with every robot on its own and every message as bytes.
#[divan::bench(args = [11, 100])]
fn tick_of_single_robots(bencher: Bencher<'_, '_>, robots: u16) {
    let scenario = scenario(robots);
    let (params, mut frame, values) = world(&scenario);
    let mut fleet = Fleet::new(&scenario, params, &values).expect("robots of a valid scenario");
    let mut liars = Liars::new(&scenario);
    let mut bodies = Bodies::new(scenario.plant, scenario.tick_s(), &frame.positions_m);
    bencher.bench_local(|| {
        want(&scenario, 0, &mut frame);
        fleet.step(&mut frame, &mut liars);
        bodies.integrate(&mut frame.positions_m, &frame.velocities_m_s);
    });
}

/// A tick of sixteen worlds of section V, monitors on, side by side in a block (true) or each alone.
#[divan::bench(args = [true, false])]
fn sixteen_worlds(bencher: Bencher<'_, '_>, together: bool) {
    let seeds: Vec<u64> = (0..16).collect();
    let blocks = seeds.chunks(if together { Block::MOST } else { 1 });
    let blocks = blocks.map(|seeds| Block::new(&Scenario::default(), seeds, Options::default()));
    let mut blocks: Vec<Block> = blocks.collect::<Result<_, _>>().expect("a valid scenario");
    assert!(blocks.iter().all(|block| block.is_in_lanes() == together));
    bencher.bench_local(|| {
        for block in &mut blocks {
            block
                .step_with(&[AnyGiven::default(); Block::MOST][..block.worlds().len()])
                .expect("nothing is given");
        }
    });
}

/// Ten seconds of section V, monitors on, no record.
#[divan::bench]
fn paper_run(bencher: Bencher<'_, '_>) {
    let scenario = Scenario::default();
    bencher.bench(|| run(&scenario, Options::default(), &mut |_| ()).expect("runs"));
}

/// Ten seconds of section V, monitors on, with every tick kept.
#[divan::bench]
fn paper_run_recorded(bencher: Bencher<'_, '_>) {
    let scenario = Scenario::default();
    bencher
        .bench(|| run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).expect("runs"));
}

/// Ten seconds of `links` in the paper's world, monitors on, as sweeps run it.
#[divan::bench]
fn links_run(bencher: Bencher<'_, '_>) {
    let scenario = Scenario { controller: Controller::Links, ..Scenario::default() };
    let options = Options { without_phi: true, ..Options::default() };
    bencher.bench(|| run(&scenario, options, &mut |_| ()).expect("runs"));
}

/// The same in ticks of 20 ms, as teams that talk have them: 500 ticks.
#[divan::bench]
fn links_run_of_20_ms(bencher: Bencher<'_, '_>) {
    let plain = Scenario { controller: Controller::Links, ..Scenario::default() };
    let clock = Clock { level_period: Duration::from_millis(20), ..plain.clock };
    let scenario = Scenario { clock, ..plain };
    let options = Options { without_phi: true, ..Options::default() };
    bencher.bench(|| run(&scenario, options, &mut |_| ()).expect("runs"));
}

/// Ten seconds of `budget` against the overstating liars (`scenarios/budget.toml`), monitors on, as sweeps run it.
#[divan::bench]
fn budget_run(bencher: Bencher<'_, '_>) {
    let (controller, level_attack) = (Controller::Budget, LevelAttack::Bias(3.5));
    let scenario = Scenario { controller, attack: level_attack.into(), ..Scenario::default() };
    let options = Options { without_phi: true, ..Options::default() };
    bencher.bench(|| run(&scenario, options, &mut |_| ()).expect("runs"));
}
