//! The last envelopes of a sender, as they came.

use std::collections::VecDeque;

use crate::wire::envelope::hash;

/// How many are kept of each sender. What others say of older ones cannot be compared any more.
pub(crate) const KEPT: usize = 32;

/// An envelope, its number (epoch and sequence) and its hash.
#[derive(Clone, Debug)]
struct Item {
    number: (u64, u64),
    hash: [u8; 16],
    bytes: Vec<u8>,
}

/// Envelopes in the order of their numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct History {
    items: VecDeque<Item>,
}

impl History {
    /// Keeps one more and forgets the oldest.
    pub(crate) fn push(&mut self, number: (u64, u64), bytes: &[u8]) {
        if self.items.len() >= KEPT {
            self.items.pop_front();
        }
        self.items.push_back(Item { number, hash: hash(bytes), bytes: bytes.to_vec() });
    }

    fn find(&self, number: (u64, u64)) -> Option<&Item> {
        let index = self.items.binary_search_by_key(&number, |item| item.number).ok()?;
        self.items.get(index)
    }

    /// The envelope with that number.
    pub(crate) fn get(&self, number: (u64, u64)) -> Option<&[u8]> {
        self.find(number).map(|item| item.bytes.as_slice())
    }

    /// The envelope with that number, and its hash.
    pub(crate) fn hashed(&self, number: (u64, u64)) -> Option<(&[u8], [u8; 16])> {
        self.find(number).map(|item| (item.bytes.as_slice(), item.hash))
    }

    /// True if an envelope with that number was kept and has other bytes.
    pub(crate) fn differs(&self, number: (u64, u64), bytes: &[u8]) -> bool {
        self.get(number).is_some_and(|kept| kept != bytes)
    }
}
