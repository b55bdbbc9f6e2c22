//! What robots say of themselves, as tools for diagnostics show it.

use closeranks_core::robot::report::{Mode, Reason};
use closeranks_sim::output::record::outcome_name;
use closeranks_sim::output::snapshot::Snapshot;

use crate::cdr::Writer;
use crate::messages::name;

const OK: u8 = 0;
const WARN: u8 = 1;
const ERROR: u8 = 2;
const STALE: u8 = 3;

/// `diagnostic_msgs/DiagnosticArray`: one status a robot.
pub(crate) fn diagnostics(now: &Snapshot<'_>, time_ns: u64, malicious: &[bool]) -> Vec<u8> {
    let mut writer = Writer::default();
    writer.header(time_ns, "");
    writer.count(now.robots());
    for index in 0..now.robots() {
        status(&mut writer, now, index, malicious.get(index).copied().unwrap_or(false));
    }
    writer.end()
}

fn status(writer: &mut Writer, now: &Snapshot<'_>, index: usize, malicious: bool) {
    let (level, message) = if now.down[index] {
        (STALE, "down")
    } else {
        (level(now.modes[index], now.degree[index] < now.required_degree), now.modes[index].name())
    };
    writer.byte(level);
    writer.text(&format!("{}: closeranks", name(index)));
    writer.text(message);
    writer.text(&name(index));
    let values = [
        ("degree", format!("{}", now.degree[index])),
        ("degree required", format!("{}", now.required_degree)),
        ("h", format!("{:.6}", now.h(index))),
        ("value", format!("{:.6}", now.value[index])),
        ("outcome", outcome_name(now.outcome[index]).to_owned()),
        ("malicious", malicious.to_string()),
    ];
    writer.count(values.len());
    for (key, value) in &values {
        writer.text(key);
        writer.text(value);
    }
}

/// How grave a mode is. A controller that promises nothing in discrete time is no reason to warn.
fn level(mode: Mode, short_of_neighbors: bool) -> u8 {
    match mode {
        _ if short_of_neighbors => ERROR,
        Mode::Guaranteed | Mode::Degraded(Reason::ContinuousTime | Reason::Unfiltered) => OK,
        Mode::Degraded(Reason::Degree | Reason::Infeasible | Reason::OutsideSafeSet) | Mode::Stopped => ERROR,
        Mode::Degraded(_) | Mode::Hold => WARN,
    }
}
