//! `scenarios/everything.toml` against the table of numbers in the core: nothing is left out, and the values are the defaults.

use closeranks_core::settings::field::{Parts, Row, TABLE};
use closeranks_sim::law::Law;
use closeranks_sim::parse::scenario;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, run};

const EVERYTHING: &str = include_str!("../../../scenarios/everything.toml");

/// The default that the core has for the number of `row`.
fn default_of(row: &Row) -> f64 {
    let Scenario {
        mut team,
        mut link,
        mut limits,
        mut composed,
        mut budget,
        mut links,
        mut clock,
        mut errors,
        ..
    } = Scenario::default();
    // There is no limit by default; the comment shows this one.
    limits.speed_max_m_s = 1.5;
    let parts = Parts {
        team: &mut team,
        ranks: None,
        link: &mut link,
        distance_min_m: &mut limits.distance_min_m,
        clearance_m: &mut limits.clearance_m,
        speed_max_m_s: &mut limits.speed_max_m_s,
        composed: Some(&mut composed),
        budget: Some(&mut budget),
        links: Some(&mut links),
        clock: &mut clock,
        errors: &mut errors,
        distance_limit_m: f64::INFINITY,
        move_max_m: 0.005 * 1.5 * 2.0_f64.sqrt(),
    };
    (row.get)(&parts).expect("both controllers are there")
}

/// The number that the file gives for the number of `row`, in a comment or not.
fn written_for(row: &Row) -> f64 {
    let (table, key) = row.place();
    let head = format!("[{table}]");
    let lines = EVERYTHING.lines().skip_while(|line| **line != head).skip(1);
    let here = lines.take_while(|line| !line.starts_with('['));
    let found: Vec<&str> = here
        .filter_map(|line| line.trim_start_matches("# ").split_once(" = "))
        .filter(|(name, _)| *name == key)
        .map(|(_, value)| value.split('#').next().unwrap_or(value).trim())
        .collect();
    assert_eq!(found.len(), 1, "{} stands once in everything.toml: {found:?}", row.name);
    found[0].parse().expect("a number")
}

#[test]
fn every_number_of_the_table_stands_in_the_file_with_its_default() {
    for row in &TABLE {
        let (written, default) = (written_for(row), default_of(row));
        // Some defaults are computed and have more digits than are of use in a file.
        assert!(
            (written - default).abs() <= 1e-3 * default.abs(),
            "{}: {written} in everything.toml, {default} by default",
            row.name
        );
    }
}

#[test]
fn a_number_that_is_none_is_refused_with_the_range_of_the_table() {
    for row in &TABLE {
        let (table, key) = row.place();
        let problems = scenario(&format!("[{table}]\n{key} = nan")).expect_err("nan is no number of a team");
        let told = problems[0].to_string();
        assert!(told.starts_with(&format!("`{}` is nan, allowed is ", row.name)), "{told}");
    }
}

/// What controllers of others leave open can be said, and matters; who says nothing gets what the table says.
#[test]
fn the_two_numbers_of_others_are_read_and_used() {
    let text = |kind: &str, more: &str| {
        format!(
            "duration_s = 1.0\n[start]\nkind = \"random\"\nhalf_side_m = 1.0\ndistance_min_m = 0.31\n[controller]\nkind = \"{kind}\"\n{more}"
        )
    };
    let end = |text: &str| {
        let scenario = scenario(text).expect("a scenario");
        run(&scenario, Options::default(), &mut |_| ()).expect("a run").summary.gyration_m
    };
    for (kind, usual, other) in [
        ("min-composition", "rate_1_s = 0.05", "rate_1_s = 5.0"),
        ("orca", "orca_horizon_s = 2.0", "orca_horizon_s = 0.25"),
    ] {
        assert_eq!(end(&text(kind, "")), end(&text(kind, usual)));
        assert!(end(&text(kind, "")) != end(&text(kind, other)), "{kind}");
    }
    let problems = scenario(&text("orca", "orca_horizon_s = 0.0")).expect_err("no horizon");
    assert!(problems[0].to_string().contains("controller.orca_horizon_s"), "{problems:?}");
}

/// The words that the field of this text may hold, as the refusal of another one names them.
fn words(text: &str) -> Vec<String> {
    let problems = scenario(text).expect_err("no such word");
    let told = problems[0].to_string();
    let (_, allowed) = told.split_once(", allowed is ").expect("what is allowed");
    allowed.split('`').skip(1).step_by(2).map(str::to_owned).collect()
}

/// A new controller, lie, motion or rule is found by who reads the file.
#[test]
fn every_word_that_a_field_may_hold_stands_in_the_file() {
    let fields = [
        "[controller]\nkind = \"?\"",
        "[consensus]\nrule = \"?\"",
        "[start]\nkind = \"?\"",
        "[values]\nkind = \"?\"",
        "[motion]\nkind = \"?\"",
        "[attack]\nmotion = \"?\"",
        "[attack]\nlevel = { kind = \"?\" }",
        "[attack]\nlists = { kind = \"?\" }",
        "[attack]\nvalue = { kind = \"?\" }",
    ];
    for field in fields {
        let words = words(field);
        assert!(words.len() > 1, "{field}: {words:?}");
        let (table, key) = field.split_once('\n').expect("a table and a field");
        let key = key.split(' ').next().unwrap_or(key);
        let there = EVERYTHING.lines().skip_while(|line| line.split(' ').next() != Some(table)).skip(1);
        let there: Vec<&str> = there.take_while(|line| !line.starts_with('[')).collect();
        let missing: Vec<&String> =
            words.iter().filter(|word| !there.join("\n").contains(&format!("\"{word}\""))).collect();
        assert!(missing.is_empty(), "{table} {key} of everything.toml: {missing:?}");
    }
}

#[test]
fn every_law_stands_in_the_file_and_in_the_table_of_laws() {
    let table = include_str!("../../../scenarios/README.md");
    for law in Law::ALL.map(Law::name) {
        let named = EVERYTHING
            .lines()
            .filter(|line| line.starts_with("# "))
            .any(|line| line.trim_end_matches('.').split([' ', ',']).any(|word| word == law));
        assert!(named, "{law} in everything.toml");
        assert!(table.contains(&format!("| `{law}` | ")), "{law} in scenarios/README.md");
    }
}
