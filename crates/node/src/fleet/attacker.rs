//! An outsider without any key, on the same network: it puts garbage, changed copies and old messages on every key of the team.

use core::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use core::time::Duration;
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::sync_channel;
use std::thread::JoinHandle;

use closeranks_sim::random::{Random, Stream};
use closeranks_sim::scenario::Scenario;

use crate::config::Network;
use crate::session::{Net, Out, SessionError, send};

/// How many messages it keeps to play them again.
const KEPT: usize = 500;

/// A thread that attacks until it is told to stop.
pub struct Attacker {
    stop: Arc<AtomicBool>,
    injected: Arc<AtomicU64>,
    thread: Option<JoinHandle<()>>,
}

impl Attacker {
    /// Begins to put so many messages a second on the keys of the team of `scenario`; nobody if there are none.
    pub fn start(network: &Network, scenario: &Scenario, per_s: f64) -> Result<Option<Self>, SessionError> {
        if per_s <= 0.0 {
            return Ok(None);
        }
        let net = Net::open(network, &network.mode)?;
        let robots = scenario.team.robots;
        let mut outs = Vec::new();
        for id in 1..=robots {
            for kind in ["say", "sensed", "report", "evidence", "proof"] {
                outs.push(net.out(&format!("{kind}/{id}"))?);
            }
            let other = id % robots + 1;
            outs.push(net.out(&format!("to/{id}/{other}"))?);
            outs.push(net.out(&format!("aside/{id}/{other}"))?);
        }
        let (queue, heard) = sync_channel(KEPT);
        let ear = net.listen("**", queue, |_, bytes| Some(bytes))?;
        let (stop, injected) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicU64::new(0)));
        let (ended, count) = (Arc::clone(&stop), Arc::clone(&injected));
        let mut random = Random::new(scenario.seed, Stream::Faces);
        let pause = Duration::from_secs_f64((1.0 / per_s).max(0.0001));
        let thread = std::thread::spawn(move || {
            let mut kept: VecDeque<Vec<u8>> = VecDeque::new();
            while !ended.load(Ordering::Relaxed) {
                while let Ok(bytes) = heard.try_recv() {
                    if kept.len() >= KEPT {
                        kept.pop_front();
                    }
                    kept.push_back(bytes);
                }
                attack(&mut random, &kept, &outs);
                count.fetch_add(1, Ordering::Relaxed);
                std::thread::sleep(pause);
            }
            drop(ear);
            net.close();
        });
        Ok(Some(Self { stop, injected, thread: Some(thread) }))
    }

    /// Ends the attack, and says how many messages it put.
    #[must_use]
    pub fn stop(mut self) -> u64 {
        self.stop.store(true, Ordering::Relaxed);
        if let Some(thread) = self.thread.take() {
            // A thread that panicked has stopped as well.
            let _ = thread.join();
        }
        self.injected.load(Ordering::Relaxed)
    }
}

/// Puts one message on one key: noise, an old message as it was, or one with a changed byte.
fn attack(random: &mut Random, kept: &VecDeque<Vec<u8>>, outs: &[Out]) {
    let mut below = |count: usize| {
        let count = u64::try_from(count.max(1)).unwrap_or(1);
        usize::try_from(random.below(count)).unwrap_or(0)
    };
    let kind = below(3);
    let old = kept.get(below(kept.len())).cloned();
    let mut bytes = match old {
        Some(old) if kind > 0 => old,
        _ => (0..below(600)).map(|_| u8::try_from(below(256)).unwrap_or(0)).collect(),
    };
    if kind == 2 && !bytes.is_empty() {
        let at = below(bytes.len());
        bytes[at] ^= 1_u8 << below(8);
    }
    if let Some(out) = outs.get(below(outs.len())) {
        send(out, bytes);
    }
}
