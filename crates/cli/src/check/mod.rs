//! `closeranks check GRAPH`: how many liars a network survives, exactly.

mod analysis;
mod answer;
mod certificate;
mod hops;
mod input;
mod mend;
mod network;
mod question;
mod recording;
mod rule;
mod save;
mod task;
mod words;

use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::{Args, ValueEnum};
use closeranks_graph::formats;
use closeranks_graph::network::Network;
use closeranks_sim::consensus::Rule;

use crate::folder::Folder;
use crate::output;
use crate::progress::Watch;
use crate::threads::Threads;
use answer::Answer;
use input::{Input, Source};
use task::Task;

/// Shown by `closeranks check --help`.
pub(crate) const HELP: &str = "\
A graph is a file in one of many formats, told by its content; `-` reads standard input. A file that fits two formats
as two different graphs is refused, and --format chooses. Every answer says what the file was read as.

Read: edge lists (`a b`, `a,b,0.5`, `a -> b`, `a -- b`, tuples of Python, with or without a header), matrices (0 and 1,
True and False, with or without names), adjacency lists (networkx), graph6, digraph6, sparse6, GraphML, GEXF, GML, DOT,
JSON (networkx), Pajek, DIMACS and PACE, MatrixMarket, METIS, LGL, TGF, LEDA.

A directed edge u -> v means that v hears u. In a matrix, row u, column v is the edge u -> v, as networkx and igraph write
it; papers on consensus often mean by a_uv that u hears v: --transpose reads that. Where a file leaves it open, edges have
no direction; --directed gives them one. Parallel links count once and loops not at all, with a note; --strict refuses them.

    closeranks check team.edges                  # how many liars it survives, the table of (r, s), a witness
    closeranks check team.edges --F 2            # one question: any 2 liars? Exit code 0 yes, 1 no or undecided
    closeranks check team.edges --r 3 --s 2      # is it (3,2)-robust?
    closeranks check team.edges -o out           # and a picture of the two sets that never agree
    closeranks check team.edges --F 2 --certificate proof.txt   # and what proves it, for other checkers (docs/proofs.md)
    closeranks check team.edges --F 2 --additions   # which edges to add
    closeranks check team.edges --local          # liars few in every neighbourhood instead of few in all
    closeranks check team.edges --leaders 1,2 --r 3 # do all follow robots 1 and 2?
    closeranks check matrix.csv --directed --transpose   # row u, column v: u hears v
    closeranks check team.edges --rule two-hop --F 1     # what a rule of consensus needs; also of a run: --rule sw-msr --window 5
    closeranks check team.edges --hops 2 --F 1           # robots pass on what they were told: two hops
    closeranks check team.edges --effort 1000000         # stop after so many sets: the same answer on every machine
    closeranks check out/run.parquet --window 5 --F 1    # all links of five rounds together: jointly 3-robust?
    closeranks check many.g6 --which 3           # the third graph of a file with several
    closeranks check out/run.parquet             # a recorded run: robustness at every consensus round
    closeranks check flight.csv --radius 3 --F 1 # positions of others, CSV or Parquet: time_s or tick, robot, x_m, y_m[, z_m]
    closeranks graph petersen | closeranks check -

Graphs of more than 128 robots, up to millions, are looked at for ranks (docs/ranks.md): --F asks whether they survive any F
liars around each robot, and what is neither proved by ranks nor ruled out by degrees is said to be open.

What the words mean, with pictures: docs/robustness.md.

--json prints {n, directed, r_max, f_max, s_max: {\"1\": ..}, proved, witness: {r, s, S1, S2, exempt}, agreement: {groups, between,
liars}, read: {format,
told_by: \"content\" | \"ending\" | \"request\", robots, links, directed, notes: [..]}}. Robots have the
names of the file, as numbers if all are numbers. A number that was not settled within --time-limit is [least, most],
and `proved` is then \"bounds\" instead of \"exactly\". An answer to a question is
{n, directed, question, answer: \"yes\" | \"no\" | \"undecided\", .., read}.

Exit codes: 0 fine, 1 the answer is no or was not found within the time limit, 2 bad input.";

/// How graphs are written down by `closeranks graph`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// One edge `u v` a line.
    Edges,
    /// Rows of 0 and 1.
    Matrix,
    /// graph6 and digraph6 of nauty and networkx.
    Graph6,
    /// GraphML.
    Graphml,
    /// DOT of Graphviz.
    Dot,
    /// JSON as networkx writes it (node-link).
    Json,
}

impl Format {
    /// The format of the library.
    pub(crate) fn of_library(self) -> formats::Format {
        match self {
            Self::Edges => formats::Format::EdgeList,
            Self::Matrix => formats::Format::Matrix,
            Self::Graph6 => formats::Format::Graph6,
            Self::Graphml => formats::Format::GraphMl,
            Self::Dot => formats::Format::Dot,
            Self::Json => formats::Format::Json,
        }
    }
}

/// What is asked of which graph.
#[derive(Args, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of the command line")]
pub(crate) struct Check {
    /// Graph, recorded run (Parquet) or recorded positions (Parquet, CSV); `-` reads standard input.
    #[arg(value_name = "GRAPH")]
    file: PathBuf,
    /// How it is written down; told by its content if left out.
    #[arg(long, value_name = "NAME", value_parser = input::formats())]
    format: Option<formats::Format>,
    /// Edges have a direction, where the file leaves that open: in `u v`, and in row u, column v, v hears u.
    #[arg(long)]
    directed: bool,
    /// Edges have no direction, where the file leaves that open, whatever a comment in it says.
    #[arg(long, conflicts_with = "directed")]
    undirected: bool,
    /// Turn every edge round: in `u v`, and in row u, column v, u hears v.
    #[arg(long)]
    transpose: bool,
    /// Refuse parallel links and loops instead of counting them once or not at all.
    #[arg(long)]
    strict: bool,
    /// In a matrix every number but 0 is a link; otherwise only 0 and 1 are allowed.
    #[arg(long)]
    weights: bool,
    /// Which graph of a file with several (graph6 and its relatives), from 1.
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(1..))]
    which: Option<u32>,
    /// Ask whether the graph is (r,s)-robust.
    #[arg(long, value_name = "R", value_parser = clap::value_parser!(u8).range(1..=128))]
    r: Option<u8>,
    /// The s of (r,s).
    #[arg(long, value_name = "S", requires = "r", value_parser = clap::value_parser!(u8).range(1..=128))]
    s: Option<u8>,
    /// Ask whether it survives any F liars: (F+1,F+1)-robust.
    #[arg(long = "F", value_name = "F", conflicts_with_all = ["r", "s"], value_parser = clap::value_parser!(u8).range(0..=127))]
    faults: Option<u8>,
    /// Strong r-robustness with respect to these robots, names with commas between; with --F, r = 2F + 1.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with_all = ["s", "local", "additions"])]
    leaders: Vec<String>,
    /// Liars that are at most F in every neighbourhood (F-local), however many in all.
    #[arg(long, conflicts_with_all = ["r", "s", "additions"])]
    local: bool,
    /// Ask what this rule of consensus needs of the graph (docs/comparison.md); with --F, bp-msr with --leaders too.
    #[arg(long, value_name = "RULE", value_parser = rule::named(), conflicts_with_all = ["r", "s", "local", "additions"])]
    rule: Option<Rule>,
    /// Of a recorded run: how many rounds are looked at together, for --rule sw-msr, which is meant if no rule is given.
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u16).range(1..=1000))]
    window: Option<u16>,
    /// Robots pass on what they were told, over so many links: robustness with L hops (docs/robustness.md).
    #[arg(long, value_name = "L", value_parser = clap::value_parser!(u8).range(1..=127), conflicts_with_all = ["leaders", "local", "rule", "additions"])]
    hops: Option<u8>,
    /// Which edges to add, as few as can be, until --F or --r and --s hold.
    #[arg(long)]
    additions: bool,
    /// Of a recorded run, look at every K-th tick; every consensus round if left out.
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u32).range(1..))]
    every: Option<u32>,
    /// Of recorded positions, how far robots hear each other, m; needed where the file has no scenario.
    #[arg(long, value_name = "METRES", value_parser = radius)]
    radius: Option<f64>,
    /// Stop after so many seconds of processor time a thread and say what is proved by then; 60 if neither this nor --effort is given.
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<f64>,
    /// Stop after so many sets and say what is proved by then: the same on every machine.
    #[arg(long, value_name = "SETS", value_parser = clap::value_parser!(u64).range(1..))]
    effort: Option<u64>,
    /// Threads of long searches; as many as there are processors if left out. The answer is the same for any number.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Folder for a picture (SVG, PNG) and a page.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// New file for a certificate: the graph and what proves the answer, which others can check.
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,
    /// Print the numbers as JSON.
    #[arg(long)]
    json: bool,
    /// Print nothing but errors.
    #[arg(short, long)]
    quiet: bool,
}

fn radius(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| *number > 0.0 && *number <= 1e9);
    number.ok_or_else(|| "allowed is more than 0 and at most 1e9 metres".to_owned())
}

fn seconds(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| (0.0..=1e9).contains(number));
    number.ok_or_else(|| "allowed is 0 to 1e9 seconds".to_owned())
}

impl Check {
    /// The clock of this question.
    fn watch(&self) -> Watch {
        let seconds = self.time_limit.unwrap_or(if self.effort.is_some() { f64::INFINITY } else { 60.0 });
        Watch::new(seconds, self.threads().count(), self.quiet)
    }

    fn threads(&self) -> Threads {
        self.threads.map_or_else(Threads::all, |threads| Threads::of(usize::from(threads)))
    }

    /// How many sets may be looked at.
    fn sets(&self) -> u64 {
        self.effort.unwrap_or(u64::MAX)
    }

    /// Where the search ends, in words, after "within".
    fn limit(&self) -> String {
        match (self.effort, self.time_limit) {
            (Some(sets), None) => format!("{sets} sets"),
            (Some(sets), Some(seconds)) => format!("{sets} sets or {seconds} s"),
            (None, seconds) => format!("{} s", seconds.unwrap_or(60.0)),
        }
    }
}

/// Answers; false when the answer is no or was not found within the time limit.
pub(crate) fn check(arguments: &Check) -> Result<bool> {
    let folder = arguments.output.as_deref().map(Folder::new).transpose()?;
    match input::read(arguments)? {
        Source::Graph(input) => graph(arguments, &input, folder),
        Source::Network(input) => network::check(arguments, &input),
        Source::Recording(name, recording) => recording::check(arguments, &name, &recording, folder),
    }
}

fn graph(arguments: &Check, input: &Input, folder: Option<Folder>) -> Result<bool> {
    if arguments.every.is_some() {
        bail!("--every is for recorded runs (Parquet files of `closeranks run`, and tables of positions)");
    }
    if arguments.radius.is_some() {
        bail!("--radius is for recorded positions; a graph has its links");
    }
    if arguments.window.is_some() {
        bail!("--window is for recorded runs; a graph is the same in every round");
    }
    let mut watch = arguments.watch();
    let task = Task::new(&input.reading.named, arguments)?;
    let answer = task.answer(&mut watch).with_reading(&input.reading);
    watch.finish();
    if let Some(folder) = folder {
        save::save(folder, input, &answer)?;
    }
    tell(arguments, &answer, "report.html, graph.svg, graph.png");
    if let Some(target) = &arguments.certificate {
        let named = &input.reading.named;
        let name = |node: usize| named.names[node].clone();
        certificate::save(arguments, target, Network::from(&named.graph), answer.proof.clone(), &name)?;
    }
    Ok(answer.holds)
}

fn tell(arguments: &Check, answer: &Answer, files: &str) {
    if arguments.json {
        output::say(&crate::json::text(&answer.numbers));
    } else if !arguments.quiet {
        output::say(&answer.text());
        if let Some(target) = &arguments.output {
            output::say(&format!("\nwritten to {}: {files}\n", target.display()));
        }
    }
}
