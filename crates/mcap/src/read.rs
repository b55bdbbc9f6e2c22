//! A recording of ours, read back as far as it is whole: what robots were like, for the page.

use std::collections::BTreeMap;

use closeranks_sim::parse;

use crate::bytes::{MAGIC, code};
use crate::history::{COLUMNS, History, MOMENTS_MAX};
use crate::look::{METADATA, ROBOTS_MAX};

/// The largest chunk that is unpacked, bytes; ours have 16 MiB and a message more.
const CHUNK_MAX: u64 = 1 << 26;

/// Why a file is no recording of ours.
#[derive(Debug, thiserror::Error)]
pub enum McapError {
    /// It begins in another way.
    #[error("not an MCAP file")]
    NotMcap,
    /// There is no scenario in its metadata, or one that cannot be read.
    #[error("no MCAP file that `closeranks run --record` wrote: it carries no scenario")]
    NoScenario,
    /// There is no moment in which all robots are known.
    #[error("it holds no whole tick")]
    Empty,
    /// A chunk is broken, or too large.
    #[error("the chunk at byte {0} is broken or larger than {CHUNK_MAX} bytes")]
    Chunk(usize),
}

/// What a channel of ours holds of a robot, by its index.
#[derive(Clone, Copy)]
enum Channel {
    Pose(usize),
    State(usize),
}

/// Reads a recording. What follows the first record that is not whole is left out.
pub fn read(file: &[u8]) -> Result<History, McapError> {
    let mut rest = file.strip_prefix(&MAGIC).ok_or(McapError::NotMcap)?;
    let mut reading = Reading::default();
    while let Some((kind, fields)) = record(&mut rest) {
        match kind {
            code::METADATA => reading.metadata(fields)?,
            code::CHANNEL => reading.channel(fields),
            code::CHUNK => {
                let at = file.len() - rest.len() - fields.len();
                let records = unpacked(fields).ok_or(McapError::Chunk(at))?;
                reading.messages(&records);
            }
            code::DATA_END => break,
            _ => {}
        }
    }
    reading.finish()
}

#[derive(Default)]
struct Reading {
    scenario: Option<String>,
    robots: usize,
    tick_ns: u64,
    channels: BTreeMap<u16, Channel>,
    /// Every so many ticks one is kept.
    stride: u64,
    rows: BTreeMap<u64, Vec<f64>>,
}

impl Reading {
    fn metadata(&mut self, fields: &[u8]) -> Result<(), McapError> {
        let mut fields = Cursor { bytes: fields, at: 0 };
        if fields.text() != Some(METADATA) {
            return Ok(());
        }
        let mut pairs = Cursor { bytes: fields.sized().ok_or(McapError::NoScenario)?, at: 0 };
        while let (Some(key), Some(value)) = (pairs.text(), pairs.text()) {
            if key == "scenario" {
                let scenario = parse::scenario(value).map_err(|_| McapError::NoScenario)?;
                self.scenario = Some(value.to_owned());
                self.robots = usize::from(scenario.team.robots.min(ROBOTS_MAX));
                self.tick_ns =
                    u64::try_from(scenario.clock.level_period.as_nanos()).unwrap_or(u64::MAX).max(1);
                self.stride = 1;
            }
        }
        Ok(())
    }

    fn channel(&mut self, fields: &[u8]) {
        let mut fields = Cursor { bytes: fields, at: 0 };
        let (Some(id), Some(_), Some(topic)) = (fields.short(), fields.short(), fields.text()) else {
            return;
        };
        let Some((robot, name)) = topic.strip_prefix("/robot_").and_then(|rest| rest.split_once('/')) else {
            return;
        };
        let Some(index) = robot.parse::<usize>().ok().and_then(|robot| robot.checked_sub(1)) else { return };
        if index >= self.robots {
            return;
        }
        match name {
            "pose" => _ = self.channels.insert(id, Channel::Pose(index)),
            "state" => _ = self.channels.insert(id, Channel::State(index)),
            _ => {}
        }
    }

    fn messages(&mut self, mut records: &[u8]) {
        while let Some((kind, fields)) = record(&mut records) {
            if kind == code::MESSAGE {
                // A message that is not ours says nothing.
                let _ = self.message(fields);
            }
        }
    }

    fn message(&mut self, fields: &[u8]) -> Option<()> {
        let mut head = Cursor { bytes: fields, at: 0 };
        let channel = *self.channels.get(&head.short()?)?;
        head.word()?;
        let tick = head.long()? / self.tick_ns;
        if !tick.is_multiple_of(self.stride) {
            return None;
        }
        // Behind the head of the record and that of CDR: stamp, frame, and the fields of the message.
        let mut body = Cursor { bytes: fields.get(22 + 4..)?, at: 0 };
        body.word()?;
        body.word()?;
        body.sized()?;
        let (index, known): (usize, Vec<(usize, f64)>) = match channel {
            Channel::Pose(index) => (index, vec![(0, body.double()?), (1, body.double()?)]),
            Channel::State(index) => (index, state(&mut body)?),
        };
        let robots = self.robots;
        let row = self.rows.entry(tick).or_insert_with(|| vec![f64::NAN; robots * COLUMNS.len()]);
        for (column, number) in known {
            row[column * robots + index] = number;
        }
        if self.rows.len() > MOMENTS_MAX {
            self.stride *= 2;
            let stride = self.stride;
            self.rows.retain(|tick, _| tick.is_multiple_of(stride));
        }
        Some(())
    }

    fn finish(self) -> Result<History, McapError> {
        let scenario = self.scenario.ok_or(McapError::NoScenario)?;
        let robots = self.robots;
        let mut history = History { scenario, robots, ticks: Vec::new(), columns: Default::default() };
        for (tick, row) in &self.rows {
            let known =
                |column: usize| row[column * robots..(column + 1) * robots].iter().all(|x| x.is_finite());
            // Of a killed run the last tick may lack some robots.
            if !(known(0) && known(1) && known(2)) {
                continue;
            }
            history.ticks.push(u32::try_from(*tick).unwrap_or(u32::MAX));
            for (column, numbers) in history.columns.iter_mut().enumerate() {
                numbers.extend_from_slice(&row[column * robots..(column + 1) * robots]);
            }
        }
        if history.ticks.is_empty() { Err(McapError::Empty) } else { Ok(history) }
    }
}

/// Degree, level, h and value of a `closeranks_msgs/RobotState`, each with its column.
fn state(body: &mut Cursor<'_>) -> Option<Vec<(usize, f64)>> {
    body.take(4, 4)?; // tick
    body.aligned_short()?; // robot
    body.take(2, 1)?; // malicious, down
    let degree = f64::from(body.aligned_short()?);
    body.aligned_short()?; // required
    let level = body.double()?;
    body.double()?; // told
    let h = body.double()?;
    body.double()?; // phi_i
    Some(vec![(2, degree), (3, level), (4, h), (5, body.double()?)])
}

/// The next record: its code and its fields.
fn record<'a>(rest: &mut &'a [u8]) -> Option<(u8, &'a [u8])> {
    let (code, after) = rest.split_first()?;
    let (length, after) = after.split_first_chunk::<8>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?;
    let (fields, after) = after.split_at_checked(length)?;
    *rest = after;
    Some((*code, fields))
}

/// The records of a chunk.
fn unpacked(fields: &[u8]) -> Option<Vec<u8>> {
    let mut fields = Cursor { bytes: fields, at: 16 };
    let size = fields.long().filter(|size| *size <= CHUNK_MAX)?;
    fields.word()?;
    let packing = fields.text()?;
    let length = usize::try_from(fields.long()?).ok()?;
    let packed = fields.take(length, 1)?;
    match packing {
        "" => Some(packed.to_vec()),
        "zstd" => zstd::bulk::decompress(packed, usize::try_from(size).ok()?).ok(),
        _ => None,
    }
}

/// Reads fields one after another; numbers of CDR stand at multiples of their size.
struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Cursor<'a> {
    fn take(&mut self, count: usize, align: usize) -> Option<&'a [u8]> {
        let start = self.at.next_multiple_of(align);
        let end = start.checked_add(count)?;
        let bytes = self.bytes.get(start..end)?;
        self.at = end;
        Some(bytes)
    }

    fn short(&mut self) -> Option<u16> {
        self.take(2, 1)?.try_into().ok().map(u16::from_le_bytes)
    }

    fn aligned_short(&mut self) -> Option<u16> {
        self.take(2, 2)?.try_into().ok().map(u16::from_le_bytes)
    }

    fn word(&mut self) -> Option<u32> {
        self.take(4, 1)?.try_into().ok().map(u32::from_le_bytes)
    }

    fn long(&mut self) -> Option<u64> {
        self.take(8, 1)?.try_into().ok().map(u64::from_le_bytes)
    }

    fn double(&mut self) -> Option<f64> {
        self.take(8, 8)?.try_into().ok().map(f64::from_le_bytes)
    }

    /// Bytes behind their number.
    fn sized(&mut self) -> Option<&'a [u8]> {
        let length = usize::try_from(self.word()?).ok()?;
        self.take(length, 1)
    }

    fn text(&mut self) -> Option<&'a str> {
        core::str::from_utf8(self.sized()?).ok()
    }
}
