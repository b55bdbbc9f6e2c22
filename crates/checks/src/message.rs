//! Bytes from the network.

use closeranks_core::message::{Message, VALUE_MAX};

/// Any bytes are a message that is in range and has this one form, or an error that says why not.
pub fn message(bytes: &[u8]) {
    match Message::parse(bytes) {
        Ok(message) => {
            assert_eq!(message.encode(), bytes, "one message has one form");
            assert!(message.level().is_finite(), "{message:?}");
            assert!(message.value().is_none_or(|value| value.abs() <= VALUE_MAX), "{message:?}");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
