//! One graph of the data set as a line.

use core::ops::ControlFlow;

use closeranks_graph::analysis::{Analysis, analyze};
use closeranks_graph::decide::Robustness;
use closeranks_graph::definition::Witness;
use closeranks_graph::effort::{Effort, Meter, Progress};
use closeranks_graph::formats::{Format, Named, write};
use closeranks_graph::graph::Graph;
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::local;
use closeranks_graph::verdict::Certificate;

use crate::recipes::Recipe;

/// The names of the columns.
pub(crate) const HEAD: &str = "command,n,directed,links,degree_min,degree_max,connectivity,r_least,r_most,F_least,F_most,F_local_least,\
                        F_local_most,s_least,s_most,proof_r,proof_F,r_S1,r_S2,F_S1,F_S2,sets,graph6";

/// Nodes of the search tree that one graph may take.
const NODES: u64 = 1_000_000;

/// Up to so many nodes the largest F around each node is asked for.
const LOCAL_NODES: usize = 9;

/// All that is known of one graph.
pub(crate) fn row(recipe: &Recipe) -> String {
    let graph = &recipe.graph;
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    let known = analyze(graph, &Effort { nodes: NODES, table_bytes: 0 }, &mut go_on);
    let (local_least, local_most) = local(graph, &known);
    let s = |end: fn(&closeranks_graph::verdict::Interval) -> i32| {
        words(known.s_max.iter().map(|(interval, _)| end(interval)))
    };
    let [r_first, r_second] = sides(known.witness_r.as_ref());
    let [f_first, f_second] = sides(known.witness_f.as_ref());
    [
        recipe.command.clone(),
        known.node_count.to_string(),
        u8::from(known.directed).to_string(),
        graph.edge_count().to_string(),
        known.degree_min.to_string(),
        known.degree_max.to_string(),
        known.connectivity.to_string(),
        known.r_max.least.to_string(),
        known.r_max.most.to_string(),
        known.f_max.least.to_string(),
        known.f_max.most.to_string(),
        local_least.to_string(),
        local_most.to_string(),
        s(|interval| interval.least),
        s(|interval| interval.most),
        proof(&known, known.r_max.least).to_owned(),
        proof(&known, known.f_max.least + 1).to_owned(),
        r_first,
        r_second,
        f_first,
        f_second,
        known.nodes.to_string(),
        write(&Named::from(graph.clone()), Format::Graph6).unwrap().trim().to_owned(),
    ]
    .join(",")
}

/// Of small graphs exact, else what degrees and r_max leave open.
fn local(graph: &Graph, known: &Analysis) -> (i32, i32) {
    let by_degree = known.f_by_degree.and_then(|f| i32::try_from(f).ok()).unwrap_or(-1);
    let least = known.f_local_least().unwrap_or(-1).max(by_degree);
    if graph.node_count() > LOCAL_NODES {
        return (least, known.f_max.most);
    }
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    let mut robustness = Robustness::new(graph, &Effort::UNLIMITED);
    let exact = local::f_max(&mut robustness, &mut Meter::new(u64::MAX, &mut go_on)).0.exactly().unwrap();
    assert!((least..=known.f_max.most).contains(&exact), "{exact} is not in {least} to {}", known.f_max.most);
    (exact, exact)
}

/// How it is known that s is as large as it is at this r.
fn proof(known: &Analysis, r: i32) -> &'static str {
    let place = usize::try_from(r).ok().and_then(|r| r.checked_sub(1));
    match place.and_then(|place| known.s_max.get(place)) {
        None | Some((_, Certificate::Nothing)) => "nothing",
        Some((_, Certificate::Degrees { .. })) => "degrees",
        Some((_, Certificate::Pairs)) => "pairs",
        Some((_, Certificate::Eigenvalues)) => "eigenvalues",
        Some((_, Certificate::Search { .. })) => "search",
        Some((_, Certificate::Table { .. })) => "table",
        Some(_) => "shifted",
    }
}

fn sides(witness: Option<&Witness>) -> [String; 2] {
    let numbers = |set: NodeSet| words(set.iter());
    witness.map_or_else(Default::default, |witness| [witness.first, witness.second].map(numbers))
}

fn words<T: ToString>(values: impl Iterator<Item = T>) -> String {
    values.map(|value| value.to_string()).collect::<Vec<String>>().join(" ")
}
