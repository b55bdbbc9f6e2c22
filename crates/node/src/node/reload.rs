//! Files that are read again while a robot runs: its own one and its roster, when they change.

use core::sync::atomic::{AtomicBool, Ordering};
use core::time::Duration;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::SyncSender;
use std::thread;
use std::time::SystemTime;

use closeranks_core::RobotId;

use crate::config::{Config, Network, Plant};
use crate::identity::roster::Roster;
use crate::node::run::Event;
use crate::node::{NodeError, load_roster, named};

/// How often files are looked at.
const EVERY: Duration = Duration::from_secs(1);

/// When both files were changed last.
type Times = [Option<SystemTime>; 2];

fn times(config: &Path, roster: &Path) -> Times {
    [config, roster].map(|path| fs::metadata(path).and_then(|found| found.modified()).ok())
}

/// Looks at the file of a robot and at its roster until `stop`, and tells the robot what is new in them.
pub(crate) fn watch(
    file: PathBuf,
    old: Config,
    first: Arc<Roster>,
    queue: SyncSender<Event>,
    stop: Arc<AtomicBool>,
) {
    thread::spawn(move || {
        let mut seen = times(&file, &old.roster);
        let mut network = old.network.clone();
        while !stop.load(Ordering::Relaxed) {
            thread::sleep(EVERY);
            let now = times(&file, &old.roster);
            if now == seen {
                continue;
            }
            seen = now;
            let News { roster, distrusted, network: new } = match read(&file, &old, &first) {
                Ok(news) => news,
                Err(error) => {
                    eprintln!("the changed files are not used: {error}");
                    continue;
                }
            };
            let mut events = vec![Event::Files(roster, distrusted)];
            if new != network {
                network = new.clone();
                events.push(Event::Network(Box::new(new)));
            }
            for event in events {
                if queue.send(event).is_err() {
                    return;
                }
            }
        }
    });
}

/// What a running robot takes from its files.
#[derive(Debug)]
pub(crate) struct News {
    pub(crate) roster: Arc<Roster>,
    pub(crate) distrusted: Vec<RobotId>,
    pub(crate) network: Network,
}

/// What a running robot takes from its files; an error if something in them is wrong or needs another start.
pub(crate) fn read(file: &Path, old: &Config, first: &Roster) -> Result<News, NodeError> {
    let new = Config::load(file)?;
    let rest = |of: &Config| Config { distrust: Vec::new(), network: Network::default(), ..of.clone() };
    if rest(&new) != rest(old) {
        return Err(NodeError::Restart);
    }
    let roster = load_roster(&new)?;
    if old.plant == Plant::Simulated && roster.hash() != first.hash() {
        return Err(NodeError::PlantsRoster);
    }
    let distrusted = new.distrust.iter().map(|name| named(&roster, "distrust", name));
    let distrusted = distrusted.collect::<Result<_, _>>()?;
    Ok(News { roster, distrusted, network: new.network })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bytes::hex;
    use crate::testing::{draft, key, sign};

    #[test]
    fn who_is_not_believed_is_read_anew_and_what_needs_a_start_is_said() {
        let folder = tempfile::tempdir().unwrap();
        let (file, roster) = (folder.path().join("robot.toml"), folder.path().join("roster.toml"));
        fs::write(&roster, sign(&draft(3, 0, ""))).unwrap();
        let first = Roster::load(&roster, None).unwrap();
        let operator = hex(first.operator().as_bytes());
        let write = |extra: &str| {
            let head = format!("robot = 'robot_1'\nroster = 'roster.toml'\noperator = '{operator}'\n");
            fs::write(&file, format!("{head}key = 'k'\nepoch = 'e'\n{extra}")).unwrap();
        };
        write("");
        let old = Config::load(&file).unwrap();
        write("distrust = ['robot_3']\n");
        assert_eq!(read(&file, &old, &first).unwrap().distrusted, [RobotId(3)]);
        write("[network]\nconnect = ['tcp/10.0.0.2:7447']\n");
        assert_eq!(read(&file, &old, &first).unwrap().network.connect, ["tcp/10.0.0.2:7447"]);
        write("distrust = ['robot_9']\n");
        assert!(read(&file, &old, &first).unwrap_err().to_string().contains("`distrust` is `robot_9`"));
        write("value = 2.0\n");
        assert!(matches!(read(&file, &old, &first), Err(NodeError::Restart)));
        write("");
        let mut other = draft(3, 0, "");
        other.robots[2].key = hex(key(RobotId(9)).verifying_key().as_bytes());
        fs::write(&roster, sign(&other)).unwrap();
        assert!(matches!(read(&file, &old, &first), Err(NodeError::PlantsRoster)));
        write("[plant]\nkind = 'ros2'\n");
        let old = Config::load(&file).unwrap();
        assert_ne!(read(&file, &old, &first).unwrap().roster.hash(), first.hash());
        fs::write(&roster, "junk").unwrap();
        assert!(matches!(read(&file, &old, &first), Err(NodeError::Roster(_))));
    }
}
