//! Numbers as bytes, little-endian. A reader is bounded by the bytes that it was given and never panics.

/// Reads numbers from the front of some bytes.
#[derive(Clone, Copy, Debug)]
pub struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    /// Reads from the first byte on.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    /// The next `N` bytes; `None` if there are fewer.
    pub fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (front, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        Some(*front)
    }

    /// The next `count` bytes; `None` if there are fewer.
    pub fn slice(&mut self, count: usize) -> Option<&'a [u8]> {
        let (front, rest) = self.rest.split_at_checked(count)?;
        self.rest = rest;
        Some(front)
    }

    /// The next byte.
    pub fn byte(&mut self) -> Option<u8> {
        self.array::<1>().map(|[byte]| byte)
    }

    /// The next two bytes as a number.
    pub fn short(&mut self) -> Option<u16> {
        self.array().map(u16::from_le_bytes)
    }

    /// The next four bytes as a number.
    pub fn word(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    /// The next eight bytes as a number.
    pub fn long(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }

    /// The next eight bytes as a finite number; `None` if it is NaN or infinite.
    pub fn finite(&mut self) -> Option<f64> {
        self.array().map(f64::from_le_bytes).filter(|number| number.is_finite())
    }

    /// The next `D` finite numbers.
    pub fn vector<const D: usize>(&mut self) -> Option<[f64; D]> {
        let mut vector = [0.0; D];
        for component in &mut vector {
            *component = self.finite()?;
        }
        Some(vector)
    }

    /// How many bytes are left.
    #[must_use]
    pub fn left(&self) -> usize {
        self.rest.len()
    }

    /// Something, if no byte is left over.
    #[must_use]
    pub fn end(&self) -> Option<()> {
        self.rest.is_empty().then_some(())
    }
}

/// Appends the components of a vector.
pub fn put_vector<const D: usize>(bytes: &mut Vec<u8>, vector: &[f64; D]) {
    for component in vector {
        bytes.extend_from_slice(&component.to_le_bytes());
    }
}

/// The bytes as lower-case hexadecimal digits.
#[must_use]
pub fn hex(bytes: &[u8]) -> String {
    use core::fmt::Write as _;
    let mut text = String::with_capacity(2 * bytes.len());
    for byte in bytes {
        // Writing into a text does not fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// The `N` bytes that are written as 2N hexadecimal digits; `None` for any other text.
#[must_use]
pub fn unhex<const N: usize>(text: &str) -> Option<[u8; N]> {
    let digits = text.as_bytes();
    if digits.len() != 2 * N || !digits.iter().all(u8::is_ascii_hexdigit) {
        return None;
    }
    let mut bytes = [0; N];
    for (byte, pair) in bytes.iter_mut().zip(digits.chunks_exact(2)) {
        let pair = core::str::from_utf8(pair).ok()?;
        *byte = u8::from_str_radix(pair, 16).ok()?;
    }
    Some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_and_nothing_beyond_the_end() {
        let mut bytes = vec![7];
        bytes.extend_from_slice(&258_u16.to_le_bytes());
        put_vector(&mut bytes, &[1.5, -2.0]);
        let mut reader = Reader::new(&bytes);
        assert_eq!((reader.byte(), reader.short()), (Some(7), Some(258)));
        assert_eq!(reader.end(), None);
        assert_eq!(reader.vector(), Some([1.5, -2.0]));
        assert_eq!((reader.end(), reader.byte(), reader.long()), (Some(()), None, None));
    }

    #[test]
    fn numbers_that_are_not_finite_are_refused() {
        for number in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(Reader::new(&number.to_le_bytes()).finite(), None);
        }
    }

    #[test]
    fn hexadecimal_digits_have_one_length() {
        assert_eq!(unhex::<2>(&hex(&[0, 255])), Some([0, 255]));
        for wrong in ["", "0", "00f", "00f\u{e9}", "00fg", "00ff0"] {
            assert_eq!(unhex::<2>(wrong), None, "{wrong}");
        }
    }
}
