//! tmp
use crate::budget::{Meter, Stopped};
use crate::definition::Witness;
use crate::graph::Graph;
/// tmp
pub fn witness(graph: &Graph, r: usize, s: usize, meter: &mut Meter<'_>) -> Result<Option<Witness>, Stopped> {
    crate::search::witness(graph, r, s, meter)
}
