//! What a robot says of itself to planners and people: what was wanted, what it does instead, since when it is blocked, and which rows
//! and robots are in the way. It is published as JSON in every tick, from the first one on, and nothing rests on it.

use closeranks_core::num::{dot, length, subtract};
use closeranks_core::{Instant, Outcome, Params, RobotId, Slot};
use serde::Serialize;

use crate::gate::Reject;
use crate::wire::mode;
use crate::wire::report::Report;

/// A robot is blocked while it makes less of the way that is wanted than this part.
pub const BLOCKED_BELOW: f64 = 0.5;
/// Slower wishes than this, m/s, are not counted as wishes.
const WISH_MIN_M_S: f64 = 1e-6;
/// Rounding of r·v, m²/s.
const LEAVES_LESS: f64 = 1e-9;

/// What a row keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Row {
    /// (near): the least distance to a robot.
    Distance,
    /// (held), under `links`: a kept link whose other end what was wanted leaves faster than the answer does.
    Link,
    /// The robot's or its neighbours' connectivity, under `budget` and `composed`: as for a link, with any neighbour.
    Connectivity,
    /// The velocity that the robot can have.
    Input,
}

/// A row that what was wanted would break, or a link that it would weaken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Obstacle {
    /// What is kept.
    pub row: Row,
    /// With whom; the input box is nobody's.
    pub robot: Option<u16>,
}

/// Since when a robot is blocked.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Blocked {
    /// On the clock of the robot, s.
    pub since_s: f64,
    /// How long that is, s.
    pub for_s: f64,
}

/// What is published in a tick.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Status {
    /// Number of the robot.
    pub robot: u16,
    /// When it decided, on its clock, s.
    pub time_s: f64,
    /// What the answer is worth.
    pub mode: &'static str,
    /// δ_i and what of it is more than needed.
    pub degree: u16,
    /// See `degree`.
    pub margin: i32,
    /// What was wanted, m/s; none where there is no usable wish.
    pub wanted_m_s: Option<Vec<f64>>,
    /// What the robot does, m/s.
    pub velocity_m_s: Vec<f64>,
    /// The part of the wanted way that it makes.
    pub progress: Option<f64>,
    /// Set while that is less than half.
    pub blocked: Option<Blocked>,
    /// What is in the way, while the answer is not the wish.
    pub rows: Vec<Obstacle>,
    /// Where it counts itself, m.
    pub own_m: Vec<f64>,
    /// Its neighbours in sight, and where they are, m.
    pub neighbors: Vec<(u16, Vec<f64>)>,
    /// Robots that are not believed.
    pub distrusted: Vec<u16>,
    /// Ticks without anything sensed since the start.
    pub missed: u32,
    /// What was rejected so far, by reason, without zeros.
    pub rejects: Vec<(&'static str, u32)>,
}

/// Remembers since when a robot is blocked.
#[derive(Clone, Copy, Debug, Default)]
pub struct Watch {
    since: Option<Instant>,
}

/// What a status is made of besides the report.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, const D: usize> {
    /// Number of the robot.
    pub id: RobotId,
    /// Its parameters.
    pub params: &'a Params<D>,
    /// Its neighbours.
    pub slots: &'a [Slot<D>],
    /// Whether there was a wish.
    pub wished: bool,
}

impl Watch {
    /// The status at `now`.
    pub fn status<const D: usize>(
        &mut self,
        now: Instant,
        scene: &Scene<'_, D>,
        report: &Report<D>,
        distrusted: Vec<u16>,
    ) -> Status {
        let progress = if scene.wished { progress(&report.desired_m_s, &report.velocity_m_s) } else { None };
        let stopped = progress.is_some_and(|progress| progress < BLOCKED_BELOW);
        self.since = if stopped { self.since.or(Some(now)) } else { None };
        let blocked = self
            .since
            .map(|since| Blocked { since_s: seconds(since), for_s: now.since(since).as_secs_f64() });
        let rejects = Reject::ALL.iter().map(|reject| (reject.name(), report.rejected(*reject)));
        Status {
            robot: scene.id.0,
            time_s: seconds(now),
            mode: mode::word(report.mode),
            degree: report.degree,
            margin: report.degree_margin,
            wanted_m_s: scene.wished.then(|| report.desired_m_s.to_vec()),
            velocity_m_s: report.velocity_m_s.to_vec(),
            progress,
            blocked,
            rows: if scene.wished { obstacles(scene, report) } else { Vec::new() },
            own_m: report.reference_m.to_vec(),
            neighbors: scene.slots.iter().map(|slot| place(slot, report)).collect(),
            distrusted,
            missed: report.missed,
            rejects: rejects.filter(|(_, count)| *count > 0).collect(),
        }
    }
}

#[expect(clippy::cast_precision_loss, reason = "for people: microseconds are enough")]
fn seconds(at: Instant) -> f64 {
    at.as_nanos() as f64 * 1e-9
}

fn place<const D: usize>(slot: &Slot<D>, report: &Report<D>) -> (u16, Vec<f64>) {
    (slot.id().0, subtract(&report.reference_m, &slot.offset_m()).to_vec())
}

/// The part of the wish that is fulfilled; `None` without a wish.
fn progress<const D: usize>(wanted_m_s: &[f64; D], velocity_m_s: &[f64; D]) -> Option<f64> {
    let speed_m_s = length(wanted_m_s);
    let along_m_s = dot(wanted_m_s, velocity_m_s) / speed_m_s;
    (speed_m_s > WISH_MIN_M_S).then_some(along_m_s / speed_m_s)
}

/// The rows that what was wanted would break.
fn obstacles<const D: usize>(scene: &Scene<'_, D>, report: &Report<D>) -> Vec<Obstacle> {
    let (wanted, input) = (&report.desired_m_s, &scene.params.settings().limits.input);
    let mut found = Vec::new();
    if input.clip(wanted) != *wanted {
        found.push(Obstacle { row: Row::Input, robot: None });
    }
    if report.outcome == Outcome::Free {
        return found;
    }
    let lists = scene.params.controller().tells_lists();
    for slot in scene.slots {
        let rows = [
            (Row::Distance, breaks_distance(scene.params, slot, wanted)),
            (Row::Link, lists && spares_held(slot, report)),
            (Row::Connectivity, !lists && slot.link().weight > 0.0 && is_left_less(slot, report)),
        ];
        let robot = Some(slot.id().0);
        found.extend(rows.iter().filter(|(_, broken)| *broken).map(|(row, _)| Obstacle { row: *row, robot }));
    }
    found
}

/// Whether the wish breaks (near) of this neighbour, as errors allow.
fn breaks_distance<const D: usize>(params: &Params<D>, slot: &Slot<D>, wanted_m_s: &[f64; D]) -> bool {
    let (kept, offset_m) = (params.kept(), slot.offset_m());
    let spare_m2 = dot(&offset_m, &offset_m) - kept.distance_min_m * kept.distance_min_m;
    let move_m = params.desired_m(wanted_m_s);
    let closing_m2 = 2.0 * kept.errors.offset_m * length(&move_m) - 2.0 * dot(&offset_m, &move_m);
    closing_m2 > 0.5 * kept.gamma_c * spare_m2.max(0.0)
}

/// Whether what was wanted leaves this neighbour faster than the answer does.
fn is_left_less<const D: usize>(slot: &Slot<D>, report: &Report<D>) -> bool {
    let spared_m_s = subtract(&report.desired_m_s, &report.velocity_m_s);
    let offset_m = slot.offset_m();
    dot(&offset_m, &report.desired_m_s) > 0.0 && dot(&offset_m, &spared_m_s) > LEAVES_LESS
}

/// Whether the answer spares a link that is listed, kept for others or counted on.
fn spares_held<const D: usize>(slot: &Slot<D>, report: &Report<D>) -> bool {
    let named = report.rows.iter().chain(&report.counted).any(|id| *id == slot.id());
    (slot.is_listed() || named) && is_left_less(slot, report)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use closeranks_core::Mode;

    use super::*;
    use crate::node::pilot::{Identity, Pilot};
    use crate::testing::{key, roster_with};
    use crate::wire::sensed::Sensed;

    /// Robot 1 at the origin and the others where they are said to be; it wants to move by `wanted`.
    fn status(
        pilot: &mut Pilot<2>,
        watch: &mut Watch,
        tick: u64,
        others: &[[f64; 2]],
        wanted: [f64; 2],
    ) -> Status {
        let at = Instant::from_nanos(tick * 50_000_000);
        let ids = (2..).map(RobotId);
        let sensed = Sensed { at, own_m: [0.0; 2], others: ids.zip(others.iter().copied()).collect() };
        let _ = pilot.sense(&sensed);
        let report = pilot.decide(wanted);
        pilot.status(watch, at, wanted[0].is_finite(), &report)
    }

    fn pilot(kind: &str) -> Pilot<2> {
        let settings = format!("[controller]\nkind = '{kind}'\n[clock]\ntau_1_s = 0.05\ntau_2_s = 0.2\n");
        let roster = roster_with(3, 0, &settings);
        let params = roster.scenario().params().unwrap();
        let id = RobotId(1);
        Pilot::new(Identity { roster: Arc::clone(&roster), id, key: key(id), epoch: 1 }, params, 0.0).unwrap()
    }

    #[test]
    fn the_robot_in_the_way_is_named_and_the_time_counts_from_the_first_tick_of_it() {
        let (mut pilot, mut watch) = (pilot("links"), Watch::default());
        let others = [[0.3001, 0.0], [0.0, 1.0]];
        let free = status(&mut pilot, &mut watch, 0, &others, [-0.1, 0.0]);
        assert_eq!((free.blocked, free.rows.iter().any(|it| it.row == Row::Distance)), (None, false));
        for tick in 1..=3 {
            let met = status(&mut pilot, &mut watch, tick, &others, [1.0, 0.0]);
            let blocked = met.blocked.unwrap();
            assert!((blocked.since_s - 0.05).abs() < 1e-9, "{blocked:?}");
            assert!((blocked.for_s - 0.05 * f64::from(u32::try_from(tick).unwrap() - 1)).abs() < 1e-9);
            assert!(met.rows.contains(&Obstacle { row: Row::Distance, robot: Some(2) }), "{:?}", met.rows);
            assert!(!met.rows.contains(&Obstacle { row: Row::Distance, robot: Some(3) }), "{:?}", met.rows);
            assert_eq!(met.wanted_m_s, Some(vec![1.0, 0.0]));
        }
        let away = status(&mut pilot, &mut watch, 4, &others, [-0.1, 0.0]);
        assert_eq!(away.blocked, None, "{away:?}");
        let again = status(&mut pilot, &mut watch, 5, &others, [1.0, 0.0]);
        assert_eq!(again.blocked.unwrap().for_s, 0.0);
    }

    #[test]
    fn a_robot_that_is_too_close_may_always_move_away() {
        for kind in ["links", "budget"] {
            let (mut pilot, mut watch) = (pilot(kind), Watch::default());
            let close = status(&mut pilot, &mut watch, 0, &[[0.2, 0.0], [0.0, 1.0]], [-0.1, 0.0]);
            assert!(close.velocity_m_s[0] < 0.0 && close.blocked.is_none(), "{kind}: {close:?}");
        }
    }

    #[test]
    fn a_word_on_trust_counts_while_the_robot_runs() {
        let (mut pilot, mut watch) = (pilot("budget"), Watch::default());
        assert_eq!(pilot.hear_trust(br#"{"robot": 3, "trust": 0}"#), Some((RobotId(3), false)));
        let told = status(&mut pilot, &mut watch, 0, &[[1.0, 0.0], [0.0, 1.0]], [0.0, 0.0]);
        assert_eq!(told.distrusted, [3]);
        for wrong in [
            &br#"{"robot": 1, "trust": 0}"#[..],
            br#"{"robot": 4, "trust": 0}"#,
            br#"{"robot": 2, "trust": 0.5}"#,
            br#"{"robot": 2}"#,
            b"0",
            &[b' '; 300],
        ] {
            assert_eq!(pilot.hear_trust(wrong), None);
        }
        assert_eq!(pilot.hear_trust(br#"{"robot": 3, "trust": 1}"#), Some((RobotId(3), true)));
    }

    #[test]
    fn a_robot_that_knows_nothing_says_so_from_the_first_tick() {
        let (mut pilot, mut watch) = (pilot("budget"), Watch::default());
        let report = pilot.decide([f64::NAN; 2]);
        assert_eq!(report.mode, Mode::Stopped);
        let first = pilot.status(&mut watch, Instant::from_nanos(5), false, &report);
        let json = serde_json::to_string(&first).unwrap();
        assert!(json.contains("\"mode\":\"STOPPED\"") && json.contains("\"wanted_m_s\":null"), "{json}");
    }
}
