//! What the page asks of the simulator's own tables, so that it lists nothing by itself.

use closeranks_sim::controllers::{Controller, Counted, Knows};
use closeranks_sim::law::Law;
use closeranks_sim::scenario::Rule;
use serde_json::{Value, json};

/// The largest whole number that a page holds exactly, 2^53 - 1.
const WHOLE_MAX: i64 = 9_007_199_254_740_991;

/// Version, controllers, rules of consensus and laws.
pub(crate) fn about() -> Value {
    json!({
        "version": env!("CARGO_PKG_VERSION"),
        "controllers": Controller::ALL.iter().map(|one| controller(*one)).collect::<Value>(),
        "rules": Rule::ALL.into_iter().filter(|(_, one)| !one.asks_for_more()).map(|(_, one)| rule(one)).collect::<Vec<_>>(),
        "laws": Law::ALL.map(|law| json!({ "name": law.name(), "demand": law.demand() })),
    })
}

/// One row of the table of controllers.
pub(crate) fn controller(controller: Controller) -> Value {
    let row = controller.row();
    json!({
        "name": row.name,
        "about": row.about,
        "ranks": row.ranks,
        "obstacles": row.runs_among_obstacles(),
        "local": row.knows == Knows::Local,
        "guarantees": row.guarantees,
        "keeps_degrees": row.promises.contains(&Law::Degree) && row.counted != Counted::All,
        "promises": row.promises.iter().map(|law| law.name()).collect::<Vec<_>>(),
    })
}

/// A rule of consensus, and the graphs on which it agrees.
pub(crate) fn rule(rule: Rule) -> Value {
    json!({ "name": rule.name(), "condition": rule.condition(), "proved": rule == Rule::default() })
}

/// A TOML text as a value, or what is wrong with it.
pub(crate) fn table(text: &str) -> Result<Value, Value> {
    let problem = |line: usize, message: &str| json!([{ "line": line, "message": message }]);
    let table: toml::Table = toml::from_str(text).map_err(|error| {
        let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or_default();
        problem(before.matches('\n').count() + 1, error.message())
    })?;
    let whole = |value: &toml::Value| value.as_integer().is_some_and(|number| number.abs() > WHOLE_MAX);
    if let Some((key, _)) = table.iter().find(|(_, value)| whole(value)) {
        return Err(problem(1, &format!("`{key}` is too large for a page, allowed is at most {WHOLE_MAX}")));
    }
    serde_json::to_value(table).map_err(|error| problem(1, &error.to_string()))
}
