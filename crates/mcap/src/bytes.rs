//! Records of an MCAP file as bytes: a code, a length, and fields that follow each other without gaps.

/// What an MCAP file begins and ends with.
pub(crate) const MAGIC: [u8; 8] = [0x89, b'M', b'C', b'A', b'P', b'0', b'\r', b'\n'];

/// Codes of records.
pub(crate) mod code {
    pub(crate) const HEADER: u8 = 0x01;
    pub(crate) const FOOTER: u8 = 0x02;
    pub(crate) const SCHEMA: u8 = 0x03;
    pub(crate) const CHANNEL: u8 = 0x04;
    pub(crate) const MESSAGE: u8 = 0x05;
    pub(crate) const CHUNK: u8 = 0x06;
    pub(crate) const MESSAGE_INDEX: u8 = 0x07;
    pub(crate) const CHUNK_INDEX: u8 = 0x08;
    pub(crate) const STATISTICS: u8 = 0x0b;
    pub(crate) const METADATA: u8 = 0x0c;
    pub(crate) const METADATA_INDEX: u8 = 0x0d;
    pub(crate) const DATA_END: u8 = 0x0f;
}

/// The fields of a record.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fields(Vec<u8>);

impl Fields {
    pub(crate) fn short(mut self, number: u16) -> Self {
        self.0.extend_from_slice(&number.to_le_bytes());
        self
    }

    pub(crate) fn word(mut self, number: u32) -> Self {
        self.0.extend_from_slice(&number.to_le_bytes());
        self
    }

    pub(crate) fn long(mut self, number: u64) -> Self {
        self.0.extend_from_slice(&number.to_le_bytes());
        self
    }

    /// Bytes as they are.
    pub(crate) fn raw(mut self, bytes: &[u8]) -> Self {
        self.0.extend_from_slice(bytes);
        self
    }

    /// Bytes behind their number.
    pub(crate) fn sized(self, bytes: &[u8]) -> Self {
        self.word(u32::try_from(bytes.len()).unwrap_or(u32::MAX)).raw(bytes)
    }

    pub(crate) fn text(self, text: &str) -> Self {
        self.sized(text.as_bytes())
    }

    /// A map, or an array of pairs, behind the number of its bytes.
    pub(crate) fn map<T>(self, items: impl IntoIterator<Item = T>, item: impl Fn(Self, T) -> Self) -> Self {
        let all = items.into_iter().fold(Self::default(), item);
        self.sized(&all.0)
    }

    /// The fields alone.
    pub(crate) fn bytes(&self) -> &[u8] {
        &self.0
    }

    /// The whole record.
    pub(crate) fn record(self, code: u8) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(9 + self.0.len());
        append(&mut bytes, code, &[&self.0]);
        bytes
    }
}

/// Appends a record whose fields are `parts` to `bytes`.
pub(crate) fn append(bytes: &mut Vec<u8>, code: u8, parts: &[&[u8]]) {
    let length: usize = parts.iter().map(|part| part.len()).sum();
    bytes.push(code);
    bytes.extend_from_slice(&(length as u64).to_le_bytes());
    for part in parts {
        bytes.extend_from_slice(part);
    }
}
