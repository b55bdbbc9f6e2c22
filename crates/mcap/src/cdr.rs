//! CDR, version 1, little-endian: how ROS 2 writes messages. A number stands at a multiple of its size, counted from behind the
//! four bytes of the head.

use core::str;

/// Head of a message in plain CDR, little-endian.
const HEAD: [u8; 4] = [0, 1, 0, 0];
/// Longest text that is read, bytes. Frames have names of some tens.
pub const TEXT_MAX: usize = 256;

/// Writes one message.
#[derive(Clone, Debug)]
pub struct Writer {
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
    pub fn byte(&mut self, number: u8) {
        self.put([number]);
    }

    /// A number of two bytes.
    pub fn short(&mut self, number: u16) {
        self.put(number.to_le_bytes());
    }

    /// A number of four bytes.
    pub fn word(&mut self, number: u32) {
        self.put(number.to_le_bytes());
    }

    /// Floating, four bytes.
    pub fn float(&mut self, number: f32) {
        self.put(number.to_le_bytes());
    }

    /// Floating, eight bytes each.
    pub fn doubles(&mut self, numbers: &[f64]) {
        for number in numbers {
            self.put(number.to_le_bytes());
        }
    }

    /// How many elements of a sequence follow.
    pub fn count(&mut self, count: usize) {
        self.word(u32::try_from(count).unwrap_or(u32::MAX));
    }

    /// A text, with its length and a zero at the end.
    pub fn text(&mut self, text: &str) {
        self.count(text.len() + 1);
        self.bytes.extend_from_slice(text.as_bytes());
        self.bytes.push(0);
    }

    /// `std_msgs/Header`: a time and a frame.
    pub fn header(&mut self, time_ns: u64, frame: &str) {
        // Seconds are signed 32 bits in ROS 2: 68 years.
        self.word(u32::try_from((time_ns / 1_000_000_000).min(0x7fff_ffff)).unwrap_or(0));
        self.word(u32::try_from(time_ns % 1_000_000_000).unwrap_or(0));
        self.text(frame);
    }

    /// The bytes of the message.
    #[must_use]
    pub fn end(self) -> Vec<u8> {
        self.bytes
    }
}

/// Reads a message. Every method gives `None` where the bytes are not what they must be.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a> {
    body: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    /// A reader behind the head; only little-endian plain CDR is read.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Option<Self> {
        let body = bytes.strip_prefix(&HEAD[..2])?.get(2..)?;
        Some(Self { body, at: 0 })
    }

    fn take(&mut self, count: usize, align: usize) -> Option<&'a [u8]> {
        let start = self.at.next_multiple_of(align);
        let end = start.checked_add(count)?;
        let bytes = self.body.get(start..end)?;
        self.at = end;
        Some(bytes)
    }

    /// A number of four bytes.
    pub fn word(&mut self) -> Option<u32> {
        self.take(4, 4)?.try_into().ok().map(u32::from_le_bytes)
    }

    /// A finite number of eight bytes.
    pub fn finite(&mut self) -> Option<f64> {
        let number = self.take(8, 8)?.try_into().ok().map(f64::from_le_bytes)?;
        number.is_finite().then_some(number)
    }

    /// A text of at most [`TEXT_MAX`] bytes.
    pub fn text(&mut self) -> Option<&'a str> {
        let length = usize::try_from(self.word()?).ok()?;
        if length == 0 || length > TEXT_MAX + 1 {
            return None;
        }
        let (zero, text) = self.take(length, 1)?.split_last()?;
        if *zero == 0 { str::from_utf8(text).ok() } else { None }
    }

    /// `std_msgs/Header`, of which the frame is told.
    pub fn header(&mut self) -> Option<&'a str> {
        self.word()?;
        self.word()?;
        self.text()
    }

    /// Numbers one after another, whatever they are.
    pub fn skip_doubles(&mut self, count: usize) -> Option<()> {
        self.take(count.checked_mul(8)?, 8).map(|_| ())
    }

    /// Something, if nothing but up to three bytes of padding is left.
    #[must_use]
    pub fn end(&self) -> Option<()> {
        (self.body.len() - self.at < 4).then_some(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

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
        let mut reader = Reader::new(&bytes[..20]).unwrap();
        assert_eq!((reader.text(), reader.finite(), reader.end()), (Some("ab"), Some(1.0), Some(())));
        assert_eq!((reader.word(), reader.text()), (None, None));
    }

    #[test]
    fn a_header_is_read_as_it_is_written() {
        let mut writer = Writer::default();
        writer.header(5_000_000_007, "map");
        let bytes = writer.end();
        assert_eq!(bytes[4..12], [5, 0, 0, 0, 7, 0, 0, 0]);
        assert_eq!(Reader::new(&bytes).unwrap().header(), Some("map"));
    }

    proptest! {
        #[test]
        fn any_bytes_and_any_calls_end_well(bytes in prop::collection::vec(any::<u8>(), 0..80), calls in prop::collection::vec(0..4, 0..20)) {
            let bytes = [&HEAD[..], &bytes].concat();
            let mut reader = Reader::new(&bytes).unwrap();
            for call in calls {
                match call {
                    0 => _ = reader.word(),
                    1 => _ = reader.finite(),
                    2 => _ = reader.text(),
                    _ => _ = reader.skip_doubles(usize::MAX / 8),
                }
                let _ = reader.end();
            }
        }
    }
}
