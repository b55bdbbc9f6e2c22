//! Single robots as their users run them: what `doctor` says, and endpoints that change while a robot runs.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use core::time::Duration;
use std::fs;
use std::net::TcpListener;
use std::path::Path;
use std::process::{Child, Command, Stdio};

use closeranks_node::clock::{Clock, Kind};
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

const TEAM: &str = "duration_s = 3.0\n[team]\nrobots = 2\nfaults = 0\nmalicious = []\n[controller]\nkind = 'budget'\n\
    [start]\nkind = 'hexagon'\n[clock]\ntau_1_s = 0.2\ntau_2_s = 0.8\n";
const PATIENCE: Duration = Duration::from_secs(90);

fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_closeranks-node"));
    command.args(arguments).current_dir(folder);
    command
}

/// What the program says, and its exit code.
fn said(folder: &Path, arguments: &[&str]) -> (String, Option<i32>) {
    let output = program(folder, arguments).output().unwrap();
    let texts = [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    (texts.concat(), output.status.code())
}

/// Two robots, a plant and their signed roster in the folder `team`; the operator's public key.
fn team(folder: &Path) -> String {
    fs::write(folder.join("team.toml"), TEAM).unwrap();
    let good = |arguments: &[&str]| {
        let (text, code) = said(folder, arguments);
        assert_eq!(code, Some(0), "{text}");
        text
    };
    let made = good(&["roster", "new", "team", "--parameters", "team.toml"]);
    for name in ["robot_1", "robot_2", "plant"] {
        good(&["roster", "add", "team", name]);
    }
    good(&["roster", "sign", "team"]);
    made.split_whitespace().nth(1).unwrap().to_owned()
}

/// Writes the file of a robot.
fn configure(folder: &Path, operator: &str, robot: u16, network: &str, more: &str) {
    let text = format!(
        "robot = 'robot_{robot}'\nroster = 'team/roster.toml'\noperator = '{operator}'\nkey = 'team/robot_{robot}.key'\n\
         epoch = 'robot_{robot}.epoch'\nclock = 'machine'\n{more}\n[network]\n{network}\n"
    );
    fs::write(folder.join(format!("robot_{robot}.toml")), text).unwrap();
}

fn port() -> u16 {
    TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port()
}

#[test]
fn doctor_names_the_step_that_fails() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let operator = team(at);
    let fails = |step: &str, why: &str| {
        let (text, code) = said(at, &["doctor", "--config", "robot_1.toml"]);
        assert_eq!(code, Some(2), "{text}");
        assert!(text.contains(&format!("FAILS {step}")) && text.contains(why), "{step}: {text}");
    };
    fails("configuration", "No such file");
    configure(at, &"00".repeat(32), 1, "", "");
    fails("roster", "");
    configure(at, &operator, 1, "", "");
    let file = at.join("robot_1.toml");
    let text = fs::read_to_string(&file).unwrap();
    fs::write(&file, text.replace("robot = 'robot_1'", "robot = 'robot_7'")).unwrap();
    fails("name", "`robot_7`");
    fs::write(&file, text.replace("team/robot_1.key", "team/robot_2.key")).unwrap();
    fails("private key", "is not the one in the roster");
    configure(at, &operator, 1, "mode = 'client'\nconnect = ['tcp/127.0.0.1:1']", "");
    fails("endpoint tcp/127.0.0.1:1", "nobody listens there");
    configure(at, &operator, 1, "", "");
    fails("one message through the network and back", "a peer needs an endpoint");
    configure(at, &operator, 1, &format!("listen = ['tcp/127.0.0.1:{}']", port()), "");
    let (text, code) = said(at, &["doctor", "--config", "robot_1.toml"]);
    assert_eq!((code, text.matches("ok    ").count()), (Some(0), 7), "{text}");
    assert!(!at.join("robot_1.epoch").exists(), "no start was counted");
}

/// Ends with the test, whatever becomes of it.
struct Process(Child);

impl Process {
    fn start(folder: &Path, log: &str, arguments: &[&str]) -> Self {
        let log = fs::File::create(folder.join(log)).unwrap();
        let mut command = program(folder, arguments);
        Self(command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(log).spawn().unwrap())
    }

    /// Its exit code, once it has ended by itself.
    fn code(&mut self) -> Option<i32> {
        let clock = Clock::start(Kind::Machine);
        let began = clock.now();
        while clock.now().since(began) < PATIENCE {
            if let Some(status) = self.0.try_wait().unwrap() {
                return status.code();
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        panic!("the process did not end");
    }

    fn ask_to_stop(&mut self) -> Option<i32> {
        kill(Pid::from_raw(i32::try_from(self.0.id()).unwrap()), Signal::SIGTERM).unwrap();
        self.code()
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // It may have ended already.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Peers, without a router: the plant waits for both robots, and robot 2 is told of its endpoint only while it runs.
#[test]
fn endpoints_are_read_anew_without_a_restart() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    let operator = team(at);
    let [plant_at, first_at] = [port(), port()].map(|port| format!("tcp/127.0.0.1:{port}"));
    let desired = "[desired]\nsource = 'scenario'\nfile = 'team.toml'";
    configure(at, &operator, 1, &format!("listen = ['{first_at}']\nconnect = ['{plant_at}']"), desired);
    configure(at, &operator, 2, "connect = ['tcp/127.0.0.1:1']", desired);
    let arguments =
        ["plant", "--scenario", "team.toml", "--roster", "team/roster.toml", "--key", "team/plant.key"];
    let arguments = [&arguments[..], &["--one-machine", "--listen", &plant_at]].concat();
    let mut plant = Process::start(at, "plant.log", &arguments);
    let mut robots = [1, 2].map(|robot| {
        let file = format!("robot_{robot}.toml");
        Process::start(at, &format!("robot_{robot}.log"), &["run", "--config", &file])
    });
    std::thread::sleep(Duration::from_secs(3));
    assert!(plant.0.try_wait().unwrap().is_none(), "the plant waits for robot 2");
    configure(at, &operator, 2, &format!("connect = ['{plant_at}', '{first_at}']"), desired);
    let code = plant.code();
    let logs =
        ["plant.log", "robot_1.log", "robot_2.log"].map(|log| fs::read_to_string(at.join(log)).unwrap());
    assert_eq!(code, Some(0), "{logs:?}");
    assert!(logs[2].contains("connected anew"), "{logs:?}");
    for robot in &mut robots {
        assert_eq!(robot.ask_to_stop(), Some(0));
    }
    assert_eq!(fs::read_to_string(at.join("robot_2.epoch")).unwrap().trim(), "1", "it was started once");
}
