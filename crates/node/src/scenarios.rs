//! The file of a fleet: a scenario of the simulator, and beside it the table `fleet` with what happens to processes.

use std::fs;
use std::path::{Path, PathBuf};

use closeranks_sim::parse::{self, TEXT_MAX};
use closeranks_sim::scenario::Scenario;
use serde::Deserialize;

/// A scenario with what happens to processes.
#[derive(Clone, Debug, PartialEq)]
pub struct FleetScenario {
    /// What the simulator knows of it.
    pub scenario: Scenario,
    /// Its text.
    pub text: String,
    /// What happens to processes.
    pub fleet: Fleet,
}

/// What happens to processes.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Fleet {
    /// Robots that are ended with SIGKILL.
    pub kill: Vec<Kill>,
    /// When the router, which the relay is part of, is ended and started again, s.
    pub restart_router_s: Vec<f64>,
    /// How many messages of noise, changed and old ones an outsider puts on keys of the team a second.
    pub garbage_per_s: f64,
    /// Malicious robots that lie in another way than the table `attack` says.
    pub liar: Vec<Liar>,
}

/// A malicious robot with an attack of its own.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Liar {
    /// Which one.
    pub robot: u16,
    /// What stands in the place of the table `attack` for it.
    pub attack: toml::Table,
}

/// A robot that is ended and comes back.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Kill {
    /// Which one.
    pub robot: u16,
    /// When, s after all robots are there.
    pub at_s: f64,
    /// When it is started again, s; never if it is left out.
    pub back_s: Option<f64>,
}

/// Why a file is no scenario.
#[derive(Debug, thiserror::Error)]
pub enum ScenarioError {
    /// The file cannot be read.
    #[error("{path}: {error}")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why not.
        error: std::io::Error,
    },
    /// It is longer than a scenario.
    #[error("{path} has more than {TEXT_MAX} bytes")]
    Long {
        /// Which file.
        path: PathBuf,
    },
    /// Something in it is wrong.
    #[error("{path}:{line}: {problem}")]
    Problem {
        /// Which file.
        path: PathBuf,
        /// Which line, from 1.
        line: usize,
        /// What is wrong.
        problem: String,
    },
}

/// The scenario in a file.
pub fn load(path: &Path) -> Result<FleetScenario, ScenarioError> {
    let file = |error| ScenarioError::File { path: path.to_owned(), error };
    let most = u64::try_from(TEXT_MAX).unwrap_or(u64::MAX);
    if fs::metadata(path).map_err(file)?.len() > most {
        return Err(ScenarioError::Long { path: path.to_owned() });
    }
    read(&fs::read_to_string(path).map_err(file)?, path)
}

/// The scenario in the text of the file at `path`.
pub fn read(text: &str, path: &Path) -> Result<FleetScenario, ScenarioError> {
    let wrong = |line, problem| ScenarioError::Problem { path: path.to_owned(), line, problem };
    let scenario = parse::scenario(text).map_err(|problems| match problems.first() {
        Some(problem) => wrong(problem.line(text), problem.to_string()),
        None => wrong(1, "is no scenario".into()),
    })?;
    let table: Table = toml::from_str(text).map_err(|error| {
        let before = text.get(..error.span().map_or(0, |span| span.start)).unwrap_or_default();
        wrong(before.matches('\n').count() + 1, error.message().to_owned())
    })?;
    if !scenario.consensus.is_of_robots() {
        let found =
            "`consensus` asks for a rule, or for values of several numbers, that only the simulator has";
        return Err(wrong(
            1,
            format!("{found}; allowed are w-msr, trimmed-mean, median and linear in one dimension"),
        ));
    }
    if !scenario.obstacles.list.is_empty() {
        let found = "`obstacles` are known to the simulator alone: robots as processes have no map yet";
        return Err(wrong(1, format!("{found}; allowed is a scenario without any")));
    }
    if !scenario.teams.is_empty() {
        let found = "`teams` are known to the simulator alone: robots as processes sense no other teams yet";
        return Err(wrong(1, format!("{found}; allowed is [team], one team")));
    }
    if !scenario.absences.is_empty() {
        let found = "`team.absent` is known to the simulator alone";
        return Err(wrong(1, format!("{found}; allowed for processes is fleet.kill")));
    }
    table.fleet.check(&scenario).map_err(|problem| wrong(1, problem))?;
    let file = FleetScenario { scenario, text: text.to_owned(), fleet: table.fleet };
    for liar in &file.fleet.liar {
        if let Err(problems) = parse::scenario(&file.text_of(liar.robot)) {
            let first = problems.first().map(ToString::to_string).unwrap_or_default();
            return Err(wrong(1, format!("`fleet.liar` of robot {}: {first}", liar.robot)));
        }
    }
    Ok(file)
}

impl FleetScenario {
    /// The text of the scenario as it is for a robot: with its own attack, if it has one.
    #[must_use]
    pub fn text_of(&self, robot: u16) -> String {
        let own = self.fleet.liar.iter().find(|liar| liar.robot == robot);
        let table = toml::from_str::<toml::Table>(&self.text).ok();
        let (Some(own), Some(mut table)) = (own, table) else { return self.text.clone() };
        table.insert("attack".into(), toml::Value::Table(own.attack.clone()));
        toml::to_string(&table).unwrap_or_else(|_| self.text.clone())
    }
}

#[derive(Default, Deserialize)]
struct Table {
    #[serde(default)]
    fleet: Fleet,
}

impl Fleet {
    fn check(&self, scenario: &Scenario) -> Result<(), String> {
        let robots = scenario.team.robots;
        if let Some(liar) = self.liar.iter().find(|liar| !scenario.malicious.contains(&liar.robot)) {
            let allowed = &scenario.malicious;
            return Err(format!(
                "`fleet.liar.robot` is {}, allowed is one of team.malicious, {allowed:?}",
                liar.robot
            ));
        }
        let times = self.kill.iter().flat_map(|kill| [Some(kill.at_s), kill.back_s]).flatten();
        for time_s in times.chain(self.restart_router_s.iter().copied()) {
            if !(0.0..=86_400.0).contains(&time_s) {
                return Err(format!("a time in `fleet` is {time_s}, allowed is 0 to 86400"));
            }
        }
        if let Some(kill) = self.kill.iter().find(|kill| !(1..=robots).contains(&kill.robot)) {
            return Err(format!("`fleet.kill.robot` is {}, allowed is 1 to {robots}", kill.robot));
        }
        if let Some(kill) =
            self.kill.iter().find(|kill| kill.back_s.is_some_and(|back_s| back_s <= kill.at_s))
        {
            return Err(format!("`fleet.kill.back_s` of robot {} must be later than its at_s", kill.robot));
        }
        if !(0.0..=10_000.0).contains(&self.garbage_per_s) {
            return Err(format!("`fleet.garbage_per_s` is {}, allowed is 0 to 10000", self.garbage_per_s));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<FleetScenario, ScenarioError> {
        read(text, Path::new("f.toml"))
    }

    #[test]
    fn a_scenario_and_a_fleet_stand_in_one_file() {
        let text = "name = 'x'\n[fleet]\nrestart_router_s = [3]\n[[fleet.kill]]\nrobot = 4\nat_s = 2.0\n[team]\nrobots = 11\n";
        let both = of(text).unwrap();
        assert_eq!(both.fleet.kill, [Kill { robot: 4, at_s: 2.0, back_s: None }]);
        assert_eq!((both.scenario.name.as_str(), both.fleet.restart_router_s), ("x", vec![3.0]));
        assert_eq!(of("").unwrap().fleet, Fleet::default());
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        let refused = |text: &str| of(text).unwrap_err().to_string();
        assert!(refused("[fleet]\n\n[team]\nrobots = 1").starts_with("f.toml:4: `team.robots` is 1"));
        assert!(refused("seed = 1\n[fleet]\nkil = []").starts_with("f.toml:3: unknown field `kil`"));
        assert!(refused("[[fleet.kill]]\nrobot = 12\nat_s = 1.0").contains("allowed is 1 to 11"));
        let liar = |robot: u16, kind: &str| {
            format!(
                "[team]\nmalicious = [1, 2]\n[[fleet.liar]]\nrobot = {robot}\nattack = {{ level = {{ kind = '{kind}' }} }}"
            )
        };
        assert!(refused(&liar(3, "silent")).contains("allowed is one of team.malicious, [1, 2]"));
        assert!(refused(&liar(2, "rude")).contains("`fleet.liar` of robot 2: `attack.level.kind` is"));
        let text = of(&liar(2, "silent")).unwrap();
        assert!(text.text_of(2).contains("silent") && text.text_of(1) == text.text);
    }
}
