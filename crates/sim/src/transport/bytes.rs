//! The bytes of a message on their way: few stand in the parcel itself, more are shared by all parcels that carry them.

use core::fmt;
use core::ops::Deref;
use std::sync::Arc;

use closeranks_core::message::MESSAGE_BYTES;

/// Bytes that are never changed again. A copy costs no more than one of few bytes.
#[derive(Clone)]
pub enum Bytes {
    /// A message of fixed size.
    Short([u8; MESSAGE_BYTES]),
    /// Any other number of bytes.
    Long(Arc<[u8]>),
}

impl Bytes {
    /// True if both are shared and the same place in memory; what is so has the same bytes.
    #[must_use]
    pub fn is_shared_with(&self, other: &Self) -> bool {
        matches!((self, other), (Self::Long(one), Self::Long(other)) if Arc::ptr_eq(one, other))
    }
}

impl Deref for Bytes {
    type Target = [u8];

    fn deref(&self) -> &[u8] {
        match self {
            Self::Short(bytes) => bytes,
            Self::Long(bytes) => bytes,
        }
    }
}

impl From<[u8; MESSAGE_BYTES]> for Bytes {
    fn from(bytes: [u8; MESSAGE_BYTES]) -> Self {
        Self::Short(bytes)
    }
}

impl From<&[u8]> for Bytes {
    fn from(bytes: &[u8]) -> Self {
        bytes.try_into().map_or_else(|_| Self::Long(bytes.into()), Self::Short)
    }
}

impl PartialEq for Bytes {
    fn eq(&self, other: &Self) -> bool {
        self[..] == other[..]
    }
}

impl Eq for Bytes {}

impl fmt::Debug for Bytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self[..].fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_what_they_were_made_of() {
        let long: Vec<u8> = (0..200).collect();
        for length in [0, 1, 31, 32, 33, 200] {
            let bytes = Bytes::from(&long[..length]);
            assert_eq!((&bytes[..], bytes.clone() == bytes), (&long[..length], true));
            assert_eq!(bytes.is_shared_with(&bytes.clone()), length != MESSAGE_BYTES);
            assert!(!bytes.is_shared_with(&Bytes::from(&long[..length])));
        }
        assert_eq!(Bytes::from([7; MESSAGE_BYTES]), Bytes::from(&[7; MESSAGE_BYTES][..]));
    }
}
