//! Settings of any kind, from ordinary to refused.

use closeranks_core::controller::assume::Assume;
use closeranks_core::controller::budget::settings::Trust;
use closeranks_core::equations::composition::PhiSplit;
use closeranks_core::settings::field::TABLE;
use closeranks_core::settings::params::{Controller, Settings};
use closeranks_core::settings::range::MAGNITUDE_MAX;
use closeranks_core::settings::{BudgetSettings, ComposedSettings, LinksSettings};

use crate::source::Source;

/// What the source says: a few choices, and half of the time some fields replaced by anything.
pub(super) fn settings<const D: usize>(source: &mut Source<'_>) -> Settings<D> {
    let kind = source.pick(&["composed", "budget", "composed", "links"]);
    let phi_split = source.pick(&[PhiSplit::Neighbors, PhiSplit::Own]);
    let trust = source.pick(&[Trust::Told, Trust::ToldOrSeen, Trust::Seen]);
    let assume = source.pick(&[Assume::Obedient, Assume::Free]);
    let controller = match kind {
        "composed" => Controller::Composed(ComposedSettings { phi_split, ..ComposedSettings::default() }),
        "budget" => Controller::Budget(BudgetSettings { trust, assume, ..BudgetSettings::default() }),
        _ => Controller::Links(LinksSettings {
            assume,
            pass_right: trust == Trust::Seen,
            ..LinksSettings::default()
        }),
    };
    let mut settings = Settings { controller, ..Settings::default() };
    settings.team.faults = u16::try_from(source.below(6)).unwrap_or(0);
    if source.byte() & 1 == 0 {
        // Small enough that a few neighbours are enough.
        settings.team.robots = 2 * settings.team.faults + 1 + u16::try_from(source.below(6)).unwrap_or(0);
    }
    for _ in 0..source.below(12).saturating_sub(6) {
        replace(&mut settings, source);
    }
    settings
}

/// Any number of the table replaced by any number, or a side of the input box.
fn replace<const D: usize>(settings: &mut Settings<D>, source: &mut Source<'_>) {
    if let Some(row) = TABLE.get(source.below(TABLE.len() + 1)) {
        let number = size(source);
        (row.set)(&mut settings.parts(f64::INFINITY), number);
    } else {
        let axis = source.below(D);
        settings.limits.input.min_m_s[axis] = -size(source);
        settings.limits.input.max_m_s[axis] = size(source);
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
