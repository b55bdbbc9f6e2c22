//! What one robot costs: a real process of `closeranks-node` among robots that this program plays, at a given rate. It prints the figures
//! that the robot says when it stops.
//!
//!     cargo run --release --example load -- target/release/closeranks-node NEIGHBOURS HZ SECONDS [CONTROLLER]

#![expect(clippy::print_stdout, reason = "what the user asked for")]

use core::error::Error;
use core::time::Duration;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::Arc;

use closeranks_core::RobotId;
use closeranks_node::bytes::hex;
use closeranks_node::clock::{Clock, Kind, tick};
use closeranks_node::config::Network;
use closeranks_node::identity::roster::Roster;
use closeranks_node::identity::{keys, parameters, roster};
use closeranks_node::node::pilot::{Identity, Pilot};
use closeranks_node::plant::world::World;
use closeranks_node::session::{Net, send};
use closeranks_node::wire::envelope::{Letter, Purpose};
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

type Failure = Box<dyn Error>;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, program, neighbors, hz, seconds, rest @ ..] = &arguments[..] else {
        return Err("usage: load PROGRAM NEIGHBOURS HZ SECONDS [CONTROLLER]".into());
    };
    let (neighbors, hz, seconds): (u16, u32, u64) = (neighbors.parse()?, hz.parse()?, seconds.parse()?);
    let controller = rest.first().map_or("budget", String::as_str);
    let folder = std::env::temp_dir().join(format!("closeranks-load-{}", std::process::id()));
    fs::create_dir_all(&folder)?;
    let played = play(Path::new(program), &folder, neighbors + 1, hz, seconds, controller);
    fs::remove_dir_all(&folder)?;
    println!("{controller}, {neighbors} neighbours, {hz} Hz\n{}", played?);
    Ok(())
}

fn play(
    program: &Path,
    folder: &Path,
    robots: u16,
    hz: u32,
    seconds: u64,
    controller: &str,
) -> Result<String, Failure> {
    let tau_s = 1.0 / f64::from(hz);
    let text = format!(
        "[team]\nrobots = {robots}\nfaults = 2\nmalicious = []\n[controller]\nkind = '{controller}'\n[clock]\ntau_1_s = {tau_s}\n\
         tau_2_s = {}\n[start]\nkind = 'hexagon'\nspacing_m = 0.35\n",
        5.0 * tau_s
    );
    let names: Vec<String> =
        (1..=robots).map(|id| format!("robot_{id}")).chain(["plant".to_owned()]).collect();
    let keys: Vec<_> = names
        .iter()
        .map(|name| keys::create(&folder.join(format!("{name}.key"))))
        .collect::<Result<_, _>>()?;
    let public = |index: usize| hex(keys[index].verifying_key().as_bytes());
    let entries = (1..=robots).map(|id| roster::Entry {
        id,
        name: names[usize::from(id) - 1].clone(),
        key: public(usize::from(id) - 1),
    });
    let draft = roster::Draft {
        name: "load".into(),
        parameters: parameters::extract(&text)?,
        plant: Some(public(usize::from(robots))),
        robots: entries.collect(),
    };
    let operator = keys::create(&folder.join("operator.key"))?;
    let signed = draft.sign(&operator)?;
    fs::write(folder.join("roster.toml"), &signed)?;
    let port = std::net::TcpListener::bind("127.0.0.1:0")?.local_addr()?.port();
    let endpoint = format!("tcp/127.0.0.1:{port}");
    let config = format!(
        "robot = 'robot_1'\nroster = 'roster.toml'\noperator = '{}'\nkey = 'robot_1.key'\nepoch = 'epoch'\nclock = 'machine'\n\
         [network]\nconnect = ['{endpoint}']\n",
        hex(operator.verifying_key().as_bytes())
    );
    fs::write(folder.join("robot_1.toml"), config)?;
    let log = folder.join("log");
    let mut child = Command::new(program.canonicalize()?)
        .args(["run", "--config", "robot_1.toml"])
        .current_dir(folder)
        .stdin(Stdio::null())
        .stderr(fs::File::create(&log)?)
        .spawn()?;
    let roster = Arc::new(Roster::read(&signed, None)?);
    let net = Net::open(&Network { listen: vec![endpoint], ..Network::default() }, "peer")?;
    let played = tell(&net, &roster, &text, &keys, Duration::from_secs(seconds));
    kill(Pid::from_raw(i32::try_from(child.id())?), Signal::SIGTERM)?;
    child.wait()?;
    net.close();
    played?;
    let said = fs::read_to_string(&log)?;
    Ok(said.lines().filter(|line| line.starts_with("figures")).collect())
}

/// Plays the plant and all robots but the first; nobody moves.
fn tell(
    net: &Net,
    roster: &Arc<Roster>,
    text: &str,
    keys: &[ed25519_dalek::SigningKey],
    length: Duration,
) -> Result<(), Failure> {
    let scenario = closeranks_sim::parse::scenario(text).map_err(|problems| format!("{problems:?}"))?;
    let params = scenario.params::<2>()?;
    let period = params.settings().clock.level_period;
    let clock = Clock::start(Kind::Machine);
    let mut pilots = Vec::new();
    for entry in &roster.robots()[1..] {
        let (id, key) = (RobotId(entry.id), keys[usize::from(entry.id) - 1].clone());
        let identity = Identity { roster: Arc::clone(roster), id, key, epoch: 1 };
        pilots.push((Pilot::<2>::new(identity, params, 0.0)?, net.out(&format!("say/{}", entry.id))?));
    }
    let plant = keys.last().ok_or("no key of the plant")?;
    let shown = net.out("sensed/1")?;
    let mut at = tick(clock.now().after(Duration::from_secs(1)), period);
    let (end, mut sequence) = (at.after(length), 0);
    while at < end {
        std::thread::sleep(at.since(clock.now()));
        // The looks of a world in which it is this tick, whatever became of the ones before.
        let looks = World::<2>::new(&scenario, Arc::clone(roster), at)?.begin_tick();
        sequence += 1;
        let payload = &looks[0].encode();
        let (purpose, id, sent) = (Purpose::Sensed, RobotId(1), clock.now());
        let letter = Letter { purpose, id, epoch: 1, sequence, sent, payload, echoes: &[] };
        send(&shown, letter.seal(roster.hash(), plant).ok_or("the look is too long")?);
        for ((pilot, out), look) in pilots.iter_mut().zip(&looks[1..]) {
            let Some(message) = pilot.sense(look) else { continue };
            if let Some(bytes) = pilot.encode(&message).and_then(|payload| pilot.say(clock.now(), &payload)) {
                send(out, bytes);
            }
        }
        at = at.after(period).max(tick(clock.now(), period));
    }
    Ok(())
}
