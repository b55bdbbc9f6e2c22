//! Ways that are listed for robots one by one: in a scenario text, or in a file beside it.

use std::sync::Arc;

use closeranks_core::num::{Vector, length, subtract};
use closeranks_core::settings::range::{Allowed, MAGNITUDE_MAX};

use crate::parse::column::Column;
use crate::parse::common::{NOT_NEGATIVE, POSITION, POSITIVE};
use crate::parse::reader::{Reader, Section};
use crate::parse::rows::rows;

/// Rows of a list or file at most.
pub const ROWS_MAX: usize = 10_000;

/// What a list holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Listed {
    /// Where each robot goes, straight and at `speed_m_s`, and stays.
    Goals,
    /// Where each robot is to be and when; straight between these places, and at most at `speed_m_s` where it lags behind.
    Waypoints,
    /// How fast each robot goes from when on, until its next row.
    Velocities,
}

/// Every kind of list by its name in scenario files, which is also the name of the field with its rows.
pub(crate) const KINDS: [(&str, Listed); 3] =
    [("goals", Listed::Goals), ("waypoints", Listed::Waypoints), ("velocities", Listed::Velocities)];

/// Whose rows a list may have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whose<'a> {
    /// n.
    pub(crate) robots: u16,
    /// Of the space that they move in.
    pub(crate) dimension: usize,
    /// The numbers of the malicious robots, if these alone may be listed.
    pub(crate) malicious: Option<&'a [u16]>,
}

/// One row of a robot.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stop {
    time_s: f64,
    /// A place (m) or a velocity (m/s).
    vector: [f64; 3],
}

/// A list, read and checked. It is shared by whoever clones it.
#[derive(Clone, Debug, PartialEq)]
pub struct Route {
    listed: Listed,
    speed_m_s: f64,
    /// The rows of each robot, times ascending.
    robots: Arc<[Vec<Stop>]>,
}

impl Listed {
    /// Columns of its rows for a team of so many robots, in so many dimensions.
    pub(crate) fn columns(self, robots: u16, dimension: usize) -> Vec<Column> {
        const SPEED: Allowed = Allowed::Closed(-MAGNITUDE_MAX, MAGNITUDE_MAX);
        const VELOCITY: [Column; 3] =
            [Column::new("vx_m_s", SPEED), Column::new("vy_m_s", SPEED), Column::new("vz_m_s", SPEED)];
        let vector = if self == Self::Velocities { &VELOCITY } else { &POSITION };
        let time = Column::new("time_s", NOT_NEGATIVE);
        let times = (self != Self::Goals).then_some(time);
        [Column::robot(robots)].into_iter().chain(times).chain(vector[..dimension].iter().copied()).collect()
    }

    fn name(self) -> &'static str {
        KINDS[self as usize].0
    }
}

impl Route {
    /// Reads the list of this kind, from its own field or from `file`.
    pub(crate) fn read(
        reader: &mut Reader,
        section: &mut Section<'_>,
        listed: Listed,
        whose: &Whose<'_>,
    ) -> Self {
        let columns = listed.columns(whose.robots, whose.dimension);
        let speed_m_s = match listed {
            Listed::Velocities => 0.0,
            _ => reader.number_or(section, "speed_m_s", POSITIVE, 1.0),
        };
        let rows = rows(reader, section, listed.name(), &columns, ROWS_MAX);
        let mut stops = vec![Vec::new(); usize::from(whose.robots)];
        for (numbers, place) in rows {
            if let Err((found, allowed)) = add(&mut stops, &numbers, listed, whose.malicious) {
                place.refuse(reader, &found, &allowed);
                break;
            }
        }
        Self { listed, speed_m_s, robots: stops.into() }
    }

    /// Where robot `index` wants to go at `time_s` when it stands at `position`, m/s; `None` if it is not listed.
    #[must_use]
    pub fn velocity<const D: usize>(
        &self,
        index: usize,
        time_s: f64,
        tick_s: f64,
        position: &Vector<D>,
    ) -> Option<Vector<D>> {
        let stops = self.robots.get(index).filter(|stops| !stops.is_empty())?;
        let place = match self.listed {
            Listed::Velocities => return Some(held(stops, time_s)),
            Listed::Goals => vector(&stops[0].vector),
            Listed::Waypoints => between(stops, time_s + tick_s),
        };
        let way = subtract(&place, position);
        let size = length(&way);
        let share = if size > 0.0 { (self.speed_m_s / size).min(1.0 / tick_s) } else { 0.0 };
        Some(way.map(|component| share * component))
    }
}

/// Adds a row to those of its robot.
fn add(
    stops: &mut [Vec<Stop>],
    numbers: &[f64],
    listed: Listed,
    malicious: Option<&[u16]>,
) -> Result<(), (String, String)> {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of 1 to n")]
    let robot = numbers[0] as u16;
    if let Some(malicious) = malicious.filter(|malicious| !malicious.contains(&robot)) {
        return Err((format!("robot {robot}"), format!("a malicious robot, one of {malicious:?}")));
    }
    let goal = listed == Listed::Goals;
    let (time_s, rest) = if goal { (0.0, &numbers[1..]) } else { (numbers[1], &numbers[2..]) };
    let own = &mut stops[usize::from(robot) - 1];
    if let Some(last) = own.last().filter(|last| time_s <= last.time_s) {
        let last_s = last.time_s;
        return Err(if goal {
            (format!("a second goal of robot {robot}"), "one for each robot".to_owned())
        } else {
            let allowed = format!("more than {last_s}: times of a robot rise");
            (format!("robot {robot} at {time_s} s after {last_s} s"), allowed)
        });
    }
    own.push(Stop { time_s, vector: core::array::from_fn(|d| rest.get(d).copied().unwrap_or(0.0)) });
    Ok(())
}

fn vector<const D: usize>(vector: &[f64; 3]) -> Vector<D> {
    core::array::from_fn(|d| vector[d])
}

/// Times in rows and times of ticks are the same within this, s.
const ROUNDING_S: f64 = 1e-9;

/// How many rows begin at `time_s` or before.
fn begun(stops: &[Stop], time_s: f64) -> usize {
    stops.partition_point(|stop| stop.time_s <= time_s + ROUNDING_S)
}

/// The velocity of the last row that has begun; 0 before the first.
fn held<const D: usize>(stops: &[Stop], time_s: f64) -> Vector<D> {
    begun(stops, time_s).checked_sub(1).map_or([0.0; D], |last| vector(&stops[last].vector))
}

/// The place on the straight way between two rows; the first before it begins, the last after it has.
fn between<const D: usize>(stops: &[Stop], time_s: f64) -> Vector<D> {
    let next = begun(stops, time_s);
    let (before, after) = (stops[next.saturating_sub(1)], stops[next.min(stops.len() - 1)]);
    let (x, y): (Vector<D>, Vector<D>) = (vector(&before.vector), vector(&after.vector));
    let span_s = after.time_s - before.time_s;
    let share = if span_s > 0.0 { ((time_s - before.time_s) / span_s).clamp(0.0, 1.0) } else { 0.0 };
    core::array::from_fn(|d| x[d] + share * (y[d] - x[d]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn route(listed: Listed, rows: &[[f64; 3]]) -> Route {
        let stop = |row: &[f64; 3]| Stop { time_s: row[0], vector: [row[1], row[2], 0.0] };
        let rows = vec![rows.iter().map(stop).collect(), Vec::new()];
        Route { listed, speed_m_s: 2.0, robots: rows.into() }
    }

    #[test]
    fn goals_are_reached_and_not_passed() {
        let route = route(Listed::Goals, &[[0.0, 3.0, 4.0]]);
        let at = |position| route.velocity(0, 0.0, 0.1, &position).unwrap().map(|v| (v * 1e9).round() / 1e9);
        assert_eq!([at([0.0, 0.0]), at([3.0, 3.9])], [[1.2, 1.6], [0.0, 1.0]]);
        assert_eq!(route.velocity(0, 9.0, 0.1, &[3.0, 4.0]), Some([0.0, 0.0]));
        assert_eq!(route.velocity::<2>(1, 0.0, 0.1, &[0.0, 0.0]), None);
    }

    #[test]
    fn waypoints_are_met_in_time() {
        let stops = route(Listed::Waypoints, &[[1.0, 0.0, 0.0], [2.0, 1.0, 0.0]]).robots[0].clone();
        let x = |time_s| between::<2>(&stops, time_s)[0];
        assert_eq!([x(0.0), x(1.0), x(1.25), x(2.0), x(9.0)], [0.0, 0.0, 0.25, 1.0, 1.0]);
    }

    #[test]
    fn velocities_hold_until_the_next() {
        let route = route(Listed::Velocities, &[[0.3, 1.0, 0.0], [0.6, 0.0, 2.0]]);
        let at = |time_s| route.velocity(0, time_s, 0.1, &[0.0, 0.0]).unwrap();
        assert_eq!(
            [at(0.2), at(0.1 * 3.0), at(0.59), at(99.0)],
            [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 2.0]]
        );
    }
}
