//! Where exact answers end: `cargo run --release -p closeranks-graph --example limits -- [NODES] [FAMILY or QUESTION ...]`.
//!
//! For each family and size it prints `r_max`, `F_max` and the largest F around each node, `F_local`, or those of them that are named, and how many nodes of the search tree each took. NODES is
//! where a question is given up (20 million if left out); the count is the same on every machine and for every number of threads, the
//! seconds are not.
#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "an example")]

use core::ops::ControlFlow;
use std::env;
use std::time::Instant;

use closeranks_graph::decide::Robustness;
use closeranks_graph::effort::{Effort, Meter, Progress};
use closeranks_graph::graph::Graph;
use closeranks_graph::local;
use closeranks_graph::makers::{fixed, random, symmetric};
use closeranks_graph::verdict::Interval;

type Family = (&'static str, Vec<Graph>);

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let nodes = arguments.first().map_or(20_000_000, |nodes| nodes.parse().unwrap());
    println!("family,n,question,answer,nodes,seconds");
    let named = arguments.get(1..).unwrap_or_default();
    let is_asked = |name: &str, all: &[&str]| {
        named.iter().any(|asked| asked == name) || !named.iter().any(|asked| all.contains(&asked.as_str()))
    };
    let questions = [("r_max", r_max as Ask), ("F_max", f_max), ("F_local", f_local)];
    let names = questions.map(|(question, _)| question);
    let asked = || questions.into_iter().filter(|(question, _)| is_asked(question, &names));
    let families = families();
    let names: Vec<&str> = families.iter().map(|(family, _)| *family).collect();
    for (family, graphs) in &families {
        if !is_asked(family, &names) {
            continue;
        }
        for graph in graphs {
            let open = asked().map(|(question, ask)| {
                let (answer, spent, seconds) = ask_within(graph, nodes, ask);
                let answer = match answer.exactly() {
                    Some(number) => number.to_string(),
                    None => format!("{} to {}", answer.least, answer.most),
                };
                println!("{family},{},{question},{answer},{spent},{seconds:.2}", graph.node_count());
                spent >= nodes
            });
            if open.filter(|open| !open).count() == 0 {
                break;
            }
        }
    }
}

type Ask = fn(&mut Robustness<'_>, &mut Meter<'_>) -> Interval;

fn r_max(robustness: &mut Robustness<'_>, meter: &mut Meter<'_>) -> Interval {
    robustness.r_max(meter)
}

fn f_max(robustness: &mut Robustness<'_>, meter: &mut Meter<'_>) -> Interval {
    robustness.f_max(meter)
}

fn f_local(robustness: &mut Robustness<'_>, meter: &mut Meter<'_>) -> Interval {
    local::f_max(robustness, meter).0
}

fn ask_within(graph: &Graph, nodes: u64, ask: Ask) -> (Interval, u64, f64) {
    #[expect(clippy::disallowed_methods, reason = "the time taken is printed")]
    let start = Instant::now();
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    let mut meter = Meter::new(nodes, &mut go_on);
    let mut robustness = Robustness::new(graph, &Effort { nodes, table_bytes: 0 });
    let answer = ask(&mut robustness, &mut meter);
    (answer, meter.nodes(), start.elapsed().as_secs_f64())
}

fn families() -> Vec<Family> {
    let of = |sizes: &[usize], make: &dyn Fn(usize) -> Graph| sizes.iter().map(|n| make(*n)).collect();
    vec![
        (
            "multipartite",
            [(5, 6), (6, 6), (6, 7), (8, 6), (6, 10)]
                .map(|(p, s)| symmetric::multipartite(p, s).unwrap())
                .to_vec(),
        ),
        ("bipartite", of(&[40, 50, 60], &|n| fixed::bipartite(n / 2, n / 2).unwrap())),
        ("rook-complement", of(&[5, 6, 7], &|n| symmetric::rook_complement(n, n).unwrap())),
        ("kneser", of(&[8, 9, 10, 11], &|n| symmetric::kneser(n, 2).unwrap())),
        ("paley", of(&[29, 37, 41, 53, 61], &|n| symmetric::paley(n).unwrap())),
    ]
    .into_iter()
    .chain(random_families())
    .collect()
}

/// All with seed 1.
fn random_families() -> Vec<Family> {
    let of = |sizes: &[usize], make: &dyn Fn(usize) -> Graph| sizes.iter().map(|n| make(*n)).collect();
    let sizes = [16, 18, 20, 22, 24, 26, 28, 30, 32, 34, 36, 38, 40, 42, 44, 46, 48, 50, 52];
    vec![
        ("er-0.8", of(&sizes, &|n| random::erdos_renyi(n, 0.8, false, 1).unwrap())),
        ("regular-0.7", of(&sizes[..14], &|n| random::regular(n, n * 7 / 20 * 2, 1).unwrap())),
        ("regular-half", of(&sizes[..15], &|n| random::regular(n, n / 4 * 2, 1).unwrap())),
        ("er-0.5", of(&sizes, &|n| random::erdos_renyi(n, 0.5, false, 1).unwrap())),
        ("geometric-0.55", of(&sizes, &|n| random::random_geometric(n, 0.55, 1).unwrap())),
    ]
}
