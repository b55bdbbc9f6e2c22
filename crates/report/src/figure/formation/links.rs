//! Who is linked with whom.

use closeranks_core::num::Vector;
use closeranks_mcap::links::links_between;
use closeranks_sim::output::record::Record;
use closeranks_sim::scenario::Scenario;

pub(crate) use closeranks_mcap::links::Link;

/// Position of robot `index` at `tick`, m; missing axes are 0, missing rows not a number.
#[must_use]
pub(crate) fn position(record: &Record, tick: usize, index: usize) -> Vector<3> {
    let row = record.row(tick, index);
    core::array::from_fn(|axis| {
        record.positions_m.get(axis).map_or(0.0, |column| column.get(row).copied().unwrap_or(f64::NAN))
    })
}

/// The links of `tick` in this scenario, in the order of their numbers.
#[must_use]
pub(crate) fn links(record: &Record, scenario: &Scenario, tick: usize) -> Vec<Link> {
    links_between(
        &positions(record, tick),
        &record.malicious,
        scenario.link.radius_m,
        &scenario.obstacles.list,
    )
}

/// Pairs of robots that are no farther apart than this at `tick`, whatever stands between them.
#[must_use]
pub(crate) fn pairs_within(record: &Record, distance_m: f64, tick: usize) -> Vec<Link> {
    links_between(&positions(record, tick), &record.malicious, distance_m, &[])
}

/// Pairs of robots within R of each other at `tick` that would have a link if nothing cut it.
#[must_use]
pub(crate) fn cut_links(record: &Record, scenario: &Scenario, tick: usize) -> Vec<Link> {
    if !scenario.obstacles.cut_links() {
        return Vec::new();
    }
    let linked = links(record, scenario, tick);
    let mut cut = pairs_within(record, scenario.link.radius_m, tick);
    cut.retain(|pair| !linked.contains(pair));
    cut
}

fn positions(record: &Record, tick: usize) -> Vec<Vector<3>> {
    (0..usize::from(record.robots)).map(|index| position(record, tick, index)).collect()
}
