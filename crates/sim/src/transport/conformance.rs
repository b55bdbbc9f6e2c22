//! What every transport must keep as long as nothing is wrong with it. The test runs over the network in memory, and it is
//! meant to run over a real one too.

use closeranks_core::message::MESSAGE_BYTES;

use super::{Bytes, Parcel, Transport};

/// Robots 0 to 4 take part.
const ROBOTS: usize = 5;
/// Ticks of the test.
const TICKS: u32 = 10;
/// Messages from each robot to each other one in a tick.
const EACH: u8 = 3;
/// How often an empty transport is asked again before its parcels count as lost.
const PATIENCE: u32 = 1_000;

/// Sends some messages over `transport` and checks that all of them, and nothing else, arrive as they must. `wait` is called
/// whenever nothing has arrived yet: a real network needs some time, a network in memory none.
///
/// # Panics
///
/// If something is lost, changed, doubled, out of order, under another sender's name, or was never sent.
pub fn check_transport(transport: &mut impl Transport, wait: &mut dyn FnMut()) {
    assert_eq!(transport.poll(), None, "nothing was sent yet");
    for tick in 0..TICKS {
        transport.begin_tick(tick);
        let sent = parcels(tick);
        for parcel in &sent {
            assert_eq!(transport.send(parcel.clone()), Ok(()), "{} parcels are not too many", sent.len());
        }
        let arrived = collect(transport, sent.len(), wait);
        for sender in 0..ROBOTS {
            for receiver in 0..ROBOTS {
                let of = |parcels: &[Parcel]| between(parcels, sender, receiver);
                assert_eq!(of(&arrived), of(&sent), "from {sender} to {receiver} in tick {tick}");
            }
        }
        assert_eq!(arrived.len(), sent.len(), "nothing else arrives in tick {tick}");
    }
    transport.begin_tick(TICKS);
    wait();
    assert_eq!(transport.poll(), None, "nothing comes twice");
}

/// What is sent in a tick: every message differs from every other one.
fn parcels(tick: u32) -> Vec<Parcel> {
    let mut parcels = Vec::new();
    for number in 0..EACH {
        for sender in 0..ROBOTS {
            for receiver in (0..ROBOTS).filter(|receiver| *receiver != sender) {
                let mut bytes = [number; MESSAGE_BYTES];
                bytes[..4].copy_from_slice(&tick.to_le_bytes());
                bytes[4..6]
                    .copy_from_slice(&[sender, receiver].map(|robot| u8::try_from(robot).unwrap_or(0)));
                parcels.push(Parcel { sender, receiver, bytes: bytes.into() });
            }
        }
    }
    parcels
}

/// What arrives until there are `count` parcels, and whatever comes with them.
fn collect(transport: &mut impl Transport, count: usize, wait: &mut dyn FnMut()) -> Vec<Parcel> {
    let mut arrived = Vec::new();
    for _ in 0..PATIENCE {
        arrived.extend(core::iter::from_fn(|| transport.poll()).take(2 * count));
        if arrived.len() >= count {
            break;
        }
        wait();
    }
    arrived
}

fn between(parcels: &[Parcel], sender: usize, receiver: usize) -> Vec<Bytes> {
    let pair = parcels.iter().filter(|parcel| (parcel.sender, parcel.receiver) == (sender, receiver));
    pair.map(|parcel| parcel.bytes.clone()).collect()
}
