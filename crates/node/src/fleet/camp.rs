//! The processes of a fleet: their keys, their roster, their files, and how they are started and ended.

use core::time::Duration;
use std::fs;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;

use closeranks_sim::scenario::Scenario;
use closeranks_sim::world::{RunError, initial_values};
use ed25519_dalek::SigningKey;
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use crate::bytes::hex;
use crate::config::{Config, Desired, Hear, Network, Plant};
use crate::identity::keys::{self, KeyError};
use crate::identity::parameters;
use crate::identity::roster::{Draft, Entry, Roster, RosterError};
use crate::scenarios::FleetScenario;

/// How long a process may take to stop before it is ended.
const GRACE: Duration = Duration::from_secs(3);

/// Why a fleet cannot be built.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "each says what it is about itself")]
pub enum CampError {
    #[error("{path}: {error}")]
    File { path: PathBuf, error: std::io::Error },
    #[error("{0} is not empty: a fleet makes new keys, so it needs a new folder")]
    Full(PathBuf),
    #[error(transparent)]
    Key(#[from] KeyError),
    #[error(transparent)]
    Roster(#[from] RosterError),
    #[error(transparent)]
    Values(#[from] RunError),
    #[error("no free port on 127.0.0.1: {0}")]
    Port(std::io::Error),
    #[error("a configuration cannot be written: {0}")]
    Config(#[from] toml::ser::Error),
    #[error("process {name} cannot be started: {error}")]
    Start { name: String, error: std::io::Error },
}

/// A process and how it fares.
struct Process {
    name: String,
    arguments: Vec<String>,
    child: Option<Child>,
    state: &'static str,
}

/// Everything that a fleet has on disk and as processes. What is left running is ended when it is dropped.
pub struct Camp {
    folder: PathBuf,
    temporary: bool,
    roster: Arc<Roster>,
    plant: SigningKey,
    endpoint: String,
    router: Process,
    robots: Vec<Process>,
    /// How many processes ended that nobody ended.
    died: u64,
}

/// What all keys of a fleet begin with.
const PREFIX: &str = "closeranks/fleet";

impl Camp {
    /// Makes keys, the roster and configurations in `folder`, or in a folder that is thrown away.
    pub fn build(file: &FleetScenario, folder: Option<PathBuf>) -> Result<Self, CampError> {
        let temporary = folder.is_none();
        let folder = folder
            .unwrap_or_else(|| std::env::temp_dir().join(format!("closeranks-fleet-{}", std::process::id())));
        let failed = |path: &Path| {
            let path = path.to_owned();
            move |error| CampError::File { path, error }
        };
        fs::create_dir_all(&folder).map_err(failed(&folder))?;
        if fs::read_dir(&folder).map_err(failed(&folder))?.next().is_some() {
            return Err(CampError::Full(folder));
        }
        let port =
            TcpListener::bind("127.0.0.1:0").and_then(|it| it.local_addr()).map_err(CampError::Port)?.port();
        let endpoint = format!("tcp/127.0.0.1:{port}");
        let path = folder.join("scenario.toml");
        fs::write(&path, &file.text).map_err(failed(&path))?;
        let (roster, plant, operator) = enlist(&file.scenario, &file.text, &folder)?;
        let robots = configure(file, &roster, &operator, &folder, &endpoint)?;
        let arguments = ["relay", "--listen", &endpoint, "--prefix", PREFIX, "--scenario", "scenario.toml"];
        let router = Process::new("router".into(), arguments.map(String::from).to_vec());
        Ok(Self { folder, temporary, roster, plant, endpoint, router, robots, died: 0 })
    }

    /// Starts the router and every robot.
    pub fn start_all(&mut self) -> Result<(), CampError> {
        self.router.start(&self.folder)?;
        self.robots.iter_mut().try_for_each(|robot| robot.start(&self.folder))
    }

    /// The network as a process of the fleet has it.
    #[must_use]
    pub fn network(&self, mode: &str) -> Network {
        network(&self.endpoint, mode)
    }

    /// The roster.
    #[must_use]
    pub fn roster(&self) -> Arc<Roster> {
        Arc::clone(&self.roster)
    }

    /// The key of the plant.
    #[must_use]
    pub fn plant_key(&self) -> SigningKey {
        self.plant.clone()
    }

    /// Ends a robot at once, as `kill -9` does.
    pub fn kill(&mut self, id: u16) {
        if let Some(robot) = self.robots.get_mut(usize::from(id).wrapping_sub(1)) {
            robot.end("killed");
        }
    }

    /// Starts a robot again.
    pub fn revive(&mut self, id: u16) {
        let folder = self.folder.clone();
        if let Some(robot) = self.robots.get_mut(usize::from(id).wrapping_sub(1)) {
            robot.again(&folder);
        }
    }

    /// Ends the router and starts it again.
    pub fn restart_router(&mut self) {
        self.router.end("killed");
        let folder = self.folder.clone();
        self.router.again(&folder);
    }

    /// Looks for processes that ended although nobody ended them.
    pub fn notice_deaths(&mut self) {
        for process in self.robots.iter_mut().chain([&mut self.router]) {
            let ended = process.child.as_mut().is_some_and(|child| !matches!(child.try_wait(), Ok(None)));
            if ended {
                process.child = None;
                process.state = "died";
                self.died += 1;
            }
        }
    }

    /// How many processes ended although nobody ended them.
    #[must_use]
    pub fn died(&self) -> u64 {
        self.died
    }

    /// How each robot fares.
    #[must_use]
    pub fn states(&self) -> Vec<&'static str> {
        self.robots.iter().map(|robot| robot.state).collect()
    }

    /// The most memory that a robot holds, kB, as the system says.
    #[must_use]
    pub fn memory_kb(&self) -> u64 {
        let children = self.robots.iter().filter_map(|robot| robot.child.as_ref());
        children.filter_map(|child| resident_kb(child.id())).max().unwrap_or(0)
    }

    /// The CPU time of each robot since its process began, s; none of one that does not run.
    #[must_use]
    pub fn cpu_s(&self) -> Vec<Option<f64>> {
        self.robots.iter().map(|robot| robot.child.as_ref().and_then(|child| cpu_s(child.id()))).collect()
    }

    /// Which robots are proved two-faced.
    #[must_use]
    pub fn proofs(&self) -> Vec<u16> {
        let found = |id: &u16| {
            let file = format!("robot-{id}.proof");
            self.roster
                .robots()
                .iter()
                .any(|entry| self.folder.join("proofs").join(&entry.name).join(&file).exists())
        };
        self.roster.robots().iter().map(|entry| entry.id).filter(found).collect()
    }

    /// Asks every process to stop, and ends those that do not.
    pub fn stop_all(&mut self) {
        for process in self.robots.iter_mut().chain([&mut self.router]) {
            process.ask();
        }
        let polls = GRACE.as_millis() / 20;
        for _ in 0..polls {
            let running = self.robots.iter_mut().chain([&mut self.router]).any(Process::runs);
            if !running {
                break;
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        for process in self.robots.iter_mut().chain([&mut self.router]) {
            process.end("stopped");
        }
    }
}

impl Drop for Camp {
    fn drop(&mut self) {
        self.stop_all();
        if self.temporary {
            // Nothing depends on it.
            let _ = fs::remove_dir_all(&self.folder);
        }
    }
}

impl Process {
    fn new(name: String, arguments: Vec<String>) -> Self {
        Self { name, arguments, child: None, state: "not started" }
    }

    fn start(&mut self, folder: &Path) -> Result<(), CampError> {
        let failed = |error| CampError::Start { name: self.name.clone(), error };
        let program = std::env::current_exe().map_err(failed)?;
        let log = folder.join(format!("{}.log", self.name));
        let log = fs::OpenOptions::new().create(true).append(true).open(log).map_err(failed)?;
        let child = Command::new(program)
            .args(&self.arguments)
            .current_dir(folder)
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(log)
            .spawn()
            .map_err(failed)?;
        self.child = Some(child);
        self.state = "runs";
        Ok(())
    }

    fn again(&mut self, folder: &Path) {
        if self.child.is_none() && self.start(folder).is_err() {
            self.state = "cannot start";
        }
    }

    fn runs(&mut self) -> bool {
        self.child.as_mut().is_some_and(|child| matches!(child.try_wait(), Ok(None)))
    }

    fn ask(&mut self) {
        if let Some(child) = self.child.as_ref()
            && let Ok(pid) = i32::try_from(child.id())
        {
            // It may have ended by itself.
            let _ = kill(Pid::from_raw(pid), Signal::SIGTERM);
        }
    }

    fn end(&mut self, state: &'static str) {
        if let Some(mut child) = self.child.take() {
            let _ = child.kill();
            let _ = child.wait();
            self.state = state;
        }
    }
}

fn network(endpoint: &str, mode: &str) -> Network {
    Network {
        mode: mode.into(),
        connect: vec![endpoint.into()],
        prefix: PREFIX.into(),
        hear: Hear::Relayed,
        ..Network::default()
    }
}

/// Makes keys and the signed roster; also the operator's public key as text.
fn enlist(
    scenario: &Scenario,
    text: &str,
    folder: &Path,
) -> Result<(Arc<Roster>, SigningKey, String), CampError> {
    let operator = keys::create(&folder.join("operator.key"))?;
    let plant = keys::create(&folder.join("plant.key"))?;
    let mut robots = Vec::new();
    for id in 1..=scenario.team.robots {
        let name = format!("robot_{id}");
        let key = keys::create(&folder.join(format!("{name}.key")))?;
        robots.push(Entry { id, name, key: hex(key.verifying_key().as_bytes()) });
    }
    let draft = Draft {
        name: "fleet".into(),
        parameters: parameters::extract(text).map_err(RosterError::from)?,
        plant: Some(hex(plant.verifying_key().as_bytes())),
        robots,
    };
    let path = folder.join("roster.toml");
    let signed = draft.sign(&operator)?;
    fs::write(&path, &signed).map_err(|error| CampError::File { path, error })?;
    let roster = Roster::read(&signed, Some(&operator.verifying_key()))?;
    Ok((Arc::new(roster), plant, hex(operator.verifying_key().as_bytes())))
}

/// Writes the configuration of every robot and says how each is started.
fn configure(
    file: &FleetScenario,
    roster: &Roster,
    operator: &str,
    folder: &Path,
    endpoint: &str,
) -> Result<Vec<Process>, CampError> {
    let scenario = &file.scenario;
    let values = initial_values(scenario)?;
    let mut processes = Vec::new();
    for (entry, value) in roster.robots().iter().zip(values) {
        let config = Config {
            robot: entry.name.clone(),
            roster: "roster.toml".into(),
            operator: operator.into(),
            key: format!("{}.key", entry.name).into(),
            epoch: format!("{}.epoch", entry.name).into(),
            value,
            proofs: Path::new("proofs").join(&entry.name),
            distrust: Vec::new(),
            trust_key: false,
            source_timeout_s: 0.5,
            clock: crate::clock::Kind::Machine,
            network: network(endpoint, "client"),
            plant: Plant::Simulated,
            desired: Desired::Scenario { file: "scenario.toml".into() },
            file: None,
        };
        let write = |name: &str, text: String| {
            let path = folder.join(name);
            fs::write(&path, text).map_err(|error| CampError::File { path, error })
        };
        let own = format!("{}.toml", entry.name);
        write(&own, toml::to_string(&config)?)?;
        let mut arguments = vec!["run".to_owned(), "--config".into(), own];
        if scenario.malicious.contains(&entry.id) {
            let lies = format!("{}_lies.toml", entry.name);
            write(&lies, file.text_of(entry.id))?;
            arguments[0] = "liar".into();
            arguments.extend(["--scenario".into(), lies]);
        }
        processes.push(Process::new(entry.name.clone(), arguments));
    }
    Ok(processes)
}

/// CPU time that a process has used, s. The system counts in hundredths of a second.
fn cpu_s(pid: u32) -> Option<f64> {
    let text = fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    // What stands before is the name of the program in brackets.
    let (_, rest) = text.rsplit_once(')')?;
    let ticks: Vec<f64> =
        rest.split_whitespace().skip(11).take(2).filter_map(|word| word.parse().ok()).collect();
    Some(ticks.iter().sum::<f64>() / 100.0)
}

/// Memory that a process holds, kB.
fn resident_kb(pid: u32) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{pid}/status")).ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok()
}
