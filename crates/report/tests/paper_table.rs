//! The paper's table is a golden file that a person can judge. Time is left out.
//!
//! After a change of bits: read the difference, then copy what the failing test prints to
//! `tests/golden/paper_table.txt` and say why in CHANGELOG.md.

use closeranks_report::claims::SectionFive;
use closeranks_report::table::{Line, table, text};
use closeranks_sim::output::summary::Summary;
use closeranks_sim::parse::scenario;
use closeranks_sim::scenario::{Controller, Scenario};
use closeranks_sim::world::{Options, Run, run};

const FILES: [&str; 6] = [
    include_str!("../../../scenarios/published-nominal.toml"),
    include_str!("../../../scenarios/published-understating.toml"),
    include_str!("../../../scenarios/published-overstating.toml"),
    include_str!("../../../scenarios/inside-nominal.toml"),
    include_str!("../../../scenarios/inside-understating.toml"),
    include_str!("../../../scenarios/inside-overstating.toml"),
];

fn watched(scenario: &Scenario) -> Run {
    run(scenario, Options { robustness: true, ..Options::default() }, &mut |_| ()).expect("runs")
}

fn recorded(scenario: &Scenario) -> Run {
    run(scenario, Options { record: true, ..Options::default() }, &mut |_| ()).expect("runs")
}

fn summary(scenario: &Scenario) -> Summary {
    watched(scenario).summary
}

//= paper sec:sim type=test
#[test]
fn the_table_of_the_paper() {
    let runs: Vec<(Scenario, Run)> = FILES
        .iter()
        .map(|file| scenario(file).unwrap())
        .map(|scenario| (scenario.clone(), watched(&scenario)))
        .collect();
    let lines: Vec<Line<'_>> = runs
        .iter()
        .map(|(scenario, run)| Line { scenario, summary: &run.summary, rounds: &run.rounds, wall_s: None })
        .collect();
    let told = text(&table(&lines));
    assert_eq!(told, include_str!("golden/paper_table.txt"), "now:\n{told}");
}

/// Sentences in quotation marks are the paper's, word for word.
#[test]
fn quotations_are_verbatim() {
    let Ok(paper) =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/paper/paper.tex"))
    else {
        return;
    };
    let paper = paper.split_whitespace().collect::<Vec<_>>().join(" ");
    let run = recorded(&Scenario { duration_s: 0.1, ..Scenario::default() });
    let (runs, records) = ([&run.summary; 3], [run.record.as_ref().unwrap(); 3]);
    let five = SectionFive { required: 7, distance_min_m: 0.3, runs, records, unfiltered: &run.summary };
    let quoted: Vec<String> =
        five.claims().into_iter().filter(|claim| claim.is_quotation).map(|claim| claim.sentence).collect();
    assert!(quoted.len() >= 10);
    for sentence in quoted {
        assert!(paper.contains(&sentence), "{sentence}");
    }
}

/// What holds and what does not, from both starts; docs/paper.md tells why.
#[test]
fn the_claims_of_section_five() {
    let not = |start: usize| -> Vec<String> {
        let scenarios = [0, 1, 2].map(|index| scenario(FILES[3 * start + index]).unwrap());
        let runs = scenarios.each_ref().map(recorded);
        let unfiltered = summary(&Scenario { controller: Controller::None, ..scenarios[0].clone() });
        let five = SectionFive {
            required: 7,
            distance_min_m: 0.3,
            runs: runs.each_ref().map(|run| &run.summary),
            records: runs.each_ref().map(|run| run.record.as_ref().unwrap()),
            unfiltered: &unfiltered,
        };
        five.claims().into_iter().filter(|claim| !claim.holds).map(|claim| claim.sentence).collect()
    };
    let always =
        ["and prevent resilient consensus", "[thm:cbf-qp, part 1] The set of all phi_i >= 0 is never left."];
    let by_h = "one malicious robot fails to maintain seven neighbors";
    assert_eq!(not(1), [always[0], by_h, always[1]]);
    let published = [
        "and prevent resilient consensus",
        "while avoiding collisions",
        "leading to a more compact network",
        "[thm:cbf-qp, hypothesis] The start lies in the safe set: every phi_i >= 0.",
        "[thm:cbf-qp, part 1] The set of all phi_i >= 0 is never left.",
    ];
    assert_eq!(not(0), published);
}
