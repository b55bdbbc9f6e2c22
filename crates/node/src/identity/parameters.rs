//! The settings of a team as text: those tables of a scenario that every robot must have alike. They stand in the roster, so
//! that the operator's signature covers them.

use closeranks_core::need::Listen;
use closeranks_core::{Params, ParamsError};
use closeranks_sim::controllers::Make;
use closeranks_sim::parse;
use closeranks_sim::scenario::Scenario;
use closeranks_sim::scenario::ranks::How;

/// The tables of a scenario that are settings.
const TABLES: [&str; 6] = ["team", "link", "controller", "links", "clock", "consensus"];
/// What stands beside the tables.
const FIELDS: [&str; 1] = ["dimension"];
/// A setting of the world that stands in the table `team` of a scenario and that no robot may know.
const MALICIOUS: &str = "malicious";

/// Why a text does not hold the settings of a team.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ParametersError {
    /// It is not TOML.
    #[error("{0}")]
    Toml(String),
    /// It has something that is no setting.
    #[error(
        "`{0}` is no setting of a team, allowed are dimension, team (without malicious), link, controller, links, clock, consensus"
    )]
    Foreign(String),
    /// A setting is wrong.
    #[error("line {line} of the parameters: {problem}")]
    Setting {
        /// The line, from 1.
        line: usize,
        /// What is wrong there.
        problem: String,
    },
    /// Settings that do not go together.
    #[error(transparent)]
    Params(#[from] ParamsError),
    /// Ranks that are chosen from where robots start, which a roster does not know.
    #[error(
        "`team.ranks` must be a list with the rank of each robot, because a roster does not know where robots start: \
         `closeranks-node roster new --parameters` makes the list of a whole scenario"
    )]
    Ranks,
    /// The controller looks at the whole team.
    #[error("controller `{0}` needs to see the whole team, a robot by itself cannot run it")]
    Global(&'static str),
}

/// The settings in the text of a scenario, as text again: without start, motion, faults, attacks and who lies. Ranks that are chosen from
/// the start become a list.
pub fn extract(scenario: &str) -> Result<String, ParametersError> {
    let mut table: toml::Table = toml::from_str(scenario).map_err(toml_error)?;
    let ranks = ranks(&parsed(scenario)?);
    table.retain(|key, _| TABLES.contains(&key) || FIELDS.contains(&key));
    if let Some(toml::Value::Table(team)) = table.get_mut("team") {
        team.remove(MALICIOUS);
        if let Some(ranks) = ranks {
            team.insert("ranks".into(), ranks);
        }
    }
    let text = toml::to_string(&table).map_err(|error| ParametersError::Toml(error.to_string()))?;
    read(&text)?;
    Ok(text)
}

/// The ranks of a scenario as a list, and whose values robots take.
fn ranks(scenario: &Scenario) -> Option<toml::Value> {
    let ranks = if scenario.dimension == 3 { scenario.ranks::<3>() } else { scenario.ranks::<2>() };
    let list = ranks.ok().flatten()?.into_iter().map(|rank| toml::Value::Integer(rank.into()));
    let listen = match scenario.ranking()?.listen {
        Listen::All => "all",
        Listen::Counted => "counted",
    };
    let both = [("list", toml::Value::Array(list.collect())), ("listen", toml::Value::String(listen.into()))];
    Some(toml::Value::Table(both.map(|(key, value)| (key.to_owned(), value)).into_iter().collect()))
}

fn parsed(text: &str) -> Result<Scenario, ParametersError> {
    parse::scenario(text).map_err(|problems| {
        let first = problems.first();
        let line = first.map_or(0, |problem| problem.line(text));
        ParametersError::Setting { line, problem: first.map(ToString::to_string).unwrap_or_default() }
    })
}

/// The settings in a text that has nothing but settings.
pub fn read(text: &str) -> Result<Scenario, ParametersError> {
    let table: toml::Table = toml::from_str(text).map_err(toml_error)?;
    if let Some(key) =
        table.keys().find(|key| !TABLES.contains(&key.as_str()) && !FIELDS.contains(&key.as_str()))
    {
        return Err(ParametersError::Foreign(key.clone()));
    }
    if table.get("team").and_then(|team| team.get(MALICIOUS)).is_some() {
        return Err(ParametersError::Foreign(format!("team.{MALICIOUS}")));
    }
    let scenario = parsed(text)?;
    if scenario.ranking().is_some_and(|ranking| !matches!(ranking.how, How::Listed(_))) {
        return Err(ParametersError::Ranks);
    }
    let row = scenario.controller.row();
    if matches!(row.make, Make::Global(_)) {
        return Err(ParametersError::Global(row.name));
    }
    if scenario.dimension == 3 {
        check::<3>(&scenario)?;
    } else {
        check::<2>(&scenario)?;
    }
    Ok(scenario)
}

fn check<const D: usize>(scenario: &Scenario) -> Result<(), ParametersError> {
    let _: Params<D> = scenario.params()?;
    Ok(())
}

#[expect(clippy::needless_pass_by_value, reason = "it is handed to map_err")]
fn toml_error(error: toml::de::Error) -> ParametersError {
    ParametersError::Toml(error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scenario_gives_its_settings_and_nothing_else() {
        let text = extract(include_str!("../../../../scenarios/lossy.toml")).unwrap();
        assert_eq!(text, "[controller]\nkind = \"budget\"\n");
        let text = extract("seed = 3\n[team]\nrobots = 5\nfaults = 1\nmalicious = [2]\n").unwrap();
        assert!(!text.contains("malicious") && !text.contains("seed"));
        assert_eq!(read(&text).unwrap().team.robots, 5);
    }

    /// Settings of `links` and the rule of consensus were left out once: robots ran with the defaults, whatever the scenario said.
    #[test]
    fn settings_of_every_controller_and_rule_are_in_the_roster() {
        let text = "[controller]\nkind = 'links'\n[links]\ngamma = 0.25\n[consensus]\nrule = 'median'\n";
        let (all, kept) = (parsed(text).unwrap(), read(&extract(text).unwrap()).unwrap());
        assert_eq!((kept.links, kept.consensus), (all.links, all.consensus));
    }

    #[test]
    fn ranks_that_are_chosen_from_the_start_become_a_list() {
        let text = include_str!("../../../../scenarios/ranks.toml");
        let (all, kept) = (parsed(text).unwrap(), read(&extract(text).unwrap()).unwrap());
        let Some(How::Listed(list)) = kept.ranking().map(|ranking| ranking.how.clone()) else {
            panic!("{:?}", kept.ranks)
        };
        assert_eq!(Some(list), all.ranks::<2>().unwrap());
        assert_eq!(kept.params::<2>().unwrap().need(), all.params::<2>().unwrap().need());
        let chosen = "[team]\nrobots = 40\nranks = { core = 7 }\n[controller]\nkind = 'links'\n";
        assert_eq!(read(chosen).unwrap_err(), ParametersError::Ranks);
    }

    #[test]
    fn what_is_no_setting_is_refused_with_its_name() {
        let refused = |text| read(text).unwrap_err().to_string();
        assert!(refused("seed = 3").starts_with("`seed` is no setting of a team"));
        assert!(refused("[team]\nmalicious = [1]").starts_with("`team.malicious`"));
        assert_eq!(
            refused("[team]\nrobots = 5\nfaults = 3"),
            "line 3 of the parameters: `team.faults` is 3, allowed is 0 to 2 (2F + 1 <= n = 5)"
        );
        assert!(refused("[controller]\nkind = \"orca\"").contains("orca"));
        assert!(refused("[team").contains("TOML parse error"));
    }
}
