//! The tables of an advice.

use closeranks_report::content::Table;
use closeranks_report::table::text;
use closeranks_sim::advice::cost::{Cost, Stated};
use closeranks_sim::advice::{Advice, Fit};

use super::numbers::{down, plain, up};

/// One line for each assumption about malicious robots.
pub(super) fn fits(advice: &Advice) -> String {
    let heads = [
        "assume",
        "must\nkeep",
        "h at\nmost",
        "spacing\nleast, m",
        "most\nroom, m",
        "largest\nm",
        "h with\nmost room",
    ];
    table(&heads, advice.fits.iter().map(fit).collect())
}

fn fit(fit: &Fit) -> Vec<String> {
    let (counts, spacings) = (&fit.counts, &fit.spacings);
    vec![
        fit.assume.to_owned(),
        format!("{} of {}", counts.need, counts.counted),
        plain(counts.h_most),
        up(spacings.least_m),
        spacings.best.map_or("none".to_owned(), |best| plain(best.spacing_m)),
        spacings.largest_m.map_or("none".to_owned(), down),
        spacings.best.map_or("-".to_owned(), |best| plain(best.h)),
    ]
}

/// One line for each stated error.
pub(super) fn costs(costs: &[Cost]) -> String {
    let heads = ["stated", "links\nto, m", "apart\nm", "move\nm", "h\nlost", "spacings\nm"];
    table(&heads, costs.iter().map(cost).collect())
}

fn cost(cost: &Cost) -> Vec<String> {
    let spacings = match (cost.spacings.best, cost.spacings.largest_m) {
        (Some(_), Some(largest_m)) => format!("{} to {}", up(cost.spacings.least_m), down(largest_m)),
        _ => "none".to_owned(),
    };
    vec![
        stated(cost),
        plain(cost.link_m),
        plain(cost.apart_m),
        plain(cost.move_max_m),
        plain(cost.h_lost),
        spacings,
    ]
}

/// The error and how much of it.
fn stated(cost: &Cost) -> String {
    let number = plain(cost.stated);
    match cost.error {
        Stated::Nothing => "nothing".to_owned(),
        Stated::Position => format!("position {number} m"),
        Stated::Tracking => format!("tracking {number} m"),
        Stated::Hold => format!("hold +{number} s"),
        Stated::All => "all".to_owned(),
    }
}

fn table(heads: &[&str], rows: Vec<Vec<String>>) -> String {
    text(&Table { heads: heads.iter().map(|head| (*head).to_owned()).collect(), rows })
}
