//! What was broken at all, as a table: also where nothing promised that it would hold.

use closeranks_sim::law::Law;

use super::tally::Tally;
use crate::page::content::Table;

/// What the table shows.
pub const CAPTION: &str = "Runs in which something was broken at all, also where assumptions did not hold:";

/// One line a law that is about the network or the values, one column a controller.
#[must_use]
pub fn table(tally: &Tally) -> Table {
    let mut heads = vec!["law".to_owned()];
    heads.extend(tally.controllers.keys().cloned());
    let laws = Law::ALL.into_iter().filter(|law| !law.is_about_phi());
    let runs = |law: Law| {
        let counts = tally.controllers.values().map(move |share| share.broken.get(law.name()));
        let told = counts.map(|count| count.map_or("-".to_owned(), u64::to_string)); // nobody looked
        core::iter::once(law.name().to_owned()).chain(told).collect()
    };
    Table { heads, rows: laws.map(runs).collect() }
}
