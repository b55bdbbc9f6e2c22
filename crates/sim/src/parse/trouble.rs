//! The tables `network`, `clocks`, `sensing` and `plant` of a scenario text: what goes wrong.

use closeranks_core::settings::params::MAGNITUDE_MAX;
use closeranks_core::settings::range::Allowed;

use super::fields::{NOT_NEGATIVE, set, small};
use super::reader::{Reader, Section};
use crate::faults::Spell;
use crate::faults::network::Partition;
use crate::scenario::Scenario;

const SHARE: Allowed = Allowed::Closed(0.0, 1.0);
/// Longer delays are losses.
const DELAY: Allowed = Allowed::Closed(0.0, 60.0);

pub(super) fn network(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    let network = &mut scenario.trouble.network;
    set(&mut network.loss, reader.number(section, "loss", SHARE));
    set(&mut network.burst_begin, reader.number(section, "burst_begin", SHARE));
    network.burst_end = reader.number(section, "burst_end", SHARE).unwrap_or(if network.burst_begin > 0.0 {
        0.1
    } else {
        0.0
    });
    set(&mut network.delay_min_s, reader.number(section, "delay_min_s", DELAY));
    let longest = Allowed::Closed(network.delay_min_s, 60.0);
    network.delay_max_s = reader.number(section, "delay_max_s", longest).unwrap_or(network.delay_min_s);
    set(&mut network.duplicate, reader.number(section, "duplicate", SHARE));
    set(&mut network.deaf, reader.number(section, "deaf", SHARE));
    if !section.has("partition") {
        return;
    }
    let mut partition = reader.section(section, "partition");
    let last = u64::from(scenario.robots);
    let first = reader.whole(&mut partition, "first", 1..last).map_or(scenario.robots / 2, small);
    let [from_s, to_s] = times(reader, &mut partition);
    scenario.trouble.network.partition = Some(Partition { first, from_s, to_s });
    reader.close(&partition);
}

pub(super) fn clocks(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    let clocks = &mut scenario.trouble.clocks;
    set(&mut clocks.offset_max_s, reader.number(section, "offset_max_s", Allowed::Closed(0.0, 3_600.0)));
    set(&mut clocks.drift_max, reader.number(section, "drift_max", Allowed::Closed(0.0, 0.5)));
}

pub(super) fn sensing(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    set(&mut scenario.trouble.sensing.noise_m, reader.number(section, "noise_m", NOT_NEGATIVE));
    scenario.trouble.sensing.frozen =
        spell(reader, section, "frozen", scenario.robots, None).map(|(spell, _)| spell);
    scenario.trouble.sensing.jump = spell(reader, section, "jump", scenario.robots, Some("by_m"));
}

pub(super) fn plant(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    let plant = &mut scenario.trouble.plant;
    set(&mut plant.lag_s, reader.number(section, "lag_s", DELAY));
    set(&mut plant.missed, reader.number(section, "missed", SHARE));
    let held = [("stops", false), ("goes-on", true)];
    set(&mut plant.goes_on, reader.word(section, "when_missed", &held));
    plant.crash = spell(reader, section, "crash", scenario.robots, None).map(|(spell, _)| spell);
    let memory = [("keeps", false), ("forgets", true)];
    set(&mut plant.forgets, reader.word(section, "memory", &memory));
}

/// A table with `robot`, `from_s` and `to_s`, and a length if it has one.
fn spell(
    reader: &mut Reader,
    section: &mut Section<'_>,
    key: &'static str,
    robots: u16,
    length: Option<&'static str>,
) -> Option<(Spell, f64)> {
    if !section.has(key) {
        return None;
    }
    let mut spell = reader.section(section, key);
    let robot = reader.whole(&mut spell, "robot", 1..u64::from(robots) + 1).map_or(robots, small);
    let [from_s, to_s] = times(reader, &mut spell);
    let by_m = length.and_then(|key| reader.number(&mut spell, key, NOT_NEGATIVE)).unwrap_or(1.0);
    reader.close(&spell);
    Some((Spell { robot, from_s, to_s }, by_m))
}

/// Fields `from_s` and `to_s`, which is not before it.
fn times(reader: &mut Reader, section: &mut Section<'_>) -> [f64; 2] {
    let (given, from_s) = (section.has("from_s"), reader.number(section, "from_s", NOT_NEGATIVE));
    // Beside a wrong `from_s` any `to_s` may be right.
    let least = if given { from_s.unwrap_or(0.0) } else { 1.0 };
    let to_s = reader.number(section, "to_s", Allowed::Closed(least, MAGNITUDE_MAX));
    let from_s = from_s.unwrap_or(1.0);
    [from_s, to_s.unwrap_or((from_s + 1.0).min(MAGNITUDE_MAX))]
}
