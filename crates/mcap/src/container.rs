//! An MCAP file that grows: messages wait in a chunk in memory; a full chunk is compressed and written together with a new ending, over
//! the old ending. So the file is whole after every chunk, whatever becomes of the program.
//!
//! ```text
//! magic, header, metadata, schemas, channels │ chunk, its message indexes │ … │ data end, summary, footer, magic
//!                                                                               └ written anew after every chunk
//! ```

use core::mem::take;
use std::io::{self, Seek, SeekFrom, Write};

use crate::bytes::{Fields, MAGIC, append, code};

/// A chunk is written once it holds so many bytes, or a part of all bytes before: so chunks are few in long recordings.
const CHUNK_LEAST: usize = 1 << 20;
const CHUNK_MOST: usize = 1 << 24;
const CHUNK_PART: u64 = 64;
/// How hard Zstandard tries.
const LEVEL: i32 = 3;

/// What the file says about itself before its first message.
pub(crate) struct Opening<'a> {
    pub(crate) library: String,
    pub(crate) metadata: (&'a str, Vec<(&'a str, String)>),
    /// Names and texts of schemas.
    pub(crate) schemas: Vec<(String, String)>,
    /// Topics with the place of their schema.
    pub(crate) topics: Vec<(String, usize)>,
}

/// The file.
pub(crate) struct Container<W: Write + Seek> {
    sink: W,
    /// Where the next chunk begins.
    end: u64,
    chunk: Chunk,
    /// Bytes of all chunks before they were compressed.
    written: u64,
    summary: Summary,
}

/// Messages that wait.
#[derive(Debug, Default)]
struct Chunk {
    records: Vec<u8>,
    /// For each channel the time and the place of every message.
    places: Vec<Vec<(u64, u64)>>,
    times_ns: Option<(u64, u64)>,
}

/// What stands behind the last chunk.
#[derive(Debug, Default)]
struct Summary {
    /// Schemas and channels, as at the beginning.
    topics: Vec<u8>,
    schemas: u16,
    /// Messages of each channel.
    messages: Vec<u64>,
    chunks: Vec<u8>,
    chunk_count: u32,
    metadata: Vec<u8>,
    times_ns: Option<(u64, u64)>,
}

impl<W: Write + Seek> Container<W> {
    /// Begins a file, which is whole at once: it has topics and no messages.
    pub(crate) fn new(sink: W, opening: &Opening<'_>) -> io::Result<Self> {
        let mut bytes = MAGIC.to_vec();
        bytes.extend(Fields::default().text("ros2").text(&opening.library).record(code::HEADER));
        let (name, pairs) = &opening.metadata;
        let pair = |fields: Fields, (key, value): &(&str, String)| fields.text(key).text(value);
        let metadata = Fields::default().text(name).map(pairs, pair).record(code::METADATA);
        let (at, length) = (bytes.len() as u64, metadata.len() as u64);
        let index = Fields::default().long(at).long(length).text(name).record(code::METADATA_INDEX);
        bytes.extend(metadata);
        let topics = topics(opening);
        bytes.extend_from_slice(&topics);
        let channels = opening.topics.len();
        let summary = Summary {
            topics,
            schemas: u16::try_from(opening.schemas.len()).unwrap_or(u16::MAX),
            messages: vec![0; channels],
            metadata: index,
            ..Summary::default()
        };
        let chunk = Chunk { places: vec![Vec::new(); channels], ..Chunk::default() };
        let mut file = Self { sink, end: 0, chunk, written: 0, summary };
        file.extend(bytes)?;
        Ok(file)
    }

    /// Adds a message to the topic at `place` of those that the file began with.
    pub(crate) fn message(&mut self, place: usize, time_ns: u64, data: &[u8]) -> io::Result<()> {
        let chunk = &mut self.chunk;
        let at = chunk.records.len() as u64;
        let sequence = u32::try_from(self.summary.messages[place] & 0xffff_ffff).unwrap_or(0);
        let head = Fields::default().short(channel(place)).word(sequence).long(time_ns).long(time_ns);
        append(&mut chunk.records, code::MESSAGE, &[head.bytes(), data]);
        chunk.places[place].push((time_ns, at));
        chunk.times_ns = Some(span(chunk.times_ns, time_ns));
        self.summary.messages[place] += 1;
        self.summary.times_ns = Some(span(self.summary.times_ns, time_ns));
        if chunk.records.len() < chunk_size(self.written) { Ok(()) } else { self.flush() }
    }

    /// Writes what waits; the file is whole after it.
    pub(crate) fn flush(&mut self) -> io::Result<()> {
        let Some((first_ns, last_ns)) = self.chunk.times_ns.take() else { return Ok(()) };
        let records = take(&mut self.chunk.records);
        let packed = zstd::bulk::compress(&records, LEVEL)?;
        let size = records.len() as u64;
        let chunk = Fields::default().long(first_ns).long(last_ns).long(size).word(crc32fast::hash(&records));
        let mut bytes = chunk.text("zstd").long(packed.len() as u64).raw(&packed).record(code::CHUNK);
        let chunk_length = bytes.len() as u64;
        let mut offsets = Vec::new();
        for (place, places) in
            self.chunk.places.iter_mut().enumerate().filter(|(_, places)| !places.is_empty())
        {
            offsets.push((channel(place), self.end + bytes.len() as u64));
            let index = Fields::default().short(channel(place));
            let index = index.map(places.drain(..), |fields, (time, at)| fields.long(time).long(at));
            bytes.extend(index.record(code::MESSAGE_INDEX));
        }
        let index = Fields::default().long(first_ns).long(last_ns).long(self.end).long(chunk_length);
        let index = index.map(offsets, |fields, (channel, at)| fields.short(channel).long(at));
        let index = index.long(bytes.len() as u64 - chunk_length).text("zstd");
        let index = index.long(packed.len() as u64).long(size);
        self.summary.chunks.extend(index.record(code::CHUNK_INDEX));
        self.summary.chunk_count += 1;
        self.written += size;
        self.chunk.records = records;
        self.chunk.records.clear();
        self.extend(bytes)
    }

    /// Writes `bytes` over the old ending, and a new ending behind them.
    fn extend(&mut self, mut bytes: Vec<u8>) -> io::Result<()> {
        self.sink.seek(SeekFrom::Start(self.end))?;
        let end = self.end + bytes.len() as u64;
        self.summary.append(&mut bytes, end);
        self.sink.write_all(&bytes)?;
        self.sink.flush()?;
        self.end = end;
        Ok(())
    }
}

impl Summary {
    /// Appends the ending to `bytes`; it begins at `start` in the file.
    fn append(&self, bytes: &mut Vec<u8>, start: u64) {
        bytes.extend(Fields::default().word(0).record(code::DATA_END));
        let summary = bytes.len();
        let data_end = 9 + 4;
        bytes.extend_from_slice(&self.topics);
        let (first_ns, last_ns) = self.times_ns.unwrap_or_default();
        let statistics = Fields::default().long(self.messages.iter().sum()).short(self.schemas);
        let statistics = statistics.word(u32::try_from(self.messages.len()).unwrap_or(u32::MAX));
        let statistics = statistics.word(0).word(1).word(self.chunk_count).long(first_ns).long(last_ns);
        let counts = self.messages.iter().enumerate().filter(|(_, count)| **count > 0);
        let statistics =
            statistics.map(counts, |fields, (place, count)| fields.short(channel(place)).long(*count));
        bytes.extend(statistics.record(code::STATISTICS));
        bytes.extend_from_slice(&self.chunks);
        bytes.extend_from_slice(&self.metadata);
        let footer = Fields::default().long(start + data_end).long(0);
        // The sum covers the summary and the footer up to the sum itself.
        append(bytes, code::FOOTER, &[footer.bytes(), &[0; 4]]);
        let sum_at = bytes.len() - 4;
        let sum = crc32fast::hash(&bytes[summary..sum_at]);
        bytes.truncate(sum_at);
        bytes.extend_from_slice(&sum.to_le_bytes());
        bytes.extend_from_slice(&MAGIC);
    }
}

/// The records of schemas and channels.
fn topics(opening: &Opening<'_>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for (place, (name, text)) in opening.schemas.iter().enumerate() {
        let schema = Fields::default().short(channel(place)).text(name).text("ros2msg").text(text);
        bytes.extend(schema.record(code::SCHEMA));
    }
    for (place, (name, schema)) in opening.topics.iter().enumerate() {
        let fields = Fields::default().short(channel(place)).short(channel(*schema)).text(name).text("cdr");
        let qos = [("offered_qos_profiles", "")];
        let fields = fields.map(qos, |fields, (key, value)| fields.text(key).text(value));
        bytes.extend(fields.record(code::CHANNEL));
    }
    bytes
}

/// Numbers of schemas and channels: 0 is no schema, so they begin at 1.
fn channel(place: usize) -> u16 {
    u16::try_from(place + 1).unwrap_or(u16::MAX)
}

fn span(times_ns: Option<(u64, u64)>, time_ns: u64) -> (u64, u64) {
    times_ns.map_or((time_ns, time_ns), |(first, last)| (first.min(time_ns), last.max(time_ns)))
}

fn chunk_size(written: u64) -> usize {
    usize::try_from(written / CHUNK_PART).unwrap_or(CHUNK_MOST).clamp(CHUNK_LEAST, CHUNK_MOST)
}
