//! The numbers of the table for machines.

use closeranks_report::content::Claim;
use closeranks_report::numbers;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::Run;
use closeranks_sweep::PROGRAM;
use serde_json::{Map, Value, json};

/// One run of this program that took so many seconds.
pub(crate) fn run(scenario: &Scenario, run: &Run, wall_s: f64) -> Value {
    let mut numbers: Map<String, Value> = numbers::numbers(scenario, run, PROGRAM);
    numbers.insert("wall_time_s".to_owned(), json!(wall_s));
    Value::Object(numbers)
}

/// The claims of one start.
pub(crate) fn claims(claims: &[Claim]) -> Value {
    let claim = |claim: &Claim| {
        json!({
            "sentence": claim.sentence,
            "quotation": claim.is_quotation,
            "holds": claim.holds,
            "numbers": claim.numbers,
        })
    };
    claims.iter().map(claim).collect()
}

/// Text with a line end.
pub(crate) fn text(value: &Value) -> String {
    format!("{value:#}\n")
}
