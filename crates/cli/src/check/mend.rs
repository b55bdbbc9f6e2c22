//! Which edges to add to a graph.

use closeranks_graph::additions::{self, Additions};
use closeranks_graph::effort::{Effort, Meter};
use closeranks_graph::formats::Named;
use serde_json::{Value, json};

use super::answer::{Answer, numbers};
use super::question::undecided;
use super::words;

/// Which edges to add until it is (r,s)-robust.
pub(super) fn additions(named: &Named, (r, s): (usize, usize), limit: &str, meter: &mut Meter<'_>) -> Answer {
    let question = json!({ "additions": true, "r": r, "s": s });
    match additions::additions(&named.graph, r, s, &Effort::UNLIMITED, meter) {
        Ok(Some(found)) => Answer {
            holds: true,
            sentence: added(named, (r, s), &found, limit),
            numbers: numbers(named, &question, "yes", &added_value(named, &found)),
            ..Answer::default()
        },
        Ok(None) => Answer {
            sentence: format!("No edges will do: even the complete graph is not {r}-robust."),
            numbers: numbers(named, &question, "no", &json!({})),
            ..Answer::default()
        },
        Err(_) => undecided(named, &question, &format!("({r},{s})-robust with some more edges"), limit),
    }
}

fn added(named: &Named, (r, s): (usize, usize), found: &Additions, limit: &str) -> String {
    let arrow = if named.graph.is_directed() { "->" } else { "-" };
    let edge = |(from, to): &(usize, usize)| {
        format!("{} {arrow} {}", words::name(named, *from), words::name(named, *to))
    };
    let edges = found.edges.iter().map(edge).collect::<Vec<String>>().join(", ");
    let number = words::count(found.edges.len() as u64, "edge");
    match (found.edges.len(), found.is_smallest()) {
        (0, _) => format!("Nothing to add: it is ({r},{s})-robust."),
        (_, true) => format!("Add {number}, as few as can be, and it is ({r},{s})-robust: {edges}."),
        (_, false) => format!(
            "Add {number} and it is ({r},{s})-robust; {} or more are needed, not settled within {limit}: {edges}.",
            found.least
        ),
    }
}

fn added_value(named: &Named, found: &Additions) -> Value {
    let end = |node: usize| words::values(named, [node].into_iter().collect())[0].clone();
    let edges: Value = found.edges.iter().map(|(from, to)| json!([end(*from), end(*to)])).collect();
    json!({ "edges": edges, "least": found.least })
}
