//! Which number a name has, found fast where names are whole numbers, as they are in most large texts.

use alloc::borrow::ToOwned;
use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use crate::network::NETWORK_LIMIT;

/// Names that are whole numbers below this are found by their value.
const WHOLE_MAX: usize = 2 * NETWORK_LIMIT;

/// Names with a number each.
#[derive(Default)]
pub(super) struct Index {
    /// The number of the name `0`, `1`, and so on; `None` where there is no such name.
    whole: Vec<Option<u32>>,
    other: BTreeMap<String, u32>,
}

impl Index {
    /// The number of a name.
    pub(super) fn get(&self, name: &str) -> Option<usize> {
        let number = match whole(name) {
            Some(value) => self.whole.get(value).copied().flatten(),
            None => self.other.get(name).copied(),
        };
        number.map(|number| number as usize)
    }

    /// Gives a name a number below the limit of networks; false if it has one already.
    pub(super) fn insert(&mut self, name: &str, number: usize) -> bool {
        let number = u32::try_from(number).unwrap_or(u32::MAX);
        let Some(value) = whole(name) else {
            let is_new = !self.other.contains_key(name);
            if is_new {
                self.other.insert(name.to_owned(), number);
            }
            return is_new;
        };
        if value >= self.whole.len() {
            self.whole.resize(value + 1, None);
        }
        let place = &mut self.whole[value];
        let is_new = place.is_none();
        *place = place.or(Some(number));
        is_new
    }
}

/// The value of a name such as `17`, but not of `017`.
fn whole(name: &str) -> Option<usize> {
    let canonical = name == "0" || (!name.starts_with('0') && name.bytes().all(|sign| sign.is_ascii_digit()));
    let value = if canonical && name.len() <= 7 { name.parse().ok() } else { None };
    value.filter(|value| *value < WHOLE_MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_has_its_own_number() {
        let names =
            ["0", "00", "7", "07", "+7", "7.0", "", "a", "9999999", "10000000", "8388607", "8388608", "7 "];
        let mut index = Index::default();
        for (number, name) in names.iter().enumerate() {
            assert_eq!(index.get(name), None, "{name:?}");
            assert!(index.insert(name, number), "{name:?}");
        }
        for (number, name) in names.iter().enumerate() {
            assert_eq!(index.get(name), Some(number), "{name:?}");
            assert!(!index.insert(name, 99), "{name:?} twice");
            assert_eq!(index.get(name), Some(number), "{name:?}");
        }
    }
}
