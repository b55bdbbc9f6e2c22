//! What a robot decided: the velocity for its plant, and everything for whoever watches.

use closeranks_core::{Instant, Mode, Outcome, RobotId};

use crate::bytes::{Reader, put_vector};
use crate::gate::{Counts, Reject};
use crate::wire::mode;

/// Most robots in one list.
const LISTED_MAX: usize = 256;
/// How many reasons there are.
const REASONS: usize = Reject::ALL.len();

/// A decision of one robot.
#[derive(Clone, Debug, PartialEq)]
pub struct Report<const D: usize> {
    /// When what it decided on was sensed.
    pub at: Instant,
    /// The velocity that its base is to have until the next decision, m/s.
    pub velocity_m_s: [f64; D],
    /// The velocity that was wanted, m/s; 0 if there was none.
    pub desired_m_s: [f64; D],
    /// Where it counts itself, m.
    pub reference_m: [f64; D],
    /// Whether it had to begin anew.
    pub began_anew: bool,
    /// What the answer is worth.
    pub mode: Mode,
    /// What the program found.
    pub outcome: Outcome,
    /// δ_i.
    pub degree: u16,
    /// δ_i less what must be there.
    pub degree_margin: i32,
    /// c_i as sensed.
    pub level: f64,
    /// c_i as told.
    pub told: f64,
    /// h_i.
    pub h: f64,
    /// y_i; of a liar what it tells.
    pub value: f64,
    /// y_i as it is held.
    pub held: f64,
    /// Whose values it used in the round that ended with this decision; empty if none did.
    pub heard: Vec<RobotId>,
    /// Under `links`: whom it counts on.
    pub counted: Vec<RobotId>,
    /// Under `links`: for whom it keeps its row.
    pub rows: Vec<RobotId>,
    /// Age of the oldest told level in use, ms.
    pub told_age_ms: u32,
    /// Ticks without anything sensed since the start.
    pub missed: u32,
    /// From the arrival of what was sensed to the decision, µs, without the time that the schedule waits.
    pub busy_us: u32,
    /// Envelopes that were rejected, by reason.
    pub rejects: [u32; REASONS],
}

impl<const D: usize> Report<D> {
    /// The bytes of a payload.
    #[must_use]
    pub fn encode(&self) -> Vec<u8> {
        let mut bytes = self.at.as_nanos().to_le_bytes().to_vec();
        put_vector(&mut bytes, &self.velocity_m_s);
        put_vector(&mut bytes, &self.desired_m_s);
        put_vector(&mut bytes, &self.reference_m);
        let outcome = mode::encode_outcome(self.outcome);
        bytes.extend_from_slice(&[u8::from(self.began_anew), mode::encode(self.mode), outcome, 0]);
        bytes.extend_from_slice(&self.degree.to_le_bytes());
        bytes.extend_from_slice(&self.degree_margin.to_le_bytes());
        put_vector(&mut bytes, &[self.level, self.told, self.h, self.value, self.held]);
        for count in [self.told_age_ms, self.missed, self.busy_us].iter().chain(&self.rejects) {
            bytes.extend_from_slice(&count.to_le_bytes());
        }
        for list in [&self.heard, &self.counted, &self.rows] {
            let ids = &list[..list.len().min(LISTED_MAX)];
            bytes.extend_from_slice(&u16::try_from(ids.len()).unwrap_or(0).to_le_bytes());
            for id in ids {
                bytes.extend_from_slice(&id.0.to_le_bytes());
            }
        }
        bytes
    }

    /// What a payload says; `None` for anything but the exact form and for numbers that are not finite.
    #[must_use]
    pub fn parse(bytes: &[u8]) -> Option<Self> {
        let mut reader = Reader::new(bytes);
        let at = Instant::from_nanos(reader.long()?);
        let (velocity_m_s, desired_m_s, reference_m) = (reader.vector()?, reader.vector()?, reader.vector()?);
        let [anew, mode, outcome, 0] = reader.array()? else { return None };
        let degree = reader.short()?;
        let degree_margin = i32::from_le_bytes(reader.array()?);
        let [level, told, h, value, held] = reader.vector()?;
        let (told_age_ms, missed, busy_us) = (reader.word()?, reader.word()?, reader.word()?);
        let mut rejects = [0; REASONS];
        for count in &mut rejects {
            *count = reader.word()?;
        }
        let (heard, counted, rows) = (ids(&mut reader)?, ids(&mut reader)?, ids(&mut reader)?);
        reader.end()?;
        if anew > 1 {
            return None;
        }
        Some(Self {
            at,
            velocity_m_s,
            desired_m_s,
            reference_m,
            began_anew: anew == 1,
            mode: mode::decode(mode)?,
            outcome: mode::decode_outcome(outcome)?,
            degree,
            degree_margin,
            level,
            told,
            h,
            value,
            held,
            heard,
            counted,
            rows,
            told_age_ms,
            missed,
            busy_us,
            rejects,
        })
    }

    /// How many envelopes were rejected for this reason.
    #[must_use]
    pub fn rejected(&self, reject: Reject) -> u32 {
        self.rejects[reject as usize]
    }
}

/// A list of robots.
fn ids(reader: &mut Reader<'_>) -> Option<Vec<RobotId>> {
    let count = usize::from(reader.short()?);
    if count > LISTED_MAX {
        return None;
    }
    (0..count).map(|_| reader.short().map(RobotId)).collect()
}

/// The counters of a gate as a report has them.
#[must_use]
pub fn rejects(counts: &Counts) -> [u32; REASONS] {
    Reject::ALL.map(|reject| counts.total(reject))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn example() -> Report<2> {
        Report {
            at: Instant::from_nanos(77),
            velocity_m_s: [1.0, -0.5],
            desired_m_s: [2.0, 0.0],
            reference_m: [0.25, 4.0],
            began_anew: true,
            mode: Mode::Guaranteed,
            outcome: Outcome::Active,
            degree: 8,
            degree_margin: -1,
            level: 7.5,
            told: 9.0,
            h: 0.5,
            value: -3.0,
            held: 4.0,
            heard: vec![RobotId(2), RobotId(11)],
            counted: vec![RobotId(3)],
            rows: Vec::new(),
            told_age_ms: 50,
            missed: 3,
            busy_us: 900,
            rejects: core::array::from_fn(|index| u32::try_from(index).unwrap()),
        }
    }

    #[test]
    fn what_is_encoded_is_parsed() {
        let bytes = example().encode();
        assert_eq!(Report::parse(&bytes), Some(example()));
        for length in 0..bytes.len() {
            assert_eq!(Report::<2>::parse(&bytes[..length]), None);
        }
    }

    proptest! {
        #[test]
        fn a_changed_report_is_a_report_or_none(at in 0_usize..500, byte in any::<u8>()) {
            let mut bytes = example().encode();
            let at = at % bytes.len();
            bytes[at] = byte;
            if let Some(report) = Report::<2>::parse(&bytes) {
                prop_assert_eq!(report.encode(), bytes);
            }
        }
    }
}
