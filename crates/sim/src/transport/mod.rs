//! What carries the bytes of messages from robot to robot.
//!
//! A [`Transport`] is told when a tick begins, takes bytes and gives out what arrived. [`memory::InMemory`] is a queue in
//! memory that delivers at once. Faults wrap it: [`FaultyNetwork`](crate::faults::network::FaultyNetwork) is a transport that
//! holds another one, so that robots and engines cannot tell the two apart:
//!
//! ```
//! use closeranks_sim::faults::network::{FaultyNetwork, Network};
//! use closeranks_sim::transport::memory::InMemory;
//! use closeranks_sim::transport::{Parcel, Transport};
//!
//! let network = Network { loss: 0.5, ..Network::default() };
//! let mut transport = FaultyNetwork::new(InMemory::new(100), network, 1, 2, 0.005);
//! transport.begin_tick(0);
//! for byte in 0..100 {
//!     transport.send(Parcel { sender: 0, receiver: 1, bytes: [byte; 32].into() }).unwrap();
//! }
//! let arrived = core::iter::from_fn(|| transport.poll()).count();
//! assert!((30..70).contains(&arrived));
//! ```

mod bytes;
pub mod conformance;
pub mod memory;

pub use bytes::Bytes;

/// Bytes on their way.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parcel {
    /// Index of the sender.
    pub sender: usize,
    /// Index of the receiver.
    pub receiver: usize,
    /// The bytes as they were sent.
    pub bytes: Bytes,
}

/// The transport has no room for another parcel; this one is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no room for another message under way")]
pub struct Full;

/// Carries parcels. [`conformance::check_transport`] says what every transport without faults must keep:
///
/// * what is sent arrives once, unchanged, with its true sender: nobody can speak in another's name;
/// * what one robot sends to another arrives in the order in which it was sent;
/// * nothing else arrives.
///
/// A transport holds a bounded number of parcels and refuses more.
pub trait Transport {
    /// Begins a tick. Ticks never fall.
    fn begin_tick(&mut self, tick: u32);

    /// Takes a parcel that is sent in this tick.
    fn send(&mut self, parcel: Parcel) -> Result<(), Full>;

    /// The next parcel that has arrived in this tick or before; `None` if there is none yet.
    fn poll(&mut self) -> Option<Parcel>;
}
