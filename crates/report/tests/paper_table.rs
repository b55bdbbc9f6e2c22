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

/// What holds and what does not, from both starts; docs/paper.md tells why.
#[test]
fn the_claims_of_section_five() {
    let not = |start: usize| -> Vec<String> {
        let scenarios = [0, 1, 2].map(|index| scenario(FILES[3 * start + index]).unwrap());
        let runs = scenarios.each_ref().map(summary);
        let unfiltered = summary(&Scenario { controller: Controller::None, ..scenarios[0].clone() });
        let five =
            SectionFive { required: 7, distance_min_m: 0.3, runs: runs.each_ref(), unfiltered: &unfiltered };
        five.claims().into_iter().filter(|claim| !claim.holds).map(|claim| claim.sentence).collect()
    };
    let always =
        ["and prevent resilient consensus.", "[thm:cbf-qp, part 1] The set of all phi_i >= 0 is never left."];
    assert_eq!(not(1), always);
    let published = [
        "and prevent resilient consensus.",
        "while avoiding collisions.",
        "leading to a more compact network.",
        "[thm:cbf-qp, hypothesis] The start lies in the safe set: every phi_i >= 0.",
        "[thm:cbf-qp, part 1] The set of all phi_i >= 0 is never left.",
    ];
    assert_eq!(not(0), published);
}
