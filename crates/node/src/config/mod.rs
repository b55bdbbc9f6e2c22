//! The file of one robot. Paths in it are relative to the folder that it is in.

mod ros2;

use core::time::Duration;
use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::clock::Kind;
pub use crate::config::ros2::{PoseType, Ros2};

/// What a robot is told besides its roster.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Config {
    /// Its name in the roster.
    pub robot: String,
    /// The signed roster.
    pub roster: PathBuf,
    /// Public key of the operator whose signature on the roster counts.
    pub operator: String,
    /// Its private key.
    pub key: PathBuf,
    /// Where the number of its starts is kept.
    pub epoch: PathBuf,
    /// Its initial value y_i(t₀).
    #[serde(default)]
    pub value: f64,
    /// Where proofs of two-faced robots are written.
    #[serde(default = "proofs")]
    pub proofs: PathBuf,
    /// Names of robots that are not to be believed, whatever they tell.
    #[serde(default)]
    pub distrust: Vec<String>,
    /// Whether words on trust are taken from the key `PREFIX/trust/ID` while the robot runs. They are not signed.
    #[serde(default)]
    pub trust_key: bool,
    /// What comes from a source, a pose or a wish, is not used when it is older, s; a source may say otherwise. 0 switches this off.
    #[serde(default = "half_a_second")]
    pub source_timeout_s: f64,
    /// The clock.
    #[serde(default)]
    pub clock: Kind,
    /// The network.
    #[serde(default)]
    pub network: Network,
    /// Where the robot is and how it moves.
    #[serde(default)]
    pub plant: Plant,
    /// Where it wants to go.
    #[serde(default)]
    pub desired: Desired,
    /// The file that this was read from, which is read again when it changes.
    #[serde(skip)]
    pub file: Option<PathBuf>,
}

/// How the robot is connected.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Network {
    /// `peer` or `client` of Zenoh.
    pub mode: String,
    /// Endpoints at which others may connect, such as `tcp/0.0.0.0:7447`.
    pub listen: Vec<String>,
    /// Endpoints to connect to. Peers do not pass on what they hear, so every robot that is to be heard must be there, or
    /// connect from the other side; or a router must be.
    pub connect: Vec<String>,
    /// What all keys of the team begin with.
    pub prefix: String,
    /// A file of Zenoh itself (JSON5) for what has no field here, such as certificates and access control. What stands here counts more.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub zenoh: Option<PathBuf>,
    /// Whether others are heard themselves, or through a relay that plays a bad network.
    pub hear: Hear,
}

/// Whose messages are listened to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Hear {
    /// What robots say.
    #[default]
    Direct,
    /// What the relay hands on to this robot.
    Relayed,
}

impl Default for Network {
    fn default() -> Self {
        Self {
            mode: "peer".into(),
            listen: Vec::new(),
            connect: Vec::new(),
            prefix: "closeranks".into(),
            zenoh: None,
            hear: Hear::Direct,
        }
    }
}

/// Where the robot is and how it moves.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", tag = "kind")]
pub enum Plant {
    /// A `closeranks-node plant` whose key is in the roster.
    #[default]
    Simulated,
    /// Positions of all robots from a file; velocities go nowhere.
    Replay {
        /// The file.
        file: PathBuf,
    },
    /// Topics of ROS 2, in rmw_zenoh's form.
    Ros2(Ros2),
}

/// Where the robot wants to go.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", tag = "source")]
pub enum Desired {
    /// Nowhere: it holds its place.
    #[default]
    Hold,
    /// As the table `motion` of a scenario says.
    Scenario {
        /// The file of the scenario.
        file: PathBuf,
    },
    /// What is put on the key `PREFIX/want/ID`: one number a dimension, m/s, as JSON, such as `[0.5, 0.0]`.
    Key {
        /// Older ones are not followed; the robot then slows down to a halt and says `HOLD`. 0 switches this off. Left out:
        /// `source_timeout_s` of the robot.
        timeout_s: Option<f64>,
    },
    /// The velocity that a planner asks of the base, on a topic of ROS 2; the plant must be `ros2` too.
    Ros2 {
        /// The topic.
        #[serde(default = "velocity_in")]
        cmd_vel_in_topic: String,
        /// As for `key`.
        timeout_s: Option<f64>,
    },
}

fn velocity_in() -> String {
    "{name}/cmd_vel_in".into()
}

fn half_a_second() -> f64 {
    0.5
}

fn proofs() -> PathBuf {
    "proofs".into()
}

/// Why a configuration is not used.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("{path}: {error}")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why not.
        error: std::io::Error,
    },
    /// It is not TOML, or has other fields.
    #[error("{path}: {error}")]
    Toml {
        /// Which file.
        path: PathBuf,
        /// What is wrong, and where.
        error: String,
    },
    /// A number or word is not allowed.
    #[error("{path}: `{field}` is {found}, allowed is {allowed}")]
    Field {
        /// Which file.
        path: PathBuf,
        /// Which field.
        field: &'static str,
        /// What it is.
        found: String,
        /// What it may be.
        allowed: &'static str,
    },
}

impl Config {
    /// The configuration in a file, with its paths made relative to nothing.
    pub fn load(path: &Path) -> Result<Self, ConfigError> {
        let text =
            fs::read_to_string(path).map_err(|error| ConfigError::File { path: path.into(), error })?;
        let mut config: Self = toml::from_str(&text)
            .map_err(|error| ConfigError::Toml { path: path.into(), error: error.to_string() })?;
        config.check(path)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        let paths = [&mut config.roster, &mut config.key, &mut config.epoch, &mut config.proofs];
        let plant = match &mut config.plant {
            Plant::Replay { file } => Some(file),
            Plant::Simulated | Plant::Ros2(_) => None,
        };
        let desired = match &mut config.desired {
            Desired::Scenario { file } => Some(file),
            Desired::Hold | Desired::Key { .. } | Desired::Ros2 { .. } => None,
        };
        for path in paths.into_iter().chain(plant).chain(desired).chain(&mut config.network.zenoh) {
            *path = folder.join(&*path);
        }
        config.file = Some(path.to_owned());
        Ok(config)
    }

    fn check(&self, path: &Path) -> Result<(), ConfigError> {
        let wrong = |field, found: &dyn ToString, allowed| {
            Err(ConfigError::Field { path: path.into(), field, found: found.to_string(), allowed })
        };
        if !(-1e300..=1e300).contains(&self.value) {
            return wrong("value", &self.value, "a number of at most 1e300");
        }
        let Network { mode, prefix, .. } = &self.network;
        if mode != "peer" && mode != "client" {
            return wrong("network.mode", &format!("`{mode}`"), "peer or client");
        }
        let good = |letter: char| letter.is_ascii_alphanumeric() || "_-/".contains(letter);
        let whole = prefix.split('/').all(|part| !part.is_empty());
        if prefix.len() > 100 || !prefix.chars().all(good) || !whole {
            return wrong(
                "network.prefix",
                &format!("`{prefix}`"),
                "words of letters, digits, _ and -, with / between them",
            );
        }
        if !(0.0..=3_600.0).contains(&self.source_timeout_s) {
            return wrong("source_timeout_s", &self.source_timeout_s, "0 (off) to 3600");
        }
        match self.desired {
            Desired::Key { timeout_s: Some(timeout_s) }
            | Desired::Ros2 { timeout_s: Some(timeout_s), .. }
                if !(0.0..=3_600.0).contains(&timeout_s) =>
            {
                wrong("desired.timeout_s", &timeout_s, "0 (off) to 3600")
            }
            Desired::Ros2 { .. } if !matches!(self.plant, Plant::Ros2(_)) => {
                wrong("desired.source", &"ros2", "hold, scenario or key unless plant.kind is ros2 too")
            }
            _ => self.check_ros(path),
        }
    }
}

impl Config {
    /// When a source that may say `own_s` itself is too old; 0: never.
    #[must_use]
    pub fn timeout(&self, own_s: Option<f64>) -> Duration {
        Duration::from_secs_f64(own_s.unwrap_or(self.source_timeout_s))
    }

    fn check_ros(&self, path: &Path) -> Result<(), ConfigError> {
        let Plant::Ros2(ros) = &self.plant else { return Ok(()) };
        let wrong = |field, found: &dyn ToString, allowed| {
            Err(ConfigError::Field { path: path.into(), field, found: found.to_string(), allowed })
        };
        if let Some(timeout_s) = ros.source_timeout.filter(|timeout_s| !(0.0..=3_600.0).contains(timeout_s)) {
            return wrong("plant.source_timeout", &timeout_s, "0 (off) to 3600");
        }
        if let Some(ahead_m) = ros.look_ahead_m.filter(|ahead_m| !(0.001..=10.0).contains(ahead_m)) {
            return wrong("plant.look_ahead_m", &ahead_m, "0.001 to 10");
        }
        if ros.domain > 232 {
            return wrong("plant.domain", &ros.domain, "0 to 232");
        }
        if !ros.pose_topic.contains("{name}") {
            return wrong("plant.pose_topic", &ros.pose_topic, "a topic with {name}, one for each robot");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn load(extra: &str) -> Result<Config, ConfigError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("robot.toml");
        let head = "robot = 'robot_1'\nroster = 'roster.toml'\noperator = '00'\nkey = 'k'\nepoch = '/e'\n";
        fs::write(&path, format!("{head}{extra}")).unwrap();
        Config::load(&path)
    }

    #[test]
    fn defaults_are_there_and_paths_begin_at_the_file() {
        let config = load("").unwrap();
        assert_eq!(
            (config.plant, config.desired, config.clock),
            (Plant::Simulated, Desired::Hold, Kind::Wall)
        );
        assert!(config.key.is_absolute() && config.key.ends_with("k"));
        assert_eq!(config.epoch, Path::new("/e"));
    }

    #[test]
    fn every_source_has_the_one_default_and_may_say_otherwise() {
        let config = load("source_timeout_s = 0.3\n[desired]\nsource = 'key'\n").unwrap();
        assert_eq!(config.desired, Desired::Key { timeout_s: None });
        let ms = |own_s| config.timeout(own_s).as_millis();
        assert_eq!((ms(None), ms(Some(0.1)), ms(Some(0.0))), (300, 100, 0));
        assert_eq!(load("").unwrap().timeout(None), Duration::from_millis(500));
        let refused = load("source_timeout_s = -1.0").unwrap_err().to_string();
        assert!(refused.contains("`source_timeout_s` is -1, allowed is 0 (off) to 3600"), "{refused}");
    }

    #[test]
    fn topics_of_ros_have_the_names_of_nav2() {
        let config =
            load("[plant]\nkind = 'ros2'\nlook_ahead_m = 0.1\n[desired]\nsource = 'ros2'\n").unwrap();
        let Plant::Ros2(ros) = &config.plant else { panic!("{:?}", config.plant) };
        assert_eq!((ros.cmd_vel_out_topic.as_str(), ros.look_ahead_m), ("{name}/cmd_vel", Some(0.1)));
        let refused = |extra: &str| load(extra).unwrap_err().to_string();
        assert!(refused("[desired]\nsource = 'ros2'").contains("`desired.source` is ros2"));
        assert!(refused("[plant]\nkind = 'ros2'\nlook_ahead_m = 0.0").contains("`plant.look_ahead_m` is 0"));
        assert!(refused("[plant]\nkind = 'ros2'\npose_topic = 'odom'").contains("one for each robot"));
        assert!(refused("[plant]\nkind = 'ros2'\nros_distro = 'noetic'").contains("noetic"));
    }

    #[test]
    fn wrong_fields_are_named() {
        let refused = |extra: &str| load(extra).unwrap_err().to_string();
        assert!(refused("sped = 1").contains("unknown field `sped`"));
        assert!(refused("value = nan").contains("`value` is NaN, allowed is a number of at most 1e300"));
        assert!(
            refused("[network]\nmode = 'router'")
                .contains("`network.mode` is `router`, allowed is peer or client")
        );
        assert!(refused("[network]\nprefix = 'a//b'").contains("`network.prefix` is `a//b`"));
        assert!(refused("[desired]\nsource = 'key'\ntimeout_s = -1.0").contains("`desired.timeout_s` is -1"));
    }
}
