//! Ranks: who counts for whom, and what that is worth.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use closeranks_sim::law::Law;
use closeranks_sim::output::summary::Summary;
use closeranks_sim::parse::scenario;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::ranks::How;
use closeranks_sim::world::{Engine, Options, World, run};

const OWN: &str = include_str!("../../../scenarios/ranks.toml");
const PAPER: &str = include_str!("../../../scenarios/ranks-paper.toml");

fn read(text: &str) -> Scenario {
    scenario(text).unwrap()
}

fn summary(scenario: &Scenario) -> Summary {
    let summary = run(scenario, Options::default(), &mut |_| ()).unwrap().summary;
    let broken: Vec<_> = summary.violations(scenario).collect();
    assert!(broken.is_empty(), "{broken:?}");
    summary
}

/// What is wrong with a text.
fn refused(text: &str) -> String {
    let problems = scenario(text).unwrap_err();
    assert_eq!(problems.len(), 1, "{problems:?}");
    problems[0].to_string()
}

//= theory thm:ranks type=test
#[test]
fn forty_robots_spread_twice_as_far_with_ranks_of_their_own() {
    let (own, paper) = (read(OWN), read(PAPER));
    assert_eq!(Scenario { name: own.name.clone(), ranks: own.ranks.clone(), ..paper.clone() }, own);
    let [own, paper] = [own, paper].map(|scenario| {
        assert!(scenario.expect.contains(&Law::Agreement) && scenario.expect.contains(&Law::Degree));
        summary(&scenario)
    });
    assert!(own.gyration_m >= 3.9, "{}", own.gyration_m);
    assert!((1.8..=2.1).contains(&paper.gyration_m), "{}", paper.gyration_m);
    assert_eq!((own.extremes.degree_min, paper.extremes.degree_min), (Some(5), Some(22)));
    assert!(own.extremes.spread < 1.0 && paper.extremes.spread < 1.0);
}

#[test]
fn a_team_that_is_all_core_is_the_papers() {
    let text = PAPER.replace("duration_s = 12.0", "duration_s = 1.0");
    let core = text.replace("malicious =", "ranks = { core = 40 }\nmalicious =");
    let digest = |text: &str| {
        let options = Options { digest: true, ..Options::default() };
        run(&read(text), options, &mut |_| ()).unwrap().digest
    };
    assert_eq!(digest(&text), digest(&core));
}

#[test]
fn ranks_in_layers_and_in_a_list_keep_every_promise() {
    let layers = OWN.replace("{ core = 7 }", "{ core = 9, kind = \"layers\", listen = \"counted\" }");
    let layers = read(&layers.replace("duration_s = 12.0", "duration_s = 4.0"));
    let chosen = layers.ranks::<2>().unwrap().unwrap();
    assert!(chosen.iter().max().copied().unwrap() < 6, "{chosen:?}");
    let from_layers = summary(&layers);
    let mut listed = layers.clone();
    listed.ranks.as_mut().unwrap().how = How::Listed(chosen);
    assert_eq!(summary(&listed), from_layers);
}

#[test]
fn robots_with_ranks_hand_over_what_bytes_would_say() {
    for ranks in ["{ core = 7 }", "{ core = 7, listen = \"counted\" }", "{ core = 11, kind = \"layers\" }"] {
        let text = OWN.replace("{ core = 7 }", ranks).replace("duration_s = 12.0", "duration_s = 2.0");
        let [team, robots] = [Engine::Team, Engine::Robots].map(|engine| {
            let options = Options { digest: true, engine, ..Options::default() };
            let run = run(&read(&text), options, &mut |_| ()).unwrap();
            (run.digest, run.summary)
        });
        assert_eq!(team, robots, "{ranks}");
    }
}

#[test]
fn hundreds_of_robots_with_dozens_of_liars_agree() {
    let text = r#"
        duration_s = 3.0
        team = { robots = 300, faults = 1, malicious = { local = 40, within_m = 1.7 }, ranks = { core = 5, listen = "counted" } }
        controller = { kind = "links" }
        clock = { tau_1_s = 0.02 }
        link = { radius_m = 1.6 }
        motion = { kind = "hold" }
        attack = { value = { kind = "random", min = -10000.0, max = 10000.0 } }
    "#;
    let scenario = read(text);
    assert!(scenario.malicious.len() >= 5, "{:?}", scenario.malicious);
    let summary = summary(&scenario);
    assert!(summary.extremes.spread < 1.0, "{}", summary.extremes.spread);
}

/// Two liars beside each other where one is promised: values may be anything, and that is said.
#[test]
fn the_promise_is_void_where_more_lie_than_is_promised() {
    let text = OWN.replace("faults = 2", "faults = 1").replace("[13, 22]", "[2, 3, 4]");
    let text = format!(
        "{}\n[attack]\nvalue = {{ kind = \"constant\", value = 1e5 }}\n",
        text.replace("12.0", "2.0")
    );
    let scenario = read(&text);
    let mut world = World::<2>::new(&scenario, Options::default()).unwrap();
    for _ in 0..=scenario.ticks() {
        world.step();
    }
    let void = *world.monitors().void();
    assert!(void.rounds > 10, "{void:?}");
    assert!(void.first.is_some_and(|(tick, _, liars)| tick == 5 && liars >= 2), "{void:?}");
    let summary = world.finish().summary;
    assert_eq!(summary.violations(&scenario).count(), 0, "nothing was promised");
}

#[test]
fn bad_ranks_are_refused_by_name() {
    let with = |ranks: &str| refused(&OWN.replace("{ core = 7 }", ranks));
    let small = with("{ core = 4 }");
    assert!(small.contains("`team.ranks` is 4, allowed is 5 to 40"), "{small}");
    let many = with("{ core = 41 }");
    assert!(many.contains("team.ranks.core") && many.contains("1 to 40"), "{many}");
    let short = with("[0, 0, 0, 0, 0, 0, 0]");
    assert!(short.contains("7 ranks for 40 robots"), "{short}");
    let list =
        format!("{:?}", (0..40).map(|k| u16::from(k > 6) * (1 + u16::from(k != 9))).collect::<Vec<_>>());
    assert!(scenario(&OWN.replace("{ core = 7 }", &list)).is_ok());
    let low = format!("{:?}", (0..40).map(|k| u16::from(k > 4)).collect::<Vec<_>>());
    assert!(scenario(&OWN.replace("{ core = 7 }", &low)).is_ok());
    let word = with("{ core = 7, kind = \"best\" }");
    assert!(word.contains("team.ranks.kind") && word.contains("own"), "{word}");
    let other = refused(&OWN.replace("\"links\"", "\"composed\""));
    assert!(other.contains("team.ranks") && other.contains("only under budget, links"), "{other}");
    let alone = OWN.replace("[clock]", "[start]\nkind = \"hexagon\"\nspacing_m = 3.5\n[clock]");
    assert!(refused(&alone).contains("no 7 robots of the start"), "{}", refused(&alone));
}
