//! A run on its way into a file, tick by tick.

use std::io::{self, Seek, Write};

use closeranks_sim::output::snapshot::Snapshot;
use closeranks_sim::scenario::Scenario;

use crate::container::{Container, Opening};
use crate::diagnostics::diagnostics;
use crate::look::{COMMAND, LIBRARY, Look, METADATA};
use crate::markers::markers;
use crate::messages::{name, odometry, pose_stamped, state, transforms, twist_stamped};
use crate::metadata::Metadata;
use crate::schemas::{ROBOT_STATE, schema, spelt};

/// Topics of the whole team, before those of robots.
const TEAM: [(&str, &str); 3] = [
    ("/tf", "tf2_msgs/TFMessage"),
    ("/markers", "visualization_msgs/MarkerArray"),
    ("/diagnostics", "diagnostic_msgs/DiagnosticArray"),
];
/// Topics of every robot.
const ROBOT: [(&str, &str); 5] = [
    ("pose", "geometry_msgs/PoseStamped"),
    ("odom", "nav_msgs/Odometry"),
    ("cmd_vel_in", "geometry_msgs/TwistStamped"),
    ("cmd_vel", "geometry_msgs/TwistStamped"),
    ("state", ROBOT_STATE),
];
/// How often what people look at is recorded, at most, a second.
const SHOWN_HZ: f64 = 30.0;

/// Writes one run.
pub struct RunWriter<W: Write + Seek> {
    file: Container<W>,
    look: Look,
    tick_ns: u64,
    /// Every so many ticks there are markers and diagnostics.
    shown_every: u32,
    ticks: u32,
}

impl<W: Write + Seek> RunWriter<W> {
    /// Begins the recording of a run of `scenario` that `command` started; refused where robots come and go and where there are several
    /// teams, because messages have no word for either.
    pub fn new(scenario: &Scenario, metadata: &Metadata<'_>, command: &str, sink: W) -> io::Result<Self> {
        if !scenario.teams.is_empty() {
            let why = "`teams`: messages of ROS 2 have no word for several teams";
            return Err(io::Error::new(io::ErrorKind::Unsupported, why));
        }
        if !scenario.absences.is_empty() {
            let why = "`team.absent`: messages of ROS 2 have no word for robots that come and go";
            return Err(io::Error::new(io::ErrorKind::Unsupported, why));
        }
        let tick_ns = u64::try_from(scenario.clock.level_period.as_nanos()).unwrap_or(u64::MAX);
        let every = (1.0 / (SHOWN_HZ * scenario.tick_s())).ceil().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates; at least 1")]
        let shown_every = every as u32;
        let file = Container::new(sink, &opening(scenario, metadata, command))?;
        Ok(Self { file, look: Look::new(scenario), tick_ns, shown_every, ticks: scenario.ticks() })
    }

    /// Adds a tick; ticks come in their order.
    pub fn tick(&mut self, now: &Snapshot<'_>) -> io::Result<()> {
        let time_ns = u64::from(now.tick).saturating_mul(self.tick_ns);
        self.file.message(0, time_ns, &transforms(now, time_ns))?;
        if now.tick.is_multiple_of(self.shown_every) || now.tick == self.ticks {
            self.file.message(1, time_ns, &markers(now, time_ns, &self.look))?;
            self.file.message(2, time_ns, &diagnostics(now, time_ns, &self.look.malicious))?;
        }
        for index in 0..now.robots() {
            self.robot(now, time_ns, index)?;
        }
        Ok(())
    }

    fn robot(&mut self, now: &Snapshot<'_>, time_ns: u64, index: usize) -> io::Result<()> {
        let messages = [
            pose_stamped(now, time_ns, index),
            odometry(now, time_ns, index),
            twist_stamped(now, time_ns, now.asked_m_s, index),
            twist_stamped(now, time_ns, now.inputs_m_s, index),
            state(now, time_ns, index, self.look.malicious[index]),
        ];
        let first = TEAM.len() + index * ROBOT.len();
        for (place, message) in messages.iter().enumerate() {
            self.file.message(first + place, time_ns, message)?;
        }
        Ok(())
    }

    /// Writes what is not yet written. Without it the file lacks its last chunk and is whole all the same.
    pub fn finish(mut self) -> io::Result<()> {
        self.file.flush()
    }
}

fn opening(scenario: &Scenario, metadata: &Metadata<'_>, command: &str) -> Opening<'static> {
    let robots = usize::from(scenario.team.robots);
    let team = TEAM.iter().map(|(topic, kind)| ((*topic).to_owned(), *kind));
    let of_robot =
        |index| ROBOT.iter().map(move |(topic, kind)| (format!("/{}/{topic}", name(index)), *kind));
    let all: Vec<(String, &str)> = team.chain((0..robots).flat_map(of_robot)).collect();
    let mut kinds: Vec<&str> = Vec::new();
    let mut topics = Vec::new();
    for (topic, kind) in all {
        let place = kinds.iter().position(|known| *known == kind).unwrap_or(kinds.len());
        if place == kinds.len() {
            kinds.push(kind);
        }
        topics.push((topic, place));
    }
    let pairs = vec![
        (COMMAND, command.to_owned()),
        ("seed", metadata.seed.to_string()),
        ("version", metadata.version.to_owned()),
        ("commit", metadata.commit.to_owned()),
        ("scenario", metadata.scenario.to_owned()),
    ];
    Opening {
        library: format!("{LIBRARY}{}", metadata.version),
        metadata: (METADATA, pairs),
        schemas: kinds.into_iter().map(|kind| (spelt(kind), schema(kind))).collect(),
        topics,
    }
}
