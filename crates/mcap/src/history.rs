//! What a recorded run looked like: enough moments of it to be seen again, from Parquet and from MCAP, and as lines of JSON.

use core::fmt::Write as _;

use closeranks_sim::output::snapshot::Snapshot;

/// Moments that are kept at most; of longer runs every second one, fourth one, and so on.
pub const MOMENTS_MAX: usize = 3000;
/// What is known of every robot, by the names of the columns of our Parquet files.
pub const COLUMNS: [&str; 6] = ["x_m", "y_m", "degree", "level", "h", "value"];

/// Moments of a run, oldest first.
#[derive(Clone, Debug, PartialEq)]
pub struct History {
    /// The scenario, TOML.
    pub scenario: String,
    /// n.
    pub robots: usize,
    /// The tick of each moment, ascending.
    pub ticks: Vec<u32>,
    /// For each of [`COLUMNS`] one number a moment and robot.
    pub columns: [Vec<f64>; COLUMNS.len()],
}

/// Every how many ticks there is a moment, of a run with so many.
#[must_use]
pub fn stride(ticks: usize) -> usize {
    ticks.div_ceil(MOMENTS_MAX).next_power_of_two()
}

impl History {
    /// The moments as lines of JSON: first the scenario, then a line a moment. A number that is none is `null`.
    #[must_use]
    pub fn lines(&self) -> String {
        let mut text = opening(&self.scenario);
        for (place, tick) in self.ticks.iter().enumerate() {
            let rows = place * self.robots..(place + 1) * self.robots;
            text.push_str(&line(*tick, self.columns.each_ref().map(|column| &column[rows.clone()])));
        }
        text
    }
}

/// The first line, which says the scenario.
#[must_use]
pub fn opening(scenario: &str) -> String {
    format!("{}\n", serde_json::json!({ "scenario": scenario }))
}

/// The line of one moment, as [`History::lines`] has it, while a run goes on.
#[must_use]
pub fn moment(now: &Snapshot<'_>) -> String {
    let [x_m, y_m] = [0, 1].map(|axis| now.axis(now.positions_m, axis).collect::<Vec<f64>>());
    let degree: Vec<f64> = now.degree.iter().copied().map(f64::from).collect();
    let h: Vec<f64> = (0..now.robots()).map(|index| now.h(index)).collect();
    line(now.tick, [&x_m, &y_m, &degree, now.level, &h, now.value])
}

fn line(tick: u32, columns: [&[f64]; COLUMNS.len()]) -> String {
    let mut text = format!("{{\"tick\":{tick}");
    for (name, numbers) in COLUMNS.iter().zip(columns) {
        // Writing into a text does not fail.
        let _ = write!(text, ",\"{name}\":{}", serde_json::json!(numbers));
    }
    text.push_str("}\n");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moment_is_a_line_of_json() {
        let mut columns: [Vec<f64>; 6] = [0.1, 1.1, 2.1, 3.1, 4.1, 5.1].map(|number| vec![number; 2]);
        columns[4][1] = f64::NAN;
        let history = History { scenario: "seed = 7\n".to_owned(), robots: 2, ticks: vec![3], columns };
        let lines = history.lines();
        let lines: Vec<serde_json::Value> =
            lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert_eq!(lines[0]["scenario"], "seed = 7\n");
        assert_eq!((&lines[1]["tick"], &lines[1]["x_m"]), (&3.into(), &serde_json::json!([0.1, 0.1])));
        assert_eq!(lines[1]["h"], serde_json::json!([4.1, null]));
    }

    #[test]
    fn strides_keep_enough_and_not_too_much() {
        for (ticks, wanted) in [(0, 1), (1, 1), (3000, 1), (3001, 2), (9000, 4), (2_000_001, 1024)] {
            assert_eq!(stride(ticks), wanted, "{ticks}");
        }
    }
}
