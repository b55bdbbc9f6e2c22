//! Texts with draws: what is drawn, that it is the same every time, and what is refused.
#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::collections::BTreeSet;

use closeranks_sim::parse::{Problem, scenario};
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::sweep::{Drawn, Plan, Run, is_drawn};

fn plan(text: &str) -> Plan {
    Plan::read(text).unwrap()
}

fn runs(text: &str, count: u64) -> Vec<Run> {
    let plan = plan(text);
    (0..count).map(|run| plan.draw(1, run).unwrap()).collect()
}

fn scenarios(text: &str, count: u64) -> Vec<Scenario> {
    runs(text, count).into_iter().map(|run| run.scenarios[0].0.clone()).collect()
}

/// The draws of `text` have one mistake, said as `expected`, and the underlined part is `marked`.
#[track_caller]
fn refused(text: &str, marked: &str, expected: &str) {
    let problems = Plan::read(text).expect_err("must be refused");
    assert_eq!(problems.iter().map(Problem::to_string).collect::<Vec<_>>(), [expected]);
    assert_eq!(&text[problems[0].span.clone()], marked);
}

#[test]
fn whole_numbers_reach_both_ends_evenly() {
    let teams = scenarios("[team]\nrobots = { draw = [4, 6] }", 300);
    let count = |robots: u16| teams.iter().filter(|team| team.team.robots == robots).count();
    assert!((4..=6).all(|robots| (70..130).contains(&count(robots))), "{} {}", count(4), count(6));
    assert_eq!(count(4) + count(5) + count(6), 300);
}

#[test]
fn numbers_fill_their_interval_evenly_or_in_the_logarithm() {
    let q2 = |text: &str| scenarios(text, 400).into_iter().map(|one| one.link.q2).collect::<Vec<f64>>();
    let even = q2("[link]\nq2 = { draw = [0.1, 10] }");
    assert!(even.iter().all(|q2| (0.1..10.0).contains(q2)));
    let below = |numbers: &[f64]| numbers.iter().filter(|number| **number < 1.0).count();
    assert!(below(&even) < 70, "{}", below(&even));
    let log = q2("[link]\nq2 = { draw = [0.1, 10.0], log = true }");
    assert!(log.iter().all(|q2| (0.1..=10.0).contains(q2)));
    assert!((150..250).contains(&below(&log)), "half of the decades: {}", below(&log));
}

#[test]
fn choices_follow_their_weights_and_draw_inside() {
    let text = "[attack]\nlevel = { choose = [{ kind = \"none\" }, { kind = \"bias\", bias = { draw = [2.0, 3.0] } }], weights = [1, 3] }";
    let runs = runs(text, 200);
    let paths: Vec<&str> =
        plan(text).fields().iter().map(|field| field.path.clone().leak() as &str).collect();
    assert_eq!(paths, ["attack.level.bias", "attack.level.kind"]);
    let mut biased = 0;
    for run in &runs {
        match run.drawn.as_slice() {
            [None, Some(Drawn::Text(kind))] => assert_eq!(kind, "none"),
            [Some(Drawn::Number(bias)), Some(Drawn::Text(kind))] => {
                assert!(kind == "bias" && (2.0..3.0).contains(bias));
                biased += 1;
            }
            other => panic!("{other:?}"),
        }
    }
    assert!((130..170).contains(&biased), "{biased}");
}

#[test]
fn lists_and_nested_choices_are_drawn_too() {
    let text = "[team]\nrobots = 5\nmalicious = { choose = [[1], [{ draw = [2, 3] }, 5]] }\n[values]\nkind = \"listed\"\nvalues = [1, 2, { choose = [{ draw = [0.0, 1.0] }, 7] }, 4, 5]";
    let fields = plan(text).fields().to_vec();
    let shown: Vec<_> = fields.iter().map(|field| (field.path.as_str(), field.number, field.few)).collect();
    assert_eq!(shown, [("team.malicious", false, true), ("values.values[2]", true, false)]);
    let lists = scenarios(text, 60);
    let has = |malicious: &[u16]| lists.iter().any(|one| one.malicious == malicious);
    assert!(has(&[1]) && has(&[2, 5]) && has(&[3, 5]));
}

/// A whole table in one column would have another text in every run.
#[test]
fn every_field_of_a_table_in_a_chosen_list_has_a_column() {
    let text = "[team]\nrobots = 5\nabsent = { choose = [[], [{ robot = { draw = [2, 3] }, to_s = { draw = [0.1, 0.9] } }]] }";
    let fields = plan(text).fields().to_vec();
    let shown: Vec<_> = fields.iter().map(|field| (field.path.as_str(), field.number, field.few)).collect();
    let robot = [("team.absent[0].robot", true, true), ("team.absent[0].to_s", true, false)];
    assert_eq!(shown, [[("team.absent", false, true)].as_slice(), &robot].concat());
    for run in runs(text, 20) {
        let absent = run.scenarios[0].0.absences.len();
        match run.drawn.as_slice() {
            [Some(Drawn::Text(none)), None, None] => assert!(none == "[]" && absent == 0),
            [None, Some(Drawn::Number(robot)), Some(Drawn::Number(to_s))] => {
                assert!(absent == 1 && [2.0, 3.0].contains(robot) && (0.1..0.9).contains(to_s));
            }
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_run_depends_on_its_number_and_the_seed_alone() {
    let text = "[team]\nrobots = { draw = [4, 12] }\n[link]\nq2 = { draw = [0.1, 0.9] }";
    let plan = plan(text);
    let late = plan.draw(3, 1_000_000).unwrap();
    (0..5).for_each(|run| assert_ne!(plan.draw(3, run).unwrap(), late));
    assert_eq!(plan.draw(3, 1_000_000).unwrap(), late);
    assert_ne!(plan.draw(4, 1_000_000).unwrap(), late);
    let (drawn, plain) = &late.scenarios[0];
    assert_eq!(scenario(plain).as_ref(), Ok(drawn), "the plain text is the whole scenario");
    let turned = "[link]\nq2 = { draw = [0.1, 0.9] }\n[team]\nrobots = { draw = [4, 12] }";
    assert_eq!(
        Plan::read(turned).unwrap().draw(3, 1_000_000).unwrap(),
        late,
        "the order of tables does not matter"
    );
}

/// If this changes, every sweep changes: say so in CHANGELOG.md, with the reason.
#[test]
fn the_first_run_has_the_committed_draws() {
    let run = plan("[team]\nrobots = { draw = [4, 12] }\n[link]\nq2 = { draw = [0.1, 0.9], log = true }")
        .draw(1, 0)
        .unwrap();
    assert_eq!(
        run.scenarios[0].1,
        "seed = 605878427163532\n\n[link]\nq2 = 0.2593223397664737\n\n[team]\nrobots = 4\n"
    );
}

#[test]
fn every_controller_runs_the_same_scenario() {
    let text = "[sweep]\ncontrollers = [\"none\", \"budget\"]\n[team]\nrobots = { draw = [4, 9] }";
    let run = plan(text).draw(1, 5).unwrap();
    let [(budget, _), (none, _)] = run.scenarios.as_slice() else { panic!("{run:?}") };
    assert_eq!((budget.controller, none.controller), (Controller::Budget, Controller::None));
    let same = Scenario { controller: Controller::Budget, expect: budget.expect.clone(), ..none.clone() };
    assert_eq!(&same, budget);
    assert_eq!(run.under(Controller::None), run.scenarios[1].1);
    let composed = closeranks_sim::parse::scenario(&run.under(Controller::Composed)).unwrap();
    assert_eq!((composed.controller, composed.seed), (Controller::Composed, none.seed));
    assert_eq!(composed.team.robots, none.team.robots);
}

/// A table without a kind goes by the names of its fields, inside another choice too.
#[test]
fn a_choice_inside_a_choice_has_a_name_of_its_own() {
    let text =
        "[sensing]\nchoose = [{ frozen = { choose = [{ robot = 1 }, { robot = 2, from_s = 0.5 }] } }, {}]";
    let plan = plan(text);
    let paths: Vec<&str> = plan.fields().iter().map(|field| field.path.as_str()).collect();
    assert_eq!(paths, ["sensing", "sensing.frozen", "sensing.frozen.from_s", "sensing.frozen.robot"]);
    let names: BTreeSet<_> = runs(text, 40)
        .into_iter()
        .map(|run| [0, 1].map(|place| run.drawn[place].clone().map(|drawn| format!("{drawn:?}"))))
        .collect();
    let name = |text: &str| Some(format!("Text({text:?})"));
    let inner = |text: &str| [name("frozen"), name(text)];
    assert_eq!(names, BTreeSet::from([[name("nothing"), None], inner("robot"), inner("from_s + robot")]));
}

#[test]
fn what_cannot_be_run_is_drawn_again() {
    let text = "[team]\nrobots = { draw = [4, 12] }\nfaults = { draw = [0, 4] }";
    let all = runs(text, 60);
    assert!(all.iter().any(|run| run.redraws > 0) && all.iter().any(|run| run.redraws == 0));
    assert!(all.iter().all(|run| run.scenarios[0].0.team.faults * 2 < run.scenarios[0].0.team.robots));
    let problems = plan("[team]\nrobots = 4\nfaults = { draw = [2, 3] }").draw(1, 0).unwrap_err();
    assert_eq!(problems[0].field, "team.faults");
    assert_eq!(problems[0].span, 27..44, "the place in the text with draws");
}

/// Three branches of `scenarios/campaign-ranks.toml` had a field that was gone. Every draw of them was refused and drawn again, so
/// the campaign went on without them and nobody was told.
#[test]
fn a_part_of_a_choice_that_can_never_be_run_is_refused() {
    let text = "[clock]\nchoose = [{ tau_1_s = 0.05 }, { tau_1_s = 0.05, drift_s = 0.1 }]";
    refused(
        text,
        "{ tau_1_s = 0.05, drift_s = 0.1 }",
        "`clock.drift_s` is no longer a field, allowed is nothing: no told level has an age any more, and missing robots are \
         reckoned in ticks",
    );
    refused(
        "[attack]\nlevel = { choose = [{ kind = \"none\" }, { choose = [{ kind = \"none\" }, { kind = \"sing\" }] }] }",
        "{ kind = \"sing\" }",
        &plan_of_one("[attack]\nlevel = { kind = \"sing\" }\n"),
    );
    refused(
        "[team]\nrobots = 4\n[[start.choose]]\nkind = \"hexagon\"\n[[start.choose]]\nkind = \"listed\"\npositions_m = [[0, { choose = [0, true] }]]",
        "true",
        "`start.positions_m[0][1]` is true, allowed is a finite number (y_m), -1000000 to 1000000",
    );
    let whole = "[team]\nrobots = { draw = [4, 6] }\nrobot = 3";
    refused(
        whole,
        "3",
        "`team.robot` is not a field here, allowed is `robots`, `faults`, `malicious`, `ranks`, `absent`",
    );
}

/// What a plain text with one mistake is refused with.
fn plan_of_one(text: &str) -> String {
    scenario(text).unwrap_err()[0].to_string()
}

/// At the top one of several texts takes the place of whole tables, so that lengths fit each other.
#[test]
fn what_belongs_together_is_drawn_together() {
    let text = "choose = [{ }, { link = { radius_m = 1.0 }, team = { robots = { draw = [5, 6] } } }]\nweights = [1, 1]\n[link]\nq2 = { draw = [0.1, 0.9] }\n[team]\nrobots = 9";
    let plan = plan(text);
    let paths: Vec<&str> = plan.fields().iter().map(|field| field.path.as_str()).collect();
    assert_eq!(paths, ["choose", "link.q2", "link.radius_m", "team.robots"]);
    assert!(is_drawn("choose = [{ }]"));
    let mut names = BTreeSet::new();
    for run in runs(text, 60) {
        let scenario = &run.scenarios[0].0;
        let small = scenario.link.radius_m == 1.0;
        assert_eq!(scenario.team.robots == 9, !small, "drawn together");
        assert_eq!(run.drawn[1].is_some(), !small, "of a table that was replaced nothing is noted");
        assert_eq!([run.drawn[2].is_some(), run.drawn[3].is_some()], [small; 2]);
        let default = Scenario::default().link.q2;
        assert_eq!(scenario.link.q2 == default, small, "whole tables take the place of whole tables");
        names.insert(format!("{:?}", run.drawn[0]));
    }
    let name = |name: &str| format!("Some(Text({name:?}))");
    assert_eq!(names, BTreeSet::from([name("nothing"), name("link + team")]));
    refused("choose = [{ }, 3]", "[{ }, 3]", "`choose` is [a table, 3], allowed is a list of tables");
    refused(
        "choose = [{ }, { link = { radius = 1.0 } }]\n[link]\nq2 = { draw = [0.1, 0.9] }",
        "{ link = { radius = 1.0 } }",
        "`link.radius` is not a field here, allowed is `radius_m`, `epsilon`, `q2`",
    );
}

/// A part that is never drawn may say anything, and so may one that makes sense with some draws of the rest.
#[test]
fn what_some_draw_makes_sense_of_is_not_refused() {
    plan("[clock]\nchoose = [{ }, { drift_s = 0.1 }]\nweights = [1, 0]");
    let text = "[attack.level]\nkind = { choose = [\"none\", \"bias\"] }\nbias = { draw = [1.0, 2.0] }";
    let problem = "`attack.level.bias` is not a field here, allowed is `kind`";
    refused(text, "\"none\"", problem);
    plan(
        "dimension = { choose = [2, 3] }\n[controller]\ninput_max_m_s = { choose = [[1.0, 1.0], [1.0, 1.0, 1.0]] }",
    );
    plan("[team]\nrobots = { draw = [1, 4] }\nfaults = { choose = [0, 1] }");
}

#[test]
fn malformed_draws_are_refused_with_place_value_and_what_is_allowed() {
    let two = "two finite numbers, ascending; whole numbers at most 2^53";
    for (ends, found) in [
        ("3", "3"),
        ("[3]", "[3]"),
        ("[5, 4]", "[5, 4]"),
        ("[0.0, inf]", "[0.0, inf]"),
        ("[\"a\", 1]", "[\"a\", 1]"),
        ("[0, 9007199254740993]", "[0, 9007199254740993]"),
    ] {
        let text = format!("[link]\nq2 = {{ draw = {ends} }}");
        refused(&text, ends, &format!("`link.q2.draw` is {found}, allowed is {two}"));
    }
    refused(
        "[link]\nq2 = { draw = [0.0, 1.0], log = true }",
        "[0.0, 1.0]",
        "`link.q2.draw` is [0.0, 1.0], allowed is two numbers, both more than 0, ascending, one of them written as a float",
    );
    refused("q = { draw = [0.1, 1.0], log = 1 }", "1", "`q.log` is 1, allowed is true or false");
    refused(
        "q = { draw = [1, 2], step = 1 }",
        "step",
        "`q.step` is not a field here, allowed is `draw`, `log`",
    );
    refused("q = { choose = [] }", "[]", "`q.choose` is [], allowed is a list of at least one value");
    refused(
        "q = { choose = [1, 2], weights = [1, -1] }",
        "[1, -1]",
        "`q.weights` is [1, -1], allowed is a list of 2 numbers, none negative and not all of them 0",
    );
    refused(
        "seed = { draw = [1, 2] }",
        "{ draw = [1, 2] }",
        "`seed` is drawn, allowed is left out: the seed of every run is drawn",
    );
}

#[test]
fn the_table_sweep_is_checked() {
    let all: Vec<String> = Controller::ALL.iter().map(|one| format!("`{}`", one.name())).collect();
    let names = &format!("a list of {}, each at most once", all.join(", "));
    for list in ["[]", "[\"brakes\"]", "[\"none\", \"none\"]"] {
        let text = format!("[sweep]\ncontrollers = {list}");
        refused(&text, list, &format!("`sweep.controllers` is {list}, allowed is {names}"));
    }
    refused("sweep = 3", "3", "`sweep` is 3, allowed is a table");
    refused("[sweep]\nruns = 3", "runs", "`sweep.runs` is not a field here, allowed is `controllers`");
    refused(
        "[sweep]\ncontrollers = [\"none\"]\n[controller]\nkind = { choose = [\"none\", \"budget\"] }",
        "{ choose = [\"none\", \"budget\"] }",
        "`controller.kind` is drawn, allowed is a fixed one beside `sweep.controllers`",
    );
}

#[test]
fn plain_scenarios_are_told_from_texts_with_draws() {
    assert!(
        !is_drawn("") && !is_drawn("[team]\nrobots = 4\n[start]\nkind = \"listed\"\npositions_m = [[0, 1]]")
    );
    assert!(!is_drawn("not = toml ="));
    assert!(is_drawn("[sweep]"));
    assert!(is_drawn("[start]\nkind = \"listed\"\npositions_m = [[0, { draw = [0, 1] }]]"));
    let run = plan("name = \"plain\"\nseed = 4").draw(1, 0).unwrap();
    assert_eq!(
        run.scenarios[0].0,
        Scenario { name: "plain".into(), seed: run.scenarios[0].0.seed, ..Scenario::default() }
    );
    assert_ne!(run.scenarios[0].0.seed, 4, "always drawn");
}
