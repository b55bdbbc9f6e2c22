//! What a recording knows of a scenario, and how a file of ours is known again.

use closeranks_core::obstacle::Obstacle;
use closeranks_sim::scenario::Scenario;

use crate::bytes::{MAGIC, code};

/// Robots of a recording at most: each has five topics.
pub const ROBOTS_MAX: u16 = 200;
/// Begins the name of the library that wrote a file of ours.
pub(crate) const LIBRARY: &str = "closeranks ";
/// Name of our record of metadata.
pub(crate) const METADATA: &str = "closeranks";
/// Key of the command in it.
pub(crate) const COMMAND: &str = "command";

/// What markers need to know that does not change.
#[derive(Clone, Debug)]
pub(crate) struct Look {
    pub(crate) malicious: Vec<bool>,
    pub(crate) radius_m: f64,
    /// How wide robots are drawn, m: half of how near they may come.
    pub(crate) body_m: f64,
    /// What stands in the way.
    pub(crate) map: Vec<Obstacle<3>>,
}

impl Look {
    pub(crate) fn new(scenario: &Scenario) -> Self {
        Self {
            malicious: scenario.malicious_mask(),
            radius_m: scenario.link.radius_m,
            body_m: 0.5 * scenario.limits.distance_min_m,
            map: scenario.obstacles.list.clone(),
        }
    }
}

/// Which command wrote the recording that begins with `start`; none if we did not write it. The metadata stand first, so some
/// kilobytes of the beginning are enough unless the scenario is long.
#[must_use]
pub fn opened_by(start: &[u8]) -> Option<String> {
    let mut at = start.strip_prefix(&MAGIC)?;
    let header = record(&mut at, code::HEADER)?;
    let mut fields = header;
    text(&mut fields)?;
    if !text(&mut fields)?.starts_with(LIBRARY) {
        return None;
    }
    let mut fields = record(&mut at, code::METADATA)?;
    if text(&mut fields)? != METADATA {
        return None;
    }
    let mut pairs = sized(&mut fields)?;
    while !pairs.is_empty() {
        let (key, value) = (text(&mut pairs)?, text(&mut pairs)?);
        if key == COMMAND {
            return Some(value.to_owned());
        }
    }
    None
}

/// The fields of the next record, as far as they are there.
fn record<'a>(at: &mut &'a [u8], wanted: u8) -> Option<&'a [u8]> {
    let (code, rest) = at.split_first()?;
    let (length, rest) = rest.split_first_chunk::<8>()?;
    let length = usize::try_from(u64::from_le_bytes(*length)).ok()?.min(rest.len());
    let (fields, rest) = rest.split_at(length);
    *at = rest;
    (*code == wanted).then_some(fields)
}

/// Bytes behind their number, as far as they are there.
fn sized<'a>(at: &mut &'a [u8]) -> Option<&'a [u8]> {
    let (length, rest) = at.split_first_chunk::<4>()?;
    let length = usize::try_from(u32::from_le_bytes(*length)).ok()?.min(rest.len());
    let (bytes, rest) = rest.split_at(length);
    *at = rest;
    Some(bytes)
}

fn text<'a>(at: &mut &'a [u8]) -> Option<&'a str> {
    core::str::from_utf8(sized(at)?).ok()
}
