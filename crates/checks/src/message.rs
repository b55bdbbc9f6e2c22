//! Bytes from the network.

use closeranks_core::controller::links::wire::{LinkMessage, bytes_max};
use closeranks_core::message::{Message, VALUE_MAX};
use closeranks_core::num::is_finite;
use closeranks_core::robot::neighbor::RobotId;
use closeranks_core::settings::range::ROBOTS_MAX;

/// Any bytes are a message that is in range and has this one form, or an error that says why not.
pub fn message(bytes: &[u8]) {
    match Message::parse(bytes) {
        Ok(message) => {
            assert_eq!(message.encode(), bytes, "one message has one form");
            assert!(message.level().is_none_or(f64::is_finite), "{message:?}");
            assert!(message.value().is_none_or(|value| value.abs() <= VALUE_MAX), "{message:?}");
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Any bytes are a message of lists that is in range and has this one form, or an error that says why not.
pub fn link_message(bytes: &[u8]) {
    lists::<2>(bytes);
    lists::<3>(bytes);
}

fn lists<const D: usize>(bytes: &[u8]) {
    match LinkMessage::<D>::parse(bytes) {
        Ok(message) => {
            assert!(bytes.len() <= bytes_max(ROBOTS_MAX, D), "{} bytes", bytes.len());
            let mut again = vec![0; bytes.len()];
            assert_eq!(message.head().encode(message.items(), &mut again), Some(bytes.len()));
            assert_eq!(again, bytes, "one message has one form");
            let head = message.head();
            assert!(head.price_m >= 0.0 && is_finite(&head.wish_m_s), "{head:?}");
            assert!(head.value.is_none_or(|value| value.abs() <= VALUE_MAX), "{head:?}");
            for item in message.items() {
                let notice = message.to(item.id);
                assert_eq!((notice.word.entry, notice.promised), (item.entry, item.promised));
            }
            assert!(!message.to(RobotId(0)).word.entry.listed);
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
