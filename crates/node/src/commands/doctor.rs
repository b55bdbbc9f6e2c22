//! `doctor`: goes through everything that a robot needs, one step after another, and says which one fails.

use core::time::Duration;
use std::net::{TcpStream, ToSocketAddrs as _};
use std::path::Path;
use std::sync::mpsc::sync_channel;

use crate::clock::Clock;
use crate::commands::Failure;
use crate::config::{Config, Network, Plant};
use crate::identity::keys;
use crate::identity::roster::Roster;
use crate::node::load_roster;
use crate::session::{Net, send};

/// How long a session may take to open, ms.
const SESSION_MS: u32 = 5_000;
/// How long an endpoint may take to answer.
const REACH: Duration = Duration::from_secs(2);
/// How long a message may need to come back.
const PATIENCE: Duration = Duration::from_secs(5);

/// Looks at the robot of a configuration. Nothing is changed: the number of its starts stays as it is.
pub fn doctor(path: &Path, say: &mut dyn FnMut(&str)) -> Result<(), Failure> {
    let mut step = |name: &str, found: Result<String, Failure>| match found {
        Ok(found) => {
            say(&format!("ok    {name}: {found}"));
            Ok(())
        }
        Err(error) => {
            say(&format!("FAILS {name}: {error}"));
            Err(Failure::from(format!("{name} fails: {error}")))
        }
    };
    let config = Config::load(path);
    step(
        "configuration",
        config.as_ref().map(|_| path.display().to_string()).map_err(|error| error.to_string().into()),
    )?;
    let config = config?;
    let roster = load_roster(&config);
    let text = |error: &crate::node::NodeError| Failure::from(error.to_string());
    step(
        "roster",
        roster
            .as_ref()
            .map(|it| format!("{}, {} robots, the signature fits", it.name(), it.robots().len()))
            .map_err(text),
    )?;
    let roster = roster?;
    let id = roster.find(&config.robot);
    step(
        "name",
        id.map(|id| format!("{} is robot {}", config.robot, id.0))
            .ok_or_else(|| format!("no robot of the roster is called `{}`", config.robot).into()),
    )?;
    step("private key", private_key(&config, &roster))?;
    let plant = config.plant != Plant::Simulated || roster.plant().is_some();
    step(
        "plant",
        if plant { Ok("can be believed".into()) } else { Err("the roster has no key of a plant".into()) },
    )?;
    for endpoint in &config.network.connect {
        step(&format!("endpoint {endpoint}"), reach(endpoint))?;
    }
    let clock = Clock::start(config.clock);
    let net = Net::open_within(&config.network, &config.network.mode, Some(SESSION_MS));
    step(
        "session",
        net.as_ref()
            .map(|_| format!("{} with {:?}", config.network.mode, config.network.connect))
            .map_err(|error| error.to_string().into()),
    )?;
    let net = net?;
    let key = format!("doctor/{}", id.map_or(0, |id| id.0));
    let back = echo(&config, &net, &key, clock);
    step("one message through the network and back", back)?;
    net.close();
    Ok(())
}

fn private_key(config: &Config, roster: &Roster) -> Result<String, Failure> {
    let key = keys::load(&config.key)?.verifying_key();
    if roster.find(&config.robot).and_then(|id| roster.key(id)) != Some(&key) {
        return Err("is not the one in the roster".into());
    }
    Ok("is that of the roster, and only its owner can read it".into())
}

/// Whether somebody listens at an endpoint. Zenoh would try again for ever.
fn reach(endpoint: &str) -> Result<String, Failure> {
    let place = endpoint.split_once('/').map_or(endpoint, |(_, place)| place);
    let place = place.split(['?', '#']).next().unwrap_or(place);
    let found: Vec<_> = place.to_socket_addrs().map_err(|error| format!("`{place}`: {error}"))?.collect();
    let mut why = "no address".to_owned();
    for address in found {
        match TcpStream::connect_timeout(&address, REACH) {
            Ok(_) => return Ok("somebody listens".into()),
            Err(error) => why = error.to_string(),
        }
    }
    Err(format!(
        "nobody listens there ({why}): is it running, is the address right, is a firewall in between?"
    )
    .into())
}

/// Publishes on one session and listens with another one, which connects as the robot does and to the robot's own endpoints.
fn echo(config: &Config, net: &Net, key: &str, clock: Clock) -> Result<String, Failure> {
    let own = config.network.listen.iter().map(|endpoint| endpoint.replace("/0.0.0.0:", "/127.0.0.1:"));
    let connect = config.network.connect.iter().cloned().chain(own).collect();
    let network = Network { listen: Vec::new(), connect, ..config.network.clone() };
    let other = Net::open_within(&network, &network.mode, Some(SESSION_MS))?;
    let (queue, heard) = sync_channel(1);
    let _ear = other.listen(key, queue, |_, bytes| Some(bytes))?;
    let out = net.out(key)?;
    let began = clock.now();
    while clock.now().since(began) < PATIENCE {
        let sent = clock.now();
        send(&out, sent.as_nanos().to_le_bytes().to_vec());
        if let Ok(bytes) = heard.recv_timeout(Duration::from_millis(200))
            && bytes.len() == 8
        {
            return Ok(format!("{:.1} ms", clock.now().since(sent).as_secs_f64() * 1_000.0));
        }
    }
    let hint = if config.network.mode == "peer" {
        "a peer needs an endpoint in `network.listen`, or one in `network.connect` at which a router listens"
    } else {
        "is a router running at the endpoints of `network.connect`?"
    };
    Err(format!("nothing came back within {} s; {hint}", PATIENCE.as_secs()).into())
}
