//! The definition, branch and bound, and the table of subsets on the same graphs.
//!
//! `cargo bench -p closeranks-graph`. The families of graphs are those of docs/robustness-performance.md.
#![allow(clippy::unwrap_used, reason = "a bench may panic")]

use core::fmt;
use core::ops::ControlFlow;

use closeranks_graph::analysis::largest;
use closeranks_graph::decide::Robustness;
use closeranks_graph::definition;
use closeranks_graph::effort::{Effort, Meter, Progress};
use closeranks_graph::graph::Graph;
use closeranks_graph::makers::random;
use closeranks_graph::table;

const NO_TABLE: Effort = Effort { nodes: u64::MAX, table_bytes: 0 };
const SMALL: [Case; 4] = [er(8, 5), er(10, 5), er(11, 8), Case { family: Family::Paper, count: 11 }];
const LARGE: [Case; 9] = [
    er(20, 5),
    er(24, 5),
    er(28, 5),
    er(20, 8),
    er(24, 8),
    er(28, 8),
    Case { family: Family::Paper, count: 20 },
    Case { family: Family::Paper, count: 24 },
    Case { family: Family::Paper, count: 28 },
];
const TABLE: [Case; 3] = [er(16, 5), er(20, 5), er(24, 5)];

#[derive(Clone, Copy)]
enum Family {
    /// Erdos-Renyi, edges by chance in tenths.
    Er(u8),
    /// Points in a disc, the smallest radius that gives every node floor(n/5) + floor(n/2) neighbours.
    Paper,
}

#[derive(Clone, Copy)]
struct Case {
    family: Family,
    count: usize,
}

const fn er(count: usize, tenths: u8) -> Case {
    Case { family: Family::Er(tenths), count }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.family {
            Family::Er(tenths) => write!(f, "ER.{tenths} n={}", self.count),
            Family::Paper => write!(f, "P n={}", self.count),
        }
    }
}

impl Case {
    fn graph(self) -> Graph {
        match self.family {
            Family::Er(tenths) => {
                random::erdos_renyi(self.count, f64::from(tenths) / 10.0, false, 1).unwrap()
            }
            Family::Paper => paper(self.count),
        }
    }
}

fn paper(count: usize) -> Graph {
    let square = random::unit_square(4 * count, 1).into_iter().map(|[x, y]| [2.0 * x - 1.0, 2.0 * y - 1.0]);
    let disc: Vec<[f64; 2]> = square.filter(|[x, y]| x * x + y * y <= 1.0).take(count).collect();
    let radii = (1..=200).map(|step| f64::from(step) / 100.0);
    let mut graphs = radii.map(|radius| random::geometric(&disc, radius).unwrap());
    graphs.find(|graph| graph.degree_min() >= count / 5 + count / 2).unwrap()
}

fn with_meter<T>(work: impl FnOnce(&mut Meter<'_>) -> T) -> T {
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    work(&mut Meter::new(u64::MAX, &mut go_on))
}

fn main() {
    divan::main();
}

#[divan::bench(args = SMALL, max_time = 2)]
fn r_max_by_definition(bencher: divan::Bencher<'_, '_>, case: &Case) {
    let graph = case.graph();
    bencher.bench(|| (1..=case.count).take_while(|&r| definition::is_robust(&graph, r, 1)).count());
}

#[divan::bench(args = SMALL, max_time = 1)]
fn r_max_and_f_max_of_a_monitor(bencher: divan::Bencher<'_, '_>, case: &Case) {
    let graph = case.graph();
    bencher.bench(|| largest(&graph));
}

#[divan::bench(args = LARGE, max_time = 2)]
fn r_max_by_search(bencher: divan::Bencher<'_, '_>, case: &Case) {
    let graph = case.graph();
    bencher.bench(|| with_meter(|meter| Robustness::new(&graph, &NO_TABLE).r_max(meter)));
}

#[divan::bench(args = LARGE, max_time = 2)]
fn f_max_by_search(bencher: divan::Bencher<'_, '_>, case: &Case) {
    let graph = case.graph();
    bencher.bench(|| with_meter(|meter| Robustness::new(&graph, &NO_TABLE).f_max(meter)));
}

#[divan::bench(args = TABLE, max_time = 2)]
fn r_max_by_table(bencher: divan::Bencher<'_, '_>, case: &Case) {
    let graph = case.graph();
    bencher.bench(|| with_meter(|meter| table::r_max(&graph, 1 << 26, meter)).unwrap().0);
}

#[divan::bench(args = TABLE, max_time = 2)]
fn s_max_by_table(bencher: divan::Bencher<'_, '_>, case: &Case) {
    let graph = case.graph();
    bencher.bench(|| with_meter(|meter| table::s_max(&graph, 4, 1 << 26, meter)).unwrap().0);
}
