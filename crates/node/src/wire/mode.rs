//! Modes and outcomes of the core as one byte each.

use closeranks_core::{Mode, Outcome, Reason};

const GUARANTEED: u8 = 0;
const HOLD: u8 = 1;
const STOPPED: u8 = 2;
/// Reasons are numbered from here.
const DEGRADED: u8 = 16;

/// Every reason, in the order of its number.
const REASONS: [Reason; 15] = [
    Reason::Degree,
    Reason::Infeasible,
    Reason::OutsideSafeSet,
    Reason::Late,
    Reason::Moved,
    Reason::Overlooked,
    Reason::Uncertain,
    Reason::Untold,
    Reason::Uncounted,
    Reason::Unfiltered,
    Reason::NotSensed,
    Reason::NotShared,
    Reason::Scratch,
    Reason::ContinuousTime,
    Reason::Obstacle,
];

/// The number of a reason, and the word that people read.
const fn told(reason: Reason) -> (u8, &'static str) {
    match reason {
        Reason::Degree => (0, "degree"),
        Reason::Infeasible => (1, "infeasible"),
        Reason::OutsideSafeSet => (2, "outside"),
        Reason::Late => (3, "late"),
        Reason::Moved => (4, "moved"),
        Reason::Overlooked => (5, "overlooked"),
        Reason::Uncertain => (6, "uncertain"),
        Reason::Untold => (7, "untold"),
        Reason::Uncounted => (8, "uncounted"),
        Reason::Unfiltered => (9, "unfiltered"),
        Reason::NotSensed => (10, "not sensed"),
        Reason::NotShared => (11, "not shared"),
        Reason::Scratch => (12, "scratch"),
        Reason::ContinuousTime => (13, "continuous time"),
        Reason::Obstacle => (14, "near obstacle"),
    }
}

/// The byte of a mode.
#[must_use]
pub fn encode(mode: Mode) -> u8 {
    match mode {
        Mode::Guaranteed => GUARANTEED,
        Mode::Hold => HOLD,
        Mode::Stopped => STOPPED,
        Mode::Degraded(reason) => DEGRADED + told(reason).0,
    }
}

/// The mode of a byte.
#[must_use]
pub fn decode(byte: u8) -> Option<Mode> {
    match byte {
        GUARANTEED => Some(Mode::Guaranteed),
        HOLD => Some(Mode::Hold),
        STOPPED => Some(Mode::Stopped),
        _ => {
            let place = usize::from(byte.checked_sub(DEGRADED)?);
            REASONS.get(place).copied().map(Mode::Degraded)
        }
    }
}

/// A mode in a word for tables.
#[must_use]
pub fn word(mode: Mode) -> &'static str {
    match mode {
        Mode::Guaranteed => "GUARANTEED",
        Mode::Hold => "HOLD",
        Mode::Stopped => "STOPPED",
        Mode::Degraded(reason) => told(reason).1,
    }
}

const OUTCOMES: [Outcome; 4] = [Outcome::Free, Outcome::Active, Outcome::Infeasible, Outcome::Recovering];

/// The byte of an outcome.
#[must_use]
pub fn encode_outcome(outcome: Outcome) -> u8 {
    OUTCOMES
        .iter()
        .position(|known| *known == outcome)
        .and_then(|place| u8::try_from(place).ok())
        .unwrap_or(2)
}

/// The outcome of a byte.
#[must_use]
pub fn decode_outcome(byte: u8) -> Option<Outcome> {
    OUTCOMES.get(usize::from(byte)).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_is_one_mode_or_none() {
        let mut found = 0;
        for byte in 0..=u8::MAX {
            if let Some(mode) = decode(byte) {
                assert_eq!(encode(mode), byte);
                assert!(!word(mode).is_empty());
                found += 1;
            }
            if let Some(outcome) = decode_outcome(byte) {
                assert_eq!(encode_outcome(outcome), byte);
            }
        }
        assert_eq!(found, 3 + REASONS.len());
    }

    #[test]
    fn every_reason_has_the_number_of_its_place() {
        for (reason, number) in REASONS.into_iter().zip(0..) {
            assert_eq!(told(reason).0, number, "{reason:?}");
            assert_eq!(decode(encode(Mode::Degraded(reason))), Some(Mode::Degraded(reason)));
        }
    }
}
