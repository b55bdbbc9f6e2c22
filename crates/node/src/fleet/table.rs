//! The table that a fleet draws on a terminal while it runs.

use std::io::{IsTerminal as _, Write as _};

use closeranks_core::Instant;
use closeranks_sim::scenario::Scenario;
use core::fmt::Write as _;
use core::time::Duration;

use crate::gate::Reject;
use crate::plant::world::World;
use crate::wire::mode;

/// How often it is drawn.
const EVERY: Duration = Duration::from_millis(500);

/// Draws one row a robot, in place.
pub struct Table {
    live: bool,
    malicious: Vec<bool>,
    required: u16,
    next: Option<Instant>,
    drawn: usize,
}

impl Table {
    /// A table for the robots of `scenario`; it draws nothing unless `live` and standard error is a terminal.
    #[must_use]
    pub fn new(live: bool, scenario: &Scenario) -> Self {
        let live = live && std::io::stderr().is_terminal();
        let required = scenario.composition().required;
        Self { live, malicious: scenario.malicious_mask(), required, next: None, drawn: 0 }
    }

    /// Draws, if it is time.
    pub fn draw<const D: usize>(&mut self, world: &World<D>, states: &[&str], now: Instant) {
        if !self.live || self.next.is_some_and(|next| now < next) {
            return;
        }
        self.next = Some(now.after(EVERY));
        let text = self.text(world, states, now);
        let mut out = String::new();
        if self.drawn > 0 {
            let _ = write!(out, "\x1b[{}A", self.drawn);
        }
        for line in text.lines() {
            let _ = writeln!(out, "\x1b[2K{line}");
        }
        self.drawn = text.lines().count();
        // Nothing depends on the terminal.
        let _ = std::io::stderr().write_all(out.as_bytes());
    }

    /// What is drawn.
    #[must_use]
    pub fn text<const D: usize>(&self, world: &World<D>, states: &[&str], now: Instant) -> String {
        let period_s = world.period().as_secs_f64();
        let extremes = world.monitors().extremes();
        let mut text = format!(
            "t {:7.2} s   F' {}   least degree {}   least distance {:.3} m\n",
            f64::from(world.tick()) * period_s,
            self.required,
            extremes.degree_min.map_or_else(|| "-".into(), |degree| degree.to_string()),
            if extremes.distance_min_m.is_finite() { extremes.distance_min_m } else { 0.0 },
        );
        text.push_str(
            "robot       process  mode         degree      h        y   told  missed  busy  seen  rejects\n",
        );
        for (index, report) in world.reports().iter().enumerate() {
            let name = format!("{}{}", index + 1, if self.malicious[index] { " liar" } else { "" });
            let state = states.get(index).copied().unwrap_or("-");
            let _ = match report {
                None => writeln!(text, "{name:<10}  {state:<8} -"),
                Some((at, report)) => writeln!(
                    text,
                    "{name:<10}  {state:<8} {:<11}  {:>2} {:+3}  {:6.3}  {:7.2}  {:>3}ms {:>6}  {:>3.1}ms {:>4.1}s {}",
                    mode::word(report.mode),
                    report.degree,
                    report.degree_margin,
                    report.h,
                    report.value,
                    report.told_age_ms,
                    report.missed,
                    f64::from(report.busy_us) / 1_000.0,
                    now.since(*at).as_secs_f64(),
                    rejects(&report.rejects),
                ),
            };
        }
        text
    }

    /// Ends the table: what comes next is written below it.
    pub fn end(&self) {
        if self.live {
            let _ = std::io::stderr().write_all(b"\n");
        }
    }
}

/// The three most frequent reasons.
fn rejects(counts: &[u32]) -> String {
    let mut named: Vec<(u32, &str)> =
        counts.iter().copied().zip(Reject::ALL.map(Reject::name)).filter(|(count, _)| *count > 0).collect();
    named.sort_by_key(|(count, _)| core::cmp::Reverse(*count));
    let words: Vec<String> = named.iter().take(3).map(|(count, name)| format!("{name} {count}")).collect();
    words.join(" ")
}
