//! The table of runs: one line a scenario.

use closeranks_graph::verdict::Interval;
use closeranks_sim::law::Law;
use closeranks_sim::monitors::robustness::{Round, weakest};
use closeranks_sim::output::summary::Summary;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::Run;

use super::content::Table;
pub use super::text_table::text;

/// One line of the table.
#[derive(Clone, Copy, Debug)]
pub struct Line<'a> {
    /// What was run.
    pub scenario: &'a Scenario,
    /// What it came to.
    pub summary: &'a Summary,
    /// Exact robustness of its rounds, if it was searched.
    pub rounds: &'a [Round],
    /// Wall time of the run, s, if it was measured.
    pub wall_s: Option<f64>,
}

/// The line of a run, and below it what each of several teams came to by itself.
#[must_use]
pub fn lines_of<'a>(scenario: &'a Scenario, run: &'a Run, wall_s: Option<f64>) -> Vec<Line<'a>> {
    let all = Line { scenario, summary: &run.summary, rounds: &run.rounds, wall_s };
    let teams = scenario.teams.iter().zip(&run.teams).map(|(scenario, team)| Line {
        scenario,
        summary: &team.summary,
        rounds: &team.rounds,
        wall_s: None,
    });
    [all].into_iter().chain(teams).collect()
}

/// Heads of the table; the second line of each is the unit or the kind of robot.
const HEADS: [&str; 14] = [
    "scenario",
    "degree\nnormal",
    "h\nnormal",
    "degree\nmalicious",
    "distance\nleast, m",
    "gyration\nend, m",
    "links\nend",
    "to liars\nmean, m",
    "rounds\nto agree",
    "infea-\nsible",
    "phi_i\n< 0",
    "global\nphi",
    "F_max\nleast",
    "time\nms",
];

/// The table of several runs: least degree and least h of normal robots, least degree of malicious ones, least distance,
/// radius of gyration and number of links at the end, mean distance from normal to malicious robots at the end, rounds
/// until the spread of normal values is below 1, infeasible programs, negative φ_i, least global φ, least F for which the
/// network was (F+1, F+1)-robust in every round (all robots counted, malicious ones too), time.
///
/// φ is a matter of `composed` alone: others have a dash there, and where there are only others no such column.
#[must_use]
pub fn table(lines: &[Line<'_>]) -> Table {
    let phi = lines.iter().any(|line| uses_phi(line.scenario));
    let is_shown = |column: &usize| phi || !PHI.contains(column);
    let shown = |cells: Vec<String>| {
        cells.into_iter().enumerate().filter(|(column, _)| is_shown(column)).map(|(_, cell)| cell).collect()
    };
    let heads = HEADS.map(str::to_owned).to_vec();
    Table { heads: shown(heads), rows: lines.iter().map(|line| shown(row(line))).collect() }
}

/// Columns about φ.
const PHI: [usize; 2] = [10, 11];

/// True if the controller of `scenario` uses φ and φ_i.
#[must_use]
pub fn uses_phi(scenario: &Scenario) -> bool {
    scenario.controller.row().uses_phi
}

fn row(line: &Line<'_>) -> Vec<String> {
    let (summary, extremes) = (line.summary, &line.summary.extremes);
    let degree = |least: Option<u16>| least.map_or("-".to_owned(), |degree| degree.to_string());
    let phi = |text: String| if uses_phi(line.scenario) { text } else { "-".to_owned() };
    vec![
        line.scenario.name.clone(),
        degree(extremes.degree_min),
        number(extremes.h_min, 3),
        degree(extremes.malicious_degree_min),
        number(extremes.distance_min_m, 3),
        number(summary.gyration_m, 3),
        summary.links.to_string(),
        summary.liar_distance_m.map_or("-".to_owned(), |distance| number(distance, 3)),
        extremes.rounds_to_agree.map_or("never".to_owned(), |rounds| rounds.to_string()),
        summary.broken(Law::Feasible).to_string(),
        phi(summary.broken(Law::Shares).to_string()),
        phi(number(extremes.phi_global_min, 3)),
        weakest(line.rounds).map_or("-".to_owned(), |round| proved(round.f_max)),
        line.wall_s.map_or("-".to_owned(), |time| number(time * 1e3, 1)),
    ]
}

/// The number, or the end of the interval that is proved.
fn proved(interval: Interval) -> String {
    interval.exactly().map_or(format!(">= {}", interval.least), |value| value.to_string())
}

/// A number with `digits` after the point; large ones, and small ones that would read as 0, in powers of ten.
#[must_use]
pub fn telling(value: f64, digits: usize) -> String {
    let plain = number(value, digits);
    let vanished = plain.parse() == Ok(0.0) && value != 0.0 && value.is_finite();
    if vanished { format!("{value:.1e}") } else { plain }
}

/// A number with `digits` after the point; very large ones in powers of ten, `-` for what is not a number.
#[must_use]
pub fn number(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let plain = format!("{value:.digits$}");
    if value.abs() >= 1e6 {
        return format!("{value:.1e}");
    }
    if plain.parse() == Ok(0.0) { format!("{:.digits$}", 0.0) } else { plain }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(number(1.234_56, 3), "1.235");
        assert_eq!(number(-0.000_01, 3), "0.000");
        assert_eq!(number(-3.2e21, 3), "-3.2e21");
        assert_eq!(number(f64::NAN, 3), "-");
        assert_eq!(telling(-0.000_031, 4), "-3.1e-5");
        assert_eq!(telling(0.0, 4), "0.0000");
        assert_eq!(number(10.0, 1), "10.0");
    }
}
