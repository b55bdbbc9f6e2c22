//! The Rust side of `benches/compare`: makes the graphs, and times this crate and the definition on one of them.
//!
//! ```text
//! compare graphs                                          a line for each graph: family, n, seed, graph6
//! compare (closeranks|definition) (r_max|f_max) GRAPH6    the answer, and the median seconds of a run
//! ```
#![allow(clippy::print_stdout, reason = "an example prints")]

use core::ops::ControlFlow;
use core::time::Duration;
use std::time::Instant;

use closeranks_graph::decide::Robustness;
use closeranks_graph::definition;
use closeranks_graph::effort::{Effort, Meter, Progress};
use closeranks_graph::formats::{self, Format, Named, Options};
use closeranks_graph::graph::Graph;
use closeranks_graph::makers::{MakerError, random};
use closeranks_graph::verdict::Interval;

const NODE_COUNTS: [usize; 6] = [8, 11, 14, 18, 22, 26];
const SEEDS: [u64; 3] = [1, 2, 3];
const FAMILIES: [&str; 5] = ["ER.3", "ER.5", "ER.8", "paper", "regular"];
/// A run is repeated this often, unless it is long.
const REPEATS: usize = 11;
/// No repeat begins after this much time.
const PATIENCE: Duration = Duration::from_millis(200);

type Failure = Box<dyn core::error::Error>;

fn main() -> Result<(), Failure> {
    let words: Vec<String> = std::env::args().skip(1).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["graphs"] => print_graphs(),
        [method, question, graph6] => {
            let graph =
                formats::read(graph6, &Options { format: Some(Format::Graph6), ..Options::default() })?
                    .named
                    .graph;
            let (answer, seconds) = median_of_runs(answer_by(method, question)?, &graph);
            println!("{answer} {seconds:e}");
            Ok(())
        }
        _ => Err("usage: compare graphs | compare (closeranks|definition) (r_max|f_max) GRAPH6".into()),
    }
}

fn print_graphs() -> Result<(), Failure> {
    for family in FAMILIES {
        for count in NODE_COUNTS {
            for seed in SEEDS {
                let text = formats::write(&Named::from(graph_of(family, count, seed)?), Format::Graph6)?;
                println!("{family} {count} {seed} {}", text.trim_end());
            }
        }
    }
    Ok(())
}

fn graph_of(family: &str, count: usize, seed: u64) -> Result<Graph, MakerError> {
    match family {
        "ER.3" => random::erdos_renyi(count, 0.3, false, seed),
        "ER.5" => random::erdos_renyi(count, 0.5, false, seed),
        "ER.8" => random::erdos_renyi(count, 0.8, false, seed),
        "paper" => paper_like(count, seed),
        _ => random::regular(count, count / 4 * 2, seed),
    }
}

/// Points in a disc, the smallest radius (in steps of 0.01) that gives every node floor(n/5) + floor(n/2) neighbours.
fn paper_like(count: usize, seed: u64) -> Result<Graph, MakerError> {
    let square =
        random::unit_square(4 * count, seed).into_iter().map(|[x, y]| [2.0 * x - 1.0, 2.0 * y - 1.0]);
    let disc: Vec<[f64; 2]> = square.filter(|[x, y]| x * x + y * y <= 1.0).take(count).collect();
    let wanted = count / 5 + count / 2;
    let mut graph = random::geometric(&disc, 0.0)?;
    for step in 1..=200 {
        if graph.degree_min() < wanted {
            graph = random::geometric(&disc, f64::from(step) / 100.0)?;
        }
    }
    Ok(graph)
}

fn answer_by(method: &str, question: &str) -> Result<fn(&Graph) -> i32, Failure> {
    match (method, question) {
        ("closeranks", "r_max") => Ok(|graph| ask(graph, Robustness::r_max)),
        ("closeranks", "f_max") => Ok(|graph| ask(graph, Robustness::f_max)),
        ("definition", "r_max") => Ok(|graph| highest(graph, |r| definition::is_robust(graph, r, 1))),
        ("definition", "f_max") => Ok(|graph| highest(graph, |r| definition::is_robust(graph, r, r)) - 1),
        _ => Err(format!("no {question} by {method}").into()),
    }
}

/// One question to a [`Robustness`] that knows nothing yet.
fn ask<'g>(graph: &'g Graph, question: fn(&mut Robustness<'g>, &mut Meter<'_>) -> Interval) -> i32 {
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    let mut meter = Meter::new(u64::MAX, &mut go_on);
    question(&mut Robustness::new(graph, &Effort::UNLIMITED), &mut meter)
        .exactly()
        .expect("without a limit the answer is exact")
}

/// The last of r = 1, 2, … that `holds`, 0 if the first does not.
fn highest(graph: &Graph, holds: impl Fn(usize) -> bool) -> i32 {
    (1..).zip(1..=graph.node_count()).take_while(|&(_, r)| holds(r)).last().map_or(0, |(answer, _)| answer)
}

#[expect(clippy::disallowed_methods, reason = "a benchmark reads the clock")]
fn median_of_runs(answer: fn(&Graph) -> i32, graph: &Graph) -> (i32, f64) {
    let began = Instant::now();
    let mut answers = Vec::new();
    let mut seconds = Vec::new();
    while seconds.len() < REPEATS && (seconds.is_empty() || began.elapsed() < PATIENCE) {
        let start = Instant::now();
        answers.push(core::hint::black_box(answer(core::hint::black_box(graph))));
        seconds.push(start.elapsed().as_secs_f64());
    }
    assert!(answers.iter().all(|&other| other == answers[0]), "the same question, two answers: {answers:?}");
    seconds.sort_by(f64::total_cmp);
    (answers[0], seconds[seconds.len() / 2])
}
