//! Robots that come and go within the roster: what holds meanwhile, and what is held against nobody.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::program::Outcome;
use closeranks_core::robot::report::{Mode, Reason};
use closeranks_sim::law::Law;
use closeranks_sim::output::attendance::{Attendance, Refused};
use closeranks_sim::output::summary::Summary;
use closeranks_sim::parse;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::desired::Desired;
use closeranks_sim::sweep::Plan;
use closeranks_sim::world::{Engine, Options, World, initial_values, run};

const SHIFT: &str = include_str!("../../../scenarios/shift.toml");
const CAMPAIGN: &str = include_str!("../../../scenarios/campaign-presence.toml");

fn shift(controller: &str) -> Scenario {
    parse::scenario(&SHIFT.replace("\"budget\"", &format!("\"{controller}\""))).unwrap()
}

/// Nine robots near each other who want to rest, F = 1, ticks of 20 ms, and who is absent.
fn resting(controller: &str, absent: &str) -> Scenario {
    let text = format!(
        "duration_s = 3.0\n[team]\nrobots = 9\nfaults = 1\nmalicious = []\nabsent = [{absent}]\n[controller]\n\
         kind = \"{controller}\"\n[clock]\ntau_1_s = 0.02\n[motion]\nkind = \"hold\"\n"
    );
    parse::scenario(&text).unwrap()
}

fn summary(scenario: &Scenario) -> Summary {
    run(scenario, Options::default(), &mut |_| ()).unwrap().summary
}

/// The world at a tick.
fn at_tick(scenario: &Scenario, tick: u32) -> World<2> {
    let mut world = World::<2>::new(scenario, Options::default()).unwrap();
    while world.ticks_done() <= tick {
        world.step();
    }
    world
}

#[test]
fn a_shift_changes_and_everything_holds() {
    for controller in ["budget", "links"] {
        let scenario = shift(controller);
        let summary = summary(&scenario);
        let broken: Vec<_> = summary.failures(&scenario).collect();
        assert!(broken.is_empty(), "{controller}: {broken:?}");
        let Attendance { left, arrived, .. } = summary.attendance;
        assert_eq!((left, arrived), (3, 3), "{controller}");
        assert!(summary.extremes.spread < 1.0, "{controller}: values of those who came are taken up");
    }
}

//= theory sec:departures type=test
#[test]
fn who_is_absent_has_no_body_and_no_voice() {
    for controller in ["budget", "links", "composed", "none"] {
        let world =
            at_tick(&resting(controller, "{ robot = 4, from_s = 1.0, to_s = 2.0, at_m = [0.0, 1.4] }"), 60);
        let frame = world.frame();
        assert!(frame.positions_m[3].iter().all(|x| x.is_nan()), "{controller}");
        assert_eq!((frame.degrees[3], frame.down[3], frame.velocities_m_s[3]), (0, true, [0.0; 2]));
        for other in (0..9).filter(|other| *other != 3) {
            assert_eq!(frame.degrees[other], 7, "{controller}: all but robot 4 are in range");
            assert!(!frame.counted[other].contains(&4) && !frame.rows[other].contains(&4), "{controller}");
            assert!(frame.heard[other][0] <= 7, "{controller}");
        }
        assert_eq!(frame.links, 28);
        let snapshot = world.snapshot().unwrap();
        assert!(snapshot.h(3).is_nan() && snapshot.value[3].is_nan() && snapshot.told(3).is_nan());
        let there = at_tick(world.scenario(), 101);
        assert_eq!(there.frame().degrees[3], 8, "{controller}");
    }
}

/// All together, or each by itself with every message as bytes.
#[test]
fn both_engines_give_the_same_bits() {
    for controller in ["budget", "links", "composed"] {
        let scenario = Scenario { duration_s: 6.5, ..shift(controller) };
        let digest = |engine| {
            let options = Options { digest: true, engine, ..Options::default() };
            run(&scenario, options, &mut |_| ()).unwrap().digest
        };
        assert_eq!(digest(Engine::Team), digest(Engine::Robots), "{controller}");
    }
}

/// Where it has enough neighbours a robot that comes promises at once; else it says that it does not, and all others go on promising.
//= theory sec:arrivals type=test
#[test]
fn who_comes_begins_anew_and_promises_when_it_is_connected() {
    for (at, connected) in [("[2.6, 0.0]", true), ("[3.2, 0.0]", false)] {
        let scenario = resting("budget", &format!("{{ robot = 7, to_s = 0.5, at_m = {at} }}"));
        let world = at_tick(&scenario, 25);
        let frame = world.frame();
        assert!(frame.presence.arrived[6] && frame.held[6] == initial_values(&scenario).unwrap()[6]);
        let expected = if connected {
            (Outcome::Free, Mode::Guaranteed)
        } else {
            (Outcome::Recovering, Mode::Degraded(Reason::Degree))
        };
        assert_eq!((frame.outcomes[6], frame.modes[6]), expected);
        let others = frame.modes.iter().enumerate().filter(|(robot, _)| *robot != 6);
        assert!(others.into_iter().all(|(_, mode)| *mode == Mode::Guaranteed));
    }
}

/// Under `links` one that comes at the rim and wishes to gather is counted on soon.
//= theory sec:arrivals type=test
#[test]
fn who_comes_at_the_rim_is_taken_in_by_links() {
    let absent = "{ robot = 7, to_s = 0.5, at_m = [3.2, 0.0] }";
    let scenario = Scenario { desired: Desired::Gather, ..resting("links", absent) };
    let modes = [25, 140].map(|tick| at_tick(&scenario, tick).frame().modes[6]);
    assert_eq!(modes, [Mode::Degraded(Reason::Uncounted), Mode::Guaranteed]);
}

#[test]
fn who_finds_its_place_taken_waits_and_says_why() {
    let scenario = resting("budget", "{ robot = 7, from_s = 0.5, to_s = 1.0, at_m = [0.0, 0.1] }");
    let Attendance { left, arrived, refused, first } = summary(&scenario).attendance;
    assert_eq!((left, arrived, refused), (1, 0, 101));
    let Some((50, 7, Refused::Robot { other: 1, distance_m, needed_m })) = first else { panic!("{first:?}") };
    assert!((distance_m - 0.1).abs() < 0.01 && needed_m == 0.3);
    let drawn = resting("budget", "{ robot = 7, from_s = 0.5, to_s = 1.0 }");
    assert_eq!(summary(&drawn).attendance, Attendance { left: 1, arrived: 1, refused: 0, first: None });
    assert_eq!(at_tick(&drawn, 120).frame().positions_m, at_tick(&drawn, 120).frame().positions_m);
}

/// A robot that leaves takes its link along and nothing else: at most half of q1 of anybody's h.
//= theory sec:departures type=test
#[test]
fn a_departure_takes_no_more_than_one_weight() {
    let scenario = resting("budget", "{ robot = 4, from_s = 1.0 }, { robot = 6, from_s = 1.0 }");
    let most = 0.5 * scenario.link_shape().unwrap().q1;
    let [before, after] = [49, 50].map(|tick| at_tick(&scenario, tick).frame().h.clone());
    for robot in (0..9).filter(|robot| ![3, 5].contains(robot)) {
        let fell = before[robot] - after[robot];
        assert!(fell > 1.0 && fell <= 2.0 * most + 1e-9, "robot {} lost {fell}", robot + 1);
    }
    assert!(after[3].is_nan());
}

/// Where more leave than h has room for it is negative, and nobody is to blame; those who are left say so.
#[test]
fn too_many_departures_are_held_against_nobody() {
    for controller in ["budget", "links"] {
        let absent: Vec<String> =
            (5..9).map(|robot| format!("{{ robot = {robot}, from_s = 1.0 }}")).collect();
        let scenario = resting(controller, &absent.join(", "));
        let summary = summary(&scenario);
        assert!(summary.broken(Law::Degree) > 0, "{controller}");
        assert_eq!(summary.violations(&scenario).count(), 0, "{controller}");
        let world = at_tick(&scenario, 148);
        let left = 0..4;
        assert!(left.into_iter().all(|robot| world.frame().modes[robot] != Mode::Guaranteed), "{controller}");
    }
}

/// Nobody is told: neighbours reckon with who left for as long as it could not have walked away, and the world knows that this is wrong.
#[test]
fn a_silent_departure_breaks_an_assumption_for_as_long_as_it_is_not_noticed() {
    for controller in ["budget", "links"] {
        let scenario = resting(
            controller,
            "{ robot = 4, from_s = 1.0, to_s = 2.9, at_m = [0.0, 1.4], leaves = \"silently\" }",
        );
        let mut world = World::<2>::new(&scenario, Options::default()).unwrap();
        let mut ghosts = Vec::new();
        for tick in 0..145 {
            let frame = world.step();
            ghosts.extend(frame.assumptions.broken.then_some(tick));
        }
        assert_eq!(ghosts.first(), Some(&50), "{controller}");
        assert!(ghosts.len() > 10 && *ghosts.last().unwrap() < 144, "{controller}: {ghosts:?}");
        assert_eq!(world.finish().summary.violations(&scenario).count(), 0, "{controller}");
    }
}

#[test]
fn what_cannot_be_run_is_refused_with_its_place() {
    let refused = |table: &str, more: &str| {
        let text = format!("{more}\n[team]\nabsent = [{table}]\n");
        parse::scenario(&text).expect_err(table)[0].to_string()
    };
    for (table, more, part) in [
        ("{ from_s = 1.0 }", "", "`team.absent[0].robot` is not there, allowed is a whole number, 1 to 11"),
        ("{ robot = 12 }", "", "`team.absent[0].robot` is 12, allowed is a whole number, 1 to 11"),
        ("{ robot = 1, from_s = 2.0, to_s = 2.0 }", "", "`team.absent[0].to_s` is 2.0"),
        ("{ robot = 1, at_m = [1.0] }", "", "`team.absent[0].at_m` is a list of 1, allowed is 2 numbers"),
        ("{ robot = 1, leaves = \"now\" }", "", "`announced`, `silently`"),
        ("{ robot = 1, when = 1 }", "", "`team.absent[0].when` is not a field here"),
        ("3", "", "`team.absent[0]` is 3, allowed is a table"),
        (
            "{ robot = 2, from_s = 1.0 }, { robot = 2, from_s = 3.0 }",
            "",
            "robot 2 leaves at 3 s, while it is away",
        ),
        ("{ robot = 1 }", "controller.kind = \"orca\"", "only under budget, composed, links, none"),
        ("{ robot = 1 }", "consensus.rule = \"two-hop\"", "rules of robots"),
        (
            "{ robot = 1, to_s = 1.0, at_m = [9.0, 0.0] }",
            "obstacles.discs = [[9.0, 0.0, 1.0]]",
            "team.absent",
        ),
    ] {
        let told = refused(table, more);
        assert!(told.contains(part), "{table}: {told}");
    }
}

/// The first draws of the campaign; sweeps make thousands.
#[test]
fn nothing_that_is_promised_is_broken_in_drawn_teams() {
    let plan = Plan::read(CAMPAIGN).unwrap();
    let mut arrived = 0;
    for number in 0..6 {
        let drawn = plan.draw(7, number).unwrap();
        for (scenario, _) in drawn.scenarios.iter().filter(|(one, _)| one.controller.row().guarantees) {
            let summary = summary(scenario);
            let broken: Vec<_> = summary.violations(scenario).collect();
            assert!(broken.is_empty(), "run {number} {:?}: {broken:?}", scenario.controller);
            arrived += summary.attendance.arrived;
        }
    }
    assert!(arrived > 4, "{arrived}");
}
