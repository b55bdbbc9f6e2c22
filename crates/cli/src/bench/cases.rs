//! What is run: fixed scenarios, and lies about values for the rules of consensus.

use anyhow::{Result, anyhow};
use closeranks_sim::attack::ValueAttack;
use closeranks_sim::parse;
use closeranks_sim::scenario::{Controller, Scenario};

/// The version of cases and scores. It rises with any change of either, so that numbers of one version can be compared.
pub(super) const VERSION: u32 = 2;

/// Names and texts of the cases for controllers.
const CASES: [(&str, &str); 7] = [
    ("task", include_str!("../../../../scenarios/bench/task.toml")),
    ("slow", include_str!("../../../../scenarios/bench/slow.toml")),
    ("lossy", include_str!("../../../../scenarios/bench/lossy.toml")),
    ("faces", include_str!("../../../../scenarios/bench/faces.toml")),
    ("noise", include_str!("../../../../scenarios/bench/noise.toml")),
    ("lag", include_str!("../../../../scenarios/bench/lag.toml")),
    ("crowd", include_str!("../../../../scenarios/bench/crowd.toml")),
];

/// Lies about values for the rules of consensus: all normal robots run `links`, from the starts of `task`.
const LIES: [(&str, ValueAttack); 6] = [
    ("random", ValueAttack::Random { min: -500.0, max: 500.0 }),
    ("constant", ValueAttack::Constant { value: 500.0 }),
    ("extreme", ValueAttack::Extreme),
    ("faces", ValueAttack::Faces { min: -500.0, max: 500.0 }),
    ("sway", ValueAttack::Sway),
    ("split", ValueAttack::Split),
];

/// A scenario with a name.
#[derive(Clone, Debug)]
pub(super) struct Case {
    /// Its name.
    pub(super) name: &'static str,
    scenario: Scenario,
}

impl Case {
    /// The run of this number, which is its seed, from 1.
    pub(super) fn run(&self, number: u64) -> Scenario {
        Scenario { seed: number, ..self.scenario.clone() }
    }
}

/// The cases for controllers.
pub(super) fn for_controllers() -> Result<Vec<Case>> {
    CASES.iter().map(|(name, text)| Ok(Case { name, scenario: read(name, text)? })).collect()
}

/// The cases for rules of consensus.
pub(super) fn for_rules() -> Result<Vec<Case>> {
    let (name, text) = CASES[0];
    let task = read(name, text)?.under(Controller::Links);
    let cases = LIES.iter().map(|(name, value)| {
        let attack = (*value).into();
        Case { name, scenario: Scenario { attack, ..task.clone() } }
    });
    Ok(cases.collect())
}

fn read(name: &str, text: &str) -> Result<Scenario> {
    parse::scenario(text).map_err(|problems| anyhow!("case `{name}` cannot be read: {problems:?}"))
}
