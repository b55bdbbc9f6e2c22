//! A perfect network in memory: what is sent arrives at once.

use std::collections::VecDeque;

use super::{Full, Parcel, Transport};

/// A queue of parcels.
#[derive(Clone, Debug)]
pub struct InMemory {
    queue: VecDeque<Parcel>,
    capacity: usize,
}

impl InMemory {
    /// A network that holds at most `capacity` parcels. Memory is taken when it is used.
    #[must_use]
    pub fn new(capacity: usize) -> Self {
        Self { queue: VecDeque::new(), capacity }
    }
}

impl Transport for InMemory {
    fn begin_tick(&mut self, _tick: u32) {}

    fn send(&mut self, parcel: Parcel) -> Result<(), Full> {
        if self.queue.len() >= self.capacity {
            return Err(Full);
        }
        self.queue.push_back(parcel);
        Ok(())
    }

    fn poll(&mut self) -> Option<Parcel> {
        self.queue.pop_front()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transport::conformance::check_transport;

    #[test]
    fn it_is_a_transport() {
        check_transport(&mut InMemory::new(1_000), &mut || ());
    }

    #[test]
    fn it_holds_no_more_than_it_was_made_for() {
        let mut network = InMemory::new(2);
        let parcel = Parcel { sender: 0, receiver: 1, bytes: [7; 32].into() };
        let sent = [(); 3].map(|()| network.send(parcel.clone()));
        assert_eq!(sent, [Ok(()), Ok(()), Err(Full)]);
        assert_eq!([(); 3].map(|()| network.poll()), [Some(parcel.clone()), Some(parcel.clone()), None]);
        assert_eq!(network.send(parcel), Ok(()));
    }
}
