//! Modes and outcomes of the core as one byte each.

use closeranks_core::{Mode, Outcome, Reason};

const GUARANTEED: u8 = 0;
const HOLD: u8 = 1;
const STOPPED: u8 = 2;
/// Reasons are numbered from here.
const DEGRADED: u8 = 16;

/// Every reason with the word that people read, in the order of its number.
const REASONS: [(Reason, &str); 14] = [
    (Reason::Degree, "degree"),
    (Reason::Infeasible, "infeasible"),
    (Reason::OutsideSafeSet, "outside"),
    (Reason::Late, "late"),
    (Reason::Moved, "moved"),
    (Reason::Overlooked, "overlooked"),
    (Reason::Uncertain, "uncertain"),
    (Reason::Untold, "untold"),
    (Reason::Uncounted, "uncounted"),
    (Reason::Unfiltered, "unfiltered"),
    (Reason::NotSensed, "not sensed"),
    (Reason::NotShared, "not shared"),
    (Reason::Scratch, "scratch"),
    (Reason::ContinuousTime, "continuous time"),
];

/// The byte of a mode. A reason without a number is told as the last one, which no node of `budget` says.
#[must_use]
pub fn encode(mode: Mode) -> u8 {
    match mode {
        Mode::Guaranteed => GUARANTEED,
        Mode::Hold => HOLD,
        Mode::Stopped => STOPPED,
        Mode::Degraded(reason) => {
            let place = REASONS.iter().position(|(known, _)| *known == reason).unwrap_or(REASONS.len() - 1);
            DEGRADED + u8::try_from(place).unwrap_or(0)
        }
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
            REASONS.get(place).map(|(reason, _)| Mode::Degraded(*reason))
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
        Mode::Degraded(reason) => {
            REASONS.iter().find(|(known, _)| *known == reason).map_or("degraded", |(_, word)| word)
        }
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
}
