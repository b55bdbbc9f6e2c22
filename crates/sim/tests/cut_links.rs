//! Obstacles that cut links: no message goes through them, and `links` keeps every link whole that a robot counts on.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_core::obstacle::is_cut;
use closeranks_sim::law::Law;
use closeranks_sim::parse;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::{Options, Run, RunError, World, run};

const MAP: &str = "[obstacles]\nclearance_m = 0.05\ncuts_links = \"all\"\n\
     discs = [[2.0, 0.6, 0.4]]\nwalls = [[-1.6, 1.2, -0.4, 1.6], [0.2, -1.7, 1.6, -1.5]]\n";

fn scenario(controller: &str, more: &str, seed: u64) -> Scenario {
    let text = format!(
        "duration_s = 8.0\nseed = {seed}\n[controller]\nkind = \"{controller}\"\n{more}\n\
         [clock]\ntau_1_s = 0.02\n[motion]\nkind = \"wander\"\n"
    );
    parse::scenario(&text).unwrap()
}

fn done(scenario: &Scenario) -> Run {
    run(scenario, Options { robustness: true, ..Options::default() }, &mut |_| ()).unwrap()
}

/// In worlds in which links are cut, and some only just not, nothing that `links` promises is broken.
//= theory thm:cut type=test
//= theory sec:cut type=test
//= theory sec:cut-admitted type=test
#[test]
fn nothing_that_is_promised_is_broken_where_links_are_cut() {
    let worlds = [
        String::new(),
        "speed_max_m_s = 1.0\n[plant]\nlook_ahead_m = 0.05\n".to_owned(),
        "position_error_m = 0.01\n[sensing]\nnoise_m = 0.01\n".to_owned(),
        "tracking_error_m = 0.043\n[plant]\nlag_s = 0.02\n".to_owned(),
        "assume = \"free\"\n[attack]\nmotion = \"flee\"\n".to_owned(),
        "[network]\nloss = 0.3\n".to_owned(),
    ];
    let (mut cut, mut near) = (0, 0);
    for (world, seed) in worlds.iter().zip(1..) {
        let scenario = scenario("links", &format!("{world}{MAP}"), seed);
        let run = done(&scenario);
        assert_eq!(run.summary.violations(&scenario).count(), 0, "{world}: {:?}", run.summary);
        let mut world = World::<2>::new(&scenario, Options::default()).unwrap();
        while !world.is_over() {
            let frame = world.step();
            for (first, x) in frame.positions_m.iter().enumerate() {
                for (second, y) in frame.positions_m[..first].iter().enumerate() {
                    let d = closeranks_core::num::length(&closeranks_core::num::subtract(x, y));
                    let is_cut = is_cut(&frame.cutting, x, y);
                    cut += u32::from(d <= 3.0 && is_cut);
                    let counted = frame.counted[first].contains(&u16::try_from(second + 1).unwrap());
                    near += u32::from(
                        counted
                            && frame.cutting.iter().any(|one| {
                                closeranks_core::num::length(&one.offset_between_m(x, y))
                                    < one.radius_m + 0.01
                            }),
                    );
                }
            }
        }
    }
    assert!(cut > 100 && near > 100, "{cut} links cut, {near} near to it");
}

/// A robot behind a wall hears nobody and reports no neighbour, though it senses all: it keeps its distance and is free to go.
//= theory sec:cut type=test
#[test]
fn who_is_behind_a_wall_is_sensed_and_not_heard() {
    let text = "duration_s = 2.0\n[team]\nrobots = 3\nfaults = 0\n[controller]\nkind = \"links\"\n[clock]\ntau_1_s = 0.02\n\
         [start]\nkind = \"listed\"\npositions_m = [[0.0, 0.5], [0.4, 0.5], [0.2, -0.5]]\n\
         [motion]\nkind = \"hold\"\n[values]\nkind = \"listed\"\nvalues = [0.0, 10.0, 90.0]\n\
         [obstacles]\nwalls = [[-9.0, 0.0, 9.0, 0.0]]\ncuts_links = \"walls\"\n";
    let apart = parse::scenario(text).unwrap();
    let mut world = World::<2>::new(&apart, Options::default()).unwrap();
    while !world.is_over() {
        world.step();
    }
    let frame = world.frame();
    assert_eq!(frame.degrees, [1, 1, 0]);
    assert_eq!([&frame.counted[0], &frame.counted[1], &frame.counted[2]], [&vec![2], &vec![1], &vec![]]);
    assert_eq!((frame.held[0], frame.held[2]), (5.0, 90.0));
    let together = parse::scenario(&text.replace("\"walls\"", "\"discs\"")).unwrap();
    let mut world = World::<2>::new(&together, Options::default()).unwrap();
    while !world.is_over() {
        world.step();
    }
    assert_eq!(world.frame().degrees, [2, 2, 2]);
}

/// Nobody is tied to those behind a wall, who could never be told that they are let go of: the two sides part beyond R.
//= theory sec:cut-admitted type=test
#[test]
fn robots_on_two_sides_of_a_wall_part() {
    let text = "duration_s = 6.0\n[team]\nrobots = 4\nfaults = 0\n[controller]\nkind = \"links\"\n[clock]\ntau_1_s = 0.02\n\
         [start]\nkind = \"listed\"\npositions_m = [[0.0, 0.5], [0.4, 0.5], [0.0, -0.5], [0.4, -0.5]]\n\
         [motion]\nkind = \"outward\"\n[obstacles]\nwalls = [[-9.0, 0.0, 9.0, 0.0]]\ncuts_links = \"walls\"\n";
    let mut world = World::<2>::new(&parse::scenario(text).unwrap(), Options::default()).unwrap();
    while !world.is_over() {
        world.step();
    }
    let places_m = &world.frame().positions_m;
    let least_m = places_m[..2].iter().map(|x| x[1]).fold(f64::INFINITY, f64::min);
    let most_m = places_m[2..].iter().map(|x| x[1]).fold(f64::NEG_INFINITY, f64::max);
    assert!(least_m - most_m > 3.5, "{places_m:?}");
}

/// Without a controller links are cut; the laws and the exact robustness of each round notice.
#[test]
fn without_a_controller_links_are_cut_and_that_is_counted() {
    let run = done(&scenario("none", MAP, 3));
    assert!(run.summary.broken(Law::Degree) > 0);
    let open = done(&scenario("none", &MAP.replace("\"all\"", "\"none\""), 3));
    let least = |run: &Run| run.rounds.iter().map(|round| round.f_max.least).min();
    assert!(least(&run) < least(&open), "{:?} {:?}", least(&run), least(&open));
}

#[test]
fn controllers_that_would_let_links_be_cut_are_refused() {
    for name in ["budget", "composed"] {
        let text = format!("[controller]\nkind = \"{name}\"\n{MAP}");
        let problems = parse::scenario(&text).unwrap_err();
        assert_eq!(problems.len(), 1);
        let told = format!(
            "`obstacles.cuts_links` is under controller \"{name}\", which has no row that keeps a link from being cut, \
             allowed is only under links, none"
        );
        assert_eq!(problems[0].to_string(), told);
        assert_eq!(&text[problems[0].span.clone()], "\"all\"");
    }
    let under = scenario("links", MAP, 1).under(Controller::Budget);
    assert!(matches!(World::<2>::new(&under, Options::default()), Err(RunError::Obstacles(_))));
    let word =
        parse::scenario(&format!("[controller]\nkind = \"links\"\n{}", MAP.replace("\"all\"", "true")));
    assert_eq!(
        word.unwrap_err()[0].to_string(),
        "`obstacles.cuts_links` is true, allowed is `none`, `discs`, `walls`, `all`"
    );
}
