//! A team of `links` that begins anew where its links end. The page lets people touch a run, which makes a new start of where the robots
//! are: four robots that had just enough neighbours lost one within two ticks. Rounding had taken their longest links beyond R_h by less
//! than a millionth of a micrometre, so nobody listed them any more.

use closeranks_sim::law::Law;
use closeranks_sim::parse;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::world::{Options, World, run};

const TEAM: &str = "
duration_s = 12.0

[team]
robots = 40
faults = 2
malicious = [1]
RULE

[controller]
kind = \"links\"

[clock]
tau_1_s = 0.02

[motion]
kind = \"outward\"
";

/// Where the robots of a scenario are at these times, s.
fn places(scenario: &Scenario, times_s: &[f64]) -> Vec<Vec<Vec<f64>>> {
    let mut world = World::<2>::new(scenario, Options::default()).expect("a world");
    let mut places = Vec::new();
    while !world.is_over() {
        let positions_m = world.step().positions_m.iter().map(|place| place.to_vec()).collect();
        let time_s = f64::from(world.ticks_done() - 1) * scenario.tick_s();
        if times_s.iter().any(|at_s| (at_s - time_s).abs() < 0.5 * scenario.tick_s()) {
            places.push(positions_m);
        }
    }
    places
}

/// How many ticks of how many new starts had a robot with too few neighbours.
fn short(ranks: &str) -> (u64, usize) {
    let scenario = parse::scenario(&TEAM.replace("RULE", ranks)).expect("a scenario");
    let starts = places(&scenario, &[2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0, 11.9]);
    let anew = |positions_m: &Vec<Vec<f64>>| {
        let start = Start::Listed(positions_m.clone());
        let scenario = Scenario { start, duration_s: 1.0, ..scenario.clone() };
        let run = run(&scenario, Options::default(), &mut |_| ()).expect("a run");
        run.summary.verdicts.of(Law::Degree).count
    };
    (starts.iter().map(anew).sum(), starts.len())
}

#[test]
fn a_team_that_begins_anew_at_its_limit_keeps_its_links() {
    assert_eq!(short(""), (0, 8));
}

#[test]
fn so_does_one_with_ranks() {
    assert_eq!(short("ranks = { core = 7 }"), (0, 8));
}
