//! Scenario texts: what is refused, and how it is said.

use closeranks_core::settings::LinkSettings;
use closeranks_sim::parse::{Problem, scenario};
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::start::Start;

fn problems(text: &str) -> Vec<Problem> {
    scenario(text).expect_err("must be refused")
}

/// The text has one mistake, said as `expected`, and the underlined part is `marked`.
#[track_caller]
fn refused(text: &str, marked: &str, expected: &str) {
    let problems = problems(text);
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert_eq!(problems[0].to_string(), expected);
    assert_eq!(&text[problems[0].span.clone()], marked, "{expected}");
}

#[test]
fn an_empty_text_is_the_default_scenario() {
    assert_eq!(scenario(""), Ok(Scenario::default()));
}

#[test]
fn the_file_with_every_field_says_what_an_empty_one_does() {
    let text = include_str!("../../../scenarios/everything.toml");
    let named = Scenario {
        name: "everything".into(),
        link: LinkSettings { epsilon: Some(0.099), ..LinkSettings::default() },
        ..Scenario::default()
    };
    assert_eq!(scenario(text), Ok(named));
}

#[test]
fn unknown_fields_and_tables_are_refused_with_what_is_known() {
    refused(
        "sed = 4",
        "sed",
        "`sed` is not a field here, allowed is `name`, `duration_s`, `seed`, `dimension`, `expect`, `team`, `link`, `controller`, `links`, `clock`, `start`, `obstacles`, `consensus`, `values`, `motion`, `attack`, `network`, `clocks`, `sensing`, `plant`, `fleet`",
    );
    refused(
        "[link]\nradius = 3",
        "radius",
        "`link.radius` is not a field here, allowed is `radius_m`, `epsilon`, `q2`",
    );
    refused(
        "[start]\nkind = \"inside\"\nspacing_m = 1",
        "spacing_m",
        "`start.spacing_m` is not a field here, allowed is `at_m`, `kind`",
    );
}

#[test]
fn wrong_types_are_refused_with_the_type_that_is_allowed() {
    refused("team = 3", "3", "`team` is 3, allowed is a table");
    refused("seed = 1.5", "1.5", "`seed` is 1.5, allowed is a whole number, 0 to 9223372036854775807");
    refused("seed = -1", "-1", "`seed` is -1, allowed is a whole number, 0 to 9223372036854775807");
    refused(
        "name = \"\"",
        "\"\"",
        "`name` is \"\", allowed is a text of 1 to 60 characters, without control characters",
    );
    refused(
        "[controller]\nw_r = \"15\"",
        "\"15\"",
        "`controller.w_r` is \"15\", allowed is a number, more than 0 and at most 1000000",
    );
    refused(
        "[controller]\nshare = \"both\"",
        "\"both\"",
        "`controller.share` is \"both\", allowed is `neighbours`, `own`",
    );
    refused(
        "expect = [\"degrees\"]",
        "\"degrees\"",
        "`expect[0]` is \"degrees\", allowed is `degree`, `distance`, `interval`, `agreement`, `input`, `spare`, `path`, `decay`, `mode`, `untowed`, `held`, `clear`, `composition`, `shares`, `feasible`",
    );
}

#[test]
fn numbers_that_do_not_fit_are_named_one_by_one() {
    let listed = |x: &str| {
        format!(
            "[team]\nrobots = 2\nfaults = 0\n[start]\nkind = \"listed\"\npositions_m = [[0, 0], [{x}, 0.6]]"
        )
    };
    for x in ["inf", "-inf", "nan", "-1e9"] {
        let said = format!(
            "`start.positions_m[1][0]` is {x}, allowed is a finite number (x_m), -1000000 to 1000000"
        );
        refused(&listed(x), x, &said);
    }
    refused(
        "[controller]\ninput_min_m_s = [-inf, -1]",
        "-inf",
        "`controller.input_min_m_s[0]` is -inf, allowed is a finite number (m/s), -1000000 to 1000000",
    );
    refused(
        "[link]\nq2 = -inf",
        "-inf",
        "`link.q2` is -inf, allowed is a number, more than 0 and at most 1000000000000000",
    );
}

#[test]
fn names_are_without_control_characters() {
    refused(
        "name = \"a\\u0007b\"",
        "\"a\\u0007b\"",
        "`name` is \"a\\u{7}b\", allowed is a text of 1 to 60 characters, without control characters",
    );
}

#[test]
fn seeds_are_what_toml_can_say() {
    assert!(scenario("seed = 9223372036854775807").is_ok());
    for seed in ["-1", "9223372036854775808"] {
        let said = format!("`seed` is {seed}, allowed is a whole number, 0 to 9223372036854775807");
        refused(&format!("seed = {seed}"), seed, &said);
    }
}

/// The distance that must be kept used to be called wrong, with a negative number as what is allowed.
#[test]
fn robots_that_fly_past_each_other_are_too_fast() {
    refused(
        "[controller]\nkind = \"budget\"\ninput_min_m_s = [-1, -1]\ninput_max_m_s = [400, 300]",
        "[400, 300]",
        "`controller.input_max_m_s` is too much: at up to 500.0000 m/s a robot moves 2.5000 m in 0.005 s, allowed is such a move below half of link.radius_m = 3",
    );
    refused(
        "[controller]\nkind = \"budget\"\n[clock]\ntau_1_s = 2.0\ntau_2_s = 2.0",
        "2.0",
        "`clock.tau_1_s` is too much: at up to 2.1213 m/s a robot moves 4.2426 m in 2 s, allowed is such a move below half of link.radius_m = 3",
    );
}

#[test]
fn the_second_of_two_that_are_alike_is_marked() {
    let text = "[team]\nmalicious = [1, 2, 1]";
    let found = problems(text);
    assert_eq!(found[0].to_string(), "`team.malicious[2]` is robot 1 twice, allowed is each robot once");
    assert_eq!(found[0].span, text.len() - 2..text.len() - 1);
    let text = "[team]\nrobots = 2\nfaults = 0\n[start]\nkind = \"listed\"\npositions_m = [[0, 0], [0, 0]]";
    let found = problems(text);
    assert!(found[0].to_string().starts_with("`start.positions_m[1]` is robots 1 and 2 at one point"));
    assert_eq!(found[0].span, text.len() - 7..text.len() - 1);
}

#[test]
fn impossible_numbers_are_refused() {
    refused("duration_s = nan", "nan", "`duration_s` is nan, allowed is a number, 0 to 1000000");
    refused(
        "[link]\nq2 = 0",
        "0",
        "`link.q2` is 0, allowed is a number, more than 0 and at most 1000000000000000",
    );
    refused(
        "[link]\nradius_m = inf",
        "inf",
        "`link.radius_m` is inf, allowed is a number, more than 0 and at most 1000000",
    );
    refused(
        "[link]\nepsilon = 0.1",
        "0.1",
        "`link.epsilon` is 0.1, allowed is more than 0 and less than 0.1 (below 1/(n-1), n = 11)",
    );
    refused("[team]\nfaults = 6", "6", "`team.faults` is 6, allowed is 0 to 5 (2F + 1 <= n = 11)");
    refused(
        "[controller]\ndistance_min_m = 3.5",
        "3.5",
        "`controller.distance_min_m` is 3.5, allowed is more than 0 and less than 3 (below link.radius_m)",
    );
    refused(
        "[controller]\ninput_min_m_s = [0.5, -1]",
        "[0.5, -1]",
        "`controller.input_min_m_s` is 0.5, allowed is -1000000 to 0 (the box must contain 0)",
    );
    refused(
        "[controller]\ninput_max_m_s = [1, 1, 1]",
        "[1, 1, 1]",
        "`controller.input_max_m_s` is a list of 3, allowed is 2 numbers",
    );
    refused(
        "[clock]\ntau_2_s = 0.012",
        "0.012",
        "`clock.tau_2_s` is 0.012, allowed is a whole multiple of clock.tau_1_s = 0.005",
    );
    refused(
        "duration_s = 100000",
        "100000",
        "`duration_s` is 100000, allowed is at most 90909.1 with 11 robots and this clock",
    );
}

#[test]
fn budget_has_limits_of_its_own() {
    refused(
        "[controller]\nkind = \"budget\"\ngamma = 1.5",
        "1.5",
        "`controller.gamma` is 1.5, allowed is a number, more than 0 and at most 1",
    );
    let fast = problems("[controller]\nkind = \"budget\"\ninput_max_m_s = [300, 300]");
    assert!(fast[0].to_string().contains("below half of link.radius_m = 3"), "{}", fast[0]);
}

/// Robots that run one by one hold what they know of others, so dense teams may not be large.
#[test]
fn large_dense_teams_need_a_plain_world() {
    let expected = "`team.robots` is 1001, allowed is as many as have at most 500000 pairs within link.radius_m at the start where \
                    robots run one by one: wherever something goes wrong, liars have faces, fall silent, send garbage or disobey, \
                    and with controller.kind = \"budget\" under assume = \"free\" or stated errors";
    for heavy in [
        "controller = { kind = \"budget\", assume = \"free\" }",
        "controller = { kind = \"budget\", position_error_m = 0.01 }",
        "network = { loss = 0.1 }",
        "plant = { missed = 0.1 }\ncontroller = { kind = \"none\" }",
        "attack = { motion = \"flee\" }",
        "attack = { value = { kind = \"silent\" } }",
    ] {
        let team = |robots: u32, radius_m: u32| {
            format!(
                "duration_s = 1.0\nteam = {{ robots = {robots} }}\nlink = {{ radius_m = {radius_m} }}\n{heavy}"
            )
        };
        refused(&team(1001, 100), "1001", expected);
        assert!(scenario(&team(1000, 100)).is_ok() && scenario(&team(3000, 3)).is_ok());
    }
    assert!(scenario("duration_s = 1.0\nteam = { robots = 1001 }").is_ok());
    let budget = "duration_s = 1.0\nteam = { robots = 1001 }\ncontroller = { kind = \"budget\" }";
    assert!(scenario(budget).is_ok());
}

#[test]
fn impossible_teams_and_starts_are_refused() {
    refused(
        "[team]\nmalicious = [12]",
        "12",
        "`team.malicious[0]` is 12, allowed is the number of a robot, 1 to 11",
    );
    refused(
        "[team]\nmalicious = [4, 3, 4]",
        "4",
        "`team.malicious[2]` is robot 4 twice, allowed is each robot once",
    );
    let two = |positions: &str| {
        format!("[team]\nrobots = 2\n[start]\nkind = \"listed\"\npositions_m = {positions}")
    };
    let same = "[[1.0, 2.0], [1, 2]]";
    refused(
        &two(same),
        "[1, 2]",
        "`start.positions_m[1]` is robots 1 and 2 at one point [1.0, 2.0], allowed is a different point for each robot",
    );
    refused(
        &two("[[1.0, 2.0]]"),
        "[[1.0, 2.0]]",
        "`start.positions_m` is a list of 1, allowed is 2 positions, one a robot",
    );
    refused(
        &two("[[1, 2], [nan, 0]]"),
        "nan",
        "`start.positions_m[1][0]` is nan, allowed is a finite number (x_m), -1000000 to 1000000",
    );
    refused(
        "[team]\nrobots = 5\n[start]\nkind = \"inside\"",
        "\"inside\"",
        "`start.kind` is start `inside` has 11 robots in 2 dimensions, not 5 in 2, allowed is a start for this team and dimension",
    );
    let full = problems("[start]\nkind = \"random\"\nhalf_side_m = 0.4");
    assert!(full[0].to_string().contains("robots found a place"), "{}", full[0]);
}

/// Squares of tiny lengths are 0: then robots that are drawn or on a lattice stand at one point, and no list is at fault.
#[test]
fn starts_too_small_are_refused_by_their_own_field() {
    refused(
        "[start]\nkind = \"hexagon\"\nspacing_m = 1e-200",
        "1e-200",
        "`start.spacing_m` is 1e-200, where the distance of robots 1 and 2 is rounded to 0, allowed is a larger start",
    );
    let drawn = problems("[start]\nkind = \"random\"\nhalf_side_m = 1e-200\ndistance_min_m = 1e-210");
    assert_eq!(drawn.iter().map(|problem| problem.field.as_str()).collect::<Vec<_>>(), ["start.half_side_m"]);
    assert!(scenario("[start]\nkind = \"hexagon\"\nspacing_m = 1e-100").is_ok());
}

/// Which fields there are depends on the kind: where it is misspelt no other one is called unknown.
#[test]
fn a_misspelt_kind_is_one_mistake() {
    for text in [
        "[attack]\nlevel = { kind = \"rump\", rate_per_s = 3.0 }",
        "[attack.value]\nkind = \"constnat\"\nvalue = 3.0",
        "[start]\nkind = \"hexagons\"\nspacing_m = 1",
        "[values]\nkind = \"list\"\nvalues = [1.0]",
    ] {
        let found = problems(text);
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].field.rsplit('.').next(), Some("kind"));
    }
    assert_eq!(problems("[attack.level]\nkind = \"bias\"\nrate_per_s = 3.0").len(), 1);
}

#[test]
fn troubles_do_not_end_before_they_begin() {
    let crash = |times: &str| format!("[plant]\ncrash = {{ robot = 3, {times} }}");
    refused(
        &crash("from_s = 2.0, to_s = 1.5"),
        "1.5",
        "`plant.crash.to_s` is 1.5, allowed is a number, 2 to 1000000",
    );
    refused(&crash("to_s = 0.5"), "0.5", "`plant.crash.to_s` is 0.5, allowed is a number, 1 to 1000000");
    refused(
        &crash("from_s = -1.0, to_s = 0.5"),
        "-1.0",
        "`plant.crash.from_s` is -1.0, allowed is a number, 0 to 1000000",
    );
    let partition = problems("[network]\npartition = { from_s = 2, to_s = 1 }");
    assert_eq!(partition[0].field, "network.partition.to_s");
    let spell = |times: &str| scenario(&crash(times)).unwrap().faults.outages.crash.unwrap();
    assert_eq!(spell("from_s = 1.0, to_s = 1.0").to_s, 1.0);
    assert_eq!(spell("from_s = 1e6").to_s, 1e6);
    assert_eq!((spell("to_s = 1.5").from_s, spell("from_s = 3.0").to_s), (1.0, 4.0));
}

#[test]
fn a_default_that_clashes_is_said_to_be_a_default() {
    refused(
        "[clock]\ntau_1_s = 0.03",
        "[clock]",
        "`clock.tau_2_s` is 0.1 by default, allowed is a whole multiple of clock.tau_1_s = 0.03",
    );
}

#[test]
fn other_teams_start_in_a_patch_or_a_cube() {
    assert_eq!(scenario("[team]\nrobots = 20").unwrap().start, Start::Hexagon { spacing_m: 0.6 });
    assert!(matches!(scenario("dimension = 3").unwrap().start, Start::Random { .. }));
}

#[test]
fn text_that_is_not_toml_is_refused_with_its_line() {
    let text = "seed = 1\nname = \"open";
    let problems = problems(text);
    assert_eq!(problems[0].line(text), 2, "{}", problems[0]);
    assert!(!scenario("[a").unwrap_err().is_empty());
}

#[test]
fn several_mistakes_are_told_at_once_in_order() {
    let found = problems("seed = -1\n[link]\nq2 = -3\nfoo = 1");
    assert_eq!(
        found.iter().map(|problem| problem.field.as_str()).collect::<Vec<_>>(),
        ["seed", "link.q2", "link.foo"]
    );
}

#[test]
fn hostile_texts_are_refused_without_panic() {
    let deep = "[".repeat(100_000);
    let long = format!("name = \"{}\"", "x".repeat(2_000_000));
    let huge = "duration_s = 1e400\nseed = 99999999999999999999999999";
    for text in [deep.as_str(), long.as_str(), huge, "\u{0}", "expect = [[[[]]]]", "[team]\nmalicious = [0]"]
    {
        assert!(!problems(text).is_empty());
    }
}
