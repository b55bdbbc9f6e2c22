//! Who is linked with whom.

use closeranks_core::num::Vector;
use closeranks_mcap::links::links_between;
use closeranks_sim::output::record::Record;

pub(crate) use closeranks_mcap::links::Link;

/// Position of robot `index` at `tick`, m; missing axes are 0, missing rows not a number.
#[must_use]
pub(crate) fn position(record: &Record, tick: usize, index: usize) -> Vector<3> {
    let row = record.row(tick, index);
    core::array::from_fn(|axis| {
        record.positions_m.get(axis).map_or(0.0, |column| column.get(row).copied().unwrap_or(f64::NAN))
    })
}

/// The links of `tick`, in the order of their numbers.
#[must_use]
pub(crate) fn links(record: &Record, radius_m: f64, tick: usize) -> Vec<Link> {
    let robots = usize::from(record.robots);
    let positions: Vec<Vector<3>> = (0..robots).map(|index| position(record, tick, index)).collect();
    links_between(&positions, &record.malicious, radius_m)
}
