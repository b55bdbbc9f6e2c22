//! The port through which the page sees a run that it does not compute: lines of JSON. The first says the scenario, each of the others what
//! robots were like at one moment. A recording is all lines at once; a live source goes on.

use std::collections::VecDeque;
use std::io::{BufRead, Read as _};
use std::sync::{Condvar, Mutex, PoisonError};

use anyhow::{Context as _, Result, bail};
use closeranks_report::recording::history::{COLUMNS, MOMENTS_MAX};
use closeranks_sim::scenario::Scenario;
use serde_json::Value;

use crate::source;

/// Longest line, bytes: two hundred robots have some twenty kilobytes.
const LINE_MAX: usize = 1 << 20;

/// Lines of a live source: the first, and as many of the newest as a page keeps.
#[derive(Default)]
pub(crate) struct Feed {
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    first: String,
    lines: VecDeque<String>,
    /// Lines that were ever taken, without the first.
    taken: usize,
    over: bool,
}

impl Feed {
    /// Reads the first line, which must have a scenario that the page can show.
    pub(crate) fn begin(&self, source: &mut impl BufRead) -> Result<(Scenario, String)> {
        let line = line(source)?.context("the live source ended before its first line")?;
        let value: Value = serde_json::from_str(&line).context("line 1 of the live source is not JSON")?;
        let text = value["scenario"].as_str();
        let text =
            text.context("line 1 of the live source: allowed is {\"scenario\": \"the text of a scenario\"}")?;
        let read = source::read("the scenario of the live source", text.to_owned())?;
        self.change(|state| state.first = line);
        Ok(read)
    }

    /// Takes moments of `robots` robots until the source ends; a line that is none ends it too.
    pub(crate) fn follow(&self, source: &mut impl BufRead, robots: u16) -> Result<()> {
        let followed = self.take(source, usize::from(robots));
        self.change(|state| state.over = true);
        followed
    }

    fn take(&self, source: &mut impl BufRead, robots: usize) -> Result<()> {
        let mut number = 1_usize;
        while let Some(line) = line(source)? {
            number += 1;
            check(&line, robots).with_context(|| format!("line {number} of the live source"))?;
            self.change(|state| {
                state.taken += 1;
                state.lines.push_back(line);
                while state.lines.len() > MOMENTS_MAX {
                    state.lines.pop_front();
                }
            });
        }
        Ok(())
    }

    /// What a reader has not seen, waiting for it; none once the source has ended. `seen` is none for who has seen nothing. What is
    /// no longer kept is left out.
    pub(crate) fn next(&self, seen: &mut Option<usize>) -> Option<String> {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(count) = *seen else {
            *seen = Some(0);
            return Some(format!("{}\n", state.first));
        };
        while state.taken == count && !state.over {
            state = self.changed.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
        if state.taken == count {
            return None;
        }
        let oldest = state.taken - state.lines.len();
        let new = state.lines.iter().skip(count.saturating_sub(oldest));
        let text = new.flat_map(|line| [line.as_str(), "\n"]).collect();
        *seen = Some(state.taken);
        Some(text)
    }

    fn change(&self, change: impl FnOnce(&mut State)) {
        change(&mut self.state.lock().unwrap_or_else(PoisonError::into_inner));
        self.changed.notify_all();
    }
}

/// The next line, without its end; none if there is no other.
fn line(source: &mut impl BufRead) -> Result<Option<String>> {
    let mut bytes = Vec::new();
    let mut part = source.take(LINE_MAX as u64 + 1);
    part.read_until(b'\n', &mut bytes).context("cannot read the live source")?;
    if bytes.len() > LINE_MAX {
        bail!("a line of the live source is longer than {LINE_MAX} bytes");
    }
    if bytes.is_empty() {
        return Ok(None);
    }
    let text = String::from_utf8(bytes).context("a line of the live source is no text")?;
    Ok(Some(text.trim_end().to_owned()))
}

/// Refuses a line that is no moment of so many robots.
fn check(line: &str, robots: usize) -> Result<()> {
    let value: Value = serde_json::from_str(line).context("not JSON")?;
    if value["tick"].as_u64().is_none_or(|tick| tick > u64::from(u32::MAX)) {
        bail!("`tick` is {}: allowed is a whole number, 0 to {}", value["tick"], u32::MAX);
    }
    for name in COLUMNS {
        let is_number = |number: &Value| number.is_null() || number.as_f64().is_some_and(f64::is_finite);
        if !value[name].as_array().is_some_and(|all| all.len() == robots && all.iter().all(is_number)) {
            bail!("`{name}`: allowed is a list of {robots} numbers, or null where there is none");
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moment(tick: u32) -> String {
        let numbers = "[0.5,1,null]";
        let columns: Vec<String> = COLUMNS.iter().map(|name| format!("\"{name}\":{numbers}")).collect();
        format!("{{\"tick\":{tick},{}}}\n", columns.join(","))
    }

    const FIRST: &str =
        "{\"scenario\":\"team.robots = 3\\nteam.faults = 0\\nstart.kind = \\\"hexagon\\\"\"}\n";

    #[test]
    fn who_comes_late_sees_what_is_kept_and_then_the_rest() {
        let feed = Feed::default();
        let text = FIRST.to_owned() + &moment(0) + &moment(1);
        let mut source = text.as_bytes();
        feed.begin(&mut source).unwrap();
        feed.follow(&mut source, 3).unwrap();
        let mut seen = None;
        assert_eq!(feed.next(&mut seen).unwrap(), FIRST);
        assert_eq!(feed.next(&mut seen).unwrap(), moment(0) + &moment(1));
        assert_eq!(feed.next(&mut seen), None);
        let mut some = Some(1);
        assert_eq!(feed.next(&mut some).unwrap(), moment(1));
    }

    #[test]
    fn only_the_newest_moments_are_kept() {
        let feed = Feed::default();
        let many = u32::try_from(MOMENTS_MAX).unwrap() + 7;
        let text: String = (0..many).map(moment).collect();
        feed.follow(&mut text.as_bytes(), 3).unwrap();
        let all = feed.next(&mut Some(0)).unwrap();
        assert_eq!(all.lines().count(), MOMENTS_MAX);
        assert_eq!(all.lines().next().unwrap(), moment(7).trim_end());
    }

    #[test]
    fn what_is_no_moment_is_refused_with_its_line() {
        let refused = |line: &str| {
            let text = moment(0) + line;
            format!("{:#}", Feed::default().follow(&mut text.as_bytes(), 3).unwrap_err())
        };
        assert_eq!(
            refused("hello"),
            "line 3 of the live source: not JSON: expected value at line 1 column 1"
        );
        let short = moment(1).replacen("[0.5,1,null]", "[0.5]", 1);
        let message =
            "line 3 of the live source: `x_m`: allowed is a list of 3 numbers, or null where there is none";
        assert_eq!(refused(&short), message);
        let early = moment(1).replace("\"tick\":1", "\"tick\":-1");
        assert!(refused(&early).contains("`tick` is -1: allowed is a whole number"));
        let long = "x".repeat(LINE_MAX + 1);
        assert!(refused(&long).contains("longer than"));
        let begin = |text: &str| format!("{:#}", Feed::default().begin(&mut text.as_bytes()).unwrap_err());
        assert!(begin("").contains("ended before its first line"));
        assert!(begin("{}\n").contains("allowed is {\"scenario\""));
    }
}
