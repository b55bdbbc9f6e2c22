//! CDR, version 1, little-endian: how ROS 2 writes messages. A number stands at a multiple of its size, counted from behind the
//! four bytes of the head.

/// Head of a message in plain CDR, little-endian.
const HEAD: [u8; 4] = [0, 1, 0, 0];

/// Writes one message.
#[derive(Clone, Debug)]
pub(super) struct Writer {
    bytes: Vec<u8>,
}

impl Default for Writer {
    fn default() -> Self {
        Self { bytes: HEAD.to_vec() }
    }
}

impl Writer {
    fn put<const SIZE: usize>(&mut self, bytes: [u8; SIZE]) {
        while !(self.bytes.len() - HEAD.len()).is_multiple_of(SIZE) {
            self.bytes.push(0);
        }
        self.bytes.extend_from_slice(&bytes);
    }

    /// A number of one byte, or a truth value.
    pub(super) fn byte(&mut self, number: u8) {
        self.put([number]);
    }

    /// A number of two bytes.
    pub(super) fn short(&mut self, number: u16) {
        self.put(number.to_le_bytes());
    }

    /// A number of four bytes.
    pub(super) fn word(&mut self, number: u32) {
        self.put(number.to_le_bytes());
    }

    /// Floating, four bytes.
    pub(super) fn float(&mut self, number: f32) {
        self.put(number.to_le_bytes());
    }

    /// Floating, eight bytes each.
    pub(super) fn doubles(&mut self, numbers: &[f64]) {
        for number in numbers {
            self.put(number.to_le_bytes());
        }
    }

    /// How many elements of a sequence follow.
    pub(super) fn count(&mut self, count: usize) {
        self.word(u32::try_from(count).unwrap_or(u32::MAX));
    }

    /// A text, with its length and a zero at the end.
    pub(super) fn text(&mut self, text: &str) {
        self.count(text.len() + 1);
        self.bytes.extend_from_slice(text.as_bytes());
        self.bytes.push(0);
    }

    /// The bytes of the message.
    pub(super) fn end(self) -> Vec<u8> {
        self.bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_at_multiples_of_their_size() {
        let mut writer = Writer::default();
        writer.text("ab");
        writer.doubles(&[1.0]);
        writer.byte(7);
        writer.short(8);
        let bytes = writer.end();
        assert_eq!(&bytes[..12], &[0, 1, 0, 0, 3, 0, 0, 0, b'a', b'b', 0, 0]);
        assert_eq!(bytes[12..20], 1.0_f64.to_le_bytes());
        assert_eq!(bytes[20..], [7, 0, 8, 0]);
    }
}
