//! Teams among still obstacles, and speed limits in any direction.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::num::length;
use closeranks_sim::law::Law;
use closeranks_sim::output::summary::Summary;
use closeranks_sim::parse;
use closeranks_sim::scenario::desired::Desired;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::{Engine, Options, RunError, World, run};

const DRAWN: &str = "[obstacles]\nclearance_m = 0.1\n\
     drawn = { discs = 4, walls = 4, size_min_m = 0.05, size_max_m = 0.6, half_side_m = 2.0 }\n";

fn scenario(controller: &str, more: &str) -> Scenario {
    let text = format!(
        "duration_s = 3.0\n[controller]\nkind = \"{controller}\"\n{more}\n\
         [clock]\ntau_1_s = 0.02\n[motion]\nkind = \"outward\"\n"
    );
    parse::scenario(&text).unwrap()
}

fn summary(scenario: &Scenario) -> Summary {
    run(scenario, Options::default(), &mut |_| ()).unwrap().summary
}

//= theory thm:clear type=test
//= theory sec:obstacles-composed type=test
#[test]
fn nothing_that_is_promised_is_broken_among_obstacles() {
    let worlds = [
        String::new(),
        "speed_max_m_s = 1.0\n[plant]\nlook_ahead_m = 0.05\n".to_owned(),
        "position_error_m = 0.01\n[sensing]\nnoise_m = 0.01\n".to_owned(),
        "tracking_error_m = 0.043\n[plant]\nlag_s = 0.02\n".to_owned(),
    ];
    let mut stopped = 0;
    for controller in ["budget", "links", "composed"] {
        for (world, seed) in worlds.iter().zip(1..) {
            let scenario = Scenario { seed, ..scenario(controller, &format!("{world}{DRAWN}")) };
            assert!(!scenario.obstacles.list.is_empty() && scenario.expect.contains(&Law::Clear));
            let summary = summary(&scenario);
            assert_eq!(summary.verdicts.of(Law::Clear).covered, 0, "{controller} {world}");
            if scenario.controller.row().guarantees {
                assert_eq!(summary.violations(&scenario).count(), 0, "{controller} {world}: {summary:?}");
                assert_eq!(summary.broken(Law::Clear), 0, "{controller} {world}");
            }
            stopped += u32::from(summary.extremes.clear_min_m < 0.1 + 0.05);
        }
    }
    assert!(stopped >= 4, "in {stopped} worlds somebody meets an obstacle");
}

#[test]
fn without_a_controller_robots_run_into_obstacles_and_that_is_counted() {
    let run = summary(&scenario("none", "[obstacles]\ndiscs = [[2.5, 0.1, 0.5], [-2.0, -0.2, 0.4]]\n"));
    assert!(run.broken(Law::Clear) > 0 && run.extremes.clear_min_m < 0.0);
}

#[test]
fn both_engines_give_the_same_bits_among_obstacles_and_under_a_disc() {
    for controller in ["budget", "links", "composed", "none"] {
        let scenario = scenario(controller, &format!("speed_max_m_s = 0.9\n{DRAWN}"));
        let digest = |engine| {
            run(&scenario, Options { digest: true, engine, ..Options::default() }, &mut |_| ())
                .unwrap()
                .digest
        };
        assert_eq!(digest(Engine::Team), digest(Engine::Robots), "{controller}");
    }
}

/// A disc is met in every direction and exactly: where the box lets robots go faster along its diagonal, the disc does not.
//= theory sec:disc type=test
#[test]
fn no_velocity_is_longer_than_the_disc_allows_and_some_are_as_long() {
    for controller in ["budget", "links", "composed", "none"] {
        let scenario = scenario(controller, "speed_max_m_s = 0.8\n");
        let mut world = World::<2>::new(&scenario, Options::default()).unwrap();
        let mut fastest = 0.0_f64;
        for _ in 0..20 {
            let speeds = world.step().velocities_m_s.iter().map(length);
            fastest = speeds.fold(fastest, f64::max);
        }
        assert!(fastest <= 0.8 && fastest > 0.8 - 1e-9, "{controller}: {fastest}");
        assert_eq!(summary(&scenario).broken(Law::Input), 0, "{controller}");
    }
}

#[test]
fn a_start_in_the_way_and_a_controller_without_rows_for_obstacles_are_refused_with_their_place() {
    let refused = |text: &str| {
        let problems = parse::scenario(text).unwrap_err();
        assert_eq!(problems.len(), 1, "{problems:?}");
        (problems[0].to_string(), text[problems[0].span.clone()].to_owned())
    };
    let (told, place) = refused(
        "[controller]\nkind = \"composed\"\n[obstacles]\nwalls = [[9, 0, 9, 1], [-1, 0.1, 1, 0.1]]\n",
    );
    assert!(told.starts_with("`obstacles.walls[1]` is ") && told.contains("robot"), "{told}");
    assert_eq!(place, "[-1, 0.1, 1, 0.1]");
    let listed = "[team]\nrobots = 2\nfaults = 0\n[start]\nkind = \"listed\"\npositions_m = [[0, 0], [1, 0]]\n\
                  [obstacles]\ndiscs = [[1.4, 0, 0.3]]\n";
    let (told, place) = refused(listed);
    assert!(told.starts_with("`start.positions_m[1]` is 0.1000 m between the start of robot 2"), "{told}");
    assert_eq!(place, "[1, 0]");
    let (told, _) = refused("[controller]\nkind = \"budget\"\n[obstacles]\ndiscs = [[0, 0.1, 0.2]]\n");
    assert!(told.ends_with("allowed is at least 0 m: outside of obstacles"), "{told}");
    let (told, _) = refused("[controller]\nkind = \"orca\"\n[obstacles]\ndiscs = [[9, 9, 1]]\n");
    assert!(told.ends_with("allowed is only under budget, composed, links, none"), "{told}");
    let among = scenario("budget", "[obstacles]\ndiscs = [[9, 9, 1]]\n").under(Controller::Orca);
    assert!(matches!(World::<2>::new(&among, Options::default()), Err(RunError::Obstacles(_))));
}

/// A wall between robots that wish to rest, nearer to some than they may be: they go away from it and say so, nobody else moves, and
/// nothing counts as broken. It was refused once, and a robot that was pushed there stayed there.
//= theory sec:clear-recovery type=test
#[test]
fn who_starts_too_near_goes_away_and_nothing_that_is_promised_breaks() {
    for controller in ["budget", "links"] {
        let near = scenario(controller, "[obstacles]\nwalls = [[-0.4, 0.1, 0.4, 0.1]]\n");
        let near = Scenario { duration_s: 2.0, desired: Desired::Hold, ..near };
        let mut world = World::<2>::new(&near, Options { without_phi: true, ..Options::default() }).unwrap();
        world.step();
        let said = world.frame().modes.iter().filter(|mode| mode.name() == "near obstacle").count();
        assert!(said > 0, "{controller}: {:?}", world.frame().modes);
        while !world.is_over() {
            world.step();
        }
        let end = world.frame().modes.iter().filter(|mode| mode.name() == "near obstacle").count();
        assert_eq!(end, 0, "{controller}");
        let summary = world.finish().summary;
        assert!(!summary.start.inside && summary.broken(Law::Clear) > 0, "it is counted");
        let broken: Vec<_> = summary.violations(&near).collect();
        assert!(broken.is_empty(), "{controller}: {broken:?}");
        assert_eq!((summary.broken(Law::Untowed), summary.broken(Law::Mode)), (0, 0), "{controller}");
    }
}

/// The paper's team on its way to the right, past what stands there, for so long.
fn passing(controller: &str, turn: &str, obstacles: &str, duration_s: f64) -> (f64, Summary) {
    let velocities: Vec<String> = (1..=11).map(|robot| format!("[{robot}, 0.0, 1.0, 0.0]")).collect();
    let text = format!(
        "duration_s = {duration_s}\n[team]\nmalicious = []\n[controller]\nkind = \"{controller}\"\nspeed_max_m_s = 1.5\n\
         [clock]\ntau_1_s = 0.05\n[obstacles]\nturn = \"{turn}\"\n{obstacles}\n\
         [motion]\nkind = \"velocities\"\nvelocities = [{}]\n",
        velocities.join(", ")
    );
    let scenario = parse::scenario(&text).unwrap();
    let mut world = World::<2>::new(&scenario, Options::default()).unwrap();
    while !world.is_over() {
        world.step();
    }
    let last_m = world.frame().positions_m.iter().map(|x| x[0]).fold(f64::INFINITY, f64::min);
    (last_m, world.finish().summary)
}

/// With turned wishes the whole team comes past discs and through gaps, and keeps what is promised on its way.
#[test]
fn a_team_with_turned_wishes_passes_whole() {
    let disc = |radius: f64| {
        (
            format!("disc of {radius} m"),
            format!("discs = [[{}, 0.0, {radius}]]", 2.0 + radius),
            2.0 + 2.0 * radius,
        )
    };
    let gap = |wide: f64| {
        let half = 0.5 * wide;
        (format!("gap of {wide} m"), format!("walls = [[2.5, -4, 2.5, -{half}], [2.5, {half}, 2.5, 4]]"), 2.5)
    };
    let mut stuck = Vec::new();
    for (what, obstacles, behind_m) in
        [disc(0.5), disc(1.0), disc(2.0), disc(5.0), gap(1.2), gap(0.8), gap(0.6)]
    {
        for controller in ["budget", "links"] {
            let (last_m, summary) = passing(controller, "middle", &obstacles, 40.0);
            eprintln!("{what}, {controller}: the last robot is {:.2} m behind it", last_m - behind_m);
            for law in [Law::Degree, Law::Distance, Law::Path, Law::Clear, Law::Mode] {
                assert_eq!(summary.broken(law), 0, "{what}, {controller}: {law:?}");
            }
            if last_m < behind_m {
                stuck.push(format!("{what} under {controller}"));
            }
        }
    }
    assert!(stuck.is_empty(), "{stuck:?}");
}
