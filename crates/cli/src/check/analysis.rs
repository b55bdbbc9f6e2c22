//! Everything about one graph: the verdict, the table of (r, s), a witness.

use closeranks_graph::analysis::{Analysis, analyze_with};
use closeranks_graph::connectivity::node_connectivity;
use closeranks_graph::effort::{Effort, Meter};
use closeranks_graph::formats::Named;
use closeranks_graph::graph::Graph;
use closeranks_graph::verdict::{Certificate, Interval};
use closeranks_report::content::Table;
use serde_json::{Map, Value, json};

use super::answer::Answer;
use super::words;

/// Degrees and connectivity, in one line.
pub(super) fn graph(graph: &Graph) -> String {
    let (least, most) = (graph.degree_min(), graph.degree_max());
    let heard = if graph.is_directed() { "in-degrees" } else { "degrees" };
    format!("{heard} {least} to {most}, connectivity {}", node_connectivity(graph))
}

/// The whole answer; intervals where `meter` stopped the search.
pub(super) fn everything(named: &Named, limit: &str, meter: &mut Meter<'_>) -> Answer {
    let analysis = analyze_with(&named.graph, &Effort::UNLIMITED, meter);
    let sentence = verdict(&analysis, limit);
    let answer = Answer {
        holds: analysis.is_exact(),
        sentence,
        table: Some(table(&analysis)),
        why: vec![degrees(&analysis)],
        numbers: numbers(named, &analysis),
        ..Answer::default()
    };
    match &analysis.witness_f {
        Some(witness) => answer.with_witness(named, witness),
        None => answer,
    }
}

/// How many liars it survives, in one sentence.
fn verdict(analysis: &Analysis, limit: &str) -> String {
    let f_max = analysis.f_max;
    if analysis.node_count == 1 {
        return "A single robot: there is nobody to agree with.".to_owned();
    }
    let least = match f_max.least {
        -1 if f_max.most == -1 => "does not agree even if nobody lies".to_owned(),
        -1 => "is not shown to agree even if nobody lies".to_owned(),
        0 => format!("agrees if nobody lies: (1,1)-robust, proved by {}", proof(analysis, 1)),
        f => format!(
            "survives any {}: ({r},{r})-robust, proved by {}",
            liars(f),
            proof(analysis, usize::try_from(f + 1).unwrap_or(0)),
            r = f + 1
        ),
    };
    let over = f_max.most + 2;
    let most = match (f_max.exactly(), f_max.most) {
        (Some(-1), _) => format!("not ({over},{over})-robust"),
        (Some(f), _) => format!("not any {}: not ({over},{over})-robust", liars(f + 1)),
        (None, most) => {
            format!("not any {}; what lies between was not settled within {limit}", liars(most + 1))
        }
    };
    format!("{}; {most}.", words::capital(&least))
}

fn liars(number: i32) -> String {
    words::liars(usize::try_from(number).unwrap_or(0))
}

fn proof(analysis: &Analysis, r: usize) -> String {
    let row = r.checked_sub(1).and_then(|index| analysis.s_max.get(index));
    words::proof(row.map_or(Certificate::Nothing, |(_, certificate)| *certificate))
}

/// What the paper's degree condition says of the same graph.
fn degrees(analysis: &Analysis) -> String {
    let half = analysis.node_count / 2;
    let gives = match analysis.f_by_degree {
        Some(f) => format!("promises this for F = {f}"),
        None => "promises nothing here".to_owned(),
    };
    format!("The degree condition (every honest robot hears F + floor(n/2) = F + {half} or more) {gives}.")
}

/// One line for each r up to the first that is not reached.
fn table(analysis: &Analysis) -> Table {
    let heads = ["r", "largest s", "proved by"].map(str::to_owned).to_vec();
    let mut rows = Vec::new();
    for (index, (s_max, certificate)) in analysis.s_max.iter().enumerate() {
        let how = if s_max.most == 0 { "a witness".to_owned() } else { words::proof(*certificate) };
        rows.push(vec![(index + 1).to_string(), interval(*s_max), how]);
        if s_max.most == 0 {
            break;
        }
    }
    Table { heads, rows }
}

fn interval(number: Interval) -> String {
    match number.exactly() {
        Some(number) => number.to_string(),
        None => format!("{} to {}", number.least, number.most),
    }
}

/// The number, or `[least, most]`.
pub(super) fn value(number: Interval) -> Value {
    number.exactly().map_or_else(|| json!([number.least, number.most]), |number| json!(number))
}

fn numbers(named: &Named, analysis: &Analysis) -> Value {
    let rows = analysis.s_max.iter().enumerate();
    let s_max: Map<String, Value> =
        rows.map(|(index, (s_max, _))| ((index + 1).to_string(), value(*s_max))).collect();
    json!({
        "n": analysis.node_count,
        "directed": analysis.directed,
        "r_max": value(analysis.r_max),
        "f_max": value(analysis.f_max),
        "s_max": s_max,
        "proved": if analysis.is_exact() { "exactly" } else { "bounds" },
        "witness": analysis.witness_f.as_ref().map(|witness| words::witness_value(named, witness)),
    })
}
