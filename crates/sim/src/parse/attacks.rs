//! The table `attack` of a scenario text.

use closeranks_core::message::VALUE_MAX;
use closeranks_core::settings::params::MAGNITUDE_MAX;
use closeranks_core::settings::range::Allowed;

use super::fields::{ANY, NOT_NEGATIVE, interval, set};
use super::reader::{Reader, Section};
use crate::attack::{LevelAttack, MotionAttack, ValueAttack};
use crate::scenario::Scenario;

const PERIOD: Allowed = Allowed::Closed(1e-3, MAGNITUDE_MAX);
const VALUE: Allowed = Allowed::Closed(-VALUE_MAX, VALUE_MAX);

pub(super) fn attack(reader: &mut Reader, section: &mut Section<'_>, scenario: &mut Scenario) {
    let mut level = reader.section(section, "level");
    scenario.level_attack = level_attack(reader, &mut level);
    reader.close(&level);
    let mut value = reader.section(section, "value");
    scenario.value_attack = value_attack(reader, &mut value);
    reader.close(&value);
    let motions = [
        ("obedient", MotionAttack::Obedient),
        ("flee", MotionAttack::Flee),
        ("wander", MotionAttack::Wander),
    ];
    set(&mut scenario.motion_attack, reader.word(section, "motion", &motions));
}

fn number(
    reader: &mut Reader,
    section: &mut Section<'_>,
    key: &'static str,
    allowed: Allowed,
    default: f64,
) -> f64 {
    reader.number(section, key, allowed).unwrap_or(default)
}

fn level_attack(reader: &mut Reader, level: &mut Section<'_>) -> LevelAttack {
    let names = ["none", "bias", "step", "ramp", "sine", "random", "faces", "replay", "garbage", "silent"];
    match kind(reader, level, &names).unwrap_or("none") {
        "bias" => LevelAttack::Bias(number(reader, level, "bias", ANY, 0.0)),
        "step" => LevelAttack::Step {
            bias: number(reader, level, "bias", ANY, 0.0),
            from_s: number(reader, level, "from_s", NOT_NEGATIVE, 0.0),
        },
        "ramp" => LevelAttack::Ramp { rate_per_s: number(reader, level, "rate_per_s", ANY, 1.0) },
        "sine" => LevelAttack::Sine {
            amplitude: number(reader, level, "amplitude", ANY, 0.0),
            period_s: number(reader, level, "period_s", PERIOD, 1.0),
        },
        "random" => {
            let [min, max] = levels(reader, level);
            LevelAttack::Random { min, max }
        }
        "faces" => {
            let [min, max] = levels(reader, level);
            LevelAttack::Faces { min, max }
        }
        "replay" => LevelAttack::Replay { age_s: number(reader, level, "age_s", NOT_NEGATIVE, 1.0) },
        "garbage" => LevelAttack::Garbage,
        "silent" => LevelAttack::Silent,
        _ => LevelAttack::None,
    }
}

/// Fields `min` and `max` of a level.
fn levels(reader: &mut Reader, level: &mut Section<'_>) -> [f64; 2] {
    let min = number(reader, level, "min", ANY, -20.0);
    [min, number(reader, level, "max", Allowed::Closed(min, MAGNITUDE_MAX), min.max(20.0))]
}

fn value_attack(reader: &mut Reader, value: &mut Section<'_>) -> ValueAttack {
    let names = ["random", "none", "constant", "ramp", "sine", "extreme", "faces", "sway", "split", "silent"];
    match kind(reader, value, &names).unwrap_or("random") {
        "none" => ValueAttack::None,
        "constant" => ValueAttack::Constant { value: number(reader, value, "value", VALUE, 500.0) },
        "ramp" => ValueAttack::Ramp {
            start: number(reader, value, "start", ANY, 0.0),
            rate_per_s: number(reader, value, "rate_per_s", ANY, 100.0),
        },
        "sine" => ValueAttack::Sine {
            amplitude: number(reader, value, "amplitude", ANY, 500.0),
            period_s: number(reader, value, "period_s", PERIOD, 1.0),
        },
        "extreme" => ValueAttack::Extreme,
        "faces" => {
            let [min, max] = interval(reader, value);
            ValueAttack::Faces { min, max }
        }
        "sway" => ValueAttack::Sway,
        "split" => ValueAttack::Split,
        "silent" => ValueAttack::Silent,
        _ => {
            let [min, max] = interval(reader, value);
            ValueAttack::Random { min, max }
        }
    }
}

/// The field `kind`.
fn kind<'a>(reader: &mut Reader, section: &mut Section<'_>, names: &[&'a str]) -> Option<&'a str> {
    let choices: Vec<(&str, &'a str)> = names.iter().map(|name| (*name, *name)).collect();
    reader.kind(section, &choices)
}
