//! The table `consensus` of a scenario text.

use closeranks_core::settings::range::Allowed;
use toml::de::DeValue;

use super::{Combine, Consensus, Rule};
use crate::parse::common::{set, small};
use crate::parse::reader::{Reader, Section};
use crate::parse::value::{number, whole};
use crate::scenario::Scenario;

/// The longest window, rounds.
const WINDOW_MAX: u64 = 1_000;
/// Covers are searched in 2^F steps.
const TWO_HOP_FAULTS_MAX: u16 = 8;
/// The world holds what everybody heard of everybody.
const ROBOTS_MAX: u16 = 1_000;

impl Consensus {
    /// Reads it; what does not fit the rest of the scenario is refused by [`check`](Self::check).
    pub(crate) fn read(reader: &mut Reader, section: &mut Section<'_>, robots: u16) -> Self {
        let mut read = Self::default();
        set(&mut read.rule, reader.word(section, "rule", &Rule::ALL));
        set(&mut read.dimension, reader.whole(section, "dimension", 1..4).map(|d| usize::from(small(d))));
        let ways = [("coordinates", Combine::Coordinates), ("safe-point", Combine::SafePoint)];
        set(&mut read.combine, reader.word(section, "combine", &ways));
        set(&mut read.window, reader.whole(section, "window", 1..WINDOW_MAX + 1).map(small));
        set(&mut read.gain_per_s, reader.number(section, "gain_per_s", Allowed::Open(0.0, 1e6)));
        let robot =
            move |value: &DeValue<'_>| whole(value).map(small).filter(|one| (1..=robots).contains(one));
        set(
            &mut read.leaders,
            reader.list(section, "leaders", &format!("the number of a robot, 1 to {robots}"), robot),
        );
        let share = |value: &DeValue<'_>| number(value).filter(|number| (0.0..=1.0).contains(number));
        set(&mut read.trust, reader.list(section, "trust", "a number, 0 to 1", share));
        read
    }

    /// Notes in `reader` what does not fit.
    pub(crate) fn check(reader: &mut Reader, scenario: &Scenario) {
        let (Self { rule, dimension, combine, leaders, trust, .. }, team) =
            (&scenario.consensus, scenario.team);
        let name = rule.name();
        let mut refuse = |field: &str, found: String, allowed: String| reader.refuse(field, found, allowed);
        if *combine == Combine::SafePoint && (*dimension != 2 || *rule != Rule::WMsr) {
            let found = format!("\"safe-point\" with dimension = {dimension} and rule = \"{name}\"");
            refuse(
                "consensus.combine",
                found,
                "\"safe-point\" only in 2 dimensions and with rule = \"w-msr\"".to_owned(),
            );
        }
        if *rule == Rule::BpMsr && leaders.is_empty() {
            let allowed = "leaders = [..] with at least one robot".to_owned();
            refuse("consensus.rule", "\"bp-msr\" without leaders".to_owned(), allowed);
        }
        if *rule == Rule::Trust && trust.len() != usize::from(team.robots) {
            let found = format!("\"trust\" with {} trusts", trust.len());
            refuse(
                "consensus.rule",
                found,
                format!("trust = [..] with {} numbers, one a robot", team.robots),
            );
        }
        if *rule == Rule::TwoHop && team.faults > TWO_HOP_FAULTS_MAX {
            let found = format!("\"two-hop\" with team.faults = {}", team.faults);
            refuse("consensus.rule", found, format!("at most {TWO_HOP_FAULTS_MAX} faults"));
        }
        if scenario.consensus.is_of_robots() {
            return;
        }
        let found = if *dimension > 1 { format!("dimension = {dimension}") } else { format!("\"{name}\"") };
        if scenario.ranking().is_some() {
            refuse(
                "consensus.rule",
                format!("{found} under ranks"),
                "a rule that robots run, of one number".to_owned(),
            );
        }
        if team.robots > ROBOTS_MAX {
            refuse(
                "team.robots",
                format!("{}, with {found}", team.robots),
                format!("at most {ROBOTS_MAX} with this consensus"),
            );
        }
    }
}
