//! Positions from a file, such as a recorded flight: what would the robot have done? Velocities go nowhere.
//!
//! The file is CSV with the head `time_s,robot,x_m,y_m` (and `z_m` in three dimensions), ordered by time. Rows of one time are
//! one look. Who is farther away than a robot sees is left out.

use closeranks_core::{Instant, Params, RobotId};
use core::time::Duration;

use crate::plant::PlantPort;
use crate::wire::sensed::Sensed;

/// Longest file, bytes.
pub const REPLAY_MAX: u64 = 1 << 28;

/// Why a file is no recording.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReplayError {
    /// The first line is not the head.
    #[error("line 1 is `{found}`, must be `{expected}`")]
    Head {
        /// What it is.
        found: String,
        /// What it must be.
        expected: &'static str,
    },
    /// A line is not a row.
    #[error(
        "line {line}: `{found}`, must be a time of at least 0 in s, a number of the team, and {dimension} finite coordinates in m"
    )]
    Row {
        /// Which line, from 1.
        line: usize,
        /// What is there.
        found: String,
        /// D.
        dimension: usize,
    },
    /// Times fall.
    #[error("line {0}: the time is earlier than that of the line before")]
    Order(usize),
    /// The robot itself is in no row.
    #[error("robot {0} is in no row")]
    Absent(u16),
}

/// The looks of one robot in a recording.
pub struct Replay<const D: usize> {
    looks: Vec<Sensed<D>>,
    next: usize,
}

impl<const D: usize> Replay<D> {
    /// The recording in a text, as robot `id` sees it, begun at `start`.
    pub fn read(text: &str, id: RobotId, params: &Params<D>, start: Instant) -> Result<Self, ReplayError> {
        let expected = if D == 3 { "time_s,robot,x_m,y_m,z_m" } else { "time_s,robot,x_m,y_m" };
        let head = text.lines().next().unwrap_or_default().trim();
        if head != expected {
            return Err(ReplayError::Head { found: head.chars().take(80).collect(), expected });
        }
        let robots = params.settings().team.robots;
        let (mut looks, mut rows): (Vec<Sensed<D>>, Vec<Row<D>>) = (Vec::new(), Vec::new());
        for (line, text) in (1..).zip(text.lines()).skip(1).filter(|(_, text)| !text.trim().is_empty()) {
            let row = Row::read(text, robots).ok_or_else(|| ReplayError::Row {
                line,
                found: text.chars().take(80).collect(),
                dimension: D,
            })?;
            let last = rows.last().map_or(row.time, |last| last.time);
            if row.time < last {
                return Err(ReplayError::Order(line));
            }
            if row.time > last {
                looks.extend(look(&rows, id, params, start));
                rows.clear();
            }
            rows.push(row);
        }
        looks.extend(look(&rows, id, params, start));
        if looks.is_empty() { Err(ReplayError::Absent(id.0)) } else { Ok(Self { looks, next: 0 }) }
    }

    /// True when everything was given out.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.next >= self.looks.len()
    }
}

struct Row<const D: usize> {
    time: Duration,
    id: RobotId,
    position_m: [f64; D],
}

impl<const D: usize> Row<D> {
    fn read(text: &str, robots: u16) -> Option<Self> {
        let mut parts = text.split(',').map(str::trim);
        let time = Duration::try_from_secs_f64(parts.next()?.parse().ok()?).ok()?;
        let id: u16 = parts.next()?.parse().ok()?;
        let mut position_m = [0.0; D];
        for component in &mut position_m {
            *component = parts.next()?.parse::<f64>().ok().filter(|number| number.is_finite())?;
        }
        let whole = parts.next().is_none() && (1..=robots).contains(&id);
        whole.then_some(Self { time, id: RobotId(id), position_m })
    }
}

/// What robot `id` sees of the rows of one time; `None` if it is in none of them.
fn look<const D: usize>(
    rows: &[Row<D>],
    id: RobotId,
    params: &Params<D>,
    start: Instant,
) -> Option<Sensed<D>> {
    let own = rows.iter().find(|row| row.id == id)?;
    let radius_m = params.link().radius_m;
    let sight_m2 = params.sight_m2().max(radius_m * radius_m);
    let near = |row: &&Row<D>| {
        let squares = row.position_m.iter().zip(&own.position_m).map(|(a, b)| (a - b) * (a - b));
        row.id != id && squares.sum::<f64>() <= sight_m2
    };
    let others = rows.iter().filter(near).map(|row| (row.id, row.position_m)).collect();
    Some(Sensed { at: start.after(own.time), own_m: own.position_m, others })
}

impl<const D: usize> PlantPort<D> for Replay<D> {
    fn arrived(&mut self, _now: Instant, _from: RobotId, _bytes: &[u8]) {}

    fn sensed(&mut self, now: Instant) -> Option<Sensed<D>> {
        let mut newest = None;
        while let Some(look) = self.looks.get(self.next).filter(|look| look.at <= now) {
            newest = Some(look.clone());
            self.next += 1;
        }
        newest
    }

    fn next_at(&self) -> Option<Instant> {
        self.looks.get(self.next).map(|look| look.at)
    }

    fn drive(&mut self, _now: Instant, _velocity_m_s: &[f64; D]) {}
}

#[cfg(test)]
mod tests {
    use closeranks_core::Settings;

    use super::*;

    fn read(text: &str) -> Result<Replay<2>, ReplayError> {
        let params = Params::new(Settings::default()).unwrap();
        Replay::read(text, RobotId(1), &params, Instant::from_nanos(1_000))
    }

    #[test]
    fn looks_come_at_their_times_and_hold_who_is_in_range() {
        let rows = "0,1,0,0\n0,2,1,0\n0,3,9,0\n0.5,1,0.1,0\n0.5,2,1,0\n";
        let mut replay = read(&format!("time_s,robot,x_m,y_m\n{rows}")).unwrap();
        assert!(replay.sensed(Instant::START).is_none());
        let first = replay.sensed(Instant::from_nanos(1_000)).unwrap();
        assert_eq!(first.others, [(RobotId(2), [1.0, 0.0])]);
        assert_eq!(replay.next_at(), Some(Instant::from_nanos(500_001_000)));
        assert_eq!(replay.sensed(Instant::from_nanos(u64::MAX)).unwrap().own_m, [0.1, 0.0]);
        assert!(replay.is_over());
    }

    #[test]
    fn what_is_no_recording_is_refused_with_its_line() {
        let refused = |text: &str| read(text).map(|_| ()).unwrap_err();
        assert!(matches!(refused("x,y\n"), ReplayError::Head { .. }));
        for row in ["0,12,0,0", "0,1,0", "0,1,0,0,0", "-1,1,0,0", "0,1,nan,0", "0,0,0,0", "1e99,1,0,0"] {
            let error = refused(&format!("time_s,robot,x_m,y_m\n{row}\n"));
            assert!(matches!(error, ReplayError::Row { line: 2, .. }), "{row}: {error}");
        }
        assert_eq!(refused("time_s,robot,x_m,y_m\n1,1,0,0\n0,1,0,0\n"), ReplayError::Order(3));
        assert_eq!(refused("time_s,robot,x_m,y_m\n1,2,0,0\n"), ReplayError::Absent(1));
    }
}
