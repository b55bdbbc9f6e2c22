//! The only file that knows Zenoh: sessions with explicit endpoints, keys, and bytes in and out.
//!
//! Multicast and gossip are off, so what is connected is what the configuration says. Everything is published to be dropped when
//! a link is full and not to wait, because an old message is worth less than the next one.

use core::sync::atomic::{AtomicU64, Ordering};
use std::sync::Arc;
use std::sync::mpsc::{SyncSender, TrySendError};

use zenoh::bytes::ZBytes;
use zenoh::pubsub::{Publisher, Subscriber};
use zenoh::qos::{CongestionControl, Priority};
use zenoh::{Session, Wait as _};

use crate::config::Network;
use crate::wire::envelope::ENVELOPE_MAX;
use crate::wire::proof::PROOF_MAX;

/// Nothing longer is handed on to a robot.
const BYTES_MAX: usize = if ENVELOPE_MAX > PROOF_MAX { ENVELOPE_MAX } else { PROOF_MAX };

/// So many tokens are looked at.
const TOKENS_MAX: usize = 10_000;

/// Why there is no session.
#[derive(Debug, thiserror::Error)]
pub enum SessionError {
    /// A field of the configuration is wrong.
    #[error("`network.{field}` is {value}: {error}")]
    Config {
        /// Which field.
        field: &'static str,
        /// What it is.
        value: String,
        /// What Zenoh says.
        error: String,
    },
    /// Zenoh cannot be opened.
    #[error("no session of Zenoh with listen {listen:?} and connect {connect:?}: {error}")]
    Open {
        /// Endpoints to listen at.
        listen: Vec<String>,
        /// Endpoints to connect to.
        connect: Vec<String>,
        /// What Zenoh says.
        error: String,
    },
    /// A key cannot be used.
    #[error("key `{key}`: {error}")]
    Key {
        /// Which key.
        key: String,
        /// What Zenoh says.
        error: String,
    },
}

/// A session, and how many arrivals had to be dropped because their receiver was too slow, or that were too long.
pub struct Net {
    session: Session,
    prefix: String,
    dropped: Arc<AtomicU64>,
    sent: Arc<Meter>,
    heard: Arc<Meter>,
}

/// How much went through a session: messages and bytes of payloads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Traffic {
    /// Messages and bytes that were sent.
    pub sent: [u64; 2],
    /// Messages and bytes that were heard.
    pub heard: [u64; 2],
}

#[derive(Default)]
struct Meter([AtomicU64; 2]);

impl Meter {
    fn add(&self, bytes: usize) {
        self.0[0].fetch_add(1, Ordering::Relaxed);
        self.0[1].fetch_add(u64::try_from(bytes).unwrap_or(0), Ordering::Relaxed);
    }

    fn read(&self) -> [u64; 2] {
        self.0.each_ref().map(|count| count.load(Ordering::Relaxed))
    }
}

/// A key to publish on.
pub struct Out {
    publisher: Publisher<'static>,
    meter: Arc<Meter>,
}
/// Shows that something is there until it is dropped.
pub type Token = zenoh::liveliness::LivelinessToken;
/// Listens until it is dropped.
pub type Ear = Subscriber<()>;

impl Net {
    /// Opens a session in this `mode`: `peer`, `client` or `router`. Whoever cannot be reached yet is tried again until it can.
    pub fn open(network: &Network, mode: &str) -> Result<Self, SessionError> {
        Self::open_within(network, mode, None)
    }

    /// As [`open`](Self::open), but fails if nobody can be reached within so many ms.
    pub fn open_within(network: &Network, mode: &str, most_ms: Option<u32>) -> Result<Self, SessionError> {
        let config = configuration(network, mode, most_ms)?;
        let session = zenoh::open(config).wait().map_err(|error| SessionError::Open {
            listen: network.listen.clone(),
            connect: network.connect.clone(),
            error: error.to_string(),
        })?;
        let prefix = network.prefix.clone();
        Ok(Self { session, prefix, dropped: Arc::default(), sent: Arc::default(), heard: Arc::default() })
    }

    /// Refuses what no session can be opened with, without opening one.
    pub fn check(network: &Network, mode: &str) -> Result<(), SessionError> {
        configuration(network, mode, None).map(|_| ())
    }

    /// The tokens that are there on these keys, or as many of them as come within `most`.
    pub fn tokens(&self, keys: &str, most: core::time::Duration) -> Result<Vec<String>, SessionError> {
        let asked = self.session.liveliness().get(keys).timeout(most).wait();
        let answers =
            asked.map_err(|error| SessionError::Key { key: keys.into(), error: error.to_string() })?;
        let mut found = Vec::new();
        while let Ok(answer) = answers.recv() {
            if let Ok(sample) = answer.result()
                && found.len() < TOKENS_MAX
            {
                found.push(sample.key_expr().as_str().to_owned());
            }
        }
        Ok(found)
    }

    /// A key of the team, to publish on.
    pub fn out(&self, key: &str) -> Result<Out, SessionError> {
        self.out_at(format!("{}/{key}", self.prefix))
    }

    /// Any key, to publish on.
    pub fn out_at(&self, key: String) -> Result<Out, SessionError> {
        let declared = self
            .session
            .declare_publisher(key.clone())
            .congestion_control(CongestionControl::Drop)
            .priority(Priority::RealTime)
            .express(true)
            .wait();
        let publisher = declared.map_err(|error| SessionError::Key { key, error: error.to_string() })?;
        Ok(Out { publisher, meter: Arc::clone(&self.sent) })
    }

    /// Hands what arrives on keys of the team on to `queue`, with the key after the prefix. When the queue is full, it is dropped
    /// and counted.
    pub fn listen<E: Send + 'static>(
        &self,
        key: &str,
        queue: SyncSender<E>,
        event: impl Fn(&str, Vec<u8>) -> Option<E> + Send + Sync + 'static,
    ) -> Result<Ear, SessionError> {
        self.listen_at(format!("{}/{key}", self.prefix), self.prefix.len() + 1, queue, event)
    }

    /// As [`listen`](Self::listen), on any key; the event is made of the key from byte `start` on.
    pub fn listen_at<E: Send + 'static>(
        &self,
        key: String,
        start: usize,
        queue: SyncSender<E>,
        event: impl Fn(&str, Vec<u8>) -> Option<E> + Send + Sync + 'static,
    ) -> Result<Ear, SessionError> {
        let (dropped, heard) = (Arc::clone(&self.dropped), Arc::clone(&self.heard));
        let arrived = move |sample: zenoh::sample::Sample| {
            heard.add(sample.payload().len());
            let rest = sample.key_expr().as_str().get(start..).unwrap_or_default();
            let long = sample.payload().len() > BYTES_MAX;
            let made = if long { None } else { event(rest, sample.payload().to_bytes().into_owned()) };
            let full = made.is_some_and(|made| matches!(queue.try_send(made), Err(TrySendError::Full(_))));
            if long || full {
                dropped.fetch_add(1, Ordering::Relaxed);
            }
        };
        let declared = self.session.declare_subscriber(key.clone()).callback(arrived).wait();
        declared.map_err(|error| SessionError::Key { key, error: error.to_string() })
    }

    /// The name of this session, which the tokens of ROS 2 begin with.
    #[must_use]
    pub fn name(&self) -> String {
        self.session.zid().to_string()
    }

    /// Shows a token to whoever lists what there is, until it is dropped.
    pub fn token(&self, key: String) -> Result<Token, SessionError> {
        let declared = self.session.liveliness().declare_token(key.clone()).wait();
        declared.map_err(|error| SessionError::Key { key, error: error.to_string() })
    }

    /// How many arrivals were dropped.
    #[must_use]
    pub fn dropped(&self) -> u64 {
        self.dropped.load(Ordering::Relaxed)
    }

    /// How much went through it.
    #[must_use]
    pub fn traffic(&self) -> Traffic {
        Traffic { sent: self.sent.read(), heard: self.heard.read() }
    }

    /// Ends the session.
    pub fn close(self) {
        // There is nothing to be done about a session that does not end well.
        let _ = self.session.close().wait();
    }
}

/// The configuration of a session.
fn configuration(network: &Network, mode: &str, most_ms: Option<u32>) -> Result<zenoh::Config, SessionError> {
    let mut config = match &network.zenoh {
        None => zenoh::Config::default(),
        Some(path) => zenoh::Config::from_file(path).map_err(|error| SessionError::Config {
            field: "zenoh",
            value: path.display().to_string(),
            error: error.to_string(),
        })?,
    };
    let list = |endpoints: &[String]| serde_json::to_string(endpoints).unwrap_or_default();
    let fields = [
        ("mode", "mode", format!("\"{mode}\"")),
        ("listen", "listen/endpoints", list(&network.listen)),
        ("connect", "connect/endpoints", list(&network.connect)),
        ("connect", "connect/timeout_ms", most_ms.map_or("-1".into(), |most| most.to_string())),
        ("connect", "connect/exit_on_failure", most_ms.is_some().to_string()),
        (
            "connect",
            "connect/retry",
            "{period_init_ms: 200, period_max_ms: 2000, period_increase_factor: 2}".into(),
        ),
        ("mode", "scouting/multicast/enabled", "false".into()),
        ("mode", "scouting/gossip/enabled", "false".into()),
    ];
    for (field, key, value) in fields {
        config.insert_json5(key, &value).map_err(|error| SessionError::Config {
            field,
            value,
            error: error.to_string(),
        })?;
    }
    Ok(config)
}

/// Publishes; what cannot be sent now is lost, as messages are.
pub fn send(out: &Out, bytes: Vec<u8>) {
    out.meter.add(bytes.len());
    let _ = out.publisher.put(ZBytes::from(bytes)).wait();
}

/// As [`send`], with an attachment.
pub fn send_with(out: &Out, bytes: Vec<u8>, attachment: &[u8]) {
    out.meter.add(bytes.len() + attachment.len());
    let _ = out.publisher.put(ZBytes::from(bytes)).attachment(attachment.to_vec()).wait();
}

/// The last part of a key as the number of a robot.
#[must_use]
pub fn number(key: &str) -> Option<u16> {
    key.rsplit('/').next()?.parse().ok()
}
