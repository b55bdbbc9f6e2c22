//! Controllers side by side: what each came to in one scenario, and what it needs to know.

use closeranks_sim::law::Law;

use super::content::Table;
use super::table::{Line, number};

/// Heads of the table; the second line of each is the unit.
const HEADS: [&str; 15] = [
    "controller",
    "degree\nleast",
    "h\nleast",
    "distance\nleast, m",
    "rounds\nto agree",
    "gyration\nend, m",
    "progress\nm",
    "off wish\nm/s",
    "blocked\ns",
    "dead-\nlock",
    "jerk\nm/s^3",
    "infea-\nsible",
    "links\nend",
    "robot-step\nus",
    "needs to know",
];

/// Where times stand, which differ from run to run.
const TIME: usize = 13;

/// One line a controller: least degree, h and distance over the run; rounds until normal values were within 1 of each other; radius of
/// gyration at the end; how normal robots moved compared with their wishes ([`closeranks_sim::output::conduct`]); programs without a
/// solution; links at the end; time of a robot-step, which is measured and not computed; what the controller needs to know.
///
/// Without `steps_us` there is no column of times, and the table is the same whoever makes it.
#[must_use]
pub fn comparison(lines: &[Line<'_>], steps_us: Option<&[f64]>) -> Table {
    let is_shown = |column: usize| column != TIME || steps_us.is_some();
    let shown = |cells: Vec<String>| {
        cells.into_iter().enumerate().filter(|(column, _)| is_shown(*column)).map(|(_, cell)| cell).collect()
    };
    let step_us = |place: usize| steps_us.and_then(|steps| steps.get(place)).copied().unwrap_or(f64::NAN);
    let rows = lines.iter().enumerate().map(|(place, line)| shown(row(line, step_us(place))));
    Table { heads: shown(HEADS.map(str::to_owned).to_vec()), rows: rows.collect() }
}

fn row(line: &Line<'_>, step_us: f64) -> Vec<String> {
    let (summary, extremes, conduct) = (line.summary, &line.summary.extremes, &line.summary.conduct);
    vec![
        line.scenario.controller.name().to_owned(),
        extremes.degree_min.map_or("-".to_owned(), |degree| degree.to_string()),
        number(extremes.h_min, 3),
        number(extremes.distance_min_m, 3),
        extremes.rounds_to_agree.map_or("never".to_owned(), |rounds| rounds.to_string()),
        number(summary.gyration_m, 3),
        number(conduct.progress_m, 2),
        number(conduct.deviation_m_s, 3),
        number(conduct.blocked_s, 2),
        if conduct.deadlocked { "yes" } else { "no" }.to_owned(),
        number(conduct.jerk_m_s3, 0),
        summary.broken(Law::Feasible).to_string(),
        summary.links.to_string(),
        number(step_us, 2),
        line.scenario.controller.row().needs.to_owned(),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::table::text;
    use closeranks_sim::scenario::{Controller, Scenario};
    use closeranks_sim::world::{Options, run};

    #[test]
    fn the_table_has_a_row_a_controller_and_fits_a_terminal() {
        let runs: Vec<_> = Controller::ALL
            .iter()
            .map(|controller| {
                let scenario = Scenario { duration_s: 0.1, ..Scenario::default() }.under(*controller);
                let summary = run(&scenario, Options::default(), &mut |_| ()).unwrap().summary;
                (scenario, summary)
            })
            .collect();
        let lines: Vec<Line<'_>> = runs
            .iter()
            .map(|(scenario, summary)| Line { scenario, summary, rounds: &[], wall_s: None })
            .collect();
        let steps_us = vec![0.5; lines.len()];
        let table = comparison(&lines, Some(&steps_us));
        assert!(table.rows.iter().all(|row| row.len() == table.heads.len() && row[TIME] == "0.50"));
        assert!(text(&table).lines().all(|line| line.chars().count() <= 80), "{}", text(&table));
        let timeless = comparison(&lines, None);
        assert_eq!(timeless.heads.len() + 1, table.heads.len());
        assert!(!timeless.heads.iter().any(|head| head.starts_with("robot-step")));
        // With wishes that are met by nobody's filter there is nothing that keeps robots from them.
        let none = table.rows.iter().find(|row| row[0] == "none").unwrap();
        assert_eq!((none[7].as_str(), none[14].as_str()), ("0.000", "nothing"));
    }
}
