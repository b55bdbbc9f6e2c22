//! `doctor`: goes through everything that a robot needs, one step after another, and says which one fails.

use core::time::Duration;
use std::path::Path;
use std::sync::mpsc::sync_channel;

use crate::clock::Clock;
use crate::commands::Failure;
use crate::config::{Config, Plant};
use crate::identity::keys;
use crate::identity::roster::Roster;
use crate::node::load_roster;
use crate::session::{Net, send};

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
    let clock = Clock::start(config.clock);
    let net = Net::open(&config.network, &config.network.mode);
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

/// Publishes on one session and listens with another one.
fn echo(config: &Config, net: &Net, key: &str, clock: Clock) -> Result<String, Failure> {
    let other = Net::open(
        &crate::config::Network { listen: Vec::new(), ..config.network.clone() },
        &config.network.mode,
    )?;
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
        "two peers hear each other only if one lists the other in `network.connect`"
    } else {
        "is a router running at the endpoints of `network.connect`?"
    };
    Err(format!("nothing came back within {} s; {hint}", PATIENCE.as_secs()).into())
}
