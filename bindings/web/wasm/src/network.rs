//! How many liars the network of a moment survives, exactly.

use core::ops::ControlFlow;

use closeranks_graph::decide::Robustness;
use closeranks_graph::effort::{Effort, Meter};
use closeranks_graph::graph::set::NodeSet;
use closeranks_graph::makers::random::geometric;
use closeranks_graph::verdict::{Interval, Verdict};
use serde_json::{Value, json};

/// Largest F for which the network is (F+1, F+1)-robust, and whether it is for the F of the team; if not, two sets of robots that
/// would never agree. Null for teams that the search does not take.
pub(crate) fn network(positions_m: &[[f64; 2]], radius_m: f64, faults: u16, nodes: u64) -> Value {
    let Ok(graph) = geometric(positions_m, radius_m) else { return Value::Null };
    let mut go_on = |_: &_| ControlFlow::Continue(());
    let mut meter = Meter::new(nodes, &mut go_on);
    let mut robustness = Robustness::new(&graph, &Effort { nodes, table_bytes: 0 });
    let wanted = usize::from(faults) + 1;
    let verdict = robustness.decide(wanted, wanted, &mut meter);
    let f_max = robustness.f_max(&mut meter);
    let (robust, sets) = match verdict {
        Verdict::Robust(_) => (Some(true), None),
        Verdict::NotRobust(witness) => (Some(false), Some([numbers(witness.first), numbers(witness.second)])),
        Verdict::Unknown => (None, None),
    };
    let Interval { least, most } = f_max;
    json!({ "f_least": least, "f_most": most, "robust": robust, "sets": sets })
}

/// Numbers of robots, from 1.
fn numbers(set: NodeSet) -> Vec<usize> {
    set.iter().map(|node| node + 1).collect()
}
