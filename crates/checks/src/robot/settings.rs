//! Settings of any kind, from ordinary to refused.

use closeranks_core::controller::budget::knowledge::{Assume, Trust};
use closeranks_core::equations::composition::Share;
use closeranks_core::settings::params::{Controller, MAGNITUDE_MAX, Settings};

use crate::source::Source;

/// What the source says: a few choices, and half of the time some fields replaced by anything.
pub(super) fn settings<const D: usize>(source: &mut Source<'_>) -> Settings<D> {
    let mut settings = Settings {
        controller: source.pick(&[Controller::Composed, Controller::Budget]),
        share: source.pick(&[Share::Neighbours, Share::Own]),
        trust: source.pick(&[Trust::Told, Trust::ToldOrSeen, Trust::Seen]),
        assume: source.pick(&[Assume::Obedient, Assume::Free]),
        faults: u16::try_from(source.below(6)).unwrap_or(0),
        ..Settings::default()
    };
    if source.byte() & 1 == 0 {
        // Small enough that a few neighbours are enough.
        settings.robots = 2 * settings.faults + 1 + u16::try_from(source.below(6)).unwrap_or(0);
    }
    for _ in 0..source.below(12).saturating_sub(6) {
        replace(&mut settings, source);
    }
    settings
}

fn replace<const D: usize>(settings: &mut Settings<D>, source: &mut Source<'_>) {
    match source.below(20) {
        0 => settings.robots = u16::from_le_bytes(source.take()),
        1 => settings.faults = u16::from_le_bytes(source.take()),
        2 => settings.radius_m = size(source),
        3 => settings.distance_min_m = size(source),
        4 => settings.epsilon = Some(size(source)),
        5 => settings.q2 = size(source),
        6 => settings.w_r = size(source),
        7 => settings.w_c = size(source),
        8 => settings.alpha = size(source),
        9 => settings.gamma = Some(size(source)),
        10 => settings.gamma_c = size(source),
        11 => settings.level_period = source.period(),
        12 => settings.value_period = source.period(),
        13 => settings.hold_max = Some(source.period()),
        14 => settings.told_max = source.period(),
        15 => settings.clock_error = source.period(),
        16 => settings.position_error_m = size(source),
        17 => settings.tracking_error_m = size(source),
        18 => settings.rise = size(source),
        _ => {
            let axis = source.below(D);
            settings.input.min_m_s[axis] = -size(source);
            settings.input.max_m_s[axis] = size(source);
        }
    }
}

/// Positive and allowed as a rule.
fn size(source: &mut Source<'_>) -> f64 {
    match source.byte() {
        0..=99 => source.near().abs(),
        100..=119 => MAGNITUDE_MAX,
        120..=139 => f64::from_bits(1),
        140..=179 => 2.0_f64.powi(-4 * i32::from(source.byte())),
        _ => source.number(),
    }
}
