//! Evidence by search: the choices of a search over roles, written down and checked.

use super::{Claim, Refused};
use crate::effort::{Meter, Stopped};
use crate::network::Network;
use crate::ranks::Order;
use crate::roles::{self, Liars, Question, Refutation};

/// Evidence by search has so many choices at most: a text of about ten megabytes.
pub const CHOICES_MAX: usize = 1 << 20;

/// The claim that the network is (r,s)-robust, with the choices of a search; `None` if it is not, or if it has more than 128 nodes.
/// Stopped too if there are more than [`CHOICES_MAX`] choices.
pub fn of_robust(
    network: &Network,
    r: usize,
    s: usize,
    meter: &mut Meter<'_>,
) -> Result<Option<Claim>, Stopped> {
    let Ok(graph) = network.graph() else { return Ok(None) };
    if r == 0 || s == 0 {
        return Ok(None);
    }
    let question = Question { r, liars: Liars::Total { s } };
    let refutation = roles::refutation(&graph, question, CHOICES_MAX, meter)?;
    Ok(refutation.map(|refutation| Claim::Search { r, s, refutation }))
}

/// The claim that the order proves, by counting or else with the choices of a search in its core; `None` if it proves nothing.
/// Stopped too if there are more than [`CHOICES_MAX`] choices.
pub fn of_order(network: &Network, order: Order, meter: &mut Meter<'_>) -> Result<Option<Claim>, Stopped> {
    if order.counts(network).is_ok() {
        return Ok(Some(Claim::Ranks(order)));
    }
    let Some(core) = order.core_graph(network) else { return Ok(None) };
    let refutation = roles::refutation(&core, local(order.f), CHOICES_MAX, meter)?;
    Ok(refutation.map(|refutation| Claim::SearchedRanks { order, refutation }))
}

fn local(f: usize) -> Question {
    Question { r: f.saturating_add(1), liars: Liars::Local }
}

//= theory sec:roles
pub(super) fn robust(network: &Network, r: usize, s: usize, refutation: &Refutation) -> Result<(), Refused> {
    if r == 0 || s == 0 {
        return Err(Refused::Zero);
    }
    let graph = network.graph().map_err(|_| Refused::Large { nodes: network.node_count() })?;
    refutation.check(&graph, Question { r, liars: Liars::Total { s } }).map_err(Refused::Choices)
}

//= theory thm:ranks-exact
pub(super) fn ranks(network: &Network, order: &Order, refutation: &Refutation) -> Result<(), Refused> {
    order.around_core(network).map_err(Refused::Order)?;
    let core = order.core_graph(network).ok_or(Refused::Large { nodes: order.core.len() })?;
    refutation.check(&core, local(order.f)).map_err(Refused::Choices)
}
