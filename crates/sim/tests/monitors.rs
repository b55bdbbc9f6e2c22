//! Every law can be broken, and is then named with tick, robots and amount.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::settings::{Clock, LinkSettings, Team};
use core::time::Duration;

use closeranks_core::program::Outcome;
use closeranks_sim::attack::{LevelAttack, ValueAttack};
use closeranks_sim::faults::Spell;
use closeranks_sim::frame::Frame;
use closeranks_sim::law::{Law, Violation};
use closeranks_sim::monitors::Monitors;
use closeranks_sim::output::summary::Summary;
use closeranks_sim::scenario::start::Start;
use closeranks_sim::scenario::{Controller, Scenario, Values};
use closeranks_sim::world::{Options, run};

fn summary(scenario: &Scenario) -> Summary {
    run(scenario, Options::default(), &mut |_| ()).unwrap().summary
}

fn first(summary: &Summary, law: Law) -> Violation {
    summary.verdicts.of(law).first.expect("was broken")
}

#[test]
fn without_a_filter_degrees_and_distances_go() {
    let summary = summary(&Scenario { controller: Controller::None, ..Scenario::default() });
    let degree = first(&summary, Law::Degree);
    assert_eq!((degree.seen, degree.demanded), (6.0, 7.0));
    let distance = first(&summary, Law::Distance);
    assert!(distance.seen < distance.demanded && distance.robots[0] < distance.robots[1]);
    assert!(summary.broken(Law::Composition) > 0);
    assert_eq!(summary.broken(Law::Feasible), 0, "no program is solved");
    assert_eq!(summary.extremes.safe_from, None);
}

/// docs/theory, sec:wide-attacks: at 50 ms ticks `composed` fails with no attack at all.
#[test]
fn slow_ticks_break_the_papers_controller() {
    let slow = Scenario {
        malicious: Vec::new(),
        attack: ValueAttack::None.into(),
        clock: Clock { level_period: Duration::from_millis(50), ..Clock::default() },
        link: LinkSettings { q2: 0.9, ..LinkSettings::default() },
        ..Scenario::default()
    };
    let summary = summary(&slow);
    assert!(summary.broken(Law::Degree) > 0 || summary.broken(Law::Distance) > 0);
}

#[test]
fn more_liars_than_f_pull_values_out_of_their_interval() {
    let values = Values::Random { min: 0.0, max: 1.0 };
    let attack = ValueAttack::Random { min: 100.0, max: 200.0 };
    let team = Scenario { values, attack: attack.into(), malicious: vec![1, 2, 3], ..Scenario::default() };
    let summary = summary(&team);
    let interval = first(&summary, Law::Interval);
    assert!(interval.seen > interval.demanded && interval.demanded <= 1.0);
    assert!(summary.broken(Law::Agreement) > 0, "and the spread grows");
}

#[test]
fn an_understated_level_beyond_reach_makes_programs_infeasible() {
    let scenario = Scenario { attack: LevelAttack::Bias(-6.0).into(), ..Scenario::default() };
    assert!(summary(&scenario).broken(Law::Feasible) > 0);
    assert!(!summary(&scenario).start.inside);
}

/// The program of robot 4 has no solution when it crashes. That does not count again in every tick in which it is down.
#[test]
fn a_robot_that_is_down_breaks_nothing_again_and_again() {
    let mut scenario = Scenario { attack: LevelAttack::Bias(-6.0).into(), ..Scenario::default() };
    scenario.faults.outages.crash = Some(Spell { robot: 4, from_s: 0.05, to_s: 100.0 });
    let run = run(&scenario, Options { record: true, ..Options::default() }, &mut |_| ()).unwrap();
    let record = run.record.unwrap();
    let found = |tick| (record.outcome[record.row(tick, 3)], record.phi[record.row(tick, 3)] < 0.0);
    assert_eq!((found(9), found(10)), ((Outcome::Infeasible, true), (Outcome::Free, false)));
    let infeasible = record.outcome.iter().filter(|outcome| **outcome == Outcome::Infeasible).count();
    let negative = record.phi.iter().filter(|phi| **phi < 0.0).count();
    let told = [Law::Feasible, Law::Shares].map(|law| run.summary.broken(law));
    assert_eq!(told, [infeasible, negative].map(|count| count as u64));
}

/// A start is inside if every φ_i is known and not negative.
#[test]
fn a_start_with_a_robot_down_is_not_called_inside() {
    let mut scenario = Scenario { duration_s: 0.5, ..Scenario::default() };
    assert!(summary(&scenario).start.inside);
    scenario.faults.outages.crash = Some(Spell { robot: 4, from_s: 0.0, to_s: 0.1 });
    let summary = summary(&scenario);
    assert_eq!((summary.start.inside, summary.extremes.inside_from), (false, Some(20)));
}

/// Inputs outside their box cannot come from a controller of ours, so the monitor is given a frame of its own.
#[test]
fn an_input_outside_its_box_is_named_with_its_component() {
    let scenario =
        Scenario { malicious: Vec::new(), team: Team { robots: 2, faults: 0 }, ..Scenario::default() };
    let mut frame = Frame::new(vec![[0.0, 0.0], [1.0, 0.0]], vec![0.0, 0.0]);
    frame.velocities_m_s[1] = [0.2, -1.6];
    frame.outcomes[1] = Outcome::Active;
    let mut monitors = Monitors::<2>::new(&scenario, scenario.params().unwrap());
    monitors.watch(3, &frame);
    let verdict = *monitors.verdicts().of(Law::Input);
    assert_eq!(verdict.first, Some(Violation { tick: 3, robots: [2, 0], seen: -1.6, demanded: -1.5 }));
    frame.velocities_m_s[1] = [f64::NAN, 0.0];
    monitors.watch(4, &frame);
    assert_eq!(monitors.verdicts().of(Law::Input).count, 2);
}

#[test]
fn a_random_start_says_whether_it_is_safe() {
    let crowd = Start::Random { half_side_m: 0.7, distance_min_m: 0.3 };
    let wide = Start::Random { half_side_m: 1.2, distance_min_m: 0.55 };
    assert!(!summary(&Scenario { start: crowd, duration_s: 0.0, ..Scenario::default() }).start.inside);
    assert!(summary(&Scenario { start: wide, duration_s: 0.0, ..Scenario::default() }).start.inside);
}
