//! The picture of docs/ranks.md, on standard output: forty robots that pull outwards, with ranks of their own and under the paper's rule.

use core::error::Error;
use std::io::Write as _;

use closeranks_report::figure::{Case, swarm};
use closeranks_sim::parse::scenario;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{Options, run};

fn main() -> Result<(), Box<dyn Error>> {
    let read = |text: &str| scenario(text).map_err(|problems| format!("{problems:?}"));
    let own = read(include_str!("../../../scenarios/ranks.toml"))?;
    let paper = read(include_str!("../../../scenarios/ranks-paper.toml"))?;
    let recorded = |scenario: &Scenario| -> Result<_, Box<dyn Error>> {
        let run = run(scenario, Options { record: true, ..Options::default() }, &mut |_| ())?;
        Ok(run.record.ok_or("a record was asked for")?)
    };
    let (with, without) = (recorded(&own)?, recorded(&paper)?);
    let svg = swarm(&[
        Case { title: "ranks", scenario: &own, record: &with },
        Case { title: "the paper's rule", scenario: &paper, record: &without },
    ]);
    std::io::stdout().write_all(svg.as_bytes())?;
    Ok(())
}
